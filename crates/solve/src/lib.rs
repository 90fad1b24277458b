//! The solver: from a material and `a/t` to the four quantities, with an estimate of their error.
//!
//! `solution` accepts a contact within the `domain` and lets `method` choose: `galerkin` for thick films and for stacks of
//! layers, `wiener_hopf` for thin films. Both know what the probe touches by its `compliance`, and return an `estimate`.
//! `stacked` solves a stack, under one sphere or many. A probe with the profile `r^n` (`power_law`) is one more column of
//! Galerkin's method, and one more functional of the result of the Wiener-Hopf method. `batch` solves many materials at one
//! `a/t`, `adaptive_curve` one material along `a/t`.

#![forbid(unsafe_code)]

mod adaptive_curve;
mod batch;
pub mod cohesive;
mod compliance;
mod domain;
mod error;
mod estimate;
mod galerkin;
mod method;
pub mod parallel;
mod power_law;
mod solution;
pub mod stack;
mod stacked;
pub mod stick;
mod wiener_hopf;

pub use adaptive_curve::{CURVE_TOLERANCE, curve};
pub use batch::Batch;
pub use compliance::Compliance;
pub use compliance::layered::LayeredCompliance;
pub use compliance::surface::{Sample, SurfaceCompliance};
pub use domain::{A_OVER_T, TOLERANCE};
pub use error::Error;
pub use estimate::larger;
pub use galerkin::quadrature::{GaussLegendre, PanelWeights, Panels};
pub use method::Method;
pub use power_law::{EXPONENTS, PowerLaw};
pub use solution::{Solution, solve, solve_power_laws};
pub use stacked::{check_reach, solve_stack_under_spheres};
pub use stacked::{solve_stack, solve_stack_power_laws, stack_curve};
