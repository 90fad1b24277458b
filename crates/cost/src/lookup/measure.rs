//! The measurement of all rows.

use interp::Table;
use solve::Error;

use super::rows::{Point, Row};
use super::{form, layer};
use crate::Measured;
use crate::clock::Timing;

/// The number of points of the command.
pub const POINTS: usize = 1000;
/// The seed of these points.
pub const SEED: u64 = 1;

/// Measures all rows of a table with all four quantities over `e1_over_e2` and `e0_over_e2`, at `points` of its box.
///
/// A table in low-rank form is measured in this form and expanded. `progress` is called with the
/// number of contacts that have been solved since the last call.
///
/// # Errors
/// Those of the solve and of the lookup.
///
/// # Panics
/// If there are no `points`.
pub fn measure(
    table: &Table,
    points: &[Point],
    timing: Timing,
    progress: &(dyn Fn(usize) + Sync),
) -> Result<Measured<Row>, Error> {
    let mut measured = form::measure(table, points, timing, progress)?;
    measured
        .rows
        .extend(layer::measure(points.len(), timing, progress)?);
    Ok(measured)
}

/// Returns the number of solves that [`measure`] reports.
pub const fn solves(points: usize) -> usize {
    form::solves(points) + layer::solves(points)
}
