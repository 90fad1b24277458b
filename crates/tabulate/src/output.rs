//! Files that are either complete or not there.
//!
//! A file is written beside its target as `.NAME.unfinished-XXXXXX`, a name that no file has, and
//! renamed when it is complete. A second file `.NAME.unfinished-XXXXXX.lock` is locked meanwhile.
//! The system unlocks it when the process ends, in any way. [`tidy`] removes the pairs that are not
//! locked: killed processes have left them.

use std::fs::{self, File, OpenOptions, TryLockError};
use std::io;
use std::path::{Path, PathBuf, is_separator};

use same_file::Handle;
use tempfile::{NamedTempFile, TempPath};

use crate::{Error, printable};

/// Accepts an output, before any work, if a file can be made or replaced there and if it is none of
/// the `inputs`, under any name.
#[cfg(feature = "cli")]
pub fn check(path: &Path, inputs: &[&Path]) -> Result<(), Error> {
    let attempt = || {
        let target = target(path)?;
        // Comparing opens both, and opening a pipe may block.
        let is_target = |input: &&Path| {
            input.is_file() && same_file::is_same_file(input, &target).unwrap_or(false)
        };
        if inputs.iter().any(is_target) {
            return Err(io::Error::other(
                "it is the input, which no command overwrites; choose another name",
            ));
        }
        // Without a name, so that nothing is left behind if the process is killed here.
        tempfile::tempfile_in(existing_folder(&target)?).map(drop)
    };
    attempt().map_err(write_error(path))
}

/// Removes the unfinished files of an output that killed processes have left, and returns their
/// paths. Those of living processes stay. A file that cannot be removed stays too.
pub fn tidy(path: &Path) -> Vec<PathBuf> {
    let Ok(target) = target(path) else {
        return Vec::new();
    };
    let prefix = prefix(&target);
    let locks = fs::read_dir(folder(&target))
        .into_iter()
        .flatten()
        .flatten();
    let dead = locks.filter(|entry| {
        let name = entry.file_name();
        let name = name.to_string_lossy();
        name.starts_with(&prefix) && name.ends_with(LOCK)
    });
    dead.filter_map(|lock| remove_dead(&lock.path())).collect()
}

/// Returns what the user is told of a path that [`tidy`] returns.
pub fn removed(path: &Path) -> String {
    format!(
        "{} is removed, which a killed process has left",
        printable::path(path)
    )
}

/// Removes a lock and its unfinished file, and returns the path of the latter, unless the lock is
/// held or cannot be taken.
fn remove_dead(lock: &Path) -> Option<PathBuf> {
    // Anything but a file is not ours, and opening a pipe may block.
    if !fs::symlink_metadata(lock).is_ok_and(|data| data.is_file()) {
        return None;
    }
    let file = OpenOptions::new().write(true).open(lock).ok()?;
    file.try_lock().ok()?;
    if !is_at(&file, lock) {
        return None;
    }
    let data = lock.with_extension("");
    let removed = fs::remove_file(&data);
    fs::remove_file(lock).ok()?;
    removed.ok().map(|()| data)
}

/// A file that is not complete yet. Dropping it removes it.
pub struct Unfinished {
    /// The output as the user names it.
    path: PathBuf,
    target: PathBuf,
    data: TempPath,
    // After `data`, so that it is removed last.
    _lock: NamedTempFile,
}

impl Unfinished {
    /// Makes an empty file under a name of its own beside an output. No link is followed, and no
    /// file is replaced.
    pub fn new(path: &Path) -> Result<Self, Error> {
        let attempt = || {
            let target = target(path)?;
            let folder = existing_folder(&target)?;
            loop {
                let lock = tempfile::Builder::new()
                    .prefix(&prefix(&target))
                    .suffix(LOCK)
                    .tempfile_in(folder)?;
                // Another process may tidy up before the lock is held. Where a disk has no locks,
                // nothing is ever tidied up.
                let is_lost = matches!(lock.as_file().try_lock(), Err(TryLockError::WouldBlock));
                if is_lost || !is_at(lock.as_file(), lock.path()) {
                    continue;
                }
                let data = lock.path().with_extension("");
                File::create_new(&data)?;
                return Ok(Self {
                    path: path.to_owned(),
                    target,
                    data: TempPath::try_from_path(data)?,
                    _lock: lock,
                });
            }
        };
        attempt().map_err(write_error(path))
    }

    /// Returns the path at which the content is to be written.
    pub fn path(&self) -> &Path {
        &self.data
    }

    /// Flushes the file to disk and renames it to its target. It gets the permissions of a file that it replaces:
    /// what was private stays so.
    ///
    /// # Errors
    /// [`Error::Write`] naming the output; an existing file is then untouched.
    pub fn complete(self) -> Result<(), Error> {
        let Self {
            path,
            target,
            data,
            _lock,
        } = self;
        let attempt = || {
            if let Ok(replaced) = fs::metadata(&target) {
                fs::set_permissions(&data, replaced.permissions())?;
            }
            File::open(&data)?.sync_all()?;
            data.persist(&target).map_err(|e| e.error)?;
            sync_folder(&target)
        };
        attempt().map_err(write_error(&path))
    }
}

/// Calls `fill` with the path of an [`Unfinished`] file, then completes it.
///
/// # Errors
/// [`Error::Write`] naming `path`; an existing file is then untouched. Anything but a file at
/// `path`, a device for instance, is an error.
pub fn atomically(path: &Path, fill: impl FnOnce(&Path) -> io::Result<()>) -> Result<(), Error> {
    let unfinished = Unfinished::new(path)?;
    fill(unfinished.path()).map_err(write_error(path))?;
    unfinished.complete()
}

/// Returns the file that `path` leads to: the file behind a link is replaced, not the link.
///
/// # Errors
/// [`Error::Write`] naming `path`, if it exists and is not a file, is read-only, is a link to nothing, or names a stream.
pub fn behind_links(path: &Path) -> Result<PathBuf, Error> {
    target(path).map_err(write_error(path))
}

/// Names of the streams of a program, and folders of such names.
const DESCRIPTORS: [&str; 4] = ["/dev/stdout", "/dev/stderr", "/dev/fd", "/proc"];

fn target(path: &Path) -> io::Result<PathBuf> {
    if path
        .to_str()
        .is_some_and(|name| matches!(name.trim(), "" | "-"))
    {
        return Err(io::Error::other("that is no name; give the name of a file"));
    }
    // A file of this name would replace the one to which standard output goes.
    if DESCRIPTORS.iter().any(|folder| path.starts_with(folder)) {
        return Err(io::Error::other(
            "it is no file but a stream of the program; give the name of a file",
        ));
    }
    match path.canonicalize() {
        Ok(existing) if !existing.is_file() => Err(io::Error::other("it exists and is not a file")),
        Ok(existing) if fs::metadata(&existing)?.permissions().readonly() => Err(io::Error::other(
            "it is read-only; make it writable, or give another name",
        )),
        Ok(existing) => Ok(existing),
        Err(error) => match fs::read_link(path) {
            Ok(destination) => Err(io::Error::other(format!(
                "it is a link to {}, which is not there; make that file, or remove the link",
                printable::path(&destination)
            ))),
            Err(_) if error.kind() != io::ErrorKind::NotFound => Err(error),
            Err(_) if path.to_string_lossy().ends_with(is_separator) => Err(io::Error::other(
                "it is the name of a folder, not of a file",
            )),
            Err(_) => Ok(path.to_owned()),
        },
    }
}

const LOCK: &str = ".lock";
/// The largest number of bytes of a target's name that the names of unfinished files begin with.
/// Names may have 255 bytes.
const NAME: usize = 200;

/// Returns the beginning of the names of a target's unfinished files.
fn prefix(target: &Path) -> String {
    let name = target.file_name().unwrap_or_default().to_string_lossy();
    format!(".{}.unfinished-", &name[..name.floor_char_boundary(NAME)])
}

fn write_error(path: &Path) -> impl Fn(io::Error) -> Error {
    let path = path.to_owned();
    move |source| Error::Write {
        path: path.clone(),
        source,
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
        let why = format!("there is no folder {}", printable::path(folder));
        Err(io::Error::new(io::ErrorKind::NotFound, why))
    }
}

/// Returns true if an open file is still the one at the path, and no link leads there.
pub fn is_at(file: &File, path: &Path) -> bool {
    let handle = file.try_clone().and_then(Handle::from_file);
    !path.is_symlink()
        && handle.is_ok_and(|handle| Handle::from_path(path).is_ok_and(|other| other == handle))
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
