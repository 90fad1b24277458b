//! Nanoseconds against error of one lookup, of every form of it.

use super::axis::Axis;
use super::chart::{BLUE, Colour, Figure, GREEN, Marker, Panel, Side, VERMILION};
use crate::cost::lookup::{FURTHER, Family, NEW, Row};

/// Draws it: what holds over the whole box of the table, and the series for layers where they apply.
pub fn figure(rows: &[Row]) -> Figure {
    let drawn = |at: &str| {
        let mut rows = rows.iter().filter(|row| row.at == at).peekable();
        // Of the scopes of the layers, the first has the thickest.
        let scope = rows.peek().map_or("", |row| row.scope.as_str());
        rows.filter(move |row| row.scope == scope && is_drawn(row)).collect::<Vec<_>>()
    };
    let [in_box, of_layers] = ["contact radius", "penetration"].map(drawn);
    let all = || in_box.iter().chain(&of_layers);
    let range = Axis::decades("", all().flat_map(|row| [row.median_error, row.max_error])).range();
    let errors = |label: &str| Axis::logarithmic(label, range);
    let left = Panel::new(
        "any contact in the table's box",
        times(&in_box, 30.0),
        errors("relative error of the load: disc median, circle largest"),
    );
    let right = Panel::new("a layer between rigid bodies, a/t < 1", times(&of_layers, 30.0), errors("")).share(0.55);
    Figure::new(600, [panel(left, &in_box), panel(right, &of_layers)])
}

/// Of the ways to use a table that cost the same, one.
fn is_drawn(row: &Row) -> bool {
    row.what == NEW || row.what == FURTHER && row.form != "dense table"
}

fn nanoseconds(row: &Row) -> f64 {
    1e9 * row.seconds
}

/// From a little before the first to so much after the last, for labels.
fn times(rows: &[&Row], room: f64) -> Axis {
    let times = || rows.iter().map(|row| nanoseconds(row));
    Axis::logarithmic("time (ns)", [0.4 * times().fold(f64::INFINITY, f64::min), room * times().fold(0.0, f64::max)])
}

/// A disc at the median error of each form, and a line to a circle at the largest: beside each other where they would lie on each
/// other.
fn panel(mut panel: Panel, rows: &[&Row]) -> Panel {
    /// The ratio of times at which they no longer do.
    const APART: f64 = 1.25;
    let mut rows = rows.to_vec();
    rows.sort_by(|a, b| a.seconds.total_cmp(&b.seconds));
    let mut before: Vec<(f64, &Row)> = Vec::new();
    for row in rows {
        let meets = |other: &Row| other.median_error <= row.max_error && other.max_error >= row.median_error;
        let beside = before.iter().filter(|(_, other)| meets(other)).map(|(time, _)| APART * time);
        let time = beside.fold(nanoseconds(row), f64::max);
        before.push((time, row));
        let colour = colour(row.family);
        let [median, largest] = [[time, row.median_error], [time, row.max_error]];
        panel.line([median, largest], colour);
        panel.markers([median], colour, Marker::Full).markers([largest], colour, Marker::Hollow);
        let (text, side) = label(row);
        panel.label(if side == Side::Above { largest } else { median }, text, colour, side);
    }
    panel
}

/// What a form is called, and where; above is above the circle, all else beside the disc.
fn label(row: &Row) -> (String, Side) {
    match (row.form.as_str(), row.what.as_str()) {
        ("packed table", FURTHER) => ("table, further point".to_owned(), Side::BelowRight),
        ("packed table", _) => ("packed table, new material".to_owned(), Side::Below),
        ("dense table", _) => ("dense table, new material".to_owned(), Side::Above),
        (form, _) => {
            let name = form.split(',').next().unwrap_or_default();
            let above = name.starts_with("bulk") || name.starts_with("Gao") || name.starts_with("cubic");
            (name.to_owned(), if above { Side::Above } else { Side::Right })
        }
    }
}

fn colour(family: Family) -> Colour {
    match family {
        Family::Table => BLUE,
        Family::Solve => GREEN,
        Family::ClosedForm => VERMILION,
    }
}
