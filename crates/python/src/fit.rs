//! Fits of measured contacts: one fit of one or several experiments, and a map of separate fits.

use std::sync::Arc;
use std::sync::atomic::Ordering;

use ::solve::parallel;
use contact::magnitude::Magnitude;
use fit::data::{Notes, opposite_sense};
use fit::report::{JkrPlotPoint, jkr_plot, report};
use fit::{
    Combination, Direction, Estimate, Experiment, Fit, FixedValue, Free, Known, Loss, Measurement,
    Options, Warning, WarningKind, WithoutFilm,
};
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList, PyString, PyTuple};

use crate::error::{Failure, unknown, with_identifiers};
use crate::experiment::{Given, all, interrupt};
use crate::indentation::loss;
use crate::interruption::interruptible;
use crate::parameter::{GivenFree, fixed, frees};
use crate::table::Table;

/// Loss, level of profiles, range of the attraction, whether any magnitude is allowed, and whether
/// points may be left out.
type GivenOptions = (String, Option<f64>, f64, bool, bool);

/// Fits one or several experiments together.
#[pyfunction]
#[pyo3(name = "fit")]
pub fn fit_together<'py>(
    py: Python<'py>,
    table: &Bound<'py, Table>,
    experiments: Vec<Given<'py>>,
    free: Vec<GivenFree>,
    given_options: GivenOptions,
    known: Vec<(String, f64)>,
    fixed_values: bool,
) -> PyResult<Bound<'py, PyDict>> {
    let known = known.into_iter().map(|(name, error)| {
        let quantity = fixed(py, &name)?;
        Ok(Known { quantity, error })
    });
    let known: PyResult<Vec<Known>> = known.collect();
    let (options, allow_magnitudes) = options(given_options)?;
    let options = Options {
        known: known?,
        fixed_values,
        ..options
    };
    let table = table.get();
    let mut experiments = all(py, &experiments, &table.solver(py)?)?;
    let interrupted = Arc::default();
    interrupt(&mut experiments, &interrupted);
    let free = frees(py, free)?;
    let found = interruptible(py, &interrupted, || {
        checked_fit(table.get(), &experiments, &free, &options, allow_magnitudes)
    })?
    .map_err(|failure| failure.raise(py))?;
    let result = summary(py, &found)?;
    // The points come from arrays, which have no headings.
    let notes = vec![Notes::default(); experiments.len()];
    let report = report(&found, &experiments, &notes, &[]);
    result.set_item("report", report)?;
    let fitted = experiments.iter().enumerate();
    let fitted = fitted.map(|(i, experiment)| points(py, &found, i, experiment));
    result.set_item("experiments", fitted.collect::<PyResult<Vec<_>>>()?)?;
    result.set_item(
        "without_film",
        without_film(py, found.without_film.as_ref())?,
    )?;
    set_fixed_values(&result, &found.fixed_values)?;
    result.set_item("undetermined", Combination::texts(&found.undetermined))?;
    Ok(result)
}

/// Adds what values that are not free do to a result.
pub fn set_fixed_values(result: &Bound<'_, PyDict>, values: &[FixedValue]) -> PyResult<()> {
    let rows = values.iter().map(|one| {
        (
            one.quantity.identifier(),
            one.value,
            &one.values,
            one.step,
            &one.changes,
            one.error,
        )
    });
    result.set_item("fixed_values", rows.collect::<Vec<_>>())
}

/// Fits each experiment by itself, on all cores. Returns a summary, or an exception, for each.
#[pyfunction]
pub fn fit_map<'py>(
    py: Python<'py>,
    table: &Bound<'py, Table>,
    experiments: Vec<Given<'py>>,
    free: Vec<GivenFree>,
    given_options: GivenOptions,
) -> PyResult<Bound<'py, PyList>> {
    /// The fits whose results are in memory before they are made objects of Python.
    const BLOCK: usize = 64;
    let (options, allow_magnitudes) = options(given_options)?;
    let options = Options {
        without_film: false,
        ..options
    };
    let table = table.get();
    let (solver, free) = (table.solver(py)?, frees(py, free)?);
    let interrupted = Arc::default();
    let results = PyList::empty(py);
    for (block, curves) in experiments.chunks(BLOCK).enumerate() {
        let mut curves = all(py, curves, &solver)?;
        interrupt(&mut curves, &interrupted);
        let one = |curve: &Experiment| {
            let goes_on = !interrupted.load(Ordering::Relaxed);
            let curve = std::slice::from_ref(curve);
            goes_on
                .then(|| checked_fit(table.get(), curve, &free, &options, allow_magnitudes))
                .ok_or(())
        };
        let found = interruptible(py, &interrupted, || parallel::try_map(&curves, one))?;
        for (i, found) in found.into_iter().flatten().enumerate() {
            match found {
                Ok(found) => results.append(summary(py, &found)?)?,
                Err(failure) => {
                    results.append(failure.at(block * BLOCK + i).raise(py))?;
                }
            }
        }
    }
    Ok(results)
}

/// Fits, and refuses numbers that no experiment has unless they are allowed.
fn checked_fit(
    table: &interp::Table,
    experiments: &[Experiment],
    free: &[Free],
    options: &Options,
    allow_magnitudes: bool,
) -> Result<Fit, Box<Failure>> {
    accept_magnitudes(experiments, allow_magnitudes)?;
    let mut found = fit::fit(table, experiments, free, options).map_err(|error| {
        let failure = Failure::from(error);
        Box::new(match experiments.iter().find_map(opposite) {
            Some(doubt) => failure.with(&doubt),
            None => failure,
        })
    })?;
    if !found.warnings.is_empty() {
        let doubts = experiments.iter().filter_map(opposite);
        found.warnings.extend(doubts.map(|text| Warning {
            kind: WarningKind::Implausible,
            text,
        }));
    }
    if found.found_values() && !allow_magnitudes {
        accept("the fit", &found.magnitudes())?;
    }
    Ok(found)
}

/// Says that abscissae or ordinates may count in the opposite sense, as is said of files when they are read.
fn opposite(experiment: &Experiment) -> Option<String> {
    let Measurement {
        name, kind, points, ..
    } = &experiment.measurement;
    let what = match opposite_sense(*kind, points)? {
        [true, true] => "abscissa and ordinate",
        [true, false] => "the abscissa",
        _ => "the ordinate",
    };
    Some(format!(
        "{name}: {what} may count in the opposite sense: loads are positive where they press the bodies together, \
         penetrations grow and heights fall where the bodies come closer; if so, change the sign"
    ))
}

/// Refuses numbers that no experiment has, unless they are allowed.
pub fn accept_magnitudes(experiments: &[Experiment], allowed: bool) -> Result<(), Box<Failure>> {
    let mut refused = experiments.iter().filter(|_| !allowed);
    refused.try_for_each(|one| accept(&one.measurement.name, &one.magnitudes()))
}

fn accept(name: &str, found: &[Magnitude]) -> Result<(), Box<Failure>> {
    let failure = Failure::magnitudes(name, found);
    failure.map_or(Ok(()), |failure| Err(Box::new(failure)))
}

/// Makes the options, and tells whether any magnitude is allowed.
fn options(given: GivenOptions) -> PyResult<(Options, bool)> {
    let (loss, profile_level, interaction_range, allow_magnitudes, allow_left_out) = given;
    let loss = match loss.as_str() {
        "squares" => Loss::Squares,
        "huber" => Loss::HUBER,
        "soft-l1" => Loss::SOFT_L1,
        other => return Err(unknown("loss", other)),
    };
    let options = Options {
        loss,
        profile_level,
        interaction_range,
        allow_left_out,
        ..Options::default()
    };
    Ok((options, allow_magnitudes))
}

/// Returns parameter, experiment, value, standard error and profile of each estimate.
pub fn estimates<'py>(py: Python<'py>, estimates: &[Estimate]) -> PyResult<Bound<'py, PyList>> {
    let one = |one: &Estimate| {
        let profile = one.profile.map(<(f64, f64)>::from);
        let (value, error) = (one.value, one.standard_error);
        let parameter = one.parameter.identifier();
        (parameter, one.experiment, value, error, profile)
    };
    PyList::new(py, estimates.iter().map(one))
}

/// Returns what a fit of a map and a single one have in common.
fn summary<'py>(py: Python<'py>, found: &Fit) -> PyResult<Bound<'py, PyDict>> {
    let fields = PyDict::new(py);
    fields.set_item("converged", found.converged)?;
    fields.set_item("evaluations", found.evaluations)?;
    fields.set_item("estimates", estimates(py, &found.estimates)?)?;
    fields.set_item("correlation", &found.correlation)?;
    fields.set_item("chi_squared", found.chi_squared)?;
    fields.set_item("degrees_of_freedom", found.degrees_of_freedom)?;
    fields.set_item("reduced_chi_squared", found.reduced_chi_squared)?;
    fields.set_item("warnings", warnings(&found.warnings))?;
    Ok(fields)
}

/// Returns the kinds and the texts of warnings.
pub fn warnings(found: &[Warning]) -> Vec<(&'static str, String)> {
    let words = |warning: &Warning| (warning.kind.name(), with_identifiers(&warning.text));
    found.iter().map(words).collect()
}

/// Returns the points of the experiment `number` of a fit as arrays, NaN where there is no value.
fn points<'py>(
    py: Python<'py>,
    found: &Fit,
    number: usize,
    given: &Experiment,
) -> PyResult<Bound<'py, PyDict>> {
    let experiment = &found.experiments[number];
    let points = &experiment.points;
    let column = |value: fn(&fit::FittedPoint) -> Option<f64>| {
        PyArray1::from_iter(
            py,
            points.iter().map(|point| value(point).unwrap_or(f64::NAN)),
        )
    };
    let fields = PyDict::new(py);
    fields.set_item("name", &experiment.name)?;
    fields.set_item("kind", given.measurement.kind.name())?;
    let directions = given.measurement.points.iter().map(|point| point.direction);
    let retract: Option<Vec<bool>> = directions
        .map(|direction| direction.map(|one| one == Direction::Retract))
        .collect();
    let retract = retract.map(|retract| PyArray1::from_vec(py, retract));
    fields.set_item("retract", retract)?;
    fields.set_item("_jkr", jkr(py, jkr_plot(found, given, number))?)?;
    fields.set_item("loss", loss(py, experiment.loss)?)?;
    let relaxation = experiment.relaxation.map(|found| {
        let [times, moduli] = [0, 1].map(|i| found.moduli.map(|pair| pair[i]).to_vec());
        (
            times,
            moduli,
            found.made_monotone,
            found.unlike_bodies,
            found.steps_error,
        )
    });
    fields.set_item("relaxation", relaxation)?;
    fields.set_item("noise", experiment.noise)?;
    fields.set_item("noise_is_estimated", experiment.noise_is_estimated)?;
    fields.set_item("abscissa_noise", experiment.abscissa_noise)?;
    fields.set_item("abscissa", column(|point| Some(point.abscissa)))?;
    fields.set_item("ordinate", column(|point| Some(point.ordinate)))?;
    fields.set_item("fit", column(|point| point.fit))?;
    fields.set_item("deviation", column(|point| Some(point.deviation)))?;
    fields.set_item("contact_radius", column(|point| point.contact_radius))?;
    fields.set_item("without_film", column(|point| point.without_film))?;
    fields.set_item("line_speed", column(|point| point.line_speed))?;
    let energies = column(|point| point.energy_release_rate);
    fields.set_item("energy_release_rate", energies)?;
    let branches = points.iter().map(|point| point.branch.name());
    fields.set_item("branch", branches.collect::<Vec<_>>())?;
    let outliers = points.iter().map(|point| point.outlier);
    fields.set_item("outlier", PyArray1::from_iter(py, outliers))?;
    let left_out = PyDict::new(py);
    for group in &experiment.left_out {
        left_out.set_item(group.reason.name(), group.points)?;
    }
    fields.set_item("left_out", left_out)?;
    Ok(fields)
}

/// Returns the points of a JKR plot as arrays: abscissa, ordinate, that of the fit and that without
/// the film, NaN where there is no value; or why there is no such plot.
fn jkr<'py>(
    py: Python<'py>,
    plot: Result<Vec<Option<JkrPlotPoint>>, fit::Error>,
) -> PyResult<Bound<'py, PyAny>> {
    match plot {
        Err(reason) => Ok(PyString::new(py, &reason.to_string()).into_any()),
        Ok(points) => {
            let column = |value: fn(&JkrPlotPoint) -> Option<f64>| {
                let values = points.iter().map(|point| value(point.as_ref()?));
                PyArray1::from_iter(py, values.map(|value| value.unwrap_or(f64::NAN)))
            };
            let columns: [fn(&JkrPlotPoint) -> Option<f64>; 4] = [
                |point| Some(point.abscissa),
                |point| Some(point.measured),
                |point| point.fit,
                |point| point.without_film,
            ];
            Ok(PyTuple::new(py, columns.map(column))?.into_any())
        }
    }
}

/// Returns the fit without the film.
fn without_film<'py>(
    py: Python<'py>,
    found: Option<&WithoutFilm>,
) -> PyResult<Option<Bound<'py, PyDict>>> {
    let Some(found) = found else { return Ok(None) };
    let fields = PyDict::new(py);
    fields.set_item("estimates", estimates(py, &found.estimates)?)?;
    fields.set_item("chi_squared", found.chi_squared)?;
    let modulus = found.modulus.map(|bias| {
        (
            bias.parameter.identifier(),
            bias.relative,
            bias.standard_errors,
            bias.matters(),
        )
    });
    fields.set_item("modulus", modulus)?;
    Ok(Some(fields))
}
