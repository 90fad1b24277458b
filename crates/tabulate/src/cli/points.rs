//! Points as CSV: `a_over_t,e1_over_e2,nu1,e0_over_e2[,nu0]` in any order.

use std::path::Path;

use anyhow::{Context, ensure};
use interp::{Material, Quantity};
use serde::Deserialize;

/// One point to solve or look up.
#[derive(Clone, Copy)]
pub struct Point {
    /// The line of the file that it stands in.
    pub line: u64,
    pub a_over_t: f64,
    pub material: Material,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Row {
    a_over_t: f64,
    e1_over_e2: f64,
    nu1: f64,
    e0_over_e2: f64,
    nu0: Option<f64>,
}

/// Reads all points, or names the file, the line and what is wrong with it. `nu0` stands in where there is no such column.
pub fn read(path: &Path, nu0: f64) -> anyhow::Result<Vec<Point>> {
    let mut reader = csv::ReaderBuilder::new()
        .trim(csv::Trim::All)
        .comment(Some(b'#'))
        .from_path(path)
        .with_context(|| path.display().to_string())?;
    let headers = reader.headers().with_context(|| path.display().to_string())?.clone();
    let mut points = Vec::new();
    for record in reader.records() {
        let record = record.with_context(|| path.display().to_string())?;
        let line = record.position().map_or(0, csv::Position::line);
        let place = || place(path, line);
        let row: Row = record.deserialize(Some(&headers)).with_context(place)?;
        let material = Material::new(row.e1_over_e2, row.nu1, row.e0_over_e2, row.nu0.unwrap_or(nu0)).with_context(place)?;
        points.push(Point { line, a_over_t: row.a_over_t, material });
    }
    ensure!(!points.is_empty(), "{} holds no points", path.display());
    Ok(points)
}

/// Where a point stands, for an error.
pub fn place(path: &Path, line: u64) -> String {
    format!("{}, line {line}", path.display())
}

/// The points with their values and error, as CSV; an empty field where a value is missing.
pub fn format(points: &[Point], results: &[([Option<f64>; 4], f64)]) -> anyhow::Result<Vec<u8>> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    let names = Quantity::ALL.map(Quantity::name);
    writer.write_record(["a_over_t", "e1_over_e2", "nu1", "e0_over_e2", "nu0"].iter().chain(&names).chain(&["error"]))?;
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
