//! The doubt that a paraboloid stands for a sphere.

use interp::Probe;

use crate::estimate::fixed_values::residuals_of;
use crate::estimate::problem::Problem;
use crate::estimate::problem::uncertainty::Uncertainty;
use crate::{Experiment, Warning, WarningKind};

/// The contact radius over that of the sphere below which the shapes differ by less than 0.1 % of the penetration.
const SMALL: f64 = 0.05;
/// The change of a value, in parts of itself, from which on the shape matters, if it is more than its standard error: that
/// of a radius of the sphere that is off by some per cent.
const MATTERS: f64 = 0.03;
/// The standard error over the value up to which the first order tells anything.
const TOLD: f64 = 0.3;
/// The change over the value above which the first order tells no more than that the change is larger than this: it told -95
/// and -54 % where fits changed by -72 and -39 %.
const LINEAR: f64 = 0.3;

/// Warns if the exact sphere in place of the paraboloid would change a modulus or a work of adhesion by more than its
/// standard error and more than 3 %, to the first order. All experiments on a half-space or a film, with contacts of up to
/// `largest` of `a/R`, above which another warning tells of the paraboloid, are changed together.
pub(crate) fn doubt(
    problem: &Problem<'_>,
    uncertainty: &Uncertainty,
    largest: f64,
) -> Option<Warning> {
    let mut widest = 0.0_f64;
    for (e, experiment) in problem.experiments().enumerate() {
        if let Some(radius) = sphere(experiment) {
            let [_, a] = problem.contact_radii(e)?;
            widest = widest.max(a / radius);
        }
    }
    if widest < SMALL || widest > largest {
        return None;
    }
    let spherical = residuals_of(problem, |own| {
        if let Some(radius) = sphere(own) {
            own.bodies.probe = Probe::Sphere { radius };
        }
        Ok(())
    })?;
    let changes = uncertainty.changes_in_errors(&(spherical - problem.plain_residuals()?));
    let names = problem.slot_names();
    let large = changes.iter().enumerate().filter_map(|(slot, change)| {
        let error = uncertainty.relative_error(slot);
        let part = change * error;
        let is_large = change.abs() > 1.0 && part.abs() > MATTERS && error < TOLD;
        (problem.slots[slot].parameter.is_positive() && is_large).then(|| {
            let name = &names[slot];
            if part.abs() > LINEAR {
                let way = if part > 0.0 { "upwards" } else { "downwards" };
                return format!("{name} {way} by more than {:.0} %", 1e2 * LINEAR);
            }
            format!(
                "{name} by about {:+.1} %, {change:+.1} of its standard errors",
                1e2 * part
            )
        })
    });
    let large: Vec<String> = large.collect();
    (!large.is_empty()).then(|| {
        WarningKind::LargeContact.with(format!(
            "a/R reaches {widest:.2}, and the model takes the sphere for a paraboloid: the exact sphere, which is a probe of its \
             own, would change {}; fit it",
            large.join(" and ")
        ))
    })
}

/// Returns the radius of a sphere (m) whose paraboloid an experiment takes, where the exact sphere is solved.
fn sphere(experiment: &Experiment) -> Option<f64> {
    match experiment.bodies.probe {
        Probe::Paraboloid { radius } if !experiment.bodies.are_layered() => Some(radius),
        _ => None,
    }
}
