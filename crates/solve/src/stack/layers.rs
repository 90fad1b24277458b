//! The layers, what a stack may be, and what a contact needs to know of it.

use interp::{Curve, Elastic, Material, Probe, StackShape, System, Table};

use super::interface::Interface;
use crate::Error;
use crate::domain::A_OVER_T;

/// The largest contact radius over the thickness of the top layer for which a stack is solved.
/// Neighbouring layers of one material count as one.
pub const MOST_A_OVER_TOP: f64 = 1000.0;

/// The largest ratio of the Young's moduli of two bodies of a stack, a rigid base left aside.
pub const LARGEST_CONTRAST: f64 = 1e9;

/// The smallest normal stiffness of an interface over Young's modulus of the stiffest layer, times
/// the thickness of all layers.
pub const SOFTEST_SPRINGS: f64 = 1e-12;

/// One layer of a stack.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Layer {
    /// The solid.
    pub solid: Elastic,
    /// The thickness, m.
    pub thickness: f64,
    /// What joins it to the layer below, or to the base.
    pub interface: Interface,
}

impl Layer {
    /// Returns a layer of a `solid` and a `thickness` (m), bonded to what lies below it.
    pub const fn bonded(solid: Elastic, thickness: f64) -> Self {
        Self {
            solid,
            thickness,
            interface: Interface::Bonded,
        }
    }
}

/// Layers on a base.
#[derive(Clone, Debug, PartialEq)]
pub struct Stack {
    base: Elastic,
    layers: Vec<Layer>,
    surface: Elastic,
}

impl Stack {
    /// Puts `layers`, from the base up, on a `base`. A base with an infinite Young's modulus is
    /// rigid.
    ///
    /// # Errors
    /// [`Error::NoLayers`] without a layer; [`Error::Layer`] for a thickness that is not positive
    /// and finite, a rigid layer, a Young's modulus more than [`LARGEST_CONTRAST`] times that of
    /// another body, a stiffness of an interface that is negative or NaN, or a normal stiffness
    /// that is 0 or too small ([`SOFTEST_SPRINGS`]).
    pub fn new(base: Elastic, layers: impl Into<Vec<Layer>>) -> Result<Self, Error> {
        let mut layers: Vec<Layer> = layers.into();
        for layer in &mut layers {
            layer.interface = layer.interface.plain();
        }
        let top = layers.last().ok_or(Error::NoLayers)?;
        let surface = top.solid;
        let stack = Self {
            base,
            layers,
            surface,
        };
        stack.check()?;
        Ok(stack)
    }

    /// Makes a stack of one layer: the film of a `system` on its substrate, with an `interface` between
    /// them. The probe does not matter.
    ///
    /// # Errors
    /// As [`Stack::new`].
    pub fn of_film(system: &System, interface: Interface) -> Result<Self, Error> {
        let film = Layer {
            solid: system.film,
            thickness: system.film_thickness,
            interface,
        };
        Self::new(system.substrate, [film])
    }

    /// Makes a film of a given `thickness` (m) whose material changes with the height above the
    /// `base`: `count` sublayers of equal thickness, each of the solid at its middle height (m).
    ///
    /// At the surface the sphere touches `solid(thickness)`: this solid sets the modulus of the
    /// crack tip, `es`, and the unit of the quantities under a rigid sphere. `Gamma` of the
    /// sublayers, which is proportional to the root of their own `es`, is multiplied with the root
    /// of the ratio.
    ///
    /// The error falls with the square of the number of sublayers. Measured for an exponential
    /// gradient of 20:1 on a base like its lower face (`tests/truth/stack_limits.rs`): with 40
    /// sublayers at most 2.6e-3, 1.1e-3 and 3.3e-4 at `a/t` of 0.3, 1 and 5 for Poisson ratios from 0 to
    /// 0.5, and a quarter of that where the film is incompressible.
    ///
    /// # Errors
    /// As [`Stack::new`].
    ///
    /// # Panics
    /// If the sublayers do not fit into the memory.
    pub fn graded(
        base: Elastic,
        thickness: f64,
        count: usize,
        solid: impl Fn(f64) -> Elastic,
    ) -> Result<Self, Error> {
        let layer = |i: usize| {
            let middle = thickness * ((i as f64 + 0.5) / count as f64);
            Layer::bonded(solid(middle), thickness / count as f64)
        };
        Self::new(base, (0..count).map(layer).collect::<Vec<_>>())?.with_surface(solid(thickness))
    }

    /// Returns this stack with another solid at its surface than that of the top layer, as
    /// [`Stack::graded`] makes it: the top layer is the highest sublayer of a graded film, and
    /// `surface` what the sphere touches.
    ///
    /// # Errors
    /// [`Error::Layer`] for a rigid solid.
    pub fn with_surface(self, surface: Elastic) -> Result<Self, Error> {
        if surface.young() == f64::INFINITY {
            return Err(self.rigid(self.layers.len()));
        }
        Ok(Self { surface, ..self })
    }

    /// Returns the base.
    pub const fn base(&self) -> Elastic {
        self.base
    }

    /// Returns the layers, from the base up.
    pub fn layers(&self) -> &[Layer] {
        &self.layers
    }

    /// Returns the sum of all thicknesses, m.
    pub fn thickness(&self) -> f64 {
        self.layers.iter().map(|layer| layer.thickness).sum()
    }

    /// Returns the solid that the sphere touches: that of the top layer, of a graded film that at
    /// its surface.
    pub const fn surface(&self) -> Elastic {
        self.surface
    }

    /// Returns the sphere on this stack as a system: its film is the solid that the sphere touches
    /// with the thickness of the whole stack, its substrate is the base.
    ///
    /// `es`, `einf` and `a/t` of this system are those of the stack. [`Contact::new`] takes it
    /// together with the curve of the stack, and any other curve is of another contact.
    ///
    /// [`Contact::new`]: contact::Contact::new
    pub fn system(&self, sphere_radius: f64, sphere_modulus: f64) -> System {
        System {
            probe: Probe::Paraboloid {
                radius: sphere_radius,
            },
            sphere_modulus,
            film: self.surface,
            film_thickness: self.thickness(),
            substrate: self.base,
        }
    }

    /// Looks up the curve of this stack under a sphere of reduced modulus `sphere_modulus` (Pa;
    /// infinity is rigid) in a table of this stack.
    ///
    /// Whether the table is of these layers is not checked: a table knows its reach, not its layers.
    /// `tabulate::table::stack_of` reads the stack of a table from its scene.
    ///
    /// # Errors
    /// Those of [`Stack::material`] and [`Table::stack_curve`].
    pub fn curve_in(&self, table: &Table, sphere_modulus: f64) -> Result<Curve, Error> {
        let e1_over_e2 = self.material(sphere_modulus)?.e1_over_e2();
        Ok(table.stack_curve(e1_over_e2, self.shape())?)
    }

    /// Returns the material of the solid that the sphere touches and the base, under a sphere of
    /// reduced modulus `sphere_modulus` (Pa; infinity is rigid).
    ///
    /// # Errors
    /// As [`System::material`].
    pub fn material(&self, sphere_modulus: f64) -> Result<Material, Error> {
        Ok(self.system(1.0, sphere_modulus).material()?)
    }

    /// Returns the compressibility of the layers in a wide contact, over `(a/t)^2`, which is
    /// [`FilmValidity::compressibility`](contact::FilmValidity::compressibility) for a stack.
    ///
    /// It compares two stiffnesses under a flat frictionless punch of radius `a`, on a rigid base.
    /// Layers that cannot move sideways are springs in series, and layers that keep their volume
    /// flow sideways. With `b = (1 - 2 nu)/(2 (1 - nu))` and the depth-weighted shear compliance
    /// `I` of all layers, the stiffnesses are `pi a^2 / sum(h b/G)` and `pi a^4/(16 I)`, and
    ///
    /// ```text
    /// compressibility = a^2 sum(h b/G)/(16 I)        I = int_0^t int_0^z int_0^y dx/G(x) dy dz
    /// ```
    ///
    /// (`I`: lubrication theory, with shear stress that grows with depth from the frictionless
    /// top). It is `3/16 (1 - 2 nu)/(1 - nu)` for one film, however it is cut into layers. It is NaN
    /// where an interface is not bonded: such layers yield sideways without being confined.
    pub fn compressibility(&self) -> f64 {
        if !self.is_bonded() {
            return f64::NAN;
        }
        let t = self.thickness();
        let (mut series, mut once, mut twice, mut thrice) = (0.0, 0.0, 0.0, 0.0);
        for Layer {
            solid, thickness, ..
        } in &self.layers
        {
            let (h, nu) = (thickness / t, solid.poisson());
            // In units of that of the surface, so that nothing overflows.
            let compliance = (1.0 + nu) * (self.surface.young() / solid.young());
            series += h * compliance * (1.0 - 2.0 * nu) / (2.0 * (1.0 - nu));
            thrice += h * (twice + h * (0.5 * once + h * compliance / 6.0));
            twice += h * (once + 0.5 * h * compliance);
            once += h * compliance;
        }
        series / (16.0 * thrice)
    }

    /// Returns what a contact needs to know of this stack beside its curve.
    pub fn shape(&self) -> StackShape {
        let springs = self
            .layers
            .iter()
            .map(|layer| layer.interface.stiffnesses()[1]);
        StackShape {
            compressibility: self.compressibility(),
            top: self.merged().top().thickness / self.thickness(),
            opening: springs.map(f64::recip).sum::<f64>() / self.thickness(),
        }
    }

    /// Returns the top layer.
    pub fn top(&self) -> &Layer {
        self.layers.last().expect("a stack has a layer")
    }

    /// Tells whether all interfaces are bonded.
    pub fn is_bonded(&self) -> bool {
        self.layers.iter().all(|layer| layer.interface.is_bonded())
    }

    /// Tells whether there is a single layer, bonded to the base: a film.
    pub(crate) fn is_film(&self) -> bool {
        self.layers.len() == 1 && self.is_bonded()
    }

    /// Returns the `a/t`, with the thickness of all layers, of a contact of `a_over_top` times the thickness of the top
    /// layer. Neighbours of one material are one layer, and of layers that are one film in all it is the largest `a/t`
    /// of a film.
    pub fn reach(&self, a_over_top: f64) -> f64 {
        let merged = self.merged();
        merged.most(a_over_top) / (self.thickness() / merged.top().thickness)
    }

    /// Returns `a_over_top`, but of a film the largest `a/t` of films, which are solved by other methods.
    pub(crate) fn most(&self, a_over_top: f64) -> f64 {
        if self.is_film() {
            A_OVER_T[1]
        } else {
            a_over_top
        }
    }

    /// Returns the same body with as few layers as possible: neighbours of one material that are
    /// bonded are one layer, and the lowest layers belong to the base if they are of its material
    /// and bonded to it.
    pub(crate) fn merged(&self) -> Self {
        let mut layers: Vec<Layer> = Vec::with_capacity(self.layers.len());
        for layer in &self.layers {
            match layers.last_mut() {
                _ if !layer.interface.is_bonded() => layers.push(*layer),
                Some(below) if below.solid == layer.solid => below.thickness += layer.thickness,
                None if self.base == layer.solid => {}
                _ => layers.push(*layer),
            }
        }
        if layers.is_empty() {
            layers.push(*self.top());
        }
        Self {
            layers,
            ..self.clone()
        }
    }

    /// Returns this stack with the solid of its top layer at its surface.
    pub(crate) fn of_top_layer(self) -> Self {
        let surface = self.top().solid;
        Self { surface, ..self }
    }

    /// Accepts layers that the solver can take.
    fn check(&self) -> Result<(), Error> {
        for (i, layer) in self.layers.iter().enumerate() {
            let Layer {
                solid, thickness, ..
            } = layer;
            if !(*thickness > 0.0 && thickness.is_finite()) {
                let what = format!("its thickness is {thickness:?} m, but must be > 0 and finite");
                return Err(self.fault(i + 1, what));
            }
            if solid.young() == f64::INFINITY {
                return Err(self.rigid(i + 1));
            }
        }
        if !self.thickness().is_finite() {
            let what = "the sum of all thicknesses overflows an f64: give them in m".into();
            return Err(self.fault(self.layers.len(), what));
        }
        let base = self.base.young();
        let young = |i: usize| self.layers[i].solid.young();
        let softest = (0..self.layers.len())
            .map(young)
            .chain([base])
            .fold(f64::INFINITY, f64::min);
        for i in 0..self.layers.len() {
            if young(i) / softest > LARGEST_CONTRAST {
                return Err(self.fault(i + 1, contrast(young(i), softest)));
            }
            if base < f64::INFINITY && base / young(i) > LARGEST_CONTRAST {
                let what = format!(
                    "{}; or take the base as rigid (inf), which it is beside this layer",
                    contrast(young(i), base)
                );
                return Err(self.fault(i + 1, what));
            }
        }
        let stiffest = (0..self.layers.len()).map(young).fold(0.0, f64::max);
        let least = SOFTEST_SPRINGS * stiffest / self.thickness();
        for (i, layer) in self.layers.iter().enumerate() {
            let check = layer.interface.check(least);
            check.map_err(|what| self.fault(i + 1, what))?;
        }
        Ok(())
    }

    /// The error of a rigid layer.
    fn rigid(&self, layer: usize) -> Error {
        let what = "its Young's modulus is inf, but must be finite: a rigid layer is the base of what \
                    lies above it, so give it as the base and leave out what lies below";
        self.fault(layer, what.into())
    }

    /// The error of one layer.
    fn fault(&self, layer: usize, what: String) -> Error {
        Error::Layer {
            layer,
            layers: self.layers.len(),
            what,
        }
    }
}

/// Says that two Young's moduli (Pa) are too far apart.
fn contrast(young: f64, other: f64) -> String {
    format!(
        "its Young's modulus is {young:?} Pa and another body of the stack has {other:?} Pa, but the \
         larger must be at most {LARGEST_CONTRAST:e} times the smaller: check the units of both, or bring them closer"
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn solid(young: f64) -> Elastic {
        Elastic::new(young, 0.3).expect("physical")
    }

    fn layer(young: f64, thickness: f64) -> Layer {
        Layer::bonded(solid(young), thickness)
    }

    fn stack(base: f64, layers: &[Layer]) -> Stack {
        Stack::new(solid(base), layers).expect("physical")
    }

    #[test]
    fn equal_neighbours_are_one_layer() {
        let cut = stack(2.0, &[layer(1.0, 0.5), layer(1.0, 0.25), layer(3.0, 1.0)]);
        assert_eq!(cut.merged().layers(), [layer(1.0, 0.75), layer(3.0, 1.0)]);
        assert_eq!(cut.merged().thickness(), cut.thickness());
    }

    #[test]
    fn the_lowest_layers_may_belong_to_the_base() {
        let sunk = stack(2.0, &[layer(2.0, 0.5), layer(2.0, 0.5), layer(3.0, 1.0)]);
        assert_eq!(sunk.merged().layers(), [layer(3.0, 1.0)]);
        let homogeneous = stack(2.0, &[layer(2.0, 0.5), layer(2.0, 0.25)]);
        assert_eq!(homogeneous.merged().layers(), [layer(2.0, 0.25)]);
        let returning = stack(2.0, &[layer(3.0, 0.5), layer(2.0, 0.25)]);
        assert_eq!(returning.merged(), returning);
    }

    #[test]
    fn a_wrong_layer_is_named() {
        let of = |base: f64, layers: &[[f64; 2]]| {
            let layers: Vec<Layer> = layers.iter().map(|&[e, t]| layer(e, t)).collect();
            Stack::new(solid(base), layers)
                .expect_err("refused")
                .to_string()
        };
        let inf = f64::INFINITY;
        for (message, words) in [
            (of(1.0, &[]), "at least one layer"),
            (
                of(1.0, &[[1.0, 1.0], [1.0, 0.0]]),
                "layer 2 of 2; thickness is 0.0 m, but must be > 0",
            ),
            (of(1.0, &[[1.0, f64::NAN]]), "layer 1 of 1; NaN"),
            (
                of(1.0, &[[1.0, 1e308], [2.0, 1e308]]),
                "layer 2 of 2; overflows",
            ),
            (
                of(1.0, &[[inf, 1.0], [1.0, 1.0]]),
                "layer 1 of 2; give it as the base",
            ),
            (
                of(1.0, &[[1.0, 1.0], [1.01e9, 1.0]]),
                "layer 2 of 2; at most 1e9 times",
            ),
            (
                of(1.01e9, &[[1.0, 1.0]]),
                "layer 1 of 1; take the base as rigid",
            ),
        ] {
            for word in words.split("; ") {
                assert!(message.contains(word), "{message:?} lacks {word:?}");
            }
        }
        // One step inside the allowed contrast, and a rigid base beside any layer.
        stack(1.0, &[layer(1.0, 1.0), layer(0.99e9, 1.0)]);
        stack(f64::INFINITY, &[layer(1e-3, 1.0)]);
    }
}
