//! The packages of Rust that crates.io gets, in the order of their dependencies.

use std::path::Path;

use serde_json::Value;

use super::{VERSION, put};
use crate::{hdf5, succeed, workspace};

/// Returns the names of the published packages, each after those that it depends on.
pub fn in_order() -> Result<Vec<String>, String> {
    let all = workspace::members()?;
    // `publish = false` is an empty list.
    let published = all.iter().filter(|package| package["publish"].is_null());
    order(&published.collect::<Vec<_>>())
}

fn order(published: &[&Value]) -> Result<Vec<String>, String> {
    let name = |package: &Value| package["name"].as_str().unwrap_or_default().to_owned();
    let needs = |package: &Value, other: &Value| {
        let dependencies = package["dependencies"].as_array().into_iter().flatten();
        // Tests need no package of the registry.
        dependencies
            .filter(|one| one["kind"] != "dev")
            .any(|one| one["name"] == other["name"])
    };
    let (mut ordered, mut left) = (Vec::new(), published.to_vec());
    while !left.is_empty() {
        let is_ready = |package: &&Value| !left.iter().any(|other| needs(package, other));
        let (ready, blocked): (Vec<_>, Vec<_>) = left.iter().partition(|&one| is_ready(one));
        if ready.is_empty() {
            return Err(format!("packages depend on each other: {blocked:?}"));
        }
        ordered.extend(ready.into_iter().map(name));
        left = blocked;
    }
    Ok(ordered)
}

/// Packs the packages into `crates` of a folder, with their place in the order before their names.
/// Cargo compiles each from what is packed, and from the packages before it.
pub fn pack(folder: &Path) -> Result<(), String> {
    let names = in_order()?;
    let selected: Vec<_> = names.iter().flat_map(|name| ["-p", name]).collect();
    succeed(&mut hdf5::cargo(
        &[&["package", "--locked"], &selected[..]].concat(),
    )?)?;
    let packed = workspace::target()?.join("package");
    let folder = workspace::make(&folder.join("crates"))?;
    for (i, name) in names.iter().enumerate() {
        let path = put(&packed.join(format!("{name}-{VERSION}.crate")), &folder)?;
        let numbered = folder.join(format!("{:02}-{name}-{VERSION}.crate", i + 1));
        std::fs::rename(&path, numbered).map_err(|e| super::at(&path, &e))?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    fn package(name: &str, needs: &[(&str, Option<&str>)]) -> Value {
        let needs = needs
            .iter()
            .map(|(name, kind)| json!({ "name": name, "kind": kind }));
        json!({ "name": name, "dependencies": needs.collect::<Vec<_>>() })
    }

    #[test]
    fn a_package_comes_after_those_that_it_needs() {
        let packages = [
            package("fit", &[("contact", None), ("solve", Some("build"))]),
            package("contact", &[("interp", None), ("fit", Some("dev"))]),
            package("solve", &[("interp", None), ("serde", None)]),
            package("interp", &[]),
        ];
        let found = order(&packages.iter().collect::<Vec<_>>());
        let expected = ["interp", "contact", "solve", "fit"].map(str::to_owned);
        assert_eq!(found, Ok(expected.to_vec()));
        let circle = [package("a", &[("b", None)]), package("b", &[("a", None)])];
        assert!(order(&circle.iter().collect::<Vec<_>>()).is_err());
    }

    #[test]
    fn every_package_of_the_workspace_has_a_place() {
        let names = in_order().expect("an order");
        let place = |name: &str| {
            names
                .iter()
                .position(|one| *one == format!("coated-contact-{name}"))
        };
        let chain = [
            "piecewise",
            "low-rank",
            "interp",
            "contact",
            "fit",
            "tabulate",
        ]
        .map(place);
        assert!(
            chain.iter().all(Option::is_some) && chain.is_sorted(),
            "{names:?}"
        );
        assert!([place("python"), place("c")] == [None, None], "{names:?}");
    }
}
