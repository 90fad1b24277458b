//! Tabulates the adhesive contact of a sphere on a coated substrate, and certifies the tables.
//!
//! [`generate`](generate()) goes from a scene, which describes a table, to its file. The solves are
//! those of the crate `solve`.
//!
//! ```text
//! scene -> plan -> sweep -> certify -------> .h5 (archive) -> .bin (compress)
//!          nodes   batches  largest error
//!                  of solves  at sampled points
//! ```
//!
//! Data flows from left to right, and never back. The modules of the crate:
//!
//! | module | holds |
//! |---|---|
//! | [`stack`] | stacks of layers as TOML |
//! | [`table`] | from a scene to a certified table, and its files |
//! | [`cost`] | measurements of time and accuracy |
//! | [`plot`] | the figures |
//! | [`report`] | the interactive page |
//! | [`cli`] | the program `tabulate` |
//!
//! The last four are behind the feature `cli`, which is on by default.

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
