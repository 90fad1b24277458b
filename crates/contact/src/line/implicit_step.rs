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
