//! The polynomials in which a train expands functions along an axis.
//!
//! They are the Chebyshev polynomials `T_k` between the ends of the axis, with factors: an error of
//! one unit in a number of high degree changes derivatives more than one of low degree, and
//! therefore has a smaller factor.

use std::f64::consts::SQRT_2;

/// Returns the weight of degree `k`: `(1 + (k/s)^2)^(1/2)`, where `s` is `smooth_degree`, the degree
/// from which the factors of the polynomials fall.
pub fn smoothness(smooth_degree: f64, k: usize) -> f64 {
    (k as f64 / smooth_degree).hypot(1.0)
}

/// Returns the first `count` polynomials at `u`: 1, and `2^(1/2) T_k(t) / w_k` for the degrees `k`
/// from 1 on, with the [weights](smoothness) `w_k`.
///
/// `t` is -1 and 1 at the `ends`. Over the angle `arccos(t)` the polynomials are orthogonal, and
/// the mean of their squares is `1 / w_k^2`.
pub fn polynomials(smooth_degree: f64, count: usize, [from, to]: [f64; 2], u: f64) -> Vec<f64> {
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
                SQRT_2 * value / smoothness(smooth_degree, k)
            }
        })
        .collect()
}

/// Returns the linear map from the values of a function at the [points] to its coefficients
/// in the first `count` [polynomials]: a row for each coefficient.
pub fn transform(smooth_degree: f64, count: usize) -> Vec<Vec<f64>> {
    let row = |k: usize| {
        let angle = |i: usize| k as f64 * std::f64::consts::PI * (i as f64 + 0.5) / count as f64;
        let factor = if k == 0 { 1.0 } else { SQRT_2 };
        let factor = factor * smoothness(smooth_degree, k) / count as f64;
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
