//! Rows as CSV.

use std::io;
use std::path::Path;

use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::{Error, input, printable};

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

/// A row of measurements.
pub trait Measurement: Serialize + DeserializeOwned {
    /// The columns of numbers, with the ranges that a summary or a figure can show. An empty field
    /// is no number.
    const RANGES: &'static [(&'static str, [f64; 2])];
}

/// The range of a time that was measured, in seconds.
pub(super) const TIME: [f64; 2] = [1e-12, 1e9];
/// The range of a relative tolerance.
pub(super) const TOLERANCE: [f64; 2] = [1e-30, 1.0];
/// The range of a relative error.
pub(super) const ERROR: [f64; 2] = [0.0, 1e30];
/// The range of a number of bytes or solves.
pub(super) const COUNT: [f64; 2] = [0.0, 1e15];

/// The largest number of bytes of a file of rows. A larger one is taken for a mistake.
const LONGEST: u64 = 1 << 24;

/// Reads rows that [`to_csv`] wrote, to show them.
///
/// # Errors
/// [`Error::Read`] for a file that cannot be read, a line that is not such a row, a number outside
/// [`Measurement::RANGES`], or a file without rows. It names the file and, where there is one, the
/// line, the column and the value.
pub fn read_csv<R: Measurement>(path: &Path) -> Result<Vec<R>, Error> {
    read(path, R::RANGES)
}

/// Reads rows that [`to_csv`] wrote, to [`compare`](super::compare) others with them: a time of 0
/// was not measured.
///
/// # Errors
/// As [`read_csv`], but for the ranges.
pub fn read_earlier<R: Measurement>(path: &Path) -> Result<Vec<R>, Error> {
    read(path, &[])
}

fn read<R: Measurement>(path: &Path, ranges: &[(&str, [f64; 2])]) -> Result<Vec<R>, Error> {
    let attempt = || {
        let mut reader = csv::Reader::from_reader(input::open(path, LONGEST)?.0);
        let headers = reader.headers()?.clone();
        let mut rows = Vec::new();
        for record in reader.records() {
            let record = record?;
            check(&headers, &record, ranges)?;
            rows.push(record.deserialize(Some(&headers))?);
        }
        if rows.is_empty() {
            return Err(invalid("it has no rows".to_owned()));
        }
        Ok(rows)
    };
    attempt().map_err(|source: io::Error| Error::Read {
        path: path.to_owned(),
        source,
    })
}

/// Accepts the numbers and the texts of a row, which may come from anywhere.
fn check(
    headers: &csv::StringRecord,
    record: &csv::StringRecord,
    ranges: &[(&str, [f64; 2])],
) -> io::Result<()> {
    let line = record.position().map_or(0, csv::Position::line);
    for (column, field) in headers.iter().zip(record) {
        let shown = printable::line(field);
        if shown != field {
            return Err(invalid(format!(
                "line {line}: {} = {shown} holds characters that are not printed; remove them",
                printable::line(column)
            )));
        }
        let range = ranges.iter().find(|(name, _)| *name == column);
        if let Some((name, [from, to])) = range
            && let Ok(value) = field.parse::<f64>()
            && !(value >= *from && value <= *to)
        {
            return Err(invalid(format!(
                "line {line}: {name} = {field} is outside {from:e} to {to:e}; measure it again, or remove the row"
            )));
        }
    }
    Ok(())
}

fn invalid(why: String) -> io::Error {
    io::Error::new(io::ErrorKind::InvalidData, why)
}
