//! Rows against those of an earlier run, which another machine may have made.

use serde::Serialize;
use serde_json::{Map, Value};

use super::clock::median;
use crate::Error;

/// The largest factor by which a time may have changed more than the other times of its column.
pub const TIME_FACTOR: f64 = 10.0;

/// Errors that differ by at most this part of them are equal: rounding differs between processors.
const RELATIVE: f64 = 1e-2;
/// Errors that differ by at most this are equal.
const ABSOLUTE: f64 = 1e-13;

/// Compares rows with those of an earlier run.
///
/// - Texts and counts must be equal.
/// - Errors must agree to a hundredth or to 1e-13.
/// - Times must agree within [`TIME_FACTOR`] after division by the median ratio of their column. So
///   the result does not depend on the speed of the machine or on its number of threads. A time
///   that was 0 was not measured, and is not compared.
/// - The columns `threads`, `saved_seconds` and `break_even_*` are not compared: the latter are
///   differences and ratios of times.
/// - If there are fewer rows `now`, the last rows of `before` are not compared.
///
/// # Errors
/// [`Error::Changed`] with the row, the column and both values; also if there are more rows `now`.
///
/// # Panics
/// If a row is more than a struct of numbers and texts.
pub fn compare<R: Serialize>(before: &[R], now: &[R]) -> Result<(), Error> {
    if now.len() > before.len() {
        let [before, now] = [before, now].map(|rows| rows.len().to_string());
        return Err(Error::Changed {
            row: now.len(),
            column: "the number of rows".to_owned(),
            before,
            now,
        });
    }
    let pairs: Vec<[Map<String, Value>; 2]> = before
        .iter()
        .zip(now)
        .map(|(before, now)| [fields(before), fields(now)])
        .collect();
    for (i, [before, now]) in pairs.iter().enumerate() {
        for (column, before) in before {
            let now = &now[column];
            let remark = if is_derived(column) {
                continue;
            } else if is_time(column) {
                let pace = pace(&pairs, column);
                match ratio(before, now) {
                    Some(ratio) if !within(TIME_FACTOR, ratio / pace) => {
                        format!(", and the column takes {pace:.2} times as long")
                    }
                    _ => continue,
                }
            } else if agree(before, now) {
                continue;
            } else {
                String::new()
            };
            return Err(Error::Changed {
                row: i + 1,
                column: column.clone(),
                before: before.to_string(),
                now: format!("{now}{remark}"),
            });
        }
    }
    Ok(())
}

fn fields<R: Serialize>(row: &R) -> Map<String, Value> {
    match serde_json::to_value(row) {
        Ok(Value::Object(fields)) => fields,
        other => unreachable!("a row is a struct: {other:?}"),
    }
}

/// Whether a column depends on the machine or is a difference or a ratio of times.
fn is_derived(column: &str) -> bool {
    ["threads", "saved_seconds", "time_ratio"].contains(&column) || column.starts_with("break_even")
}

fn is_time(column: &str) -> bool {
    column.ends_with("seconds")
}

/// The median ratio of the times of a column: that of the two machines. 1 where no time is
/// compared.
fn pace(pairs: &[[Map<String, Value>; 2]], column: &str) -> f64 {
    let ratios: Vec<f64> = pairs
        .iter()
        .filter_map(|[before, now]| ratio(&before[column], &now[column]))
        .collect();
    if ratios.is_empty() {
        1.0
    } else {
        median(ratios)
    }
}

/// The second time over the first; none if the first is 0.
fn ratio(before: &Value, now: &Value) -> Option<f64> {
    let (before, now) = before.as_f64().zip(now.as_f64())?;
    (before != 0.0).then_some(now / before)
}

fn within(factor: f64, ratio: f64) -> bool {
    (1.0 / factor..=factor).contains(&ratio)
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
