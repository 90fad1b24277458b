//! Derivatives by differences, also of direct solves, and integrals.

use interp::Quantities;
use solve::solve;

use crate::material;

/// Returns the derivatives of `N` functions at 0, from four values or, on one side only, seven.
pub fn derivatives<const N: usize>(
    step: f64,
    one_sided: bool,
    f: impl Fn(f64) -> [f64; N],
) -> [f64; N] {
    if !one_sided {
        let [near, far] = [1.0, 2.0].map(|steps| [f(steps * step), f(-steps * step)]);
        return std::array::from_fn(|i| {
            (8.0 * (near[0][i] - near[1][i]) - (far[0][i] - far[1][i])) / (12.0 * step)
        });
    }
    let weights = [-2.45, 6.0, -7.5, 20.0 / 3.0, -3.75, 1.2, -1.0 / 6.0];
    let values: [[f64; N]; 7] = std::array::from_fn(|k| f(-step * k as f64));
    std::array::from_fn(|i| {
        let terms = weights.iter().zip(&values);
        terms.map(|(weight, value)| weight * value[i]).sum::<f64>() / -step
    })
}

/// Returns the quantities of a direct solve, as accurate as double precision allows. Their error
/// over the steps of [`derivatives`] is at most a tolerance of the embedded table.
pub fn direct(x: f64, parameters: [f64; 4]) -> Quantities {
    let solved = |tolerance| solve(x, &material(parameters), tolerance);
    solved(1e-13)
        .or_else(|_| solved(1e-11))
        .or_else(|_| solved(1e-9))
        .expect("solved")
        .quantities
}

/// Returns the derivatives of `N` functions at 0, by central differences of eighth order.
pub fn slopes<const N: usize>(step: f64, f: impl Fn(f64) -> [f64; N]) -> [f64; N] {
    let mut slopes = [0.0; N];
    for (weight, k) in [0.8, -0.2, 4.0 / 105.0, -1.0 / 280.0].into_iter().zip(1..) {
        let [after, before] = [1.0, -1.0].map(|sign| f(sign * f64::from(k) * step));
        for (i, slope) in slopes.iter_mut().enumerate() {
            *slope += weight * (after[i] - before[i]) / step;
        }
    }
    slopes
}

/// Integrates a function by Simpson's rule with `2 n` intervals.
pub fn simpson(f: impl Fn(f64) -> f64, from: f64, to: f64, n: u32) -> f64 {
    let step = (to - from) / f64::from(2 * n);
    let at = |i: u32| f(from + f64::from(i) * step);
    let inner: f64 = (1..2 * n)
        .map(|i| if i % 2 == 1 { 4.0 } else { 2.0 } * at(i))
        .sum();
    (at(0) + inner + at(2 * n)) * step / 3.0
}
