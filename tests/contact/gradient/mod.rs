//! Derivatives of the quantities, of load and penetration, against differences of direct solves and
//! of the interpolant.

mod load;
mod quantities;
mod wanted;

use acceptance::solid;
use contact::Input;
use interp::{Elastic, Probe, System};

/// The largest error of a derivative of the logarithm of a quantity, in tolerances of the table, in
/// the order `a/t`, `E1`, `nu1`, `E0`, `nu0`. The derivatives are with respect to the logarithm of
/// `a/t` or of a modulus, or to a Poisson ratio. The unit of `nu1` is the range on which the
/// quantities change, `(1 - 2 nu1) + 1/(1 + (a/t)^2)`.
const SHARES: [f64; 5] = [20.0, 20.0, 100.0, 20.0, 20.0];

/// Returns an input of a system; 0 of the radius of a probe that has none, and of what is no part of a system.
pub fn value(system: &System, input: Input) -> f64 {
    match input {
        Input::SphereRadius => system.probe.radius().unwrap_or(0.0),
        Input::SphereModulus => system.sphere_modulus,
        Input::FilmThickness => system.film_thickness,
        Input::FilmModulus => system.film.young(),
        Input::FilmPoisson => system.film.poisson(),
        Input::SubstrateModulus => system.substrate.young(),
        Input::SubstratePoisson => system.substrate.poisson(),
        Input::ContactRadius | Input::WorkOfAdhesion => 0.0,
    }
}

/// Returns a system with another `value` of one of its inputs.
pub fn with(system: &System, input: Input, value: f64) -> System {
    let mut system = system.clone();
    let moduli = |body: Elastic| solid(value, body.poisson());
    let ratios = |body: Elastic| solid(body.young(), value);
    match input {
        Input::SphereRadius => match &mut system.probe {
            Probe::Paraboloid { radius }
            | Probe::Sphere { radius }
            | Probe::RoundedCone { radius, .. }
            | Probe::FlatPunch { radius }
            | Probe::FlatEndedCone { radius, .. } => *radius = value,
            other => panic!("{other:?} has no radius"),
        },
        Input::SphereModulus => system.sphere_modulus = value,
        Input::FilmThickness => system.film_thickness = value,
        Input::FilmModulus => system.film = moduli(system.film),
        Input::FilmPoisson => system.film = ratios(system.film),
        Input::SubstrateModulus => system.substrate = moduli(system.substrate),
        Input::SubstratePoisson => system.substrate = ratios(system.substrate),
        Input::ContactRadius | Input::WorkOfAdhesion => {}
    }
    system
}
