//! The doubt about points that are given twice.

use crate::estimate::problem::Problem;
use crate::{Measurement, Warning, WarningKind};

/// Warns of experiments that have the points of one before them: they count twice, and the errors are too
/// small.
pub(crate) fn add(warnings: &mut Vec<Warning>, problem: &Problem<'_>) {
    let measurements = problem.experiments().map(|one| &one.measurement);
    let measurements: Vec<&Measurement> = measurements.collect();
    for (e, one) in measurements.iter().enumerate() {
        if let Some(first) = measurements[..e].iter().find(|first| are_equal(first, one)) {
            warnings.push(WarningKind::SamePoints.with(format!(
                "{}: its {} points are those of {}, so that they count twice and the errors are too \
                 small; leave one of the two out",
                one.name,
                one.points.len(),
                first.name
            )));
        }
    }
}

/// Tells whether two measurements have the same points.
fn are_equal(a: &Measurement, b: &Measurement) -> bool {
    let mut pairs = a.points.iter().zip(&b.points);
    a.kind == b.kind
        && a.points.len() == b.points.len()
        && pairs.all(|(a, b)| (a.abscissa, a.ordinate) == (b.abscissa, b.ordinate))
}
