//! The doubts about a fit of contact stiffness.

use super::wanted::column;
use crate::estimate::problem::assigned::Assigned;
use crate::estimate::problem::uncertainty::Uncertainty;
use crate::estimate::problem::{Ending, Problem};
use crate::statistics::{extremes, likeness_of_neighbours, median};
use crate::{
    ContactDepth, Estimate, Fit, Indentation, Kind, LossAngle, Parameter, Warning, WarningKind,
};

/// The most evaluations of the fit with the other contact depth, over the number of parameters + 1,
/// and the relative changes at which it ends.
const PATIENCE: usize = 30;
const TOLERANCE: f64 = 1e-6;
/// The contact depth over the depth from which a contact counts as plastic: that of an elastic cone
/// is 0.64.
const PLASTIC: f64 = 0.9;
/// The change of the hardness from the smallest load to the largest one whose effect is told.
const CHANGE: f64 = 0.1;
/// The largest contact depth over the thickness of the film.
const DEEP: f64 = 0.5;

/// The standard deviations by which misfits of neighbouring phases are alike from which on the model is doubted: one sound
/// fit in 4000 exceeds them. Fewer than 10 phases never do.
const ALIKE: f64 = 3.5;
/// The misfit over the phases below which the error of the expansion in the loss angle may be the reason.
const EXACT: f64 = 0.01;

/// Adds the doubts.
pub(crate) fn add(warnings: &mut Vec<Warning>, fit: &Fit, problem: &Problem<'_>) {
    let mut of_depth = Vec::new();
    for (assigned, fitted) in problem.assigned.iter().zip(&fit.experiments) {
        if let Some(loss) = fitted.loss {
            of_phases(warnings, problem, assigned, loss);
        }
        let experiment = &assigned.experiment;
        if experiment.measurement.kind != Kind::StiffnessDepth {
            continue;
        }
        let name = &experiment.measurement.name;
        let depths = experiment.contact_depths();
        let points = experiment.measurement.points.iter();
        let parts = points
            .zip(&depths)
            .map(|(point, depth)| depth / point.abscissa);
        of_depth.push((name, median(parts.collect())));
        let deepest = depths.iter().copied().fold(0.0, f64::max);
        let thickness = experiment.bodies.top_thickness();
        if let Some(thickness) = thickness.filter(|&thickness| deepest > DEEP * thickness) {
            warnings.push(WarningKind::DeepContact.with(format!(
                "{name}: the contact depth reaches {:.0} % of the thickness of the film, above \
                 {:.0} %: under the tip the film is thinner than the model takes it to be; \
                 leave out the deepest points, or thin the film by a part of the contact depth",
                1e2 * deepest / thickness,
                1e2 * DEEP
            )));
        }
    }
    if of_depth.is_empty() {
        return;
    }
    let Some((used, changed)) = other_depth(fit, problem) else {
        return;
    };
    for (before, after) in changed {
        let change = after / before.value - 1.0;
        let mut text = format!(
            "{} depends on how the contact radius follows from the depth: {:.4e} Pa by {}, {:.4e} Pa \
             by {}, {:+.0} %, which is more than its standard error: no model of the layers decides \
             between them; measure the contact area, or compare with a fit of one hardness",
            before.parameter,
            before.value,
            used.name(),
            after,
            used.other().name(),
            1e2 * change
        );
        let plastic = of_depth.iter().filter(|(_, part)| *part > PLASTIC);
        for (name, part) in plastic {
            text += &format!(
                ". {name}: the contact is plastic (contact depth over depth {part:.2}, an elastic one \
                 has 0.64), and the material may pile up around the tip"
            );
        }
        warnings.push(WarningKind::ContactDepth.with(text));
    }
}

/// Warns where one hardness stands for all loads, and a hardness that changes with the load would change a modulus by more
/// than its standard error, to the first order.
pub(crate) fn of_hardness(
    warnings: &mut Vec<Warning>,
    problem: &Problem<'_>,
    uncertainty: &Uncertainty,
) {
    let rows = problem.rows_of_experiments();
    for (e, (assigned, rows)) in problem.assigned.iter().zip(rows).enumerate() {
        let experiment = &assigned.experiment;
        let Some(slot) = problem.slot_of(Parameter::Hardness) else {
            return;
        };
        let column = column(problem, e, Parameter::Hardness, |_| true);
        let (Kind::StiffnessLoad, Some(mut change)) = (experiment.measurement.kind, column) else {
            continue;
        };
        let load = |i: usize| experiment.measurement.points[i].abscissa.ln();
        let [least, most] = extremes(assigned.counting_points().map(load));
        for (row, i) in rows.zip(assigned.counting_points()) {
            let place = (load(i) - least) / (most - least) - 0.5;
            change[row] *= CHANGE * place * problem.value(slot);
        }
        let changes = uncertainty.changes_in_errors(&change);
        for (i, (slot, change)) in problem.slots.iter().zip(changes).enumerate() {
            if slot.parameter.is_modulus() && change.abs() > 1.0 {
                warnings.push(WarningKind::OneHardness.with(format!(
                    "{}: one hardness is taken for all loads: if it rose by {:.0} % from the smallest load to the largest, {} \
                     would change by {:+.1} %, {change:+.1} of its standard errors. Hardness depends on the depth in many \
                     films: compare the load over the contact area at small and large depths, or fit the stiffness against \
                     the depth, with the area of the tip",
                    experiment.measurement.name,
                    1e2 * CHANGE,
                    slot.parameter,
                    1e2 * change * uncertainty.relative_error(i)
                )));
            }
        }
    }
}

/// Doubts phases that no film causes, and those that do not have the course of the fit.
fn of_phases(warnings: &mut Vec<Warning>, problem: &Problem<'_>, of: &Assigned, loss: LossAngle) {
    let name = &of.experiment.measurement.name;
    let tangent = loss.tangent();
    if tangent + (2.0 * loss.tangent_error()).max(0.0) < 0.0 {
        warnings.push(WarningKind::Implausible.with(format!(
            "{name}: the phases give the film a loss tangent of {tangent:.3}, and no film gives back more energy than it \
             took: change the sign of phases that count in the opposite sense"
        )));
    }
    let order = (&of.branches[..], &of.order[..]);
    let Ok(both) = of
        .experiment
        .phases_beside(&problem.contact_of(), order, loss.angle)
    else {
        return;
    };
    let misfits: Vec<f64> = both.iter().map(|[read, fitted]| read - fitted).collect();
    let squares = |numbers: &[f64]| numbers.iter().map(|x| x * x).sum::<f64>();
    let fitted: Vec<f64> = both.iter().map(|[_, fitted]| *fitted).collect();
    let part = (squares(&misfits) / squares(&fitted)).sqrt();
    if part > EXACT
        && let Some([deviations, ratio]) = likeness_of_neighbours(&misfits)
        && deviations > ALIKE
    {
        warnings.push(WarningKind::PoorFit.with(format!(
            "{name}: the model does not describe the phases to the noise that neighbouring ones show: the mean square of \
             the misfits is {ratio:.1} times that of this noise, and the loss tangent is not what its standard error \
             says. Of the bodies only the film or top layer is taken to have a loss: where the phases are those of \
             several bodies, or of the instrument, fit the absolute value of the stiffness without phases"
        )));
    }
}

/// Fits with the other definition of the contact depth. Returns the definition that was used, and the
/// moduli that change by more than their standard errors, with their values by the other one.
fn other_depth(fit: &Fit, problem: &Problem<'_>) -> Option<(ContactDepth, Vec<(Estimate, f64)>)> {
    let mut other = problem.clone();
    let mut used = None;
    for assigned in &mut other.assigned {
        if assigned.experiment.measurement.kind == Kind::StiffnessDepth {
            let Indentation { contact_depth, .. } = &mut assigned.experiment.indentation;
            used.get_or_insert(*contact_depth);
            *contact_depth = contact_depth.other();
        }
    }
    other.update().ok()?;
    let other = other.minimise(PATIENCE, TOLERANCE);
    if other.ending != Ending::Converged {
        return None;
    }
    let is_of_sample = |one: Parameter| one.is_modulus() && one != Parameter::SphereModulus;
    let estimates = fit.estimates.iter().enumerate();
    let changed = estimates.filter(|(_, one)| is_of_sample(one.parameter));
    let changed = changed.map(|(i, one)| (*one, other.value(i)));
    let is_large =
        |(before, after): &(Estimate, f64)| (after - before.value).abs() > before.standard_error;
    Some((used?, changed.filter(is_large).collect()))
}
