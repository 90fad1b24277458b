//! Reading measurements from files of text.

use std::path::PathBuf;

use fit::data::{
    Cantilever, Column, Format, Named, Reading, Reduced, Remedy, Role, Segments, read,
};
use fit::report::reading;
use fit::{Direction, Kind};
use numpy::PyArray1;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::error::{Failure, OrRaise as _};

/// What is known about a file, as a Python dict.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct GivenFormat {
    kind: Option<String>,
    /// What a column holds, and its heading.
    columns: Vec<(String, String)>,
    stiffness: Option<f64>,
    sensitivity: Option<f64>,
    segments: String,
    only: Option<String>,
    between: Option<[f64; 2]>,
    keep_pauses: bool,
}

/// Reads a file. Returns the fields of the experiment, and the doubts about how it was read.
#[pyfunction]
pub fn read_file<'py>(
    py: Python<'py>,
    path: PathBuf,
    given: GivenFormat,
) -> PyResult<(Bound<'py, PyDict>, Option<String>)> {
    let sensitivity = given.sensitivity;
    let format = format(py, given)?;
    let Reading {
        measurement,
        errors,
        loads,
        phases,
        times,
        notes,
    } = py.detach(|| read(&path, &format)).or_raise(py)?;
    if let Some(value) = sensitivity.filter(|_| !notes.has_volts()) {
        let text = format!(
            "{}: sensitivity is that of deflections in volts, and the file has none: leave it out, or give the unit \
             of the column, columns={{\"deflection\": \"HEADING [V]\"}}",
            measurement.name
        );
        let failure = Failure::of_words("FitError", &text);
        return Err(failure.about("sensitivity", value).raise(py));
    }
    let points = &measurement.points;
    let fields = PyDict::new(py);
    fields.set_item("name", &measurement.name)?;
    fields.set_item("kind", measurement.kind.name())?;
    let abscissae = points.iter().map(|point| point.abscissa);
    fields.set_item("abscissa", PyArray1::from_iter(py, abscissae))?;
    let ordinates = points.iter().map(|point| point.ordinate);
    fields.set_item("ordinate", PyArray1::from_iter(py, ordinates))?;
    // Points without a direction count as those of approach.
    if points.iter().any(|point| point.direction.is_some()) {
        let retract = points
            .iter()
            .map(|point| point.direction == Some(Direction::Retract));
        fields.set_item("retract", PyArray1::from_iter(py, retract))?;
    }
    for (name, list) in [
        ("abscissa_noise", errors.abscissa),
        ("noise", errors.ordinate),
        ("loads", loads),
        ("phases", phases),
        ("time", times),
    ] {
        if !list.is_empty() {
            fields.set_item(name, PyArray1::from_vec(py, list))?;
        }
    }
    if measurement.kind == Kind::ForceHeight {
        fields.set_item("stiffness", notes.cantilever.stiffness)?;
        fields.set_item("from_deflection", notes.has_deflection())?;
    }
    fields.set_item("reading", reading(&measurement, &notes))?;
    let doubts = notes.doubts.iter().map(|doubt| match &doubt.remedy {
        Some(remedy) => format!("{}; if so, {}", doubt.text, in_python(remedy)),
        None => doubt.text.clone(),
    });
    let doubts: Vec<String> = doubts.collect();
    let doubt = (!doubts.is_empty()).then(|| doubts.join("; "));
    Ok((fields, doubt))
}

/// Returns the format. The Python layer has checked the words.
fn format(py: Python<'_>, given: GivenFormat) -> PyResult<Format> {
    let unknown = |what: &str| PyValueError::new_err(format!("{what} is not known"));
    let kind = |name: String| Kind::of_name(&name).ok_or_else(|| unknown(&name));
    let only = |name: String| Direction::of_name(&name).ok_or_else(|| unknown(&name));
    let column = |(role, heading): (String, String)| {
        format!("{role}={heading}")
            .parse::<Column>()
            .map_err(|text| Failure::of_words("FitError", &text))
            .or_raise(py)
    };
    Ok(Format {
        kind: given.kind.map(kind).transpose()?,
        columns: given
            .columns
            .into_iter()
            .map(column)
            .collect::<PyResult<_>>()?,
        cantilever: Cantilever {
            stiffness: given.stiffness,
            sensitivity: given.sensitivity,
        },
        segments: Segments::of_name(&given.segments).ok_or_else(|| unknown(&given.segments))?,
        only: given.only.map(only).transpose()?,
        between: given.between.map(|ends| ends.map(Into::into)),
        keep_pauses: given.keep_pauses,
    })
}

/// Returns what to give, in the words of the package.
pub fn in_python(remedy: &Remedy) -> String {
    match remedy {
        Remedy::Columns(ways) => {
            let way = |named: &Named| {
                let Named { kind, columns, .. } = named;
                let kind = kind.map(|kind| format!("kind=\"{}\", ", kind.name()));
                let columns: Vec<String> = columns.iter().map(entry).collect();
                let columns = columns.join(", ");
                let reduced = named.reduced.map(|reduced| match reduced {
                    Reduced::ContactDepth => ", indentation=Indentation(epsilon=0)".to_owned(),
                    Reduced::Separation => ", stiffness=...".to_owned(),
                });
                let [kind, reduced] = [kind, reduced].map(Option::unwrap_or_default);
                format!("{kind}columns={{{columns}}}{reduced}")
            };
            let ways: Vec<String> = ways.iter().map(way).collect();
            let given = format!("give {}", ways.join(", or "));
            match remedy.to_fill_in() {
                Some(open) => format!("{given}, {open}"),
                None => given,
            }
        }
        Remedy::Kind(kinds) => {
            let names: Vec<String> = kinds
                .iter()
                .map(|kind| format!("\"{}\"", kind.name()))
                .collect();
            format!("give the kind, one of {}", names.join(", "))
        }
        Remedy::Cantilever { sensitivity: false } => "give stiffness=, N/m".to_owned(),
        Remedy::Cantilever { sensitivity: true } => {
            "give stiffness=, N/m, and sensitivity=, m/V".to_owned()
        }
        Remedy::Split => "give segments=\"split\"".to_owned(),
        Remedy::BaselineSlope => "free baseline_slope in the fit, too".to_owned(),
    }
}

/// Returns an entry of the argument `columns`.
fn entry((role, heading): &(Role, String)) -> String {
    format!("\"{}\": {heading:?}", role.name())
}

impl From<fit::data::DataError> for Failure {
    fn from(error: fit::data::DataError) -> Self {
        if let Some(source) = &error.of_system {
            return Self::new("FitError", &error).about_file(error.name.as_ref(), source);
        }
        let remedy = error.remedy.as_deref().map(in_python);
        match remedy {
            Some(remedy) => Self::of_words("FitError", &format!("{error}; {remedy}")),
            None => Self::new("FitError", &error),
        }
    }
}
