//! Rows as CSV.

use std::io;
use std::path::Path;

use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::Error;

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

/// Reads rows that [`to_csv`] wrote.
///
/// # Errors
/// [`Error::Read`] for a file that cannot be read, a line that is not such a row, or a file without
/// rows. It names the file and, where there is one, the line.
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
