//! Solves the adhesive contact of a sphere on a coated substrate and tabulates it.
//!
//! Data flows one way:
//!
//! ```text
//! scene -> sweep( solve <- galerkin <- bessel, quadrature, compliance <- material ) -> table -> archive (.h5) / pack (.bin)
//! ```

#![forbid(unsafe_code)]

pub mod bessel;
pub mod compliance;
mod error;
pub mod galerkin;
pub mod quadrature;
pub mod solve;

pub use error::Error;
