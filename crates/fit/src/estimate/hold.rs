//! A hold after which no retract was measured: a load that falls then tells that the film relaxes.

use super::assigned::Assigned;
use super::doubts::Warnings;
use crate::WarningKind;
use crate::statistics::{extremes, median};

/// The part of the range of penetrations or heights within which they are held, and the part of the load by which it falls
/// then.
const HELD: f64 = 0.02;
const FALLS: f64 = 0.03;
/// The noise of the levels at both ends of the hold beyond which the load has fallen.
const CLEAR: f64 = 4.0;
/// The fewest points of a hold, and the least part of all points.
const FEWEST: usize = 5;
const PART: usize = 20;

/// Warns of a load that falls during a hold after which no retract was measured.
pub(super) fn add(warnings: &mut Warnings, assigned: &Assigned) {
    let experiment = &assigned.experiment;
    let measurement = &experiment.measurement;
    let kind = measurement.kind;
    if kind.at_radii() || kind.is_stiffness() || experiment.relaxing.is_some() {
        return;
    }
    let noise = assigned.seen_noise();
    let sense = experiment.sense();
    let points = &measurement.points;
    let positions = || points.iter().map(|point| sense * point.abscissa);
    let [least, most] = extremes(positions());
    // The points in time from the first one at the largest position on.
    let is_held = |position: f64| position >= most - HELD * (most - least);
    let Some(begin) = positions().position(is_held) else {
        return;
    };
    let held = positions()
        .skip(begin)
        .take_while(|&position| is_held(position))
        .count();
    if held < FEWEST.max(points.len() / PART) || begin == 0 {
        return;
    }
    let part = held.div_ceil(5);
    let load = |from: usize| {
        let points = points[from..from + part].iter();
        median(
            points
                .map(|point| point.ordinate - experiment.baseline_at(point.abscissa))
                .collect(),
        )
    };
    let first = load(begin);
    let fall = first - load(begin + held - part);
    if first > 0.0 && fall > FALLS * first && fall > CLEAR * noise / (part as f64).sqrt() {
        let what = kind.names()[0];
        let needed = if experiment.times.is_empty() {
            ", for which each point needs its time"
        } else {
            " with the times of the points"
        };
        warnings.add(
            WarningKind::Relaxes,
            format!(
                "{}: while the {what} was held the load fell by {fall:.2e} N, {:.0} %: the film relaxes, or \
                 flows; fit a relaxation function{needed}, or leave out the points of the hold",
                measurement.name,
                1e2 * fall / first
            ),
        );
    }
}
