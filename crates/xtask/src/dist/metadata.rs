//! What describes a release: its version, `CITATION.cff`, `.zenodo.json` and the conda recipe.

use std::fs;
use std::path::Path;
use std::process::Command;

use serde_json::Value;

use super::{VERSION, at, here};
use crate::workspace::read;
use crate::{printed, python, succeed};

/// The program that checks and converts `CITATION.cff`, and that which reads conda recipes.
const CFFCONVERT: &str = "==2.0.0";
const RATTLER_BUILD: &str = "==0.73.0";
/// Reads and renders a recipe as a build on conda-forge does, where the compilers have these versions.
const RENDER: &str = "
import sys
from rattler_build import Stage0Recipe, VariantConfig
with open(sys.argv[1]) as recipe:
    [found] = Stage0Recipe.from_yaml(recipe.read()).render(VariantConfig({'c_stdlib': ['sysroot']}))
package = found.recipe.package
assert str(package.version) == sys.argv[2], f'the recipe is of version {package.version}'
";
/// The recipe, and its checksum, which is known when the source distribution is made.
const RECIPE: &str = "crates/python/recipe.yaml";
const NO_CHECKSUM: &str = "0000000000000000000000000000000000000000000000000000000000000000";

/// Checks that all metadata are valid and agree.
pub fn check() -> Result<(), String> {
    let citation = here("CITATION.cff").display().to_string();
    cffconvert(&["--validate", "-i", &citation])?;
    let converted = cffconvert(&["-f", "zenodo", "-i", &citation])?;
    let parse = |text: &str| serde_json::from_str(text).map_err(|e| e.to_string());
    agree(&parse(&converted)?, &parse(&read(&here(".zenodo.json"))?)?)?;
    if !read(&here("CHANGELOG.md"))?
        .lines()
        .any(|line| line.starts_with("## ") && line.contains(VERSION))
    {
        return Err(format!("CHANGELOG.md has no section of version {VERSION}"));
    }
    render(&here(RECIPE))
}

/// Compares `.zenodo.json` with what the citation becomes there.
fn agree(citation: &Value, stored: &Value) -> Result<(), String> {
    for key in ["title", "description", "creators", "keywords"] {
        if citation[key] != stored[key] {
            return Err(format!(
                "{key} is {} in CITATION.cff, and {} in .zenodo.json",
                citation[key], stored[key]
            ));
        }
    }
    if citation["version"] != VERSION {
        let found = &citation["version"];
        return Err(format!(
            "CITATION.cff is of version {found}, the crates of {VERSION}"
        ));
    }
    // Zenodo takes one.
    let licences = citation["license"]["id"].as_array();
    if !licences.is_some_and(|all| all.contains(&stored["license"])) {
        let (found, all) = (&stored["license"], &citation["license"]["id"]);
        return Err(format!(
            "the license of .zenodo.json is {found}: take one of {all}"
        ));
    }
    Ok(())
}

/// Writes the recipe of a source distribution: with its checksum.
pub fn recipe_of(source: &Path, to: &Path) -> Result<(), String> {
    let recipe = read(&here(RECIPE))?;
    let printed = printed(Command::new("sha256sum").arg(source))?;
    let checksum = printed.split(' ').next().unwrap_or_default();
    fs::write(to, recipe.replace(NO_CHECKSUM, checksum)).map_err(|e| at(to, &e))?;
    render(to)
}

fn render(recipe: &Path) -> Result<(), String> {
    succeed(
        Command::new("python3")
            .args(["-c", RENDER])
            .arg(recipe)
            .arg(VERSION)
            .env(
                "PYTHONPATH",
                python::package("py-rattler-build", RATTLER_BUILD)?,
            ),
    )
}

fn cffconvert(args: &[&str]) -> Result<String, String> {
    let folder = python::package("cffconvert", CFFCONVERT)?;
    printed(
        Command::new("python3")
            .arg(folder.join("bin/cffconvert"))
            .args(args)
            .env("PYTHONPATH", &folder),
    )
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn metadata_that_disagree_are_refused() {
        let citation = |version: &str| json!({ "title": "a", "version": version, "license": { "id": ["MIT", "0BSD"] } });
        let stored = |title: &str, license: &str| json!({ "title": title, "license": license });
        assert_eq!(agree(&citation(VERSION), &stored("a", "0BSD")), Ok(()));
        for (citation, stored, word) in [
            (citation(VERSION), stored("b", "MIT"), "title"),
            (citation("0.0.9"), stored("a", "MIT"), "0.0.9"),
            (citation(VERSION), stored("a", "MIT OR 0BSD"), "MIT OR 0BSD"),
        ] {
            let error = agree(&citation, &stored).expect_err("refused");
            assert!(error.contains(word), "{error}");
        }
    }

    #[test]
    fn the_recipe_has_room_for_a_checksum() {
        let recipe = fs::read_to_string(here(RECIPE)).expect("a recipe");
        assert_eq!(recipe.matches(NO_CHECKSUM).count(), 1);
    }
}
