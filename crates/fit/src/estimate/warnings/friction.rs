//! What friction may change: the model without friction, or with full friction, is one end of all
//! laws of friction.

use contact::Contact;
use solve::stick::Sticking;

use crate::{Bodies, Estimate, Experiment, Kind, Parameter, Warning, WarningKind};

/// The relative tolerance of the two punches.
const TOLERANCE: f64 = 1e-6;

/// The part of other bodies in the compliance, up to which the film alone counts as deforming.
const SMALL: f64 = 0.01;

/// The Poisson ratio of a sphere of which none is known.
const USUAL_POISSON_RATIO: f64 = 0.5;

/// Warns where full friction changes the modulus by more than its standard error. `a` is the largest
/// contact radius, m.
///
/// A flat punch has no smaller stiffness with friction than without, and a sphere that is pressed on gains
/// less: where contact radii are known and nothing but the film deforms, the moduli at both ends are
/// bounds. At a given penetration or load friction changes the contact radius, too, and the load more than
/// that of a punch; and where other bodies deform, the film has a part of the compliance only.
pub(crate) fn doubt(
    experiment: &Experiment,
    contact: &Contact,
    a: f64,
    estimates: &[Estimate],
) -> Option<Warning> {
    let (name, bodies) = (&experiment.measurement.name, &experiment.bodies);
    let of_top = bodies.modulus_of_top();
    let modulus = estimates.iter().find(|one| one.parameter == of_top)?;
    let nu2 = experiment
        .sphere_poisson_ratio
        .unwrap_or(USUAL_POISSON_RATIO);
    let (ratio, is_uncoupled) = stiffening(bodies, nu2, a)?;
    let sticks = contact.curve().is_some_and(|curve| curve.stick().is_some());
    let other = if sticks {
        modulus.value * ratio
    } else {
        modulus.value / ratio
    };
    // The standard error may be none.
    let matters = (other - modulus.value).abs() > modulus.standard_error;
    if !matters {
        return None;
    }
    let [stick, slide] = if sticks {
        [modulus.value, other]
    } else {
        [other, modulus.value]
    };
    let parameter = modulus.parameter;
    let kind = experiment.measurement.kind;
    let is_punch = bodies.probe.is_flat_punch();
    let has_radii = is_punch || kind == Kind::LoadRadius || !experiment.has_shape(false);
    let is_found = |parameter| estimates.iter().any(|one| one.parameter == parameter);
    let bounds = if !has_radii || is_found(Parameter::Hardness) {
        format!(
            "at a given {} it also changes the contact radius, and no bound of {parameter} follows",
            kind.names()[0]
        )
    } else if part_of_others(bodies, contact, a) > SMALL {
        format!("other bodies deform, too, and no bound of {parameter} follows")
    } else {
        format!("{parameter} is between {stick:.4e} Pa (stick) and {slide:.4e} Pa (no friction)")
    };
    // A growing contact with full friction is solved under these conditions only.
    let paraboloid = bodies.probe.is_paraboloid();
    let both = if paraboloid && is_uncoupled && !kind.is_stiffness() {
        "fit with both, or "
    } else {
        ""
    };
    Some(WarningKind::Friction.with(format!(
        "{name}: full friction would raise the stiffness of a flat punch as wide as the widest contact by {} %, and \
         changes {parameter} by more than its standard error: {bounds}; {both}use contacts that are less \
         wide beside the film",
        digits(1e2 * (ratio - 1.0)),
    )))
}

/// Returns the part of sphere and base in the compliance of the contact of radius `a` (m): that of
/// half-spaces.
fn part_of_others(bodies: &Bodies, contact: &Contact, a: f64) -> f64 {
    let base = bodies.base().map_or(f64::INFINITY, |base| base.reduced());
    let of_half_spaces = 0.5 * (1.0 / bodies.sphere_modulus + 1.0 / base) / a;
    contact
        .stiffness(a)
        .map_or(f64::INFINITY, |stiffness| stiffness * of_half_spaces)
}

/// Returns a number with two digits, or one decimal.
fn digits(value: f64) -> String {
    let decimals = (1.0 - value.abs().log10().floor()).clamp(1.0, 12.0) as usize;
    format!("{value:.decimals$}")
}

/// Returns the stiffness with full friction over that without, of a flat punch of radius `a` (m), and whether
/// Dundurs' beta of sphere and film is 0; `None` where it is not solved, or there is no film.
fn stiffening(bodies: &Bodies, nu2: f64, a: f64) -> Option<(f64, bool)> {
    let stack = bodies.stack_or_on_rigid()?;
    let sticking = Sticking::on_stack(&stack, bodies.sphere_modulus, nu2).ok()?;
    let a_over_t = (a / stack.thickness()).min(sticking.most_of_punch());
    let ratio = sticking.stiffening(a_over_t, TOLERANCE).ok()?;
    Some((ratio, sticking.beta() == 0.0))
}
