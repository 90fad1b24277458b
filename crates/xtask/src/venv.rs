//! The virtual environment with the Python packages of tests, benches, builds and the site.

use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::PathBuf;
use std::process::Command;

use crate::python;

/// The packages that build and test the Python package, that read tables as others do, that benches compare with, and
/// that make the site: Sphinx, its reader of Markdown, its theme, and the formulas.
const PACKAGES: [&str; 21] = [
    "afmformats==0.18.7",
    "distributed==2026.8.0",
    "furo==2025.12.19",
    "h5netcdf==1.8.2",
    "h5py==3.16.0",
    "latex2mathml==3.81.1",
    "lmfit==1.3.4",
    "matplotlib==3.11.2",
    "maturin==1.16.0",
    "mypy==2.4.1",
    "myst-parser==5.2.0",
    "netCDF4==1.7.5.1.post1",
    "numpy==2.4.6",
    "pandas==3.1.1",
    "pytest==9.2.0",
    "pytest-xdist==3.8.0",
    "ruff==0.17.6",
    "scipy==1.17.1",
    "sphinx==9.0.4",
    "tqdm==4.70.1",
    "xarray==2026.9.0",
];
/// The packages with whose numbers those of the project are compared, and whose functions it takes.
/// Without them the tests that need them are skipped.
const PEERS: [&str; 4] = [
    "ContactMechanics==1.8.3",
    "emcee==3.1.6",
    "jax==0.10.2",
    "nanite==4.2.3",
];

/// Returns the interpreter of a virtual environment with [`PACKAGES`] and, where they can be fetched, [`PEERS`]. The
/// first call makes it.
pub fn interpreter() -> Result<PathBuf, String> {
    let mut hasher = DefaultHasher::new();
    (PACKAGES, PEERS).hash(&mut hasher);
    let name = format!("venv-{:016x}", hasher.finish());
    let folder = python::fetched(&name, &PACKAGES.join(" "), |folder| {
        // The pip of python3 fills it. One of its own takes longer to install than most packages.
        python::run(
            Command::new("python3")
                .args(["-m", "venv", "--without-pip"])
                .arg(folder),
        )?;
        let interpreter = folder.join("bin/python");
        python::install(&interpreter, PACKAGES.iter().chain(&PEERS)).or_else(|_| {
            let peers = PEERS.join(", ");
            eprintln!("xtask: without {peers}, of which one cannot be fetched, tests are skipped");
            python::install(&interpreter, PACKAGES)
        })
    })?;
    Ok(folder.join("bin/python"))
}
