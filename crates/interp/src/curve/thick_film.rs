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

use crate::Material;

/// The values of `a/t`, over the first one, at which `Gamma` is needed. The last one only tests the
/// result.
pub(crate) const MULTIPLES: [f64; 3] = [1.0, 2.0, 4.0];

/// The largest first `a/t`. The series of the kernel converges for `a/t` below 1, and beyond this
/// value its first terms do not allow an estimate of the others.
pub(crate) const LARGEST: f64 = 0.4;

/// The largest error of `Gamma` that the fifth order can make at `a_over_t`, below 1: a bound that
/// holds for every film, where an estimate from values at nodes may vanish by accident.
///
/// The fourth power of the distance has the coefficient `1/(24 pi) int (X - 1) q^4 dq` in the
/// kernel, between -0.37 and 0.56 for all Poisson ratios and all ratios of moduli, and whatever lies
/// below the film: `X` is between those on a rigid substrate and on none. Its effect on
/// `es/Gamma` is `6.4 x^5 es/e1` times that, `3.6 x^5 es/e1` at most; 4 allows for higher orders.
pub(crate) fn fifth_order(material: &Material, a_over_t: f64) -> f64 {
    4.0 * a_over_t.powi(5) * material.sphere_film_modulus() / material.film_modulus()
}

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
    /// errors up to `4 c`. The estimate is a fiftieth of the difference, to allow for the terms
    /// after that one: errors are 0.17 of it at small `a/t` and 0.7 at the [`LARGEST`] (measured by
    /// `tests/truth/derived.rs`).
    pub(crate) fn new(gamma: [f64; 3]) -> Self {
        let [first, second, third] = gamma.map(|gamma| 1.0 / gamma);
        let u = (second - 2.0 * first + 1.0) / (14.0 * first - 2.0);
        let alpha = first / (1.0 + u) - 1.0 - u;
        let expected = (1.0 + 4.0 * alpha + 64.0 * u) * (1.0 + 64.0 * u);
        Self {
            alpha,
            u,
            compliances: [first, second],
            error: 0.02 * (expected / third - 1.0).abs(),
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

#[cfg(test)]
mod tests {
    use super::*;

    /// `Gamma/es`, `Eeq/es`, `Delta0` and `Pi0/es` of the kernel `alpha + beta (rho^2 + s^2)`: the
    /// exact solution of the two equations for the moments `<1, g>` and `<rho^2, g>`.
    fn of_kernel(alpha: f64, beta: f64) -> [f64; 4] {
        // g = f - (alpha + beta rho^2) m0 - beta m2, for f = 1 and f = rho^2.
        let moments = |[f0, f2]: [f64; 2]| {
            let (a, b) = (1.0 + alpha + beta / 3.0, beta);
            let (c, d) = (alpha / 3.0 + beta / 5.0, 1.0 + beta / 3.0);
            let determinant = a * d - b * c;
            [
                (d * f0 - b * f2) / determinant,
                (a * f2 - c * f0) / determinant,
            ]
        };
        let edge = |[m0, m2]: [f64; 2]| 1.0 - (alpha + beta) * m0 - beta * m2;
        let (punch, parabola) = (moments([1.0, 1.0 / 3.0]), moments([1.0 / 3.0, 0.2]));
        let delta0 = edge(parabola) / edge(punch);
        let pi0 = 4.0 * (delta0 * punch[0] - parabola[0]);
        [edge(punch), punch[0], delta0, pi0]
    }

    fn thick_film(alpha: f64, beta: f64) -> ThickFilm {
        ThickFilm::new(MULTIPLES.map(|m| of_kernel(m * alpha, m.powi(3) * beta)[0]))
    }

    #[test]
    fn the_quantities_are_those_of_the_kernel() {
        for alpha in [-1e-3, 0.0, 0.1, 30.0, 1e5] {
            for beta in [-1e-6, 1e-8, 1e-6] {
                let [_, exact @ ..] = of_kernel(alpha, beta);
                let found = thick_film(alpha, beta);
                for (found, exact) in found.values().into_iter().zip(exact) {
                    // The edge value of a large `alpha` is a difference of numbers near 1.
                    let rounding = 1e-15 * (1.0 + alpha);
                    let left_out = 20.0 * beta * beta;
                    assert!(
                        (found / exact - 1.0).abs() <= rounding + left_out,
                        "{alpha:e}, {beta:e}: {found}, not {exact}"
                    );
                }
                assert!(
                    found.error <= 1e-15 * (1.0 + alpha) + 1e4 * beta * beta,
                    "{found:?}"
                );
            }
        }
    }

    #[test]
    fn an_error_of_gamma_is_damped() {
        const ERROR: f64 = 1e-9;
        for alpha in [-1e-3, 0.1, 30.0] {
            let gamma = MULTIPLES.map(|m| of_kernel(m * alpha, 0.0)[0]);
            let exact = ThickFilm::new(gamma).values();
            for signs in [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0]] {
                let [first, second] = [0, 1].map(|i| gamma[i] * (1.0 + signs[i] * ERROR));
                let found = ThickFilm::new([first, second, gamma[2]]).values();
                for (found, exact) in found.into_iter().zip(exact) {
                    assert!(
                        (found / exact - 1.0).abs() < 1.5 * ERROR,
                        "{alpha}, {signs:?}"
                    );
                }
            }
        }
    }

    #[test]
    fn derivatives_are_differences() {
        for (alpha, beta) in [(0.1, 1e-4), (-0.01, -1e-3), (30.0, 1e-5)] {
            let gamma = MULTIPLES.map(|m| of_kernel(m * alpha, m.powi(3) * beta)[0]);
            let change = [0.7, -0.4];
            let at = |step: f64| {
                let [first, second] = [0, 1].map(|i| gamma[i] * (step * change[i]).exp());
                ThickFilm::new([first, second, gamma[2]]).values()
            };
            let (before, after) = (at(-1e-6), at(1e-6));
            let found = ThickFilm::new(gamma).derivatives(change);
            for i in 0..3 {
                let expected = (after[i] - before[i]) / 2e-6;
                assert!(
                    (found[i] / expected - 1.0).abs() < 1e-7,
                    "{found:?}, not {expected}"
                );
            }
        }
    }
}
