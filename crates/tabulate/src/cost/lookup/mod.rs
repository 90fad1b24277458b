//! One lookup: time and error of every form of it, beside direct solves and the closed forms in
//! use.
//!
//! An error is that of the load at a given contact radius, once without adhesion and once with
//! adhesion that halves the load. For the series for thin layers, it is that of the load at a given
//! penetration, without adhesion. The true load is that of the solve at the tightest tolerance that
//! is not refused.
//!
//! `form` measures the forms that hold in the whole box of a table (`linear` has two of them),
//! `layer` the series for thin layers. `load` compares loads, `timer` measures times, `summary`
//! prints the rows.

mod form;
mod layer;
mod linear;
mod load;
mod summary;
mod timer;

use interp::{Material, Parameter, Table};
use serde::{Deserialize, Serialize};

pub use self::summary::markdown;
use super::Measured;
use super::clock::Timing;
use crate::Error;
use crate::cost::rows::{COUNT, ERROR, Measurement, TIME};
use crate::table;

/// The basis of a form of lookup.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Family {
    /// Values at the nodes of a table.
    #[serde(rename = "table")]
    Table,
    /// The equations, solved each time.
    #[serde(rename = "direct solve")]
    Solve,
    /// A formula.
    #[serde(rename = "closed form")]
    ClosedForm,
}

/// One task done with one form of lookup. Errors are relative.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// The form's basis.
    pub family: Family,
    /// The form's name.
    pub form: String,
    /// The task, for example [`NEW`].
    pub what: String,
    /// The time of one task (s).
    pub seconds: f64,
    /// The ranges of the parameters in which the errors were measured.
    pub scope: String,
    /// The number of points at which they were measured.
    pub points: u64,
    /// The variable at whose value loads are compared: `contact radius` or `penetration`.
    pub at: String,
    /// Median error of the load without adhesion.
    pub median_error: f64,
    /// Largest error of the load without adhesion.
    pub max_error: f64,
    /// The largest factor by which the load without adhesion is too large or too small.
    pub max_factor: f64,
    /// Median error of the load where adhesion halves it; none for forms without adhesion.
    pub adhesive_median_error: Option<f64>,
    /// Largest error of the load where adhesion halves it; none for forms without adhesion.
    pub adhesive_max_error: Option<f64>,
}

impl Measurement for Row {
    const RANGES: &'static [(&'static str, [f64; 2])] = &[
        ("seconds", TIME),
        ("points", COUNT),
        ("median_error", ERROR),
        ("max_error", ERROR),
        ("max_factor", [1.0, 1e30]),
        ("adhesive_median_error", ERROR),
        ("adhesive_max_error", ERROR),
    ];
}

/// The number of points of the command.
pub const POINTS: usize = 1000;

/// The number of points that are solved directly at each tolerance, for their times and errors.
/// Times differ by a factor of a thousand, so the mean of fewer would not be reliable.
const SOLVED: usize = 200;

/// The task of all forms except those along a curve, see [`Row::what`].
pub const NEW: &str = "one point of a new material";
/// The task of the forms that make a curve first, see [`Row::what`].
pub const FURTHER: &str = "a further point";

/// A contact: `a/t` and material.
pub type Point = (f64, Material);

/// Measures all rows, at `points` random points of the table's box. Every run has the points of
/// seed 1.
///
/// A table in low-rank form is measured in this form and expanded. `progress` is called with the
/// number of contacts that have been solved since the last call.
///
/// # Errors
/// Those of the solve; [`Error::Table`] for a table without all four quantities.
///
/// # Panics
/// If `points` is 0.
pub fn measure(
    table: &Table,
    points: usize,
    timing: Timing,
    progress: &(dyn Fn(usize) + Sync),
) -> Result<Measured<Row>, Error> {
    let points = random_points(table, points, 1);
    let mut measured = form::measure(table, &points, timing, progress)?;
    measured
        .rows
        .extend(layer::measure(points.len(), timing, progress)?);
    Ok(measured)
}

/// Returns the number of solves that [`measure`] reports.
pub const fn solves(points: usize) -> usize {
    form::solves(points) + layer::solves(points)
}

/// Returns `count` random points of a table's box, evenly distributed in the coordinates of the
/// axes.
pub fn random_points(table: &Table, count: usize, seed: u64) -> Vec<Point> {
    let (parameters, nu0) = (table.parameters(), table.description().nu0);
    let ends = parameters.map(|parameter| ends(table, parameter));
    let point = |[x, values @ ..]: [f64; 4]| {
        let material = table::material(parameters, nu0, values);
        (x, material.expect("the table's box is physical"))
    };
    let points = table::random_points(parameters, ends, count, seed);
    points.into_iter().map(point).collect()
}

/// The first and the last node of an axis.
fn ends(table: &Table, parameter: Parameter) -> [f64; 2] {
    let nodes = table.axis(parameter);
    [nodes[0], nodes[nodes.len() - 1]]
}
