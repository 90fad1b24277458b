//! Where the workspace and its build products are.

use std::env;
use std::path::PathBuf;

/// The folder of the workspace's `Cargo.toml`.
pub fn root() -> PathBuf {
    // As cargo says when it runs this: a target directory that was copied with its checkout holds a
    // program that was built elsewhere.
    let here = env::var_os("CARGO_MANIFEST_DIR")
        .map_or_else(|| PathBuf::from(env!("CARGO_MANIFEST_DIR")), PathBuf::from);
    here.ancestors()
        .nth(2)
        .expect("xtask lives two folders below the workspace root")
        .to_path_buf()
}

/// The target directory, which `CARGO_TARGET_DIR` may put anywhere; if relative, cargo reads it
/// from the current folder.
pub fn target() -> Result<PathBuf, String> {
    let current = env::current_dir().map_err(|e| format!("no current folder: {e}"))?;
    Ok(env::var_os("CARGO_TARGET_DIR")
        .map_or_else(|| root().join("target"), |dir| current.join(dir)))
}
