//! Rows of measurements, and the ranges of their numbers.

use serde::Serialize;
use serde::de::DeserializeOwned;

/// A row of measurements.
pub trait Measurement: Serialize + DeserializeOwned {
    /// The shortest time in `seconds`.
    const SHORTEST: f64 = 1e-12;

    /// Returns the range of the numbers in a column that a summary or a figure can show, by the name of the column; none for a
    /// column where all can be shown. An empty field is no number.
    fn range(column: &str) -> Option<[f64; 2]> {
        let ends = |words: &[&str]| words.iter().any(|word| column.ends_with(word));
        Some(match column {
            "tolerance" => [1e-30, 1.0],
            "a_over_t" => [1e-30, 1e30],
            "axes" => [0.0, 4.0],
            "threads" => [1.0, 1e6],
            "max_factor" => [1.0, 1e30],
            "time_ratio" => [0.0, 1e9],
            "break_even_alone" | "break_even_along" => [0.0, f64::INFINITY],
            _ if column.starts_with("saved") => [-1e15, 1e15],
            _ if ends(&["seconds"]) => [Self::SHORTEST, 1e9],
            _ if ends(&["solves", "bytes", "points"]) => [0.0, 1e15],
            _ if ends(&["error", "error_estimated"]) => [0.0, 1e30],
            _ => return None,
        })
    }
}

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
