//! The parameters that the solver accepts: every material, and the values of `a/t` and of the
//! tolerance stated here.
//!
//! [`Material`](interp::Material) holds every positive modulus, a rigid sphere, a rigid substrate, and
//! Poisson ratios in `(-1, 0.5]`. The solver computes with `E1*/E2*`, from 0 to infinity, and with
//! `E1/E0`, from 0 to the largest number. No contrast of moduli is outside the domain: a contact that
//! cannot be told from a limit is answered with the limit, and a tolerance that double precision does
//! not allow is refused with the error that is reached.

use crate::Error;

/// The values of `a/t` that [`solve`](crate::solve()) accepts.
pub const A_OVER_T: [f64; 2] = [1e-6, 1e6];
/// The relative tolerances that [`solve`](crate::solve()) accepts.
pub const TOLERANCE: [f64; 2] = [1e-13, 1e-2];

/// Accepts `a/t` and a tolerance within the domain.
///
/// # Errors
/// [`Error::Domain`] for a value outside.
pub fn check(a_over_t: f64, tolerance: f64) -> Result<(), Error> {
    Error::check("a_over_t", a_over_t, A_OVER_T)?;
    Error::check("tolerance", tolerance, TOLERANCE)
}
