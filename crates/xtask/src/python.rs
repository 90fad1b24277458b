//! Python packages for the project's own use. They lie in the target directory; the user's own
//! environment is not changed.

use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::{succeed, workspace};

/// Returns the folder (for `PYTHONPATH`) of the package `name` at a version in `range`. The first
/// call fetches it with pip.
pub fn package(name: &str, range: &str) -> Result<PathBuf, String> {
    packages(&[&format!("{name}{range}")])
}

/// Returns the folder (for `PYTHONPATH`) of packages, each with its versions as pip takes them. The
/// first call fetches them with pip.
pub fn packages(requirements: &[&str]) -> Result<PathBuf, String> {
    let all = requirements.join(" ");
    fetched(&plain(&all), &all, |folder| {
        run(pip()
            .args(INSTALL)
            .arg("--target")
            .arg(folder)
            .args(requirements))
    })
}

/// Returns the folder of the source distribution of the package `name` at a `version`, unpacked.
/// The first call fetches it with pip.
pub fn source(name: &str, version: &str) -> Result<PathBuf, String> {
    let release = format!("{name}-{version}");
    let what = format!("source of {release}");
    let folder = fetched(&plain(&what), &what, |folder| {
        let requirement = format!("{name}=={version}");
        run(pip()
            .args(["download", "--no-deps", "--no-binary", name, &requirement])
            .arg("--dest")
            .arg(folder))?;
        let archive = folder.join(format!("{release}.tar.gz"));
        let mut unpack = Command::new("python3");
        unpack
            .args(["-m", "tarfile", "-e"])
            .arg(archive)
            .arg(folder);
        run(&mut unpack)
    })?;
    Ok(folder.join(release))
}

/// Returns the name of the folder of `what`: each set of packages and versions has its own.
fn plain(what: &str) -> String {
    what.replace(|c: char| !c.is_ascii_alphanumeric(), "-")
}

/// Returns the folder `name` of `what`, in the tools of the target directory. The first call lets
/// `fill` fill it.
pub fn fetched(
    name: &str,
    what: &str,
    fill: impl FnOnce(&Path) -> Result<(), String>,
) -> Result<PathBuf, String> {
    let folder = workspace::target()?.join("tools").join(name);
    if folder.exists() {
        return Ok(folder);
    }
    eprintln!("xtask: fetching {what} from PyPI into {}", folder.display());
    // The folder is renamed when it is complete: an interrupted download is not used later.
    let unfinished = folder.with_extension(format!("partial-{}", std::process::id()));
    if let Err(message) = fill(&unfinished) {
        // Half a package is useless. If it cannot be removed, the error below still tells the user
        // how to proceed.
        let _ = fs::remove_dir_all(&unfinished);
        return Err(message);
    }
    // Another program may have renamed its own meanwhile.
    match fs::rename(&unfinished, &folder) {
        Err(e) if !folder.exists() => Err(format!("cannot rename {}: {e}", unfinished.display())),
        _ => Ok(folder),
    }
}

/// Returns the environment in which Python stores compiled modules, in the target directory. The folders of
/// sources get no files, and all programs share the compiled modules.
pub fn compiled() -> Result<[(&'static str, PathBuf); 2], String> {
    let folder = workspace::target()?.join("tools").join("compiled");
    // Images of machines tell Python to store nothing, and each program would compile its modules again.
    let stored = PathBuf::new();
    Ok([
        ("PYTHONPYCACHEPREFIX", folder),
        ("PYTHONDONTWRITEBYTECODE", stored),
    ])
}

/// Python compiles what it imports. That is little of what pip would compile.
const INSTALL: [&str; 2] = ["install", "--no-compile"];

/// Installs packages, or does what else `arguments` ask for, in the environment of an interpreter.
pub fn install(
    interpreter: &Path,
    arguments: impl IntoIterator<Item: AsRef<OsStr>>,
) -> Result<(), String> {
    run(pip()
        .arg("--python")
        .arg(interpreter)
        .args(INSTALL)
        .args(arguments))
}

fn pip() -> Command {
    let mut pip = Command::new("python3");
    pip.args(["-m", "pip", "--quiet", "--disable-pip-version-check"])
        .env("PIP_ROOT_USER_ACTION", "ignore")
        // A user's settings of these refuse to install into a folder.
        .env("PIP_USER", "0")
        .env("PIP_REQUIRE_VIRTUALENV", "0");
    pip
}

/// Runs a command of Python. An error says what it needs.
pub fn run(python: &mut Command) -> Result<(), String> {
    succeed(python).map_err(|error| {
        format!(
            "{error}; it needs python3 >= 3.11 with pip (Debian: python3-pip) and PyPI within reach"
        )
    })
}
