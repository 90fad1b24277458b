//! One lookup: nanoseconds against error for every form of it, beside direct solves and the closed
//! forms that people use instead.
//!
//! An error is that of the load at a given contact radius, once without adhesion and once with
//! adhesion that takes half of that load away; of the series for thin layers, that of the load at a
//! given penetration, without adhesion. The truth is the solve at the tightest tolerance that is
//! answered.

mod form;
mod layer;
mod linear;

use interp::Parameter;
use interp::{Material, Table};
use serde::{Deserialize, Serialize};

use super::clock::human;
use crate::Error;
use crate::table::scene;

/// What a form of lookup rests on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Family {
    /// Values at the nodes of a table.
    #[serde(rename = "table")]
    Table,
    /// The equations, solved anew each time.
    #[serde(rename = "direct solve")]
    Solve,
    /// A formula.
    #[serde(rename = "closed form")]
    ClosedForm,
}

/// One thing done with one form of lookup. Errors are relative.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// What the form rests on.
    pub family: Family,
    /// The form's name.
    pub form: String,
    /// What took the time.
    pub what: String,
    /// The time, for one of them.
    pub seconds: f64,
    /// Where the errors were measured.
    pub scope: String,
    /// At how many points.
    pub points: u64,
    /// What is held fixed while the load is compared: `contact radius` or `penetration`.
    pub at: String,
    /// Median error of the load without adhesion.
    pub median_error: f64,
    /// Largest error of the load without adhesion.
    pub max_error: f64,
    /// The largest factor by which the load without adhesion is too large or too small.
    pub max_factor: f64,
    /// Median error of the load where adhesion halves it; none of the forms without adhesion.
    pub adhesive_median_error: Option<f64>,
    /// Largest error of the load where adhesion halves it; none of the forms without adhesion.
    pub adhesive_max_error: Option<f64>,
}

/// How many points the command takes.
pub const POINTS: usize = 1000;

/// How many points are solved directly for times and for their errors, at each tolerance. Their
/// times differ by a factor of a thousand, so that fewer would not do.
const SOLVED: usize = 200;

/// Of each time, what it may take to measure it.
const SECONDS: f64 = 0.05;

/// What all forms do but those along a curve, see [`Row::what`].
pub const NEW: &str = "one point of a new material";
/// What the forms do that make a curve first, see [`Row::what`].
pub const FURTHER: &str = "a further point";

/// A contact: `a/t` and material.
pub type Point = (f64, Material);

/// Measures all rows, in order: the errors of a table's forms at so many random points of its box,
/// which are the same each time.
///
/// A table in low-rank form is measured as it is and expanded, another as it is alone.
///
/// # Errors
/// Those of the solve; [`Error::Table`] without all four quantities.
///
/// # Panics
/// If `points` is 0.
pub fn measure(
    table: &Table,
    points: usize,
    progress: &(dyn Fn(usize) + Sync),
) -> Result<Vec<Row>, Error> {
    let points = random_points(table, points, 1);
    let mut rows = form::measure(table, &points, progress)?;
    rows.extend(layer::measure(points.len(), progress)?);
    Ok(rows)
}

/// How many solves [`measure`] reports.
pub const fn solves(points: usize) -> usize {
    form::solves(points) + layer::solves(points)
}

/// Random points of a table's box, evenly distributed in the coordinates of the axes.
pub fn random_points(table: &Table, count: usize, seed: u64) -> Vec<Point> {
    let nu0 = table.description().nu0;
    let material =
        |e1, nu1, e0| Material::new(e1, nu1, e0, nu0).expect("the table's box is physical");
    let points = scene::random_points(
        Parameter::ALL.map(|parameter| ends(table, parameter)),
        count,
        seed,
    );
    points
        .into_iter()
        .map(|[x, e1, nu1, e0]| (x, material(e1, nu1, e0)))
        .collect()
}

/// The first and the last node of an axis.
fn ends(table: &Table, parameter: Parameter) -> [f64; 2] {
    let nodes = table.axis(parameter);
    [nodes[0], nodes[nodes.len() - 1]]
}

/// The rows in short, as Markdown: a line for each form, with two of its times.
pub fn markdown(rows: &[Row]) -> String {
    let mut text = format!(
        "| form | {NEW} | {FURTHER} | load: median error | largest | with adhesion: median | largest |\n|---|---|---|---|---|---|---|\n"
    );
    let (mut scope, mut points) = ("", 0);
    for group in rows.chunk_by(|a, b| (&a.scope, &a.form) == (&b.scope, &b.form)) {
        let first = &group[0];
        if first.scope != scope {
            (scope, points) = (&first.scope, first.points);
            text += &format!(
                "| *{points} points, {scope}, at a given {}* | | | | | | |\n",
                first.at
            );
        }
        let time = |what| {
            group
                .iter()
                .find(|row| row.what == what)
                .map_or_else(|| "–".to_owned(), |row| human(row.seconds))
        };
        let largest = if first.max_factor >= 2.0 {
            factor(first.max_factor)
        } else {
            percent(first.max_error)
        };
        let adhesive = |error: Option<f64>| match error {
            None => "–".to_owned(),
            Some(error) if error >= 10.0 => factor(1.0 + error),
            Some(error) => percent(error),
        };
        let errors = [
            percent(first.median_error),
            largest,
            adhesive(first.adhesive_median_error),
            adhesive(first.adhesive_max_error),
        ];
        let fewer = if first.points == points {
            String::new()
        } else {
            format!(" ({} points)", first.points)
        };
        text += &format!(
            "| {}{fewer} | {} | {} | {} |\n",
            first.form,
            time(NEW),
            time(FURTHER),
            errors.join(" | ")
        );
    }
    text
}

/// An error with one digit, in percent where that is a number that one says.
fn percent(error: f64) -> String {
    if error < 1e-3 {
        format!("{error:.0e}")
    } else {
        format!("{} %", one_digit(100.0 * error))
    }
}

/// A factor with one digit.
fn factor(factor: f64) -> String {
    format!("× {}", one_digit(factor))
}

/// A number rounded to one digit.
fn one_digit(number: f64) -> f64 {
    format!("{number:.0e}").parse().expect("it was a number")
}
