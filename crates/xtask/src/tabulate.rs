//! The program of this workspace, built optimised.

use std::env;
use std::process::{Command, Stdio};

use serde_json::Value;

use crate::hdf5;

/// The name of its package.
pub const PACKAGE: &str = "coated-contact-tabulate";

/// Returns the command that runs `tabulate` with these arguments: the program that the environment
/// variable `TABULATE` names, or else the one that cargo builds first.
pub fn command(args: &[&str]) -> Result<Command, String> {
    if let Some(program) = env::var_os("TABULATE") {
        let mut command = Command::new(program);
        command.args(args);
        return Ok(command);
    }
    let run = ["run", "--quiet", "--release", "-p", PACKAGE, "--"];
    hdf5::cargo(&[&run, args].concat())
}

/// Runs `tabulate` and returns the text that it prints.
pub fn text(args: &[&str]) -> Result<String, String> {
    let mut command = command(args)?;
    let output = command
        .stderr(Stdio::inherit())
        .output()
        .map_err(|e| format!("cannot run cargo: {e}"))?;
    if !output.status.success() {
        return Err(format!("{command:?} failed ({})", output.status));
    }
    String::from_utf8(output.stdout).map_err(|e| e.to_string())
}

/// Runs `tabulate` with `--json` and returns the object that it prints.
pub fn json(args: &[&str]) -> Result<Value, String> {
    let text = text(&[args, &["--json"]].concat())?;
    serde_json::from_str(&text).map_err(|e| format!("tabulate {args:?} prints no JSON: {e}"))
}
