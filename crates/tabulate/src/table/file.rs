//! The file of a finished table: packed if its name ends in `.bin`, else HDF5.

use std::path::Path;
use std::{fs, io};

use interp::Table;

use crate::{Error, output};

/// Whether this program writes HDF5: it was built with the feature `hdf5`.
pub const WRITES_HDF5: bool = cfg!(feature = "hdf5");

/// Returns whether the file of this name holds the packed form.
fn is_packed(path: &Path) -> bool {
    path.extension()
        .is_some_and(|ending| ending.eq_ignore_ascii_case("bin"))
}

/// Accepts a path that the table can be written to, before any work is done for it.
///
/// # Errors
/// [`Error::Write`] naming `path`, for an HDF5 file: if the path is no UTF-8, or if this program was built without
/// the feature `hdf5`.
pub(super) fn check(path: &Path) -> Result<(), Error> {
    let is_no_text = || std::path::absolute(path).is_ok_and(|path| path.to_str().is_none());
    let why = match is_packed(path) {
        true => return Ok(()),
        false if !WRITES_HDF5 => {
            "this build cannot write HDF5; write the packed form, to a name that ends in .bin, or take a build with HDF5"
        }
        false if is_no_text() => "its name or folder is no UTF-8, which HDF5 needs; choose another",
        false => return Ok(()),
    };
    Err(Error::Write {
        path: path.to_owned(),
        source: io::Error::other(why),
    })
}

/// Writes the table; as HDF5 of a low-rank table, the values at its nodes. An existing file is replaced when the new
/// one is complete.
///
/// # Errors
/// [`Error::Write`] with the path, if it cannot be written, or not as HDF5; those of [`Table::expand`].
pub fn write(table: &Table, path: &Path) -> Result<(), Error> {
    check(path)?;
    if is_packed(path) {
        let packed = table.to_packed()?;
        return output::atomically(path, |unfinished| fs::write(unfinished, packed));
    }
    let table = table.expand()?;
    output::atomically(path, |unfinished| fill(&table, unfinished))
}

#[cfg(feature = "hdf5")]
fn fill(table: &Table, path: &Path) -> io::Result<()> {
    // The library tells a full disk in the middle of a long text.
    super::archive::fill(table, path).map_err(|error| match error.to_string() {
        text if text.contains("No space left on device") => {
            io::Error::new(io::ErrorKind::StorageFull, "No space left on device")
        }
        _ => io::Error::other(error),
    })
}

#[cfg(not(feature = "hdf5"))]
fn fill(_: &Table, _: &Path) -> io::Result<()> {
    Err(io::ErrorKind::Unsupported.into())
}
