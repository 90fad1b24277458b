//! The JSON object of a fit.

use ::fit::data::Notes;
use ::fit::report::{a_over_t, line_speeds, reading};
use ::fit::{
    Estimate, Experiment, Fit, FittedExperiment, FixedValue, LeftOut, LossAngle, ModulusBias,
    Parameter, Warning, WithoutFilm,
};
use serde_json::{Value, json};

use super::reading::told;
use crate::cli::command_line::command_line;
use crate::cli::json::number;
use crate::table::scene::created_by;

/// Returns the object of a fit.
pub fn fit(fit: &Fit, experiments: &[Experiment], notes: &[Notes]) -> Value {
    let files = experiments.len();
    let fitted = || fit.experiments.iter().zip(experiments);
    let all_of = |value: &dyn Fn(&FittedExperiment, &Experiment) -> Value| -> Vec<Value> {
        fitted().map(|(fitted, own)| value(fitted, own)).collect()
    };
    // Of each file, where one of them has it.
    let any_of = |value: &dyn Fn(&FittedExperiment, &Experiment) -> Value| {
        let all = all_of(value);
        (!all.iter().all(Value::is_null)).then(|| one_or_all(all))
    };
    // The smallest and the largest contact radius of the points over the thickness of the film or top layer; null on a
    // half-space.
    let ratios = a_over_t(fit, experiments).into_iter();
    let ratios = ratios.map(|ends| ends.map(|ends| numbers(&ends)).into());
    let left_out =
        |fitted: &FittedExperiment, _: &Experiment| fitted.left_out.iter().map(group).collect();
    let doubts = told(experiments, notes)
        .map(|(doubt, text)| json!({ "kind": doubt.kind.name(), "text": text }));
    let read = experiments.iter().zip(notes);
    let read = read.map(|(own, notes)| reading(&own.measurement, notes));
    let of_relaxation =
        |fitted: &FittedExperiment, own: &Experiment| relaxation(fitted, own).into();
    let object = json!({
        "created_by": created_by(),
        "command": command_line(),
        "read": read.collect::<Vec<_>>(),
        "converged": fit.converged,
        "parameters": estimates(&fit.estimates, files),
        "sphere_young_modulus": young_of_sphere(fit, experiments),
        // In the order of `parameters`, the values of one parameter one after another.
        "correlation": matrix(&fit.correlation),
        // Null where a noise was estimated from the residuals.
        "reduced_chi_squared": fit.reduced_chi_squared.map(number),
        "noise": one_or_all(all_of(&|fitted, _| number(fitted.noise))),
        "abscissa_noise": one_or_all(all_of(&|fitted, _| number(fitted.abscissa_noise))),
        "a_over_t": one_or_all(ratios.collect()),
        // The least and the largest speed, where adhesion depends on it.
        "line_speed": any_of(&|fitted, _| line_speeds(fitted).map(|ends| numbers(&ends)).into()),
        "left_out": one_or_all(all_of(&left_out)),
        "loss": any_of(&|fitted, _| fitted.loss.map(loss).into()),
        "relaxation": any_of(&of_relaxation),
        "without_film": fit.without_film.as_ref().map(|one| without_film(one, files)),
        "fixed_values": fit.fixed_values.iter().map(fixed_value).collect::<Value>(),
        "warnings": doubts.chain(fit.warnings.iter().map(warning)).collect::<Value>(),
    });
    let optional = ["sphere_young_modulus", "line_speed", "loss", "relaxation"];
    without(&optional, object)
}

/// Leaves fields out of an object where they are null.
fn without(optional: &[&str], mut object: Value) -> Value {
    if let Value::Object(fields) = &mut object {
        fields.retain(|name, value| !(value.is_null() && optional.contains(&&**name)));
    }
    object
}

/// Returns the value itself if there is one, else the list.
fn one_or_all(mut all: Vec<Value>) -> Value {
    match all.len() {
        1 => all.remove(0),
        _ => all.into(),
    }
}

fn numbers(all: &[f64]) -> Value {
    all.iter().copied().map(number).collect()
}

/// Returns a matrix as JSON.
pub fn matrix(rows: &[Vec<f64>]) -> Value {
    rows.iter().map(|row| numbers(row)).collect()
}

pub fn warning(warning: &Warning) -> Value {
    json!({ "kind": warning.kind.name(), "text": warning.text })
}

/// Returns the same data without the film. The modulus stands beside that with the film; null if no modulus is free.
fn without_film(without: &WithoutFilm, files: usize) -> Value {
    let modulus = |bias: ModulusBias| {
        json!({
            "parameter": bias.parameter.identifier(),
            "relative": number(bias.relative),
            "standard_errors": number(bias.standard_errors),
            "film_matters": bias.matters(),
        })
    };
    json!({
        "parameters": estimates(&without.estimates, files),
        "chi_squared": number(without.chi_squared),
        "modulus": without.modulus.map(modulus),
    })
}

/// Returns what a value taken as given does.
pub fn fixed_value(one: &FixedValue) -> Value {
    let values = (!one.values.is_empty()).then(|| numbers(&one.values));
    let object = json!({
        "name": one.quantity.identifier(),
        // That of the first file that has it; if they differ, `values` has those of all files that have it, in their order.
        "value": number(one.value),
        "values": values,
        "unit": one.quantity.unit(),
        // The change of the value, and the changes of the parameters that follow, in the order of `correlation`.
        "step": number(one.step),
        "changes": numbers(&one.changes),
        // The standard error, if one is given.
        "error": one.error.map(number),
    });
    without(&["values"], object)
}

/// Returns the angle of a complex modulus, and its tangent with the standard error.
fn loss(found: LossAngle) -> Value {
    json!({
        "angle": number(found.angle),
        "tangent": number(found.tangent()),
        "stderr": number(found.tangent_error()),
    })
}

/// Returns what the relaxation does: the modulus (Pa) at times (s) after a step of the strain.
fn relaxation(fitted: &FittedExperiment, experiment: &Experiment) -> Option<Value> {
    let found = fitted.relaxation?;
    let moduli = found
        .moduli
        .map(|[time, modulus]| json!({ "time": number(time), "modulus": number(modulus) }));
    Some(json!({
        "law": experiment.relaxing.as_ref()?.law.name(),
        "moduli": moduli,
        "made_monotone": number(found.made_monotone),
        "unlike_bodies": number(found.unlike_bodies),
        "steps_error": number(found.steps_error),
    }))
}

/// Returns points that were left out for one reason.
fn group(group: &LeftOut) -> Value {
    json!({ "reason": group.reason.name(), "points": group.points, "lines": group.lines })
}

/// Returns estimates by the names of their parameters: one object, or a list with one for each of several `files` where
/// they have their own, null for a file that has no such parameter.
pub fn estimates(all: &[Estimate], files: usize) -> Value {
    let of = |parameter: Parameter| {
        let own = all.iter().filter(|found| found.parameter == parameter);
        let objects = by_file(own.map(|found| (found.experiment, estimate(found))), files);
        (parameter.identifier(), one_or_all(objects))
    };
    Estimate::parameters(all).into_iter().map(of).collect()
}

/// Returns the objects of one parameter: one, or with null one for each file where files have their own.
fn by_file(objects: impl Iterator<Item = (Option<usize>, Value)>, files: usize) -> Vec<Value> {
    let mut all = Vec::new();
    for (file, object) in objects {
        let place = file.unwrap_or(0);
        let length = if file.is_some() { files } else { 1 };
        all.resize(length.max(place + 1), Value::Null);
        all[place] = object;
    }
    all
}

fn estimate(found: &Estimate) -> Value {
    let interval = found.profile.map(|ends| numbers(&ends));
    let object = json!({
        "value": number(found.value),
        "stderr": number(found.standard_error),
        "unit": found.parameter.unit(),
        "interval": interval,
    });
    without(&["interval"], object)
}

/// Returns Young's modulus of the sphere, if its Poisson ratio is given and its reduced modulus was
/// found.
fn young_of_sphere(fit: &Fit, experiments: &[Experiment]) -> Option<Value> {
    let poisson = experiments.first()?.sphere_poisson_ratio?;
    let of_sphere = |found: &&Estimate| found.parameter == Parameter::SphereModulus;
    let found = fit.estimates.iter().filter(of_sphere);
    let young = found.map(|found| (found.experiment, estimate(&found.young_of_sphere(poisson))));
    let objects = by_file(young, experiments.len());
    (!objects.is_empty()).then(|| one_or_all(objects))
}
