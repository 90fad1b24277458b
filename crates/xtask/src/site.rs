//! The site of the documentation, made by Sphinx.

use std::process::Command;

use crate::{hdf5, python, python_tests, succeed, venv, workspace};

/// Makes the site in `site` of the target directory, with the documentation of the crates. A dead
/// link between its pages, an image that is missing, a docstring that cannot be read, a warning of
/// rustdoc, and a notebook that fails are errors.
pub fn site() -> Result<(), String> {
    let mut crates = hdf5::cargo(&["doc", "--release", "--workspace", "--no-deps"])?;
    succeed(crates.env("RUSTDOCFLAGS", "-D warnings"))?;
    let out = workspace::target()?.join("site");
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
            .env("PYTHONPATH", python_tests::package()?)
            .env("RUST_DOCUMENTATION", workspace::target()?.join("doc"))
            .envs(python::compiled()?),
    )?;
    println!("xtask: the site is in {}", out.display());
    Ok(())
}
