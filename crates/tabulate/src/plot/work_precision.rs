//! Work-precision fronts: the error that one solve achieves against its time, compared with
//! Nyström's method.

use cost::solve::{NYSTROM, PAPER, REFUSED, Row, by_contact, front};
use figures::Error;
use figures::axis::{Axis, power_of_ten};
use figures::chart::{BLACK, BLUE, Figure, Marker, Panel, Point, Side, VERMILION};

/// The contacts that have a panel: name and `a/t`, row by row.
const DRAWN: [[(&str, f64); 2]; 3] = [
    [(PAPER, 1.0), ("stiff film on a soft base", 30.0)],
    [
        (PAPER, 30.0),
        ("nearly incompressible film on a rigid base", 30.0),
    ],
    [
        (PAPER, 100.0),
        ("incompressible film between rigid bodies", 100.0),
    ],
];

/// Draws the fronts: vermilion for Nyström's method, blue for this solver, with discs for
/// Galerkin's method and circles for the Wiener-Hopf method.
///
/// # Errors
/// [`Error`] naming a contact without a row.
pub fn figure(rows: &[Row]) -> Result<Figure, Error> {
    let contact = |name: &str, x: f64| {
        let found = by_contact(rows).find(|rows| rows[0].contact == name && rows[0].a_over_t == x);
        found.ok_or_else(|| Error(format!("there is no row of {name:?} at a_over_t = {x}")))
    };
    let line = |line: [(&str, f64); 2]| {
        let panels = line
            .into_iter()
            .enumerate()
            .map(|(column, (name, x))| Ok(panel(contact(name, x)?, name, x, column == 0)));
        panels.collect::<Result<Vec<_>, Error>>()
    };
    Ok(Figure::grid(
        800,
        DRAWN
            .into_iter()
            .map(line)
            .collect::<Result<Vec<_>, Error>>()?,
    ))
}

/// Draws one contact.
fn panel(rows: &[Row], name: &str, x: f64, leftmost: bool) -> Panel {
    /// In microseconds, with room for labels left of the fastest.
    const TIMES: [f64; 2] = [0.03, 1e6];
    /// From rounding errors, with room for labels below, to 100 %.
    const ERRORS: [f64; 2] = [1e-18, 1.0];
    let errors = Axis::logarithmic(
        if leftmost {
            "relative error achieved"
        } else {
            ""
        },
        ERRORS,
    );
    // The label takes room from the panel.
    let mut panel = Panel::new(name, Axis::logarithmic("time (µs)", TIMES), errors)
        .share(if leftmost { 1.05 } else { 1.0 });
    let point = |row: &Row| -> Point { [1e6 * row.seconds, row.error.unwrap_or(f64::NAN)] };

    if let Some(refused) = rows.iter().find(|row| row.method == REFUSED) {
        let exponent = power_of_ten(refused.tolerance.log10().round() as i32);
        panel.horizontal_guide(
            refused.tolerance,
            format!("refused: {exponent} and less"),
            Side::Left,
        );
    }
    let nystrom = front(rows, |method| method == NYSTROM);
    let points: Vec<Point> = nystrom
        .into_iter()
        .map(point)
        .filter(|[_, error]| *error < ERRORS[1])
        .collect();
    panel
        .line(points.clone(), VERMILION)
        .markers(points.clone(), VERMILION, Marker::Full);
    let from_middle = preferred(points.len() / 2, points);
    panel.label_along(from_middle, "Nyström", VERMILION, Side::AboveRight);

    let own = front(rows, |method| method != NYSTROM);
    panel.line(own.iter().map(|row| point(row)).collect::<Vec<_>>(), BLUE);
    for row in &own {
        panel.markers([point(row)], BLUE, family(row).1);
    }
    let runs: Vec<_> = own.chunk_by(|a, b| family(a) == family(b)).collect();
    for name in ["Galerkin", "Wiener–Hopf"] {
        // Where a method has several runs, its longest one is named.
        let longest = runs
            .iter()
            .enumerate()
            .filter(|(_, run)| family(run[0]).0 == name)
            .max_by_key(|(_, run)| run.len());
        if let Some((i, run)) = longest {
            let (first, side) = if i + 1 == runs.len() {
                (run.len() - 1, Side::BelowLeft)
            } else {
                (0, Side::AboveLeft)
            };
            let points = run.iter().map(|row| point(row)).collect();
            panel.label_along(preferred(first, points), name, BLUE, side);
        }
    }
    panel.label(
        [TIMES[1], ERRORS[1]],
        format!("a/t = {x}"),
        BLACK,
        Side::BelowLeft,
    );
    panel
}

/// Returns the points with number `first` in front.
fn preferred(first: usize, mut points: Vec<Point>) -> Vec<Point> {
    if first < points.len() {
        points.swap(0, first);
    }
    points
}

/// Returns the name of the method of a row, and its marker.
fn family(row: &Row) -> (&str, Marker) {
    match row.method.split(',').next().unwrap_or_default() {
        "Wiener-Hopf" => ("Wiener–Hopf", Marker::Hollow),
        method => (method, Marker::Full),
    }
}
