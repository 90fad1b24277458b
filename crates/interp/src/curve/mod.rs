//! The quantities of one material as functions of `a/t`.
//!
//! A table, or a solve, gives values at `nodes`. The crate [`piecewise`] interpolates them by splines, and
//! turns these into polynomials on pieces that are found without a search. `quantity_resampler` does
//! this for the quantities; from `Gamma` alone, `derived` integrates the others on the pieces,
//! beginning with those of a `thick_film`. `fitting` chooses the pieces. [`Curve`] holds them;
//! `through` makes one from values at nodes, and `exchange` converts one for the crate `splines`.
//!
//! `shaped` holds what other probes than a paraboloid need of a curve. `asymptotics` continues a curve
//! `beyond` its nodes; `sensitivity` holds its derivatives with respect to the material.

mod asymptotics;
mod beyond;
mod curve;
pub(crate) mod derived;
mod exchange;
mod fitting;
pub(crate) mod nodes;
pub(crate) mod quantity_resampler;
pub(crate) mod sensitivity;
mod shaped;
#[cfg(test)]
mod test_curve;
mod thick_film;
mod through;

pub use curve::{Curve, StackShape};
pub use sensitivity::QuantityGradient;
pub use shaped::BelowNodes;
