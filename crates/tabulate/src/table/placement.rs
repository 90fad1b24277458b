//! The nodes of one axis, given by a rule with few numbers.

use std::f64::consts::PI;

use interp::Parameter;
use serde::{Deserialize, Serialize};

/// The nodes of one axis, as a rule.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Placement {
    /// A fixed parameter.
    Fixed(f64),
    /// `nodes` nodes at `asin(evenness z)/asin(evenness)`, with the Chebyshev points `z` of the
    /// second kind, in the parameter's coordinate.
    Nodes {
        /// The first node.
        from: f64,
        /// The last node.
        to: f64,
        /// The number of nodes, two or more.
        nodes: usize,
        /// 0 for Chebyshev points, 1 for even spacing.
        evenness: f64,
        /// Whether the number may be changed, because the scene does not state it.
        free: bool,
    },
}

/// The values of `evenness` from which the planner takes the one with the fewest nodes.
///
/// Boxes whose quantities are smooth up to their ends need even nodes. Boxes that end in a steep
/// region need nodes that crowd towards their ends.
pub(super) const EVENNESS: [f64; 4] = [0.0, 0.9, 0.95, 0.98];

impl Placement {
    /// Returns the nodes, ascending, with exact ends.
    ///
    /// # Panics
    /// If there are fewer than 2 nodes or `evenness` is not in `[0, 1]`.
    pub fn nodes(&self, parameter: Parameter) -> Vec<f64> {
        match *self {
            Self::Fixed(value) => vec![value],
            Self::Nodes {
                from,
                to,
                nodes,
                evenness,
                ..
            } => {
                let (first, last) = (parameter.coordinate(from), parameter.coordinate(to));
                let node = |place: f64| parameter.value(first + (last - first) * place);
                let mut values: Vec<f64> = places(nodes, evenness).into_iter().map(node).collect();
                values[0] = from;
                values[nodes - 1] = to;
                values
            }
        }
    }
}

/// Returns `count` places from 0 to 1, ascending: those of [`Placement::Nodes`].
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
