//! Errors: the solve they are measured against, and how they are summed up.

use interp::{Material, Quantities};

use super::clock::median;
use solve::{Error, Solution, larger, solve};

/// Returns the solve at the tightest tolerance from 1e-13 to 1e-9 that is not refused.
///
/// # Errors
/// The error of [`solve()`] at 1e-9, if that is refused, too.
pub fn tightest(a_over_t: f64, material: &Material) -> Result<Solution, Error> {
    let tolerances = [1e-13, 1e-12, 1e-11, 1e-10];
    tolerances
        .iter()
        .find_map(|&tolerance| solve(a_over_t, material, tolerance).ok())
        .map_or_else(|| solve(a_over_t, material, 1e-9), Ok)
}

/// Returns the largest relative deviation of the four quantities of `a` from those of `b`, at least
/// half a unit of rounding. NaN if one deviation is NaN.
pub fn deviation(a: &Quantities, b: &Quantities) -> f64 {
    let pairs = a.to_array().into_iter().zip(b.to_array());
    pairs
        .map(|(a, b)| (a / b - 1.0).abs())
        .fold(0.5 * f64::EPSILON, larger)
}

/// Returns the median and the largest of at least one error. NaN counts as larger than any number.
///
/// # Panics
/// If there is none.
pub fn median_and_largest(errors: Vec<f64>) -> [f64; 2] {
    let largest = errors
        .iter()
        .copied()
        .max_by(f64::total_cmp)
        .expect("there are errors");
    [median(errors), largest]
}
