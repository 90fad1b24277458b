//! A hold after which no retract was measured: a load that falls at a held position, or a position that grows at a held
//! load, then tells that the film relaxes.

use std::ops::Range;

use super::assigned::Assigned;
use super::doubts::Warnings;
use crate::WarningKind;
use crate::statistics::{extremes, median};

/// The part of the range of positions or loads within which they are held, and the part of the load by which it falls
/// then, or of the range of penetrations by which they grow.
const HELD: f64 = 0.02;
const CHANGES: f64 = 0.03;
/// The part of the held load above which the positions count whose range is that of the penetrations.
const PRESSED: f64 = 0.1;
/// The noise of the levels at both ends of the hold beyond which the load has fallen, and the noise of a load within which
/// it is held.
const CLEAR: f64 = 4.0;
/// The fewest points of a hold, and the least part of all points.
const FEWEST: usize = 5;
const PART: usize = 20;

/// Warns of a hold in which the film relaxes, and after which no retract was measured.
pub(super) fn add(warnings: &mut Warnings, assigned: &Assigned) {
    let experiment = &assigned.experiment;
    let measurement = &experiment.measurement;
    let kind = measurement.kind;
    if kind.at_radii() || kind.is_stiffness() || experiment.relaxing.is_some() {
        return;
    }
    let noise = assigned.seen_noise();
    let sense = experiment.sense();
    let points = || measurement.points.iter();
    let positions: Vec<f64> = points().map(|point| sense * point.abscissa).collect();
    let loads = points().map(|point| point.ordinate - experiment.baseline_at(point.abscissa));
    let loads: Vec<f64> = loads.collect();
    let what = kind.names()[0];
    let levels = |of: &[f64], [first, last]: &[Range<usize>; 2]| {
        [first, last].map(|part| median(of[part.clone()].to_vec()))
    };
    let chance = |ends: &[Range<usize>; 2]| CLEAR * noise / (ends[0].len() as f64).sqrt();
    let falls = || {
        let ends = hold(&positions, 0.0)?;
        let [first, last] = levels(&loads, &ends);
        let fall = first - last;
        let is_clear = first > 0.0 && fall > CHANGES * first && fall > chance(&ends);
        is_clear.then(|| {
            format!(
                "while the {what} was held the load fell by {fall:.2e} N, {:.0} %: the film relaxes, or flows",
                1e2 * fall / first
            )
        })
    };
    let creeps = || {
        let ends = hold(&loads, 2.0 * CLEAR * noise)?;
        let [first, last] = levels(&loads, &ends);
        let pressed = positions.iter().zip(&loads);
        let pressed = pressed.filter(|(_, load)| **load > PRESSED * last);
        let [least, most] = extremes(pressed.map(|(position, _)| *position));
        let is_level = (last - first).abs() <= HELD * last + chance(&ends);
        let [first, last] = levels(&positions, &ends);
        let grows = last - first;
        (is_level && grows > CHANGES * (most - least)).then(|| {
            format!(
                "while the load was held the {what} changed by {grows:.2e} m, {:.0} % of its change with the load: the film \
                 creeps or flows, or the detector is saturated",
                1e2 * grows / (most - least - grows)
            )
        })
    };
    if let Some(told) = falls().or_else(creeps) {
        let needed = if experiment.times.is_empty() {
            ", for which each point needs its time"
        } else {
            " with the times of the points"
        };
        warnings.add(
            WarningKind::Relaxes,
            format!(
                "{}: {told}; fit a relaxation function{needed}, or leave out the points of the hold",
                measurement.name
            ),
        );
    }
}

/// Returns the first and the last fifth of the points at which values, in time, are held at the largest one, to some
/// `slack` beside a part of their range.
fn hold(values: &[f64], slack: f64) -> Option<[Range<usize>; 2]> {
    let [least, most] = extremes(values.iter().copied());
    let is_held = |value: &f64| *value >= most - HELD * (most - least) - slack;
    let begin = values.iter().position(is_held).filter(|begin| *begin > 0)?;
    let held = values[begin..]
        .iter()
        .take_while(|value| is_held(value))
        .count();
    let part = held.div_ceil(5);
    (held >= FEWEST.max(values.len() / PART))
        .then(|| [begin..begin + part, begin + held - part..begin + held])
}
