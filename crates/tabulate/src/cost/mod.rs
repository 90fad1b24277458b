//! What accuracy costs in time and memory, measured: each module here is one `tabulate cost`
//! command.
//!
//! Each has a `Row`, a function that measures all rows and one that sums them up as Markdown. Of
//! the same program on the same kind of processor, two runs differ in their times alone.

pub mod approximations;
pub mod clock;
pub mod deviation;
pub mod effects;
pub mod lookup;
pub mod nystrom;
pub mod solve;
pub mod table;

pub(crate) use lookup::random_points;

use std::io;
use std::path::Path;

use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::Value;

use crate::Error;

/// The rows as CSV, with the names of their fields as the header. Numbers read back to the same
/// `f64`.
///
/// # Panics
/// If a row is more than a struct of numbers and texts.
pub fn to_csv<R: Serialize>(rows: &[R]) -> Vec<u8> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for row in rows {
        writer
            .serialize(row)
            .expect("rows are flat, and memory takes them");
    }
    writer.into_inner().expect("memory takes them")
}

/// Reads the rows that [`to_csv`] made.
///
/// # Errors
/// [`Error::Read`] naming the file, the line and what is wrong with it, or that there is no row.
pub fn read_csv<R: DeserializeOwned>(path: &Path) -> Result<Vec<R>, Error> {
    let attempt = || {
        csv::Reader::from_path(path)?
            .deserialize()
            .collect::<Result<Vec<_>, _>>()
    };
    let failed = |source| Error::Read {
        path: path.to_owned(),
        source,
    };
    let rows = attempt().map_err(|error| failed(error.into()))?;
    if rows.is_empty() {
        Err(failed(io::Error::new(
            io::ErrorKind::InvalidData,
            "it has no rows",
        )))
    } else {
        Ok(rows)
    }
}

/// The times of two runs may differ by this factor, because machines do and what else they do.
pub const TIME_FACTOR: f64 = 10.0;

/// Compares rows with those of an earlier run: texts and counts must be the same, errors the same
/// to a hundredth or 1e-13, as rounding differs between processors, and times within
/// [`TIME_FACTOR`]. The number of threads is left out, and what follows from differences and ratios
/// of times, the `saved_seconds` and `break_even`s of some rows; so are the last rows before, if
/// there are fewer now.
///
/// # Errors
/// [`Error::Changed`] naming the row, the column and both values.
///
/// # Panics
/// If a row is more than a struct of numbers and texts.
pub fn compare<R: Serialize>(before: &[R], now: &[R]) -> Result<(), Error> {
    let fields = |row: &R| match serde_json::to_value(row) {
        Ok(Value::Object(fields)) => fields,
        other => unreachable!("a row is a struct: {other:?}"),
    };
    if now.len() > before.len() {
        let [before, now] = [before, now].map(|rows| rows.len().to_string());
        return Err(Error::Changed {
            row: now.len(),
            column: "the number of rows".to_owned(),
            before,
            now,
        });
    }
    for (i, (before, now)) in before
        .iter()
        .map(fields)
        .zip(now.iter().map(fields))
        .enumerate()
    {
        for ((column, before), now) in before.iter().zip(now.values()) {
            if !alike(column, before, now) {
                let [before, now] = [before, now].map(Value::to_string);
                return Err(Error::Changed {
                    row: i + 1,
                    column: column.clone(),
                    before,
                    now,
                });
            }
        }
    }
    Ok(())
}

/// Whether two values of a column are the same but for noise.
fn alike(column: &str, before: &Value, now: &Value) -> bool {
    if ["threads", "saved_seconds"].contains(&column) || column.starts_with("break_even") {
        return true;
    }
    let Some((a, b)) = before.as_f64().zip(now.as_f64()) else {
        return before == now;
    };
    match column {
        _ if column.ends_with("seconds") => a.max(b) <= TIME_FACTOR * a.min(b),
        _ if before.is_f64() => (a - b).abs() <= 1e-2 * a.abs().max(b.abs()) + 1e-13,
        _ => before == now,
    }
}
