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
//! Data flows from left to right, and never back.
//!
//! The program is behind the feature `cli`, and `measure`, `plot` and `report` are behind the feature
//! `figures`; `compress` and `low_rank` of `table` are behind the feature `compress`. All are on by default.

#![deny(unsafe_code)]

#[cfg(feature = "cli")]
pub mod cli;
#[cfg(feature = "cli")]
mod csv_file;
mod error;
#[cfg(test)]
mod hostile;
mod input;
#[cfg(feature = "cli")]
pub mod large_contact;
#[cfg(feature = "figures")]
pub mod measure;
mod output;
#[cfg(feature = "figures")]
pub mod plot;
mod printable;
#[cfg(feature = "figures")]
pub mod report;
pub mod stack;
pub mod table;

pub use error::Error;
pub use table::generate;
