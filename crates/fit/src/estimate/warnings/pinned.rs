//! The doubt that the contact line stays where it is while the load falls.

use crate::estimate::problem::assigned::Assigned;
use crate::statistics::{extremes, range};
use crate::{Direction, Kind, Warning, WarningKind};

/// The radii over the largest one that count as one radius.
const ONE: f64 = 0.98;
/// The smallest radius over the largest one: of a narrower range, 2 % are much.
const NARROW: f64 = 0.85;
/// The fewest points at one radius.
const FEWEST: usize = 3;
/// The part of the range of all loads over which they then change. Where the radii have a wide range, a load that grows like
/// the tenth power of the radius changes by 0.18 of its largest value within 2 %.
const PART: f64 = 0.25;

/// Warns if the load falls by a large part of its range while the contact radius stays at its largest values.
pub(crate) fn doubt(assigned: &Assigned) -> Option<Warning> {
    let experiment = &assigned.experiment;
    let kind = experiment.measurement.kind;
    // Adhesion that depends on the speed describes a slow line, too.
    if kind != Kind::LoadRadius || !experiment.has_shape(false) || experiment.has_line_law() {
        return None;
    }
    let points = &experiment.measurement.points;
    // Points without a direction may be of unloading.
    let unloading = || {
        let counting = assigned.counting_points();
        let unloads = |i: usize| points[i].direction != Some(Direction::Approach);
        counting.filter(move |&i| unloads(i) && points[i].abscissa > 0.0)
    };
    let [least, largest] = extremes(unloading().map(|i| points[i].abscissa));
    let of_loads = range(unloading().map(|i| points[i].ordinate));
    let own = unloading().filter(|&i| points[i].abscissa >= ONE * largest);
    let own: Vec<usize> = own.collect();
    let falls = range(own.iter().map(|&i| points[i].ordinate));
    // A line that stays does so in a row, at the largest loads.
    let lowest = own.iter().map(|&i| points[i].ordinate);
    let lowest = lowest.fold(f64::INFINITY, f64::min);
    let mut others = unloading().filter(|i| !own.contains(i));
    let are_apart = others.all(|i| points[i].ordinate <= lowest);
    let is_pinned = own.len() >= FEWEST && least < NARROW * largest && falls > PART * of_loads;
    (is_pinned && are_apart).then(|| {
        let lines: Vec<u64> = own.iter().map(|&i| points[i].line).collect();
        WarningKind::PinnedLine.with(format!(
            "{}: on unloading the load falls by {falls:.1e} N, {:.0} % of its range, while the contact radius is within 2 % of \
             the largest one: the contact line seems to stay where it is, as at the beginning of unloading under a larger work \
             of adhesion, and a fit of such points gives wrong values; leave them out, in {}, or fit loading and unloading \
             together with a work of adhesion of its own for each",
            experiment.measurement.name,
            1e2 * falls / of_loads,
            experiment.measurement.numbering.names(&lines)
        ))
    })
}
