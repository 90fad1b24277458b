//! The error of the load without an effect.

use interp::{Material, Normalisation};

use super::Effect;
use super::cohesive_zone::error_of_jkr;
use super::friction::error_without;
use super::interface::sliding;
use super::relaxation::error_of_elastic;
use super::shape::error_of_paraboloid;
use crate::load::Load;
use solve::{Error, solve};

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
    /// Relative tolerance of the solves, and of those of films that slide, which take longer.
    const TOLERANCE: f64 = 1e-8;
    const OF_SLIDING: f64 = 1e-5;
    let film = film_modulus(material);
    let load = |of: &Material| -> Result<Load, Error> {
        let quantities = solve(a_over_t, of, TOLERANCE)?.quantities;
        Ok(Load::new(&quantities, of, unit(of, film)))
    };
    let of = |e1, nu1, e0| load(&Material::new(e1, nu1, e0, material.nu0())?);
    let truth = load(material)?;
    let (e1, nu1, e0) = (material.e1_over_e2(), material.nu1(), material.e0_over_e2());
    let error = |&effect: &Effect| {
        let without = match effect {
            Effect::Shape => return error_of_paraboloid(a_over_t, material, TOLERANCE),
            Effect::FiniteRange => return error_of_jkr(a_over_t, material, TOLERANCE),
            Effect::Friction => return error_without(a_over_t, material),
            Effect::Relaxation => return error_of_elastic(a_over_t, material),
            Effect::Interface => {
                // The film of the scene is what is left without the effect.
                let quantities = sliding(a_over_t, material, OF_SLIDING)?;
                let slid = Load::new(&quantities, material, unit(material, film));
                return Ok(error_beside(truth, slid, strength));
            }
            Effect::Film => {
                Load::of_half_space(unit(material, film) * material.sphere_substrate_modulus())
            }
            Effect::SphereCompliance => of(0.0, nu1, e0 / e1)?,
            Effect::SubstrateCompliance => of(e1, nu1, f64::INFINITY)?,
            Effect::FilmCompressibility => of(e1, 0.5, e0)?,
            Effect::Adhesion => Load { pull: 0.0, ..truth },
            Effect::Penetration => truth,
        };
        Ok(error_beside(without, truth, strength))
    };
    effects.iter().map(error).collect()
}

/// Returns the error of a load in place of the true one, over the true one without adhesion. Both are in units of a
/// modulus that no effect changes: `E2*`, or `E1` under a rigid sphere.
fn error_beside(load: Load, truth: Load, strength: f64) -> f64 {
    let [press, pull] = [load.press / truth.press, load.pull / truth.pull];
    (press - 1.0 - strength * (pull - 1.0)).abs()
}

/// The film's Young's modulus in the unit of loads.
const fn film_modulus(material: &Material) -> f64 {
    match material.normalisation() {
        Normalisation::Sphere => material.e1_over_e2(),
        Normalisation::Film => 1.0,
    }
}

/// The modulus that normalises a material's quantities in the unit of loads, given the film's
/// Young's modulus.
fn unit(material: &Material, film_modulus: f64) -> f64 {
    match material.normalisation() {
        Normalisation::Sphere => 1.0,
        Normalisation::Film => film_modulus / ((1.0 - material.nu1()) * (1.0 + material.nu1())),
    }
}
