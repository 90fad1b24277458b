//! The model of measured contacts: branches read from data, predictions, synthetic data, and the
//! errors of planned experiments.

use std::slice;

use fit::{Branch, Error, Solver};
use numpy::{PyArray1, PyArrayMethods as _};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::arrays::Output;
use crate::error::{OrRaise as _, unknown};
use crate::experiment::{Given, all, one};
use crate::fit::{accept_magnitudes, estimates, set_fixed_values, warnings};
use crate::parameter::{GivenFree, frees, parameter};
use crate::table::Table;

/// Returns the names of branches.
fn names(branches: &[Branch]) -> Vec<&'static str> {
    branches.iter().map(|branch| branch.name()).collect()
}

/// Returns the branches of names.
pub fn of_names(names: &[String]) -> PyResult<Vec<Branch>> {
    let branch = |name: &String| Branch::of_name(name).ok_or_else(|| unknown("branch", name));
    names.iter().map(branch).collect()
}

/// Reads from the data on which branch each point is.
#[pyfunction]
pub fn branches(
    py: Python<'_>,
    given: Given<'_>,
    free: Vec<String>,
) -> PyResult<Vec<&'static str>> {
    // No contact is made.
    let experiment = one(py, &given, &Solver::Direct)?;
    let free: Result<Vec<_>, Error> = free.iter().map(|name| parameter(name)).collect();
    let free = free.or_raise(py)?;
    let branches = experiment.branches(&free).or_raise(py)?;
    Ok(names(&branches))
}

/// Evaluates the model at every point: ordinates, contact radii, branches, whether each point is
/// beyond the end of its branch, and the derivatives, a row for each point.
#[pyfunction]
pub fn predict<'py>(
    py: Python<'py>,
    table: &Bound<'py, Table>,
    given: Given<'py>,
    branches: Option<Vec<String>>,
    parameters: Vec<String>,
) -> PyResult<Bound<'py, PyDict>> {
    let table = table.get();
    let experiment = one(py, &given, &table.solver(py)?)?;
    let parameters: Result<Vec<_>, Error> = parameters.iter().map(|name| parameter(name)).collect();
    let parameters = parameters.or_raise(py)?;
    let branches = branches.map(|names| of_names(&names)).transpose()?;
    let predicted =
        py.detach(|| experiment.predictions(table.get(), branches.as_deref(), &parameters));
    let predicted = predicted.or_raise(py)?;
    let fields = PyDict::new(py);
    fields.set_item("branch", names(&predicted.branches))?;
    let shape = [predicted.ordinates.len(), parameters.len()];
    let derivatives = PyArray1::from_vec(py, predicted.derivatives).reshape(shape)?;
    fields.set_item("ordinate", PyArray1::from_vec(py, predicted.ordinates))?;
    let radii = PyArray1::from_vec(py, predicted.contact_radii);
    fields.set_item("contact_radius", radii)?;
    fields.set_item("beyond", PyArray1::from_vec(py, predicted.beyond))?;
    fields.set_item("derivatives", derivatives)?;
    Ok(fields)
}

/// Returns the abscissae and ordinates of synthetic data, the loads of a contact stiffness at depths, and the
/// phases of a loss tangent.
#[pyfunction]
pub fn simulate<'py>(
    py: Python<'py>,
    table: &Bound<'py, Table>,
    given: Given<'py>,
    noise: f64,
    seed: u64,
    allow_magnitudes: bool,
) -> PyResult<[Output<'py>; 4]> {
    let table = table.get();
    let experiment = one(py, &given, &table.solver(py)?)?;
    let accepted = accept_magnitudes(slice::from_ref(&experiment), allow_magnitudes);
    accepted.map_err(|failure| failure.raise(py))?;
    let made = py.detach(|| fit::simulate(table.get(), &experiment, noise, seed));
    let made = made.or_raise(py)?;
    let points = made.measurement.points.iter();
    Ok([
        PyArray1::from_iter(py, points.clone().map(|point| point.abscissa)),
        PyArray1::from_iter(py, points.map(|point| point.ordinate)),
        PyArray1::from_vec(py, made.indentation.loads),
        PyArray1::from_vec(py, made.indentation.phases),
    ])
}

/// Returns the estimates that planned experiments would give, their correlation, and the
/// combinations that would not be determined: each in words, with the numbers of its estimates.
#[pyfunction]
pub fn forecast<'py>(
    py: Python<'py>,
    table: &Bound<'py, Table>,
    experiments: Vec<Given<'py>>,
    free: Vec<GivenFree>,
    allow_magnitudes: bool,
) -> PyResult<Bound<'py, PyDict>> {
    let table = table.get();
    let experiments = all(py, &experiments, &table.solver(py)?)?;
    let accepted = accept_magnitudes(&experiments, allow_magnitudes);
    accepted.map_err(|failure| failure.raise(py))?;
    let free = frees(py, free)?;
    let found = py.detach(|| fit::forecast(table.get(), &experiments, &free));
    let found = found.or_raise(py)?;
    let fields = PyDict::new(py);
    fields.set_item("estimates", estimates(py, &found.estimates)?)?;
    fields.set_item("correlation", found.correlation)?;
    set_fixed_values(&fields, &found.fixed_values)?;
    let undetermined = found.undetermined.into_iter().map(|one| {
        let parts = one.weights.iter().map(|&(estimate, _)| estimate);
        (one.text, parts.collect::<Vec<_>>())
    });
    fields.set_item("undetermined", undetermined.collect::<Vec<_>>())?;
    fields.set_item("warnings", warnings(&found.warnings))?;
    Ok(fields)
}
