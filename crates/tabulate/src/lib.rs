//! Solves the adhesive contact of a sphere on a coated substrate and tabulates it.
//!
//! ```text
//! scene -> plan -> sweep( solve <- galerkin    <- bessel, quadrature, compliance <- material
//!                               <- wiener_hopf <- krylov, contour, symbol <- compliance ) -> certify -> archive (.h5), end_slope -> train -> pack (.bin)
//! ```
//!
//! Data flows one way along this line, and each word is a module here or, from the table on, in the
//! crate `interp`. [`curve`] makes the [`interp::Curve`] of one material without a table,
//! [`generate`] goes from a scene to the file of its table, and [`plot`] draws.

#![deny(unsafe_code)]

pub mod cli;
pub mod cost;
mod error;
mod output;
mod parallel;
pub mod plot;
pub mod report;
pub mod solve;
pub mod table;

pub use error::Error;
pub use solve::{curve, solve};
pub use table::generate;
