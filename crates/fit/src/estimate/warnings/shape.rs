//! The doubt that a paraboloid stands for a sphere.

use interp::Probe;

use crate::estimate::fixed_values::residuals_of;
use crate::estimate::problem::Problem;
use crate::estimate::problem::uncertainty::Uncertainty;
use crate::{Bodies, Warning, WarningKind};

/// The contact radius over that of the sphere below which the shapes differ by less than 0.1 % of the penetration.
const SMALL: f64 = 0.05;
/// The change of a value, in parts of itself, from which on the shape matters, if it is more than its standard error: that
/// of a radius of the sphere that is off by some per cent.
const MATTERS: f64 = 0.03;

/// Warns if the exact sphere in place of the paraboloid would change a modulus or a work of adhesion by more than its
/// standard error and more than 3 %, to the first order, in experiment `e`. `largest` is the `a/R` above which another warning tells of the paraboloid.
pub(crate) fn doubt(
    problem: &Problem<'_>,
    e: usize,
    uncertainty: &Uncertainty,
    largest: f64,
) -> Option<Warning> {
    let experiment = &problem.assigned[e].experiment;
    let &Probe::Paraboloid { radius } = experiment.bodies.probe() else {
        return None;
    };
    let [_, a] = problem.contact_radii(e)?;
    let is_solved = matches!(experiment.bodies, Bodies::Coated(_) | Bodies::HalfSpace(_));
    if !is_solved || a < SMALL * radius || a > largest * radius {
        return None;
    }
    let spherical = residuals_of(problem, |own| {
        if own.bodies.probe() == experiment.bodies.probe() {
            *own.bodies.probe_mut() = Probe::Sphere { radius };
        }
        Ok(())
    })?;
    let changes = uncertainty.changes_in_errors(&(spherical - problem.plain_residuals()?));
    let names = problem.slot_names();
    let large = changes.iter().enumerate().filter_map(|(slot, change)| {
        let part = change * uncertainty.relative_error(slot);
        let is_large = change.abs() > 1.0 && part.abs() > MATTERS;
        (problem.slots[slot].parameter.is_positive() && is_large).then(|| {
            let name = &names[slot];
            format!(
                "{name} by {:+.1} %, {change:+.1} of its standard errors",
                1e2 * part
            )
        })
    });
    let large: Vec<String> = large.collect();
    (!large.is_empty()).then(|| {
        WarningKind::LargeContact.with(format!(
            "{}: a/R reaches {:.2}, and the model takes the sphere for a paraboloid: the exact sphere, which is a probe of its \
             own, would change {}; fit it",
            experiment.measurement.name,
            a / radius,
            large.join(" and ")
        ))
    })
}
