//! Checks of the numbers that a contact is given, and of those that it computes. The crates of
//! contacts share them, so that all of them refuse a value in the same words.

use crate::Error;

/// The largest number of points that a function makes at once.
const MOST_POINTS: usize = 1_000_000;

/// Accepts a positive finite input.
///
/// # Errors
/// [`Error::Unphysical`] for another value.
pub fn positive(name: &'static str, value: f64) -> Result<(), Error> {
    let holds = value > 0.0 && value.is_finite();
    Error::unless(holds, name, value, "> 0 and finite")
}

/// Accepts a finite input.
///
/// # Errors
/// [`Error::Unphysical`] for another value.
pub fn finite_input(name: &'static str, value: f64) -> Result<(), Error> {
    Error::unless(value.is_finite(), name, value, "finite")
}

/// Accepts a work of adhesion.
///
/// # Errors
/// [`Error::Unphysical`] for another value.
#[inline]
pub fn work_of_adhesion(w: f64) -> Result<(), Error> {
    let holds = (0.0..f64::INFINITY).contains(&w);
    Error::unless(holds, "work of adhesion", w, ">= 0 and finite")
}

/// Accepts a number of points, from 2 to 1,000,000.
///
/// # Errors
/// [`Error::InvalidArgument`] for another number.
pub fn number_of_points(points: usize) -> Result<(), Error> {
    let holds = (2..=MOST_POINTS).contains(&points);
    Error::argument(
        holds,
        "number of points",
        points as f64,
        "from 2 to 1000000",
    )
}

/// Returns a result at contact radius `a` unless it is infinite or NaN.
///
/// # Errors
/// [`Error::Unphysical`] for a result that is not finite.
#[inline]
pub fn finite_result(a: f64, result: f64) -> Result<f64, Error> {
    if result.is_finite() {
        return Ok(result);
    }
    Err(Error::Unphysical {
        name: "contact radius",
        value: a,
        allowed: "such that load, penetration and stresses do not overflow an f64",
    })
}
