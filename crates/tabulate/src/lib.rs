//! Solves the adhesive contact of a sphere on a coated substrate and tabulates it.
//!
//! [`solve()`] solves one contact, [`curve`] makes the [`interp::Curve`] of one material without a
//! table, and [`generate`](generate()) goes from a scene, which describes a table, to its file.
//!
//! ```text
//! one contact    material, a/t ----------> solve ---------> quantities, estimated error
//! one material   material, range of a/t -> curve ---------> interp::Curve
//! a table        scene -> plan -> sweep -> certify -------> .h5 (archive) -> .bin (compress)
//!                         nodes   batches  largest error
//!                                 of solves  at sampled points
//! ```
//!
//! Data flows from left to right, and never back. The modules of the crate:
//!
//! | module | holds |
//! |---|---|
//! | [`solve`](mod@solve) | the solver: the film's compliance, the methods of solution, many contacts at once |
//! | [`stack`] | stacks of layers on a base |
//! | [`cohesive`] | an attraction of finite range |
//! | [`parallel`] | work on all cores |
//! | [`table`] | from a scene to a certified table, and its files |
//! | [`cost`] | measurements of time and accuracy |
//! | [`plot`] | the figures |
//! | [`report`] | the interactive page |
//! | [`cli`] | the program `tabulate` |
//!
//! The last four are behind the feature `cli`, which is on by default.
//!
//! Lookup in a finished table, curves and contact mechanics are in the crate `interp`, which does
//! not depend on this one.

#![deny(unsafe_code)]

#[cfg(feature = "cli")]
pub mod cli;
#[cfg(feature = "cli")]
pub mod cost;
mod error;
#[cfg(test)]
mod hostile;
mod input;
mod output;
#[cfg(feature = "cli")]
pub mod plot;
mod printable;
#[cfg(feature = "cli")]
pub mod report;
pub mod stack;
pub mod table;

pub use error::Error;
pub use table::generate;
