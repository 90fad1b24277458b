//! What an experiment would tell, before it is made.

use interp::Table;

use crate::{Error, Experiment, Forecast, Free};

/// Computes the standard errors that a planned experiment would give.
///
/// The values of the experiments are taken for the truth, the abscissae of their points for those to
/// be measured; the ordinates are not used. Each experiment needs its noise. The errors are those of
/// least squares, from the derivatives of the model at the truth.
///
/// # Errors
/// As [`fit`](crate::fit); [`Error::Setting`] without a noise.
pub fn forecast(
    _table: &Table,
    _experiments: &[Experiment],
    _free: &[Free],
) -> Result<Forecast, Error> {
    Err(Error::Nothing("forecast yet"))
}
