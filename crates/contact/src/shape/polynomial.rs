//! Polynomials through twelve Chebyshev points on an interval.

use std::f64::consts::PI;

use interp::once::Lazy;
use piecewise::lagrange;

/// The number of points on an interval.
pub(super) const POINTS: usize = 12;

/// The points on the interval from -1 to 1, and what belongs to them.
pub(super) struct Points {
    /// The Chebyshev points of the first kind, ascending.
    pub at: [f64; POINTS],
    /// The inverses of the products of the distances of each point from the others.
    weights: [f64; POINTS],
    /// The integral, from -1 to a point, of each polynomial that is 1 at its own point and 0 at the
    /// others.
    pub integrals: [[f64; POINTS]; POINTS],
    /// The same by polynomial: `columns[j][i]` is `integrals[i][j]`.
    pub columns: [[f64; POINTS]; POINTS],
    /// Their integrals from -1 to 1.
    pub whole: [f64; POINTS],
}

pub(super) static CHEBYSHEV: Lazy<Points> = Lazy::new(Points::new);

impl Points {
    fn new() -> Self {
        let angle = |i: usize| PI * (i as f64 + 0.5) / POINTS as f64;
        let at: [f64; POINTS] = std::array::from_fn(|i| -angle(i).cos());
        let weights = std::array::from_fn(|i| {
            let others = (0..POINTS).filter(|&j| j != i);
            1.0 / others.map(|j| at[i] - at[j]).product::<f64>()
        });
        let lagrange = lagrange(&at);
        let integral = |polynomial: &[f64; POINTS], to: f64| {
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
        }
    }

    /// Returns the values of the Lagrange polynomials at `t`.
    #[inline]
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
}

/// Returns the coordinates of the points on an interval.
pub(super) fn points_on([from, to]: [f64; 2]) -> [f64; POINTS] {
    CHEBYSHEV.at.map(|t| 0.5 * ((from + to) + (to - from) * t))
}

/// Returns the values of the Lagrange polynomials of the points on an interval.
#[inline]
pub(super) fn basis_on([from, to]: [f64; 2], x: f64) -> [f64; POINTS] {
    CHEBYSHEV.basis((2.0 * x - from - to) / (to - from))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polynomials_are_met_and_integrated() {
        let cube = |x: f64| 1.0 + x * x * x;
        let values = points_on([1.0, 2.0]).map(cube);
        let sum = |weights: &[f64; POINTS]| -> f64 {
            let terms = weights.iter().zip(values);
            terms.map(|(own, value)| own * value).sum()
        };
        for x in [1.0, 1.3, 2.0] {
            assert!((sum(&basis_on([1.0, 2.0], x)) - cube(x)).abs() < 1e-13);
        }
        // The integral is `x + x^4/4`; half of the interval's length is a factor.
        let from_1_to = |x: f64| x - 1.0 + 0.25 * (x.powi(4) - 1.0);
        for (weights, x) in CHEBYSHEV.integrals.iter().zip(points_on([1.0, 2.0])) {
            assert!((0.5 * sum(weights) - from_1_to(x)).abs() < 1e-11);
        }
        assert!((0.5 * sum(&CHEBYSHEV.whole) - from_1_to(2.0)).abs() < 1e-11);
    }
}
