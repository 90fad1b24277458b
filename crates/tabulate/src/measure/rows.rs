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
/// [`Measurement::range`], or a file without rows. It names the file and, where there is one, the
/// line, the column and the value.
pub fn read_csv<R: Measurement>(path: &Path) -> Result<Vec<R>, Error> {
    let rows = input::open(path, LONGEST).and_then(|(file, _)| rows(file));
    rows.map_err(|source| Error::Read {
        path: path.to_owned(),
        source,
    })
}

/// Reads the rows of an open file.
pub fn rows<R: Measurement>(file: impl io::Read) -> io::Result<Vec<R>> {
    let mut reader = CsvFile::new(file);
    let headers = reader.header()?;
    let mut rows = Vec::new();
    let mut record = csv::StringRecord::new();
    while let Some(line) = reader.read(&mut record)? {
        check::<R>(&headers, &record, line)?;
        let row = record.deserialize(Some(&headers));
        rows.push(row.map_err(|error| located(error, line))?);
    }
    if rows.is_empty() {
        return Err(invalid("it has no rows".to_owned()));
    }
    Ok(rows)
}

/// Accepts the numbers and the texts of a row, which may come from anywhere.
fn check<R: Measurement>(
    headers: &csv::StringRecord,
    record: &csv::StringRecord,
    line: u64,
) -> io::Result<()> {
    for (column, field) in headers.iter().zip(record) {
        let shown = printable::line(field);
        if shown != field {
            return Err(invalid(format!(
                "line {line}: {} = {shown} holds characters that are not printed; remove them",
                printable::line(column)
            )));
        }
        if let Some([from, to]) = R::range(column)
            && let Ok(value) = field.parse::<f64>()
            && !(value >= from && value <= to)
        {
            return Err(invalid(format!(
                "line {line}: {} = {field} is outside {from:e} to {to:e}; measure it again, or remove the row",
                printable::line(column)
            )));
        }
    }
    Ok(())
}
