//! Derivatives by differences of direct solves.

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
