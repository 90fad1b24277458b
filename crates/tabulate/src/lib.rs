//! Solves the adhesive contact of a sphere on a coated substrate and tabulates it.
//!
//! ```text
//! scene -> plan -> sweep( solve <- galerkin    <- bessel, quadrature, compliance <- material
//!                               <- wiener_hopf <- krylov, contour, symbol <- compliance ) -> certify -> archive (.h5), end_slope -> train -> pack (.bin)
//! ```
//!
//! Data flows one way along this line, and each word is a module here or, from the table on, in the crate `interp`. [`curve`] makes
//! the [`interp::Curve`] of one material without a table, [`generate`] goes from a scene to the file of its table, and [`plot`] draws.

#![deny(unsafe_code)]

mod answer;
pub mod approximations;
pub mod archive;
mod bessel;
mod bindings;
pub mod certify;
pub mod cli;
pub mod compliance;
mod contour;
pub mod cost;
pub mod curve;
mod end_slope;
mod error;
mod galerkin;
pub mod generate;
mod journal;
mod krylov;
mod output;
pub mod pack;
pub mod plan;
pub mod plot;
mod quadrature;
pub mod report;
pub mod scene;
pub mod solve;
pub mod sweep;
mod symbol;
pub mod train;
mod wiener_hopf;

pub use error::Error;
