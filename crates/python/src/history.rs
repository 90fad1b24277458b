//! Contacts in time where the bodies relax.

use ::contact::{Course, Error, Hysteresis, Relaxation};
use numpy::PyArray1;
use pyo3::prelude::*;

use crate::arrays::{Output, columns};
use crate::contact::{Contact, Imposed, control, numbers};
use crate::error::{OrRaise as _, unknown};

/// A law: its name, relaxed fraction, exponent, times (s) and weights.
pub type LawNumbers = (String, f64, f64, Vec<f64>, Vec<f64>);
/// Time, contact radius, load and penetration.
type TimedArrays<'py> = [Output<'py>; 4];

/// Makes a law.
pub fn law((name, relaxed, exponent, times, weights): LawNumbers) -> PyResult<Relaxation> {
    let time = times.first().copied().unwrap_or(f64::NAN);
    Ok(match name.as_str() {
        "prony" => {
            let terms = weights.iter().zip(&times);
            let terms = terms.map(|(&weight, &time)| [weight, time]).collect();
            Relaxation::Prony { relaxed, terms }
        }
        "power_law" => Relaxation::PowerLaw { exponent, time },
        "modified_power_law" => Relaxation::ModifiedPowerLaw {
            relaxed,
            exponent,
            time,
        },
        "fractional_zener" => Relaxation::FractionalZener {
            relaxed,
            exponent,
            time,
        },
        other => return Err(unknown("law", other)),
    })
}

/// Accepts a law.
#[pyfunction]
pub fn check_relaxation(py: Python<'_>, numbers: LawNumbers) -> PyResult<()> {
    law(numbers)?.check().or_raise(py)
}

/// Returns the modulus (`modulus`) or the creep compliance (`creep`) at times, or storage and loss
/// modulus, one after the other, at angular frequencies (`complex`).
#[pyfunction]
pub fn relaxation_values<'py>(
    py: Python<'py>,
    numbers: LawNumbers,
    what: &str,
    at: Vec<f64>,
) -> PyResult<Output<'py>> {
    let law = law(numbers)?;
    let mut values = Vec::with_capacity(at.len());
    for x in at {
        match what {
            "modulus" => values.push(law.modulus(x).or_raise(py)?),
            "creep" => values.push(law.creep(x).or_raise(py)?),
            _ => values.extend(law.complex(x).or_raise(py)?),
        }
    }
    Ok(PyArray1::from_vec(py, values))
}

/// Follows a program. Returns the states, their phases, their error, and the bound of the error by
/// bodies that do not relax.
#[pyfunction]
#[pyo3(signature = (contact, law_numbers, imposed, *, time, value, at, receding, rigid, tolerance))]
#[expect(
    clippy::too_many_arguments,
    reason = "the arguments of a call from Python"
)]
pub fn history<'py>(
    py: Python<'py>,
    contact: &Bound<'py, Contact>,
    law_numbers: LawNumbers,
    imposed: Imposed<'_>,
    time: Vec<f64>,
    value: Vec<f64>,
    at: Vec<f64>,
    receding: f64,
    rigid: Option<&Bound<'py, Contact>>,
    tolerance: Option<f64>,
) -> PyResult<(TimedArrays<'py>, Vec<&'static str>, f64, f64)> {
    let (law, control) = (law(law_numbers)?, control(imposed)?);
    let contact = &contact.get().contact;
    let rigid = rigid.map(|rigid| &rigid.get().contact);
    let program: Vec<(f64, f64)> = time.into_iter().zip(value).collect();
    let follow = || -> Result<Course, Error> {
        let mut own = contact.history(&law)?;
        if let Some(rigid) = rigid {
            own = own.beside(rigid);
        }
        if receding != 0.0 {
            own = own.receding(Hysteresis::new(0.0, receding)?)?;
        }
        own.at(control, &program, &at, tolerance)
    };
    let course = py.detach(follow).or_raise(py)?;
    let rows = course.states.iter().map(|at| {
        let [a, load, penetration] = numbers(at.state);
        [at.time, a, load, penetration]
    });
    let rows: Vec<_> = rows.collect();
    let phases = course.states.iter().map(|at| at.phase.name()).collect();
    Ok((
        columns(py, &rows),
        phases,
        course.error,
        course.unlike_bodies,
    ))
}
