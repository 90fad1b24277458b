//! The way from a minimum on few points to that on all: points near the end of a branch are held
//! back, and the noise is estimated.

use super::minimum::Minimum;
use super::noise::estimate_noise;
use crate::estimate::problem::assigned::Assigned;
use crate::estimate::problem::few::hold_back;
use crate::estimate::problem::uncertainty::Uncertainty;
use crate::estimate::problem::{Ending, Problem};
use crate::statistics::{MEDIAN, excess, median};
use crate::{Branch, Loss, Point};

/// The most evaluations over the number of parameters + 1.
pub(crate) const PATIENCE: usize = 60;
/// The relative changes of the sum of squares and of the values at which the method stops: on few
/// points, where more points follow, and at last.
pub(crate) const COARSE: f64 = 1e-4;
const FINE: f64 = 1e-8;
/// Points count from this number of standard errors of the end of their branch on. Nearer to it a
/// force is no linear function of the parameters.
pub(crate) const CLEAR: f64 = 4.0;
/// The most of the points in contact that are left out for being near the end of their branch. Each
/// point left out makes the end less certain, which would leave out more, until none is left.
const MOST_NEAR: f64 = 0.1;
/// The most rounds of noise and branches.
pub(crate) const ROUNDS: usize = 6;
/// The round from which on a point that counts goes on to count.
const STEADY: usize = 3;
/// The largest distance of the end of a fit from the minimum of its linearisation, in standard
/// errors. A fit that ends farther away was stopped.
pub(crate) const SHORT: f64 = 0.1;
/// The relative change of the deviation of a point, by errors of the abscissae, that needs another
/// round.
const WEIGHTS_CHANGE: f64 = 1e-3;
/// An excess of the sum of squares, in standard deviations, at which other starts are tried.
const BAD: f64 = 4.5;

/// Tells whether the residuals are larger than the noise, given or seen in neighbouring ordinates.
pub(crate) fn is_bad(problem: &Problem<'_>) -> bool {
    let Some(residuals) = problem.plain_residuals() else {
        return true;
    };
    let mut experiments = problem.assigned.iter().zip(problem.rows_of_experiments());
    experiments.any(|(assigned, rows)| {
        let count = rows.len();
        let own = residuals.rows(rows.start, count);
        let is_known = assigned.experiment.usual_noise().is_some();
        let local = assigned.local_noise.filter(|&noise| noise > 0.0);
        if !is_known && local.is_none() {
            return false;
        }
        let unit = |i: usize| local.map_or(1.0, |local| assigned.deviation(i) / local);
        let points = assigned.counting_points();
        let units = points.map(|i| if is_known { 1.0 } else { unit(i) });
        // The median bears outliers.
        let squares = own.iter().zip(units).map(|(r, unit)| (r * unit).powi(2));
        let middle = median(squares.collect()) / MEDIAN.powi(2);
        excess(middle * count as f64, count as f64) > BAD
    })
}

/// What becomes of points in contact that are clearly beyond the end of their branch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Beyond {
    /// They count, on the line that continues the branch: without them the branch may end ever earlier, on ever fewer
    /// points.
    Counts,
    /// They are left out.
    LeftOut,
}

/// Follows an end on few points to all points: estimates the noise where it is not known, and lets the points count that
/// are not near the end of their branch, until neither changes. Points beyond the end are left out where the fit does not
/// describe the data with them, or where the other points contradict them.
pub(crate) fn settle<'a>(problem: Problem<'a>, data: &[Assigned]) -> Minimum<'a> {
    let (counted, has_beyond) = settle_with(problem.clone(), data, Beyond::Counts);
    if !has_beyond {
        return counted;
    }
    let (without, _) = settle_with(problem, data, Beyond::LeftOut);
    let is_better = is_bad(&counted.problem) || contradicts(&without.problem, &counted.problem);
    if without.problem.ending == Ending::Converged && is_better {
        without
    } else {
        counted
    }
}

/// Tells whether the points that count `without` those beyond the end contradict the fit in which these `counted`: whether
/// it describes them worse by more than chance explains, in units of their noise.
fn contradicts(without: &Problem<'_>, counted: &Problem<'_>) -> bool {
    let mut change = 0.0;
    let all = without.assigned.iter().zip(&counted.assigned);
    let predicted = without.predicted.iter().flatten();
    let predicted = predicted.zip(counted.predicted.iter().flatten());
    for ((own, other), (ours, theirs)) in all.zip(predicted) {
        let square = |values: &[f64], i: usize| {
            ((values[i] - own.experiment.compared(i)) / own.deviation(i)).powi(2)
        };
        let in_both = own
            .counting_points()
            .filter(|&i| other.branches[i] != Branch::LeftOut);
        let changes = in_both.map(|i| square(&theirs.values, i) - square(&ours.values, i));
        change += changes.sum::<f64>();
    }
    excess(change, without.slots.len() as f64) > BAD
}

fn settle_with<'a>(
    mut problem: Problem<'a>,
    data: &[Assigned],
    beyond: Beyond,
) -> (Minimum<'a>, bool) {
    let (mut round, mut has_beyond) = (0, false);
    loop {
        let weights = problem.weigh();
        let uncertainty = Uncertainty::of(&problem);
        let (Some(uncertainty), Ok(weights)) = (uncertainty, weights) else {
            return (Minimum::new(problem, None), has_beyond);
        };
        let (uncertainty, noise_changed) = estimate_noise(&mut problem, uncertainty);
        let mut branches_changed = false;
        for (e, whole) in data.iter().enumerate() {
            let (mut branches, own) = clear_branches(&problem, e, &uncertainty, whole, beyond);
            has_beyond |= own;
            // Without this, an end that moves to and fro with the points near it would never settle.
            if beyond == Beyond::Counts && round >= STEADY {
                for (new, old) in branches.iter_mut().zip(&problem.assigned[e].branches) {
                    if *new == Branch::LeftOut {
                        *new = *old;
                    }
                }
            }
            if branches != problem.assigned[e].branches && round < ROUNDS {
                problem.assigned[e].branches = branches;
                branches_changed = true;
            }
        }
        let is_inexact = |assigned: &Assigned| !assigned.abscissa_errors.is_empty();
        let noise_matters = problem.assigned.len() > 1
            || problem.assigned.iter().any(is_inexact)
            || problem.loss != Loss::Squares
            || problem.slots.iter().any(|slot| slot.prior.is_some());
        round += 1;
        // At a point where the contact changes from pinned to receding the derivatives have a step,
        // at which the method may stop too early.
        let stalled = uncertainty.short > SHORT && problem.ending == Ending::Converged && round < 3;
        let weights_changed = weights > WEIGHTS_CHANGE;
        let settled =
            !(branches_changed || weights_changed || noise_changed && noise_matters || stalled);
        if settled || round > ROUNDS {
            return (Minimum::new(problem, Some(uncertainty)), has_beyond);
        }
        // A point that did not count has no part of the error of its abscissa yet.
        if problem.update().is_err() || branches_changed && problem.weigh().is_err() {
            return (Minimum::new(problem, None), has_beyond);
        }
        problem = problem.minimise(PATIENCE, FINE);
    }
}

/// Returns the branches without the points that are too near to the end of their branch, or too far beyond it to count,
/// and tells whether there are any beyond it.
pub(crate) fn clear_branches(
    problem: &Problem<'_>,
    e: usize,
    uncertainty: &Uncertainty,
    whole: &Assigned,
    beyond: Beyond,
) -> (Vec<Branch>, bool) {
    let mut ends = ends(problem, e, uncertainty, whole);
    narrow(whole, &mut ends);
    let [counted, without] =
        [Beyond::Counts, Beyond::LeftOut].map(|beyond| clear_of(whole, &ends, beyond));
    let has_beyond = counted != without;
    let branches = match beyond {
        Beyond::Counts => counted,
        Beyond::LeftOut => without,
    };
    let counting = branches.iter().filter(|own| **own != Branch::LeftOut);
    if counting.count() < problem.slots.len() {
        // The values are so uncertain that the branch may end anywhere.
        return (hold_back(whole).branches, has_beyond);
    }
    (branches, has_beyond)
}

/// Narrows the distances from which on points are clear of the ends, until no more than
/// [`MOST_NEAR`] of the points in contact are nearer. Points that are clearly beyond an end have no
/// contact, and are none of these.
fn narrow(whole: &Assigned, ends: &mut [End]) {
    let sense = whole.experiment.sense();
    let points = whole.experiment.measurement.points.iter();
    let mut near: Vec<f64> = points
        .zip(&whole.branches)
        .filter_map(|(point, branch)| {
            let end = ends.iter().find(|end| end.branch == *branch)?;
            let distance = sense * point.abscissa - end.position;
            (distance.abs() <= end.clear).then_some(distance.abs())
        })
        .collect();
    let contacts = whole.branches.iter().filter(|branch| branch.is_contact());
    let most = (MOST_NEAR * contacts.count() as f64).ceil() as usize;
    if near.len() > most {
        near.sort_by(f64::total_cmp);
        let clear = near[most - 1];
        for end in ends {
            end.clear = end.clear.min(clear);
        }
    }
}

/// The end of a stable branch, as far as the fit knows it, in the sense of the imposed value.
#[derive(Clone, Copy, Debug)]
pub(crate) struct End {
    pub branch: Branch,
    /// The abscissa of the end times the sense.
    pub position: f64,
    /// The distance from which on a point is clear of it.
    pub clear: f64,
}

/// Returns the ends of the branches that an experiment has points on.
pub(crate) fn ends(
    problem: &Problem<'_>,
    e: usize,
    uncertainty: &Uncertainty,
    whole: &Assigned,
) -> Vec<End> {
    let experiment = &problem.assigned[e].experiment;
    let slots = problem.slots_of(e);
    let parameters = problem.parameters_of(e);
    // With all points that may count, the variance will be smaller.
    let part = problem.assigned[e].counting() as f64 / whole.counting().max(1) as f64;
    let end = |branch: Branch| {
        let end = experiment.branch_end_with(&problem.contact_of(), branch, &parameters);
        let end = end.ok().flatten()?;
        let mut variance = 0.0;
        for (&one, by_one) in slots.iter().zip(&end.derivatives) {
            for (&other, by_other) in slots.iter().zip(&end.derivatives) {
                let sizes = uncertainty.sizes[one] * uncertainty.sizes[other];
                variance += by_one * by_other * sizes * uncertainty.covariance[(one, other)];
            }
        }
        Some(End {
            branch,
            position: experiment.sense() * end.abscissa,
            clear: CLEAR * (part * variance.max(0.0)).sqrt(),
        })
    };
    Branch::CONTACTS
        .into_iter()
        .filter(|branch| whole.branches.contains(branch))
        .filter_map(end)
        .collect()
}

/// Returns the branches without the points in contact that are near the end of their branch, or beyond it and do not
/// count.
fn clear_of(whole: &Assigned, ends: &[End], beyond: Beyond) -> Vec<Branch> {
    let sense = whole.experiment.sense();
    let points = whole.experiment.measurement.points.iter();
    let branch = |(point, &branch): (&Point, &Branch)| {
        let is_left_out = |end: &End| {
            let distance = sense * point.abscissa - end.position;
            let is_near = distance >= -end.clear || beyond == Beyond::LeftOut;
            end.branch == branch && distance <= end.clear && is_near
        };
        if ends.iter().any(is_left_out) {
            Branch::LeftOut
        } else {
            branch
        }
    };
    points.zip(&whole.branches).map(branch).collect()
}
