//! Measurements: what accuracy costs in time and memory.
//!
//! Each of `solve`, `table`, `lookup`, `effects` and `history` is one `tabulate cost` command. It has a `Row`,
//! a function `measure` that returns all rows as [`Measured`], and a function `markdown` that sums
//! the rows up. `rows` writes rows as CSV and reads them, `comparison` compares them with the rows
//! of an earlier run. `clock` measures times, `deviation` measures errors, `numbers` prints
//! numbers. `nystrom` and `approximations` are the methods and closed forms that solves and lookups
//! are measured beside.
//!
//! Two runs of one program on one kind of processor differ only in their times.

pub mod approximations;
pub mod clock;
mod comparison;
pub mod deviation;
pub mod effects;
pub mod history;
pub mod lookup;
pub(crate) mod numbers;
pub mod nystrom;
mod rows;
pub mod solve;
pub mod table;

pub use comparison::compare;
pub(crate) use lookup::random_points;
pub use rows::{Measurement, read_csv, read_earlier, to_csv};

/// Rows that were measured, and the reasons for those that were not.
#[derive(Clone, Debug)]
pub struct Measured<R> {
    /// The rows, in a fixed order.
    pub rows: Vec<R>,
    /// Sentences that name each missing row, with the reason.
    pub left_out: Vec<String>,
}

impl<R> From<Vec<R>> for Measured<R> {
    /// Returns the rows as complete: nothing is left out.
    fn from(rows: Vec<R>) -> Self {
        Self {
            rows,
            left_out: Vec::new(),
        }
    }
}
