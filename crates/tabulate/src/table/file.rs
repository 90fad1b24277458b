//! The file of a finished table: packed if its name ends in `.bin`, else HDF5.

use std::fs;
use std::path::Path;

use interp::Table;

use crate::table::archive;
use crate::{Error, output};

/// Returns whether the file of this name holds the packed form.
fn is_packed(path: &Path) -> bool {
    path.extension()
        .is_some_and(|ending| ending.eq_ignore_ascii_case("bin"))
}

/// Accepts a path that the table can be written to, before any work is done for it.
///
/// # Errors
/// Those of [`archive::write`] for an HDF5 file.
pub fn check(path: &Path) -> Result<(), Error> {
    if is_packed(path) {
        Ok(())
    } else {
        archive::check(path)
    }
}

/// Writes the table. An existing file is replaced when the new one is complete.
///
/// # Errors
/// [`Error::Write`] with the path; those of [`archive::write`] for an HDF5 file.
pub fn write(table: &Table, path: &Path) -> Result<(), Error> {
    if !is_packed(path) {
        return archive::write(table, path);
    }
    let packed = table.to_packed()?;
    output::atomically(path, |unfinished| fs::write(unfinished, packed))
}
