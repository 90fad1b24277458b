//! Probes whose profile is a power of the radius, `f(r) = c r^n`.
//!
//! `Eeq` and `Gamma` do not depend on the profile. With `b(s) = s int_0^s f'(r)/sqrt(s^2 - r^2) dr`,
//! which is `c kappa_n s^n` for `c r^n`, the contact is the integral equation `A g = delta - b`, and
//! with `A g1 = 1` and `A g_n = rho^n` on `[0, 1]` the contact without adhesion (`g(1) = 0`) has
//!
//! ```text
//! kappa_n = sqrt(pi) Gammafunction(n/2 + 1)/Gammafunction((n + 1)/2)
//! delta0  = c kappa_n a^n Delta_n                   Delta_n = g_n(1)/Gamma
//! F0      = c kappa_n a^{n+1} (E2*/2) Pi_n          Pi_n    = 4 (Delta_n Eeq - mu_n),    mu_n = int_0^1 g_n
//! ```
//!
//! `n = 2`, `c = 1/2R` are the paraboloid's `Delta0` and `Pi0`. Profiles add: `delta0` and `F0` are
//! linear in `f`.
//!
//! For even `n` the right-hand sides are finite sums of Legendre polynomials. Any other `n` has a
//! kink in some derivative at the centre, and its sum has no end. For a cone Galerkin's method takes
//! up to 1.8 times as many modes as for a paraboloid: 8, 15 and 25 instead of 8, 11 and 14 for
//! tolerances of 1e-4, 1e-6 and 1e-8 on the film of Barthel's Table 1 at `a/t = 10`.

use crate::Error;

/// The exponents that [`solve_power_laws`](crate::solve_power_laws) accepts.
pub const EXPONENTS: [f64; 2] = [0.1, 20.0];

/// The adhesionless contact of the profile `c r^n`, dimensionless.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PowerLaw {
    /// The exponent `n`.
    pub exponent: f64,
    /// The load `Pi_n = 2 F0/(c kappa_n a^{n+1} E*)`, `E*` being the modulus that normalises
    /// `Pi0`. For film = substrate it is `4 n es/(n + 1)`.
    pub pi: f64,
    /// The penetration `Delta_n = delta0/(c kappa_n a^n)`, 1 for film = substrate.
    pub delta: f64,
}

impl PowerLaw {
    /// Returns the contact on a homogeneous half-space, with the compound modulus `modulus`:
    /// Sneddon's `F = 2 E* a delta n/(n + 1)`.
    pub(crate) fn homogeneous(exponent: f64, modulus: f64) -> Self {
        Self {
            exponent,
            pi: 4.0 * modulus / (1.0 + 1.0 / exponent),
            delta: 1.0,
        }
    }
}

/// Accepts exponents within [`EXPONENTS`].
///
/// # Errors
/// [`Error::Domain`] for any other.
pub(crate) fn check(exponents: &[f64]) -> Result<(), Error> {
    let accept = |&exponent: &f64| Error::check("exponent", exponent, EXPONENTS);
    exponents.iter().try_for_each(accept)
}

/// Returns the coefficients of `rho^n` in the orthonormal basis `sqrt(4m+1) P_2m` on `[0, 1]`.
///
/// `c_0 = 1/(n+1)` and `c_{m+1}/c_m = sqrt((4m+5)/(4m+1)) (n-2m)/(n+2m+3)`, by Rodrigues' formula
/// and integration by parts.
pub(crate) fn coefficients(exponent: f64, modes: usize) -> impl Iterator<Item = f64> {
    (0..modes).scan(1.0 / (exponent + 1.0), move |next, m| {
        let (value, m) = (*next, m as f64);
        *next *= ((4.0 * m + 5.0) / (4.0 * m + 1.0)).sqrt() * (exponent - 2.0 * m)
            / (exponent + 2.0 * m + 3.0);
        Some(value)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `int_0^1 rho^n sqrt(5) P_2 = sqrt(5) n/((n + 1)(n + 3))`, and Parseval's
    /// `sum c_m^2 = int_0^1 rho^2n = 1/(2n + 1)`.
    #[test]
    fn coefficients_of_powers_are_exact() {
        for n in [0.5_f64, 1.0, 2.0, 3.0, 4.0, 7.3, 20.0] {
            let c: Vec<f64> = coefficients(n, 4000).collect();
            let second = 5_f64.sqrt() * n / ((n + 1.0) * (n + 3.0));
            assert!((c[1] / second - 1.0).abs() < 1e-14, "{n}: {}", c[1]);
            let squares: f64 = c.iter().map(|c| c * c).sum();
            // The terms left out fall like `m^{-2n-2}`, and their sum like `m^{-2n-1}`.
            let left_out = 1e-14 + 4000_f64.powf(-2.0 * n - 1.0);
            assert!(
                (squares * (2.0 * n + 1.0) - 1.0).abs() < left_out,
                "{n}: {squares}"
            );
        }
        let even: Vec<f64> = coefficients(4.0, 6).collect();
        assert_eq!(even[3..], [0.0; 3]);
    }
}
