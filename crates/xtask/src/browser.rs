//! The browser that the tests of the report run it in.

use std::env;
use std::path::PathBuf;
use std::process::Command;

/// Chromium: what `CHROMIUM` names, or one in `PATH`, or Debian's, installed if we may. None
/// otherwise: the tests then say that they are skipped.
pub fn chromium() -> Option<PathBuf> {
    env::var_os("CHROMIUM")
        .map(PathBuf::from)
        .or_else(in_path)
        .or_else(|| {
            let root = Command::new("id")
                .arg("-u")
                .output()
                .is_ok_and(|output| output.stdout == b"0\n");
            if !root {
                return None;
            }
            eprintln!("xtask: installing chromium with apt-get");
            let apt = |arguments: &[&str]| {
                let output = Command::new("apt-get")
                    .args(arguments)
                    .env("DEBIAN_FRONTEND", "noninteractive")
                    .output();
                output.is_ok_and(|output| output.status.success())
            };
            let install = || apt(&["install", "--yes", "--no-install-recommends", "chromium"]);
            // A fresh machine may know of no packages.
            if install() || apt(&["update"]) && install() {
                in_path()
            } else {
                None
            }
        })
}

fn in_path() -> Option<PathBuf> {
    let folders: Vec<PathBuf> = env::split_paths(&env::var_os("PATH")?).collect();
    let names = ["chromium", "chromium-browser", "google-chrome"];
    names
        .iter()
        .flat_map(|name| folders.iter().map(move |folder| folder.join(name)))
        .find(|path| path.is_file())
}
