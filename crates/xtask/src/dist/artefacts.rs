//! The artefacts: wheel and source of Python, program, C library, packages, and their sums.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use super::{bom, metadata, trial, zig};
use crate::{hdf5, succeed, wheel, workspace};

/// The version of the release.
pub(super) const VERSION: &str = env!("CARGO_PKG_VERSION");
/// The package of the C interface.
pub(super) const C: &str = "coated-contact-c";
/// The target without a C library of the system, and that with the one of 2014.
pub(super) const STATIC: &str = "x86_64-unknown-linux-musl";
pub(super) const OLD_LINUX: &str = "x86_64-unknown-linux-gnu";

/// Checks the metadata of a release: version, citation, archive, recipe, and list of what is compiled in.
pub fn check() -> Result<(), String> {
    metadata::check()?;
    bom::write(&workspace::target()?.join("tools"))
}

/// Makes all artefacts of a release in `dist` of the target directory, and tries each.
pub fn dist() -> Result<(), String> {
    metadata::check()?;
    let folder = workspace::target()?.join("dist");
    workspace::clear(&folder)?;
    workspace::make(&folder)?;
    let zig = zig::fetch()?;

    let [wheel, source] = wheel::release(&zig)?;
    let [wheel, source] = [put(&wheel, &folder)?, put(&source, &folder)?];
    metadata::recipe_of(&source, &folder.join("recipe.yaml"))?;

    let made = zig::build(&zig, STATIC, hdf5::TABULATE, &["--features", hdf5::FEATURE])?;
    let program = archive(
        &folder,
        &format!("tabulate-{VERSION}-x86_64-linux"),
        &[
            (made.join("tabulate"), ""),
            (here("crates/tabulate/README.md"), ""),
        ],
    )?;

    let made = zig::build(&zig, OLD_LINUX, C, &[])?;
    let library = archive(
        &folder,
        &format!("{C}-{VERSION}-x86_64-linux"),
        &[
            (made.join("libcoated_contact.so"), "lib"),
            (made.join("libcoated_contact.a"), "lib"),
            (here("crates/capi/include/coated_contact.h"), "include"),
            (here("crates/capi/examples/force.c"), "examples"),
            (here("crates/capi/README.md"), ""),
        ],
    )?;

    pack(&folder)?;
    bom::write(&folder)?;
    trial::all(&wheel, &source, &program, &library)?;
    succeed(
        Command::new("sh")
            .args(["-c", "sha256sum -- *.* */*.crate > SHA256SUMS"])
            .current_dir(&folder),
    )?;
    println!("xtask: the release is in {}", folder.display());
    Ok(())
}

/// Packs the packages of Rust that crates.io gets into `crates` of a folder. Cargo compiles each from what is packed, after
/// those that it depends on.
fn pack(folder: &Path) -> Result<(), String> {
    let mut names = Vec::new();
    for package in workspace::members()? {
        // `publish = false` is an empty list.
        if package["publish"].is_null() {
            names.push(package["name"].as_str().unwrap_or_default().to_owned());
        }
    }
    let selected: Vec<_> = names.iter().flat_map(|name| ["-p", name]).collect();
    succeed(&mut hdf5::cargo(
        &[&["package", "--locked"], &selected[..]].concat(),
    )?)?;
    let packed = workspace::target()?.join("package");
    let folder = workspace::make(&folder.join("crates"))?;
    for name in names {
        put(&packed.join(format!("{name}-{VERSION}.crate")), &folder)?;
    }
    Ok(())
}

/// Packs files, each into a folder of its archive, with the licences, and returns the path of the
/// archive.
fn archive(folder: &Path, name: &str, files: &[(PathBuf, &str)]) -> Result<PathBuf, String> {
    let staging = workspace::target()?.join("tools").join(name);
    workspace::clear(&staging)?;
    let licences = ["LICENSE-MIT", "LICENSE-APACHE"].map(|name| (here(name), ""));
    for (file, within) in files.iter().chain(&licences) {
        put(file, &workspace::make(&staging.join(within))?)?;
    }
    let path = folder.join(format!("{name}.tar.gz"));
    // The bytes depend on the content alone.
    succeed(
        Command::new("tar")
            .args(["--sort=name", "--mtime=@0", "--owner=0", "--group=0"])
            .args(["--numeric-owner", "--use-compress-program=gzip -n9", "-cf"])
            .args([&path, Path::new("-C")])
            .arg(staging.parent().expect("a folder in the tools"))
            .arg(name),
    )?;
    workspace::clear(&staging)?;
    Ok(path)
}

/// Copies a file into a folder, and returns its new path.
fn put(file: &Path, folder: &Path) -> Result<PathBuf, String> {
    let copy = folder.join(file.file_name().expect("a file has a name"));
    fs::copy(file, &copy).map_err(|e| at(file, &e))?;
    Ok(copy)
}

/// Returns the path of a file of the workspace.
pub(super) fn here(path: &str) -> PathBuf {
    workspace::root().join(path)
}

/// Names the file in an error.
pub(super) fn at(path: &Path, error: &std::io::Error) -> String {
    format!("{}: {error}", path.display())
}
