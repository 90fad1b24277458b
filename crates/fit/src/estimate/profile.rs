//! Profile-likelihood intervals.

use super::loss::weighted;
use super::problem::{Ending, Problem};
use super::uncertainty::Uncertainty;
use crate::Estimate;

/// The most evaluations over the number of parameters + 1 of one fit.
const PATIENCE: usize = 30;
/// The relative changes at which the method stops.
const TOLERANCE: f64 = 1e-6;
/// The most fits for one end of an interval.
const MOST_FITS: usize = 24;
/// The accuracy of `sqrt(chi^2 - chi^2_min)` at an end.
const ACCURACY: f64 = 0.01;
/// The farthest end sought, in standard errors times the deviations asked for.
const FARTHEST: f64 = 20.0;

/// Adds the interval of each estimate in which the sum of squares, minimised over all other values,
/// exceeds its minimum by less than `deviations^2`. Returns the number of evaluations.
pub(crate) fn add(
    estimates: &mut [Estimate],
    problem: &Problem<'_>,
    uncertainty: &Uncertainty,
    deviations: f64,
) -> usize {
    let least = problem.misfit();
    let deviations = deviations * uncertainty.growth;
    let mut evaluations = 0;
    for (slot, estimate) in estimates.iter_mut().enumerate() {
        let error = uncertainty.relative_error(slot) / uncertainty.growth;
        let ends = [-1.0, 1.0].map(|side| {
            end(
                problem,
                slot,
                least,
                (side, error, deviations),
                &mut evaluations,
            )
        });
        estimate.profile = Some(ends);
    }
    evaluations
}

/// Returns one end of an interval: 0 or infinity where the sum of squares does not grow enough, NaN
/// where the other values have no fit.
fn end(
    problem: &Problem<'_>,
    slot: usize,
    least: f64,
    (side, error, deviations): (f64, f64, f64),
    evaluations: &mut usize,
) -> f64 {
    let positive = problem.slots[slot].parameter.is_positive();
    let best = problem.value(slot);
    let size = problem.slots[slot].coordinate.size(best);
    let value = |distance: f64| {
        if positive {
            best * (side * distance).exp()
        } else {
            best + side * distance * size
        }
    };
    let mut current = problem.clone();
    let unlimited = match (positive, side < 0.0) {
        (true, true) => 0.0,
        (false, true) => f64::NEG_INFINITY,
        _ => f64::INFINITY,
    };
    let farthest = FARTHEST * deviations * error.min(5.0);
    let (mut near, mut far) = ([0.0, 0.0], None::<[f64; 2]>);
    let mut distance = deviations * error.min(5.0);
    for step in 0..MOST_FITS {
        // Where the table ends, the data have set no limit.
        let Some(fixed) = current.with_fixed(slot, value(distance)) else {
            return unlimited;
        };
        let before = fixed.evaluations;
        let (fitted, ending) = fixed.minimise(PATIENCE, TOLERANCE);
        *evaluations += fitted.evaluations - before;
        if ending == Ending::Failed {
            return f64::NAN;
        }
        let of_prior = problem.slots[slot].prior.map_or(0.0, |prior| {
            let residual = (value(distance) - prior.mean) / prior.width;
            weighted(problem.loss, residual).0.powi(2)
        });
        current.take_others(slot, &fitted);
        // How far the sum of squares has grown, as a number of standard deviations.
        let grown = (fitted.misfit() + of_prior - least).max(0.0).sqrt();
        if (grown - deviations).abs() < ACCURACY * deviations {
            return value(distance);
        }
        if grown < deviations {
            near = [distance, grown];
        } else {
            far = Some([distance, grown]);
        }
        distance = match far {
            // The root of a parabola is a straight line, on which the secant converges quickly.
            // Where the growth is no parabola, every second step halves.
            Some(far) => {
                let part = if step % 2 == 0 {
                    (deviations - near[1]) / (far[1] - near[1])
                } else {
                    0.5
                };
                near[0] + part.clamp(0.05, 0.95) * (far[0] - near[0])
            }
            None => {
                let ratio = if grown > 0.0 { deviations / grown } else { 4.0 };
                distance * ratio.clamp(1.2, 4.0)
            }
        };
        if distance > farthest {
            return unlimited;
        }
    }
    value(distance)
}
