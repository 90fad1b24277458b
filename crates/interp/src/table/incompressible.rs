//! Derivatives with respect to the Poisson ratio of nearly incompressible films.
//!
//! The quantities at `x = a/t` change where `w = 1 - 2 nu1` changes by about `w + u`, with
//! `u = 1/(1 + x^2)`. The coordinate `v` of `nu1`, see [`Parameter::coordinate`], resolves `w` down
//! to the smallest `u` of all `x`. Where `u` is much larger, a small step of `v` changes the
//! quantities by less than the table's error, and the slope of the spline is the slope of this
//! error: it is multiplied by `(w + u) dv/dw`, which is 2e4 at `w = 0` for thick films.
//!
//! There the derivative is a difference of values over distances of the size of `w + u`.

use crate::Parameter;
use crate::table::tensor_spline::TensorSpline;

/// The largest `(w + u) |dv/dw|` with which the slope of the spline is used.
const LARGEST_MAGNIFICATION: f64 = 2.5;
/// The distances in `w` are powers of this.
const RATIO: f64 = 2.5;
/// The number of distances in one difference.
const POINTS: usize = 5;
/// The largest distance in one difference, relative to `w + u`.
const REACH: f64 = 2.0;

/// Replaces the derivatives of the coefficients over `ln(a/t)` with respect to `nu1` where those of
/// the spline are inaccurate.
///
/// `values` are the coefficients of the material at `coordinates` and `slopes` their derivatives,
/// a group of quantities for each node of `a_over_t`. `least` is the smallest `nu1` of the table.
pub(crate) fn improve_slopes(
    spline: &TensorSpline,
    coordinates: [f64; 3],
    a_over_t: &[f64],
    least: f64,
    values: &[f64],
    slopes: &mut [f64],
) {
    let [e1, v, e0] = coordinates;
    let w_of = |nu1: f64| 1.0 - 2.0 * nu1;
    let w = w_of(Parameter::Nu1.value(v));
    let room = w_of(least) - w;
    let speed = 0.5 * Parameter::Nu1.speed(v);
    // `w + u`; the B-splines are numbered as the nodes in their middle.
    let scale = |x: f64| w + 1.0 / (1.0 + x * x);
    let inaccurate = a_over_t.partition_point(|&x| scale(x) * speed > LARGEST_MAGNIFICATION);
    let Some(&last) = a_over_t[..inaccurate].last() else {
        return;
    };
    let farthest = room.min(REACH * scale(a_over_t[0]));
    let nearest = REACH * scale(last) * RATIO.powi(-(POINTS as i32));
    let distances: Vec<f64> = (0..64)
        .map(|k| farthest * RATIO.powi(-k))
        .take_while(|&distance| distance > nearest)
        .collect();
    if distances.len() < POINTS {
        return;
    }
    let changes: Vec<Vec<f64>> = distances
        .iter()
        .map(|distance| {
            let v = Parameter::Nu1.coordinate(0.5 * (1.0 - w - distance));
            spline.coefficients([e1, v, e0])
        })
        .collect();
    let quantities = values.len() / a_over_t.len();
    for (j, &x) in a_over_t[..inaccurate].iter().enumerate() {
        let scale = scale(x);
        let first = distances.partition_point(|&distance| distance > REACH * scale);
        let first = first.min(distances.len() - POINTS);
        let weights = weights(std::array::from_fn(|k| {
            (distances[first + k] / scale).ln_1p()
        }));
        for i in j * quantities..(j + 1) * quantities {
            let differences = weights.iter().zip(&changes[first..]);
            let sum: f64 = differences
                .map(|(weight, change)| weight * (change[i] - values[i]))
                .sum();
            // `dw/dnu1` is -2.
            slopes[i] = -2.0 / scale * sum;
        }
    }
}

/// Returns the weights of `f(s) - f(0)` at the points `s` in `f'(0)`, exact for polynomials.
fn weights(s: [f64; POINTS]) -> [f64; POINTS] {
    std::array::from_fn(|k| {
        let others = (0..POINTS).filter(|&i| i != k);
        others.map(|i| s[i] / (s[i] - s[k])).product::<f64>() / s[k]
    })
}
