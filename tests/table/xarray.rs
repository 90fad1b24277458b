//! The HDF5 file of a table as netCDF: as xarray reads it by netCDF4 and by h5netcdf, and as the example
//! of `tables/README.md` interpolates it, by `read_xarray.py`.

use std::path::{Path, PathBuf};

use acceptance::{
    BOX, Contacts, TRUTH, larger, output, python, shipped, solved, table, write_hdf5,
};
use interp::{Material, Parameter, Quantity, Table};
use serde_json::{Value, json};

use crate::h5py::{RIGID, hexadecimal};

const SCRIPT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/table/read_xarray.py");

fn readme() -> PathBuf {
    shipped("README.md")
}

/// Returns what Python finds in a file, and by the methods with the example at `points`.
fn read(path: &Path, points: &[(f64, Material)], methods: &[&str]) -> Value {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let places = folder.path().join("points.json");
    let points: Vec<Value> = points
        .iter()
        .map(|(x, material)| {
            json!({
                "a_over_t": x,
                "e1_over_e2": material.e1_over_e2(),
                "nu1": material.nu1(),
                // JSON has no infinity; the example does not need the axes of one node.
                "e0_over_e2": Some(material.e0_over_e2()).filter(|value| value.is_finite()),
            })
        })
        .collect();
    std::fs::write(&places, Value::from(points).to_string()).expect("written");
    let found = output(
        python()
            .arg(SCRIPT)
            .args([path, &readme(), &places])
            .args(methods),
    );
    serde_json::from_slice(&found).expect("JSON")
}

/// Asserts that every reader finds the axes as coordinates and the quantities over them.
fn assert_reads(table: &Table, found: &Value) {
    let all = Parameter::ALL.map(Parameter::name);
    for engine in ["h5netcdf", "netcdf4"] {
        let found = &found[engine];
        assert_eq!(found["title"], table.description().title.as_str());
        let coordinates = Parameter::ALL.map(|parameter| {
            let contents = json!({
                "dimensions": [parameter.name()],
                "bits": hexadecimal(table.axis(parameter)),
                "long_name": parameter.long_name(),
            });
            (parameter.name().to_owned(), contents)
        });
        let coordinates = Value::Object(coordinates.into_iter().collect());
        assert_eq!(found["coordinates"], coordinates, "{engine}");
        let quantities = table.quantities().into_iter().map(|quantity| {
            let contents = json!({
                "dimensions": all,
                "bits": hexadecimal(table.values(quantity).expect("held")),
                "long_name": quantity.long_name(),
            });
            (quantity.name().to_owned(), contents)
        });
        let quantities = Value::Object(quantities.collect());
        assert_eq!(found["quantities"], quantities, "{engine}");
    }
}

/// Returns `count` random points of the box of a table.
fn points(table: &Table, seed: u64, count: usize) -> Vec<(f64, Material)> {
    let mut contacts = Contacts::new(seed);
    (0..count).map(|_| contacts.point_of(table)).collect()
}

/// Returns the largest relative error of what one method found, against the quantities `truth`.
fn worst(found: &Value, truth: &[(Quantity, Vec<f64>)]) -> f64 {
    assert_eq!(found.as_object().expect("quantities").len(), truth.len());
    let mut worst = 0.0;
    for (quantity, truth) in truth {
        let values = found[quantity.name()].as_array().expect("a list");
        assert_eq!(values.len(), truth.len());
        for (value, truth) in values.iter().zip(truth) {
            let value = value.as_f64().expect("a number");
            worst = larger(worst, (value / truth - 1.0).abs());
        }
    }
    worst
}

/// The errors that `tables/README.md` states are those against direct solves.
#[test]
fn xarray_opens_the_papers_table_and_the_example_interpolates_it_to_its_tolerance() {
    let path = shipped("paper.h5");
    let table = Table::open(&path).expect("a sound table");
    let points = points(&table, 101, 300);
    let methods = ["degree 9", "degree 3", "linear"];
    let found = read(&path, &points, &methods);
    assert_reads(&table, &found);

    let solved = points.iter().map(|(x, own)| solved(*x, own, TRUTH));
    let solved: Vec<_> = solved.collect();
    let of = |quantity| solved.iter().map(|four| four.get(quantity)).collect();
    let truth = Quantity::ALL.map(|quantity| (quantity, of(quantity)));
    let [nine, three, linear] = methods.map(|method| worst(&found[method], &truth));
    println!("degree 9: {nine:.1e}, degree 3: {three:.1e}, linear: {linear:.1e}");
    assert!(nine <= table.description().tolerance);
    let text = std::fs::read_to_string(readme()).expect("text");
    let stated = format!(
        "is {nine:.0e}. With `k=3` it is {three:.0e}, and with\n`table.interp`, which is linear in the parameters and values, {linear:.0e}."
    );
    assert!(text.contains(&stated), "not in the README: {stated}");
}

/// The example as a user runs it, at the root of the repository.
#[test]
fn the_example_prints_the_solved_value() {
    let text = std::fs::read_to_string(readme()).expect("text");
    let mut blocks = text.split("```python\n");
    let block = blocks.find(|block| block.contains("make_interp_spline"));
    let example = block.and_then(|block| Some(block.split_once("```")?.0));
    let example = example.expect("the README has the example");
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let printed = output(python().arg("-c").arg(example).current_dir(root));
    let printed = String::from_utf8(printed).expect("text");
    let found: f64 = printed.trim().parse().expect("one number");
    let material = acceptance::material([1.75, 0.5, 1e5, 0.25]);
    let truth = solved(65.0, &material, TRUTH).eeq;
    let error = (found / truth - 1.0).abs();
    println!("eeq = {found}, with an error of {error:.1e}");
    assert!(error <= 1e-9, "{found}, not {truth}");
}

#[test]
fn the_example_interpolates_other_tables_as_the_lookup_does() {
    /// Largest difference, in tolerances of the table. The splines of the lookup are flat at an
    /// incompressible film, and a curve has a tenth of the tolerance of its own.
    const OF_TOLERANCE: f64 = 1.0;
    for scene in [BOX, RIGID] {
        let table = table(scene);
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("table.h5");
        write_hdf5(&table, &path);
        let points = points(&table, 102, 20);
        let found = read(&path, &points, &["degree 9"]);
        assert_reads(&table, &found);

        let looked_up = |quantity| {
            let value =
                |(x, material): &(f64, Material)| table.curve(material)?.quantity(quantity, *x);
            let values: Result<_, _> = points.iter().map(value).collect();
            (quantity, values.expect("in the table"))
        };
        let expected: Vec<_> = table.quantities().into_iter().map(looked_up).collect();
        let difference = worst(&found["degree 9"], &expected) / table.description().tolerance;
        println!("difference: {difference:.1e} tolerances");
        assert!(difference <= OF_TOLERANCE);
    }
}
