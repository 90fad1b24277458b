//! Galerkin's method, for thick films and for stacks of layers.
//!
//! `galerkin` adds modes and panels until the error is small enough, `operator` holds the matrices and solves them, of
//! which `slope` is one. `abscissae` are the points of the integrals on the panels of `quadrature`, with the values of
//! Bessel functions (`bessel`, `sine`) there.

pub mod abscissae;
pub mod bessel;
mod galerkin;
pub mod operator;
pub mod quadrature;
pub mod sine;
pub mod slope;

pub use self::galerkin::*;
