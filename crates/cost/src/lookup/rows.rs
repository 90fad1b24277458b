//! The rows that are measured of lookups.

use interp::Material;
use serde::{Deserialize, Serialize};

use crate::Measurement;

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

impl Measurement for Row {}

/// The number of points that are solved directly at each tolerance, for their times and errors.
/// Times differ by a factor of a thousand, so the mean of fewer would not be reliable.
pub(super) const SOLVED: usize = 200;

/// The task of all forms except those along a curve, see [`Row::what`].
pub const NEW: &str = "one point of a new material";
/// The task of the forms that make a curve first, see [`Row::what`].
pub const FURTHER: &str = "a further point";

/// A contact: `a/t` and material.
pub type Point = (f64, Material);
