//! The fit.

use interp::Table;

use crate::{Error, Experiment, Fit, Free, Options};

/// Finds the free parameters of one or several experiments.
///
/// The first experiment's values are the starts of shared parameters that do not start from the
/// data. The fit is deterministic and uses one thread; curves of a map can be fitted side by side,
/// since `table` may be shared among threads.
///
/// # Errors
/// [`Error`] for points, parameters or options that cannot be used. A fit that does not converge is
/// no error: see [`Fit::converged`].
pub fn fit(
    _table: &Table,
    _experiments: &[Experiment],
    _free: &[Free],
    _options: &Options,
) -> Result<Fit, Error> {
    Err(Error::Nothing("solver yet"))
}
