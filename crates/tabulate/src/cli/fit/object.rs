//! The JSON object of a fit.

use std::borrow::Cow;

use ::fit::data::Notes;
use ::fit::report::{a_over_t, reading};
use ::fit::{
    Estimate, Experiment, Fit, FittedExperiment, FixedValue, LeftOut, LossAngle, Parameter,
    Warning, WithoutFilm,
};
use serde::{Serialize, Serializer};

use super::reading::told;
use crate::cli::json::{Fields, Number};

/// A fit.
#[derive(Serialize)]
pub struct FitObject<'a> {
    /// How each file was read, as the report says it.
    read: Vec<String>,
    converged: bool,
    parameters: Estimates<'a>,
    /// Young's modulus of the sphere, where its Poisson ratio is given.
    #[serde(skip_serializing_if = "Option::is_none")]
    sphere_young_modulus: Option<OneOrAll<Option<EstimateObject>>>,
    /// In the order of `parameters`, the values of one parameter one after another.
    correlation: Vec<Vec<Number>>,
    /// Null where a noise was estimated from the residuals.
    reduced_chi_squared: Option<Number>,
    noise: OneOrAll<Number>,
    abscissa_noise: OneOrAll<Number>,
    /// Of each file, the smallest and the largest contact radius of its points over the thickness of
    /// the film or top layer; null on a half-space.
    a_over_t: OneOrAll<Option<[Number; 2]>>,
    /// Of each file, the points that were left out, by reason.
    left_out: OneOrAll<Vec<LeftOutObject>>,
    /// Of each file, the loss tangent of the film, where phases are measured.
    #[serde(skip_serializing_if = "Option::is_none")]
    loss: Option<OneOrAll<Option<Fields<Number, 3>>>>,
    /// Of each file, what the relaxation does.
    #[serde(skip_serializing_if = "Option::is_none")]
    relaxation: Option<OneOrAll<Option<RelaxationObject>>>,
    without_film: Option<WithoutFilmObject<'a>>,
    fixed_values: Vec<FixedValueObject>,
    warnings: Vec<WarningObject<'a>>,
}

/// The same data without the film.
#[derive(Serialize)]
struct WithoutFilmObject<'a> {
    parameters: Estimates<'a>,
    chi_squared: Number,
    /// The modulus beside that with the film; null if no modulus is free.
    modulus: Option<ModulusObject>,
}

/// What a value taken as given does.
#[derive(Serialize)]
struct FixedValueObject {
    name: String,
    /// The value of the first file that has it; if they differ, those of all files that have it, in their order.
    value: Number,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    values: Vec<Number>,
    unit: &'static str,
    /// The change of the value, and the changes of the parameters that follow, in the order of
    /// `correlation`.
    step: Number,
    changes: Vec<Number>,
    /// The standard error, if one is given.
    error: Option<Number>,
}

/// Returns the angle of a complex modulus, and its tangent with the standard error.
fn loss(found: LossAngle) -> Fields<Number, 3> {
    let numbers = [
        ("angle", found.angle),
        ("tangent", found.tangent()),
        ("stderr", found.tangent_error()),
    ];
    Fields(numbers.map(|(name, value)| (name, Number(value))))
}

/// What the relaxation does: the modulus (Pa) at times (s) after a step of the strain.
#[derive(Serialize)]
struct RelaxationObject {
    law: &'static str,
    moduli: [Fields<Number, 2>; 3],
    made_monotone: Number,
    unlike_bodies: Number,
    steps_error: Number,
}

impl RelaxationObject {
    fn new(fitted: &FittedExperiment, experiment: &Experiment) -> Option<Self> {
        let found = fitted.relaxation?;
        Some(Self {
            law: experiment.relaxing.as_ref()?.law.name(),
            moduli: found.moduli.map(|[time, modulus]| {
                Fields([("time", Number(time)), ("modulus", Number(modulus))])
            }),
            made_monotone: Number(found.made_monotone),
            unlike_bodies: Number(found.unlike_bodies),
            steps_error: Number(found.steps_error),
        })
    }
}

#[derive(Serialize)]
struct LeftOutObject {
    reason: &'static str,
    points: usize,
    lines: [u64; 2],
}

#[derive(Serialize)]
struct ModulusObject {
    parameter: String,
    relative: Number,
    standard_errors: Number,
    film_matters: bool,
}

#[derive(Serialize)]
pub struct WarningObject<'a> {
    kind: &'static str,
    text: Cow<'a, str>,
}

impl<'a> WarningObject<'a> {
    pub fn new(warning: &'a Warning) -> Self {
        Self {
            kind: warning.kind.name(),
            text: warning.text.as_str().into(),
        }
    }
}

/// The value itself if there is one, else the list.
struct OneOrAll<T>(Vec<T>);

impl<T: Serialize> Serialize for OneOrAll<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match &self.0[..] {
            [one] => one.serialize(serializer),
            all => all.serialize(serializer),
        }
    }
}

/// Estimates by the names of their parameters: one object, or a list with one for each of several files where
/// they have their own, null for a file that has no such parameter.
pub struct Estimates<'a> {
    pub all: &'a [Estimate],
    /// The number of files.
    pub files: usize,
}

#[derive(Serialize)]
struct EstimateObject {
    value: Number,
    stderr: Number,
    unit: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    interval: Option<[Number; 2]>,
}

impl Serialize for Estimates<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut parameters: Vec<Parameter> = Vec::new();
        for estimate in self.all {
            if !parameters.contains(&estimate.parameter) {
                parameters.push(estimate.parameter);
            }
        }
        serializer.collect_map(parameters.into_iter().map(|parameter| {
            let of = self.all.iter().filter(|found| found.parameter == parameter);
            let objects = by_file(of, self.files, EstimateObject::new);
            (parameter.identifier(), OneOrAll(objects))
        }))
    }
}

/// Returns objects of the estimates of one parameter: one, or with null one for each file where files have their own.
fn by_file<'a>(
    estimates: impl Iterator<Item = &'a Estimate>,
    files: usize,
    object: impl Fn(&Estimate) -> EstimateObject,
) -> Vec<Option<EstimateObject>> {
    let mut objects = Vec::new();
    for found in estimates {
        let place = found.experiment.unwrap_or(0);
        let length = if found.experiment.is_some() { files } else { 1 };
        objects.resize_with(length.max(place + 1), || None);
        objects[place] = Some(object(found));
    }
    objects
}

impl EstimateObject {
    fn new(found: &Estimate) -> Self {
        Self {
            value: Number(found.value),
            stderr: Number(found.standard_error),
            unit: found.parameter.unit(),
            interval: found.profile.map(|ends| ends.map(Number)),
        }
    }
}

fn left_out(fitted: &FittedExperiment) -> Vec<LeftOutObject> {
    let groups = fitted.left_out.iter();
    let object = |group: &LeftOut| LeftOutObject {
        reason: group.reason.name(),
        points: group.points,
        lines: group.lines,
    };
    groups.map(object).collect()
}

/// Returns a matrix as JSON.
pub fn matrix(rows: &[Vec<f64>]) -> Vec<Vec<Number>> {
    rows.iter()
        .map(|row| row.iter().copied().map(Number).collect())
        .collect()
}

impl<'a> FitObject<'a> {
    /// Returns the object of a fit.
    pub fn new(fit: &'a Fit, experiments: &[Experiment], notes: &'a [Notes]) -> Self {
        let of_files = |value: fn(&FittedExperiment) -> f64| {
            let values = fit.experiments.iter().map(|one| Number(value(one)));
            OneOrAll(values.collect())
        };
        let doubts = told(experiments, notes).map(|(doubt, text)| WarningObject {
            kind: doubt.kind(),
            text: text.into(),
        });
        let warnings = fit.warnings.iter().map(WarningObject::new);
        let losses: Vec<Option<LossAngle>> = fit.experiments.iter().map(|one| one.loss).collect();
        let read = experiments.iter().zip(notes);
        Self {
            read: read
                .map(|(experiment, notes)| reading(&experiment.measurement, notes))
                .collect(),
            sphere_young_modulus: young_of_sphere(fit, experiments),
            converged: fit.converged,
            parameters: Estimates {
                all: &fit.estimates,
                files: experiments.len(),
            },
            correlation: matrix(&fit.correlation),
            reduced_chi_squared: fit.reduced_chi_squared.map(Number),
            noise: of_files(|one| one.noise),
            abscissa_noise: of_files(|one| one.abscissa_noise),
            a_over_t: OneOrAll(
                fit.experiments
                    .iter()
                    .zip(experiments)
                    .map(|(fitted, one)| a_over_t(fit, fitted, one).map(|ends| ends.map(Number)))
                    .collect(),
            ),
            left_out: OneOrAll(fit.experiments.iter().map(left_out).collect()),
            loss: losses.iter().any(Option::is_some).then(|| {
                let objects = losses.iter().map(|one| one.map(loss));
                OneOrAll(objects.collect())
            }),
            relaxation: fit
                .experiments
                .iter()
                .any(|one| one.relaxation.is_some())
                .then(|| {
                    let fitted = fit.experiments.iter().zip(experiments);
                    OneOrAll(fitted.map(|(f, e)| RelaxationObject::new(f, e)).collect())
                }),
            without_film: fit
                .without_film
                .as_ref()
                .map(|without| WithoutFilmObject::new(without, experiments.len())),
            fixed_values: fit.fixed_values.iter().map(FixedValueObject::new).collect(),
            warnings: doubts.chain(warnings).collect(),
        }
    }
}

impl FixedValueObject {
    fn new(one: &FixedValue) -> Self {
        Self {
            name: one.quantity.identifier(),
            value: Number(one.value),
            values: one.values.iter().copied().map(Number).collect(),
            unit: one.quantity.unit(),
            step: Number(one.step),
            changes: one.changes.iter().copied().map(Number).collect(),
            error: one.error.map(Number),
        }
    }
}

/// Returns Young's modulus of the sphere, if its Poisson ratio is given and its reduced modulus was
/// found.
fn young_of_sphere(
    fit: &Fit,
    experiments: &[Experiment],
) -> Option<OneOrAll<Option<EstimateObject>>> {
    let poisson = experiments.first()?.sphere_poisson_ratio?;
    let of_sphere = |found: &&Estimate| found.parameter == Parameter::SphereModulus;
    let young = |found: &Estimate| EstimateObject::new(&found.young_of_sphere(poisson));
    let found = fit.estimates.iter().filter(of_sphere);
    let objects = by_file(found, experiments.len(), young);
    (!objects.is_empty()).then_some(OneOrAll(objects))
}

impl<'a> WithoutFilmObject<'a> {
    fn new(without: &'a WithoutFilm, files: usize) -> Self {
        Self {
            parameters: Estimates {
                all: &without.estimates,
                files,
            },
            chi_squared: Number(without.chi_squared),
            modulus: without.modulus.map(|bias| ModulusObject {
                parameter: bias.parameter.identifier(),
                relative: Number(bias.relative),
                standard_errors: Number(bias.standard_errors),
                film_matters: bias.matters(),
            }),
        }
    }
}
