//! The polynomials in which a low-rank form expands the logarithms along an axis.
//!
//! They are the Chebyshev polynomials `T_k` between the ends of a tile, with factors: an error of
//! one unit in a number of high degree changes derivatives more than one of low degree, and
//! therefore has a smaller factor.

use std::f64::consts::SQRT_2;

/// The degree from which the factors fall, for each dimension: `a/t`, the modulus of the film, its
/// Poisson ratio, the modulus of the substrate. The derivative with respect to the Poisson ratio of
/// nearly incompressible films is the one that errors change most.
const SMOOTH_DEGREE: [f64; 4] = [40.0, 20.0, 2.0, 20.0];

/// Returns the weight of degree `k` along a dimension: `(1 + (k/s)^2)^(1/2)`, where `s` is 40 for
/// `a/t`, 20 for the moduli, and 2 for `nu1`.
pub fn smoothness(dimension: usize, k: usize) -> f64 {
    (k as f64 / SMOOTH_DEGREE[dimension]).hypot(1.0)
}

/// Returns the first `count` polynomials at `u`: 1, and `2^(1/2) T_k(t) / w_k` for the degrees `k`
/// from 1 on, with the [weights](smoothness) `w_k`.
///
/// `t` is -1 and 1 at the `ends`. Over the angle `arccos(t)` the polynomials are orthogonal, and
/// the mean of their squares is `1 / w_k^2`.
pub fn polynomials(dimension: usize, count: usize, [from, to]: [f64; 2], u: f64) -> Vec<f64> {
    let length = to - from;
    let t = if length > 0.0 {
        (u - from - (to - u)) / length
    } else {
        0.0
    };
    let [mut before, mut present] = [t, 1.0];
    (0..count)
        .map(|k| {
            let value = present;
            (before, present) = (present, 2.0 * t * present - before);
            if k == 0 {
                value
            } else {
                SQRT_2 * value / smoothness(dimension, k)
            }
        })
        .collect()
}

/// Returns the linear map from the values of a function at the [points](points) to its coefficients
/// in the first `count` [polynomials]: a row for each coefficient.
pub fn transform(dimension: usize, count: usize) -> Vec<Vec<f64>> {
    let row = |k: usize| {
        let angle = |i: usize| k as f64 * std::f64::consts::PI * (i as f64 + 0.5) / count as f64;
        let factor = if k == 0 { 1.0 } else { SQRT_2 };
        let factor = factor * smoothness(dimension, k) / count as f64;
        (0..count).map(|i| factor * angle(i).cos()).collect()
    };
    (0..count).map(row).collect()
}

/// Returns the `count` points where `T_count` is 0, from the last to the first.
pub fn points(count: usize, [from, to]: [f64; 2]) -> Vec<f64> {
    let point = |i: usize| {
        let angle = std::f64::consts::PI * (i as f64 + 0.5) / count as f64;
        0.5 * (from + to) + 0.5 * (to - from) * angle.cos()
    };
    (0..count).map(point).collect()
}
