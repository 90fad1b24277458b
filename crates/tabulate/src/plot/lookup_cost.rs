//! Nanoseconds against error of one lookup, of every form of it.

use super::axis::Axis;
use super::chart::{BLUE, Colour, Figure, GREEN, Marker, Panel, Side, VERMILION};
use crate::cost::lookup::{FURTHER, Family, NEW, Row};

/// Draws it: what holds over the whole box of the table, and the series for thin layers where they apply.
pub fn figure(rows: &[Row]) -> Figure {
    let drawn = |at: &str| {
        let mut rows = rows.iter().filter(|row| row.at == at).peekable();
        // The thickest films among the scopes of the layers come first.
        let scope = rows.peek().map_or("", |row| row.scope.as_str());
        rows.filter(move |row| row.scope == scope && is_drawn(row)).collect::<Vec<_>>()
    };
    let [box_rows, layer_rows] = ["contact radius", "penetration"].map(drawn);
    let errors = Axis::decades(
        "relative error of the load",
        box_rows.iter().chain(&layer_rows).flat_map(|row| [row.median_error, row.max_error]),
    );
    let right = Panel::new("a rigid layer's series", times(&layer_rows), errors.clone()).share(0.45);
    let left = Panel::new("over the whole box of the table", times(&box_rows), errors);
    Figure::new(560, [panel(left, &box_rows), panel(right, &layer_rows)])
}

/// Of the ways to use a table that cost the same, one.
fn is_drawn(row: &Row) -> bool {
    row.what == NEW || row.what == FURTHER && row.form != "dense table"
}

fn nanoseconds(row: &Row) -> f64 {
    1e9 * row.seconds
}

/// Decades, with room for labels beside the last points.
fn times(rows: &[&Row]) -> Axis {
    let axis = Axis::decades("time (ns)", rows.iter().map(|row| nanoseconds(row)));
    let [from, to] = axis.range();
    Axis::logarithmic("time (ns)", [from, 10.0 * to])
}

/// A disc at the median error of each form, and a line up to the largest.
fn panel(mut panel: Panel, rows: &[&Row]) -> Panel {
    for row in rows {
        let (time, colour) = (nanoseconds(row), colour(row.family));
        panel.line([[time, row.median_error], [time, row.max_error]], colour);
        panel.markers([[time, row.median_error]], colour, Marker::Full);
        panel.label([time, row.median_error], label(row), colour, Side::Right);
    }
    panel
}

fn label(row: &Row) -> String {
    let form = row.form.split(',').next().unwrap_or_default();
    match (row.family, row.what.as_str()) {
        (Family::Table, NEW) if form.ends_with("table") => format!("{form}, new material"),
        (Family::Table, FURTHER) if form.ends_with("table") => format!("{form}, further point"),
        _ => form.to_owned(),
    }
}

fn colour(family: Family) -> Colour {
    match family {
        Family::Table => BLUE,
        Family::Solve => GREEN,
        Family::ClosedForm => VERMILION,
    }
}
