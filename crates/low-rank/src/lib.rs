//! A function of several variables as a tensor train of small integers: compressed, coded, and
//! evaluated with its slopes.
//!
//! A table of a smooth function of four variables has millions of numbers, of which few are
//! independent. An [`IntegerTrain`] holds them as polynomials along each variable, joined by short
//! sums, with all coefficients rounded to multiples of one step: some hundred kilobytes. A
//! [`PreparedTrain`] evaluates it, in some microseconds, with exact derivatives.
//!
#![cfg_attr(feature = "compress", doc = "```")]
#![cfg_attr(not(feature = "compress"), doc = "```ignore")]
//! use piecewise::bspline::Basis;
//! use low_rank::{PreparedTrain, compress};
//!
//! // A function on a grid of 12 nodes along each of its four variables.
//! let nodes: Vec<f64> = (0..12).map(|i| f64::from(i) / 11.0).collect();
//! let f = |y: f64, u: f64, v: f64, w: f64| (1.0 + y + u * v).ln() * (w - y).cos();
//! let axis = || compress::Axis {
//!     coordinates: nodes.clone(),
//!     nodes: [0, 11],
//!     smooth_degree: 20.0,
//! };
//! // Row-major over the variables 1, 2, 3 and 0.
//! let mut values = Vec::new();
//! for &u in &nodes {
//!     for &v in &nodes {
//!         for &w in &nodes {
//!             values.extend(nodes.iter().map(|&y| f(y, u, v, w)));
//!         }
//!     }
//! }
//! let train = compress::compress([axis(), axis(), axis(), axis()], 1, &values, 1e-6)?;
//! assert!(train.coded_integers().len() < values.len() / 8);
//!
//! // The value and the slopes along the last three variables, at one place.
//! let basis = Basis::of_table(&nodes);
//! let prepared = PreparedTrain::new(&train, [[0.0, 1.0]; 4], &nodes, &basis, 1e-6);
//! let [value, by_u, _, _] = prepared.coefficients_and_slopes([0.3, 0.7, 0.2], [true, false, false]);
//! let at = |coefficients: &[f64], y: f64| {
//!     let weights = basis.weights(y);
//!     let used = &coefficients[weights.first..][..weights.count];
//!     used.iter().zip(weights.values).map(|(c, w)| c * w).sum::<f64>()
//! };
//! assert!((at(&value, 0.4) - f(0.4, 0.3, 0.7, 0.2)).abs() < 3e-6);
//! let exact = 0.7 / (1.4 + 0.21) * (0.2_f64 - 0.4).cos();
//! assert!((at(&by_u, 0.4) - exact).abs() < 1e-4);
//! # Ok::<(), compress::NotReached>(())
//! ```
//!
//! The crate knows nothing of what the functions mean. The README lists its types. Parts of a train from
//! a file may be hostile: whatever they are, there is a [`Malformed`] error or a train whose values are
//! finite.

#![forbid(unsafe_code)]

mod blocks;
pub mod chebyshev;
mod coarser;
#[cfg(feature = "compress")]
pub mod compress;
mod dense_spline;
mod entropy;
mod functions;
mod integer_train;
mod malformed;
mod mixed_precision;
mod needs;
pub mod once;
mod prepared_train;
mod tiling;
mod values;
mod vectors;
mod weighted_sum;

pub use coarser::coarser;
pub use dense_spline::DenseSpline;
pub use integer_train::IntegerTrain;
pub use malformed::Malformed;
pub use needs::Needs;
pub use prepared_train::PreparedTrain;
pub use tiling::cover_once;
pub use vectors::WeightedSum;
pub use weighted_sum::add_rows;
