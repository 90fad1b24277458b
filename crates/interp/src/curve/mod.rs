//! The quantities of one material as functions of `a/t`.
//!
//! A table, or a solve, gives values at `nodes`. `bspline` interpolates them by splines.
//! `resampler` turns the splines into polynomials on the pieces of a `grid`, which finds a piece
//! without a search; `piecewise` evaluates the polynomials. [`Curve`] holds the pieces; `through`
//! makes one from values at nodes, and `exchange` converts one for the crate `splines`.
//! `asymptotics` continues a curve beyond its nodes; `sensitivity` holds its derivatives with
//! respect to the material.

mod asymptotics;
pub mod bspline;
mod curve;
mod derived;
mod exchange;
mod fitting;
mod grid;
pub(crate) mod nodes;
mod piecewise;
pub(crate) mod resampler;
pub(crate) mod sensitivity;
mod series;
#[cfg(test)]
mod test_curve;
mod thick_film;
mod through;

pub use curve::Curve;
pub use sensitivity::QuantityGradient;
