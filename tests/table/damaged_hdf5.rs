//! HDF5 files of tables whose parts are mistyped, misshapen, missing, cut off or no text.

use std::fs;

use interp::{Error, Table};
use ndarray::{Array, Dimension, arr1};

use crate::files::{TABLE, altered, assert_same, named, with_table};

/// Replaces a dataset of the file.
fn replace<T: hdf5::H5Type, D: Dimension>(
    file: &hdf5::File,
    name: &str,
    data: &Array<T, D>,
) -> hdf5::Result<()> {
    file.unlink(name)?;
    file.new_dataset_builder()
        .with_data(data)
        .create(name)
        .map(drop)
}

/// Replaces the values of a quantity by one value in an array of some shape.
fn filled<T: hdf5::H5Type + Clone, S: ndarray::ShapeBuilder>(
    file: &hdf5::File,
    shape: S,
    value: T,
) -> hdf5::Result<()> {
    replace(file, "values/pi0", &Array::from_elem(shape, value))
}

/// Replaces an axis.
fn axis<T: hdf5::H5Type, D: Dimension>(file: &hdf5::File, nodes: &Array<T, D>) -> hdf5::Result<()> {
    replace(file, "axes/nu1", nodes)
}

#[test]
fn a_mistyped_misshapen_or_missing_part_is_malformed() {
    type Change = fn(&hdf5::File) -> hdf5::Result<()>;
    const SHAPE: [usize; 4] = [5, 4, 3, 2];
    let changes: [(&str, Change); 19] = [
        ("values of f32", |file| filled(file, SHAPE, 1.0_f32)),
        ("values of i64", |file| filled(file, SHAPE, 1_i64)),
        ("values in another order", |file| {
            filled(file, [4, 5, 3, 2], 1.0_f64)
        }),
        ("values in one dimension", |file| filled(file, 120, 1.0_f64)),
        ("a value that is not positive", |file| {
            filled(file, SHAPE, 0.0_f64)
        }),
        ("a value that is no number", |file| {
            filled(file, SHAPE, f64::NAN)
        }),
        ("no values", |file| {
            let mut names = ["pi0", "gamma", "delta0"].iter();
            names.try_for_each(|name| file.unlink(&format!("values/{name}")))
        }),
        ("no axis", |file| file.unlink("axes/nu1")),
        ("an axis of f32", |file| {
            axis(file, &arr1(&[0.3_f32, 0.4, 0.5]))
        }),
        ("an axis too short", |file| axis(file, &arr1(&[0.3, 0.5]))),
        ("an axis that descends", |file| {
            axis(file, &arr1(&[0.5, 0.4, 0.3]))
        }),
        ("an axis outside physics", |file| {
            axis(file, &arr1(&[0.3, 0.4, 0.6]))
        }),
        ("an axis of two dimensions", |file| {
            axis(file, &ndarray::arr2(&[[0.3], [0.4], [0.5]]))
        }),
        ("no certificate", |file| {
            file.delete_attr("certified_max_error")
        }),
        ("a part of the certificate", |file| {
            file.delete_attr("certified_worst_point")
        }),
        ("a worst point of three numbers", |file| {
            file.delete_attr("certified_worst_point")?;
            let point = file.new_attr::<f64>().shape(3);
            let point = point.create("certified_worst_point")?;
            point.write(&arr1(&[1.0, 1.0, 0.5]))
        }),
        ("a worst quantity that there is not", |file| {
            named(file, "certified_worst_quantity", "pi1")
        }),
        ("a number as f32", |file| {
            file.delete_attr("nu0")?;
            let nu0 = file.new_attr::<f32>().create("nu0")?;
            nu0.write_scalar(&0.25_f32)
        }),
        ("an unknown normalisation", |file| {
            named(file, "normalised_by", "E0*")
        }),
    ];
    let workdir = with_table();
    let mut wrong = Vec::new();
    for (what, change) in changes {
        let path = altered(&workdir, "changed.h5", change);
        let result = Table::open(&path).map_err(Error::without_file);
        if !matches!(result, Err(Error::Malformed(_))) {
            wrong.push(format!("{what}: {:?}", result.map(|table| table.shape())));
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn a_truncated_hdf5_file_is_an_error_and_one_with_trailing_bytes_is_not_changed_by_them() {
    let workdir = with_table();
    let bytes = workdir.read("table.h5");
    let mut complete = 0;
    for length in (0..bytes.len()).step_by(97).chain([bytes.len() - 1]) {
        let path = workdir.write("shorter.h5", &bytes[..length]);
        match Table::open(&path).map_err(Error::without_file) {
            Err(Error::Foreign(_) | Error::Malformed(_)) => {}
            Err(error) => panic!("{length} bytes: {error}"),
            // The last bytes of a file may be unused.
            Ok(table) => {
                assert_same(&table, &TABLE);
                complete += 1;
            }
        }
        fs::remove_file(path).expect("it is there");
    }
    println!("{complete} truncated files are complete");
    // The superblock of HDF5 states the end of the file. Readers ignore the bytes after it.
    let path = workdir.write("longer.h5", [bytes.as_slice(), &[0; 100]].concat());
    assert_same(&Table::open(&path).expect("HDF5 allows it"), &TABLE);
}

#[test]
fn text_that_is_no_utf_8_is_malformed() {
    let workdir = with_table();
    let mut bytes = workdir.read("table.h5");
    let texts: Vec<usize> = (0..bytes.len())
        .filter(|&at| bytes[at..].starts_with(b"E2*\0"))
        .collect();
    assert_eq!(texts.len(), 1);
    bytes[texts[0] + 2] = 0xff;
    let path = workdir.write("changed.h5", &bytes);
    let result = Table::open(&path).map_err(Error::without_file);
    assert!(matches!(result, Err(Error::Malformed(_))), "{result:?}");
}
