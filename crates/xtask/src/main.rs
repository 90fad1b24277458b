//! The project's own commands, run as `cargo xtask COMMAND`.
//!
//! They need Rust, a C compiler and python3, and fetch the rest (cmake for libhdf5, h5py for one
//! test, scipy for two benches) from PyPI into the target directory. The tests of the report run in
//! Chromium, which is installed with apt-get where that is possible.

#![forbid(unsafe_code)]

mod browser;
mod figures;
mod hdf5;
mod python;
mod tables;
mod tabulate;
mod workspace;

use std::env;
use std::process::{Command, ExitCode};

const USAGE: &str = "\
usage: cargo xtask COMMAND

  table [SCENE] [ARGS]
                 make a table: `tabulate generate SCENE ARGS`; without SCENE the default one, into tables/default.h5
  tables         make and pack the table of every scene in tables/, in target/tables/, and print the rows of tables/README.md
  figures [--check]
                 measure what accuracy costs, draw all figures and quote the numbers in README.md and tables/README.md; or measure
                 and draw again, and fail where that differs
  test [ARGS]    run the whole test suite, optimised; ARGS go to `cargo test`
  compare        time the solve against numpy and scipy on the same equation, and the lookup against interpn and scipy on
                 the same nodes
  cargo ARGS     run a cargo command that builds tabulate, with HDF5 set up: `cargo xtask cargo bench -p tabulate`
";

fn main() -> ExitCode {
    let mut args = env::args().skip(1);
    let command = args.next();
    let rest: Vec<String> = args.collect();
    let outcome = match command.as_deref() {
        Some("table") => table(&rest),
        Some("tables") if rest.is_empty() => tables::tables(),
        Some("figures") if rest.is_empty() => figures::figures(),
        Some("figures") if rest == ["--check"] => figures::check(),
        Some("test") => test(&rest),
        Some("compare") if rest.is_empty() => compare(),
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
    // Without a scene it is the workspace's default one, wherever the command is run; the table is
    // written beside it.
    let scene = workspace::root()
        .join("tables/default.toml")
        .display()
        .to_string();
    if args.first().is_none_or(|first| first.starts_with('-')) {
        command.push(&scene);
    }
    command.extend(args.iter().map(String::as_str));
    succeed(&mut hdf5::cargo(&command)?)
}

/// Every test of every member with every feature, documentation examples included.
fn test(args: &[String]) -> Result<(), String> {
    let mut command = vec!["test", "--release", "--workspace"];
    command.extend(args.iter().map(String::as_str));
    let mut cargo = hdf5::cargo(&command)?;
    cargo
        .env("H5PY_PATH", python::package("h5py", H5PY)?)
        .envs(browser::chromium().map(|path| ("CHROMIUM", path)));
    succeed(&mut cargo)
}

/// The h5py versions that one test of the HDF5 file is known to pass with.
const H5PY: &str = ">=3.8,<4";

/// The benches that need scipy; pip fetches numpy with it.
fn compare() -> Result<(), String> {
    let bench = [
        "bench", "-p", "tabulate", "--bench", "nystrom", "--bench", "rivals",
    ];
    succeed(hdf5::cargo(&bench)?.env("PYTHONPATH", python::package("scipy", SCIPY)?))
}

/// The scipy versions that the benches are known to run with.
const SCIPY: &str = ">=1.11,<2";

fn cargo(args: &[String]) -> Result<(), String> {
    let args: Vec<&str> = args.iter().map(String::as_str).collect();
    succeed(&mut hdf5::cargo(&args)?)
}

/// Runs a command that prints for itself; an error names the command.
fn succeed(command: &mut Command) -> Result<(), String> {
    let status = command
        .status()
        .map_err(|e| format!("cannot run {:?}: {e}", command.get_program()))?;
    if status.success() {
        Ok(())
    } else {
        Err(format!("{command:?} failed ({status})"))
    }
}
