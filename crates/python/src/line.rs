//! The contact line under laws other than a constant work of adhesion.
//!
//! A line in Python holds its contact, its law and its state; each call of this module makes it
//! again from these.

use ::contact::Error;
use ::contact::{CrackTip, Hysteresis, RateDependent, State};
use pyo3::prelude::*;

use crate::arrays::{Output, columns};
use crate::contact::{Contact, Imposed, StateNumbers, control, numbers};
use crate::error::OrRaise as _;

/// The energies of an advancing and of a receding line at rest, and the speed and the exponent of a
/// law that depends on the speed.
pub type LawNumbers = (f64, f64, Option<[f64; 2]>);
/// Time, contact radius, load, penetration and energy release rate.
type TimedArrays<'py> = [Output<'py>; 5];

/// Makes a law.
fn law((advancing, receding, rate): LawNumbers) -> Result<Box<dyn CrackTip + Send>, Error> {
    let slow = Hysteresis::new(advancing, receding)?;
    Ok(match rate {
        None => Box::new(slow),
        Some([v0, n]) => Box::new(RateDependent::new(slow, v0, n)?),
    })
}

/// Makes a state.
fn state([contact_radius, load, penetration]: StateNumbers) -> State {
    State {
        contact_radius,
        load,
        penetration,
    }
}

/// Accepts a law.
#[pyfunction]
pub fn check_law(py: Python<'_>, law_numbers: LawNumbers) -> PyResult<()> {
    law(law_numbers).map(drop).or_raise(py)
}

/// Returns the energy release rate of a law at a speed.
#[pyfunction]
pub fn energy_of_speed(
    py: Python<'_>,
    energies: [f64; 2],
    rate: [f64; 2],
    speed: f64,
) -> PyResult<f64> {
    let ([advancing, receding], [v0, n]) = (energies, rate);
    Hysteresis::new(advancing, receding)
        .and_then(|slow| RateDependent::new(slow, v0, n)?.energy_release_rate(speed))
        .or_raise(py)
}

/// Returns the state of a line that has slowly grown to a contact radius.
#[pyfunction]
pub fn line(
    py: Python<'_>,
    contact: &Bound<'_, Contact>,
    law_numbers: LawNumbers,
    a: f64,
) -> PyResult<StateNumbers> {
    let contact = &contact.get().contact;
    let made = || Ok::<_, Error>(contact.line(law(law_numbers)?, a)?.state());
    let state = made().or_raise(py)?;
    Ok(state.map_or([f64::NAN; 3], numbers))
}

/// Returns the state after an imposed value has been reached slowly.
#[pyfunction]
pub fn impose(
    py: Python<'_>,
    contact: &Bound<'_, Contact>,
    law_numbers: LawNumbers,
    from: Option<StateNumbers>,
    imposed: Imposed<'_>,
    value: f64,
) -> PyResult<Option<StateNumbers>> {
    let (contact, control) = (&contact.get().contact, control(imposed)?);
    let moved = py.detach(|| {
        contact
            .line_in(law(law_numbers)?, from.map(state))?
            .impose(control, value)
    });
    moved.map(|state| state.map(numbers)).or_raise(py)
}

/// Returns the states of a ramp, and the state after it.
#[pyfunction]
#[pyo3(signature = (contact, law_numbers, from, imposed, *, value, duration, tolerance))]
#[expect(
    clippy::too_many_arguments,
    reason = "the arguments of a call from Python"
)]
pub fn ramp<'py>(
    py: Python<'py>,
    contact: &Bound<'py, Contact>,
    law_numbers: LawNumbers,
    from: Option<StateNumbers>,
    imposed: Imposed<'_>,
    value: f64,
    duration: f64,
    tolerance: f64,
) -> PyResult<(TimedArrays<'py>, Option<StateNumbers>)> {
    let (contact, control) = (&contact.get().contact, control(imposed)?);
    let moved = py.detach(|| {
        let mut line = contact.line_in(law(law_numbers)?, from.map(state))?;
        let states = line.ramp(control, value, duration, tolerance)?;
        Ok::<_, Error>((states, line.state()))
    });
    let (states, last) = moved.or_raise(py)?;
    let rows = states.iter().map(|one| {
        let [a, load, penetration] = numbers(one.state);
        [one.time, a, load, penetration, one.energy_release_rate]
    });
    let rows: Vec<_> = rows.collect();
    Ok((columns(py, &rows), last.map(numbers)))
}
