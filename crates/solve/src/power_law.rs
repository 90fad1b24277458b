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
