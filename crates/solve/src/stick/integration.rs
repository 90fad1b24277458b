//! Integrals `int_0^tau sigma^m F(sigma) d sigma` of functions known at Gauss's points.
//!
//! `F` is the polynomial through its values at the points `tau_j`, in Legendre polynomials. With `x` from -1
//! to 1 in place of `tau`, and `u = sigma/tau`,
//!
//! ```text
//! I_l = int_0^1 u^m P_l du        (l+m+1) I_l = (m+1-l) I_{l-1} + P_l(x) - P_{l-1}(x),        I_0 = 1/(m+1)
//! ```
//!
//! from `(1+x) (P_l' - P_{l-1}') = l (P_l + P_{l-1})`, by parts. The recurrence does not magnify errors, and
//! integrals over a short way keep their relative accuracy.

use faer::{Mat, Par};

use crate::galerkin::quadrature::{GaussLegendre, legendre};

/// Polynomials through values at Gauss's points of an interval from 0 to a little beyond the last point.
#[derive(Clone, Debug)]
pub struct Points {
    /// The points, ascending.
    pub at: Vec<f64>,
    /// The factors of the barycentric formula.
    factors: Vec<f64>,
    /// The points as abscissae `x` of the rule.
    abscissae: Vec<f64>,
    /// `(l + 1/2) P_l(x_j) w_j` in row `j` and column `l`: the coefficients of Legendre's polynomials.
    coefficients: Mat<f64>,
}

impl Points {
    /// Places `count` points up to `last`, which is one of them: a value there needs no extrapolation.
    pub fn new(count: usize, last: f64) -> Self {
        let GaussLegendre {
            abscissae, weights, ..
        } = GaussLegendre::new(count);
        let part = |x: f64| 0.5 * (1.0 + x);
        let end = abscissae.last().map_or(last, |x| last / part(*x));
        // The barycentric factors of Gauss's points are `(-1)^j ((1 - x^2) w)^{1/2}`.
        let factor = |(j, (x, w)): (usize, (&f64, &f64))| {
            let size = ((1.0 - x * x) * w).sqrt();
            if j % 2 == 0 { size } else { -size }
        };
        let mut coefficients = Mat::zeros(count, count);
        for (j, (x, weight)) in abscissae.iter().zip(&weights).enumerate() {
            for (l, value) in legendre(*x).take(count).enumerate() {
                coefficients[(j, l)] = (l as f64 + 0.5) * value * weight;
            }
        }
        Self {
            at: abscissae.iter().map(|x| end * part(*x)).collect(),
            factors: abscissae
                .iter()
                .zip(&weights)
                .enumerate()
                .map(factor)
                .collect(),
            abscissae,
            coefficients,
        }
    }

    /// Returns the weights with which the values at the points give the polynomial at `tau`.
    pub fn interpolation(&self, tau: f64) -> Vec<f64> {
        interpolation(&self.at, &self.factors, tau)
    }

    /// Returns, in column `i`, the weights with which the values at the points give
    /// `tau_i^{-m-1} int_0^{tau_i} sigma^m F d sigma`, for a `power` `m > -1`.
    pub fn integrals(&self, power: f64) -> Mat<f64> {
        let count = self.at.len();
        let mut moments = Mat::zeros(count, count);
        for (i, x) in self.abscissae.iter().enumerate() {
            let moments = moments.col_as_slice_mut(i);
            let (mut moment, mut before) = (0.0, 0.0);
            for ((l, value), place) in legendre(*x).enumerate().zip(moments) {
                let l = l as f64;
                moment = ((power + 1.0 - l) * moment + value - before) / (power + 1.0 + l);
                before = value;
                *place = moment;
            }
        }
        let mut integrals = Mat::zeros(count, count);
        faer::linalg::matmul::matmul(
            integrals.as_mut(),
            faer::Accum::Replace,
            self.coefficients.as_ref(),
            moments.as_ref(),
            1.0,
            Par::Seq,
        );
        integrals
    }
}

/// Returns the weights with which values at `nodes` give the polynomial through them at a place, by the barycentric
/// formula with the `factors` of the nodes (Berrut and Trefethen, SIAM Review 46, 501, 2004).
pub fn interpolation(nodes: &[f64], factors: &[f64], place: f64) -> Vec<f64> {
    if let Some(j) = nodes.iter().position(|node| *node == place) {
        return (0..nodes.len()).map(|i| f64::from(i == j)).collect();
    }
    let terms = nodes.iter().zip(factors);
    let mut weights: Vec<f64> = terms
        .map(|(node, factor)| factor / (place - node))
        .collect();
    let sum: f64 = weights.iter().sum();
    weights.iter_mut().for_each(|weight| *weight /= sum);
    weights
}
