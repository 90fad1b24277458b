//! Integrals `int_0^tau sigma^m F(sigma) d sigma` of functions known at Gauss's points.
//!
//! `F` is the polynomial through its values at the points `tau_j`. The weight `sigma^m` is taken
//! into the rule, so that integrals over a short way keep their relative accuracy.

use crate::quadrature::GaussLegendre;

/// Polynomials through values at Gauss's points of an interval from 0 to a little beyond the last point.
#[derive(Clone, Debug)]
pub struct Points {
    /// The points, ascending.
    pub at: Vec<f64>,
    /// The factors of the barycentric formula.
    factors: Vec<f64>,
    /// Gauss's rule on `[0, 1]`: points, and for each the values `(2l+1) P_l w` of all degrees `l`.
    rule: Vec<(f64, Vec<f64>)>,
}

impl Points {
    /// Places `count` points up to `last`, which is one of them: a value there needs no extrapolation.
    pub fn new(count: usize, last: f64) -> Self {
        let rule = GaussLegendre::new(count);
        let part = |x: f64| 0.5 * (1.0 + x);
        let end = rule.abscissae.last().map_or(last, |x| last / part(*x));
        let points = rule.abscissae.iter().zip(&rule.weights);
        // The barycentric factors of Gauss's points are `(-1)^j ((1 - x^2) w)^{1/2}`.
        let factor = |(j, (x, w)): (usize, (&f64, &f64))| {
            let size = ((1.0 - x * x) * w).sqrt();
            if j % 2 == 0 { size } else { -size }
        };
        Self {
            at: rule.abscissae.iter().map(|x| end * part(*x)).collect(),
            factors: points.clone().enumerate().map(factor).collect(),
            rule: points
                .map(|(x, w)| (part(*x), legendre_values(count, *x, 0.5 * w)))
                .collect(),
        }
    }

    /// Returns the weights with which the values at the points give the polynomial at `tau`.
    pub fn interpolation(&self, tau: f64) -> Vec<f64> {
        if let Some(j) = self.at.iter().position(|at| *at == tau) {
            return (0..self.at.len()).map(|i| f64::from(i == j)).collect();
        }
        let mut weights: Vec<f64> = self
            .at
            .iter()
            .zip(&self.factors)
            .map(|(at, factor)| factor / (tau - at))
            .collect();
        let sum: f64 = weights.iter().sum();
        weights.iter_mut().for_each(|weight| *weight /= sum);
        weights
    }

    /// Returns, for every point `tau_i` and every one of the `powers` `m > -1`, the weights with
    /// which the values at the points give `tau_i^{-m-1} int_0^{tau_i} sigma^m F d sigma`.
    pub fn integrals<const N: usize>(&self, powers: [f64; N]) -> [Vec<Vec<f64>>; N] {
        let rules = powers.map(|power| {
            let moments = moments(power, self.at.len());
            let weight = |(_, values): &(f64, Vec<f64>)| -> f64 {
                values.iter().zip(&moments).map(|(v, m)| v * m).sum()
            };
            self.rule.iter().map(weight).collect::<Vec<f64>>()
        });
        let mut integrals = [(); N].map(|()| Vec::with_capacity(self.at.len()));
        for tau in &self.at {
            let mut rows = [(); N].map(|()| vec![0.0; self.at.len()]);
            for (k, (u, _)) in self.rule.iter().enumerate() {
                let interpolation = self.interpolation(tau * u);
                for (row, rule) in rows.iter_mut().zip(&rules) {
                    for (sum, weight) in row.iter_mut().zip(&interpolation) {
                        *sum += rule[k] * weight;
                    }
                }
            }
            for (integrals, row) in integrals.iter_mut().zip(rows) {
                integrals.push(row);
            }
        }
        integrals
    }
}

/// Returns `(2l+1) P_l(x) weight` for `l < count`.
fn legendre_values(count: usize, x: f64, weight: f64) -> Vec<f64> {
    let (mut before, mut now) = (0.0, 1.0);
    (0..count)
        .map(|l| {
            let degree = l as f64;
            let value = (2.0 * degree + 1.0) * now * weight;
            (before, now) = (
                now,
                ((2.0 * degree + 1.0) * x * now - degree * before) / (degree + 1.0),
            );
            value
        })
        .collect()
}

/// Returns `int_0^1 u^m P_l(2u - 1) du = m (m-1) .. (m-l+1)/((m+1) .. (m+l+1))` for `l < count`.
fn moments(m: f64, count: usize) -> Vec<f64> {
    let mut moment = 1.0 / (m + 1.0);
    (0..count)
        .map(|l| {
            let value = moment;
            let l = l as f64;
            moment *= (m - l) / (m + l + 2.0);
            value
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::estimate::larger;

    /// Powers with whole and broken exponents, times a smooth function.
    #[test]
    fn integrals_keep_their_relative_accuracy() {
        // At 2 one of the integrals is 0.
        let points = Points::new(24, 1.9);
        let values: Vec<f64> = points
            .at
            .iter()
            .map(|tau| tau.powi(3) - 2.0 * tau)
            .collect();
        let powers = [0.0, 2.0, 3.0, 1.6];
        let integrals = points.integrals(powers);
        let mut worst = 0.0;
        for (power, rows) in powers.into_iter().zip(&integrals) {
            for (tau, row) in points.at.iter().zip(rows) {
                let found: f64 = row.iter().zip(&values).map(|(w, v)| w * v).sum();
                let exact = tau.powi(3) / (power + 4.0) - 2.0 * tau / (power + 2.0);
                worst = larger(worst, (found / exact - 1.0).abs());
            }
        }
        println!("integrals: {worst:.1e}");
        assert!(worst <= 1e-10, "{worst:e}");
    }
}
