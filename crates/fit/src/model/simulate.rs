//! Synthetic data.

use interp::Table;

use crate::{Error, Experiment, Measurement};

/// Makes the measurement that the values of an experiment would give.
///
/// The points of `experiment` say where to measure: their abscissae and directions, in the order of
/// time; their ordinates are not used. A cycle of approach and retract jumps into contact at the
/// contact point, follows the stable branch, is pinned at the turn if the receding work of adhesion
/// is larger, and jumps off at the end of the branch. Points at contact radii are always in contact
/// (a radius of 0 is none). `noise` is the standard deviation of the normal noise that is added to
/// each ordinate; one `seed` always gives one measurement.
///
/// # Errors
/// [`Error::Point`] for an abscissa that is not possible; [`Error::Setting`] for a negative noise;
/// [`Error::Contact`] outside the table.
pub fn simulate(
    _table: &Table,
    _experiment: &Experiment,
    _noise: f64,
    _seed: u64,
) -> Result<Measurement, Error> {
    Err(Error::Nothing("simulation yet"))
}
