//! The doubt that residuals at contact radii are errors of the radius, which the fit takes as exact.
//!
//! The fit is made again with errors of the radius, and with a small part of the noise of the ordinate. With the
//! deviation `s_i` of point `i` and its residual `r_i` in this unit, a likelihood with the most likely scale is
//!
//! ```text
//! 2 ln L = -n ln(sum r_i^2) - sum ln(s_i^2)
//! ```

use crate::estimate::minima::valley::is_costly;
use crate::estimate::problem::{Ending, Problem};
use crate::{Estimate, Warning, WarningKind};

/// The fewest points.
const FEWEST: usize = 8;
/// The difference of `2 ln L` from which on the radii are named. Of 440 simulated data sets whose ordinates have the noise
/// one reaches it; of 60 each with 10, 20 and 40 radii that have it, a quarter, most and nearly all do.
const MORE_LIKELY: f64 = 5.0;
/// The step of a radius, in parts of the widest one, for the slopes.
const STEP: f64 = 1e-5;
/// The noise of the ordinate beside errors of the radius, in parts of the noise without.
const LEFT: f64 = 0.05;
/// The rounds of weights and values, the most evaluations of each over the number of parameters + 1, and the relative
/// changes at which it ends.
const ROUNDS: usize = 3;
const PATIENCE: usize = 30;
const TOLERANCE: f64 = 1e-6;

/// Warns if the residuals of experiment `e` are more likely errors of the contact radii than of the ordinates.
pub(crate) fn doubt(problem: &Problem<'_>, e: usize, estimates: &[Estimate]) -> Option<Warning> {
    let assigned = &problem.assigned[e];
    let experiment = &assigned.experiment;
    let kind = experiment.measurement.kind;
    let is_sought = kind.at_radii()
        && experiment.usual_noise().is_none()
        && assigned.abscissa_errors.is_empty()
        && assigned.counting() >= FEWEST
        && !is_costly(problem);
    if !is_sought {
        return None;
    }
    let radii = experiment.measurement.points.iter();
    let widest = radii.fold(0.0, |widest: f64, point| widest.max(point.abscissa));
    let noise = assigned.noise;
    let mut other = problem.clone();
    let own = &mut other.assigned[e].experiment;
    (own.noise, own.abscissa_noise) = (Some(LEFT * noise), STEP * widest);
    other.weigh().ok()?;
    let errors = &other.assigned[e].abscissa_errors;
    let squares = assigned.counting_points().map(|i| errors[i].part.powi(2));
    let usual = (squares.sum::<f64>() / assigned.counting() as f64).sqrt();
    other.assigned[e].experiment.abscissa_noise *= noise / usual;
    for _ in 0..ROUNDS {
        other.weigh().ok()?;
        other.update().ok()?;
        other = other.minimise(PATIENCE, TOLERANCE);
        if other.ending != Ending::Converged {
            return None;
        }
    }
    other.weigh().ok()?;
    let ([of_ordinates, _], [of_radii, scale]) = (likelihood(problem, e)?, likelihood(&other, e)?);
    if of_radii - of_ordinates < MORE_LIKELY {
        return None;
    }
    let deviation = scale * other.assigned[e].experiment.abscissa_noise;
    let changes = estimates.iter().enumerate().map(|(i, one)| {
        let (change, parameter) = (other.value(i) - one.value, one.parameter);
        format!(
            "{parameter} by {:+.1} of its standard errors",
            change / one.standard_error
        )
    });
    let changes: Vec<String> = changes.collect();
    Some(WarningKind::RadiusNoise.with(format!(
        "{}: the residuals are more likely errors of the contact radius, of some {deviation:.1e} m, than one noise of the {}, \
         which the fit takes for all points: standard errors are not right. Give the errors of the contact radius their size, \
         which changes {}",
        experiment.measurement.name,
        kind.names()[1],
        changes.join(" and ")
    )))
}

/// Returns twice the logarithm of the likelihood of experiment `e`, with the most likely scale of its deviations, and this
/// scale.
fn likelihood(problem: &Problem<'_>, e: usize) -> Option<[f64; 2]> {
    let rows = problem.rows_of_experiments()[e].clone();
    let count = rows.len() as f64;
    let residuals = problem.plain_residuals()?;
    let squares = residuals.rows(rows.start, rows.len()).norm_squared();
    let assigned = &problem.assigned[e];
    let logarithms: f64 = assigned
        .counting_points()
        .map(|i| assigned.deviation(i).ln())
        .sum();
    let freedom = (count - problem.parameters_of(e).len() as f64).max(1.0);
    Some([
        -count * squares.ln() - 2.0 * logarithms,
        (squares / freedom).sqrt(),
    ])
}
