//! The licences of all crates of the lock file.

use std::collections::{BTreeMap, BTreeSet};

use spdx::{Expression, ParseMode};

use crate::{printed, workspace};

/// Licences like MIT: to keep the notice. BSD-3-Clause also forbids to advertise with the names of the authors.
const LIKE_MIT: [&str; 9] = [
    "0BSD",
    "BSD-2-Clause",
    "BSD-3-Clause",
    "BSL-1.0",
    "ISC",
    "MIT",
    "Unicode-3.0",
    "Unlicense",
    "Zlib",
];

/// The crates under other licences, with these and the features that need them.
///
/// That of `hdf5-metno-src` is in a file of its own, that of HDF5: as BSD-3-Clause. `target-lexicon` runs in the compiler only.
const OTHERS: &str = "\
approx (Apache-2.0): fit, python, python/hdf5, tabulate/default, tabulate/figures
cbindgen (MPL-2.0): tests, benches, xtask
ciborium (Apache-2.0): tests, benches, xtask
ciborium-io (Apache-2.0): tests, benches, xtask
ciborium-ll (Apache-2.0): tests, benches, xtask
hdf5-metno-src (): tabulate/hdf5-static
nalgebra (Apache-2.0): fit, python, python/hdf5, tabulate/default, tabulate/figures
simba (Apache-2.0): fit, python, python/hdf5, tabulate/default, tabulate/figures
spdx (Apache-2.0): tests, benches, xtask
target-lexicon (Apache-2.0 WITH LLVM-exception): python, python/hdf5
";

/// Crates by name, with their versions and licences.
pub type Crates = BTreeMap<String, BTreeSet<(String, String)>>;

/// Checks the licences of all crates of the lock file, and prints those that are not as MIT.
pub fn licences() -> Result<(), String> {
    let whole = [
        "--workspace",
        "--all-features",
        "--edges",
        "all",
        "--target",
        "all",
    ];
    let all = crates(&whole)?;
    let licences = others(&all)?;
    let trees = trees()?;
    let mut found = String::new();
    for (name, licence) in &licences {
        let needs = trees.iter().filter(|(_, tree)| tree.contains_key(name));
        let by: Vec<&str> = needs.map(|(feature, _)| feature.as_str()).collect();
        let by = match &by[..] {
            [] => "tests, benches, xtask".to_owned(),
            by => by.join(", "),
        };
        found += &format!("{name} ({licence}): {by}\n");
    }
    if found != OTHERS {
        return Err(format!(
            "the crates under other licences are no longer those of crates/xtask/src/licences.rs, but\n\n{found}\nLeave out \
             what is new, or state this there and in the README of the package that needs it"
        ));
    }
    print!("{found}");
    println!(
        "all other {} crates have the conditions of MIT or fewer",
        all.len() - licences.len()
    );
    Ok(())
}

/// Returns the crates whose licences are not like MIT, with these.
fn others(all: &Crates) -> Result<BTreeMap<String, String>, String> {
    let mut others = BTreeMap::new();
    for (name, versions) in all {
        for (_, licence) in versions {
            if !is_like_mit(licence)? {
                others.insert(name.clone(), licence.clone());
            }
        }
    }
    Ok(others)
}

/// Returns true if an SPDX expression can be met by licences like MIT.
fn is_like_mit(licence: &str) -> Result<bool, String> {
    if licence.is_empty() {
        return Ok(false);
    }
    let expression = Expression::parse_mode(licence, ParseMode::LAX)
        .map_err(|e| format!("{licence:?} is no SPDX expression: {e}"))?;
    Ok(expression.evaluate(|requirement| {
        let id = requirement.license.id();
        requirement.addition.is_none() && id.is_some_and(|id| LIKE_MIT.contains(&id.name))
    }))
}

/// The crate of the Python package.
pub const PYTHON: &str = "coated-contact-python";

/// Returns the crates that each published package needs without features, and with each of its features, by the names of
/// both without their prefix.
fn trees() -> Result<BTreeMap<String, Crates>, String> {
    let mut trees = BTreeMap::new();
    for package in workspace::members()? {
        let name = package["name"].as_str().unwrap_or_default();
        // `publish = false` is an empty list. The Python package is published as a wheel.
        if package["publish"].is_array() && name != PYTHON {
            continue;
        }
        let short = name.trim_start_matches("coated-contact-");
        trees.insert(short.to_owned(), tree(name, "", "all")?);
        for feature in package["features"].as_object().into_iter().flatten() {
            let tree = tree(name, feature.0, "all")?;
            trees.insert(format!("{short}/{}", feature.0), tree);
        }
    }
    Ok(trees)
}

/// Returns the crates that a package needs with some features on a target, or on `all`.
pub fn tree(package: &str, features: &str, target: &str) -> Result<Crates, String> {
    crates(&[
        "--target",
        target,
        "--package",
        package,
        "--no-default-features",
        "--features",
        features,
        "--edges",
        "normal,build",
    ])
}

/// Returns the crates that `cargo tree` lists, without those of this workspace.
fn crates(args: &[&str]) -> Result<Crates, String> {
    let all = [
        "tree", "--locked", "--prefix", "none", "--format", "{p}|{l}",
    ];
    let own = format!("({}", workspace::root().display());
    let mut crates = Crates::new();
    for line in cargo(&[&all, args].concat())?.lines() {
        // So cargo marks a crate that it has listed before.
        let line = line.strip_suffix(" (*)").unwrap_or(line);
        let Some((package, licence)) = line.split_once('|') else {
            continue;
        };
        if package.contains(&own) {
            continue;
        }
        let words: Vec<&str> = package.split(' ').collect();
        let [name, version, ..] = words[..] else {
            return Err(format!("cargo tree prints {line:?}"));
        };
        if package.contains("://") || package.contains("(/") {
            return Err(format!("{package} is not from crates.io"));
        }
        let version = version.trim_start_matches('v').to_owned();
        crates
            .entry(name.to_owned())
            .or_default()
            .insert((version, licence.trim().to_owned()));
    }
    Ok(crates)
}

/// Runs cargo and returns its output.
fn cargo(args: &[&str]) -> Result<String, String> {
    printed(workspace::cargo().args(args).current_dir(workspace::root()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_expression_is_met_by_licences_like_mit_or_not() {
        for (licence, expected) in [
            ("MIT", true),
            ("MIT OR Apache-2.0", true),
            ("Unlicense/MIT", true),
            ("(MIT OR Apache-2.0) AND Unicode-3.0", true),
            ("MIT OR Apache-2.0 OR LGPL-2.1-or-later", true),
            ("Apache-2.0", false),
            ("MIT AND Apache-2.0", false),
            ("Apache-2.0 WITH LLVM-exception", false),
            ("GPL-3.0-only", false),
            ("", false),
        ] {
            assert_eq!(is_like_mit(licence), Ok(expected), "{licence}");
        }
        assert!(is_like_mit("MTI").is_err());
    }
}
