//! The result of every method of solution, and the distance between two results.

use interp::Quantities;

/// The four quantities with their estimated error, whether that is small enough or not.
#[derive(Clone, Copy, Debug)]
pub struct Estimate {
    /// `Pi0`, `Eeq`, `Gamma`, `Delta0`.
    pub quantities: Quantities,
    /// Estimated largest relative error of the four; infinite where a method has failed.
    pub error: f64,
    /// Legendre modes, or real unknowns along a contour.
    pub modes: usize,
}

impl Estimate {
    /// The result of a method that has failed: NaN, with an infinite error.
    pub const FAILED: Self = Self {
        quantities: Quantities {
            pi0: f64::NAN,
            eeq: f64::NAN,
            gamma: f64::NAN,
            delta0: f64::NAN,
        },
        error: f64::INFINITY,
        modes: 0,
    };
}

/// Returns the largest of the four relative differences; infinite if one is not a number.
pub fn difference(a: &Quantities, b: &Quantities) -> f64 {
    let pairs = a.to_array().into_iter().zip(b.to_array());
    let largest = pairs.map(|(a, b)| (a / b - 1.0).abs()).fold(0.0, larger);
    if largest.is_nan() {
        f64::INFINITY
    } else {
        largest
    }
}

/// Returns the larger of two numbers, NaN if either is NaN.
///
/// `f64::max` drops NaN; an error that is NaN must not pass for a small one.
pub const fn larger(a: f64, b: f64) -> f64 {
    if a.is_nan() || b <= a { a } else { b }
}
