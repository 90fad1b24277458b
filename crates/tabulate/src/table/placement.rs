//! The nodes of one axis, given by a rule with few numbers.

use std::f64::consts::PI;

use interp::Parameter;

/// The values of `evenness` from which the planner takes the one with the fewest nodes.
///
/// Boxes whose quantities are smooth up to their ends need even nodes. Boxes that end in a steep
/// region need nodes that crowd towards their ends.
pub(super) const EVENNESS: [f64; 4] = [0.0, 0.9, 0.95, 0.98];

/// Returns the nodes of an axis, ascending, with exact ends: `count` at the [`places`] in the
/// parameter's coordinate, or a single one at `from`.
///
/// # Panics
/// As [`places`] for no node, and for an `evenness` that is none.
pub(super) fn nodes(
    parameter: Parameter,
    [from, to]: [f64; 2],
    (count, evenness): (usize, f64),
) -> Vec<f64> {
    if count == 1 {
        return vec![from];
    }
    let node = |place: f64| between(parameter, [from, to], place);
    let mut values: Vec<f64> = places(count, evenness).into_iter().map(node).collect();
    values[0] = from;
    values[count - 1] = to;
    values
}

/// Returns the value at the part `share` of a range, in the parameter's coordinate.
pub(super) fn between(parameter: Parameter, [from, to]: [f64; 2], share: f64) -> f64 {
    let [first, last] = [from, to].map(|end| parameter.coordinate(end));
    parameter
        .value(first + (last - first) * share)
        .clamp(from, to)
}

/// Returns `count` places from 0 to 1, ascending: `asin(evenness z)/asin(evenness)`, with the Chebyshev points `z` of the
/// second kind, moved from `[-1, 1]`. They are these points at an `evenness` of 0, and evenly spaced at 1.
///
/// # Panics
/// If `count` is below 2 or `evenness` is not in `[0, 1]`.
pub(super) fn places(count: usize, evenness: f64) -> Vec<f64> {
    assert!(
        count >= 2 && (0.0..=1.0).contains(&evenness),
        "{count} nodes, evenness {evenness}"
    );
    let intervals = (count - 1) as f64;
    let place = |i: usize| {
        let even = i as f64 / intervals;
        // The sine keeps the places symmetric.
        let chebyshev = (PI * (even - 0.5)).sin();
        match evenness {
            0.0 => 0.5 + 0.5 * chebyshev,
            1.0 => even,
            _ => 0.5 + 0.5 * (evenness * chebyshev).asin() / evenness.asin(),
        }
    };
    (0..count).map(place).collect()
}
