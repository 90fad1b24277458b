//! What a report says of adhesion that depends on the speed of the contact line.

use super::unit::three_digits;
use crate::statistics::extremes;
use crate::{Fit, FittedExperiment};

/// Returns the least and the largest speed of the contact line, m/s, of the points that count, without their signs; `None`
/// where adhesion does not depend on it.
pub fn line_speeds(fitted: &FittedExperiment) -> Option<[f64; 2]> {
    let speeds = fitted.points.iter().filter_map(|point| point.line_speed);
    let [least, most] = extremes(speeds.map(f64::abs));
    (least <= most).then_some([least, most])
}

/// Returns these speeds of each measurement.
pub(super) fn lines(fit: &Fit) -> Vec<String> {
    let line = |fitted: &FittedExperiment| {
        let [least, most] = line_speeds(fitted)?.map(|speed| three_digits(speed, "m/s"));
        let name = &fitted.name;
        Some(format!(
            "{name}: speeds of the contact line from {least} to {most}"
        ))
    };
    fit.experiments.iter().filter_map(line).collect()
}
