//! One contact: solves it with one method after the other until the tolerance is reached.

use interp::{Material, Quantities};

use crate::Error;
use crate::compliance::symbol::Symbol;
use crate::domain;
use crate::error::of_film;
use crate::estimate::{Estimate, larger};
use crate::method::Method;
use crate::power_law::{self, PowerLaw};

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
/// # fn main() -> Result<(), solve::Error> {
/// let film_on_glass = interp::Material::new(1.75, 0.5, 1e5, 0.25)?;
/// let solution = solve::solve(65.0, &film_on_glass, 1e-8)?;
/// assert!(solution.error <= 1e-8);
/// # Ok(()) }
/// ```
///
/// Every material is accepted whose ratios of moduli are numbers, with `a_over_t` in
/// [`A_OVER_T`](crate::A_OVER_T) and `tolerance` in [`TOLERANCE`](crate::TOLERANCE).
///
/// # Errors
/// [`Error::Domain`] for an `a_over_t`, a `tolerance` or a ratio of moduli outside the domain;
/// [`Error::NotConverged`] where double precision does not allow the tolerance.
pub fn solve(a_over_t: f64, material: &Material, tolerance: f64) -> Result<Solution, Error> {
    solve_power_laws(a_over_t, material, &[], tolerance).map(|(solution, _)| solution)
}

/// Solves the contact of `material` at `a_over_t`, and those of rigid or elastic probes with the
/// profiles `c r^n`, to the relative `tolerance`.
///
/// The `exponents` n need not be integers; each must be within
/// [`EXPONENTS`](crate::EXPONENTS). The power laws come in the order of the exponents. The
/// error and the tolerance are those of all numbers together, so that a power law that is difficult
/// makes the whole solve more expensive.
///
/// At `a/t = 300` a tolerance of 1e-12 is reached (five materials, exponents 4, 6, 8 and 10). On
/// thinner films each further power loses digits. From `a/t = 400` to 1000, on the film of Barthel's
/// Table 1, the smallest tolerance that is reached is 1e-11 for the exponents 1 to 4, 1e-10 for 5
/// and 6, 1e-9 for 8, 1e-7 for 10 and 1e-6 for 12, in powers of ten.
///
/// ```
/// # fn main() -> Result<(), solve::Error> {
/// let film_on_glass = interp::Material::new(1.75, 0.5, 1e5, 0.25)?;
/// let (_, cone) = solve::solve_power_laws(3.0, &film_on_glass, &[1.0], 1e-8)?;
/// println!("delta0 = {} a (pi/2) tan(beta)", cone[0].delta);
/// # Ok(()) }
/// ```
///
/// # Errors
/// As [`solve`], and [`Error::Domain`] for an exponent outside the domain.
pub fn solve_power_laws(
    a_over_t: f64,
    material: &Material,
    exponents: &[f64],
    tolerance: f64,
) -> Result<(Solution, Vec<PowerLaw>), Error> {
    domain::check(a_over_t, material, tolerance)?;
    power_law::check(exponents)?;
    let symbol = Symbol::new(material);
    let mut reached = f64::INFINITY;
    for method in Method::candidates(a_over_t, &symbol, tolerance) {
        let estimate = method.solve(a_over_t, &symbol, exponents, tolerance);
        match estimate.accept(method, tolerance) {
            Ok(accepted) => return Ok(accepted),
            Err(error) => reached = reached.min(error),
        }
    }
    Err(Error::NotConverged {
        a_over_t,
        of: of_film(material),
        tolerance,
        reached,
    })
}

impl Estimate {
    /// Returns the solution and the power laws if the estimated error is at most `tolerance`, and
    /// otherwise that error.
    pub(crate) fn accept(
        self,
        method: Method,
        tolerance: f64,
    ) -> Result<(Solution, Vec<PowerLaw>), f64> {
        // A value that underflows has lost its digits.
        let error = if self.numbers().all(f64::is_normal) {
            self.error
        } else {
            larger(self.error, 1.0)
        };
        if error > tolerance || error.is_nan() {
            return Err(error);
        }
        let solution = Solution {
            quantities: self.quantities,
            error,
            modes: self.modes,
            method,
        };
        Ok((solution, self.power_laws))
    }
}
