//! The valley of the sum of squares along one value, away from a minimum.

use super::profile::with_fixed;
use crate::estimate::problem::few::thin;
use crate::estimate::problem::uncertainty::{UNDETERMINED, Uncertainty};
use crate::estimate::problem::{Ending, Problem};
use crate::{Experiment, Kind, Prior};

/// The most by which the sum of squares on few points may exceed the smallest one at a start that
/// is followed to all points.
pub(crate) const MARGIN: f64 = 60.0;
/// The relative error of a positive value from which on its valley is looked at: below it the
/// problem is linear as far as the data allow the value to move.
const DOUBTFUL: f64 = 0.03;
/// The first step of a logarithm, the factor from one step to the next, the largest step, and the
/// farthest distance.
const STEP: f64 = 0.3;
const GROWTH: f64 = 1.6;
const LARGEST_STEP: f64 = 1.2;
const FARTHEST: f64 = 8.0;
/// The most evaluations over the number of parameters + 1 of one fit.
const PATIENCE: usize = 6;
/// The sum of squares falls if it is below this part of that of the step before.
const FALLS: f64 = 0.999;
/// The distance, in standard errors, at which a standard error is tested, and the least growth of
/// the sum of squares there. It is the square of the distance if the problem is linear.
pub(crate) const TESTED: f64 = 5.0;
const LEAST_GROWTH: f64 = 16.0;

/// The rounds in which stiffness at depths becomes that of the fit: it also tells the contact radius, with which it
/// is predicted.
const ROUNDS: usize = 8;

/// A value that may be farther away than its standard error says.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bend {
    pub slot: usize,
    /// The value at [`TESTED`] standard errors.
    pub value: f64,
    /// The growth of the sum of squares there, instead of the square of the distance.
    pub growth: f64,
}

/// Lists the positive values with large errors, that of the largest error first.
pub(crate) fn doubtful(problem: &Problem<'_>, uncertainty: &Uncertainty) -> Vec<usize> {
    let is_positive = |slot: &usize| problem.slots[*slot].parameter.is_positive();
    let error = |slot: usize| uncertainty.relative_error(slot);
    let mut slots: Vec<usize> = (0..problem.slots.len())
        .filter(is_positive)
        .filter(|&slot| error(slot) > DOUBTFUL)
        .collect();
    slots.sort_by(|&one, &other| error(other).total_cmp(&error(one)));
    slots
}

/// Tells whether each step needs further solves, as on a stack of layers.
pub(crate) fn is_costly(problem: &Problem<'_>) -> bool {
    problem.experiments().any(|one| one.bodies.are_layered())
}

/// Follows the valley of a value on both sides: the value moves away, and all others follow it.
/// Returns the place on each side from which the sum of squares falls again, or else the lowest one
/// beyond [`TESTED`] standard errors, if chance could explain its sum of squares.
pub(crate) fn other_sides<'a>(problem: &Problem<'a>, slot: usize, error: f64) -> Vec<Problem<'a>> {
    let (start, least) = (problem.value(slot), problem.misfit());
    let mut found = Vec::new();
    for side in [-1.0, 1.0] {
        let mut current = problem.clone();
        let (mut last, mut lowest) = (least, None::<(f64, Problem<'a>)>);
        let (mut distance, mut step) = (STEP, STEP);
        while distance < FARTHEST {
            let value = start * (side * distance).exp();
            let Some(misfit) = with_fixed(&mut current, slot, value, PATIENCE) else {
                break;
            };
            let falls = misfit < FALLS * last;
            let is_lowest = lowest.as_ref().is_none_or(|(before, _)| misfit < *before);
            if falls || (distance > TESTED * error && is_lowest && misfit < least + MARGIN) {
                lowest = Some((misfit, current.clone()));
            }
            if falls {
                break;
            }
            last = misfit;
            step = (GROWTH * step).min(LARGEST_STEP);
            distance += step;
        }
        if let Some((_, mut place)) = lowest
            && place.update().is_ok()
        {
            place.ending = Ending::Converged;
            found.push(place);
        }
    }
    found
}

/// Finds a value whose standard error says too little: at [`TESTED`] of them, with the best other
/// values, the ordinates differ from those of the fit by too little. It takes few of the points.
pub(crate) fn bend(problem: &Problem<'_>, uncertainty: &Uncertainty) -> Option<Bend> {
    let mut worst = None::<Bend>;
    let slots = doubtful(problem, uncertainty);
    if slots.is_empty() {
        return None;
    }
    let exact = exact(problem);
    let part = exact.counting() as f64 / problem.counting() as f64;
    for slot in slots {
        let error = uncertainty.relative_error(slot);
        if error > UNDETERMINED {
            continue;
        }
        for side in [-1.0, 1.0] {
            let mut current = exact.clone();
            let value = problem.value(slot) * (side * TESTED * error).exp();
            let misfit = with_fixed(&mut current, slot, value, PATIENCE);
            let Some(misfit) = misfit.filter(|_| current.ending != Ending::Failed) else {
                continue;
            };
            let growth = misfit / part / uncertainty.growth.powi(2);
            if growth < worst.map_or(LEAST_GROWTH, |worst| worst.growth) {
                worst = Some(Bend {
                    slot,
                    value,
                    growth,
                });
            }
        }
    }
    worst
}

/// Returns the problem on few points, or on all of bodies that relax, with the ordinates and the priors that the fit predicts.
fn exact<'a>(problem: &Problem<'a>) -> Problem<'a> {
    let mut exact = problem.clone();
    // Few points do not tell a relaxation time as well as their part of all points.
    let thinned = exact.assigned.into_iter().map(|own| {
        if own.experiment.relaxing.is_some() {
            own
        } else {
            thin(own)
        }
    });
    exact.assigned = thinned.collect();
    let of_depth = |one: &Experiment| one.measurement.kind == Kind::StiffnessDepth;
    let rounds = if exact.experiments().any(of_depth) {
        ROUNDS
    } else {
        1
    };
    for _ in 0..rounds {
        if exact.update().is_err() {
            break;
        }
        let predicted = exact.predicted.iter().flatten();
        for (assigned, predicted) in exact.assigned.iter_mut().zip(predicted) {
            for (i, value) in predicted.values.iter().enumerate() {
                let ordinate = assigned.experiment.ordinate_of(*value);
                assigned.experiment.measurement.points[i].ordinate = ordinate;
            }
        }
    }
    for slot in 0..exact.slots.len() {
        let mean = exact.value(slot);
        let prior = exact.slots[slot].prior;
        exact.slots[slot].prior = prior.map(|prior| Prior { mean, ..prior });
    }
    exact
}
