//! Probe, film, substrate and layers: the numbers of the Python classes as the bodies of Rust.
//!
//! Each Python object makes its native one once, when it is made itself, which is also its check.

use std::path::PathBuf;

use ::solve::stack::{Interface, Layer, Stack};
use ::solve::stick::Sticking;
use contact::magnitude::Magnitude;
use interp::{Elastic, Error, HalfSpace, Probe, System};
use numpy::PyReadonlyArray1;
use pyo3::prelude::*;
use tabulate::stack::NamedStack;

use crate::error::{OrRaise as _, unknown};

/// Young's modulus and Poisson ratio.
pub type Solid = (f64, f64);
/// A layer: its solid, its thickness, its name if it has one, and the tangential and the normal
/// stiffness of the interface below.
pub type GivenLayer = (Solid, f64, Option<String>, (f64, f64));

/// The shape of a probe.
#[pyclass(frozen, module = "coated_contact._core", name = "Probe")]
pub struct NativeProbe(Probe);

/// A probe on a film or on layers.
#[pyclass(frozen, module = "coated_contact._core", name = "Coated")]
pub struct NativeCoated {
    /// Probe, film and substrate; of layers, the system whose film is the solid that the probe touches.
    pub system: System,
    /// The layers, if there are some.
    pub named: Option<NamedStack>,
}

/// A probe on a half-space.
#[pyclass(frozen, module = "coated_contact._core", name = "HalfSpace")]
pub struct NativeHalfSpace(pub HalfSpace);

/// Layers on a base, with the names of those that have one.
#[pyclass(frozen, module = "coated_contact._core", name = "Stack")]
pub struct NativeStack(pub NamedStack);

impl NativeCoated {
    /// Returns the layers without their names, if there are some.
    pub fn stack(&self) -> Option<&Stack> {
        self.named.as_ref().map(|named| &named.stack)
    }

    /// Returns the bodies of a sphere of the Poisson ratio `nu2` that sticks.
    pub fn sticking(&self, nu2: f64) -> Result<Sticking, ::solve::Error> {
        match self.stack() {
            None => Sticking::on_film(&self.system.material()?, nu2),
            Some(stack) => Sticking::on_stack(stack, self.system.sphere_modulus, nu2),
        }
    }
}

/// Makes a solid.
fn solid((young, poisson): Solid) -> Result<Elastic, Error> {
    Elastic::new(young, poisson)
}

#[pymethods]
impl NativeProbe {
    #[new]
    fn new(py: Python<'_>, name: &str, numbers: PyReadonlyArray1<'_, f64>) -> PyResult<Self> {
        let made = Probe::of_numbers(name, numbers.as_slice()?);
        let made = made.ok_or_else(|| unknown("probe", name))?;
        let made = made.and_then(|probe| {
            // A half-space accepts a probe alone.
            let touched = HalfSpace {
                probe,
                sphere_modulus: f64::INFINITY,
                solid: Elastic::new(1.0, 0.0)?,
            };
            touched.compound_modulus()?;
            Ok(Self(touched.probe))
        });
        made.or_raise(py)
    }
}

#[pymethods]
impl NativeCoated {
    #[new]
    fn new(
        py: Python<'_>,
        probe: &Bound<'_, NativeProbe>,
        sphere_modulus: f64,
        film: Solid,
        film_thickness: f64,
        substrate: Solid,
    ) -> PyResult<Self> {
        let make = || {
            let system = System {
                probe: probe.get().0.clone(),
                sphere_modulus,
                film: solid(film)?,
                film_thickness,
                substrate: solid(substrate)?,
            };
            system.material()?;
            let named = None;
            Ok::<_, Error>(Self { system, named })
        };
        make().or_raise(py)
    }

    #[staticmethod]
    fn on_layers(
        py: Python<'_>,
        probe: &Bound<'_, NativeProbe>,
        sphere_modulus: f64,
        stack: &Bound<'_, NativeStack>,
    ) -> PyResult<Self> {
        let named = stack.get().0.clone();
        let system = System {
            probe: probe.get().0.clone(),
            // The radius is that of the probe.
            ..named.stack.system(1.0, sphere_modulus)
        };
        system.material().or_raise(py)?;
        let named = Some(named);
        Ok(Self { system, named })
    }

    /// Names what no contact has of the bodies.
    fn magnitudes(&self) -> Vec<String> {
        let System {
            probe,
            sphere_modulus,
            ..
        } = &self.system;
        texts(match &self.named {
            None => Magnitude::of_system(&self.system, 0.0),
            Some(named) => named.magnitudes(probe, *sphere_modulus, 0.0),
        })
    }
}

fn texts(found: impl IntoIterator<Item = Magnitude>) -> Vec<String> {
    found.into_iter().map(|one| one.to_string()).collect()
}

/// Names a work of adhesion that no contact has.
#[pyfunction]
pub fn magnitudes_of_work(work_of_adhesion: f64) -> Vec<String> {
    texts(Magnitude::work_of_adhesion(
        "the work of adhesion",
        work_of_adhesion,
    ))
}

#[pymethods]
impl NativeHalfSpace {
    #[new]
    fn new(
        py: Python<'_>,
        probe: &Bound<'_, NativeProbe>,
        sphere_modulus: f64,
        touched: Solid,
    ) -> PyResult<Self> {
        let make = || {
            let half_space = HalfSpace {
                probe: probe.get().0.clone(),
                sphere_modulus,
                solid: solid(touched)?,
            };
            half_space.compound_modulus()?;
            Ok::<_, Error>(Self(half_space))
        };
        make().or_raise(py)
    }

    fn compound_modulus(&self, py: Python<'_>) -> PyResult<f64> {
        let modulus = self.0.compound_modulus();
        modulus.or_raise(py)
    }

    /// Names what no contact has of the bodies.
    fn magnitudes(&self) -> Vec<String> {
        texts(Magnitude::of_half_space(&self.0, 0.0))
    }
}

#[pymethods]
impl NativeStack {
    /// Takes the base, the layers from the base up, and the solid at the surface if it is not that
    /// of the top layer.
    #[new]
    fn new(
        py: Python<'_>,
        base: Solid,
        layers: Vec<GivenLayer>,
        surface: Option<Solid>,
    ) -> PyResult<Self> {
        let make = || {
            let mut names = Vec::with_capacity(layers.len());
            let layer = |(given, thickness, name, (tangential, normal))| {
                names.push(name);
                Ok(Layer {
                    solid: solid(given)?,
                    thickness,
                    interface: Interface::Springs { tangential, normal },
                })
            };
            let layers: Result<Vec<Layer>, Error> = layers.into_iter().map(layer).collect();
            let mut stack = Stack::new(solid(base)?, layers?)?;
            if let Some(surface) = surface {
                stack = stack.with_surface(solid(surface)?)?;
            }
            Ok::<_, tabulate::Error>(Self(NamedStack { stack, names }))
        };
        make().or_raise(py)
    }

    fn thickness(&self) -> f64 {
        self.0.stack.thickness()
    }

    fn compressibility(&self) -> f64 {
        self.0.stack.compressibility()
    }
}

/// Returns the base and the layers of a stack.
pub fn parts(NamedStack { stack, names }: &NamedStack) -> (Solid, Vec<GivenLayer>) {
    let solid = |solid: Elastic| (solid.young(), solid.poisson());
    let layers = stack.layers().iter().zip(names);
    let layers = layers.map(|(layer, name)| {
        let stiffnesses = layer.interface.stiffnesses().into();
        (
            solid(layer.solid),
            layer.thickness,
            name.clone(),
            stiffnesses,
        )
    });
    (solid(stack.base()), layers.collect())
}

/// Reads a stack file, and returns the base and the layers.
#[pyfunction]
pub fn read_stack(py: Python<'_>, path: PathBuf) -> PyResult<(Solid, Vec<GivenLayer>)> {
    let named = py.detach(|| NamedStack::read(&path)).or_raise(py)?;
    Ok(parts(&named))
}

/// Accepts Young's modulus and Poisson ratio; returns the reduced modulus.
#[pyfunction]
pub fn check_elastic(py: Python<'_>, young: f64, poisson: f64) -> PyResult<f64> {
    Elastic::new(young, poisson)
        .map(|solid| solid.reduced())
        .or_raise(py)
}
