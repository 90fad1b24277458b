//! Probe, film, substrate and layers: the numbers of the Python classes as the bodies of Rust.
//!
//! Each Python object makes its native one once, when it is made itself, which is also its check.

use interp::{Elastic, Error, HalfSpace, Probe, Profile, System};
use numpy::PyReadonlyArray1;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use tabulate::stack::{Layer, Stack};

use crate::error::Failure;

/// Young's modulus and Poisson ratio.
pub type Solid = (f64, f64);

/// The shape of a probe.
#[pyclass(frozen, module = "coated_contact._core", name = "Probe")]
pub struct NativeProbe(Probe);

/// Probe, film and substrate.
#[pyclass(frozen, module = "coated_contact._core", name = "System")]
pub struct NativeSystem(pub System);

/// A probe on a half-space.
#[pyclass(frozen, module = "coated_contact._core", name = "HalfSpace")]
pub struct NativeHalfSpace(pub HalfSpace);

/// Layers on a base.
#[pyclass(frozen, module = "coated_contact._core", name = "Stack")]
pub struct NativeStack(pub Stack);

/// A probe on a stack, with the system whose film is the solid that the probe touches.
#[pyclass(frozen, module = "coated_contact._core", name = "StackSystem")]
pub struct NativeStackSystem {
    pub stack: Stack,
    pub system: System,
}

/// Makes a solid.
fn solid((young, poisson): Solid) -> Result<Elastic, Error> {
    Elastic::new(young, poisson)
}

/// Makes the shape of a name from the numbers of its Python class, in the order of their
/// attributes. Those of a profile are radius and height in turn.
fn probe(name: &str, numbers: &[f64]) -> PyResult<Result<Probe, Error>> {
    Ok(Ok(match (name, numbers) {
        ("paraboloid", &[radius]) => Probe::Paraboloid { radius },
        ("sphere", &[radius]) => Probe::Sphere { radius },
        ("power law", &[coefficient, exponent]) => Probe::PowerLaw {
            coefficient,
            exponent,
        },
        ("cone", &[half_angle]) => Probe::Cone { half_angle },
        ("rounded cone", &[radius, half_angle]) => Probe::RoundedCone { radius, half_angle },
        ("flat punch", &[radius]) => Probe::FlatPunch { radius },
        ("flat-ended cone", &[radius, half_angle]) => Probe::FlatEndedCone { radius, half_angle },
        ("profile", numbers) => {
            let (points, _) = numbers.as_chunks();
            return Ok(Profile::new(points).map(Probe::Profile));
        }
        _ => return Err(PyValueError::new_err(format!("{name:?} is not a probe"))),
    }))
}

#[pymethods]
impl NativeProbe {
    #[new]
    fn new(py: Python<'_>, name: &str, numbers: PyReadonlyArray1<'_, f64>) -> PyResult<Self> {
        let made = probe(name, numbers.as_slice()?)?.and_then(|probe| {
            // A half-space accepts a probe alone.
            let touched = HalfSpace {
                probe,
                sphere_modulus: f64::INFINITY,
                solid: Elastic::new(1.0, 0.0)?,
            };
            touched.compound_modulus()?;
            Ok(Self(touched.probe))
        });
        made.map_err(|error| Failure::from(error).raise(py))
    }
}

#[pymethods]
impl NativeSystem {
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
            Ok::<_, Error>(Self(system))
        };
        make().map_err(|error| Failure::from(error).raise(py))
    }
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
        make().map_err(|error| Failure::from(error).raise(py))
    }

    fn compound_modulus(&self, py: Python<'_>) -> PyResult<f64> {
        let modulus = self.0.compound_modulus();
        modulus.map_err(|error| Failure::from(error).raise(py))
    }
}

#[pymethods]
impl NativeStack {
    /// Takes the base, the layers from the base up, each with its thickness, and the solid at the
    /// surface if it is not that of the top layer.
    #[new]
    fn new(
        py: Python<'_>,
        base: Solid,
        layers: Vec<(Solid, f64)>,
        surface: Option<Solid>,
    ) -> PyResult<Self> {
        let make = || {
            let layer = |(layer, thickness)| {
                Ok(Layer {
                    solid: solid(layer)?,
                    thickness,
                })
            };
            let layers: Result<Vec<Layer>, Error> = layers.into_iter().map(layer).collect();
            let stack = Stack::new(solid(base)?, layers?)?;
            match surface {
                Some(surface) => stack.with_surface(solid(surface)?),
                None => Ok(stack),
            }
        };
        make()
            .map(Self)
            .map_err(|error: tabulate::Error| Failure::from(error).raise(py))
    }

    fn thickness(&self) -> f64 {
        self.0.thickness()
    }

    fn compressibility(&self) -> f64 {
        self.0.compressibility()
    }
}

#[pymethods]
impl NativeStackSystem {
    #[new]
    fn new(
        py: Python<'_>,
        probe: &Bound<'_, NativeProbe>,
        sphere_modulus: f64,
        stack: &Bound<'_, NativeStack>,
    ) -> PyResult<Self> {
        let stack = stack.get().0.clone();
        let system = System {
            probe: probe.get().0.clone(),
            // The radius is that of the probe.
            ..stack.system(1.0, sphere_modulus)
        };
        match system.material() {
            Ok(_) => Ok(Self { stack, system }),
            Err(error) => Err(Failure::from(error).raise(py)),
        }
    }
}

/// Accepts Young's modulus and Poisson ratio; returns the reduced modulus.
#[pyfunction]
pub fn check_elastic(py: Python<'_>, young: f64, poisson: f64) -> PyResult<f64> {
    Elastic::new(young, poisson)
        .map(|solid| solid.reduced())
        .map_err(|error| Failure::from(error).raise(py))
}
