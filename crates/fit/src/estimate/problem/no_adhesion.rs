//! Where adhesion changes nothing that is measured: works of adhesion that ended at 0, and the doubt about them.

use std::f64::consts::PI;

use contact::Contact;

use super::problem::Problem;
use super::uncertainty::Uncertainty;
use crate::{Experiment, Kind, Warning, WarningKind};

/// The part of the range of the loads by which a work of adhesion that ended at 0 changes a load.
const NO_ADHESION: f64 = 1.4e-4;

/// Tells whether a work of adhesion ended at 0, from the contact and the largest contact radius `a` of an
/// experiment: at this radius adhesion changes the load by about `sqrt(4 pi w S) a`, with the stiffness `S` of the
/// contact. That is JKR's change on a half-space, and more than the change on a film that is thin beside `a`.
pub(crate) fn is_none(
    experiment: &Experiment,
    contact: &Contact,
    a: f64,
    work_of_adhesion: f64,
) -> bool {
    let kind = experiment.measurement.kind;
    let by_adhesion = |stiffness: f64| a * (4.0 * PI * work_of_adhesion * stiffness).sqrt();
    !kind.is_stiffness()
        && kind != Kind::PenetrationRadius
        && contact.stiffness(a).is_ok_and(|stiffness| {
            by_adhesion(stiffness) < NO_ADHESION * experiment.compared_range()
        })
}

/// Returns the work of adhesion of a slot that changes the load at the largest contact radius by a `part` of the range of
/// the loads, as in [`is_none`]; `None` without a contact.
pub(crate) fn work_of_part(problem: &Problem<'_>, slot: usize, part: f64) -> Option<f64> {
    let e = problem.slots[slot].experiment.unwrap_or(0);
    let experiment = &problem.assigned[e].experiment;
    let [_, a] = problem.contact_radii(e)?;
    let contact = problem.contact(&experiment.bodies, false).ok()?;
    let stiffness = contact.stiffness(a).ok()?;
    Some((part * experiment.compared_range() / a).powi(2) / (4.0 * PI * stiffness))
}

/// Lists the slots of the works of adhesion that ended at 0, which their logarithms never reach.
pub(crate) fn ended_at_zero(problem: &Problem<'_>) -> Vec<usize> {
    let is_at_zero = |&i: &usize| {
        let (slot, value) = (&problem.slots[i], problem.value(i));
        let is_work = slot.parameter.is_work_of_adhesion();
        let mut own = (problem.assigned.iter().enumerate())
            .filter(|(e, _)| slot.experiment.is_none_or(|own| own == *e));
        let ended = |e: usize, experiment: &Experiment| {
            let [_, a] = problem.contact_radii(e)?;
            let contact = problem.contact(&experiment.bodies, false).ok()?;
            Some(is_none(experiment, &contact, a, value))
        };
        is_work && own.all(|(e, assigned)| ended(e, &assigned.experiment) == Some(true))
    };
    (0..problem.slots.len()).filter(is_at_zero).collect()
}

/// Returns the uncertainty where works of adhesion ended at 0; `None` where none did. They are held there, as if they were
/// fixed. Their own errors are those of works that change next to nothing: where rounding hides a work, it hides its
/// derivatives, too.
pub(crate) fn uncertainty(problem: &Problem<'_>) -> Option<Uncertainty> {
    /// The part of [`NO_ADHESION`] by which they change a load.
    const NEXT_TO_NOTHING: f64 = 0.1;
    let ended = ended_at_zero(problem);
    if ended.is_empty() {
        return None;
    }
    let mut place = problem.clone();
    for &slot in &ended {
        let work = work_of_part(problem, slot, NEXT_TO_NOTHING * NO_ADHESION)?;
        let work = work.max(problem.value(slot));
        place.x[slot] = problem.slots[slot].coordinate.of(work);
    }
    place.update().ok()?;
    Some(Uncertainty::of(&place)?.holding(&ended))
}

/// Warns of works of adhesion that ended at 0. Returns their slots.
pub(crate) fn add(
    warnings: &mut Vec<Warning>,
    problem: &Problem<'_>,
    names: &[String],
) -> Vec<usize> {
    let ended = ended_at_zero(problem);
    for &i in &ended {
        let (name, value) = (&names[i], problem.value(i));
        warnings.push(WarningKind::AtBound.with(format!(
            "{name} = {value:.1e} J/m^2 ended at 0, its bound: the points that are fitted \
             show no adhesion. Its standard error does not hold there, and those of the other parameters are \
             those without adhesion; fix it at 0, give it a prior, or measure the pull-off; the upper end of its interval \
             from the profile of the likelihood is the largest that the data allow"
        )));
    }
    ended
}
