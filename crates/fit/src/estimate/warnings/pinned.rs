//! The doubt that the contact line stays where it is while the load changes.

use crate::estimate::problem::assigned::Assigned;
use crate::statistics::range;
use crate::{Kind, Warning, WarningKind};

/// The radii over the largest one that count as one radius.
const ONE: f64 = 0.98;
/// The fewest points at one radius.
const FEWEST: usize = 3;
/// The part of the range of all loads over which they then change. A load that grows like the tenth power of the radius
/// changes by 0.18 of its largest value within 2 %.
const PART: f64 = 0.25;

/// Warns if the load changes by a large part of its range while the contact radius stays at its largest values.
pub(crate) fn doubt(assigned: &Assigned) -> Option<Warning> {
    let experiment = &assigned.experiment;
    if experiment.measurement.kind != Kind::LoadRadius || !experiment.has_shape(false) {
        return None;
    }
    let points = &experiment.measurement.points;
    let counting = || assigned.counting_points().map(|i| &points[i]);
    let largest = counting().map(|point| point.abscissa).fold(0.0, f64::max);
    let own: Vec<_> = counting()
        .filter(|point| point.abscissa >= ONE * largest)
        .collect();
    let of_loads = range(own.iter().map(|point| point.ordinate));
    let part = of_loads / range(counting().map(|point| point.ordinate));
    if own.len() < FEWEST || part.is_nan() || part < PART {
        return None;
    }
    let lines: Vec<u64> = own.iter().map(|point| point.line).collect();
    Some(WarningKind::PinnedLine.with(format!(
        "{}: the load changes by {of_loads:.1e} N, {:.0} % of its range, while the contact radius is within 2 % of the largest \
         one: the contact line stays where it is, as at the beginning of unloading under a larger work of adhesion, and a \
         fit of such points gives wrong values; leave them out, in {}, or fit loading and unloading together with a work of \
         adhesion of its own for each",
        experiment.measurement.name,
        1e2 * part,
        experiment.measurement.numbering.names(&lines)
    )))
}
