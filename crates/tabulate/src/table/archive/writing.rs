//! Writes a table as HDF5, where the feature `hdf5` is there.

use std::io;
use std::path::Path;

use interp::Table;

use crate::{Error, output};

/// Whether this program writes HDF5: it was built with the feature `hdf5`.
pub const WRITES_HDF5: bool = cfg!(feature = "hdf5");

/// Accepts a path that an HDF5 file can be written to, before any work is done for it.
///
/// # Errors
/// [`Error::Write`] naming `path`: if it ends in `.bin`, as packed tables do; if it is no UTF-8; if
/// this program was built without the feature `hdf5`.
pub(crate) fn check(path: &Path) -> Result<(), Error> {
    let refused = |why: &str| {
        Err(Error::Write {
            path: path.to_owned(),
            source: io::Error::other(why),
        })
    };
    if !WRITES_HDF5 {
        return refused(
            "this build cannot write HDF5; write the packed form, to a name that ends in .bin, or take a build with HDF5",
        );
    }
    let ending = path.extension();
    if ending.is_some_and(|ending| ending.eq_ignore_ascii_case("bin")) {
        return refused(
            "this file would be HDF5, and .bin is the ending of packed tables; write it to a name with the ending \
             .h5, and pack that with `tabulate pack TABLE.h5 -o TABLE.bin`",
        );
    }
    if std::path::absolute(path).is_ok_and(|path| path.to_str().is_none()) {
        return refused("its name or folder is no UTF-8, which HDF5 needs; choose another");
    }
    Ok(())
}

/// Writes the table; of a low-rank table, the values at its nodes.
///
/// The file is written under a temporary name and renamed when it is complete, so that `path` never
/// holds half a table.
///
/// # Errors
/// [`Error::Write`] with the path: if the file cannot be written, if `path` ends in `.bin` or is no
/// UTF-8, or if this program was built without the feature `hdf5`; those of [`Table::expand`].
pub fn write(table: &Table, path: &Path) -> Result<(), Error> {
    check(path)?;
    let table = table.expand()?;
    output::atomically(path, |unfinished| fill(&table, unfinished))
}

#[cfg(feature = "hdf5")]
fn fill(table: &Table, path: &Path) -> io::Result<()> {
    // The library tells a full disk in the middle of a long text.
    super::datasets::fill(table, path).map_err(|error| match error.to_string() {
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
