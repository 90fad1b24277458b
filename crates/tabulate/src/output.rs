//! Files that are either complete or not there.

use std::fs::File;
use std::io;
use std::path::{Path, PathBuf};

use tempfile::TempPath;

use crate::Error;

/// Accepts an output, before any work, if a file can be made or replaced there and if it is not the
/// `input`.
///
/// # Errors
/// [`Error::Write`] naming the output.
pub fn check(output: Option<&Path>, input: Option<&Path>) -> Result<(), Error> {
    let Some(path) = output else { return Ok(()) };
    let same = |input: &Path| {
        input
            .canonicalize()
            .is_ok_and(|input| path.canonicalize().is_ok_and(|path| path == input))
    };
    let attempt = || match input {
        Some(input) if same(input) => Err(io::Error::other("it is the input")),
        // Without a name, so that nothing is left behind if the process is killed here.
        _ => tempfile::tempfile_in(existing_folder(&target(path)?)?).map(drop),
    };
    attempt().map_err(|source| Error::Write {
        path: path.to_owned(),
        source,
    })
}

/// Calls `fill` with a temporary path beside `path`, then flushes the file to disk and renames it
/// to `path`.
///
/// # Errors
/// [`Error::Write`] naming `path`; an existing file is then untouched. Anything but a file at
/// `path`, a device for instance, is an error.
pub fn atomically(path: &Path, fill: impl FnOnce(&Path) -> io::Result<()>) -> Result<(), Error> {
    let attempt = || {
        let (unfinished, target) = temporary(path)?;
        complete(unfinished, &target, fill)
    };
    attempt().map_err(|source| Error::Write {
        path: path.to_owned(),
        source,
    })
}

/// Calls `fill` as [`atomically`] does, with the temporary path `unfinished`, which no other
/// process uses. A file that a killed process has left there is replaced.
///
/// # Errors
/// As [`atomically`].
pub fn through(
    path: &Path,
    unfinished: &Path,
    fill: impl FnOnce(&Path) -> io::Result<()>,
) -> Result<(), Error> {
    let attempt = || complete(TempPath::try_from_path(unfinished)?, &target(path)?, fill);
    attempt().map_err(|source| Error::Write {
        path: path.to_owned(),
        source,
    })
}

fn complete(
    unfinished: TempPath,
    target: &Path,
    fill: impl FnOnce(&Path) -> io::Result<()>,
) -> io::Result<()> {
    fill(&unfinished)?;
    File::open(&unfinished)?.sync_all()?;
    unfinished.persist(target).map_err(|e| e.error)?;
    sync_folder(target)
}

/// Makes a temporary file beside the [`target`] of `path`. Returns its path, which removes the file
/// when it is dropped, and the target.
fn temporary(path: &Path) -> io::Result<(TempPath, PathBuf)> {
    let target = target(path)?;
    let folder = existing_folder(&target)?;
    let mut builder = tempfile::Builder::new();
    // Temporary files are private; this one becomes what any program would have created.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let unfinished = builder
        .prefix(".unfinished-")
        .tempfile_in(folder)?
        .into_temp_path();
    Ok((unfinished, target))
}

/// Returns the file that `path` leads to: the file behind a link is replaced, not the link.
///
/// # Errors
/// [`Error::Write`] naming `path`, if it exists and is not a file.
pub fn behind_links(path: &Path) -> Result<PathBuf, Error> {
    target(path).map_err(|source| Error::Write {
        path: path.to_owned(),
        source,
    })
}

fn target(path: &Path) -> io::Result<PathBuf> {
    match path.canonicalize() {
        Ok(existing) if existing.is_file() => Ok(existing),
        Ok(_) => Err(io::Error::other("it exists and is not a file")),
        Err(_) => Ok(path.to_owned()),
    }
}

/// Returns the folder of a file. A bare file name is in the current folder.
fn folder(path: &Path) -> &Path {
    path.parent()
        .filter(|folder| !folder.as_os_str().is_empty())
        .unwrap_or(Path::new("."))
}

/// Returns the folder of a file, if it exists.
fn existing_folder(path: &Path) -> io::Result<&Path> {
    let folder = folder(path);
    if folder.is_dir() {
        Ok(folder)
    } else {
        let why = format!("there is no folder {}", folder.display());
        Err(io::Error::new(io::ErrorKind::NotFound, why))
    }
}

/// Flushes the folder of `path`, so that a new or renamed file survives a loss of power.
#[cfg(unix)]
pub fn sync_folder(path: &Path) -> io::Result<()> {
    File::open(folder(path))?.sync_all()
}

#[cfg(not(unix))]
pub fn sync_folder(_: &Path) -> io::Result<()> {
    Ok(())
}
