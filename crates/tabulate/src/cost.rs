//! What accuracy costs in time and memory, measured: each module here is one `tabulate cost` command.
//!
//! Each has a `Row`, a function that measures all rows and one that sums them up as Markdown. Of the same program on the same
//! kind of processor, two runs differ in their times alone.

pub mod clock;
pub mod effects;
pub mod error;
pub mod lookup;
pub mod nystrom;
pub mod solve;
pub mod table;

use std::path::Path;

use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::Error;

/// The rows as CSV, with the names of their fields as the header. Numbers read back to the same `f64`.
///
/// # Panics
/// If a row is more than a struct of numbers and texts.
pub fn to_csv<R: Serialize>(rows: &[R]) -> Vec<u8> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for row in rows {
        writer.serialize(row).expect("rows are flat, and memory takes them");
    }
    writer.into_inner().expect("memory takes them")
}

/// Reads the rows that [`to_csv`] made.
///
/// # Errors
/// [`Error::Read`] naming the file, the line and what is wrong with it.
pub fn read_csv<R: DeserializeOwned>(path: &Path) -> Result<Vec<R>, Error> {
    let attempt = || csv::Reader::from_path(path)?.deserialize().collect::<Result<Vec<_>, _>>();
    attempt().map_err(|error| Error::Read { path: path.to_owned(), source: error.into() })
}
