//! What a fit of bodies that relax tells beside its parameters, and the doubts about it.

use contact::LawParameter;

use super::minima::minimum::Minimum;
use super::problem::Problem;
use super::start::relaxing_start::accept_zeros;
use crate::statistics::{extremes, range};
use crate::{Error, Fit, FittedRelaxation, Parameter, Warning, WarningKind};

/// The intervals between points below which a relaxation time is not seen.
const INTERVALS: f64 = 2.0;
/// The standard errors from a relaxation time within which there is a warning where it is not seen.
const NEAR: f64 = 3.0;
/// The error by bodies that do not relax, over the largest load, above which there is a warning.
const UNLIKE: f64 = 1e-3;
/// The stiffness of a film over that of a substrate that relaxes with it, above which the contact
/// may pull inside.
const STIFF_FILM: f64 = 3.0;
/// The error of the steps in time, in parts of the noise, above which there is a warning.
const SEEN: f64 = 0.1;
/// The standard errors short of the least squares from which on a contact point at the first point is not one by chance.
const FAR_SHORT: f64 = 5.0;
/// The change of an abscissa over their range above which it is no noise.
const MONOTONE: f64 = 0.01;

/// Young's modulus (Pa) above which a body that relaxes is no gel.
const STIFFEST_GEL: f64 = 1e6;
/// The ratio of the widest contacts of two experiments from which on their times tell flow of a solvent, which grow with the
/// square of it.
const OTHER_SIZE: f64 = 1.5;

/// Returns what the relaxation of an experiment does; `None` where the bodies do not relax.
pub(super) fn of(found: &Minimum<'_>, e: usize) -> Result<Option<FittedRelaxation>, Error> {
    let problem = &found.problem;
    let experiment = &problem.assigned[e].experiment;
    let Some(relaxing) = &experiment.relaxing else {
        return Ok(None);
    };
    let program = experiment.program();
    let free = problem.parameters_of(e);
    let is_free = |one| free.contains(&one);
    accept_zeros(experiment, &program, is_free, found.is_stopped(FAR_SHORT))?;
    let contact = problem.contact(&experiment.bodies, false)?;
    let history = contact.history(&relaxing.law)?;
    let (control, points) = (experiment.control(), &program.points);
    let measured = history.measured(control, points, None)?;
    let steps_error = history.error_of_measured(control, points, &measured)?;
    let unlike_bodies = match experiment.beside_rigid(problem.table)? {
        Some(rigid) => history.beside(&rigid).unlike_bodies(&measured)?,
        None => 0.0,
    };
    let [shortest, duration] = times(&experiment.times);
    let young = experiment.bodies.film().young();
    let modulus = |t: f64| Ok::<_, Error>([t, young * relaxing.law.modulus(t)?]);
    Ok(Some(FittedRelaxation {
        moduli: [
            modulus(shortest)?,
            modulus(0.5 * duration)?,
            modulus(duration)?,
        ],
        made_monotone: program.changed,
        unlike_bodies,
        steps_error,
    }))
}

/// Returns the shortest interval and the duration.
fn times(times: &[f64]) -> [f64; 2] {
    let intervals = times.windows(2).map(|pair| pair[1] - pair[0]);
    let shortest = intervals.fold(f64::INFINITY, f64::min);
    [shortest, times[times.len() - 1] - times[0]]
}

/// Adds the doubts about an experiment whose bodies relax.
pub(super) fn add(warnings: &mut Vec<Warning>, fit: &Fit, problem: &Problem<'_>, e: usize) {
    let experiment = &problem.assigned[e].experiment;
    let (Some(relaxing), Some(found)) = (&experiment.relaxing, fit.experiments[e].relaxation)
    else {
        return;
    };
    let name = &experiment.measurement.name;
    let [_, duration] = times(&experiment.times);
    let interval = duration / (experiment.times.len() - 1) as f64;
    for &slot in &problem.slots_of(e) {
        let parameter = problem.slots[slot].parameter;
        let value = problem.value(slot);
        if !matches!(parameter, Parameter::Law(LawParameter::Time(_))) {
            continue;
        }
        let [least, most] = [INTERVALS * interval, duration];
        // Times are known to a factor.
        let factor = (NEAR * fit.estimates[slot].standard_error / value).exp();
        let (is, then) = if !(least..=most).contains(&value) {
            ("is", "they tell one plateau of the modulus only")
        } else if value / factor < least || value * factor > most {
            (
                "may be",
                "then the standard errors of the moduli and of the law are too small, and intervals from the profile of \
                 the likelihood are right",
            )
        } else {
            continue;
        };
        warnings.push(WarningKind::RelaxationTime.with(format!(
            "{name}: {parameter} = {value:.2e} s {is} outside {least:.2e} s (two intervals between points) \
             to {most:.2e} s (the duration), where these data tell a relaxation time: {then}; measure faster, or hold \
             longer"
        )));
    }
    let is_free = |parameter| fit.estimate(parameter).is_some();
    if is_free(Parameter::FilmThickness) && is_free(Parameter::FilmModulus) {
        warnings.push(WarningKind::FreeThickness.with(format!(
            "{name}: modulus and thickness of a film that relaxes are hardly told apart by one curve: the \
             error of the modulus is 6 to 31 times as large as with a known thickness; give the thickness"
        )));
    }
    if found.unlike_bodies > UNLIKE {
        warnings.push(WarningKind::UnlikeBodies.with(format!(
            "{name}: probe or substrate deform beside the film and do not relax: the loads may be wrong \
             by {:.1e} of the largest load",
            found.unlike_bodies
        )));
    }
    let largest = fit.experiments[e]
        .points
        .iter()
        .filter_map(|point| Some(point.fit? - experiment.baseline_at(point.abscissa)));
    let steps = found.steps_error * largest.fold(0.0, |most: f64, load| most.max(load.abs()));
    if steps > SEEN * fit.experiments[e].noise {
        warnings.push(WarningKind::Steps.with(format!(
            "{name}: the loads may be wrong by {steps:.1e} N ({:.1e} of the largest load), because the contact \
             changes much within a step in time; the noise is {:.1e} N: measure at more times, or with \
             turns that are less sudden",
            found.steps_error, fit.experiments[e].noise
        )));
    }
    let bodies = &experiment.bodies;
    if bodies.are_coated()
        && relaxing.all_bodies
        && bodies.film().young() > STIFF_FILM * bodies.base.young()
    {
        warnings.push(WarningKind::TensileInside.with(format!(
            "{name}: a film more than {STIFF_FILM} times as stiff as a substrate that relaxes with it may \
             pull at the probe inside the contact, which is not modelled"
        )));
    }
    let points = experiment.measurement.points.iter();
    let range = range(points.map(|point| point.abscissa));
    if found.made_monotone > MONOTONE * range {
        warnings.push(WarningKind::NotMonotone.with(format!(
            "{name}: the {} departs by {:.2e} m, {:.1} % of its range, from the straight lines that are taken for \
             it, which rise to the largest value and fall from there: check that the points are one cycle",
            experiment.measurement.kind.names()[0],
            found.made_monotone,
            1e2 * found.made_monotone / range
        )));
    }
}

/// Warns of gels whose relaxation is that of contacts of one size: flow of a solvent is not told from it.
pub(super) fn of_one_size(problem: &Problem<'_>) -> Option<Warning> {
    let is_gel = |e: &usize| {
        let experiment = &problem.assigned[*e].experiment;
        experiment.relaxing.is_some() && experiment.bodies.film().young() < STIFFEST_GEL
    };
    let gels = (0..problem.assigned.len()).filter(is_gel);
    let widest: Vec<f64> = gels
        .map(|e| problem.contact_radii(e).map(|[_, widest]| widest))
        .collect::<Option<_>>()?;
    let [least, most] = extremes(widest.into_iter());
    (least <= most && most < OTHER_SIZE * least).then(|| {
        WarningKind::OneSize.with(format!(
            "the widest contact has a radius of {most:.1e} m: a gel also relaxes by flow of its solvent, in times that grow with the \
             square of this radius, or of the thickness of a thin film, and then the law holds for this size alone; measure \
             with another sphere or to another depth, and fit both with one law"
        ))
    })
}
