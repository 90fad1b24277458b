//! A table as the command line names it: a file, or the word `embedded`.

use std::borrow::Cow;
use std::ffi::OsString;
use std::fmt;
use std::fs::{self, File};
use std::io::{self, ErrorKind, Read};
use std::path::{Path, PathBuf};

use anyhow::{Context, anyhow};
use clap::builder::{PathBufValueParser, TypedValueParser};
use interp::Table;

use super::note;
use super::output::has_ending;
use crate::printable;

/// The word for the table that is compiled into the program.
const EMBEDDED: &str = "embedded";

/// The endings of scenes, measurements, pages and figures.
const NO_TABLES: [&str; 6] = ["toml", "csv", "json", "html", "svg", "png"];

/// The help of every argument that is a [`TableName`].
pub const HELP: &str = "The table: an HDF5 or packed file, or the word `embedded` for the table that is compiled into \
                        the program (a file of that name is ./embedded)";

/// A table as the command line names it.
#[derive(Clone, Debug)]
pub enum TableName {
    /// The table that is compiled into the program.
    Embedded,
    /// An HDF5 or packed file.
    File(PathBuf),
}

impl From<OsString> for TableName {
    fn from(name: OsString) -> Self {
        if name == EMBEDDED {
            Self::Embedded
        } else {
            Self::File(name.into())
        }
    }
}

impl fmt::Display for TableName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Embedded => f.write_str(EMBEDDED),
            Self::File(path) => f.write_str(&printable::path(path)),
        }
    }
}

impl TableName {
    /// Returns the path of a file, none of the embedded table.
    pub fn path(&self) -> Option<&Path> {
        match self {
            Self::Embedded => None,
            Self::File(path) => Some(path),
        }
    }

    /// Reads the table. The first bytes of a file decide between HDF5 and the packed form.
    pub fn read(&self) -> anyhow::Result<Cow<'static, Table>> {
        let path = match self {
            Self::Embedded => return Ok(Cow::Borrowed(Table::embedded())),
            Self::File(path) => path,
        };
        let mut start = Vec::new();
        readable(path)
            .and_then(|()| File::open(path))
            .and_then(|file| file.take(8).read_to_end(&mut start))
            .map_err(|error| match error.kind() {
                ErrorKind::NotFound => anyhow!(
                    "there is no table {self} ({error}); give the path of a table, or the word `{EMBEDDED}` for the one \
                     that is compiled into the program"
                ),
                _ => anyhow!("cannot read {self}: {error}"),
            })?;
        let read = if interp::is_packed(&start) {
            Table::read
        } else {
            open_hdf5
        };
        Ok(Cow::Owned(read(path)?))
    }

    /// Reads the table for contacts: notes on standard error that it misses its tolerance.
    pub fn read_for_contacts(&self) -> anyhow::Result<Cow<'static, Table>> {
        let table = self.read()?;
        let description = table.description();
        if description.certificate.max_error > description.tolerance {
            note(&format!(
                "{self} misses its tolerance of {:.1e}: the largest error that its certificate found is {:.1e}. Make it again over \
                 a smaller range, with a larger tolerance, or with more nodes where its scene states them, or use `{EMBEDDED}`.",
                description.tolerance, description.certificate.max_error
            ));
        }
        Ok(table)
    }

    /// Returns the size of the file in bytes; of the embedded `table`, the size of its packed form.
    pub fn bytes(&self, table: &Table) -> anyhow::Result<u64> {
        match self {
            Self::Embedded => Ok(table.to_packed()?.len() as u64),
            Self::File(path) => Ok(fs::metadata(path)
                .with_context(|| printable::path(path))?
                .len()),
        }
    }
}

/// Accepts a path that can be read more than once.
fn readable(path: &Path) -> io::Result<()> {
    // Before it is opened: a pipe would wait for a writer.
    if fs::metadata(path)?.is_file() {
        Ok(())
    } else {
        Err(io::Error::other(
            "it is not a file; a table is read more than once: write a pipe's content to a file first",
        ))
    }
}

/// Parses the name of an HDF5 file to write.
pub fn hdf5_file() -> impl TypedValueParser<Value = PathBuf> {
    const WHY: &str =
        "this command writes HDF5: let the name end in .h5; `tabulate pack` writes the packed form";
    file_without(&["bin"], WHY)
}

/// Parses the name of a packed file to write.
#[cfg(feature = "compress")]
pub fn packed_file() -> impl TypedValueParser<Value = PathBuf> {
    const WHY: &str = "this command writes the packed form: let the name end in .bin; `tabulate unpack` writes HDF5";
    file_without(&["h5", "hdf5"], WHY)
}

/// Parses the name of a file to write, which has none of the `endings` of the other form of tables, nor
/// that of a file that is no table.
fn file_without(
    endings: &'static [&str],
    why: &'static str,
) -> impl TypedValueParser<Value = PathBuf> {
    PathBufValueParser::new().try_map(move |path| {
        if has_ending(&path, endings) || has_ending(&path, &NO_TABLES) {
            Err(why)
        } else {
            Ok(path)
        }
    })
}

#[cfg(feature = "read-hdf5")]
fn open_hdf5(path: &Path) -> Result<Table, interp::Error> {
    Table::open(path)
}

/// Refuses an HDF5 table.
#[cfg(not(feature = "read-hdf5"))]
fn open_hdf5(_: &Path) -> Result<Table, interp::Error> {
    let what = "it is no packed table, and this program was built without HDF5";
    Err(interp::Error::Foreign(what.into()))
}
