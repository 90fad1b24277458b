//! The error of the load without an effect.

use interp::{Material, Normalisation, Quantities};

use super::Effect;
use super::cohesive_zone::error_of_jkr;
use super::friction::error_without;
use super::interface::sliding;
use super::relaxation::error_of_elastic;
use super::shape::error_of_paraboloid;
use solve::Error;
use solve::solve;

/// The smallest and the largest strength of adhesion at which errors are measured.
///
/// The strength is the adhesive part of the load over the adhesionless load `F0` at the same
/// contact radius. At 0.01 adhesion is 1 % of the load. At 2 it is that of JKR's pull-off under a
/// given load; it is 1 where the load is zero.
pub const STRENGTHS: [f64; 2] = [0.01, 2.0];

/// Returns the errors of the load at one contact radius without each of some effects,
/// `|F' - F|/F0`, from direct solves to 1e-8.
///
/// `F` is the load and `F'` that without the effect. The adhesionless load `F0` never vanishes. The
/// `strength` of adhesion is the adhesive part of the load over `F0`, see [`STRENGTHS`]. Contact
/// radius, sphere and work of adhesion are those of the whole scene.
///
/// For [`Effect::Shape`], `F` and `F0` are those under the sphere itself at `a` =
/// [`A_OVER_R`](super::A_OVER_R) `R`. For [`Effect::FiniteRange`] the error is that of JKR's pull-off
/// load, relative to itself, under a sphere that pulls off at this contact radius, at Tabor's
/// parameter [`TABOR`](super::TABOR). For [`Effect::Interface`] it is that of the load of the bonded
/// film where the film slides, up to `a/t` of 1000. For [`Effect::Friction`] `F` is the
/// load of a flat punch with full friction, at the same penetration. For [`Effect::Relaxation`] it is the
/// largest one of the elastic load on approach and retract, over the load at the turn at this contact
/// radius, where all bodies relax by the power law of exponent [`EXPONENT`](super::EXPONENT).
///
/// # Errors
/// Those of the solve.
pub fn errors(
    effects: &[Effect],
    a_over_t: f64,
    material: &Material,
    strength: f64,
) -> Result<Vec<f64>, Error> {
    let truth = Load::new(a_over_t, material, film_modulus(material))?;
    let error = |&effect: &Effect| {
        match effect {
            Effect::Shape => return error_of_paraboloid(a_over_t, material, Load::TOLERANCE),
            Effect::FiniteRange => return error_of_jkr(a_over_t, material, Load::TOLERANCE),
            Effect::Friction => return error_without(a_over_t, material),
            Effect::Relaxation => return error_of_elastic(a_over_t, material),
            Effect::Interface => {
                // The film of the scene is what is left without the effect.
                let quantities = sliding(a_over_t, material, Load::TOLERANCE_OF_SLIDING)?;
                let slid = Load::of(&quantities, material, film_modulus(material));
                return Ok(truth.error_beside(slid, strength));
            }
            _ => {}
        }
        let without = truth.without(effect, a_over_t, material)?;
        Ok(without.error_beside(truth, strength))
    };
    effects.iter().map(error).collect()
}

/// The parts of the load of eq. 9 at one contact radius, `2 R F/a^3 = pressed - h adhesion` with
/// `h = 2 R (8 pi w/a^3)^{1/2}`. They are in units of a modulus that no effect changes: `E2*`, or
/// `E1` under a rigid sphere.
#[derive(Clone, Copy, Debug)]
struct Load {
    /// `U Pi0`, with the modulus `U` that normalises the quantities.
    pressed: f64,
    /// `(U es)^{1/2} Eeq/Gamma`.
    adhesion: f64,
}

impl Load {
    /// Relative tolerance of the solves, and of those of films that slide, which take longer.
    const TOLERANCE: f64 = 1e-8;
    const TOLERANCE_OF_SLIDING: f64 = 1e-5;

    fn new(a_over_t: f64, material: &Material, film_modulus: f64) -> Result<Self, Error> {
        let quantities = solve(a_over_t, material, Self::TOLERANCE)?.quantities;
        Ok(Self::of(&quantities, material, film_modulus))
    }

    /// Returns the load of the quantities of a contact.
    fn of(quantities: &Quantities, material: &Material, film_modulus: f64) -> Self {
        let unit = unit(material, film_modulus);
        Self {
            pressed: unit * quantities.pi0,
            adhesion: (unit * material.sphere_film_modulus()).sqrt() * quantities.eeq
                / quantities.gamma,
        }
    }

    /// Returns the error of this load in place of the true one, over the true one without adhesion.
    fn error_beside(self, truth: Self, strength: f64) -> f64 {
        let pressed = self.pressed / truth.pressed - 1.0;
        let adhesion = self.adhesion / truth.adhesion - 1.0;
        (pressed - strength * adhesion).abs()
    }

    /// Returns the load without an effect. `self` is the load of the material with all effects.
    fn without(self, effect: Effect, a_over_t: f64, material: &Material) -> Result<Self, Error> {
        let film_modulus = film_modulus(material);
        let of = |e1, nu1, e0| -> Result<Self, Error> {
            let other = Material::new(e1, nu1, e0, material.nu0())?;
            Self::new(a_over_t, &other, film_modulus)
        };
        let (e1, nu1, e0) = (material.e1_over_e2(), material.nu1(), material.e0_over_e2());
        match effect {
            Effect::Film => {
                let modulus = unit(material, film_modulus) * material.sphere_substrate_modulus();
                Ok(Self {
                    pressed: 8.0 / 3.0 * modulus,
                    adhesion: modulus.sqrt(),
                })
            }
            Effect::SphereCompliance => of(0.0, nu1, e0 / e1),
            Effect::SubstrateCompliance => of(e1, nu1, f64::INFINITY),
            Effect::FilmCompressibility => of(e1, 0.5, e0),
            Effect::Adhesion => Ok(Self {
                adhesion: 0.0,
                ..self
            }),
            Effect::Penetration
            | Effect::Shape
            | Effect::FiniteRange
            | Effect::Interface
            | Effect::Friction
            | Effect::Relaxation => Ok(self),
        }
    }
}

/// The film's Young's modulus in the unit of [`Load`].
const fn film_modulus(material: &Material) -> f64 {
    match material.normalisation() {
        Normalisation::Sphere => material.e1_over_e2(),
        Normalisation::Film => 1.0,
    }
}

/// The modulus that normalises a material's quantities in the unit of [`Load`], given the film's
/// Young's modulus.
fn unit(material: &Material, film_modulus: f64) -> f64 {
    match material.normalisation() {
        Normalisation::Sphere => 1.0,
        Normalisation::Film => film_modulus / ((1.0 - material.nu1()) * (1.0 + material.nu1())),
    }
}
