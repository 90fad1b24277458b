//! The program of this workspace, built optimised.

use std::env;
use std::path::PathBuf;
use std::process::Command;

use serde_json::Value;

use crate::{hdf5, printed, succeed, workspace};

/// The build of the program. It selects the whole workspace, and one of the targets that need what
/// only tests need: so all dependencies have the features that they have in the tests, for which
/// nothing is then compiled again.
const BUILD: [&str; 8] = [
    "build",
    "--quiet",
    "--release",
    "--workspace",
    "--bin",
    "tabulate",
    "--example",
    "force",
];

/// Returns the command that runs `tabulate` with these arguments: the program that the environment
/// variable `TABULATE` names, or else the one that cargo builds first.
pub fn command(args: &[&str]) -> Result<Command, String> {
    let program = match env::var_os("TABULATE") {
        Some(program) => program.into(),
        None => built()?,
    };
    let mut command = Command::new(program);
    command.args(args);
    Ok(command)
}

/// Builds the program, and returns its path.
fn built() -> Result<PathBuf, String> {
    let name = format!("release/tabulate{}", env::consts::EXE_SUFFIX);
    let program = workspace::target()?.join(name);
    if !program.exists() {
        eprintln!("xtask: building the program tabulate, which takes minutes at the first time");
    }
    succeed(&mut hdf5::cargo(&BUILD)?)?;
    Ok(program)
}

/// Runs `tabulate` and returns the text that it prints.
pub fn text(args: &[&str]) -> Result<String, String> {
    printed(&mut command(args)?)
}

/// Runs `tabulate` with `--json` and returns the object that it prints.
pub fn json(args: &[&str]) -> Result<Value, String> {
    let text = text(&[args, &["--json"]].concat())?;
    serde_json::from_str(&text).map_err(|e| format!("tabulate {args:?} prints no JSON: {e}"))
}
