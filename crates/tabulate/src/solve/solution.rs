//! One contact: solves it with one method after the other until the tolerance is reached.

use interp::{Material, Quantities};

use crate::Error;
use crate::solve::domain;
use crate::solve::estimate::{Estimate, larger};
use crate::solve::method::Method;
use crate::solve::symbol::Symbol;

/// The four quantities of one contact, with their estimated error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solution {
    /// `Pi0`, `Eeq`, `Gamma`, `Delta0`, dimensionless.
    pub quantities: Quantities,
    /// Estimated largest relative error of the four: truncation, quadrature and rounding together.
    pub error: f64,
    /// The size of the system of equations: Legendre modes, or real unknowns along a contour; 0 for
    /// the closed form.
    pub modes: usize,
    /// The method that found them.
    pub method: Method,
}

/// Solves the contact of `material` at `a_over_t` to the relative `tolerance`.
///
/// ```
/// # fn main() -> Result<(), tabulate::Error> {
/// let film_on_glass = interp::Material::new(1.75, 0.5, 1e5, 0.25)?;
/// let solution = tabulate::solve(65.0, &film_on_glass, 1e-8)?;
/// assert!(solution.error <= 1e-8);
/// # Ok(()) }
/// ```
///
/// Every material is accepted whose ratios of moduli are numbers, with `a_over_t` in
/// [`A_OVER_T`](crate::solve::A_OVER_T) and `tolerance` in [`TOLERANCE`](crate::solve::TOLERANCE).
///
/// # Errors
/// [`Error::Domain`] for an `a_over_t`, a `tolerance` or a ratio of moduli outside the domain;
/// [`Error::NotConverged`] where double precision does not allow the tolerance.
pub fn solve(a_over_t: f64, material: &Material, tolerance: f64) -> Result<Solution, Error> {
    domain::check(a_over_t, material, tolerance)?;
    let symbol = Symbol::new(material);
    let mut reached = f64::INFINITY;
    for method in Method::candidates(a_over_t, &symbol, tolerance) {
        let Estimate {
            quantities,
            error,
            modes,
        } = method.solve(a_over_t, &symbol, tolerance);
        // A value that underflows has lost its digits.
        let normal = quantities.to_array().into_iter().all(f64::is_normal);
        let error = if normal { error } else { larger(error, 1.0) };
        if error <= tolerance {
            return Ok(Solution {
                quantities,
                error,
                modes,
                method,
            });
        }
        reached = reached.min(error);
    }
    Err(Error::NotConverged {
        a_over_t,
        material: *material,
        tolerance,
        reached,
    })
}
