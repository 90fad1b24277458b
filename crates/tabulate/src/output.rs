//! Files that are either complete or not there.

use std::fs;
use std::io;
use std::path::Path;

use crate::Error;

/// Accepts a path at which a file can be made.
///
/// # Errors
/// [`Error::Write`] naming `path`.
pub fn check_writable(path: &Path) -> Result<(), Error> {
    let attempt = || match path.is_dir() {
        true => Err(io::Error::from(io::ErrorKind::IsADirectory)),
        false => temporary(path).map(drop),
    };
    attempt().map_err(|source| Error::Write { path: path.to_owned(), source })
}

/// Calls `fill` with a temporary path beside `path`, then flushes the file to disk and renames it to `path`.
///
/// # Errors
/// [`Error::Write`] naming `path`; an existing file is then untouched.
pub fn atomically(path: &Path, fill: impl FnOnce(&Path) -> io::Result<()>) -> Result<(), Error> {
    let attempt = || {
        let unfinished = temporary(path)?;
        fill(&unfinished)?;
        let file = fs::File::open(&unfinished)?;
        file.sync_all()?;
        share(&file)?;
        unfinished.persist(path).map_err(|e| e.error)
    };
    attempt().map_err(|source| Error::Write { path: path.to_owned(), source })
}

/// A new file in the same folder, removed when dropped.
fn temporary(path: &Path) -> io::Result<tempfile::TempPath> {
    // A bare file name has the empty path as its parent.
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    Ok(tempfile::Builder::new().prefix(".unfinished-").tempfile_in(folder)?.into_temp_path())
}

/// Temporary files are private; a finished one is for everybody to read.
#[cfg(unix)]
fn share(file: &fs::File) -> io::Result<()> {
    use std::os::unix::fs::PermissionsExt;
    file.set_permissions(fs::Permissions::from_mode(0o644))
}

#[cfg(not(unix))]
fn share(_: &fs::File) -> io::Result<()> {
    Ok(())
}
