//! Python packages for the project's own use. They lie in the target directory; the user's own
//! environment is not changed.

use std::fs;
use std::path::PathBuf;
use std::process::Command;

use crate::workspace;

/// Returns the folder (for `PYTHONPATH`) of the package `name` at a version in `range`. The first
/// call fetches it with pip.
pub fn package(name: &str, range: &str) -> Result<PathBuf, String> {
    // Each range has a folder of its own.
    let folder = workspace::target()?
        .join("tools")
        .join(format!("{name}{range}").replace(|c: char| !c.is_ascii_alphanumeric(), "-"));
    if folder.exists() {
        return Ok(folder);
    }
    eprintln!(
        "xtask: fetching {name} {range} from PyPI into {}",
        folder.display()
    );
    // The folder is renamed when it is complete: an interrupted download is not used later.
    let unfinished = folder.with_extension(format!("partial-{}", std::process::id()));
    let status = Command::new("python3")
        .args([
            "-m",
            "pip",
            "install",
            "--quiet",
            "--disable-pip-version-check",
            "--target",
        ])
        .arg(&unfinished)
        .env("PIP_ROOT_USER_ACTION", "ignore")
        .arg(format!("{name}{range}"))
        .status()
        .map_err(|e| format!("cannot run python3: {e}; install python3 with pip"))?;
    if !status.success() {
        // Half a package is useless. If it cannot be removed, the error below still tells the user
        // how to proceed.
        let _ = fs::remove_dir_all(&unfinished);
        return Err(format!(
            "`python3 -m pip install {name}{range}` failed; it needs python3 with pip (Debian: python3-pip), and PyPI within reach"
        ));
    }
    fs::rename(&unfinished, &folder)
        .map_err(|e| format!("cannot rename {}: {e}", unfinished.display()))?;
    Ok(folder)
}
