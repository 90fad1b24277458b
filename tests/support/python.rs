//! Scripts of Python beside the tests.

use std::env;
use std::process::Command;

use crate::start;

/// Returns a command of the interpreter that the environment variable `PYTHON` names, or else of python3.
pub fn python() -> Command {
    Command::new(env::var_os("PYTHON").unwrap_or_else(|| "python3".into()))
}

/// Returns what a script prints.
pub fn output(python: &mut Command) -> Vec<u8> {
    let output = start(python).wait_with_output().expect("python3 runs");
    let errors = String::from_utf8_lossy(&output.stderr);
    let hint = "`cargo xtask test` fetches the packages of Python";
    assert!(output.status.success(), "{errors}\n{hint}");
    output.stdout
}
