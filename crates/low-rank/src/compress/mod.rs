//! The train of functions given at the nodes of a grid, in about as few bytes as an error allows.
//!
//! `coefficients` expands the functions in the polynomials of a box, and `truncation` makes a train of
//! integers of the coefficients, by the decompositions of `matrices`.

mod coefficients;
mod matrices;
mod truncation;

use thiserror::Error;

use crate::IntegerTrain;
pub use coefficients::Axis;
use truncation::{Part, truncate};

/// No train keeps the error that was asked for.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[error("no train of integers keeps the error {error:e}: the best one has {reached:e}")]
pub struct NotReached {
    /// The largest error allowed at the nodes.
    pub error: f64,
    /// That of the best train.
    pub reached: f64,
}

/// Returns the train of functions in a box, in about as few bytes as `error` allows, the largest
/// error of the functions at the nodes of the box.
///
/// * `axes`: those of the variables 1, 2, 3 and 0.
/// * `count`: the number of functions, one at least.
/// * `values`: at all nodes, row-major over the axes in this order, then the functions; finite, and
///   below 1e9.
///
/// It works on all threads of the caller's pool of `rayon`.
///
/// # Errors
/// [`NotReached`] where the smallest steps have a larger error.
///
/// # Panics
/// If `values` has another length, or holds a number that is not finite.
pub fn compress(
    axes: [Axis; 4],
    count: usize,
    values: &[f64],
    error: f64,
) -> Result<IntegerTrain, NotReached> {
    let nodes: usize = axes.iter().map(|axis| axis.coordinates.len()).product();
    assert_eq!(values.len(), nodes * count, "values at all nodes");
    truncate(&Part::new(axes, count, values, error), error)
}
