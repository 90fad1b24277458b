//! The nodes of a spline: which values and which distances it takes.

use std::ops::RangeInclusive;

use crate::Parameter;

/// What moduli, `a/t` and quantities may be: far more than is solved, and far from where arithmetic
/// overflows.
pub(crate) const REASONABLE: RangeInclusive<f64> = 1e-30..=1e30;

/// The closest that nodes may be, relative to the length of their axis.
const CLOSEST: f64 = 1e-7;
/// And in the coordinate of the axis.
const SHORTEST: f64 = 1e-9;

/// The first neighbours on an axis that a spline could not tell apart, or that descend.
pub(crate) fn too_close(parameter: Parameter, nodes: &[f64]) -> Option<[f64; 2]> {
    let distance = |from: f64, to: f64| parameter.coordinate(to) - parameter.coordinate(from);
    let least = (CLOSEST * distance(nodes[0], nodes[nodes.len() - 1]).abs()).max(SHORTEST);
    nodes
        .windows(2)
        .map(|pair| [pair[0], pair[1]])
        .find(|&[low, high]| high <= low || distance(low, high) < least)
}
