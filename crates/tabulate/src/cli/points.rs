//! Points as CSV: `a_over_t,e1_over_e2,nu1,e0_over_e2[,nu0]` in any order.

use std::path::Path;

use anyhow::{Context, bail, ensure};
use interp::{Material, Quantity};

/// One point to solve or look up.
#[derive(Clone, Copy)]
pub struct Point {
    /// The line of the file.
    pub line: u64,
    pub a_over_t: f64,
    pub material: Material,
}

/// The columns. The last, `nu0`, may be missing.
const COLUMNS: [&str; 5] = ["a_over_t", "e1_over_e2", "nu1", "e0_over_e2", "nu0"];

/// Reads all points. A file without a column `nu0` gets the argument `nu0`. Errors name the file,
/// the line and the value.
pub fn read(path: &Path, nu0: f64) -> anyhow::Result<Vec<Point>> {
    let file = || path.display().to_string();
    let mut reader = csv::ReaderBuilder::new()
        .trim(csv::Trim::All)
        .comment(Some(b'#'))
        .from_path(path)
        .with_context(file)?;
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

/// Returns the position in the file of each of [`COLUMNS`].
fn columns(headers: &csv::StringRecord) -> anyhow::Result<[Option<usize>; 5]> {
    let known = |name: &&str| !COLUMNS.contains(name);
    if let Some(name) = headers.iter().find(known) {
        bail!(
            "the header has an unknown column {name:?}; the columns are {}",
            COLUMNS.join(", ")
        );
    }
    let mut columns = [None; 5];
    for (column, name) in columns.iter_mut().zip(COLUMNS) {
        let mut places = headers
            .iter()
            .enumerate()
            .filter(|(_, header)| *header == name)
            .map(|(i, _)| i);
        *column = places.next();
        ensure!(
            column.is_some() || name == "nu0" || headers.is_empty(),
            "the header has no column {name}"
        );
        ensure!(
            places.next().is_none(),
            "the header has the column {name} twice"
        );
    }
    Ok(columns)
}

fn point(
    record: &csv::StringRecord,
    columns: [Option<usize>; 5],
    line: u64,
    nu0: f64,
) -> anyhow::Result<Point> {
    let mut values = [0.0, 0.0, 0.0, 0.0, nu0];
    for ((value, column), name) in values.iter_mut().zip(columns).zip(COLUMNS) {
        let Some(field) = column.and_then(|column| record.get(column)) else {
            continue;
        };
        *value = field
            .parse()
            .with_context(|| format!("{name} = {field:?}"))?;
    }
    let [a_over_t, e1_over_e2, nu1, e0_over_e2, nu0] = values;
    Ok(Point {
        line,
        a_over_t,
        material: Material::new(e1_over_e2, nu1, e0_over_e2, nu0)?,
    })
}

/// Returns the file and the line of a point, for an error message.
pub fn place(path: &Path, line: u64) -> String {
    format!("{}, line {line}", path.display())
}

/// The numbers that are printed after those of a point.
pub struct Answer {
    /// None for a quantity that is missing.
    pub values: [Option<f64>; 4],
    /// The relative error.
    pub error: f64,
    /// The derivatives of each quantity with respect to the [`COLUMNS`], if they are asked for. One
    /// that is not known is none.
    pub gradient: Option<[[Option<f64>; COLUMNS.len()]; 4]>,
}

/// Formats points and answers as CSV. A missing number is an empty field.
pub fn format(points: &[Point], answers: &[Answer]) -> anyhow::Result<Vec<u8>> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    let names = Quantity::ALL.map(Quantity::name);
    let with_gradient = answers.iter().any(|answer| answer.gradient.is_some());
    let derivatives = names
        .iter()
        .flat_map(|name| COLUMNS.map(|column| format!("d_{name}_d_{column}")));
    let header = COLUMNS
        .iter()
        .chain(&names)
        .chain(&["error"])
        .map(ToString::to_string);
    writer.write_record(header.chain(derivatives.filter(|_| with_gradient)))?;
    for (
        Point {
            a_over_t, material, ..
        },
        answer,
    ) in points.iter().zip(answers)
    {
        let parameters = [
            *a_over_t,
            material.e1_over_e2(),
            material.nu1(),
            material.e0_over_e2(),
            material.nu0(),
        ]
        .map(Some);
        let gradient = answer.gradient.into_iter().flatten().flatten();
        let numbers = parameters
            .into_iter()
            .chain(answer.values)
            .chain([Some(answer.error)])
            .chain(gradient);
        writer.write_record(numbers.map(|value| value.map(number).unwrap_or_default()))?;
    }
    Ok(writer.into_inner()?)
}

/// Returns the shortest decimal that reads back to the same f64.
pub fn number(value: f64) -> String {
    format!("{value:?}")
}

/// Returns value `i` of `count` evenly spaced ones. Between the ends it is rounded to 15 digits, so
/// that steps of 1 um print as such.
pub fn evenly([from, to]: [f64; 2], i: u32, count: u32) -> f64 {
    match i {
        0 => from,
        _ if i == count - 1 => to,
        _ => {
            let value = from + (to - from) * (f64::from(i) / f64::from(count - 1));
            format!("{value:.14e}").parse().unwrap_or(value)
        }
    }
}
