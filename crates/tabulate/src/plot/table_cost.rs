//! What a table costs: its certified error against the time of making it, and the time of many
//! evaluations with it and without.

use super::axis::{Axis, power_of_ten};
use super::chart::{BLUE, Colour, Figure, GREEN, Marker, Panel, Side, VERMILION};
use crate::cost::numbers::{human_bytes, human_count};
use crate::cost::table::Row;

/// Draws it.
pub fn figure(rows: &[Row]) -> Figure {
    Figure::new(440, [making(rows), evaluating(rows)])
}

/// Certified error against time, with bytes: discs for the table, circles for its packed form.
fn making(rows: &[Row]) -> Panel {
    let threads = rows.first().map_or(0, |row| row.threads);
    let x = Axis::decades(
        format!("time on {threads} threads (s)"),
        rows.iter().flat_map(|row| [row.seconds, packed(row)[0]]),
    );
    let errors = rows
        .iter()
        .flat_map(|row| [row.dense_error, row.packed_error]);
    let mut panel = Panel::new(
        "Making a table",
        x,
        Axis::decades("certified relative error", errors),
    );
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

/// When the packed table is there, and its error.
fn packed(row: &Row) -> [f64; 2] {
    [row.seconds + row.pack_seconds, row.packed_error]
}

/// Processor time against the number of evaluations, for three tolerances: solid with a table,
/// whose materials have been looked up, dashed by direct solves.
fn evaluating(rows: &[Row]) -> Panel {
    let last = rows.len().saturating_sub(1);
    let mut drawn = vec![last, last / 2, 0];
    drawn.dedup();
    let drawn: Vec<(&Row, Colour)> = drawn
        .into_iter()
        .filter_map(|i| rows.get(i))
        .zip([VERMILION, GREEN, BLUE])
        .collect();
    let counts = drawn
        .iter()
        .flat_map(|(row, _)| [0.03, 30.0].map(|factor| factor * row.break_even_along));
    let x = Axis::decades("evaluations", counts);
    let [few, many] = x.range();
    let times = drawn
        .iter()
        .flat_map(|(row, _)| [few, many].map(|count| count * row.solve_seconds));
    let mut panel = Panel::new(
        "Break-even: the dots",
        x,
        Axis::decades("processor time (s)", times),
    );
    let solves = |row: &Row, count: f64| [count, count * row.solve_seconds];
    for (row, colour) in &drawn {
        const POINTS: i32 = 60;
        let table = |count: f64| [count, row.making() + count * row.point_seconds];
        let counts =
            (0..=POINTS).map(|i| few * (many / few).powf(f64::from(i) / f64::from(POINTS)));
        panel
            .line(counts.map(table).collect::<Vec<_>>(), *colour)
            .dashed([few, many].map(|count| solves(row, count)), *colour);
        panel.label(
            table(many),
            format!("table to {}", tolerance(row)),
            *colour,
            Side::BelowLeft,
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
    if let (Some((tightest, above)), Some((loosest, below))) = (drawn.first(), drawn.last()) {
        panel.label(
            solves(tightest, 0.1 * many),
            format!("solves to {}", tolerance(tightest)),
            *above,
            Side::AboveLeft,
        );
        panel.label(
            solves(loosest, 0.3 * many),
            format!("to {}", tolerance(loosest)),
            *below,
            Side::BelowRight,
        );
    }
    panel
}

fn tolerance(row: &Row) -> String {
    power_of_ten(row.tolerance.log10().round() as i32)
}
