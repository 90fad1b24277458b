//! Files of rows.

use std::io;
use std::path::Path;

use cost::Measurement;

use crate::csv_file::{CsvFile, located};
use crate::input::invalid;
use crate::{Error, input, printable};

/// The largest number of bytes of a file of rows. A larger one is taken for a mistake.
const LONGEST: u64 = 1 << 24;

/// Reads rows that [`cost::to_csv`] wrote, to show them.
///
/// # Errors
/// [`Error::Read`] for a file that cannot be read, a line that is not such a row, a number outside
/// [`Measurement::RANGES`], or a file without rows. It names the file and, where there is one, the
/// line, the column and the value.
pub fn read_csv<R: Measurement>(path: &Path) -> Result<Vec<R>, Error> {
    read(path, R::RANGES)
}

/// Reads such rows with other ranges of numbers.
pub(crate) fn read<R: Measurement>(
    path: &Path,
    ranges: &[(&str, [f64; 2])],
) -> Result<Vec<R>, Error> {
    let rows = input::open(path, LONGEST).and_then(|(file, _)| rows(file, ranges));
    rows.map_err(|source| Error::Read {
        path: path.to_owned(),
        source,
    })
}

/// Reads the rows of an open file.
pub fn rows<R: Measurement>(
    file: impl io::Read,
    ranges: &[(&str, [f64; 2])],
) -> io::Result<Vec<R>> {
    let mut reader = CsvFile::new(file);
    let headers = reader.header()?;
    let mut rows = Vec::new();
    let mut record = csv::StringRecord::new();
    while let Some(line) = reader.read(&mut record)? {
        check(&headers, &record, line, ranges)?;
        let row = record.deserialize(Some(&headers));
        rows.push(row.map_err(|error| located(error, line))?);
    }
    if rows.is_empty() {
        return Err(invalid("it has no rows".to_owned()));
    }
    Ok(rows)
}

/// Accepts the numbers and the texts of a row, which may come from anywhere.
fn check(
    headers: &csv::StringRecord,
    record: &csv::StringRecord,
    line: u64,
    ranges: &[(&str, [f64; 2])],
) -> io::Result<()> {
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
