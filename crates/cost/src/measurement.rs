//! Rows of measurements, and the ranges of their numbers.

use serde::Serialize;
use serde::de::DeserializeOwned;

/// A row of measurements.
pub trait Measurement: Serialize + DeserializeOwned {
    /// The columns of numbers, with the ranges that a summary or a figure can show. An empty field
    /// is no number.
    const RANGES: &'static [(&'static str, [f64; 2])];
}

/// The range of a time that was measured, in seconds.
pub(crate) const TIME: [f64; 2] = [1e-12, 1e9];
/// The range of a relative tolerance.
pub(crate) const TOLERANCE: [f64; 2] = [1e-30, 1.0];
/// The range of a relative error.
pub(crate) const ERROR: [f64; 2] = [0.0, 1e30];
/// The range of a number of bytes or solves.
pub(crate) const COUNT: [f64; 2] = [0.0, 1e15];

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

/// Returns the rows as CSV. The header has the names of their fields. Every number is read back as
/// the `f64` that was written.
///
/// # Panics
/// If a row is more than a struct of numbers and texts.
pub fn to_csv<R: Serialize>(rows: &[R]) -> Vec<u8> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for row in rows {
        writer
            .serialize(row)
            .expect("a row is flat, and writing to memory does not fail");
    }
    writer
        .into_inner()
        .expect("writing to memory does not fail")
}
