//! Names this build by a hash over what determines its numbers (`src/table/build.rs` uses it).

use std::collections::BTreeMap;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};

/// The sources of this crate, of those that it solves and interpolates with, and the lock file, as
/// they lie in the workspace and in a package. One of the two places does not exist. The version of
/// a package stands for the sources of its dependencies.
const SOURCES: [&str; 8] = [
    "src",
    "../solve/src",
    "../piecewise/src",
    "../contact/src",
    "../interp/src",
    "../low-rank/src",
    "../../Cargo.lock",
    "Cargo.lock",
];
/// The settings of the compiler.
const SETTINGS: [&str; 5] = [
    "TARGET",
    "OPT_LEVEL",
    "CARGO_ENCODED_RUSTFLAGS",
    "CARGO_CFG_TARGET_FEATURE",
    "CARGO_PKG_VERSION",
];

fn main() {
    let mut files = BTreeMap::new();
    for source in SOURCES.iter().map(Path::new).filter(|path| path.exists()) {
        println!("cargo::rerun-if-changed={}", source.display());
        collect(source, &mut files);
    }
    let mut hasher = DefaultHasher::new();
    files.hash(&mut hasher);
    for setting in SETTINGS {
        env::var(setting).unwrap_or_default().hash(&mut hasher);
    }
    let rustc = env::var_os("RUSTC").expect("cargo sets it");
    let version = Command::new(rustc).arg("-vV").output().expect("rustc runs");
    version.stdout.hash(&mut hasher);
    println!("cargo::rustc-env=BUILD_HASH={:016x}", hasher.finish());
}

/// Adds a file, or every file of a folder.
fn collect(path: &Path, files: &mut BTreeMap<PathBuf, Vec<u8>>) {
    if path.is_dir() {
        for entry in fs::read_dir(path).expect("a folder of sources") {
            collect(&entry.expect("an entry").path(), files);
        }
    } else {
        files.insert(path.to_owned(), fs::read(path).expect("a source"));
    }
}
