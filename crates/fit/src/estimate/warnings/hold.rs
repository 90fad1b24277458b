//! A hold after which no retract was measured: a load that falls at a held position, or a position that grows at a held
//! load, then tells that the film relaxes.

use std::ops::Range;

use crate::estimate::problem::assigned::Assigned;
use crate::statistics::{extremes, median};
use crate::{Warning, WarningKind};

/// The part of the range of positions or loads within which they are held.
const HELD: f64 = 0.02;
/// The part of the load by which it falls at a held position, or of the change of the position in contact by which the
/// position changes at a held load, from which on the film is said to relax.
const CHANGES: f64 = 0.03;
/// Points whose load is above this part of the held one are in contact.
const PRESSED: f64 = 0.1;
/// The noise of two levels beyond which they differ. A load that is held stays within twice this noise of a reading.
const CLEAR: f64 = 4.0;
/// The fewest points of a hold, and the least part of all points.
const FEWEST: usize = 5;
const PART: usize = 20;

/// Warns of a hold in which the film relaxes, and after which no retract was measured.
pub(crate) fn doubt(assigned: &Assigned) -> Option<Warning> {
    let experiment = &assigned.experiment;
    let measurement = &experiment.measurement;
    let kind = measurement.kind;
    if !kind.at_positions() || experiment.relaxing.is_some() {
        return None;
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
    let chance =
        |noise: f64, ends: &[Range<usize>; 2]| CLEAR * noise / (ends[0].len() as f64).sqrt();
    let falls = || {
        let ends = hold(&positions, 0.0)?;
        let [first, last] = levels(&loads, &ends);
        let fall = first - last;
        let is_clear = first > 0.0 && fall > CHANGES * first && fall > chance(noise, &ends);
        is_clear.then(|| {
            format!(
                "while the {what} was held the load fell by {fall:.2e} N, {:.0} %: the film relaxes, or flows",
                1e2 * fall / first
            )
        })
    };
    let creeps = || {
        let ends = hold(&loads, 2.0 * CLEAR * noise)?;
        let [first, held] = levels(&loads, &ends);
        let pressed = positions.iter().zip(&loads);
        let pressed = pressed.filter(|(_, load)| **load > PRESSED * held);
        let [least, most] = extremes(pressed.map(|(position, _)| *position));
        let is_level = (held - first).abs() <= chance(noise, &ends).max(HELD * held);
        let [first, last] = levels(&positions, &ends);
        let grows = last - first;
        let range = most - least;
        // A load that is held within this changes an elastic contact by as much at most. The standard deviation of the
        // difference of two medians is 1.8 times that of a mean.
        let elastic = HELD + 2.0 * chance(noise, &ends) / held;
        (held > 0.0 && is_level && grows > (CHANGES + elastic) * range).then(|| {
            format!(
                "while the load was held the {what} changed by {grows:.2e} m, {:.0} % of its whole change in contact: the \
                 film creeps or flows, or the detector is saturated",
                1e2 * grows / range
            )
        })
    };
    let told = falls().or_else(creeps)?;
    let needed = if experiment.times.is_empty() {
        ", for which each point needs its time"
    } else {
        " with the times of the points"
    };
    Some(WarningKind::Relaxes.with(format!(
        "{}: {told}; fit a relaxation function{needed}, or leave out the points of the hold",
        measurement.name
    )))
}

/// Returns the first and the last fifth of the points at which values, in time, are held at the largest one, to some
/// `slack` beside a part of their range.
fn hold(values: &[f64], slack: f64) -> Option<[Range<usize>; 2]> {
    let [least, most] = extremes(values.iter().copied());
    let is_held = |value: &f64| *value >= most - HELD * (most - least) - slack;
    let largest = values.iter().position(|value| *value == most)?;
    let before = values[..largest].iter().rev();
    let begin = largest - before.take_while(|value| is_held(value)).count();
    let held = values[begin..].iter();
    let end = begin + held.take_while(|value| is_held(value)).count();
    let level = median(values[end - (end - begin).div_ceil(5)..end].to_vec());
    // Within the slack the values may still grow.
    let arrives = |value: &f64| *value >= level - HELD * (most - least);
    let begin = begin + values[begin..end].iter().position(arrives)?;
    let part = (end - begin).div_ceil(5);
    (begin > 0 && end - begin >= FEWEST.max(values.len() / PART))
        .then(|| [begin..begin + part, end - part..end])
}
