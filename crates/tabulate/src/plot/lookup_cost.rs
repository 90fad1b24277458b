//! The error of one lookup against its time, for every form of lookup.

use cost::lookup::{FURTHER, Family, NEW, Row};
use figures::Error;
use figures::axis::Axis;
use figures::chart::{BLUE, Colour, Figure, GREEN, Marker, Panel, Side, VERMILION};

/// Draws the forms that hold in the whole box of the table on the left, and the series for bonded
/// layers on the right.
///
/// # Errors
/// [`Error`] if one of the panels has no row.
pub fn figure(rows: &[Row]) -> Result<Figure, Error> {
    let drawn = |at: &str| {
        let mut rows = rows.iter().filter(|row| row.at == at).peekable();
        // The first scope of the layers has the thickest layers.
        let scope = rows.peek().map_or("", |row| row.scope.as_str());
        let drawn: Vec<_> = rows
            .filter(move |row| row.scope == scope && is_drawn(row))
            .collect();
        if drawn.is_empty() {
            Err(Error(format!("there is no row at a given {at}")))
        } else {
            Ok(drawn)
        }
    };
    let (in_box, of_layers) = (drawn("contact radius")?, drawn("penetration")?);
    let all = || in_box.iter().chain(&of_layers);
    let [least, most] =
        Axis::decades("", all().flat_map(|row| [row.median_error, largest(row)])).range();
    let errors = |label: &str| Axis::logarithmic(label, [least, 10.0 * most]);
    let left = Panel::new(
        "any contact in the table's box",
        times(
            "time (ns); marks that would overlap are shifted apart",
            &in_box,
            [0.02, 1000.0],
        ),
        errors("relative error of the load (disc: median, circle: largest)"),
    );
    let right = Panel::new(
        "bonded layer, a/t < 1, ν_{1} = 0.5",
        times("time (ns)", &of_layers, [0.4, 30.0]),
        errors(""),
    )
    .share(0.55);
    Ok(Figure::new(
        600,
        [panel(left, &in_box), panel(right, &of_layers)],
    ))
}

/// Returns the largest error. For the largest underestimate it is the factor by which the load is
/// too small, less one, so that a load near 0 counts by more than 1.
fn largest(row: &Row) -> f64 {
    row.max_error.max(row.max_factor - 1.0)
}

/// True if the figure shows a row. Several uses of a table cost equal times: one of them is shown.
fn is_drawn(row: &Row) -> bool {
    row.what == NEW || row.what == FURTHER && row.form != "dense table"
}

fn nanoseconds(row: &Row) -> f64 {
    1e9 * row.seconds
}

/// Returns an axis of times, from `before` times the shortest to `after` times the longest: the
/// rest is room for labels.
fn times(label: &str, rows: &[&Row], [before, after]: [f64; 2]) -> Axis {
    let times = || rows.iter().map(|row| nanoseconds(row));
    Axis::logarithmic(
        label,
        [
            before * times().fold(f64::INFINITY, f64::min),
            after * times().fold(0.0, f64::max),
        ],
    )
}

/// Draws a disc at the median error of each form, a circle at the largest error, and a line between
/// them. Forms that would overlap are shifted apart in time.
fn panel(mut panel: Panel, rows: &[&Row]) -> Panel {
    /// The least ratio of the times of two forms without overlap.
    const APART: f64 = 1.25;
    let mut before: Vec<(f64, &Row)> = Vec::new();
    for row in rows {
        let meets =
            |other: &Row| other.median_error <= largest(row) && largest(other) >= row.median_error;
        let mut time = nanoseconds(row);
        for (other, _) in before.iter().filter(|(_, other)| meets(other)) {
            if time < APART * other && *other < APART * time {
                time = APART * other;
            }
        }
        before.push((time, row));
        let colour = colour(row.family);
        let ends @ [median, circle] = [[time, row.median_error], [time, largest(row)]];
        panel.line(ends, colour);
        panel
            .markers([median], colour, Marker::Full)
            .markers([circle], colour, Marker::Hollow);
        let (text, end, side) = label(row);
        let middle = [time, (row.median_error * largest(row)).sqrt()];
        let anchors = match end {
            End::Disc => [median, middle, circle],
            End::Circle => [circle, middle, median],
        };
        panel.label_along(anchors, text, colour, side);
    }
    panel
}

/// An end of the line of a form.
#[derive(Clone, Copy, Debug)]
enum End {
    Disc,
    Circle,
}

/// Returns the name of a form, and the preferred end and side for its label.
fn label(row: &Row) -> (&str, End, Side) {
    match (row.form.as_str(), row.what.as_str()) {
        ("packed table", FURTHER) => ("table: further point", End::Disc, Side::BelowRight),
        ("packed table", _) => ("packed: new material", End::Disc, Side::Right),
        ("dense table", _) => ("dense: new material", End::Disc, Side::Right),
        (form, _) => {
            let name = form
                .split(',')
                .next()
                .unwrap_or_default()
                .trim_start_matches("direct ");
            match name.split(' ').next().unwrap_or_default() {
                "bulk" => (name, End::Circle, Side::Above),
                "film" => (name, End::Disc, Side::Left),
                "Gao" | "Hay" | "Garcia" => (name, End::Circle, Side::Right),
                "cubic" | "Hertz" => (name, End::Circle, Side::AboveRight),
                "solve" if form.ends_with("1e-6") => (name, End::Disc, Side::Right),
                "solve" => (name, End::Circle, Side::Right),
                _ => (name, End::Disc, Side::Right),
            }
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
