//! The nodes of a spline: the values that they may have, and how close they may be.

use std::ops::RangeInclusive;

use crate::Parameter;

/// The values allowed for moduli, `a/t` and quantities.
///
/// The range is much larger than that of any solve, and far from overflow.
pub(crate) const REASONABLE: RangeInclusive<f64> = 1e-30..=1e30;

/// The smallest distance of two nodes relative to the length of their axis.
const CLOSEST: f64 = 1e-7;
/// The smallest distance of two nodes in the coordinate of the axis.
const SHORTEST: f64 = 1e-9;

/// Returns the first two neighbours in `nodes` that descend or are too close for a spline.
pub(crate) fn too_close(parameter: Parameter, nodes: &[f64]) -> Option<[f64; 2]> {
    let distance = |from: f64, to: f64| parameter.coordinate(to) - parameter.coordinate(from);
    let least = (CLOSEST * distance(nodes[0], nodes[nodes.len() - 1]).abs()).max(SHORTEST);
    nodes
        .windows(2)
        .map(|pair| [pair[0], pair[1]])
        .find(|&[low, high]| high <= low || distance(low, high) < least)
}
