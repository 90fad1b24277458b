//! The browser in which the tests of the report run its page.

use std::env;
use std::path::PathBuf;

/// Returns the path of Chromium: the value of `CHROMIUM`, or a program in `PATH`; none where there
/// is no browser.
pub fn chromium() -> Option<PathBuf> {
    env::var_os("CHROMIUM").map(PathBuf::from).or_else(in_path)
}

fn in_path() -> Option<PathBuf> {
    let folders: Vec<PathBuf> = env::split_paths(&env::var_os("PATH")?).collect();
    let names = ["chromium", "chromium-browser", "google-chrome"];
    names
        .iter()
        .flat_map(|name| folders.iter().map(move |folder| folder.join(name)))
        .find(|path| path.is_file())
}
