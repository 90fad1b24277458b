//! The wheel and the source distribution of the Python package.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::{python, succeed, venv, workspace};

/// Builds the wheel and the source distribution into `wheels` in the target directory.
pub fn build() -> Result<(), String> {
    distribute(&[], None)?;
    println!(
        "xtask: wheel and source distribution are in {}",
        folder()?.display()
    );
    Ok(())
}

/// Builds the wheel for every Linux since 2014, linked by the zig of a folder, and the source
/// distribution, and returns their paths.
pub fn release(zig: &Path) -> Result<[PathBuf; 2], String> {
    let options = ["--zig", "--strip", "--compatibility", "manylinux2014"];
    distribute(&options, Some(zig))
}

fn distribute(options: &[&str], zig: Option<&Path>) -> Result<[PathBuf; 2], String> {
    let python = venv::interpreter()?;
    let wheel = wheel(&python, options, zig)?;
    succeed(maturin(&python, "sdist")?.arg("--out").arg(folder()?))?;
    Ok([wheel, made("gz")?])
}

/// Builds the wheel, and installs it into the virtual environment.
pub fn install() -> Result<(), String> {
    let python = venv::interpreter()?;
    let wheel = wheel(&python, &[], None)?;
    let options = ["--no-deps", "--force-reinstall"].map(OsStr::new);
    python::install(&python, options.into_iter().chain([wheel.as_os_str()]))
}

/// Builds the wheel with further options of maturin, and with the folder of zig where it links, and
/// returns its path.
fn wheel(python: &Path, options: &[&str], zig: Option<&Path>) -> Result<PathBuf, String> {
    let folder = folder()?;
    // An older wheel would be taken for the new one.
    workspace::clear(&folder)?;
    succeed(
        maturin(python, "build")?
            .args(["--release", "--locked", "--out"])
            .arg(&folder)
            .args(options)
            .envs(zig.map(|folder| ("PYTHONPATH", folder))),
    )?;
    made("whl")
}

/// Returns the path of the file with an extension that maturin has made.
fn made(extension: &str) -> Result<PathBuf, String> {
    let folder = folder()?;
    let made = workspace::files(&folder, extension)?.pop();
    made.ok_or_else(|| format!("maturin left no {extension} in {}", folder.display()))
}

/// Returns a command of maturin on the package.
fn maturin(python: &Path, command: &str) -> Result<Command, String> {
    let mut maturin = Command::new(python);
    maturin
        .args(["-m", "maturin", command, "--manifest-path"])
        .arg(workspace::root().join("crates/python/Cargo.toml"))
        .env("CARGO_TARGET_DIR", workspace::target()?);
    Ok(maturin)
}

/// Returns the folder of wheel and source distribution.
fn folder() -> Result<PathBuf, String> {
    Ok(workspace::target()?.join("wheels"))
}
