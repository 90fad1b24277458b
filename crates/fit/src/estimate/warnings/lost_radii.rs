//! The doubt about contact radii of 0 under loads that no contact of that radius bears.

use crate::estimate::problem::assigned::Assigned;
use crate::statistics::extremes;
use crate::{Kind, Warning, WarningKind};

/// The range of the loads of rows with a radius of 0, over the largest load, from which on some are not off contact; the load
/// of one that is not; and the noises of either.
const RANGE: f64 = 0.05;
const PART: f64 = 0.01;
const CLEAR: f64 = 10.0;

/// Warns of rows that have a contact radius of 0 and loads far above that of another such row.
pub(super) fn doubt(own: &Assigned) -> Option<Warning> {
    let measurement = &own.experiment.measurement;
    let points = &measurement.points;
    let apart = points.iter().filter(|point| point.abscissa == 0.0);
    let [least, most] = extremes(apart.clone().map(|point| point.ordinate));
    let [_, largest] = extremes(points.iter().map(|point| point.ordinate));
    let clear = |part: f64| (part * largest).max(CLEAR * own.seen_noise());
    if measurement.kind != Kind::LoadRadius || most.is_infinite() || most - least < clear(RANGE) {
        return None;
    }
    let lost = apart.filter(|point| point.ordinate > least.min(0.0) + clear(PART));
    let lines: Vec<u64> = lost.map(|point| point.line).collect();
    Some(WarningKind::Outliers.with(format!(
        "{}: the contact radius is 0 in {} of {} rows, which means no contact, and their loads are up to {most:.2e} N, in {}: \
         leave out the rows in which the radius was not measured",
        measurement.name,
        lines.len(),
        points.len(),
        measurement.numbering.names(&lines)
    )))
}
