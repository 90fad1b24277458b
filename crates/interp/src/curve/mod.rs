//! The quantities of one material as functions of `a/t`.
//!
//! A table, or a solve, gives values at `nodes`. The crate [`piecewise`] interpolates them by splines, and
//! turns these into polynomials on pieces that are found without a search. `quantity_resampler` does
//! this for the quantities; from `Gamma` alone, `derived` integrates the others on the pieces,
//! beginning with those of a `thick_film`. `fitting` chooses the pieces. [`Curve`] holds them;
//! `through` makes one from values at nodes, and `exchange` converts one for the crate `splines`.
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
pub(crate) mod nodes;
pub(crate) mod quantity_resampler;
pub(crate) mod sensitivity;
mod shaped;
#[cfg(test)]
mod test_curve;
mod thick_film;
mod through;

pub use curve::{Curve, StackShape};
pub use even_powers::{EvenShape, LARGEST_A_OVER_R};
pub use sensitivity::QuantityGradient;
