//! Where the method starts where bodies relax: the elastic contact that describes the approach, and
//! the best of a few laws with it.

use contact::LawParameter;

use interp::{Probe, Table};

use super::starts::{IsUnknown, Starts};
use crate::estimate::problem::assigned::Assigned;
use crate::model::{Program, contacts_of, noise_of};
use crate::statistics::{extremes, median, range};
use crate::{Direction, Error, Experiment, Parameter, Point, Relaxing};

/// Why data that begin in contact are refused.
const BEGINS_IN_CONTACT: &str = "its points begin in contact: the history before the first point is \
     not known, and the forces depend on it; keep points from before the contact, and check that no two columns are swapped";
/// Why data whose beginning shows neither of the zeros are refused.
const NO_ZEROS: &str = "fewer than 3 of its points are before the contact that was found, and data that begin in contact \
     would look the same: contact point and baseline are not known together; keep more points from before the contact, \
     or fix one of both";
/// The exponents that are tried, those of laws with a relaxation time, the relaxed fractions, and
/// the relaxation times over the duration.
const EXPONENTS: [f64; 3] = [0.05, 0.2, 0.5];
const FEWER: [f64; 2] = [0.2, 0.5];
const FRACTIONS: [f64; 2] = [0.15, 0.6];
const TIMES: [f64; 3] = [0.01, 0.07, 0.5];
/// The weights that are tried of two times of which one is given.
const BESIDE: [f64; 3] = [0.1, 0.25, 0.5];
/// The range of several relaxation times over the duration.
const RANGE: [f64; 2] = [0.02, 0.5];
/// The part of the sum of squares that a start may leave without others being tried, at the contact points that these
/// parts of the approach have.
const POOR: f64 = 0.03;
const PARTS: [f64; 7] = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7];
/// The part of the largest imposed value with which data may begin, at the contact point that the
/// approach shows.
const BEGIN: f64 = 0.05;

/// The fewest points up to the largest imposed value: data with fewer have no approach.
const FEWEST: usize = 3;

/// Gives an experiment whose bodies relax the level of its baseline, if this is unknown: that of its first points,
/// because few of them may be before the contact.
pub(crate) fn level(starts: &mut Starts<'_>) -> Result<(), Error> {
    let experiment = &starts.at.experiment;
    let points = &experiment.measurement.points;
    if experiment.relaxing.is_none() || points.len() < FEWEST {
        return Ok(());
    }
    let first = points[..FEWEST].iter();
    let reading = median(first.map(|point| point.ordinate).collect());
    if (starts.is_unknown)(Parameter::Baseline) {
        starts.give(Parameter::Baseline, reading - experiment.load_offset)
    } else {
        starts.give_unknown(Parameter::LoadOffset, reading - experiment.baseline)
    }
}

/// Returns the approach of an experiment whose bodies relax, as that of an elastic contact.
pub(crate) fn elastic(one: &Assigned, level: bool) -> Result<Option<Assigned>, Error> {
    if one.experiment.relaxing.is_none() {
        return Ok(None);
    }
    let mut experiment = one.experiment.clone();
    let points = experiment.program().turn + 1;
    if points < FEWEST {
        return Err(experiment.not_fitted(BEGINS_IN_CONTACT));
    }
    experiment.relaxing = None;
    experiment.times.clear();
    experiment.errors.abscissa.truncate(points);
    experiment.errors.ordinate.truncate(points);
    experiment.measurement.points.truncate(points);
    for point in &mut experiment.measurement.points {
        point.direction = Some(Direction::Approach);
    }
    let (branches, order, _) = experiment.assign(|own| level && own == Parameter::Baseline)?;
    Ok(Some(Assigned {
        experiment,
        branches,
        order,
        ..one.clone()
    }))
}

/// Gives the experiment the law of those tried that describes the data best, with the modulus
/// `matched` that goes with it.
pub(crate) fn give(starts: &mut Starts<'_>) -> Result<(), Error> {
    let (table, matched) = (starts.table, starts.matched);
    let (experiment, is_unknown) = (&mut starts.at.experiment, starts.is_unknown);
    let Some(relaxing) = &experiment.relaxing else {
        return Ok(());
    };
    let mut parameters = relaxing.parameters();
    if let Some(modulus) = matched
        && experiment.bodies.contact(table, &[]).is_err()
    {
        // Noise has led the elastic contact to a modulus that no film has: one of the right size is enough, because
        // the law that fits best also tells the modulus.
        let points = &experiment.measurement.points;
        let size = |value: fn(&Point) -> f64| range(points.iter().map(value));
        let stress = size(|point| point.ordinate) / size(|point| point.abscissa).powi(2);
        experiment.replace(modulus, stress)?;
    }
    parameters.retain(|&parameter| is_unknown(parameter));
    let mut found: Vec<(Parameter, f64)> = begin(experiment, is_unknown)?.into_iter().collect();
    // What the law that fits best leaves of the sum of squares, the factor of the loads with which it does, and the
    // experiment with it.
    let mut best: Option<(f64, f64, Experiment)> = None;
    let mut attempt = |contact_point: Option<f64>| {
        for values in candidates(experiment, &parameters) {
            let mut tried = experiment.clone();
            for (&parameter, value) in parameters.iter().zip(values) {
                tried.replace(parameter, value)?;
            }
            tried.contact_point = contact_point.unwrap_or(tried.contact_point);
            let Some((misfit, factor)) = misfit(table, &tried, matched.is_some()) else {
                continue;
            };
            if best.as_ref().is_none_or(|(least, ..)| misfit < *least) {
                best = Some((misfit, factor, tried));
            }
        }
        Ok::<_, Error>(best.as_ref().is_none_or(|(least, ..)| *least > POOR))
    };
    if attempt(None)? && is_unknown(Parameter::ContactPoint) {
        // Noise may hide where the contact begins.
        let turn = experiment.program().turn as f64;
        for part in PARTS {
            let point = &experiment.measurement.points[(part * turn) as usize];
            attempt(Some(point.abscissa))?;
        }
    }
    if let Some((_, factor, tried)) = best {
        if tried.contact_point != experiment.contact_point {
            parameters.push(Parameter::ContactPoint);
        }
        let values = parameters.iter().map(|&one| Some((one, tried.get(one)?)));
        found.extend(values.flatten());
        if let Some(modulus) = matched
            && let Some(value) = experiment.get(modulus)
        {
            found.push((modulus, factor * value));
        }
    }
    for (parameter, value) in found {
        starts.give(parameter, value)?;
    }
    Ok(())
}

/// Refuses data that begin in contact. Returns a contact point at the first point where it is found
/// a little before.
fn begin(
    experiment: &Experiment,
    is_unknown: IsUnknown<'_>,
) -> Result<Option<(Parameter, f64)>, Error> {
    let program = experiment.program();
    let (first, largest) = (program.points[0].1, program.points[program.turn].1);
    if first <= 0.0 || !is_unknown(Parameter::ContactPoint) {
        return Ok(None);
    }
    if first > hidden(experiment).max(BEGIN) * largest {
        return Err(experiment.not_fitted(BEGINS_IN_CONTACT));
    }
    let abscissa = experiment.measurement.points[0].abscissa;
    Ok(Some((Parameter::ContactPoint, abscissa)))
}

/// Refuses a contact point and a level of the baseline, both found, that too few points before the contact show; and
/// a contact point at the first point where the fit was `stopped`, because no history begins in contact.
pub(crate) fn accept_zeros(
    experiment: &Experiment,
    program: &Program,
    is_free: impl Fn(Parameter) -> bool,
    stopped: bool,
) -> Result<(), Error> {
    let has_contact_point = is_free(Parameter::ContactPoint);
    let are_free = has_contact_point && Parameter::LEVELS.into_iter().any(&is_free);
    let is_before = |point: &&(f64, f64)| point.1 <= 0.0;
    let before = program.points.iter().take_while(is_before).count();
    if are_free && before < FEWEST {
        return Err(experiment.not_fitted(NO_ZEROS));
    }
    if has_contact_point && stopped && before <= 1 {
        return Err(experiment.not_fitted(BEGINS_IN_CONTACT));
    }
    Ok(())
}

/// Returns the part of the largest imposed value up to which the loads are below their noise.
fn hidden(experiment: &Experiment) -> f64 {
    let points = experiment.measurement.points.iter();
    let loads: Vec<f64> = points
        .map(|point| point.ordinate - experiment.baseline_at(point.abscissa))
        .collect();
    let noise = experiment.usual_noise().or_else(|| noise_of(&loads));
    // The power of the penetration like which the load grows.
    let power = match &experiment.bodies.probe {
        flat if flat.contact_radii()[0] > 0.0 => 1.0,
        Probe::Paraboloid { .. } | Probe::Sphere { .. } | Probe::Profile(_) => 1.5,
        Probe::PowerLaw { exponent, .. } => 1.0 + 1.0 / exponent,
        _ => 2.0,
    };
    (noise.unwrap_or(0.0) / extremes(loads.into_iter())[1]).powf(1.0 / power)
}

/// Lists the values of parameters of the law that are tried.
fn candidates(experiment: &Experiment, parameters: &[Parameter]) -> Vec<Vec<f64>> {
    let times = &experiment.times;
    let duration = times.last().copied().unwrap_or(1.0) - times.first().copied().unwrap_or(0.0);
    let is_time = |one: &&Parameter| matches!(one, Parameter::Law(LawParameter::Time(_)));
    let count = parameters.iter().filter(is_time).count();
    let law = experiment.relaxing.iter().flat_map(Relaxing::parameters);
    let all_times = law.filter(|one| is_time(&one)).count();
    let is_weight = |one: &&Parameter| matches!(one, Parameter::Law(LawParameter::Weight(_)));
    let weights = parameters.iter().filter(is_weight).count();
    let values = |parameter: Parameter| -> Vec<f64> {
        match parameter {
            Parameter::Law(LawParameter::Exponent) if count > 0 => FEWER.to_vec(),
            Parameter::Law(LawParameter::Exponent) => EXPONENTS.to_vec(),
            Parameter::Law(LawParameter::RelaxedFraction) => FRACTIONS.to_vec(),
            Parameter::Law(LawParameter::Time(k)) if count > 1 => {
                let part = k as f64 / (count - 1) as f64;
                vec![duration * RANGE[0] * (RANGE[1] / RANGE[0]).powf(part)]
            }
            Parameter::Law(LawParameter::Time(_)) => TIMES.map(|part| part * duration).to_vec(),
            // Beside a time that is given, a weight tells which of the times is the shorter one.
            _ if count < all_times && weights == 1 => BESIDE.to_vec(),
            // A small part for each of several times: the first has the rest.
            _ => vec![0.35 / count.max(1) as f64],
        }
    };
    let mut all: Vec<Vec<f64>> = vec![Vec::new()];
    for &parameter in parameters {
        let values = values(parameter);
        let longer = all.iter().flat_map(|before| {
            let with = move |&value: &f64| [&before[..], &[value]].concat();
            values.iter().map(with)
        });
        all = longer.collect();
    }
    all
}

/// Returns the sum of squares with the best factor of the loads, over that of the loads, and this factor; `None` where the
/// model has no contact.
fn misfit(table: &Table, experiment: &Experiment, is_free: bool) -> Option<(f64, f64)> {
    let predicted = experiment.predict_with(&contacts_of(table), &[], &[], &[]);
    let predicted = predicted.ok()?;
    let points = &experiment.measurement.points;
    let pairs = points.iter().zip(&predicted.values);
    let pairs = pairs.map(|(point, value)| {
        let level = experiment.baseline_at(point.abscissa);
        [value - level, point.ordinate - level]
    });
    let sums = pairs.fold([0.0; 3], |[mm, my, yy], [m, y]| {
        [mm + m * m, my + m * y, yy + y * y]
    });
    let [mm, my, yy] = sums;
    let factor = if is_free { my / mm } else { 1.0 };
    let misfit = (yy - 2.0 * factor * my + factor * factor * mm) / yy;
    (factor > 0.0 && misfit.is_finite()).then_some((misfit, factor))
}
