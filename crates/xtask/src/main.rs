//! The project's own commands, run as `cargo xtask COMMAND`.
//!
//! They need Rust, a C compiler and python3 >= 3.11 with pip. All else is fetched from PyPI into the target
//! directory: cmake to build libhdf5 where no library is installed, and the packages of tests, benches and builds.
//! Nothing is installed on the system. The tests of the report's page run in Chromium, and are
//! skipped, with a message, where there is none.

#![forbid(unsafe_code)]

mod browser;
mod dist;
mod figures;
mod hdf5;
mod licences;
mod python;
mod python_tests;
mod site;
mod tables;
mod tabulate;
mod venv;
mod wheel;
mod workspace;

use std::fs::{self, File};
use std::io::{self, Write, stderr, stdout};
use std::process::{Command, ExitCode, Stdio};
use std::{env, thread};

use python_tests::Environment;

const USAGE: &str = "\
usage: cargo xtask COMMAND

  tabulate ARGS  run the program `tabulate`, built optimised: `cargo xtask tabulate curve`
  table [SCENE] [ARGS]
                 make a table: `tabulate generate SCENE ARGS`; without SCENE, the default scene into tables/default.h5
  tables         make and pack the table of every scene in tables/ and tables/stacks/, in target/tables/, and print the rows of tables/README.md
  figures        measure the cost of accuracy, draw all figures, and quote the numbers in crates/tabulate/COST.md and
                 tables/README.md
  figures --check
                 measure and draw again, and fail where the figures or the quoted numbers differ
  test [ARGS]    run the whole test suite, optimised; ARGS go to `cargo test`, and then the tests of the Python package
                 are left out
  wheel          build the Python package: wheel and source distribution in target/wheels/
  wheel --test   build the wheel, and run the tests of the Python package with it; `test` runs them with the compiled
                 module of the workspace
  site           make the site of the documentation in target/site/
  dist           make all artefacts of a release in target/dist/, and try each in an empty environment; takes long
  dist --check   check the metadata of a release
  compare        time the solve against numpy and scipy on the same equation, and the lookup against interpn and scipy on
                 the same nodes; compiles all crates with other options first, which takes minutes
  compare --small
                 run the same comparisons on small cases, whose numbers mean nothing
  licences       check the licences of all crates of the lock file, and print those that have more conditions than MIT
  tools          fetch from PyPI now what tests, comparisons and the site would fetch when they run
  cargo ARGS     run a cargo command, with HDF5 set up where it selects the whole workspace or tabulate:
                 `cargo xtask cargo bench -p coated-contact-tabulate`
";

fn main() -> ExitCode {
    let mut args = env::args().skip(1);
    let command = args.next();
    let rest: Vec<String> = args.collect();
    let outcome = match command.as_deref() {
        Some("tabulate") => tabulate(&rest),
        Some("table") => table(&rest),
        Some("tables") if rest.is_empty() => tables::tables(),
        Some("figures") if rest.is_empty() => figures::figures(),
        Some("figures") if rest == ["--check"] => figures::check(),
        Some("test") => test(&rest),
        Some("wheel") if rest.is_empty() => wheel::build(),
        Some("wheel") if rest == ["--test"] => python_tests::of_wheel(),
        Some("dist") if rest.is_empty() => dist::dist(),
        Some("dist") if rest == ["--check"] => dist::check(),
        Some("site") if rest.is_empty() => site::site(),
        Some("compare") if rest.is_empty() => compare(&[]),
        Some("compare") if rest == ["--small"] => compare(&["--", "--small"]),
        Some("tools") if rest.is_empty() => tools(),
        Some("licences") if rest.is_empty() => licences::licences(),
        Some("cargo") if !rest.is_empty() => cargo(&rest),
        Some("help" | "--help" | "-h") => {
            let _ = write!(stdout(), "{USAGE}");
            return ExitCode::SUCCESS;
        }
        _ => {
            let _ = write!(stderr(), "{USAGE}");
            return ExitCode::from(2);
        }
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            let _ = writeln!(stderr(), "xtask: {message}");
            ExitCode::FAILURE
        }
    }
}

fn tabulate(args: &[String]) -> Result<(), String> {
    let args: Vec<&str> = args.iter().map(String::as_str).collect();
    succeed(&mut tabulate::command(&args)?)
}

/// Runs `tabulate generate`.
fn table(args: &[String]) -> Result<(), String> {
    let mut command = vec!["generate"];
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
    succeed(&mut tabulate::command(&command)?)
}

/// Runs every test of every member, documentation examples included.
fn test(args: &[String]) -> Result<(), String> {
    if args.is_empty() {
        return whole_suite();
    }
    succeed(&mut tests_in_rust(args, &python_tests::environment()?)?)
}

/// Compiles all tests while it fetches what they need, and runs those of the Python package beside those in Rust: each leave
/// cores idle at times. What Python prints comes last.
fn whole_suite() -> Result<(), String> {
    let fetching = thread::spawn(python_tests::environment);
    let compiled = python_tests::compile();
    // What is fetched is left whole, whatever the compiler says.
    let environment = fetching.join().expect("fetching does not panic");
    compiled?;
    let environment = environment?;
    let path = workspace::target()?.join("python-tests.log");
    let failed = |e: io::Error| format!("{}: {e}", path.display());
    let log = File::create(&path).map_err(failed)?;
    let mut rust = tests_in_rust(&[], &environment)?;
    let python = thread::spawn(move || python_tests::in_place(&environment, &log));
    let rust = succeed(&mut rust);
    let python = python.join().expect("the tests of Python do not panic");
    let _ = write!(stdout(), "{}", fs::read_to_string(&path).map_err(failed)?);
    match (rust, python) {
        (Err(rust), Err(python)) => Err(format!("{rust}\n{python}")),
        (rust, python) => rust.and(python),
    }
}

fn tests_in_rust(args: &[String], environment: &Environment) -> Result<Command, String> {
    let mut command = vec!["test", "--release", "--workspace"];
    command.extend(args.iter().map(String::as_str));
    let mut cargo = hdf5::cargo(&command)?;
    cargo
        .envs(environment.iter().cloned())
        // The threads of BLAS keep cores busy while they wait, and the tests give them little to do.
        .env("OPENBLAS_NUM_THREADS", "1")
        .envs(browser::chromium().map(|path| ("CHROMIUM", path)));
    Ok(cargo)
}

/// Fetches all packages of Python that tests, comparisons and the site need, and the tools that build
/// libhdf5.
fn tools() -> Result<(), String> {
    // To make this command is to fetch cmake and ninja where they are needed.
    hdf5::cargo(&["build", "--workspace"])?;
    python_tests::environment().map(drop)
}

/// Runs the benches that need scipy. The selection is that of the tests, so
/// that nothing is compiled twice for the small cases. Where the times count, benches are optimised, and interpn has
/// its fast code, without which it takes several times as long.
fn compare(args: &[&str]) -> Result<(), String> {
    const FAIR: [&str; 2] = ["--features", "coated-contact-tabulate/fast-interpn"];
    const AS_TESTS: [&str; 2] = ["--profile", "release"];
    let options = if args.is_empty() { FAIR } else { AS_TESTS };
    let bench = [
        "bench",
        "--workspace",
        "--bench",
        "nystrom",
        "--bench",
        "rivals",
    ];
    let bench = [&bench, &options[..], args].concat();
    succeed(hdf5::cargo(&bench)?.env("PYTHON", venv::interpreter()?))
}

fn cargo(args: &[String]) -> Result<(), String> {
    let args: Vec<&str> = args.iter().map(String::as_str).collect();
    succeed(&mut hdf5::cargo(&args)?)
}

/// Runs a command and returns what it prints. An error names the command, and has what it printed.
fn printed(command: &mut Command) -> Result<String, String> {
    let output = command
        .stderr(Stdio::inherit())
        .output()
        .map_err(|e| format!("cannot run {:?}: {e}", command.get_program()))?;
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    if output.status.success() {
        return Ok(text);
    }
    Err(format!("{command:?} failed ({}): {text}", output.status))
}

/// Runs a command whose output is its own. An error names the command.
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
