//! An attraction of short range, as a correction of JKR's contact.

use ::contact::Error;
use ::contact::{CohesiveZone, ShortZone};
use pyo3::prelude::*;

use crate::arrays::{Input, Outputs, Points};
use crate::cohesive::{CohesiveNumbers, numbers};
use crate::contact::{Contact, Imposed, control};
use crate::error::OrRaise as _;

/// Work of adhesion, J/m^2, and stress of the attraction, Pa.
type Attraction = (f64, f64);

/// Corrects a contact.
fn corrected(contact: &Contact, (w, stress): Attraction) -> Result<ShortZone<'_>, Error> {
    contact.contact.cohesive_zone(w, CohesiveZone { stress })
}

/// Accepts an attraction, and returns the length of its zone.
#[pyfunction]
pub fn zone_length(
    py: Python<'_>,
    contact: &Bound<'_, Contact>,
    attraction: Attraction,
) -> PyResult<f64> {
    let corrected = corrected(contact.get(), attraction).or_raise(py)?;
    Ok(corrected.zone())
}

/// Returns the states at contact radii.
#[pyfunction]
pub fn zone_states<'py>(
    py: Python<'py>,
    contact: &Bound<'py, Contact>,
    attraction: Attraction,
    points: Points<'py>,
    a: Input<'py>,
) -> Outputs<'py, 4> {
    let corrected = corrected(contact.get(), attraction).or_raise(py)?;
    points.evaluate([&a], |[a]| corrected.state(a).map(numbers))
}

/// Returns the state in which the contact separates.
#[pyfunction]
pub fn zone_pull_off(
    py: Python<'_>,
    contact: &Bound<'_, Contact>,
    attraction: Attraction,
    imposed: Imposed<'_>,
) -> PyResult<CohesiveNumbers> {
    let (contact, control) = (contact.get(), control(imposed)?);
    let found = py.detach(|| corrected(contact, attraction)?.pull_off(control));
    found.map(numbers).or_raise(py)
}

/// Returns all equilibria at one imposed value, each with its stability.
#[pyfunction]
pub fn zone_equilibria(
    py: Python<'_>,
    contact: &Bound<'_, Contact>,
    attraction: Attraction,
    imposed: Imposed<'_>,
    value: f64,
) -> PyResult<Vec<(CohesiveNumbers, bool)>> {
    let (contact, control) = (contact.get(), control(imposed)?);
    let found = py.detach(|| corrected(contact, attraction)?.equilibria(control, value));
    let found = found.or_raise(py)?.into_iter();
    Ok(found.map(|one| (numbers(one.state), one.stable)).collect())
}
