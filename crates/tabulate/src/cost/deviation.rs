//! Errors: against what they are measured.

use interp::{Material, Quantities};

use super::clock::median;
use crate::solve::estimate::larger;
use crate::solve::{Solution, solve};

/// The solve at the tightest tolerance that is answered.
///
/// # Errors
/// What [`solve`] says at 1e-9, where none is.
pub fn tightest(a_over_t: f64, material: &Material) -> Result<Solution, crate::Error> {
    let tolerances = [1e-13, 1e-12, 1e-11, 1e-10];
    tolerances
        .iter()
        .find_map(|&tolerance| solve(a_over_t, material, tolerance).ok())
        .map_or_else(|| solve(a_over_t, material, 1e-9), Ok)
}

/// The largest of the four relative deviations, NaN if one is; what is less than half a unit of
/// rounding counts as that.
pub fn deviation(a: &Quantities, b: &Quantities) -> f64 {
    let pairs = a.to_array().into_iter().zip(b.to_array());
    pairs
        .map(|(a, b)| (a / b - 1.0).abs())
        .fold(0.5 * f64::EPSILON, larger)
}

/// The median and the largest of at least one error; NaN is the worst of all.
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
