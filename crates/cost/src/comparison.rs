//! Rows against those of an earlier run, which another machine may have made.

use std::fmt::Display;

use serde::Serialize;
use serde_json::{Map, Value};

/// A measurement that differs from a recorded one, with its row and column and both values.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub struct Changed(String);

/// Errors that differ by at most this part of them are equal: rounding differs between processors.
const RELATIVE: f64 = 1e-2;
/// Errors that differ by at most this are equal.
const ABSOLUTE: f64 = 1e-13;

/// Compares rows with those of an earlier run.
///
/// - Texts and counts must be equal.
/// - Errors must agree to a hundredth or to 1e-13.
/// - Times, their differences and ratios, and numbers of threads are not compared. They depend on
///   the machine and on what else it does.
/// - If there are fewer rows `now`, the last rows of `before` are not compared.
///
/// # Errors
/// [`Changed`] with the row, the column and both values; also if there are more rows `now`.
///
/// # Panics
/// If a row is more than a struct of numbers and texts.
pub fn compare<R: Serialize>(before: &[R], now: &[R]) -> Result<(), Changed> {
    if now.len() > before.len() {
        let [before, now] = [before, now].map(<[R]>::len);
        return Err(changed(now, "the number of rows", before, now));
    }
    for (i, pair) in before.iter().zip(now).enumerate() {
        let [before, now] = [pair.0, pair.1].map(fields);
        for (column, before) in &before {
            let now = &now[column];
            if !depends_on_the_machine(column) && !agree(before, now) {
                return Err(changed(i + 1, column, before, now));
            }
        }
    }
    Ok(())
}

fn changed(row: usize, column: &str, before: impl Display, now: impl Display) -> Changed {
    Changed(format!("row {row}: {column} was {before} and is {now}"))
}

fn fields<R: Serialize>(row: &R) -> Map<String, Value> {
    match serde_json::to_value(row) {
        Ok(Value::Object(fields)) => fields,
        other => unreachable!("a row is a struct: {other:?}"),
    }
}

/// Whether a column is a time, comes from times, or is the number of threads.
fn depends_on_the_machine(column: &str) -> bool {
    column == "threads"
        || column == "time_ratio"
        || column.ends_with("seconds")
        || column.starts_with("break_even")
}

/// Whether two texts or counts are equal, or two errors but for rounding.
fn agree(before: &Value, now: &Value) -> bool {
    match before.as_f64().zip(now.as_f64()) {
        Some((a, b)) if before.is_f64() => {
            (a - b).abs() <= RELATIVE * a.abs().max(b.abs()) + ABSOLUTE
        }
        _ => before == now,
    }
}
