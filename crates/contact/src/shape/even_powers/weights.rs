//! The weights of the even powers in a shape: the coefficients of `b''` on a piece.

use crate::Validity;
use piecewise::lagrange;

/// The largest number of even powers in `b''`.
pub(super) const MOST_TERMS: usize = 7;

/// The largest ratio of contact radius and sphere radius for which the economised polynomial is
/// accurate, to 1e-6.
pub(crate) const LARGEST_A_OVER_R: f64 = Validity::EXACT_SPHERE_A_OVER_R;

/// The largest `a/R` of a piece for which so many terms of the series of the sphere suffice, to
/// 1e-10.
const FEW_TERMS: [(f64, usize); 6] = [
    (3e-3, 2),
    (0.02, 3),
    (0.05, 4),
    (0.1, 5),
    (0.15, 6),
    (0.19, 7),
];

/// The Chebyshev points of the second kind on `[0, 1]`, `(1 - cos(pi j/6))/2`, and their roots.
const POINTS: [f64; MOST_TERMS] = [
    0.0,
    0.066_987_298_107_780_65,
    0.25,
    0.5,
    0.75,
    0.933_012_701_892_219_4,
    1.0,
];
const ROOTS: [f64; MOST_TERMS] = [
    0.0,
    0.258_819_045_102_520_74,
    0.5,
    0.707_106_781_186_547_5,
    0.866_025_403_784_438_6,
    0.965_925_826_289_068_3,
    1.0,
];

/// A shape whose `b` consists of even powers. Lengths are in units of the film's thickness.
#[derive(Clone, Copy, Debug)]
pub(crate) enum EvenShape {
    /// A sphere of this radius.
    Sphere(f64),
    /// `b = factor s^(2k + 2)`.
    Power {
        /// The factor.
        factor: f64,
        /// Half the exponent, less 1.
        k: usize,
    },
}

/// The coefficients of `b'' = sum_k beta_k s^(2k)` on a piece.
#[derive(Clone, Copy, Debug)]
pub(super) struct Weights {
    pub(super) terms: usize,
    pub(super) beta: [f64; MOST_TERMS],
}

impl EvenShape {
    /// Returns the radius of the paraboloid whose `Pi0` and `Delta0` stand for the results.
    pub(super) const fn unit_radius(self) -> f64 {
        match self {
            Self::Sphere(radius) => radius,
            Self::Power { .. } => 1.0,
        }
    }

    /// Returns the largest contact radius.
    pub(super) const fn largest(self) -> f64 {
        match self {
            Self::Sphere(radius) => LARGEST_A_OVER_R * radius,
            Self::Power { .. } => f64::INFINITY,
        }
    }

    /// Returns the coefficients for contact radii up to `end`, in units of `1/unit` of the
    /// thickness.
    pub(super) fn weights(self, end: f64, unit: f64) -> Weights {
        let mut beta = [0.0; MOST_TERMS];
        match self {
            Self::Power { factor, k } => {
                let n = (2 * k + 2) as f64;
                beta[k] = factor * n * (n - 1.0) / unit.powi(2 * k as i32 + 1);
                Weights { terms: k + 1, beta }
            }
            Self::Sphere(radius) => {
                let radius = radius * unit;
                let alpha = end / radius;
                let few = FEW_TERMS.into_iter().find(|(largest, _)| alpha <= *largest);
                // The coefficients of `R b'/s` as a polynomial in `(s/end)^2`, or `(s/R)^2`.
                let (scale, terms) = if let Some((_, terms)) = few {
                    for (k, beta) in beta.iter_mut().enumerate().take(terms) {
                        *beta = (2 * k + 2) as f64 / (2 * k + 1) as f64;
                    }
                    (radius, terms)
                } else {
                    let end = end.min(Self::Sphere(radius).largest());
                    beta = interpolated(end / radius);
                    (end, MOST_TERMS)
                };
                let (mut power, inverse_square) = (1.0 / radius, 1.0 / (scale * scale));
                for (k, beta) in beta.iter_mut().enumerate() {
                    *beta *= (2 * k + 1) as f64 * power;
                    power *= inverse_square;
                }
                Weights { terms, beta }
            }
        }
    }
}

/// The coefficients of the polynomials that are 1 at one of [`POINTS`] and 0 at the others.
static LAGRANGE: [[f64; MOST_TERMS]; MOST_TERMS] = lagrange(&POINTS);

/// Returns the coefficients of the polynomial in `u` that equals `R b'/s = artanh(v)/v + 1/(1 -
/// v^2)`, `v = alpha sqrt(u)`, at the Chebyshev points of the second kind on `0 <= u <= 1`.
fn interpolated(alpha: f64) -> [f64; MOST_TERMS] {
    // The value at 0 is 2.
    let mut coefficients = LAGRANGE[0].map(|coefficient| 2.0 * coefficient);
    for j in 1..MOST_TERMS {
        let v = alpha * ROOTS[j];
        // Faster than `atanh`, and as accurate, because `v` is not small.
        let artanh = 0.5 * ((1.0 + v) / (1.0 - v)).ln();
        let value = artanh / v + 1.0 / ((1.0 - v) * (1.0 + v));
        for (sum, coefficient) in coefficients.iter_mut().zip(&LAGRANGE[j]) {
            *sum += value * coefficient;
        }
    }
    coefficients
}

/// Returns the weights of the derivative of a shape with respect to the logarithm of all its
/// lengths, `b - s b'`.
pub(super) fn dilated(mut weights: Weights) -> Weights {
    for (k, beta) in weights.beta.iter_mut().enumerate() {
        *beta *= -((2 * k + 1) as f64);
    }
    weights
}
