//! Python packages for the project's own use. They lie in the target directory; the user's own
//! environment is not changed.

use std::fs;
use std::path::PathBuf;
use std::process::Command;

use crate::workspace;

/// Returns the folder (for `PYTHONPATH`) of the package `name` at a version in `range`. The first
/// call fetches it with pip.
pub fn package(name: &str, range: &str) -> Result<PathBuf, String> {
    packages(&[&format!("{name}{range}")])
}

/// Returns the folder (for `PYTHONPATH`) of packages, each with its versions as pip takes them. The
/// first call fetches them with pip.
pub fn packages(requirements: &[&str]) -> Result<PathBuf, String> {
    let all = requirements.join(" ");
    // Each set of packages and versions has a folder of its own.
    let folder = workspace::target()?
        .join("tools")
        .join(all.replace(|c: char| !c.is_ascii_alphanumeric(), "-"));
    if folder.exists() {
        return Ok(folder);
    }
    eprintln!("xtask: fetching {all} from PyPI into {}", folder.display());
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
        .args(requirements)
        .status()
        .map_err(|e| format!("cannot run python3: {e}; install python3 with pip"))?;
    if !status.success() {
        // Half a package is useless. If it cannot be removed, the error below still tells the user
        // how to proceed.
        let _ = fs::remove_dir_all(&unfinished);
        return Err(format!(
            "`python3 -m pip install {all}` failed; it needs python3 with pip (Debian: python3-pip), new enough for these versions, and PyPI within reach"
        ));
    }
    fs::rename(&unfinished, &folder)
        .map_err(|e| format!("cannot rename {}: {e}", unfinished.display()))?;
    Ok(folder)
}
