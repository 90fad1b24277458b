//! The doubt about a work of adhesion whose pull the data do not show.

use crate::estimate::minima::search::{CLEAR, ends};
use crate::estimate::problem::Problem;
use crate::estimate::problem::assigned::Assigned;
use crate::estimate::problem::uncertainty::Uncertainty;
use crate::{Branch, Direction, Parameter, Point, Warning, WarningKind};

/// The number of noises by which a contact is below the baseline that would show.
const DEEP: f64 = 3.0;
/// The fewest such points that tell.
const FEWEST: usize = 5;
/// The part of the deepest pull that points must have to show one.
const SEEN: f64 = 0.5;
/// The sum of squares from the baseline over that from the contact, below which the points show no pull.
const NEARER: f64 = 0.25;

/// Warns where points that are no contacts in the data would be in contact by the fit, clear of the ends of its branches and
/// below the baseline, and are on the baseline instead, and no others are as deep. `whole` has the branches of the data.
pub(super) fn doubt(
    problem: &Problem<'_>,
    e: usize,
    uncertainty: &Uncertainty,
    whole: &Assigned,
) -> Option<Warning> {
    let own = &problem.assigned[e];
    let experiment = &own.experiment;
    let measurement = &experiment.measurement;
    let slots = problem.slots_of(e).into_iter();
    let of = |parameter: Parameter| {
        let mut slots = slots.clone();
        slots.find(|&slot| problem.slots[slot].parameter == parameter)
    };
    let work = Parameter::WORKS
        .into_iter()
        .find(|work| of(*work).is_some())?;
    if !measurement.kind.at_positions() || experiment.relaxing.is_some() {
        return None;
    }
    // On approach the contact forms at the contact point.
    let touch = experiment.sense() * experiment.contact_point;
    let error = of(Parameter::ContactPoint).map_or(0.0, |slot| uncertainty.error(slot));
    let ends = ends(problem, e, uncertainty, whole);
    let branch_of = |i: usize| {
        let point = &measurement.points[i];
        let branch = point.branch();
        let from = if point.direction == Some(Direction::Approach) {
            touch + CLEAR * error
        } else {
            let end = ends.iter().find(|end| end.branch == branch)?;
            end.position + end.clear
        };
        let is_clear = experiment.sense() * point.abscissa > from;
        (is_clear && !whole.branches[i].is_contact()).then_some(branch)
    };
    let points: Vec<(usize, Branch)> = (0..measurement.points.len())
        .filter_map(|i| Some((i, branch_of(i)?)))
        .collect();
    if points.len() < FEWEST {
        return None;
    }
    let values = |branches: &[Branch]| {
        let predicted = experiment.predict_with(&problem.contact_of(), branches, &own.order, &[]);
        predicted.ok().map(|predicted| predicted.values)
    };
    let mut branches = own.branches.clone();
    for &(i, branch) in &points {
        branches[i] = branch;
    }
    let contact = values(&branches)?;
    let baseline = values(&vec![Branch::Baseline; branches.len()])?;
    let below = |i: usize| baseline[i] - experiment.compared(i);
    let (mut count, mut deepest, mut squares) = (0, 0.0_f64, [0.0; 2]);
    for &(i, _) in &points {
        let (pull, noise) = (baseline[i] - contact[i], own.deviation(i));
        if pull > DEEP * noise {
            squares[0] += (below(i) / noise).powi(2);
            squares[1] += ((below(i) - pull) / noise).powi(2);
            (count, deepest) = (count + 1, deepest.max(pull));
        }
    }
    let pulls = (0..measurement.points.len()).filter(|&i| below(i) > SEEN * deepest);
    if pulls.count() >= FEWEST {
        return None;
    }
    // On approach no point before the contact shows a pull.
    let is_unknown = |point: &Point| point.direction.is_none();
    let unless = if measurement.points.iter().any(is_unknown) {
        ", unless they are of an approach: then give the points their direction"
    } else {
        ""
    };
    (count >= FEWEST && squares[0] < NEARER * squares[1]).then(|| {
        WarningKind::PullNotSeen.with(format!(
            "{}: with {work} = {:.1e} J/m^2 the probe would be pulled by up to {deepest:.1e} N at {count} points that are \
             fitted as no contact, and these show no pull: what the fit takes for adhesion is something else{unless}. Fix {work} at 0, \
             and check the thickness, the shape of the probe, and whether the film slides or relaxes",
            measurement.name,
            experiment.get(work).unwrap_or_default()
        ))
    })
}
