//! Each artefact does its first work where nothing else of the project is.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

use super::at;
use crate::{python, succeed, workspace};

/// The first force curve, in Python.
const FIRST_CURVE: &str = "
from coated_contact import Elastic, System, Table
system = System(
    sphere_radius=1e-3,
    sphere_modulus=2e6,
    film=Elastic(young_modulus=3.5e6, poisson_ratio=0.5),
    film_thickness=1e-5,
    substrate=Elastic(young_modulus=2e11, poisson_ratio=0.25),
)
contact = Table.embedded().contact(system)
curve = contact.force_displacement(0.040, control='displacement', most=1e-6)
last = contact.pull_off(0.040, control='displacement').load
assert min(branch.load.min() for branch in curve.unloading) <= last < 0, last
";

/// Tries all artefacts: wheel and source distribution of Python, archives of the program and of the
/// library of C.
pub fn all(wheel: &Path, source: &Path, program: &Path, library: &Path) -> Result<(), String> {
    let folder = workspace::target()?.join("tools/trial");
    workspace::clear(&folder)?;
    workspace::make(&folder)?;
    installed(wheel, &folder.join("wheel"))?;
    run_program(&unpacked(program, &folder)?, &folder)?;
    compile_example(&unpacked(library, &folder)?)?;
    installed(source, &folder.join("source"))?;
    workspace::clear(&folder)
}

/// Installs a distribution into a new virtual environment, and computes a force curve there.
fn installed(distribution: &Path, environment: &Path) -> Result<(), String> {
    succeed(
        Command::new("python3")
            .args(["-m", "venv"])
            .arg(environment),
    )?;
    let interpreter = environment.join("bin/python");
    let start = Instant::now();
    python::install(&interpreter, [distribution])?;
    succeed(Command::new(&interpreter).args(["-c", FIRST_CURVE]))?;
    println!(
        "xtask: {:.1} s from pip install of {} to the first force curve",
        start.elapsed().as_secs_f64(),
        distribution.display()
    );
    Ok(())
}

/// Makes, writes and reads a table with the program, which needs no library of the system.
fn run_program(folder: &Path, free: &Path) -> Result<(), String> {
    let program = folder.join("tabulate");
    let scene = "title = 'trial'\ntolerance = 1e-3\nquantities = ['pi0']\na_over_t = { from = 0.1, to = 1.0 }\n\
                 e1_over_e2 = 1.0\nnu1 = 0.5\ne0_over_e2 = 1e5\nnu0 = 0.25\n";
    let path = free.join("trial.toml");
    fs::write(&path, scene).map_err(|e| at(&path, &e))?;
    let run = |args: &[&str]| {
        succeed(
            Command::new(&program)
                .env_clear()
                .current_dir(free)
                .args(args),
        )
    };
    run(&["generate", "trial.toml", "-o", "trial.h5"])?;
    run(&["info", "trial.h5"])?;
    run(&["pack", "trial.h5", "-o", "trial.bin"])?;
    let ldd = Command::new("ldd").arg(&program).output();
    let ldd = ldd.map_err(|e| format!("cannot run ldd: {e}"))?;
    let said = String::from_utf8_lossy(&[ldd.stdout, ldd.stderr].concat()).into_owned();
    if said.contains("=>") {
        return Err(format!(
            "{} needs libraries of the system: {said}",
            program.display()
        ));
    }
    Ok(())
}

/// Compiles the example in C with the shared library and with the static one, and runs both.
fn compile_example(folder: &Path) -> Result<(), String> {
    for linked in ["-lcoated_contact", "-l:libcoated_contact.a"] {
        let program = folder.join("force");
        succeed(
            Command::new("cc")
                .args([
                    "-std=c99",
                    "-I",
                    "include",
                    "-L",
                    "lib",
                    "examples/force.c",
                    linked,
                ])
                .args(["-lpthread", "-ldl", "-lm", "-o", "force"])
                .current_dir(folder),
        )?;
        succeed(
            Command::new(&program)
                .env_clear()
                .env("LD_LIBRARY_PATH", folder.join("lib")),
        )?;
    }
    Ok(())
}

/// Unpacks an archive, and returns the folder that it holds.
fn unpacked(archive: &Path, folder: &Path) -> Result<PathBuf, String> {
    succeed(
        Command::new("tar")
            .arg("-xf")
            .arg(archive)
            .arg("-C")
            .arg(folder),
    )?;
    let name = archive.file_name().and_then(|name| name.to_str());
    let name = name.and_then(|name| name.strip_suffix(".tar.gz"));
    Ok(folder.join(name.expect("an archive of ours")))
}
