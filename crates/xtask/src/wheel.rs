//! The Python package: its wheel and source distribution, and its tests in a virtual environment.

use std::env;
use std::ffi::OsString;
use std::fs;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use crate::{python, succeed, workspace};

/// The packages that build and test the Python package.
const PACKAGES: [&str; 12] = [
    "distributed==2026.8.0",
    "lmfit==1.3.4",
    "matplotlib==3.11.2",
    "maturin==1.16.0",
    "mypy==2.4.1",
    "numpy==2.4.6",
    "pandas==3.1.1",
    "pytest==9.2.0",
    "ruff==0.17.6",
    "scipy==1.17.1",
    "tqdm==4.70.1",
    "xarray==2026.9.0",
];
/// The packages with whose numbers those of the package are compared. Without them the tests that
/// need them are skipped.
const PEERS: [&str; 2] = ["ContactMechanics==1.8.3", "nanite==4.2.3"];
/// The version of zig that links the wheel of a release.
const ZIG: &str = "==0.15.2";
/// The version of nanite whose source holds the measured curve of a test.
const NANITE: &str = "4.2.3";

/// Builds the wheel and the source distribution into `wheels` in the target directory.
pub fn build() -> Result<(), String> {
    distribute(&[], None)
}

/// Builds the wheel of a release like [`build`], for every Linux since 2014: zig, from PyPI, links
/// it with the C library of that time.
pub fn release() -> Result<(), String> {
    let zig = python::package("ziglang", ZIG)?;
    distribute(&["--zig", "--compatibility", "manylinux2014"], Some(&zig))
}

fn distribute(options: &[&str], zig: Option<&Path>) -> Result<(), String> {
    let python = environment()?;
    wheel(&python, options, zig)?;
    succeed(maturin(&python, "sdist")?.arg("--out").arg(folder()?))?;
    println!(
        "xtask: wheel and source distribution are in {}",
        folder()?.display()
    );
    Ok(())
}

/// Builds the package, installs it into a virtual environment, and runs its tests and checks there.
/// Without a python3 that can make one, it says so.
pub fn test() -> Result<(), String> {
    if !runs(
        "python3",
        &[
            "-c",
            "import sys, venv, ensurepip; assert sys.version_info >= (3, 11)",
        ],
    ) {
        eprintln!(
            "xtask: the tests of the Python package are skipped: there is no python3 >= 3.11 with venv"
        );
        return Ok(());
    }
    let python = environment()?;
    let package = workspace::root().join("crates/python");
    let wheel = wheel(&python, &[], None)?;
    let pip = [
        "-m",
        "pip",
        "install",
        "--quiet",
        "--disable-pip-version-check",
        "--no-deps",
        "--force-reinstall",
    ];
    succeed(Command::new(&python).args(pip).arg(wheel))?;

    let measured = match python::source("nanite", NANITE) {
        Ok(folder) => Some(folder),
        Err(message) => {
            eprintln!("xtask: {message}\nxtask: the tests with a measured curve are skipped");
            None
        }
    };
    let cache = |name: &str| Ok::<_, String>(workspace::target()?.join("tools").join(name));
    let run = |module: &str, arguments: &[&str]| -> Result<(), String> {
        let mut command = Command::new(&python);
        command
            .args(["-m", module])
            .args(arguments)
            .current_dir(&package)
            .env("PYTHONDONTWRITEBYTECODE", "1")
            .env("RUFF_CACHE_DIR", cache("ruff")?)
            .env("MYPY_CACHE_DIR", cache("mypy")?);
        if let Some(folder) = &measured {
            command.env("NANITE_SOURCE", folder);
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
    run("pytest", &[&pytest[..], &["tests"]].concat())?;
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

/// Builds the wheel with further options of maturin, and with the folder of zig where it links, and
/// returns its path.
fn wheel(python: &Path, options: &[&str], zig: Option<&Path>) -> Result<PathBuf, String> {
    let folder = folder()?;
    // An older wheel would be taken for the new one.
    if folder.exists() {
        fs::remove_dir_all(&folder)
            .map_err(|e| format!("cannot remove {}: {e}", folder.display()))?;
    }
    succeed(
        maturin(python, "build")?
            .args(["--profile", "wheel", "--locked", "--out"])
            .arg(&folder)
            .args(options)
            .envs(zig.map(|folder| ("PYTHONPATH", folder))),
    )?;
    let entries =
        fs::read_dir(&folder).map_err(|e| format!("cannot read {}: {e}", folder.display()))?;
    entries
        .filter_map(|entry| Some(entry.ok()?.path()))
        .find(|path| path.extension().is_some_and(|extension| extension == "whl"))
        .ok_or_else(|| format!("maturin left no wheel in {}", folder.display()))
}

/// Returns a command of maturin on the package.
fn maturin(python: &Path, command: &str) -> Result<Command, String> {
    let mut maturin = Command::new(python);
    maturin
        .args(["-m", "maturin", command, "--manifest-path"])
        .arg(workspace::root().join("crates/python/Cargo.toml"))
        .env("CARGO_TARGET_DIR", workspace::target()?);
    Ok(maturin)
}

/// Returns the folder of wheel and source distribution.
fn folder() -> Result<PathBuf, String> {
    Ok(workspace::target()?.join("wheels"))
}

/// Returns the program `tabulate` with whose numbers those of the package are compared: that of the
/// environment variable `TABULATE`, or the one that the acceptance tests were run with.
fn program() -> Result<Option<OsString>, String> {
    let tested = workspace::target()?.join("release/tabulate-under-test");
    Ok(env::var_os("TABULATE").or_else(|| tested.exists().then(|| tested.into_os_string())))
}

/// Returns the interpreter of a virtual environment with [`PACKAGES`]. The first call makes it.
fn environment() -> Result<PathBuf, String> {
    let mut hasher = DefaultHasher::new();
    (PACKAGES, PEERS).hash(&mut hasher);
    let name = format!("venv-{:016x}", hasher.finish());
    let folder = workspace::target()?.join("tools").join(name);
    let python = folder.join("bin/python");
    if folder.exists() {
        return Ok(python);
    }
    eprintln!(
        "xtask: fetching {} from PyPI into {}",
        PACKAGES.join(" "),
        folder.display()
    );
    // The folder is renamed when it is complete: an interrupted download is not used later.
    let unfinished = folder.with_extension(format!("partial-{}", std::process::id()));
    succeed(
        Command::new("python3")
            .args(["-m", "venv"])
            .arg(&unfinished),
    )?;
    let pip = [
        "-m",
        "pip",
        "install",
        "--quiet",
        "--disable-pip-version-check",
    ];
    succeed(
        Command::new(unfinished.join("bin/python"))
            .args(pip)
            .args(PACKAGES),
    )?;
    for peer in PEERS {
        let fetched = Command::new(unfinished.join("bin/python"))
            .args(pip)
            .arg(peer)
            // Lest the peer replaces a version.
            .args(PACKAGES)
            .status();
        if !fetched.is_ok_and(|status| status.success()) {
            eprintln!("xtask: {peer} cannot be fetched: the tests that need it are skipped");
        }
    }
    fs::rename(&unfinished, &folder)
        .map_err(|e| format!("cannot rename {}: {e}", unfinished.display()))?;
    Ok(python)
}

fn runs(program: &str, arguments: &[&str]) -> bool {
    let mut command = Command::new(program);
    command
        .args(arguments)
        .stdout(Stdio::null())
        .stderr(Stdio::null());
    command.status().is_ok_and(|status| status.success())
}
