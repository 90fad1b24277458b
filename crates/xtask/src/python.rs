//! Python packages for the project's own use, kept in the target directory and never in the user's
//! environment.

use std::fs;
use std::path::PathBuf;
use std::process::Command;

use crate::workspace;

/// The folder (for `PYTHONPATH`) that holds `name` at a version in `range`, fetched by pip at the
/// first call.
pub fn package(name: &str, range: &str) -> Result<PathBuf, String> {
    // Another range is another folder.
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
    // Renamed when complete, so that an interrupted download is never taken for a finished one.
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
        // What there is of it is of no use; if it cannot be removed either, the error below still
        // says what to do.
        let _ = fs::remove_dir_all(&unfinished);
        return Err(format!(
            "`python3 -m pip install {name}{range}` failed; it needs python3 with pip (Debian: python3-pip), and PyPI within reach"
        ));
    }
    fs::rename(&unfinished, &folder)
        .map_err(|e| format!("cannot rename {}: {e}", unfinished.display()))?;
    Ok(folder)
}
