//! Doubts about the detector: readings at the end of its range, and readings in coarse steps.

use crate::estimate::problem::assigned::Assigned;
use crate::statistics::extremes;
use crate::{Branch, FittedExperiment, FittedPoint, Warning, WarningKind};

/// The fewest neighbouring points of one reading that make a detector saturated.
const FEWEST: usize = 3;
/// The change of the fit over equal readings, in steps, that rounding explains: one step, and the noise
/// at both ends.
const ROUNDED: f64 = 3.0;
/// The noise over the steps between readings where rounding makes most of it. Rounding alone makes
/// 0.29; with noise of half a step the readings are as good as without rounding.
const OF_ROUNDING: [f64; 2] = [0.1, 0.5];

/// Adds the doubts about the detector of an experiment. Tells whether its readings are in coarse
/// steps.
pub(crate) fn add(
    warnings: &mut Vec<Warning>,
    fitted: &FittedExperiment,
    assigned: &Assigned,
) -> bool {
    let kind = assigned.experiment.measurement.kind;
    let local_noise = assigned.local_noise.unwrap_or(0.0);
    let [_, ordinate] = kind.names();
    let name = &fitted.name;
    let count = fitted.points.len();
    let readings = distinct(fitted.points.iter());
    if readings.len() < FEWEST {
        return false;
    }
    let [_, unit] = kind.units();
    let last = readings.len() - 1;
    for (which, extreme, next) in [
        ("smallest", readings[0], readings[1]),
        ("largest", readings[last], readings[last - 1]),
    ] {
        let change = change_of_fit(fitted, assigned, extreme);
        if change > ROUNDED * (extreme - next).abs() + local_noise * kind.scale(extreme) {
            let own = fitted
                .points
                .iter()
                .filter(|point| point.ordinate == extreme);
            let own: Vec<u64> = own.map(|point| point.line).collect();
            warnings.push(WarningKind::Saturated.with(format!(
                "{name}: {} points have exactly the {which} {ordinate}, {extreme:.3e} {unit}, \
                 where the fit changes by {change:.1e} {unit}: the detector may be at the end \
                 of its range; if so, leave these points out, in {}",
                own.len(),
                assigned.experiment.measurement.numbering.names(&own)
            )));
        }
    }
    let steps = readings.windows(2).map(|pair| pair[1] - pair[0]);
    let step = steps.fold(f64::INFINITY, f64::min);
    let [least, most] = OF_ROUNDING.map(|part| part * step);
    // Rounding makes a relative noise that is largest at the smallest readings.
    let squares = fitted.points.iter().map(|point| point.ordinate.powi(-2));
    let usual = (squares.sum::<f64>() / count as f64).powf(-0.5);
    let noise = fitted.noise * kind.scale(usual);
    let repeats = if kind.at_radii() {
        repeats(fitted, assigned)
    } else {
        2 * readings.len() <= count
    };
    let is_coarse = repeats && (least..most).contains(&noise);
    if is_coarse {
        warnings.push(WarningKind::CoarseSteps.with(format!(
            "{name}: the {count} points have only {} values of the {ordinate}, in steps of \
             {step:.3e} {unit}, beside which the noise is small: the errors are those of \
             rounding, which are not independent, and standard errors may be too small; measure \
             in finer steps{}",
            readings.len(),
            if kind.at_radii() {
                ", or if each of them was set and read several times, take the mean of its readings"
            } else {
                ""
            }
        )));
    }
    is_coarse
}

/// Tells whether each reading is there twice or more on the mean, in one of both ways: a load that is set at contact radii
/// may be the same in both.
fn repeats(fitted: &FittedExperiment, assigned: &Assigned) -> bool {
    let unloading = assigned.unloading();
    [false, true].into_iter().any(|way| {
        let own = fitted
            .points
            .iter()
            .zip(&unloading)
            .filter(|(_, own)| **own == way);
        let own = own.map(|(point, _)| point);
        let count = own.clone().count();
        count > 0 && 2 * distinct(own).len() <= count
    })
}

/// Returns the different readings of points, by rising size.
fn distinct<'p>(points: impl Iterator<Item = &'p FittedPoint>) -> Vec<f64> {
    let mut readings: Vec<f64> = points.map(|point| point.ordinate).collect();
    readings.sort_by(f64::total_cmp);
    readings.dedup();
    readings
}

/// Returns by how much the fit changes over neighbouring points of a branch that all have one
/// reading: the most of any [`FEWEST`] points or more.
fn change_of_fit(fitted: &FittedExperiment, assigned: &Assigned, reading: f64) -> f64 {
    let mut most = 0.0_f64;
    for branch in Branch::CONTACTS {
        let order = assigned.order.iter();
        let own = order.filter(|&&i| assigned.branches[i] == branch);
        let own: Vec<&FittedPoint> = own.map(|&i| &fitted.points[i]).collect();
        for run in own.chunk_by(|one, other| one.ordinate == other.ordinate) {
            if run.len() < FEWEST || run[0].ordinate != reading {
                continue;
            }
            let values = run.iter().filter_map(|point| point.fit);
            let [low, high] = extremes(values);
            most = most.max(high - low);
        }
    }
    most
}
