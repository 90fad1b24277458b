//! The licences of all crates of the lock file, and the crates that nobody maintains.

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

/// The name of everything that is in no published package.
const TESTS: &str = "tests, benches, xtask";

/// The Python package.
const WHEEL: &str = "coated-contact-python, coated-contact-python/hdf5";
/// All packages that fit.
const FITS: &str = "coated-contact-fit, coated-contact-python, coated-contact-python/hdf5, coated-contact-tabulate/default, coated-contact-tabulate/figures";

/// Crates under other licences, their licences, and the features that need them.
const OTHERS: [(&str, &str, &str); 10] = [
    ("approx", "Apache-2.0", FITS),
    ("cbindgen", "MPL-2.0", TESTS),
    ("ciborium", "Apache-2.0", TESTS),
    ("ciborium-io", "Apache-2.0", TESTS),
    ("ciborium-ll", "Apache-2.0", TESTS),
    // In a file of its own, that of HDF5: as BSD-3-Clause.
    ("hdf5-metno-src", "", "coated-contact-tabulate/hdf5-static"),
    ("nalgebra", "Apache-2.0", FITS),
    ("simba", "Apache-2.0", FITS),
    ("spdx", "Apache-2.0", TESTS),
    // Runs in the compiler only.
    ("target-lexicon", "Apache-2.0 WITH LLVM-exception", WHEEL),
];

/// Crates that nobody maintains, with the reason to keep them.
const UNMAINTAINED: [(&str, &str, &str); 2] = [
    (
        "bincode",
        "2.0.1",
        "RUSTSEC-2025-0141; pinned, for packed tables only, behind a checksum and limits, fuzzed",
    ),
    (
        "paste",
        "1.0.15",
        "RUSTSEC-2024-0436; runs in the compiler only, for faer and simba",
    ),
];

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
    let found = others(&all)?;
    let mut needed: BTreeMap<&str, BTreeSet<String>> = found
        .keys()
        .map(|name| (name.as_str(), BTreeSet::new()))
        .collect();
    for (package, feature) in features()? {
        let (name, tree) = if feature == NO_FEATURE {
            (package.clone(), tree(&package, "", "all")?)
        } else {
            (
                format!("{package}/{feature}"),
                tree(&package, &feature, "all")?,
            )
        };
        for (other, by) in &mut needed {
            if tree.contains_key(*other) {
                by.insert(name.clone());
            }
        }
    }
    let stated: BTreeMap<&str, (&str, &str)> = OTHERS
        .iter()
        .map(|(name, licence, by)| (*name, (*licence, *by)))
        .collect();
    for (name, by) in &needed {
        let by = if by.is_empty() {
            TESTS.to_owned()
        } else {
            by.iter().cloned().collect::<Vec<_>>().join(", ")
        };
        let licence = &found[*name];
        if stated.get(name) != Some(&(licence.as_str(), by.as_str())) {
            return Err(format!(
                "{name} has the licence {licence:?} and is needed by {by}: leave it out, or state this in \
                 crates/xtask/src/licences.rs and in the README of the package"
            ));
        }
        println!("{name:30} {licence:12} {by}");
    }
    if let Some(name) = stated.keys().find(|name| !needed.contains_key(*name)) {
        return Err(format!(
            "{name} is gone, or has another licence: remove it from crates/xtask/src/licences.rs"
        ));
    }
    for (name, version, why) in UNMAINTAINED {
        let versions = all.get(name).into_iter().flatten();
        if !versions.clone().any(|(found, _)| found == version) {
            return Err(format!(
                "{name} {version}, which nobody maintains, is gone: remove it from crates/xtask/src/licences.rs"
            ));
        }
        println!("{name:30} unmaintained: {why}");
    }
    println!(
        "all other {} crates have the conditions of MIT or fewer",
        all.len() - found.len()
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

/// The feature of a package without any.
const NO_FEATURE: &str = "";

/// Returns the published packages of the workspace with each of their features.
fn features() -> Result<Vec<(String, String)>, String> {
    let mut features = Vec::new();
    for package in workspace::members()? {
        let name = package["name"].as_str().unwrap_or_default();
        // `publish = false` is an empty list. The Python package is published as a wheel.
        if package["publish"].is_array() && name != PYTHON {
            continue;
        }
        features.push((name.to_owned(), NO_FEATURE.to_owned()));
        for feature in package["features"].as_object().into_iter().flatten() {
            features.push((name.to_owned(), feature.0.clone()));
        }
    }
    Ok(features)
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
