//! Reading measurements: the tables that instruments write, hostile ones, and large ones.

#![forbid(unsafe_code)]

mod afm;
mod errors;
mod habits;
mod instruments;
mod large;
mod properties;
mod tables;

use fit::data::{DataError, Format, Reading, read_from};
use fit::{Direction, Point};

/// Reads a text.
fn read(text: &str, format: &Format) -> Result<Reading, DataError> {
    read_from(text.as_bytes(), "file", format)
}

/// Reads a text that is sound.
fn sound(text: &str, format: &Format) -> Reading {
    read(text, format).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

/// Returns the cells of a table as text: one row a line, its cells parted by ` | `, with `\n` and `\t` as
/// they are written in a string. It is an error if a line has another number of cells, or there is none.
fn rows<const N: usize>(table: &str) -> Vec<[String; N]> {
    let lines = table.lines().filter(|line| !line.trim().is_empty());
    let cell = |cell: &str| cell.trim().replace("\\n", "\n").replace("\\t", "\t");
    let row = |line: &str| {
        let cells: Vec<String> = line.split(" | ").map(cell).collect();
        <[String; N]>::try_from(cells).unwrap_or_else(|_| panic!("not {N} cells: {line}"))
    };
    let rows: Vec<_> = lines.map(row).collect();
    assert!(!rows.is_empty(), "a table without rows");
    rows
}

/// Returns abscissae and ordinates.
fn values(reading: &Reading) -> Vec<[f64; 2]> {
    let points = &reading.measurement.points;
    points
        .iter()
        .map(|point| [point.abscissa, point.ordinate])
        .collect()
}

/// Returns a letter for the direction of each point: `a` of approach, `r` of retract, `-` of none.
fn directions(reading: &Reading) -> String {
    let letter = |point: &Point| match point.direction {
        Some(Direction::Approach) => 'a',
        Some(Direction::Retract) => 'r',
        None => '-',
    };
    reading.measurement.points.iter().map(letter).collect()
}

/// Asserts that two lists of points are equal up to the rounding of a product.
fn assert_values(found: &[[f64; 2]], expected: &[[f64; 2]]) {
    let near = |a: &f64, b: &f64| (a - b).abs() <= 2.0 * f64::EPSILON * b.abs();
    assert!(
        found.len() == expected.len()
            && found
                .iter()
                .flatten()
                .zip(expected.iter().flatten())
                .all(|(a, b)| near(a, b)),
        "{found:?}, not {expected:?}"
    );
}
