//! The folders of the workspace and of its build products.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};

use serde_json::Value;

use crate::printed;

/// Returns the folder of the workspace's `Cargo.toml`.
pub fn root() -> PathBuf {
    // The environment comes first: in a target directory that was copied with its checkout, this
    // program was built in another folder.
    let here = env::var_os("CARGO_MANIFEST_DIR")
        .map_or_else(|| PathBuf::from(env!("CARGO_MANIFEST_DIR")), PathBuf::from);
    here.ancestors()
        .nth(2)
        .expect("xtask lives two folders below the workspace root")
        .to_path_buf()
}

/// Returns the target directory, where cargo has put this program as `release/xtask`. A variable of the environment or
/// a file of settings names it, or the triple of a compilation target in it.
pub fn target() -> Result<PathBuf, String> {
    let program = env::current_exe().map_err(|e| format!("no path of this program: {e}"))?;
    let target = program.ancestors().nth(2);
    let target =
        target.ok_or_else(|| format!("{} is in no target directory", program.display()))?;
    Ok(target.to_owned())
}

/// Returns the text of a file.
pub fn read(path: &Path) -> Result<String, String> {
    fs::read_to_string(path).map_err(|e| format!("cannot read {}: {e}", path.display()))
}

/// Returns the files of a folder whose names end in `.ending`, in alphabetical order.
pub fn files(folder: &Path, ending: &str) -> Result<Vec<PathBuf>, String> {
    let entries =
        fs::read_dir(folder).map_err(|e| format!("cannot read {}: {e}", folder.display()))?;
    let paths = entries.filter_map(|entry| Some(entry.ok()?.path()));
    let mut files: Vec<PathBuf> = paths
        .filter(|path| path.extension().is_some_and(|found| found == ending))
        .collect();
    files.sort();
    Ok(files)
}

/// Makes a folder, and returns it.
pub fn make(folder: &Path) -> Result<PathBuf, String> {
    fs::create_dir_all(folder).map_err(|e| format!("cannot make {}: {e}", folder.display()))?;
    Ok(folder.to_owned())
}

/// Removes a folder if it is there.
pub fn clear(folder: &Path) -> Result<(), String> {
    if folder.exists() {
        fs::remove_dir_all(folder)
            .map_err(|e| format!("cannot remove {}: {e}", folder.display()))?;
    }
    Ok(())
}

/// Returns what `cargo metadata` tells of each member of the workspace.
pub fn members() -> Result<Vec<Value>, String> {
    let mut command = cargo();
    command
        .args([
            "metadata",
            "--no-deps",
            "--format-version",
            "1",
            "--manifest-path",
        ])
        .arg(root().join("Cargo.toml"));
    let mut metadata: Value = serde_json::from_str(&printed(&mut command)?)
        .map_err(|e| format!("cargo metadata prints no JSON: {e}"))?;
    match metadata["packages"].take() {
        Value::Array(members) => Ok(members),
        _ => Err("cargo metadata lists no packages".into()),
    }
}

/// Returns the cargo that runs this program.
pub fn cargo() -> Command {
    Command::new(env::var_os("CARGO").unwrap_or_else(|| "cargo".into()))
}
