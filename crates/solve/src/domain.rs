//! The parameters that the solver accepts: every material whose ratios of moduli are numbers, and
//! the values of `a/t` and of the tolerance stated here.
//!
//! [`Material`] holds every positive modulus, a rigid sphere, a rigid substrate, and Poisson ratios
//! in `(-1, 0.5]`. The solver computes with `E1*/E2*`, from 0 to infinity, and with `E1/E0`, from 0
//! on. No contrast of moduli is outside the domain but for under- and overflow: a contact that
//! cannot be told from a limit is answered with the limit, and a tolerance that double precision
//! does not allow is refused with the error that is reached.

use interp::{Material, Normalisation};

use crate::Error;

/// The values of `a/t` that [`solve`](crate::solve()) accepts.
pub const A_OVER_T: [f64; 2] = [1e-6, 1e6];
/// The relative tolerances that [`solve`](crate::solve()) accepts.
pub const TOLERANCE: [f64; 2] = [1e-13, 1e-2];

/// The values of `E1*/E2*` that are neither 0 nor infinite and have all their digits.
const E1_OVER_E2: [f64; 2] = [f64::MIN_POSITIVE, f64::MAX];
/// The values of `E1/E0`. For larger ones the powers of `(E0/E1)^{1/3}` in the compliance of the
/// film on its substrate underflow.
const E1_OVER_E0: [f64; 2] = [0.0, 1e200];

/// Accepts a contact and a tolerance within the domain.
///
/// # Errors
/// [`Error::Domain`] for a value outside.
pub fn check(a_over_t: f64, material: &Material, tolerance: f64) -> Result<(), Error> {
    Error::check("a_over_t", a_over_t, A_OVER_T)?;
    Error::check("tolerance", tolerance, TOLERANCE)?;
    if material.normalisation() == Normalisation::Sphere {
        Error::check("E1*/E2*", material.film_modulus(), E1_OVER_E2)?;
    }
    Error::check("E1/E0", material.film_over_substrate(), E1_OVER_E0)
}
