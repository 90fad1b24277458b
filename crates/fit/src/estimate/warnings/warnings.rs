//! The list of all doubts, and those of a value or of the method.

use contact::LawParameter;
use contact::Validity;
use contact::magnitude::{LARGEST_WORK, STIFFNESSES};

use super::agreement;
use super::assumptions;
use super::calibration;
use super::cycle;
use super::indentation;
use super::interfaces;
use super::lost_radii;
use super::prior;
use super::shape;
use super::table_error;
use super::unseen_zero;
use super::wanted;
use crate::estimate::left_out::{in_contact, text};
use crate::estimate::minima::minimum::Minimum;
use crate::estimate::minima::noise;
use crate::estimate::minima::profile::End;
use crate::estimate::minima::search::SHORT;
use crate::estimate::minima::valley::{Bend, TESTED};
use crate::estimate::problem::assigned::Assigned;
use crate::estimate::problem::no_adhesion;
use crate::estimate::problem::uncertainty::{UNDETERMINED, Uncertainty};
use crate::estimate::problem::{Ending, Problem};
use crate::estimate::relaxing;
use crate::magnitude;
use crate::statistics::{BEYOND_CHANCE, extremes};
use crate::{
    Combination, Estimate, Experiment, Fit, LayerQuantity, LeftOutReason, Loss, Options, Parameter,
    Warning, WarningKind,
};

/// The distance of a number from the end of what is possible at which it is there.
const NEAR_END: f64 = 1e-3;
/// The exponent of the speed of a contact line below which adhesion changes by less than 13 % at ten times the speed.
const NO_EXPONENT: f64 = 0.05;
/// The number of points in contact that may lie clearly beyond the end of the fitted branch.
const BEYOND_END: usize = 2;

/// Lists the doubts about a fit.
pub(crate) fn warnings(
    fit: &Fit,
    found: &Minimum<'_>,
    data: &[Assigned],
    options: &Options,
    intervals: Option<&[[End; 2]]>,
) -> Vec<Warning> {
    let mut warnings = Vec::new();
    let problem = &found.problem;
    let names = problem.slot_names();
    method(&mut warnings, fit, found, &names);
    super::twice::add(&mut warnings, problem);
    table_error::add(&mut warnings, fit, problem);
    if let Some(found) = &found.bend {
        warnings.push(bend(problem, &names[found.slot], found));
    }
    warnings.extend(fit.estimates.iter().filter_map(implausible));
    let mut at_zero = Vec::new();
    if let Some(uncertainty) = &found.uncertainty {
        let stopped = at_bounds(&mut warnings, problem, &names);
        at_zero = no_adhesion::add(&mut warnings, problem, &names);
        if found.is_stopped(SHORT) && !stopped && at_zero.is_empty() {
            warnings.push(end_of_table(problem, uncertainty.short));
        }
        undetermined(&mut warnings, fit, problem, (uncertainty, &names, &at_zero));
        interfaces::add(&mut warnings, found, uncertainty);
        left_out(&mut warnings, fit, data);
        if let Some(residuals) = problem.plain_residuals() {
            let beside = (&residuals, &uncertainty.leverages[..]);
            let unequal = agreement::add(&mut warnings, fit, problem, beside);
            prior::add(&mut warnings, problem, uncertainty, &residuals);
            noise::add(&mut warnings, fit, problem, uncertainty);
            outliers(&mut warnings, fit, data, (&unequal, problem.loss));
            wanted::add(&mut warnings, problem, uncertainty, &residuals);
        }
        unseen_zero::add(&mut warnings, problem, uncertainty, &options.known);
        warnings.extend(receding_below(fit));
        indentation::of_hardness(&mut warnings, problem, uncertainty);
        warnings.extend(shape::doubt(
            problem,
            uncertainty,
            Validity::WARNING_A_OVER_R,
        ));
    }
    warnings.extend(calibration::doubts(
        &names,
        &fit.estimates,
        &fit.fixed_values,
    ));
    for (e, whole) in data.iter().enumerate() {
        let range = options.interaction_range;
        let broken = assumptions::of_problem(problem, e, range, &fit.estimates);
        warnings.extend(broken.into_iter().flatten());
        warnings.extend(cycle::doubts(problem, e).into_iter().flatten());
        warnings.extend(super::pinned::doubt(&problem.assigned[e]));
        relaxing::add(&mut warnings, fit, problem, e);
        if let Some(uncertainty) = &found.uncertainty {
            warnings.extend(super::unseen_pull::doubt(problem, e, uncertainty, whole));
        }
    }
    if fit.converged {
        indentation::add(&mut warnings, fit, problem);
    }
    for (i, ends) in intervals.into_iter().flatten().enumerate() {
        let may_be_zero = at_zero.contains(&i);
        open_ends(&mut warnings, problem, (i, &names[i]), ends, may_be_zero);
    }
    warnings.extend(relaxing::of_one_size(problem));
    // What the data say comes before what the model leaves out in all data.
    warnings.sort_by_key(|one| one.kind.is_of_model());
    // Of several files the first one tells of surface tension.
    let mut is_told = false;
    warnings.retain(|one| {
        one.kind != WarningKind::SurfaceTension || !std::mem::replace(&mut is_told, true)
    });
    warnings
}

/// Warns of a receding work of adhesion that is below that of approach by more than chance.
fn receding_below(fit: &Fit) -> Option<Warning> {
    let place = |parameter| {
        let mut estimates = fit.estimates.iter();
        estimates.position(|one| one.parameter == parameter)
    };
    let [i, j] = [
        place(Parameter::WorkOfAdhesion)?,
        place(Parameter::WorkOfAdhesionReceding)?,
    ];
    let [advancing, receding] = [i, j].map(|i| &fit.estimates[i]);
    let [one, other] = [advancing, receding].map(|estimate| estimate.standard_error);
    let error = (one * one + other * other - 2.0 * fit.correlation[i][j] * one * other).sqrt();
    let below = advancing.value - receding.value;
    (advancing.experiment == receding.experiment && below > BEYOND_CHANCE * error).then(|| {
        WarningKind::MixedBranches.with(format!(
            "{} is below {} by {:.1} of its standard errors, and no contact gives back more energy on retract than it took: \
             check the directions of the points, and whether the zero of the load or the position drifts during the \
             measurement",
            receding.parameter,
            advancing.parameter,
            below / error
        ))
    })
}

/// Says that a fit ended `short` of the least squares, by standard errors, because contacts are refused beyond.
fn end_of_table(problem: &Problem<'_>, short: f64) -> Warning {
    let reason = if problem.beyond_table {
        "the table ends there; fix a parameter or use a larger table"
    } else {
        let mut experiments = problem.experiments();
        let is_sphere = |one: &Experiment| one.bodies.end_of_exact_sphere().is_some();
        if experiments.clone().any(is_sphere) {
            "beyond these values the contact does not exist or is not solved: the exact sphere is solved on a film up to contact \
             radii of 0.55 R; leave out the points of wider contacts, fix a parameter, or give it another start"
        } else if experiments.any(|one| one.relaxing.is_some()) {
            "beyond these values the contact does not exist, because no history begins in contact, or is not solved; keep more \
             points from before the contact, or fix a parameter"
        } else {
            "beyond these values the contact does not exist or is not solved; fix a parameter, or give it another start"
        }
    };
    WarningKind::EndOfTable.with(format!(
        "the fit stopped {short:.1} standard errors before the smallest sum of squares: {reason}"
    ))
}

/// Says why the interval of a slot has no end on a side, or two. One that `may_be_zero` begins at 0.
fn open_ends(
    warnings: &mut Vec<Warning>,
    problem: &Problem<'_>,
    (slot, name): (usize, &str),
    ends: &[End; 2],
    may_be_zero: bool,
) {
    let unit = problem.slots[slot].parameter.after_number();
    for (side, end) in ["lower", "upper"].into_iter().zip(ends) {
        let why = match end {
            End::At(_) => continue,
            End::Open(_) if side == "lower" && may_be_zero => continue,
            End::Open(value) => format!(
                "the data do not rule out {value:.3e}{unit}, the farthest value that was looked at"
            ),
            End::Failed(value) => {
                format!("at {value:.3e}{unit} the other parameters have no fit")
            }
        };
        warnings.push(WarningKind::OpenInterval.with(format!(
            "the interval of {name} has no {side} end: {why}; fix a parameter, or \
             give it a prior"
        )));
    }
}

/// Doubts about the way to the minimum.
fn method(warnings: &mut Vec<Warning>, fit: &Fit, found: &Minimum<'_>, names: &[String]) {
    if found.problem.ending != Ending::Converged {
        let how = match found.problem.ending {
            Ending::OutOfPatience => "was still moving",
            _ => "stopped where the model has no contact or no derivatives",
        };
        let advice = if unseen_zero::is_free_beside_a_work(&found.problem) {
            "without points off contact a load-offset and a work of adhesion are hardly told apart: keep such points, or fix \
             one of them"
        } else {
            "free fewer parameters, or start from other values"
        };
        warnings.push(WarningKind::NotConverged.with(format!(
            "the fit did not converge: it {how} after {} evaluations; {advice}",
            fit.evaluations
        )));
    }
    for rival in &found.rivals {
        let estimates = fit.estimates.iter().zip(names).zip(&rival.values);
        let values: Vec<String> = estimates
            .map(|((estimate, name), value)| {
                format!("{name} = {value:.3e} {}", estimate.parameter.unit())
            })
            .collect();
        warnings.push(WarningKind::SeveralMinima.with(format!(
            "there is another minimum, whose chi^2 is larger by {:.1}, which is within \
             chance: {}; fix a parameter, or give it a prior or bounds",
            rival.excess.max(0.0),
            values.join(", ")
        )));
    }
}

/// Warns of a value that may be farther away than its standard error says.
fn bend(problem: &Problem<'_>, name: &str, bend: &Bend) -> Warning {
    let parameter = problem.slots[bend.slot].parameter;
    WarningKind::NonlinearError.with(format!(
        "the standard error of {name} is too small on one side: {:.3e} {}, {} standard \
         errors away, would raise chi^2 by {:.1} only, not by {}; take the interval of the \
         profile likelihood, or give a prior",
        bend.value,
        parameter.unit(),
        TESTED,
        bend.growth,
        TESTED * TESTED
    ))
}

/// Warns of values that no experiment has, and of works of adhesion and stiffnesses that none
/// measures.
fn implausible(estimate: &Estimate) -> Option<Warning> {
    if let Some(found) = magnitude::of_estimate(estimate) {
        return Some(WarningKind::Implausible.with(found.to_string()));
    }
    let [least, most] = match estimate.parameter {
        Parameter::WorkOfAdhesion | Parameter::WorkOfAdhesionReceding => [1e-6, LARGEST_WORK],
        Parameter::Stiffness => STIFFNESSES,
        _ => return None,
    };
    let determined = estimate.standard_error < UNDETERMINED * estimate.value;
    (determined && !(least..=most).contains(&estimate.value)).then(|| {
        let (parameter, unit) = (estimate.parameter, estimate.parameter.unit());
        WarningKind::Implausible.with(format!(
            "{parameter} = {:.3e} {unit} is outside {least:e} to {most:e} {unit}: check the \
             units of the data",
            estimate.value
        ))
    })
}

/// Warns of values at their bounds. Tells whether there are any.
fn at_bounds(warnings: &mut Vec<Warning>, problem: &Problem<'_>, names: &[String]) -> bool {
    let mut any = false;
    for (i, slot) in problem.slots.iter().enumerate() {
        let value = problem.value(i);
        if slot.coordinate.is_at_bound(value) {
            any = true;
            let unit = slot.parameter.after_number();
            let [least, most] = match slot.parameter {
                Parameter::FilmPoissonRatio => [-1.0, 0.5],
                Parameter::Law(LawParameter::RelaxedFraction) => [0.0, 1.0],
                _ => [f64::NEG_INFINITY, f64::INFINITY],
            };
            // A true value at the end of what is possible is found there in every second measurement.
            let why = if value - least < NEAR_END || most - value < NEAR_END {
                "the end of what is possible, and its standard error does not hold there: fix it there, or give it a prior"
            } else {
                "its bound: a value beyond it would describe the data better"
            };
            let name = &names[i];
            warnings
                .push(WarningKind::AtBound.with(format!("{name} = {value:.4e}{unit} is at {why}")));
        }
    }
    any
}

/// Warns of parameters and combinations that the data do not determine.
fn undetermined(
    warnings: &mut Vec<Warning>,
    fit: &Fit,
    problem: &Problem<'_>,
    (uncertainty, names, at_zero): (&Uncertainty, &[String], &[usize]),
) {
    for (i, estimate) in fit.estimates.iter().enumerate() {
        // With what the errors of known values add.
        let error = estimate.standard_error / uncertainty.sizes[i];
        // Not `>`, which is false for NaN.
        if error <= UNDETERMINED || at_zero.contains(&i) {
            continue;
        }
        let parameter = estimate.parameter;
        let of = match parameter {
            _ if parameter.is_positive() => "its value",
            Parameter::FrameCompliance => "one over the range of the stiffnesses",
            // These are numbers between 0 and 1.
            Parameter::FilmPoissonRatio
            | Parameter::Law(LawParameter::RelaxedFraction | LawParameter::Exponent) => "1",
            _ => "the range of the data",
        };
        let size = if error < 100.0 {
            format!("{:.0} % of", 1e2 * error)
        } else {
            "more than 100 times".into()
        };
        warnings.push(WarningKind::Undetermined.with(format!(
            "{} is not determined by these data: its standard error is {size} \
             {of}, above {:.0} %; fix it or give a prior",
            names[i],
            1e2 * UNDETERMINED
        )));
        if parameter == Parameter::SpeedExponent && estimate.value < NO_EXPONENT {
            warnings.push(WarningKind::Undetermined.with(format!(
                "with {} near 0 adhesion does not depend on the speed but on the way alone: fit a work of adhesion of its own \
                 for each way (work-of-adhesion-receding) in place of doubling-speed and speed-exponent",
                names[i]
            )));
        }
        let is_other = matches!(
            parameter,
            Parameter::SphereModulus | Parameter::Layer(_, LayerQuantity::InterfaceStiffness)
        );
        if parameter.is_of_bodies() && !is_other {
            warnings.extend(film_not_seen(problem, parameter));
        }
    }
    let combinations = fit.undetermined.iter();
    for text in Combination::texts(combinations.filter(|one| one.weights.len() > 1)) {
        warnings.push(WarningKind::Undetermined.with(format!(
            "the data do not determine {text} apart from one another: fix one of them or give a prior"
        )));
    }
}

/// Says how large the contacts are beside a film that the data do not tell.
fn film_not_seen(problem: &Problem<'_>, parameter: Parameter) -> Option<Warning> {
    let of_experiment = |e: usize| {
        let thickness = problem.assigned[e].experiment.bodies.thickness()?;
        let radii = problem.contact_radii(e)?;
        (radii[1] > 0.0).then(|| radii.map(|radius| radius / thickness))
    };
    let ratios = (0..problem.assigned.len()).filter_map(of_experiment);
    let [least, most] = extremes(ratios.flatten());
    (most > 0.0).then(|| {
        WarningKind::FilmNotSeen.with(format!(
            "a/t is from {least:.2e} to {most:.2e}, where these data do not tell {parameter}: \
             a film is told from its substrate best by contacts from well below to well above \
             its thickness"
        ))
    })
}

/// Warns of points far from the fit. `unequal` tells of each experiment whether its noise is larger in one part
/// than in another: a robust loss would take the quiet part for the rule, and the other one for outliers.
fn outliers(
    warnings: &mut Vec<Warning>,
    fit: &Fit,
    data: &[Assigned],
    (unequal, loss): (&[bool], Loss),
) {
    let experiments = fit.experiments.iter().zip(data).zip(unequal);
    for ((fitted, whole), unequal) in experiments {
        if let Some(lost) = lost_radii::doubt(whole) {
            warnings.push(lost);
            continue;
        }
        let far = fitted.points.iter().filter(|point| point.outlier);
        let far: Vec<u64> = far.map(|point| point.line).collect();
        if far.is_empty() {
            continue;
        }
        let counting = fitted.points.iter().filter(|point| point.fit.is_some());
        let counting = counting.count();
        // Where many points are far off, the model is wrong and not the points.
        let remedy = if *unequal || loss != Loss::Squares || far.len() > counting / 4 {
            ""
        } else {
            "; a robust loss gives them less weight"
        };
        warnings.push(WarningKind::Outliers.with(format!(
            "{}: {} of {} points are far from the fit, in {}{remedy}",
            fitted.name,
            far.len(),
            counting,
            whole.experiment.measurement.numbering.names(&far)
        )));
    }
}

/// Warns of points that are in contact in the data and clearly not in the fit.
fn left_out(warnings: &mut Vec<Warning>, fit: &Fit, data: &[Assigned]) {
    for (fitted, whole) in fit.experiments.iter().zip(data) {
        let beyond = fitted.left_out.iter();
        let beyond = beyond.filter(|group| group.reason == LeftOutReason::BeyondEnd);
        let [contacts, lost] = in_contact(whole, &fitted.left_out);
        let beyond: usize = beyond.map(|group| group.points).sum();
        if beyond > BEYOND_END {
            warnings.push(WarningKind::LeftOut.with(format!(
                "{}: {lost} of {contacts} points in contact do not count; of all points are left \
                 out: {}",
                fitted.name,
                text(&fitted.left_out, whole.experiment.measurement.numbering)
            )));
        }
    }
}
