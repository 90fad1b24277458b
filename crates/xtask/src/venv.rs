//! The virtual environment in which the Python package is built and tested.

use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::PathBuf;
use std::process::Command;

use crate::{hdf5, python, succeed};

/// The packages that build and test the Python package.
const PACKAGES: [&str; 13] = [
    "distributed==2026.8.0",
    "lmfit==1.3.4",
    "matplotlib==3.11.2",
    "maturin==1.16.0",
    "mypy==2.4.1",
    "numpy==2.4.6",
    "pandas==3.1.1",
    "pytest==9.2.0",
    "pytest-xdist==3.8.0",
    "ruff==0.17.6",
    "scipy==1.17.1",
    "tqdm==4.70.1",
    "xarray==2026.9.0",
];
/// The packages with whose numbers those of the package are compared, and whose formats and
/// functions it takes (nanite brings afmformats). Without them the tests that need them are skipped.
const PEERS: [&str; 4] = [
    "ContactMechanics==1.8.3",
    "emcee==3.1.6",
    "jax==0.10.2",
    "nanite==4.2.3",
];

/// Returns whether there is a python3 that the package supports, with which an environment can be
/// made.
pub fn can_be_made() -> bool {
    let needs = "import sys, venv, ensurepip; assert sys.version_info >= (3, 11)";
    hdf5::runs(Command::new("python3").args(["-c", needs]))
}

/// Returns the interpreter of a virtual environment with [`PACKAGES`]. The first call makes it.
pub fn interpreter() -> Result<PathBuf, String> {
    let mut hasher = DefaultHasher::new();
    (PACKAGES, PEERS).hash(&mut hasher);
    let name = format!("venv-{:016x}", hasher.finish());
    let folder = python::fetched(&name, &PACKAGES.join(" "), |folder| {
        succeed(Command::new("python3").args(["-m", "venv"]).arg(folder))?;
        let interpreter = folder.join("bin/python");
        succeed(python::install(&interpreter).args(PACKAGES))?;
        for peer in PEERS {
            let fetched = python::install(&interpreter)
                .arg(peer)
                // Lest the peer replaces a version.
                .args(PACKAGES)
                .status();
            if !fetched.is_ok_and(|status| status.success()) {
                eprintln!("xtask: {peer} cannot be fetched: the tests that need it are skipped");
            }
        }
        Ok(())
    })?;
    Ok(folder.join("bin/python"))
}
