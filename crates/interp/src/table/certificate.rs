//! How accurate a table is between its nodes, as measured against direct solves.

use serde::{Deserialize, Serialize};

use crate::Quantity;

/// The measured accuracy of a table: relative errors of the interpolated quantities against direct
/// solves off the nodes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Certificate {
    /// The largest relative error of any quantity at any point.
    pub max_error: f64,
    /// The median over the points of the largest relative error at a point.
    pub median_error: f64,
    /// How many points were solved.
    pub points: u64,
    /// The seed of the random points.
    pub seed: u64,
    /// What a file made by another program need not hold.
    pub details: Option<Details>,
}

/// More of what a certificate's points say.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Details {
    /// The largest relative error at 99.9 % of the points.
    pub p999_error: f64,
    /// The quantity that has the largest error.
    pub worst_quantity: Quantity,
    /// Where it has it: `a_over_t`, `e1_over_e2`, `nu1`, `e0_over_e2`.
    pub worst_point: [f64; 4],
    /// By how much the interpolant breaks `Gamma^2 = es (Eeq + x Eeq')` and
    /// `3 Pi0 + x Pi0' = 4 Eeq (2 Delta0 + x Delta0')`, relative to the left sides: the largest of
    /// all points, which are others than `worst_point`; none where a quantity is missing or `a/t`
    /// is fixed.
    pub identity_errors: [Option<f64>; 2],
}
