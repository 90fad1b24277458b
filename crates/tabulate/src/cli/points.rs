//! Points as CSV: `a_over_t,e1_over_e2,nu1,e0_over_e2[,nu0]` in any order.

use std::path::Path;

use anyhow::{Context, bail, ensure};
use interp::{Material, Quantity};

/// One point to solve or look up.
#[derive(Clone, Copy)]
pub struct Point {
    /// The line of the file that it stands in.
    pub line: u64,
    pub a_over_t: f64,
    pub material: Material,
}

/// The columns, of which the last may be missing.
const COLUMNS: [&str; 5] = ["a_over_t", "e1_over_e2", "nu1", "e0_over_e2", "nu0"];

/// Reads all points, or names the file, the line and what is wrong with it. `nu0` stands in where there is no such column.
pub fn read(path: &Path, nu0: f64) -> anyhow::Result<Vec<Point>> {
    let file = || path.display().to_string();
    let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).comment(Some(b'#')).from_path(path).with_context(file)?;
    let headers = reader.headers().with_context(file)?.clone();
    let columns = columns(&headers).with_context(file)?;
    let mut points = Vec::new();
    for record in reader.records() {
        let record = record.with_context(file)?;
        let line = record.position().map_or(0, csv::Position::line);
        let point = point(&record, columns, line, nu0).with_context(|| place(path, line))?;
        points.push(point);
    }
    ensure!(!points.is_empty(), "{} holds no points", path.display());
    Ok(points)
}

/// Where each of [`COLUMNS`] is in the file.
fn columns(headers: &csv::StringRecord) -> anyhow::Result<[Option<usize>; 5]> {
    let known = |name: &&str| !COLUMNS.contains(name);
    if let Some(name) = headers.iter().find(known) {
        bail!("the header has an unknown column {name:?}; the columns are {}", COLUMNS.join(", "));
    }
    let mut columns = [None; 5];
    for (column, name) in columns.iter_mut().zip(COLUMNS) {
        let mut places = headers.iter().enumerate().filter(|(_, header)| *header == name).map(|(i, _)| i);
        *column = places.next();
        ensure!(column.is_some() || name == "nu0" || headers.is_empty(), "the header has no column {name}");
        ensure!(places.next().is_none(), "the header has the column {name} twice");
    }
    Ok(columns)
}

fn point(record: &csv::StringRecord, columns: [Option<usize>; 5], line: u64, nu0: f64) -> anyhow::Result<Point> {
    let mut values = [0.0, 0.0, 0.0, 0.0, nu0];
    for ((value, column), name) in values.iter_mut().zip(columns).zip(COLUMNS) {
        let Some(field) = column.and_then(|column| record.get(column)) else { continue };
        *value = field.parse().with_context(|| format!("{name} = {field:?}"))?;
    }
    let [a_over_t, e1_over_e2, nu1, e0_over_e2, nu0] = values;
    Ok(Point { line, a_over_t, material: Material::new(e1_over_e2, nu1, e0_over_e2, nu0)? })
}

/// Where a point stands, for an error.
pub fn place(path: &Path, line: u64) -> String {
    format!("{}, line {line}", path.display())
}

/// The points with their values and error, as CSV; an empty field where a value is missing.
pub fn format(points: &[Point], results: &[([Option<f64>; 4], f64)]) -> anyhow::Result<Vec<u8>> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    let names = Quantity::ALL.map(Quantity::name);
    writer.write_record(COLUMNS.iter().chain(&names).chain(&["error"]))?;
    for (Point { a_over_t, material, .. }, (values, error)) in points.iter().zip(results) {
        let parameters = [*a_over_t, material.e1_over_e2(), material.nu1(), material.e0_over_e2(), material.nu0()];
        let values = values.iter().map(|value| value.map(number).unwrap_or_default());
        writer.write_record(parameters.into_iter().map(number).chain(values).chain([number(*error)]))?;
    }
    Ok(writer.into_inner()?)
}

/// The shortest decimal that reads back to the same f64.
pub fn number(value: f64) -> String {
    format!("{value:?}")
}
