//! The program of this workspace.

use std::process::Stdio;

use crate::hdf5;

/// Runs `tabulate`, built optimised, and returns what it prints.
pub fn tabulate(args: &[&str]) -> Result<String, String> {
    let mut command = hdf5::cargo(
        &[
            &["run", "--quiet", "--release", "-p", "tabulate", "--"],
            args,
        ]
        .concat(),
    )?;
    let output = command
        .stderr(Stdio::inherit())
        .output()
        .map_err(|e| format!("cannot run cargo: {e}"))?;
    if !output.status.success() {
        return Err(format!("{command:?} failed ({})", output.status));
    }
    String::from_utf8(output.stdout).map_err(|e| e.to_string())
}
