//! The parameters that the solver accepts.

use crate::Error;

/// The values of `a/t` that [`solve`](crate::solve()) accepts.
pub const A_OVER_T: [f64; 2] = [1e-6, 1e6];
/// The relative tolerances that [`solve`](crate::solve()) accepts.
pub const TOLERANCE: [f64; 2] = [1e-13, 1e-2];

pub fn check(a_over_t: f64) -> Result<(), Error> {
    Error::check("a_over_t", a_over_t, A_OVER_T)
}
