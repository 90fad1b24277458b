//! Finds a libhdf5 to link, or the tools to build one.
//!
//! In this order: a system library (`HDF5_DIR`, or pkg-config's `hdf5`), then a static build from
//! source with cmake from `$CMAKE`, from the path, or from PyPI, and with ninja from there where
//! there is no make.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::{env, fs};

use crate::{python, workspace};

/// The package of the program `tabulate`, and its feature that builds libhdf5.
pub const TABULATE: &str = "coated-contact-tabulate";
pub const FEATURE: &str = "coated-contact-tabulate/hdf5-static";

/// The oldest cmake, major and minor version, that can build libhdf5.
const OLDEST_CMAKE: (u32, u32) = (3, 26);

/// The variable with the file that tells cmake about the compiler.
const TOOLCHAIN: &str = "CMAKE_TOOLCHAIN_FILE";
/// That file, from the root of the workspace, where the user names none.
const SETTINGS: &str = "crates/xtask/src/libhdf5.cmake";

/// Returns a cargo command with the feature and the environment that HDF5 needs on this machine, unless it names other
/// packages than [`TABULATE`] and not the whole workspace.
pub fn cargo(args: &[&str]) -> Result<Command, String> {
    let mut command = workspace::cargo();
    let Some((subcommand, rest)) = args.split_first() else {
        return Err("no cargo command given".into());
    };
    command.arg(subcommand);
    let names = |start: &str| args.iter().any(|arg| arg.starts_with(start));
    let others = (names("-p") || names("--package"))
        && !names("--workspace")
        && !args.iter().any(|arg| arg.contains(TABULATE));
    if !others && !system_library() {
        forget_moved_builds(&workspace::target()?)?;
        command.args(["--features", FEATURE]).env("CMAKE", cmake()?);
        if env::var_os(TOOLCHAIN).is_none() {
            command.env(TOOLCHAIN, workspace::root().join(SETTINGS));
        }
        if !runs(Command::new("make").arg("--version"))
            && !runs(Command::new("ninja").arg("--version"))
        {
            let folders = env::var_os("PATH").unwrap_or_default();
            let ninja = python::package("ninja", ">=1.11,<2")?.join("bin");
            let folders = env::join_paths([ninja].into_iter().chain(env::split_paths(&folders)));
            command
                .env("PATH", folders.map_err(|e| e.to_string())?)
                .env("CMAKE_GENERATOR", "Ninja");
        }
    }
    command.args(rest);
    Ok(command)
}

/// Removes what cmake has configured in a folder of another name, where the target directory was moved or copied: cmake
/// refuses to go on with it.
fn forget_moved_builds(target: &Path) -> Result<(), String> {
    let folders = |folder: &Path| {
        let entries = fs::read_dir(folder).into_iter().flatten().flatten();
        entries.map(|entry| entry.path())
    };
    let packages = folders(target).flat_map(|profile| folders(&profile.join("build")));
    for build in packages.map(|package| package.join("out/build")) {
        let Ok(cache) = fs::read_to_string(build.join("CMakeCache.txt")) else {
            continue;
        };
        let own = build.display().to_string();
        // Once cmake has refused, only some of the lines name the old folder.
        let mut names = cache.lines().filter(|line| line.contains("out/build"));
        if names.any(|line| !line.contains(&own)) {
            workspace::clear(&build)?;
        }
    }
    Ok(())
}

fn system_library() -> bool {
    env::var_os("HDF5_DIR").is_some_and(|dir| !dir.is_empty())
        || runs(Command::new("pkg-config").args(["--exists", "hdf5"]))
}

/// Returns a cmake that can build libhdf5: that of `$CMAKE`, of the path, or of PyPI.
pub fn cmake() -> Result<PathBuf, String> {
    let given = env::var_os("CMAKE").map(PathBuf::from);
    let candidates = given.into_iter().chain([PathBuf::from("cmake")]);
    for candidate in candidates {
        if cmake_version(&candidate).is_some_and(|version| version >= OLDEST_CMAKE) {
            return Ok(candidate);
        }
    }
    let package = python::package("cmake", ">=3.26,<4").map_err(|why| {
        format!(
            "libhdf5 has to be built and there is no cmake {}.{} or newer: {why}\n\
             Install one of: libhdf5 with its headers and pkg-config file (Debian: libhdf5-dev pkg-config); \
             cmake >= {0}.{1} (or set CMAKE to it); python3 with pip",
            OLDEST_CMAKE.0, OLDEST_CMAKE.1
        )
    })?;
    Ok(package.join("cmake/data/bin/cmake"))
}

/// Returns `(major, minor)` of a cmake that prints "cmake version 3.31.2".
fn cmake_version(cmake: &Path) -> Option<(u32, u32)> {
    let output = Command::new(cmake).arg("--version").output().ok()?;
    let text = String::from_utf8(output.stdout).ok()?;
    let mut numbers = text.lines().next()?.rsplit(' ').next()?.split('.');
    Some((numbers.next()?.parse().ok()?, numbers.next()?.parse().ok()?))
}

/// Returns whether a command succeeds; its output is not shown.
pub fn runs(command: &mut Command) -> bool {
    let silent = command.stdout(Stdio::null()).stderr(Stdio::null());
    silent.status().is_ok_and(|status| status.success())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_cmake_configured_under_another_name_of_the_folder_is_removed() {
        let target = env::temp_dir().join(format!("moved-{}", std::process::id()));
        let build = |name: &str| target.join(format!("release/build/{name}/out/build"));
        let configured = |name: &str, folder: &Path| {
            fs::create_dir_all(build(name)).expect("a new folder");
            let text = format!("X:INTERNAL=1\nOUTPUT:PATH={}/bin\n", folder.display());
            fs::write(build(name).join("CMakeCache.txt"), text).expect("a new file");
        };
        configured("moved", Path::new("/another/release/build/moved/out/build"));
        configured("stayed", &build("stayed"));
        fs::create_dir_all(build("other")).expect("a new folder");
        forget_moved_builds(&target).expect("ours");
        let there = ["moved", "stayed", "other"].map(|name| build(name).exists());
        fs::remove_dir_all(&target).expect("ours");
        assert_eq!(there, [false, true, true]);
    }
}
