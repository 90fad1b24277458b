//! Polynomials through twelve Chebyshev points on an interval, and Gauss's quadrature.

use std::f64::consts::PI;

use interp::once::Lazy;

/// The number of points on an interval.
pub(super) const POINTS: usize = 12;

/// A polynomial on the interval from -1 to 1 by its coefficients of powers.
pub(super) type Polynomial = [f64; POINTS];

/// The points on the interval from -1 to 1, and what belongs to them.
pub(super) struct Points {
    /// The Chebyshev points of the first kind, ascending.
    pub at: [f64; POINTS],
    /// The inverses of the products of the distances of each point from the others.
    weights: [f64; POINTS],
    /// The polynomials that are 1 at their own point and 0 at the others.
    lagrange: [Polynomial; POINTS],
    /// The integral, from -1 to a point, of each of these polynomials.
    pub integrals: [[f64; POINTS]; POINTS],
    /// The same by polynomial: `columns[j][i]` is `integrals[i][j]`.
    pub columns: [[f64; POINTS]; POINTS],
    /// Their integrals from -1 to 1.
    pub whole: [f64; POINTS],
}

pub(super) static CHEBYSHEV: Lazy<Points> = Lazy::new(Points::new);

/// Gauss's points and weights on the interval from -1 to 1.
pub(super) static GAUSS: Lazy<[Vec<[f64; 2]>; 3]> = Lazy::new(|| [gauss(6), gauss(10), gauss(16)]);

impl Points {
    fn new() -> Self {
        let angle = |i: usize| PI * (i as f64 + 0.5) / POINTS as f64;
        let at: [f64; POINTS] = std::array::from_fn(|i| -angle(i).cos());
        let weights = std::array::from_fn(|i| {
            let others = (0..POINTS).filter(|&j| j != i);
            1.0 / others.map(|j| at[i] - at[j]).product::<f64>()
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
            columns: lagrange
                .each_ref()
                .map(|own| at.map(|to| integral(own, to))),
            whole: lagrange.each_ref().map(|own| integral(own, 1.0)),
            at,
            weights,
            lagrange,
        }
    }

    /// Returns the values of the Lagrange polynomials at `t`.
    pub(super) fn basis(&self, t: f64) -> [f64; POINTS] {
        // The products of the distances from the points before and after each point.
        let mut basis = self.weights;
        let (mut before, mut after) = (1.0, 1.0);
        for (value, at) in basis.iter_mut().zip(&self.at) {
            *value *= before;
            before *= t - at;
        }
        for (value, at) in basis.iter_mut().zip(&self.at).rev() {
            *value *= after;
            after *= t - at;
        }
        basis
    }

    /// Returns the integrals of the Lagrange polynomials times `(x/x_i)^power` over `x`, between
    /// `from` and each point `x_i` of the interval, and then its end `to`.
    pub(super) fn weighted(&self, [from, to]: [f64; 2], power: f64) -> [[f64; POINTS]; POINTS + 1] {
        let half = 0.5 * (to - from);
        std::array::from_fn(|i| {
            let end = self.at.get(i).copied().unwrap_or(1.0);
            let length = 0.5 * (end + 1.0);
            let x_end = from + half * (end + 1.0);
            let mut sums = [0.0; POINTS];
            for &[t, weight] in &GAUSS[2] {
                let t = length * (t + 1.0) - 1.0;
                let ratio = (from + half * (t + 1.0)) / x_end;
                let weight = weight * half * length * ratio.powf(power);
                for (sum, own) in sums.iter_mut().zip(self.basis(t)) {
                    *sum += weight * own;
                }
            }
            sums
        })
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
            // The coefficients of the Lagrange polynomials are up to some thousands.
            assert!((value - cube(t)).abs() < 1e-11, "{value} at {t}");
            assert!((slope - 3.0 * t * t).abs() < 1e-10, "{slope} at {t}");
            let basis = CHEBYSHEV.basis(t);
            let sum: f64 = basis
                .iter()
                .zip(values)
                .map(|(own, value)| own * value)
                .sum();
            assert!((sum - cube(t)).abs() < 1e-14);
        }
        let whole = CHEBYSHEV.whole.iter().zip(values);
        assert!((whole.map(|(own, value)| own * value).sum::<f64>() - 2.0).abs() < 1e-11);
        // The integral of `(x/x_i)^4 x^3` from 1 to `x_i`, and to the end 2.
        let weighted = CHEBYSHEV.weighted([1.0, 2.0], 4.0);
        let cubes = CHEBYSHEV.at.map(|t| (1.5 + 0.5 * t).powi(3));
        for (i, weights) in weighted.iter().enumerate() {
            let end = CHEBYSHEV.at.get(i).map_or(2.0, |t| 1.5 + 0.5 * t);
            let sum: f64 = weights
                .iter()
                .zip(cubes)
                .map(|(own, value)| own * value)
                .sum();
            let expected = (end.powi(8) - 1.0) / (8.0 * end.powi(4));
            assert!((sum - expected).abs() < 1e-13, "{sum}, not {expected}");
        }
        for rule in GAUSS.iter() {
            let sum: f64 = rule.iter().map(|[x, weight]| weight * x.powi(6)).sum();
            assert!((sum - 2.0 / 7.0).abs() < 1e-14);
        }
    }
}
