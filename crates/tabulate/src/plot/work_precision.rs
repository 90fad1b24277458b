//! Work-precision fronts: the error that one solve achieves against the time it takes, beside Nyström's method.

use super::axis::Axis;
use super::chart::{BLUE, Figure, Marker, Panel, Side, VERMILION};
use crate::cost::solve::{NYSTROM, PAPER, REFUSED, Row, by_contact, front};

/// The contacts that have a panel, by name and `a/t`, row by row.
const DRAWN: [[(&str, f64); 3]; 2] = [
    [(PAPER, 1.0), (PAPER, 30.0), (PAPER, 100.0)],
    [("stiff film on a soft base", 30.0), ("soft film on a rigid base", 30.0), ("incompressible film, rigid bodies", 100.0)],
];

/// Draws it: discs for Galerkin's method, circles for Wiener and Hopf's, in any colour but that of Nyström's method.
pub fn figure(rows: &[Row]) -> Figure {
    let contact = |(name, x): (&str, f64)| by_contact(rows).find(|rows| rows[0].contact == name && rows[0].a_over_t == x);
    let drawn = DRAWN.map(|line| line.map(|drawn| contact(drawn).unwrap_or_default()));
    let times = Axis::decades("time (µs)", drawn.iter().flatten().flat_map(|rows| rows.iter()).map(microseconds));
    let panels = drawn.iter().zip(DRAWN).map(|(line, names)| {
        let line = line.iter().zip(names).enumerate();
        line.map(|(column, (rows, (name, x)))| panel(rows, name, x, &times, column == 0)).collect()
    });
    Figure::grid(620, panels.collect::<Vec<_>>())
}

fn microseconds(row: &Row) -> f64 {
    1e6 * row.seconds
}

/// One contact.
fn panel(rows: &[Row], name: &str, x: f64, times: &Axis, first: bool) -> Panel {
    /// From rounding to errors as large as the quantities.
    const ERRORS: [f64; 2] = [1e-16, 1.0];
    let errors = Axis::logarithmic(if first { "relative error achieved" } else { "" }, ERRORS);
    // The label takes room from the panel.
    let mut panel = Panel::new(name, times.clone(), errors).share(if first { 1.08 } else { 1.0 });
    let point = |row: &Row| [microseconds(row), row.error.unwrap_or(f64::NAN)];

    if let Some(refused) = rows.iter().find(|row| row.method == REFUSED) {
        panel.horizontal_guide(refused.tolerance, "tighter is refused", Side::Right);
    }
    let nystrom = front(rows, |method| method == NYSTROM);
    let points: Vec<_> = nystrom.iter().map(|row| point(row)).collect();
    panel.line(points.clone(), VERMILION).markers(points.clone(), VERMILION, Marker::Full);
    if let Some(middle) = points.get(points.len() / 2) {
        panel.label(*middle, "Nyström", VERMILION, Side::AboveRight);
    }

    let own = front(rows, |method| method != NYSTROM);
    panel.line(own.iter().map(|row| point(row)).collect::<Vec<_>>(), BLUE);
    for run in own.chunk_by(|a, b| family(a) == family(b)) {
        let (method, marker) = family(run[0]);
        panel.markers(run.iter().map(|row| point(row)), BLUE, marker);
        panel.label(point(run[run.len() / 2]), method, BLUE, Side::BelowLeft);
    }
    panel.label([times.range()[1], ERRORS[1]], format!("a/t = {x}"), super::chart::BLACK, Side::BelowLeft);
    panel
}

/// A method, whichever its path, and how it is marked.
fn family(row: &Row) -> (&str, Marker) {
    match row.method.split(',').next().unwrap_or_default() {
        "Wiener-Hopf" => ("Wiener–Hopf", Marker::Hollow),
        method => (method, Marker::Full),
    }
}
