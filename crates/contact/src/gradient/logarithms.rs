//! The derivatives of the logarithms of the factors of which load and penetration are products.

use super::Input;
use interp::{HalfSpace, Normalisation, QuantityGradient, System};

/// The derivatives, with respect to one input, of the logarithms of the factors of which the terms
/// of load and penetration are products.
#[derive(Clone, Copy, Default)]
pub(super) struct LogDerivatives {
    pub(super) contact_radius: f64,
    pub(super) work_of_adhesion: f64,
    pub(super) sphere_radius: f64,
    /// That of the modulus that normalises the quantities.
    pub(super) modulus: f64,
    /// That of `es`, which is `Es*` in units of that modulus.
    pub(super) es: f64,
    /// Those of the four quantities, in the order of [`Quantity::ALL`](interp::Quantity::ALL).
    pub(super) quantities: [f64; 4],
    /// Those of the parameters of the material: `ln e1_over_e2`, `nu1`, `ln e0_over_e2` and `nu0`.
    pub(super) parameters: [f64; 4],
}

/// Returns the derivatives of a contact with a half-space. The quantities are constant, and the
/// `compound` modulus `E*` is their unit.
pub(super) fn half_space_derivatives(
    system: &HalfSpace,
    compound: f64,
    input: Input,
) -> Option<LogDerivatives> {
    let (young, nu0) = (system.solid.young(), system.solid.poisson());
    let share = compound / system.solid.reduced();
    let modulus = match input {
        Input::SphereModulus => compound / system.sphere_modulus / system.sphere_modulus,
        Input::SubstrateModulus => share / young,
        Input::SubstratePoisson => share * 2.0 * nu0 / one_minus_square(nu0),
        _ => return None,
    };
    Some(LogDerivatives {
        modulus,
        ..LogDerivatives::default()
    })
}

/// Returns the derivatives of a coated contact with respect to one elastic constant; `None` if they are
/// not known.
#[inline(always)]
pub(super) fn coated_derivatives(
    system: &System,
    gradient: &QuantityGradient,
    input: Input,
) -> Option<LogDerivatives> {
    let material = gradient.material();
    // The derivatives of `ln e1_over_e2`, `nu1`, `ln e0_over_e2`, `nu0` and the logarithm of the
    // normalising modulus with respect to the logarithm of the modulus, or to the Poisson ratio.
    let ([e1, nu1, e0, nu0], modulus) = match (input, material.normalisation()) {
        (Input::SphereModulus, Normalisation::Sphere) => ([-1.0, 0.0, -1.0, 0.0], 1.0),
        (Input::FilmModulus, Normalisation::Sphere) => ([1.0, 0.0, 0.0, 0.0], 0.0),
        (Input::FilmPoisson, Normalisation::Sphere) => ([0.0, 1.0, 0.0, 0.0], 0.0),
        (Input::FilmModulus, Normalisation::Film) => ([0.0, 0.0, -1.0, 0.0], 1.0),
        (Input::FilmPoisson, Normalisation::Film) => (
            [0.0, 1.0, 0.0, 0.0],
            2.0 * material.nu1() / one_minus_square(material.nu1()),
        ),
        (Input::SubstrateModulus, _) => ([0.0, 0.0, 1.0, 0.0], 0.0),
        (Input::SubstratePoisson, _) => ([0.0, 0.0, 0.0, 1.0], 0.0),
        // The modulus of a rigid sphere.
        _ => ([0.0; 4], 0.0),
    };
    let unit = match input {
        Input::SphereModulus => 1.0 / system.sphere_modulus,
        Input::FilmModulus => 1.0 / system.film.young(),
        Input::SubstrateModulus => 1.0 / system.substrate.young(),
        _ => 1.0,
    };
    let mut logarithms = LogDerivatives {
        modulus: unit * modulus,
        ..LogDerivatives::default()
    };
    for (parameter, factor) in [e1, nu1, e0, nu0]
        .into_iter()
        .enumerate()
        .filter(|&(_, factor)| factor != 0.0)
    {
        let derivatives = gradient.relative(parameter)?;
        logarithms.parameters[parameter] = unit * factor;
        logarithms.es += unit * factor * gradient.scale(parameter);
        logarithms
            .quantities
            .iter_mut()
            .zip(derivatives)
            .for_each(|(sum, derivative)| *sum += unit * factor * derivative);
    }
    Some(logarithms)
}

/// Returns `1 - nu^2`, without cancellation.
fn one_minus_square(nu: f64) -> f64 {
    (1.0 - nu) * (1.0 + nu)
}
