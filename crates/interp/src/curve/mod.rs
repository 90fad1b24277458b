//! The quantities of one material as functions of `a/t`.
//!
//! A table, or a solve, gives values at `nodes`. `bspline` puts splines through them, `piecewise`
//! turns these into polynomials that are found without a search, and [`Curve`] evaluates them.
//! `asymptotics` goes on beyond the nodes, `sensitivity` holds the derivatives with respect to the
//! material.

pub(crate) mod asymptotics;
pub mod bspline;
pub(crate) mod curve;
pub(crate) mod nodes;
pub(crate) mod piecewise;
pub(crate) mod sensitivity;

pub use curve::Curve;
pub use sensitivity::QuantityGradient;
