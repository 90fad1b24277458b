//! Derivatives with respect to the Poisson ratio of nearly incompressible films.
//!
//! With `w = 1 - 2 nu1` and `x = a/t`, the quantities change where `w` changes by about `w + u`, `u
//! = 1/(1 + x^2)` on a rigid substrate. A substrate that deforms, with `p = E0*/(E0* + E1*)` below 1, confines
//! the film less: `u = 1/(1 + p x^2 + 2.3 (1 - p))`. The coordinate `v` of `nu1`, see
//! [`Parameter::coordinate`], must resolve the smallest `w + u` of all `x`. Where `u` is much larger, a small
//! step of `v` changes the quantities by less than the error of the table, and the slope of the spline is that
//! of the error. The derivative multiplies it by `(w + u) |dv/dw|`, which is 2e4 for thick incompressible films.
//!
//! There the derivative is a difference of values over distances in `w` of about `w + u` instead.
//! `tests/contact/gradient` measures the errors per unit of `w + u`. The constants below balance two
//! errors: with distances nearer to each other, or farther away, the polynomial through the
//! differences is less accurate; with a smaller nearest distance, the error of the table is
//! multiplied by more. With a ratio of 4 and a farthest distance of 1 the largest error at 2000
//! contacts of every contrast was 172 tolerances.
//!
//! Nodes of `a/t` whose `w + u` are nearly equal share one difference. It is formed as early as the
//! lookup allows, and only the coefficients of its own nodes are computed.

use std::array;

use low_rank::WeightedSum;

use crate::Parameter;
use crate::table::tensor_spline::TensorSpline;

/// The largest `(w + u) |dv/dw|` with which the slope of the spline is used.
const LARGEST_MAGNIFICATION: f64 = 0.5;
/// The number of distances in one difference.
const POINTS: usize = 4;
/// The ratio of one distance to the next. Smaller ratios need more lookups.
const RATIO: f64 = 2.7;
/// The largest distance in one difference, relative to `w + u`.
const REACH: f64 = 0.7;
/// The largest ratio of `w + u` of nodes that share a difference. A larger ratio needs fewer sums
/// of lookups, and is less accurate: with 1.2 the largest error at 2000 contacts is 49 tolerances,
/// with 1.5 it is 56, and an incompressible film took a tenth less time.
const SHARED: f64 = 1.5;

/// One over the range `u` on a far softer substrate, less one: with it the derivatives by `nu0` are wrong by 2e-5 of the
/// quantities or less; with 0, by up to 1e-3.
const SOFT: f64 = 2.3;

/// Tells whether derivatives need better slopes than those of the spline at the coordinate `v` of
/// `nu1`. `factors` are those of the slope with respect to `nu1` in them: in the derivatives with respect
/// to `ln e1_over_e2`, `nu1`, `ln e0_over_e2` and `nu0` of a material.
pub(crate) fn need_better_slopes(v: f64, [e1, nu1, e0, nu0]: [f64; 4]) -> bool {
    // The unit of all but `nu1` is 1.
    let magnification = |factor: f64| factor.abs() * Parameter::Nu1.speed(v);
    nu1 != 0.0
        || [e1, e0, nu0]
            .into_iter()
            .any(|factor| magnification(factor) > LARGEST_MAGNIFICATION)
}

/// Replaces the derivatives `slopes` of the coefficients over `ln(a/t)` with respect to `nu1` where
/// those of the spline are inaccurate.
///
/// The coefficients are those of the material at `coordinates`: a group of the quantities held
/// for each node of `a_over_t`. The axis of `nu1` begins at `least`, and `share` is `p`.
pub(crate) fn improve_slopes(
    spline: &TensorSpline,
    coordinates: [f64; 3],
    a_over_t: &[f64],
    least: f64,
    share: f64,
    slopes: &mut [f64],
) {
    let [_, v, _] = coordinates;
    let w = 1.0 - 2.0 * Parameter::Nu1.value(v);
    let room = 1.0 - 2.0 * least - w;
    // The B-splines are numbered as the nodes in their middle.
    let unit = |&x: &f64| w + 1.0 / (1.0 + share * x * x + SOFT * (1.0 - share));
    let units: Vec<f64> = a_over_t.iter().map(unit).collect();
    let magnification = 0.5 * Parameter::Nu1.speed(v);
    let inaccurate = units.partition_point(|unit| unit * magnification > LARGEST_MAGNIFICATION);
    let units = &units[..inaccurate];
    let Some(smallest) = units.last() else {
        return;
    };
    let (farthest, reach) = (room.min(REACH * units[0]), REACH * smallest);
    if farthest < reach {
        // The table ends too near.
        return;
    }
    // The last `POINTS` of them are those of the smallest unit.
    let mut distances = vec![farthest];
    while distances[distances.len() - 1] > reach {
        distances.push(distances[distances.len() - 1] / RATIO);
    }
    for _ in 1..POINTS {
        distances.push(distances[distances.len() - 1] / RATIO);
    }
    // The material itself is the last place.
    let mut places: Vec<f64> = distances
        .iter()
        .map(|distance| Parameter::Nu1.coordinate(0.5 * (1.0 - w - distance)))
        .collect();
    places.push(v);
    let quantities = slopes.len() / a_over_t.len();
    let mut differences = Vec::with_capacity(distances.len());
    let mut start = 0;
    while start < inaccurate {
        let within_reach = |unit: f64| distances.partition_point(|&other| other > REACH * unit);
        let (largest, first) = (units[start], within_reach(units[start]));
        let is_near = |&unit: &f64| SHARED * unit >= largest && within_reach(unit) == first;
        let end = start + units[start..].partition_point(is_near);
        let unit = (largest * units[end - 1]).sqrt();
        // The quantities are smooth functions of the logarithm of `w + u`. `dw/dnu1` is -2.
        let weights = weights(array::from_fn(|k| (distances[first + k] / unit).ln_1p()))
            .map(|weight| -2.0 / unit * weight);
        let own = (distances.len(), -weights.iter().sum::<f64>());
        let mut all = [own; POINTS + 1];
        for (k, weight) in weights.into_iter().enumerate() {
            all[k] = (first + k, weight);
        }
        differences.push((all, quantities * start..quantities * end));
        start = end;
    }
    let differences: Vec<_> = differences
        .iter()
        .map(|(weights, columns)| WeightedSum {
            weights,
            columns: columns.clone(),
        })
        .collect();
    spline.sums_along(coordinates, 1, &places, &differences, slopes);
}

/// Returns the weights of `f(s) - f(0)` at the points `s` that sum to `f'(0)`, exactly for
/// polynomials of degree [`POINTS`].
fn weights(s: [f64; POINTS]) -> [f64; POINTS] {
    array::from_fn(|k| {
        let others = (0..POINTS).filter(|&i| i != k);
        others.map(|i| s[i] / (s[i] - s[k])).product::<f64>() / s[k]
    })
}
