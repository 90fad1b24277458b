//! The project's own commands, run as `cargo xtask COMMAND`.
//!
//! They need Rust, a C compiler and python3, and fetch the rest (cmake for libhdf5, h5py for one test) from PyPI into the
//! target directory.

#![forbid(unsafe_code)]

mod hdf5;
mod python;
mod workspace;

use std::env;
use std::process::{Command, ExitCode};

const USAGE: &str = "\
usage: cargo xtask COMMAND

  table [ARGS]   make a table: `tabulate generate ARGS`; without ARGS the default scene into tables/default.h5
  test [ARGS]    run the whole test suite, optimised; ARGS go to `cargo test`
  cargo ARGS     run any cargo command with HDF5 set up, for example `cargo xtask cargo bench -p tabulate`
";

fn main() -> ExitCode {
    let mut args = env::args().skip(1);
    let command = args.next();
    let rest: Vec<String> = args.collect();
    let outcome = match command.as_deref() {
        Some("table") => table(&rest),
        Some("test") => test(&rest),
        Some("cargo") if !rest.is_empty() => cargo(&rest),
        Some("help" | "--help" | "-h") => {
            print!("{USAGE}");
            return ExitCode::SUCCESS;
        }
        _ => {
            eprint!("{USAGE}");
            return ExitCode::from(2);
        }
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("xtask: {message}");
            ExitCode::FAILURE
        }
    }
}

/// `tabulate generate`, built optimised.
fn table(args: &[String]) -> Result<(), String> {
    let mut command = vec!["run", "--release", "-p", "tabulate", "--", "generate"];
    // Without arguments the workspace's own default scene, wherever the command is run; the table is written beside it.
    let default = [workspace::root().join("tables/default.toml").display().to_string()];
    let args = if args.is_empty() { &default } else { args };
    command.extend(args.iter().map(String::as_str));
    succeed(&mut hdf5::cargo(&command)?)
}

/// Every test of every member with every feature, documentation examples included.
fn test(args: &[String]) -> Result<(), String> {
    let mut command = vec!["test", "--release", "--workspace", "--features", "interp/hdf5"];
    command.extend(args.iter().map(String::as_str));
    succeed(hdf5::cargo(&command)?.env("H5PY_PATH", python::package("h5py", H5PY)?))
}

/// The oldest and newest h5py that one test of the HDF5 file is known to pass with.
const H5PY: &str = ">=3.8,<4";

fn cargo(args: &[String]) -> Result<(), String> {
    let args: Vec<&str> = args.iter().map(String::as_str).collect();
    succeed(&mut hdf5::cargo(&args)?)
}

/// Runs a command that prints for itself; an error names the command.
fn succeed(command: &mut Command) -> Result<(), String> {
    let status = command.status().map_err(|e| format!("cannot run {:?}: {e}", command.get_program()))?;
    if status.success() { Ok(()) } else { Err(format!("{command:?} failed ({status})")) }
}
