//! The cost of a table: its certificate (the largest error at sampled points) against the time of
//! making it, and the time of many evaluations with a table and without.

use super::paper::spaced;
use cost::numbers::{human_bytes, human_count};
use cost::table::Row;
use figures::axis::{Axis, power_of_ten};
use figures::chart::{BLUE, Colour, Figure, GREEN, Marker, Panel, Side, VERMILION};

/// Draws the making of tables on the left and the evaluation on the right.
pub fn figure(rows: &[Row]) -> Figure {
    Figure::new(440, [making(rows), evaluating(rows)])
}

/// Draws the certified error against time, with the size of the file: discs for the table in HDF5,
/// circles for its packed form.
fn making(rows: &[Row]) -> Panel {
    let threads = rows.first().map_or(0, |row| row.threads);
    let x = Axis::decades(
        format!("time on {threads} threads (s)"),
        rows.iter().flat_map(|row| [row.seconds, packed(row)[0]]),
    );
    let errors = rows
        .iter()
        .flat_map(|row| [row.dense_error, row.packed_error])
        // With room for the labels of the largest error.
        .flat_map(|error| [error, 3.0 * error]);
    let mut panel = Panel::new(
        "Making a table",
        x,
        Axis::decades("certified relative error", errors),
    )
    .margin(48);
    let dense: Vec<_> = rows
        .iter()
        .map(|row| [row.seconds, row.dense_error])
        .collect();
    panel
        .line(dense.clone(), BLUE)
        .markers(dense, BLUE, Marker::Full);
    panel
        .line(rows.iter().map(packed).collect::<Vec<_>>(), VERMILION)
        .markers(rows.iter().map(packed), VERMILION, Marker::Hollow);
    for (i, row) in rows.iter().enumerate() {
        let [dense, small] = if i == 0 {
            ["HDF5, ", "packed, "]
        } else {
            [""; 2]
        };
        panel.label(
            [row.seconds, row.dense_error],
            dense.to_owned() + &human_bytes(row.dense_bytes),
            BLUE,
            Side::BelowLeft,
        );
        panel.label(
            packed(row),
            small.to_owned() + &human_bytes(row.packed_bytes),
            VERMILION,
            Side::AboveRight,
        );
    }
    panel
}

/// Returns the time at which the packed table is finished, and its certified error.
fn packed(row: &Row) -> [f64; 2] {
    [row.seconds + row.pack_seconds, row.packed_error]
}

/// Draws processor time against the number of evaluations, for three tolerances: solid with a
/// table, for evaluations along curves that exist, dashed by direct solves.
fn evaluating(rows: &[Row]) -> Panel {
    let last = rows.len().saturating_sub(1);
    let mut drawn = vec![last, last / 2, 0];
    drawn.dedup();
    let drawn: Vec<(&Row, Colour)> = drawn
        .into_iter()
        .filter_map(|i| rows.get(i))
        .zip([VERMILION, GREEN, BLUE])
        .collect();
    let ends = drawn
        .iter()
        .flat_map(|(row, _)| [0.03, 30.0].map(|factor| factor * row.break_even_along));
    let x = Axis::decades("number of evaluations", ends);
    let [few, many] = x.range();
    let times = drawn
        .iter()
        .flat_map(|(row, _)| [few, many].map(|count| count * row.solve_seconds));
    let mut panel = Panel::new(
        "Time of evaluations; dots: break-even",
        x,
        Axis::decades("processor time (s)", times),
    );
    let solves = |row: &Row, count: f64| [count, count * row.solve_seconds];
    for (row, colour) in &drawn {
        let table = |count: f64| [count, row.making() + count * row.point_seconds];
        let line: Vec<_> = spaced([few, many], 61).map(table).collect();
        panel
            .line(line, *colour)
            .dashed([few, many].map(|count| solves(row, count)), *colour);
        panel.label_along(
            spaced([few, many], 13).map(table).collect::<Vec<_>>(),
            format!("table to {}", tolerance(row)),
            *colour,
            Side::Above,
        );
        if row.break_even_along.is_finite() {
            let even = solves(row, row.break_even_along);
            panel.markers([even], *colour, Marker::Full).label(
                even,
                human_count(even[0]),
                *colour,
                Side::AboveLeft,
            );
        }
    }
    for (end, side) in [
        (drawn.first(), Side::AboveLeft),
        (drawn.last(), Side::BelowRight),
    ] {
        if let Some((row, colour)) = end {
            let line = spaced([few, many], 13).map(|count| solves(row, count));
            panel.label_along(
                line.collect::<Vec<_>>(),
                format!("solves to {}", tolerance(row)),
                *colour,
                side,
            );
        }
    }
    panel
}

/// Returns the tolerance of a row as a power of ten.
fn tolerance(row: &Row) -> String {
    power_of_ten(row.tolerance.log10().round() as i32)
}
