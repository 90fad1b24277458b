//! The quantities on a thick film from `Gamma` alone: where the integrals over `a/t` begin.
//!
//! The kernel is even and smooth. Up to the third order in `x = a/t` it is
//!
//! ```text
//! k(x (rho - s)) + k(x (rho + s)),  times es x/e1  =  alpha + beta (rho^2 + s^2)
//! ```
//!
//! with `alpha` proportional to `x` and `beta` to `x^3`, two numbers of the material; the next term
//! is of the fifth order. With this kernel the equations for `g1` and `g2` are two linear equations
//! for two moments each. Their solution, exact in `alpha` and to first order in `u = 2/3 beta`, is
//!
//! ```text
//! es/Eeq = 1 + alpha + u           es/Gamma = (1 + alpha + u) (1 + u)
//! Delta0 = 1 + 2/3 alpha (1 + u) + 6/5 u        Pi0 = 8/3 es (1 + u)
//! ```
//!
//! It is exact in `alpha` because a film that is much stiffer than its substrate has an `alpha` of
//! 1e5 and more at `x = 1e-3`; its `beta` is small there.
//!
//! `Gamma` at `x` and `2x` gives `alpha` and `u`. A relative error `e` of `Gamma` becomes at most
//! `5/4 e` of `Eeq`, `4/3 e` of `Delta0` and `1/4 e` of `Pi0`.

/// The values of `a/t`, over the first one, at which `Gamma` is needed. The last one only tests the
/// result.
pub(crate) const MULTIPLES: [f64; 3] = [1.0, 2.0, 4.0];

/// The quantities at the first `a/t`, with an estimate of their error.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ThickFilm {
    alpha: f64,
    u: f64,
    /// `es/Gamma` at the first two points.
    compliances: [f64; 2],
    /// The estimated relative error of the quantities; NaN if `Gamma` is not that of a thick film.
    pub(crate) error: f64,
}

impl ThickFilm {
    /// Finds the two numbers of the material from `Gamma/es` at the [`MULTIPLES`] of the first
    /// `a/t`.
    ///
    /// The error is estimated from the last one. A term `c x^5` that is left out of `es/Gamma`
    /// makes a difference of `720 c` there (`743 c` if `alpha` is large), and at the first `a/t`
    /// errors up to `4 c`. The estimate is a hundredth of the difference, which is at least 1.8
    /// times as much.
    pub(crate) fn new(gamma: [f64; 3]) -> Self {
        let [first, second, third] = gamma.map(|gamma| 1.0 / gamma);
        let u = (second - 2.0 * first + 1.0) / (14.0 * first - 2.0);
        let alpha = first / (1.0 + u) - 1.0 - u;
        let expected = (1.0 + 4.0 * alpha + 64.0 * u) * (1.0 + 64.0 * u);
        Self {
            alpha,
            u,
            compliances: [first, second],
            error: 0.01 * (expected / third - 1.0).abs(),
        }
    }

    /// Returns `Eeq/es`, `Delta0` and `Pi0/es`.
    pub(crate) fn values(&self) -> [f64; 3] {
        let Self { alpha, u, .. } = *self;
        [
            1.0 / (1.0 + alpha + u),
            1.0 + 2.0 / 3.0 * alpha * (1.0 + u) + 1.2 * u,
            8.0 / 3.0 * (1.0 + u),
        ]
    }

    /// Returns the derivatives of these three, from those of `ln(Gamma/es)` at the first two
    /// points.
    pub(crate) fn derivatives(&self, gamma: [f64; 2]) -> [f64; 3] {
        let Self { alpha, u, .. } = *self;
        let [first, second] = self.compliances;
        let (by_first, by_second) = (-first * gamma[0], -second * gamma[1]);
        let by_u = (by_second - 2.0 * by_first - 14.0 * u * by_first) / (14.0 * first - 2.0);
        let by_alpha = (by_first - first / (1.0 + u) * by_u) / (1.0 + u) - by_u;
        let eeq = 1.0 / (1.0 + alpha + u);
        [
            -eeq * eeq * (by_alpha + by_u),
            2.0 / 3.0 * (by_alpha * (1.0 + u) + alpha * by_u) + 1.2 * by_u,
            8.0 / 3.0 * by_u,
        ]
    }
}
