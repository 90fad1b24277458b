//! Barthel's four functions from a precomputed table, and eq. 9 force curves from them.
//!
//! A sphere (body 2) touches a film (1) bonded to a substrate (0) and adheres to it. Barthel's
//! model, *Adhesive contact of a compliant sphere to an elastic coated substrate: the thin film
//! limit*, needs four dimensionless functions of (`a/t`, `E1/E2*`, `nu1`, `E0/E2*`), the
//! [`Quantities`]. The crate `tabulate` computes them once for a [`Table`], a [`Curve`] has those of
//! one material, and a [`ForceCurve`] evaluates eqs. 2 to 9. The README has an example, what holds
//! outside the table, and the features.
//!
//! All units are SI. Loads are positive in compression; penetrations are positive when the sphere is
//! below the undeformed surface. Functions that return a `Result` give
//! finite numbers or an [`Error`] for any f64; all others are plain arithmetic. None panics for an f64.

#![forbid(unsafe_code)]

pub mod check;
mod curve;
mod error;
mod force_curve;
mod material;
mod mechanics;
mod table;

/// Values that are made at their first use, also in the child of a fork.
pub use low_rank::once;

pub use curve::{BelowNodes, Curve, QuantityGradient, StackShape};
pub use error::Error;
pub use force_curve::ForceCurve;
pub use material::{
    Elastic, HalfSpace, Material, MaterialParameter, Normalisation, Parameter, Probe, Profile,
    Quantities, Quantity, SubstratePoissonRatio, System,
};
pub use mechanics::{LoadAndPenetration, Mechanics};
pub use table::{Certificate, Description, Table, Tile, is_packed, schema};
