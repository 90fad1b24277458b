//! The doubt about a work of adhesion from loads whose zero the data do not show.

use super::wanted::column;
use crate::estimate::problem::Problem;
use crate::estimate::problem::assigned::Assigned;
use crate::estimate::problem::uncertainty::Uncertainty;
use crate::{Branch, Fixed, Kind, Known, Parameter, Warning, WarningKind};

/// The part of the largest load by which the zero may be off.
const PART: f64 = 0.01;

const ZERO: Parameter = Parameter::LoadOffset;

/// Tells whether all points of an experiment of loads at penetrations are in contact.
fn is_unseen(assigned: &Assigned) -> bool {
    assigned.experiment.measurement.kind == Kind::LoadPenetration
        && !assigned.branches.contains(&Branch::Baseline)
}

/// Tells whether a zero of the load that the data do not show is found beside a work of adhesion.
pub(crate) fn is_free_beside_a_work(problem: &Problem<'_>) -> bool {
    problem.assigned.iter().enumerate().any(|(e, assigned)| {
        let found = problem.parameters_of(e);
        is_unseen(assigned)
            && found.contains(&ZERO)
            && found.iter().any(|one| one.is_work_of_adhesion())
    })
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
    let is_known = |one: &Known| one.quantity == Fixed::Parameter(ZERO);
    for (e, assigned) in problem.assigned.iter().enumerate() {
        let experiment = &assigned.experiment;
        if !is_unseen(assigned)
            || problem.parameters_of(e).contains(&ZERO)
            || known.iter().any(is_known)
        {
            continue;
        }
        let loads = assigned.counting_points();
        let loads = loads.map(|i| experiment.measurement.points[i].ordinate.abs());
        let offset = PART * loads.fold(0.0, f64::max);
        let Some(column) = column(problem, e, ZERO, |_| true) else {
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
                 and free {ZERO}",
                experiment.measurement.name,
                slot.parameter,
                change
            )));
        }
    }
}
