//! Measurements: what accuracy costs in time and memory, and the other methods that solves and lookups are measured beside.
//!
//! Each of [`mod@solve`], [`table`], [`lookup`], [`effects`] and [`history`] is one `tabulate cost` command. It has a `Row` and a
//! function `markdown` that sums the rows up. `solve`, `lookup` and `history` have a function `measure` that
//! returns all rows; those of `table` and `effects` need tables to be made, which the program does. `measurement` writes rows as CSV,
//! [`compare`] compares them with the rows of an earlier run. [`clock`] measures times, [`deviation`] measures errors, `numbers`
//! prints numbers. [`nystrom`] and [`approximations`] are the other methods.
//!
//! Two runs of one program on one kind of processor differ only in their times.

#![forbid(unsafe_code)]

pub mod approximations;
pub mod clock;
mod comparison;
pub mod deviation;
pub mod effects;
pub mod history;
mod load;
pub mod lookup;
mod measurement;
pub mod numbers;
pub mod nystrom;
pub mod solve;
pub mod table;

pub use comparison::{Changed, compare};
pub use measurement::{Measured, Measurement, to_csv};
