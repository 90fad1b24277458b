//! Stacks of layers on an elastic or rigid base.
//!
//! Layers are counted from the base up: layer 1 is on the base, and the last one is what the sphere
//! touches. Each layer is bonded to what lies below it, slides on it, or is joined to it by springs:
//! its [`Interface`]. `a/t` of a stack is the contact radius over the sum of all thicknesses.
//!
//! ```
//! # fn main() -> Result<(), solve::Error> {
//! use interp::Elastic;
//! use contact::Contact;
//! use solve::stack::{Interface, Layer, Stack};
//!
//! let primer = Layer::bonded(Elastic::new(0.5e6, 0.5)?, 2.5e-6);
//! let elastomer = Layer::bonded(Elastic::new(3.5e6, 0.5)?, 7.5e-6);
//! let stack = Stack::new(Elastic::new(2e11, 0.25)?, [primer, elastomer])?;
//!
//! // Sphere of reduced modulus 2 MPa; a/t of 6.5; relative tolerance 1e-8.
//! let solution = solve::solve_stack(6.5, &stack, 2e6, 1e-8)?;
//! assert!(solution.error <= 1e-8);
//!
//! // The curve from a/t of 0.1 to 10, and a contact of a sphere of 1 mm: 65 um, 0.04 J/m^2.
//! let curve = solve::stack_curve(&stack, 2e6, [0.1, 10.0], 1e-8)?;
//! let contact = Contact::new(&stack.system(1e-3, 2e6), curve)?;
//! println!("{:.3e} N", contact.load(65e-6, 0.04)?);
//!
//! // The elastomer alone, on a lubricant: it slides on the base.
//! let sliding = Layer { interface: Interface::Sliding, ..elastomer };
//! let film = Stack::new(Elastic::new(2e11, 0.25)?, [sliding])?;
//! let softer = solve::solve_stack(6.5, &film, 2e6, 1e-8)?;
//! assert!(softer.quantities.eeq < solution.quantities.eeq);
//! # Ok(()) }
//! ```
//!
//! # What changes, and what does not
//!
//! The layers enter through the surface compliance `X(kt)` alone (the page `layered.rs` of the source
//! derives it). With `X` relative to the top layer, Barthel's equations hold as they
//! stand, and so do the definitions of the four quantities. `E1*` is the reduced modulus of the top
//! layer and `E0*` that of the base:
//!
//! ```text
//! es = 1/(1 + E2*/E1*)    crack tip, and a/t -> 0          einf = 1/(1 + E2*/E0*)    a/t -> inf
//! ```
//!
//! Under a rigid sphere the unit of the quantities is `E1*` of the top layer.
//!
//! # What a contact answers
//!
//! [`contact::Contact`] answers for a stack all that it answers for a film: loads, equilibria,
//! pull-off, energy release rates, crack-tip laws, JKR fits. `film_bias` is relative to the bare
//! base. Three answers differ. A curve of a stack has no expansions beyond its ends and no
//! derivatives with respect to the material: both are errors. The compressibility of `validity` is
//! that of all layers ([`Stack::compressibility`]), and NaN where an interface is not bonded.
//! `cohesive_zone` and `pull_off_error` demand that the zone of attraction be short beside the *top
//! layer*, whose modulus it is computed with.
//!
//! # Reach
//!
//! Stacks are solved by Galerkin's method, whose cost grows with the contact radius over the
//! thickness of the *top* layer, `a/h`. It goes up to [`MOST_A_OVER_TOP`]. The method that serves
//! thinner films needs to know where the zeros and poles of the compliance lie. For one film they
//! are at least 53 degrees away from the real axis; for stacks, where they were found at 27
//! degrees, no bound is known, and a larger `a/h` is refused. A stack that is in fact a single film
//! (all layers of one material, or the lower ones of that of the base, bonded to each other) is
//! solved as a film, without this limit.
//!
//! Measured (`tests/truth/stacks.rs`, 15 contacts up to `a/h` of 160, values by another program):
//! the errors of the quantities are at most 8e-15 at the tolerance 1e-12 and 3.4e-11 at 1e-8. With
//! interfaces that slide or have springs (`tests/truth/interfaces.rs`, 33 contacts up to `a/h` of
//! 200) they are 2.4e-14 and 2.6e-11, and 300 random contacts agree with another method of solution
//! within the stated errors.
//!
//! `cargo bench -p coated-contact-tabulate --bench stacks` prints times, here at the tolerance 1e-8 and on one
//! core. Three layers take 8 to 19 microseconds up to `a/h` of 10, which is 1.5 to 1.9 times the
//! time of one film, and 60 microseconds at `a/h` of 30, where one film takes 13 by the other
//! method. A curve of 200 layers up to `a/h` of 200 takes 9 ms: the compliance of many layers is
//! sampled once. A curve of one film that slides takes 1 ms from `a/t` of 0.01 to 10, and 8 ms from
//! 0.1 to 100. In the sweep of a table, a further sphere takes a seventh of the time of the first
//! one at `a/h` of 9, because the spheres share matrices.

mod interface;

use interp::{Elastic, Material, Probe, StackShape, System};

pub use self::interface::Interface;
use crate::Error;

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
    /// sublayers at most 6.1e-4, 4.1e-4 and 6.4e-5 at `a/t` of 0.3, 1 and 5.
    ///
    /// # Errors
    /// As [`Stack::new`].
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
        StackShape {
            compressibility: self.compressibility(),
            top: self.merged().top().thickness / self.thickness(),
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
         larger must be at most {LARGEST_CONTRAST:e} times the smaller: bring them closer"
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
        let refused = |base: f64, layers: &[Layer]| {
            Stack::new(solid(base), layers)
                .expect_err("refused")
                .to_string()
        };
        let no_layers: [Layer; 0] = [];
        let cases = [
            (refused(1.0, &no_layers), ["at least one layer", ""]),
            (
                refused(1.0, &[layer(1.0, 1.0), layer(1.0, 0.0)]),
                ["layer 2 of 2", "thickness is 0.0 m, but must be > 0"],
            ),
            (
                refused(1.0, &[layer(1.0, f64::NAN)]),
                ["layer 1 of 1", "NaN"],
            ),
            (
                refused(1.0, &[layer(1.0, 1e308), layer(2.0, 1e308)]),
                ["layer 2 of 2", "overflows"],
            ),
            (
                refused(1.0, &[layer(f64::INFINITY, 1.0), layer(1.0, 1.0)]),
                ["layer 1 of 2", "give it as the base"],
            ),
            (
                refused(1.0, &[layer(1.0, 1.0), layer(1.01e9, 1.0)]),
                ["layer 2 of 2", "at most 1e9 times"],
            ),
            (
                refused(1.01e9, &[layer(1.0, 1.0)]),
                ["layer 1 of 1", "take the base as rigid"],
            ),
        ];
        for (message, parts) in cases {
            for part in parts {
                assert!(message.contains(part), "{message:?} lacks {part:?}");
            }
        }
        // One step inside the allowed contrast, and a rigid base beside any layer.
        stack(1.0, &[layer(1.0, 1.0), layer(0.99e9, 1.0)]);
        stack(f64::INFINITY, &[layer(1e-3, 1.0)]);
    }
}
