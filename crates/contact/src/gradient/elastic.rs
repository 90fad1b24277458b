//! Derivatives with respect to an elastic constant of a body, from those with respect to the modulus
//! that normalises the contact and to the parameters of its material.

use super::Input;
use interp::MaterialParameter::{self, E0OverE2, E1OverE2, Nu0, Nu1};
use interp::{HalfSpace, LoadAndPenetration, System};

/// Returns the derivatives of a contact with a half-space, of which the `compound` modulus `E*` is
/// the unit; `None` for an input that it does not have. `by_modulus` holds those with respect to
/// `ln E*`.
pub(super) fn of_half_space(
    system: &HalfSpace,
    compound: f64,
    input: Input,
    by_modulus: LoadAndPenetration,
) -> Option<LoadAndPenetration> {
    let (young, nu0) = (system.solid.young(), system.solid.poisson());
    let share = compound / system.solid.reduced();
    let factor = match input {
        Input::SphereModulus => compound / system.sphere_modulus / system.sphere_modulus,
        Input::SubstrateModulus => share / young,
        Input::SubstratePoisson => share * logarithmic_slope(nu0),
        _ => return None,
    };
    Some(by_modulus.times(factor))
}

/// Returns the parameters of the material whose derivatives those with respect to `inputs` need.
pub(crate) fn parameters_of(system: &System, inputs: &[Input]) -> Vec<MaterialParameter> {
    let is_asked_for = |input: Input| inputs.contains(&input);
    let rigid = system.sphere_modulus == f64::INFINITY;
    let of_sphere = !rigid && is_asked_for(Input::SphereModulus);
    let of_film = is_asked_for(Input::FilmModulus);
    let is_needed = |parameter: &MaterialParameter| match parameter {
        E1OverE2 => of_sphere || !rigid && of_film,
        Nu1 => is_asked_for(Input::FilmPoisson),
        E0OverE2 => of_sphere || rigid && of_film || is_asked_for(Input::SubstrateModulus),
        Nu0 => is_asked_for(Input::SubstratePoisson),
    };
    let all = MaterialParameter::ALL.into_iter();
    all.filter(is_needed).collect()
}

/// Returns the derivatives of a coated contact; `None` if they are not known. `by_modulus` holds those
/// with respect to the logarithm of the modulus that normalises, and `by` returns those with respect to
/// `ln e1_over_e2`, `nu1`, `ln e0_over_e2` or `nu0`.
#[inline(always)]
pub(super) fn of_coated(
    system: &System,
    input: Input,
    by_modulus: LoadAndPenetration,
    by: impl Fn(MaterialParameter) -> Option<LoadAndPenetration>,
) -> Option<LoadAndPenetration> {
    let (film, substrate) = (system.film.young(), system.substrate.young());
    let rigid = system.sphere_modulus == f64::INFINITY;
    Some(match (input, rigid) {
        (Input::SphereModulus, false) => {
            let others = by(E1OverE2)?.plus(by(E0OverE2)?);
            by_modulus.minus(others).times(1.0 / system.sphere_modulus)
        }
        (Input::FilmModulus, false) => by(E1OverE2)?.times(1.0 / film),
        (Input::FilmModulus, true) => by_modulus.minus(by(E0OverE2)?).times(1.0 / film),
        (Input::FilmPoisson, false) => by(Nu1)?,
        (Input::FilmPoisson, true) => {
            let own = by_modulus.times(logarithmic_slope(system.film.poisson()));
            own.plus(by(Nu1)?)
        }
        (Input::SubstrateModulus, _) => by(E0OverE2)?.times(1.0 / substrate),
        (Input::SubstratePoisson, _) => by(Nu0)?,
        // The modulus of a rigid sphere.
        _ => LoadAndPenetration::ZERO,
    })
}

/// Returns the derivative of `ln(1/(1 - nu^2))`, that of the reduced modulus, without cancellation.
fn logarithmic_slope(nu: f64) -> f64 {
    2.0 * nu / ((1.0 - nu) * (1.0 + nu))
}
