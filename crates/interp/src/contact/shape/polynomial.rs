//! Polynomials through eight Chebyshev points on an interval, and Gauss's quadrature.

use std::f64::consts::PI;

use crate::once::Lazy;

/// The number of points on an interval.
pub(super) const POINTS: usize = 8;

/// A polynomial on the interval from -1 to 1 by its coefficients of powers.
pub(super) type Polynomial = [f64; POINTS];

/// The points on the interval from -1 to 1, and what belongs to them.
pub(super) struct Points {
    /// The Chebyshev points of the first kind, ascending.
    pub at: [f64; POINTS],
    /// The factors of the barycentric formula.
    weights: [f64; POINTS],
    /// The polynomials that are 1 at their own point and 0 at the others.
    lagrange: [Polynomial; POINTS],
    /// The integral, from -1 to a point, of each of these polynomials.
    pub integrals: [[f64; POINTS]; POINTS],
    /// Their integrals from -1 to 1.
    pub whole: [f64; POINTS],
}

pub(super) static CHEBYSHEV: Lazy<Points> = Lazy::new(Points::new);

/// Gauss's points and weights on the interval from -1 to 1.
pub(super) static GAUSS: Lazy<[Vec<[f64; 2]>; 2]> = Lazy::new(|| [gauss(4), gauss(10)]);

impl Points {
    fn new() -> Self {
        let angle = |i: usize| PI * (i as f64 + 0.5) / POINTS as f64;
        let at: [f64; POINTS] = std::array::from_fn(|i| -angle(i).cos());
        let weights = std::array::from_fn(|i| {
            let sign = if i % 2 == 0 { 1.0 } else { -1.0 };
            sign * angle(i).sin()
        });
        let lagrange: [Polynomial; POINTS] = std::array::from_fn(|i| {
            let mut polynomial = [0.0; POINTS];
            polynomial[0] = 1.0;
            for j in (0..POINTS).filter(|&j| j != i) {
                let distance = at[i] - at[j];
                for k in (0..POINTS).rev() {
                    let lower = if k > 0 { polynomial[k - 1] } else { 0.0 };
                    polynomial[k] = (lower - at[j] * polynomial[k]) / distance;
                }
            }
            polynomial
        });
        let integral = |polynomial: &Polynomial, to: f64| {
            let at = |x: f64| {
                let terms = polynomial.iter().enumerate().rev();
                x * terms.fold(0.0, |sum, (k, term)| sum * x + term / (k + 1) as f64)
            };
            at(to) - at(-1.0)
        };
        Self {
            integrals: at.map(|to| lagrange.each_ref().map(|own| integral(own, to))),
            whole: lagrange.each_ref().map(|own| integral(own, 1.0)),
            at,
            weights,
            lagrange,
        }
    }

    /// Returns the values of the Lagrange polynomials at `t`.
    pub(super) fn basis(&self, t: f64) -> [f64; POINTS] {
        if let Some(i) = self.at.iter().position(|&point| point == t) {
            return std::array::from_fn(|k| if k == i { 1.0 } else { 0.0 });
        }
        let terms: [f64; POINTS] = std::array::from_fn(|i| self.weights[i] / (t - self.at[i]));
        let sum: f64 = terms.iter().sum();
        terms.map(|term| term / sum)
    }

    /// Returns the polynomial through values at the points.
    pub(super) fn through(&self, values: &[f64; POINTS]) -> Polynomial {
        std::array::from_fn(|k| (0..POINTS).map(|i| values[i] * self.lagrange[i][k]).sum())
    }
}

/// Returns the value and the derivative of a polynomial.
pub(super) fn evaluate(polynomial: &Polynomial, t: f64) -> [f64; 2] {
    let terms = polynomial.iter().rev();
    terms.fold([0.0; 2], |[value, slope], term| {
        [value * t + term, slope * t + value]
    })
}

/// Returns Gauss's points and weights, by Newton's method on Legendre's polynomial.
fn gauss(count: usize) -> Vec<[f64; 2]> {
    let point = |i: usize| {
        let mut x = -(PI * (i as f64 + 0.75) / (count as f64 + 0.5)).cos();
        let mut slope = 1.0;
        for _ in 0..20 {
            let (mut before, mut value) = (1.0, x);
            for n in 2..=count {
                let n = n as f64;
                (before, value) = (
                    value,
                    ((2.0 * n - 1.0) * x * value - (n - 1.0) * before) / n,
                );
            }
            slope = count as f64 * (x * value - before) / (x * x - 1.0);
            x -= value / slope;
        }
        [x, 2.0 / ((1.0 - x * x) * slope * slope)]
    };
    (0..count).map(point).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polynomials_are_met_and_integrated() {
        let cube = |t: f64| 1.0 + t * t * t;
        let values = CHEBYSHEV.at.map(cube);
        let polynomial = CHEBYSHEV.through(&values);
        for t in [-1.0, CHEBYSHEV.at[2], 0.3, 1.0] {
            let [value, slope] = evaluate(&polynomial, t);
            // The coefficients of the Lagrange polynomials are up to some tens.
            assert!((value - cube(t)).abs() < 1e-13, "{value} at {t}");
            assert!((slope - 3.0 * t * t).abs() < 1e-12, "{slope} at {t}");
            let basis = CHEBYSHEV.basis(t);
            let sum: f64 = basis
                .iter()
                .zip(values)
                .map(|(own, value)| own * value)
                .sum();
            assert!((sum - cube(t)).abs() < 1e-14);
        }
        let whole = CHEBYSHEV.whole.iter().zip(values);
        assert!((whole.map(|(own, value)| own * value).sum::<f64>() - 2.0).abs() < 1e-13);
        for rule in GAUSS.iter() {
            let sum: f64 = rule.iter().map(|[x, weight]| weight * x.powi(6)).sum();
            assert!((sum - 2.0 / 7.0).abs() < 1e-14);
        }
    }
}
