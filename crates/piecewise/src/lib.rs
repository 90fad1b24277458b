#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

pub mod bspline;
pub mod exp;
mod fitting;
mod functions;
mod grid;
mod lagrange;
pub mod lanes;
mod resampler;
pub mod series;
mod spans;

pub use fitting::{Exponentials, Fitting, Target};
pub use functions::{Piecewise, Polynomials};
pub use grid::{Grid, Position};
pub use lagrange::lagrange;
pub use resampler::Resampler;

/// The number of coefficients of a spline on a piece, of `1, t, t^2, ...`
pub const SPLINE_TERMS: usize = 8;
/// The number of coefficients of a function on a piece.
///
/// The exponential of a polynomial of degree 7 has infinitely many terms, but on a piece each is
/// at least five times smaller than the one before, if an octave has two pieces or more.
pub const FUNCTION_TERMS: usize = 10;
