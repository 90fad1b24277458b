//! Compilation for every Linux: zig, from PyPI, compiles C and links, with the C library of 2014 or
//! with none of the system.

use std::path::{Path, PathBuf};
use std::process::Command;

use super::OLD_LINUX;
use crate::{hdf5, python, succeed, workspace};

/// zig, and the command by which cargo compiles with it.
const PACKAGES: [&str; 2] = ["cargo-zigbuild==0.24.1", "ziglang==0.15.2"];
/// The C library of 2014, as in the tag `manylinux2014`.
const GLIBC: &str = "2.17";

/// Fetches zig from PyPI, if it is not there, and returns the folder that holds it, for `PYTHONPATH`.
pub fn fetch() -> Result<PathBuf, String> {
    python::packages(&PACKAGES)
}

/// Builds a package for a target by zig in its folder, and returns the folder of what is built.
pub fn build(zig: &Path, target: &str, package: &str, options: &[&str]) -> Result<PathBuf, String> {
    let mut platform = target.to_owned();
    if target == OLD_LINUX {
        platform = format!("{target}.{GLIBC}");
    } else {
        succeed(Command::new("rustup").args(["target", "add", target]))?;
    }
    succeed(
        Command::new(zig.join("bin/cargo-zigbuild"))
            .args(["zigbuild", "--release", "--locked", "--target", &platform])
            .args(["--package", package])
            .args(options)
            .current_dir(workspace::root())
            .env("CARGO_TARGET_DIR", workspace::target()?)
            .env("CMAKE", hdf5::cmake()?)
            .env("PYTHONPATH", zig),
    )?;
    Ok(workspace::target()?.join(target).join("release"))
}
