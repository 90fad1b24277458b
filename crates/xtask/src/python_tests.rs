//! The tests and checks of the Python package.

use std::ffi::OsString;
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, io};

use crate::{hdf5, python, succeed, venv, wheel, workspace};

/// The packages whose sources hold measured curves, with their versions and the environment variables
/// that tell the tests where they are.
const MEASURED: [[&str; 3]; 2] = [
    ["afmformats", "0.18.7", "AFMFORMATS_SOURCE"],
    ["nanite", "4.2.3", "NANITE_SOURCE"],
];

/// Variables of the environment, which name folders and programs.
pub type Environment = Vec<(&'static str, PathBuf)>;

/// Returns the environment that tells the tests in Rust and in Python which interpreter has the packages that they need,
/// where it stores compiled modules, and where measured curves are. Leaves out, with a message, curves that cannot be
/// fetched.
pub fn environment() -> Result<Environment, String> {
    let mut environment = vec![("PYTHON", venv::interpreter()?)];
    environment.extend(python::compiled()?);
    for [name, version, variable] in MEASURED {
        match python::source(name, version) {
            Ok(folder) => environment.push((variable, folder)),
            Err(message) => {
                eprintln!("xtask: {message}\nxtask: the tests with curves of {name} are skipped")
            }
        }
    }
    Ok(environment)
}

/// Tests the package as it stands in the workspace, with the compiled module that the tests in Rust
/// were built with: that of a wheel has all its dependencies compiled again, with fewer features.
/// What the tests print is written to `log`.
pub fn in_place(environment: &Environment, log: &File) -> Result<(), String> {
    if !cfg!(target_os = "linux") {
        // Modules are linked in another way there, which maturin knows.
        return of_wheel();
    }
    run(environment, Some(&package()?), Some(log))
}

/// Builds the wheel, and tests the package that it installs.
pub fn of_wheel() -> Result<(), String> {
    wheel::install()?;
    run(&environment()?, None, None)
}

/// Puts the package together as it stands in the workspace, with the module that is compiled for the
/// tests, and returns the folder that holds it, for `PYTHONPATH`.
pub fn package() -> Result<PathBuf, String> {
    compile()?;
    let folder = workspace::target()?.join("python");
    let package = folder.join("coated_contact");
    workspace::clear(&package)?;
    copy(&sources().join("python/coated_contact"), &package)?;
    let module = workspace::target()?.join("release/lib_core.so");
    copy(&module, &package.join("_core.abi3.so"))?;
    Ok(folder)
}

/// Compiles the module and all tests, whose dependencies have more features than those of the module alone.
pub fn compile() -> Result<(), String> {
    let build = ["build", "--release", "--workspace", "--lib", "--tests"];
    succeed(&mut hdf5::cargo(&build)?)
}

/// Runs tests and checks on the package that is installed or that of a folder. What they print is
/// written to `log`, if there is one.
fn run(environment: &Environment, folder: Option<&Path>, log: Option<&File>) -> Result<(), String> {
    let python = venv::interpreter()?;
    let cache = |name: &str| Ok::<_, String>(workspace::target()?.join("tools").join(name));
    let run = |module: &str, arguments: &[&str]| -> Result<(), String> {
        let mut command = Command::new(&python);
        command
            .args(["-m", module])
            .args(arguments)
            .current_dir(sources())
            .envs(environment.iter().cloned())
            .env("RUFF_CACHE_DIR", cache("ruff")?)
            .env("MYPY_CACHE_DIR", cache("mypy")?);
        if let Some(log) = log {
            let failed = |e: io::Error| format!("cannot write what the tests print: {e}");
            command.stdout(log.try_clone().map_err(failed)?);
            command.stderr(log.try_clone().map_err(failed)?);
        }
        if let Some(folder) = folder {
            command.env("PYTHONPATH", folder);
        }
        if let Some(program) = program()? {
            command.env("TABULATE", program);
        }
        succeed(&mut command)
    };
    run("ruff", &["format", "--quiet", "--check", "."])?;
    run("ruff", &["check", "--quiet", "."])?;
    run("mypy", &["python/coated_contact"])?;
    let pytest = ["-q", "-p", "no:cacheprovider"];
    // One worker for each processor.
    run(
        "pytest",
        &[&pytest[..], &["-n", "logical", "tests"]].concat(),
    )?;
    run(
        "pytest",
        &[
            &pytest[..],
            &["--doctest-modules", "--pyargs", "coated_contact"],
        ]
        .concat(),
    )?;
    run(
        "pytest",
        &[&pytest[..], &["--doctest-glob=*.md", "README.md"]].concat(),
    )
}

/// Returns the folder of the package's sources.
fn sources() -> PathBuf {
    workspace::root().join("crates/python")
}

/// Copies a file, or a folder with all that is in it.
fn copy(from: &Path, to: &Path) -> Result<(), String> {
    let failed = |e: io::Error| format!("cannot copy {} to {}: {e}", from.display(), to.display());
    if !from.is_dir() {
        return fs::copy(from, to).map(|_| ()).map_err(failed);
    }
    fs::create_dir_all(to).map_err(failed)?;
    for entry in fs::read_dir(from).map_err(failed)? {
        let entry = entry.map_err(failed)?;
        copy(&entry.path(), &to.join(entry.file_name()))?;
    }
    Ok(())
}

/// Returns the program `tabulate` with whose numbers those of the package are compared: that of the
/// environment variable `TABULATE`, or the one that the acceptance tests were run with.
fn program() -> Result<Option<OsString>, String> {
    let tested = workspace::target()?.join("release/tabulate-under-test");
    Ok(env::var_os("TABULATE").or_else(|| tested.exists().then(|| tested.into_os_string())))
}
