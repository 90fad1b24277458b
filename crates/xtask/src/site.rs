//! The site of the documentation, made by Sphinx from PyPI.

use std::env;
use std::path::PathBuf;
use std::process::Command;

use crate::{hdf5, python, python_tests, succeed, venv, workspace};

/// Sphinx, its reader of Markdown, its theme, and the formulas.
const PACKAGES: [&str; 4] = [
    "sphinx==9.0.4",
    "myst-parser==5.2.0",
    "furo==2025.12.19",
    "latex2mathml==3.81.1",
];

/// Makes the site in `site` of the target directory, with the documentation of the crates. A dead
/// link between its pages, an image that is missing, a docstring that cannot be read, a warning of
/// rustdoc, and a notebook that fails are errors.
pub fn site() -> Result<(), String> {
    let mut crates = hdf5::cargo(&["doc", "--release", "--workspace", "--no-deps"])?;
    succeed(crates.env("RUSTDOCFLAGS", "-D warnings"))?;
    let out = workspace::target()?.join("site");
    let modules = [packages()?, python_tests::package()?];
    let modules = env::join_paths(modules).map_err(|e| format!("a folder with a colon: {e}"))?;
    let root = workspace::root();
    succeed(
        Command::new(venv::interpreter()?)
            .args([
                "-m",
                "sphinx",
                "-q",
                "-W",
                "--keep-going",
                "-b",
                "html",
                "-c",
            ])
            .arg(root.join("crates/site"))
            .arg(&root)
            .arg(&out)
            .env("PYTHONPATH", modules)
            .env("RUST_DOCUMENTATION", workspace::target()?.join("doc"))
            .envs(python::compiled()?),
    )?;
    println!("xtask: the site is in {}", out.display());
    Ok(())
}

/// Returns the folder of Sphinx. The first call fetches it.
pub fn packages() -> Result<PathBuf, String> {
    python::packages(&PACKAGES)
}
