//! The HDF5 file of a table, as h5py reads it by `read_table.py`.

use std::path::Path;

use acceptance::{assert_names, bits, output, python, table, write_hdf5};
use interp::{Parameter, SubstratePoissonRatio, Table};
use serde_json::{Value, json};

/// A scene of four axes, with more values than a chunk holds.
const BOX: &str = "
    title      = 'Four axes: µm'
    tolerance  = 1e-1
    a_over_t   = { from = 0.1, to = 10, nodes = 7 }
    e1_over_e2 = { from = 0.3, to = 3, nodes = 6 }
    nu1        = { from = 0.3, to = 0.5, nodes = 30 }
    e0_over_e2 = { from = 10, to = 100, nodes = 40 }
    nu0        = 0.2
";
/// A scene of one axis and two quantities: a rigid sphere, a film, a rigid substrate.
pub const RIGID: &str = "
    title      = 'Rigid sphere and substrate'
    tolerance  = 1e-6
    quantities = ['gamma', 'pi0']
    a_over_t   = { from = 0.1, to = 10 }
    e1_over_e2 = 0
    nu1        = 0.3
    e0_over_e2 = inf
";

const SCRIPT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/table/read_table.py");

/// Returns the contents of a file as h5py reads them.
fn read(path: &Path) -> Value {
    let found = output(python().arg(SCRIPT).arg(path));
    serde_json::from_slice(&found).expect("JSON")
}

pub fn hexadecimal(values: &[f64]) -> Value {
    let bits = bits(values).into_iter();
    bits.map(|word| format!("{word:016x}")).collect()
}

fn double(value: f64) -> Value {
    json!(["float64", format!("{:016x}", value.to_bits())])
}

/// Asserts that h5py reads from the file the whole table and nothing else.
fn assert_reads(table: &Table, normalised_by: &str) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("table.h5");
    write_hdf5(table, &path);
    let mut file = read(&path);
    // What the numbers mean, for a reader who has the file alone.
    let mut explained = |name: &str| -> String {
        let attributes = file["attributes"].as_object_mut().expect("attributes");
        let value = attributes.remove(name).expect("an explanation");
        value[1].as_str().expect("text").to_owned()
    };
    let words = "sphere of radius R; film of thickness t; a is the contact radius; 2 g^2/(pi a Es*) = w; \
                 F = F0 - S |dfp|; nu1 = b/(1 + b)";
    assert_names(&explained("comment"), words);
    let words = "Barthel; J. Phys. D; 40 (2007) 1059";
    assert_names(&explained("references"), words);
    assert_eq!(explained("license"), "MIT OR Apache-2.0");
    let description = table.description();
    let certificate = &description.certificate;
    let text = |value: &str| json!(["text", value]);
    assert_eq!(
        file["attributes"],
        json!({
            "format": text("coated-contact-table"),
            "format_version": ["uint32", 3],
            "checksum": ["uint32", file["crc32"]],
            "title": text(&description.title),
            "scene": text(&description.scene),
            "nu0": match description.nu0 {
                SubstratePoissonRatio::Fixed(nu0) => double(nu0),
                SubstratePoissonRatio::Paired => text("paired"),
            },
            "normalised_by": text(normalised_by),
            "tolerance": double(description.tolerance),
            "created_by": text(&description.created_by),
            "certified_max_error": double(certificate.max_error),
            "certified_median_error": double(certificate.median_error),
            "certified_points": ["uint64", certificate.points],
            "certified_seed": ["uint64", certificate.seed],
            "certified_p999_error": double(certificate.p999_error),
            "certified_worst_quantity": text(certificate.worst_quantity.name()),
            // The first of each list.
            "certified_worst_point": double(certificate.worst_point[0]),
            "certified_identity_errors": double(certificate.identity_errors[0].unwrap_or(f64::NAN)),
        })
    );

    // Every dataset with the values and attributes that it is to have, and with all of its properties but the shape of
    // its chunks.
    let axes = table.axes().into_iter().map(|(parameter, nodes)| {
        let scale = match (nodes.len(), parameter) {
            (1, _) => "fixed",
            (_, Parameter::Nu1) => "-(1 - 2 nu1 + 1e-6)^(1/8)",
            (_, Parameter::E1sOverEinfs) => "ln(e1s_over_einfs + 1e-10)",
            (_, Parameter::E0sOverE2s) => "ln((e0s_over_e2s + 1e-11)/(1 + 1e-11 e0s_over_e2s))",
            _ => "logarithmic",
        };
        let attributes = json!({ "units": text("1"), "long_name": text(parameter.long_name()), "scale": text(scale) });
        let properties = json!({
            "shape": [nodes.len()], "shuffle": false, "compression": null,
            "is_scale": true, "scales": [[]], "labels": [[]],
        });
        (format!("/axes/{}", parameter.name()), hexadecimal(&nodes), attributes, properties)
    });
    let named = |prefix: &str| -> Value {
        let named = |p: Parameter| json!([format!("{prefix}{}", p.name())]);
        table.parameters().map(named).into_iter().collect()
    };
    let values = table.quantities().into_iter().map(|quantity| {
        let attributes = json!({
            "units": text("1"),
            "long_name": text(quantity.long_name()),
            "equation": text(quantity.equation()),
        });
        let properties = json!({
            "shape": table.shape(), "shuffle": true, "compression": "gzip",
            "is_scale": false, "scales": named("/axes/"), "labels": named(""),
        });
        let bits = hexadecimal(table.values(quantity).expect("held"));
        let path = format!("/values/{}", quantity.name());
        (path, bits, attributes, properties)
    });
    let mut links = Vec::new();
    for (path, bits, attributes, mut expected) in axes.chain(values) {
        let (group, name) = path[1..].split_once('/').expect("a group");
        let group = file["groups"][group].as_object_mut().expect("a group");
        let mut found = group.remove(name).unwrap_or_else(|| panic!("no {path}"));
        let properties = found.as_object_mut().expect("properties");
        let chunks = properties.remove("chunks");
        assert!(chunks.is_some_and(|chunks| chunks.is_array()), "{path}");
        assert_eq!(properties.remove("bits"), Some(bits), "{path}");
        for (name, value) in [
            ("dtype", json!("float64")),
            ("fletcher32", json!(true)),
            ("fillvalue", json!("nan")),
            ("attributes", attributes),
        ] {
            expected[name] = value;
        }
        assert_eq!(found, expected, "{path}");
        links.push(path);
    }
    // There is nothing else, and the root has each dataset under its name.
    assert_eq!(file["groups"], json!({ "axes": {}, "values": {} }));
    links.sort();
    assert_eq!(file["links"], json!(links));
    assert_eq!(file["extra"], json!([]));
}

#[test]
fn h5py_reads_a_table_of_four_axes() {
    let table = table(BOX);
    // Several chunks.
    assert!(table.shape().iter().product::<usize>() > 1 << 15);
    assert_reads(&table, "E2*");
}

#[test]
fn h5py_reads_a_table_of_one_axis_and_two_quantities() {
    assert_reads(&table(RIGID), "E1*");
}
