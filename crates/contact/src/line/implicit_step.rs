//! One step of a stiff equation of one unknown, `dx/dt = f(t, x)`.
//!
//! The method is the diagonally implicit Runge-Kutta method of order 4 with five stages, L-stable and
//! stiffly accurate, of Hairer and Wanner (Solving Ordinary Differential Equations II, second edition,
//! section IV.6, table 6.5). Each stage is one equation of one unknown, `y - s f(y) = known`. Its root
//! is bracketed, so that no stiffness and no kink of `f` keeps it from being found, and the slope is
//! `(y - known)/s`, so that the rounding of a steep `f` does not enter.

use crate::root::root;

/// The diagonal of the method.
const GAMMA: f64 = 0.25;
/// The times of the stages, and the weights of the slopes before each.
const TIMES: [f64; 5] = [0.25, 0.75, 0.55, 0.5, 1.0];
const WEIGHTS: [[f64; 4]; 5] = [
    [0.0; 4],
    [0.5, 0.0, 0.0, 0.0],
    [17.0 / 50.0, -1.0 / 25.0, 0.0, 0.0],
    [371.0 / 1360.0, -137.0 / 2720.0, 15.0 / 544.0, 0.0],
    [25.0 / 24.0, -49.0 / 48.0, 125.0 / 16.0, -85.0 / 12.0],
];
/// The weights of the difference from the embedded method of order 3.
const DIFFERENCE: [f64; 5] = [-3.0 / 16.0, -27.0 / 32.0, 25.0 / 32.0, 0.0, 0.25];
/// The order of the estimated error in the length of the step.
pub const ORDER: f64 = 4.0;

/// The end of a step.
#[derive(Clone, Copy, Debug)]
pub struct Step {
    /// The unknown.
    pub value: f64,
    /// Its estimated error.
    pub error: f64,
}

/// Takes a step of the length `h` from `x` at the time `t`. `None` if a stage has no solution within
/// `farthest` of where it would be without its own slope: the step is too long.
///
/// # Errors
/// Those of `f`, which may be infinite.
pub fn step<E>(
    f: impl Fn(f64, f64) -> Result<f64, E>,
    [t, x]: [f64; 2],
    h: f64,
    farthest: f64,
) -> Result<Option<Step>, E> {
    let mut slopes = [0.0; 5];
    let mut value = x;
    for stage in 0..5 {
        let sum: f64 = (0..stage).map(|i| WEIGHTS[stage][i] * slopes[i]).sum();
        let (known, length) = (x + h * sum, GAMMA * h);
        let at = t + TIMES[stage] * h;
        let Some(root) = implicit(|y| f(at, y), known, length, farthest)? else {
            return Ok(None);
        };
        slopes[stage] = (root - known) / length;
        value = root;
    }
    let terms = DIFFERENCE.iter().zip(slopes);
    let error = h * terms.map(|(weight, slope)| weight * slope).sum::<f64>();
    Ok(Some(Step {
        value,
        error: error.abs(),
    }))
}

/// Finds the root of `y - length f(y) - known` that is nearest to `known` in the direction of `f`
/// there; `None` if there is none within `farthest`.
fn implicit<E>(
    f: impl Fn(f64) -> Result<f64, E>,
    known: f64,
    length: f64,
    farthest: f64,
) -> Result<Option<f64>, E> {
    let residual = |y: f64| Ok((y - known) - length * f(y)?);
    let explicit = length * f(known)?;
    if explicit == 0.0 {
        return Ok(Some(known));
    }
    let direction = explicit.signum();
    let (mut near, mut distance) = (known, explicit.abs().max(f64::EPSILON * known.abs()));
    loop {
        distance = distance.min(farthest);
        let far = known + direction * distance;
        if direction * residual(far)? >= 0.0 {
            return root(residual, near, far).map(Some);
        }
        if distance >= farthest {
            return Ok(None);
        }
        near = far;
        distance *= 2.0;
    }
}

#[cfg(test)]
mod tests {
    use std::convert::Infallible;

    use super::*;

    /// Integrates from 0 to 1 in equal steps and returns the end.
    fn integrate(f: impl Fn(f64, f64) -> f64, x: f64, steps: u32) -> f64 {
        let h = 1.0 / f64::from(steps);
        (0..steps).fold(x, |x, i| {
            let Ok(step) = step(
                |t, x| Ok::<_, Infallible>(f(t, x)),
                [f64::from(i) * h, x],
                h,
                10.0,
            );
            step.expect("a root").value
        })
    }

    /// `dx/dt = x cos(t)` and a nonlinear equation, `dx/dt = x^2`, whose solutions are known.
    #[test]
    fn the_error_falls_with_the_fourth_power_of_the_step() {
        type Function = fn(f64, f64) -> f64;
        let cases: [(Function, f64, f64); 2] = [
            (|t, x| x * t.cos(), 1.0, 1.0_f64.sin().exp()),
            (|_, x| x * x, 0.5, 1.0),
        ];
        for (f, x, truth) in cases {
            let [coarse, fine] = [20, 40].map(|steps| (integrate(f, x, steps) - truth).abs());
            println!("{coarse:.1e} {fine:.1e}");
            assert!((13.0..20.0).contains(&(coarse / fine)), "{coarse} {fine}");
        }
    }

    /// `dx/dt = -s (x - cos t)` follows the cosine however large `s` is, and one with the root of the
    /// distance, which is infinitely steep.
    #[test]
    fn stiff_equations_follow_their_slow_solution() {
        for s in [1e3, 1e6, 1e12] {
            let x = integrate(|t, x| -s * (x - t.cos()), 1.0, 20);
            assert!((x - 1.0_f64.cos()).abs() < 2.0 / s + 1e-15, "{s}: {x}");
            let x = integrate(
                |t, x| -s * (x - t.cos()).signum() * (x - t.cos()).abs().sqrt(),
                1.0,
                20,
            );
            assert!(
                (x - 1.0_f64.cos()).abs() < 2.0 / (s * s) + 1e-15,
                "{s}: {x}"
            );
        }
    }

    /// The solution of `dx/dt = x^2` ends at `t = 1/x`: no step leads beyond it.
    #[test]
    fn a_step_beyond_the_end_of_the_solution_is_refused() {
        let Ok(step) = step(
            |_, x: f64| Ok::<_, Infallible>(x * x),
            [0.0, 1.0],
            3.0,
            100.0,
        );
        assert!(step.is_none(), "{step:?}");
    }
}
