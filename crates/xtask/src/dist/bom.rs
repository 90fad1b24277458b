//! The crates that are compiled into each artefact, with their licences, as CycloneDX.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::Command;

use serde_json::{Value, json};

use super::{C, OLD_LINUX, STATIC, VERSION, at};
use crate::licences::{self, PYTHON};
use crate::{hdf5, python, succeed};

/// The library that checks the list against the schema of the format.
const CYCLONEDX: &str = "cyclonedx-python-lib[json-validation]==11.12.0";
const VALIDATE: &str = "
import sys
from cyclonedx.schema import SchemaVersion
from cyclonedx.validation.json import JsonStrictValidator
with open(sys.argv[1]) as text:
    error = JsonStrictValidator(SchemaVersion.V1_6).validate_str(text.read())
assert error is None, error
";

/// Writes the list into a folder.
pub fn write(folder: &Path) -> Result<(), String> {
    let with_hdf5 = format!("{}/default,{0}/hdf5-static", hdf5::TABULATE);
    let artefacts = [
        ("library", PYTHON, "", OLD_LINUX),
        ("application", hdf5::TABULATE, &with_hdf5, STATIC),
        ("library", C, "", OLD_LINUX),
    ];
    let (mut components, mut dependencies) = (BTreeMap::new(), Vec::new());
    for (kind, package, features, target) in artefacts {
        let crates = licences::tree(package, features, target)?;
        let mut needed = Vec::new();
        for (name, versions) in &crates {
            for (version, licence) in versions {
                let reference = format!("pkg:cargo/{name}@{version}");
                components.insert(
                    reference.clone(),
                    component(&reference, name, version, licence),
                );
                needed.push(reference);
            }
        }
        dependencies.push(json!({ "ref": package, "dependsOn": needed }));
        let own = json!({
            "type": kind, "bom-ref": package, "name": package, "version": VERSION,
            "licenses": [{ "expression": "MIT OR Apache-2.0" }],
        });
        components.insert(package.to_owned(), own);
    }
    let list = json!({
        "bomFormat": "CycloneDX",
        "specVersion": "1.6",
        "version": 1,
        "metadata": { "component": { "type": "application", "name": "coated-contact", "version": VERSION } },
        "components": components.into_values().collect::<Vec<_>>(),
        "dependencies": dependencies,
    });
    let path = folder.join(format!("coated-contact-{VERSION}.cdx.json"));
    fs::write(&path, format!("{list:#}\n")).map_err(|e| at(&path, &e))?;
    succeed(
        Command::new("python3")
            .args(["-c", VALIDATE])
            .arg(&path)
            .env("PYTHONPATH", python::packages(&[CYCLONEDX])?),
    )
}

fn component(reference: &str, name: &str, version: &str, licence: &str) -> Value {
    let licences = if licence.is_empty() {
        // The only one with a licence in a file of its own.
        json!([{ "license": { "name": "the licence of HDF5" } }])
    } else {
        json!([{ "expression": licence.replace('/', " OR ") }])
    };
    json!({
        "type": "library", "bom-ref": reference, "purl": reference, "name": name, "version": version,
        "licenses": licences,
    })
}
