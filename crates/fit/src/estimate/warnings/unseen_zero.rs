//! The doubts about a work of adhesion from loads whose zero the data do not show, or only seem to.

use super::wanted::column;
use crate::estimate::problem::Problem;
use crate::estimate::problem::assigned::Assigned;
use crate::estimate::problem::uncertainty::Uncertainty;
use crate::statistics::{extremes, median, robust_deviation};
use crate::{Branch, Fixed, Kind, Known, Parameter, Warning, WarningKind};

/// The part of the largest load by which the zero may be off.
const PART: f64 = 0.01;

/// Returns the zero of the load of an experiment of forces against positions all of whose points are in contact.
fn unseen(assigned: &Assigned) -> Option<Parameter> {
    let zero = match assigned.experiment.measurement.kind {
        Kind::LoadPenetration => Parameter::LoadOffset,
        Kind::ForceHeight => Parameter::Baseline,
        _ => return None,
    };
    (!assigned.branches.contains(&Branch::Baseline)).then_some(zero)
}

/// Tells whether a zero of the load that the data do not show is found beside a work of adhesion.
pub(crate) fn is_free_beside_a_work(problem: &Problem<'_>) -> bool {
    problem.assigned.iter().enumerate().any(|(e, assigned)| {
        let found = problem.parameters_of(e);
        unseen(assigned).is_some()
            && found.iter().any(|one| Parameter::LEVELS.contains(one))
            && found.iter().any(|one| one.is_work_of_adhesion())
    })
}

/// Returns the load of the points taken for the baseline of experiment `e` above the zero as it is read, N, where they may be
/// in contact, at the largest tension: loads below zero that nothing lies below, and that end soon.
///
/// None may be one of the approach, which begins off contact. From no load on, the load of JKR's contact on a half-space
/// falls to 0.8 of the largest tension over a distance that is 0.9 of that from there to the last contact. Behind a contact
/// that has ended a baseline goes on.
fn tension(problem: &Problem<'_>, e: usize, uncertainty: &Uncertainty) -> Option<f64> {
    /// The distance by which they go on over that over which the load has fallen to this part of the largest tension.
    const LONG: f64 = 1.7;
    const FALLEN: f64 = 0.8;
    /// The standard errors, and the scatters, by which a tension is clear, and the noises of a pull that shows.
    const CLEAR: [f64; 2] = [5.0, 3.0];
    const PULL: f64 = 4.0;
    /// The fewest points of a baseline, and the number of neighbours whose median has less noise.
    const FEWEST: usize = 3;
    const SMOOTH: usize = 5;
    /// Whether a point is off contact, a position that grows towards the contact, and a load.
    type Reading = (bool, f64, f64);
    let (own, found) = (&problem.assigned[e], problem.parameters_of(e));
    let experiment = &own.experiment;
    let kind = experiment.measurement.kind;
    let adheres = found.iter().any(|one| one.is_work_of_adhesion());
    if !kind.at_positions() || !adheres || experiment.relaxing.is_some() {
        return None;
    }
    let mut slots = problem.slots_of(e).into_iter();
    let free = slots.find(|&slot| Parameter::LEVELS.contains(&problem.slots[slot].parameter));
    let zero = free.map_or(0.0, |_| experiment.baseline_at(experiment.contact_point));
    // A contact without adhesion ends where the force does.
    let predicted = &problem.predicted.as_ref()?[e];
    let is_apart = |i: usize| match own.branches[i] {
        Branch::LeftOut => false,
        branch => !branch.is_contact() || predicted.radii[i] == 0.0,
    };
    let reading = |&i: &usize| {
        let point = &experiment.measurement.points[i];
        let load = point.ordinate - experiment.baseline_at(point.abscissa) + zero;
        (is_apart(i), experiment.sense() * point.abscissa, load)
    };
    let points: Vec<Reading> = own.order.iter().map(reading).collect();
    let baseline = points.iter().filter(|one| one.0).map(|one| one.2);
    let baseline: Vec<f64> = baseline.collect();
    let (level, scatter, error) = match free {
        Some(slot) => (zero, own.seen_noise(), uncertainty.error(slot)),
        None if baseline.len() < FEWEST => return None,
        None => {
            let level = median(baseline.clone());
            let scatter = robust_deviation(baseline.iter().map(|load| load - level));
            let scatter = scatter.max(own.seen_noise());
            (level, scatter, scatter / (baseline.len() as f64).sqrt())
        }
    };
    let unloading = own.unloading();
    let last = *own.order.last()?;
    let of_approach = |i: usize| !unloading[i] && (i == last || is_apart(i));
    let is_clear = -level > (CLEAR[0] * error).max(CLEAR[1] * scatter);
    if !is_clear || (0..unloading.len()).any(of_approach) {
        return None;
    }
    // The loads without much of their noise.
    let smooth = points.windows(SMOOTH).map(|near| {
        let (is_apart, position, _) = near[SMOOTH / 2];
        let loads = near.iter().map(|one| one.2);
        (is_apart, position, median(loads.collect()))
    });
    let smooth: Vec<Reading> = smooth.collect();
    let contacts = smooth.iter().filter(|one| !one.0);
    let lowest = extremes(contacts.map(|one| one.2))[0];
    let [begins, falls] = [0.0, FALLEN * lowest.min(level)].map(|load| {
        let below = smooth.iter().find(|one| one.2 <= load);
        below.map_or(f64::NAN, |one| one.1)
    });
    let goes_on = falls - points.last()?.1;
    (level - lowest < PULL * own.noise && goes_on < LONG * (begins - falls)).then_some(level)
}

/// Warns where no point is off contact, and a load whose zero is off by a hundredth of the largest one would change the
/// work of adhesion by more than its standard error. The fit cannot tell: a pull of the contact and a zero that is off
/// look nearly alike.
pub(crate) fn add(
    warnings: &mut Vec<Warning>,
    problem: &Problem<'_>,
    uncertainty: &Uncertainty,
    known: &[Known],
) {
    let is_known = |one: &Known| {
        Parameter::LEVELS
            .map(Fixed::Parameter)
            .contains(&one.quantity)
    };
    for (e, assigned) in problem.assigned.iter().enumerate() {
        let experiment = &assigned.experiment;
        if let Some(tension) = tension(problem, e, uncertainty) {
            warnings.push(WarningKind::ZeroNotSeen.with(format!(
                "{}: it is not clear whether any point is off contact: the points that are taken for the baseline, at \
                 {tension:.2e} N, may be the largest tension of a contact that has not ended, and then the work of adhesion \
                 is wrong. Measure on until the contact ends; or take the mean load far from the surface off, and keep the \
                 baseline fixed at 0",
                experiment.measurement.name
            )));
        }
        let found = problem.parameters_of(e);
        let is_found = found.iter().any(|one| Parameter::LEVELS.contains(one));
        let Some(zero) = unseen(assigned).filter(|_| !is_found && !known.iter().any(is_known))
        else {
            continue;
        };
        let loads = assigned.counting_points();
        let loads = loads.map(|i| experiment.measurement.points[i].ordinate.abs());
        let offset = PART * loads.fold(0.0, f64::max);
        let Some(column) = column(problem, e, zero, |_| true) else {
            continue;
        };
        let changes = uncertainty.changes_in_errors(&(column * offset));
        let works = problem.slots.iter().zip(changes);
        let mut works = works.filter(|(slot, _)| slot.parameter.is_work_of_adhesion());
        if let Some((slot, change)) = works.find(|(_, change)| change.abs() > 1.0) {
            warnings.push(WarningKind::ZeroNotSeen.with(format!(
                "{}: no point is off contact, so that the zero of the load is taken as it is given: one that is off by \
                 {offset:.1e} N, 1 % of the largest load, would change {} by {:+.1} of its standard errors. Take the mean \
                 load far from the surface off and state its error as that of a known value, or keep points from there \
                 and free {zero}",
                experiment.measurement.name,
                slot.parameter,
                change
            )));
        }
    }
}
