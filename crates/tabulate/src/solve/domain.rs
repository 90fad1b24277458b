//! The parameters that the solver accepts.

use interp::Material;

use crate::Error;

/// The values of `a/t` that [`solve`](crate::solve()) accepts.
pub const A_OVER_T: [f64; 2] = [1e-6, 1e6];
/// The values of `E1/E2*` that [`solve`](crate::solve()) accepts, besides 0.
pub const E1_OVER_E2: [f64; 2] = [1e-300, 1e300];
/// The values of `E0/E2*` that [`solve`](crate::solve()) accepts, besides infinity.
pub const E0_OVER_E2: [f64; 2] = [1e-300, 1e300];
/// The relative tolerances that [`solve`](crate::solve()) accepts.
pub const TOLERANCE: [f64; 2] = [1e-13, 1e-2];

/// Accepts a contact within the domain.
///
/// # Errors
/// [`Error::Domain`] for a contact outside.
pub fn check(a_over_t: f64, material: &Material) -> Result<(), Error> {
    Error::check("a_over_t", a_over_t, A_OVER_T)?;
    if material.e1_over_e2() != 0.0 {
        Error::check("e1_over_e2", material.e1_over_e2(), E1_OVER_E2)?;
    }
    if material.e0_over_e2() != f64::INFINITY {
        Error::check("e0_over_e2", material.e0_over_e2(), E0_OVER_E2)?;
    }
    Ok(())
}
