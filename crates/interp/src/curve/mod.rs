//! The quantities of one material as functions of `a/t`.
//!
//! A table, or a solve, gives values at `nodes`. The splines of `low_rank::bspline`
//! interpolate them.
//! `resampler` turns the splines into polynomials on the pieces of a `grid`, which finds a piece
//! without a search; `spans` holds the B-splines of each piece. `fitting` chooses the pieces,
//! `piecewise` evaluates the polynomials. From `Gamma` alone, `derived` integrates the other
//! quantities as `series` on the pieces, beginning with those of a `thick_film`. [`Curve`] holds
//! the pieces; `through` makes one from values at nodes, and `exchange` converts one for the crate
//! `splines`.
//!
//! `even_powers` turns the curve into that of a sphere or of an even power of the radius; `shaped` holds the
//! functions of [`Curve`] for that. `asymptotics` continues a curve `beyond` its nodes;
//! `sensitivity` holds its derivatives with respect to the material.

mod asymptotics;
mod beyond;
mod curve;
pub(crate) mod derived;
mod even_powers;
mod exchange;
mod fitting;
mod grid;
pub(crate) mod nodes;
mod piecewise;
pub(crate) mod resampler;
pub(crate) mod sensitivity;
mod series;
mod shaped;
mod spans;
#[cfg(test)]
mod test_curve;
mod thick_film;
mod through;

pub use curve::{Curve, StackShape};
pub use even_powers::{EvenShape, LARGEST_A_OVER_R};
pub use sensitivity::QuantityGradient;
