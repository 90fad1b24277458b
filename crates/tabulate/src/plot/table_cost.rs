//! What a table costs: its certified error against the time of making it, and the time of many evaluations with it and without.

use super::axis::{Axis, power_of_ten};
use super::chart::{BLUE, Colour, Figure, GREEN, GREY, Marker, Panel, Side, VERMILION};
use crate::cost::table::{Row, human_bytes, human_count};

/// Draws it.
pub fn figure(rows: &[Row]) -> Figure {
    Figure::new(440, [making(rows), evaluating(rows)])
}

/// Certified error against time, with bytes: discs for the table, circles for its packed form.
fn making(rows: &[Row]) -> Panel {
    let threads = rows.first().map_or(0, |row| row.threads);
    let x = Axis::decades(format!("time on {threads} threads (s)"), rows.iter().flat_map(|row| [row.seconds, packed(row)[0]]));
    let errors = rows.iter().flat_map(|row| [row.dense_error, row.packed_error]);
    let mut panel = Panel::new("Making a table", x, Axis::decades("certified relative error", errors));
    let dense: Vec<_> = rows.iter().map(|row| [row.seconds, row.dense_error]).collect();
    panel.line(dense.clone(), BLUE).markers(dense, BLUE, Marker::Full);
    panel.line(rows.iter().map(packed).collect::<Vec<_>>(), VERMILION).markers(rows.iter().map(packed), VERMILION, Marker::Hollow);
    for row in rows {
        panel.label([row.seconds, row.dense_error], human_bytes(row.dense_bytes), BLUE, Side::BelowLeft);
        panel.label(packed(row), human_bytes(row.packed_bytes), VERMILION, Side::AboveRight);
    }
    panel
}

/// When the packed table is there, and its error.
fn packed(row: &Row) -> [f64; 2] {
    [row.seconds + row.pack_seconds, row.packed_error]
}

/// Processor time against the number of evaluations, for three tolerances: by direct solves, and by a table.
fn evaluating(rows: &[Row]) -> Panel {
    let last = rows.len().saturating_sub(1);
    let mut drawn = vec![last, last / 2, 0];
    drawn.dedup();
    let drawn = || drawn.iter().filter_map(|&i| rows.get(i)).zip([VERMILION, GREEN, BLUE]);
    let counts = drawn().flat_map(|(row, _)| [0.03 * row.break_even_along, 30.0 * row.break_even_along]);
    let x = Axis::decades("evaluations", counts);
    let [few, many] = x.range();
    let times = drawn().flat_map(|(row, _)| [few * row.solve_seconds, many * row.solve_seconds]);
    let mut panel = Panel::new("Evaluating it, or solving directly", x, Axis::decades("processor time (s)", times));
    for (row, colour) in drawn() {
        evaluated(&mut panel, row, colour, [few, many]);
    }
    panel
}

/// One tolerance: a dashed line of direct solves, one of the table, and where they meet.
fn evaluated(panel: &mut Panel, row: &Row, colour: Colour, [few, many]: [f64; 2]) {
    const POINTS: i32 = 60;
    let table = |count: f64| row.making() + count * row.point_seconds;
    let line = (0..=POINTS).map(|i| few * (many / few).powf(f64::from(i) / f64::from(POINTS))).map(|count| [count, table(count)]);
    panel.line(line.collect::<Vec<_>>(), colour);
    panel.dashed([few, many].map(|count| [count, count * row.solve_seconds]), colour);
    let tolerance = power_of_ten(row.tolerance.log10().round() as i32);
    panel.label([few, table(few)], format!("table to {tolerance}"), colour, Side::AboveRight);
    let even = row.break_even_along;
    if even.is_finite() {
        panel.markers([[even, even * row.solve_seconds]], colour, Marker::Full);
        panel.label([even, even * row.solve_seconds], human_count(even), colour, Side::BelowRight);
    }
    let alone = row.break_even_alone;
    if alone <= many {
        panel.markers([[alone, alone * row.solve_seconds]], colour, Marker::Hollow);
    }
    panel.label([many, many * row.solve_seconds], "solves", GREY, Side::BelowLeft);
}
