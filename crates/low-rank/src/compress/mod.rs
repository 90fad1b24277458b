//! The train of functions given at the nodes of a grid, in about as few bytes as an error allows.
//!
//! `coefficients` expands the functions in the polynomials of a box, and `truncation` makes a train of
//! integers of the coefficients, by the decompositions of `matrices`.

mod coefficients;
mod matrices;
mod truncation;

pub use coefficients::Axis;
pub use truncation::{NotReached, compress};
