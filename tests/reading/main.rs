//! Reading measurements: the tables that instruments write, hostile ones, and large ones.

#![forbid(unsafe_code)]

mod afm;
mod errors;
mod habits;
mod instruments;
mod large;
mod properties;
mod tables;

use fit::data::{Cantilever, DataError, Format, Reading, read_from};
use fit::{Direction, Kind, Point};

/// Reads a text.
fn read(text: &str, format: &Format) -> Result<Reading, DataError> {
    read_from(text.as_bytes(), "file", format)
}

/// Reads a text that is sound.
fn sound(text: &str, format: &Format) -> Reading {
    read(text, format).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

/// Returns the cells of a table, of which [`acceptance::rows`] tells the form, with `\n`, `\r` and `\t` as they are
/// written in a string.
fn rows<const N: usize>(table: &str) -> Vec<[String; N]> {
    const ESCAPES: [(&str, &str); 3] = [("\\n", "\n"), ("\\r", "\r"), ("\\t", "\t")];
    let cell = |cell: &str| {
        let replaced = |text: String, (escape, byte)| text.replace(escape, byte);
        ESCAPES.into_iter().fold(cell.to_owned(), replaced)
    };
    let rows = acceptance::rows::<N>(table).into_iter();
    rows.map(|row| row.map(cell)).collect()
}

/// Returns abscissae and ordinates.
fn values(reading: &Reading) -> Vec<[f64; 2]> {
    let points = &reading.measurement.points;
    points
        .iter()
        .map(|point| [point.abscissa, point.ordinate])
        .collect()
}

/// Returns a format that names columns.
fn named(columns: &[&str]) -> Format {
    let columns = columns.iter().map(|text| text.parse().expect("a column"));
    Format {
        columns: columns.collect(),
        ..Format::default()
    }
}

/// Returns a format with the cantilever.
fn with(stiffness: f64, sensitivity: Option<f64>) -> Format {
    Format {
        cantilever: Cantilever {
            stiffness: Some(stiffness),
            sensitivity,
        },
        ..Format::default()
    }
}

/// Returns a format with the kind.
fn of_kind(kind: Kind) -> Format {
    Format {
        kind: Some(kind),
        ..Format::default()
    }
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
    let mut pairs = found.iter().flatten().zip(expected.iter().flatten());
    let are_near = pairs.all(|(a, b)| near(a, b));
    let are_equal = found.len() == expected.len() && are_near;
    assert!(are_equal, "{found:?}, not {expected:?}");
}
