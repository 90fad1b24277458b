//! The points that a fit leaves out, by reason.

use super::minima::minimum::Minimum;
use super::minima::search::{End, ends};
use super::problem::assigned::Assigned;
use crate::{Branch, Error, LeftOut, LeftOutReason, Numbering};

/// The largest part of the points in contact that may be left out unless more are allowed.
const MOST: f64 = 1.0 / 3.0;

/// Lists the points left out of each experiment, in the order of the reasons.
pub(super) fn left_out(found: &Minimum<'_>, data: &[Assigned]) -> Vec<Vec<LeftOut>> {
    let of_experiment = |(e, whole): (usize, &Assigned)| {
        let uncertainty = found.uncertainty.as_ref();
        let ends = uncertainty.map(|uncertainty| ends(&found.problem, e, uncertainty, whole));
        let ends = ends.unwrap_or_default();
        let branches = &found.problem.assigned[e].branches;
        let points = &whole.experiment.measurement.points;
        let mut groups: Vec<LeftOut> = Vec::new();
        for (i, point) in points.iter().enumerate() {
            if branches[i] != Branch::LeftOut {
                continue;
            }
            let reason = reason(whole, &ends, i);
            match groups.iter_mut().find(|group| group.reason == reason) {
                Some(group) => {
                    group.points += 1;
                    group.lines[0] = group.lines[0].min(point.line);
                    group.lines[1] = group.lines[1].max(point.line);
                }
                None => groups.push(LeftOut {
                    reason,
                    points: 1,
                    lines: [point.line; 2],
                }),
            }
        }
        groups.sort_by_key(|group| group.reason);
        groups
    };
    data.iter().enumerate().map(of_experiment).collect()
}

/// Returns why a point is left out.
fn reason(whole: &Assigned, ends: &[End], i: usize) -> LeftOutReason {
    let experiment = &whole.experiment;
    let point = &experiment.measurement.points[i];
    let at_radii = experiment.measurement.kind.at_radii();
    match whole.branches[i] {
        Branch::LeftOut if at_radii && point.abscissa == 0.0 => LeftOutReason::NoContact,
        Branch::LeftOut if experiment.is_speed_unknown(i) => LeftOutReason::UnknownSpeed,
        Branch::LeftOut if at_radii => LeftOutReason::Turn,
        Branch::LeftOut => LeftOutReason::Jump,
        branch => {
            let position = experiment.sense() * point.abscissa;
            let is_beyond = |end: &End| end.branch == branch && position < end.position - end.clear;
            if ends.iter().any(is_beyond) {
                LeftOutReason::BeyondEnd
            } else {
                LeftOutReason::NearEnd
            }
        }
    }
}

/// Returns how many points of an experiment are in contact, and how many of them are left out.
pub(super) fn in_contact(whole: &Assigned, groups: &[LeftOut]) -> [usize; 2] {
    let contacts = whole.branches.iter().filter(|branch| branch.is_contact());
    let of_contact = groups.iter().filter(|group| group.reason.is_of_contact());
    [contacts.count(), of_contact.map(|group| group.points).sum()]
}

/// Accepts what is left out.
pub(super) fn accept(data: &[Assigned], left_out: &[Vec<LeftOut>]) -> Result<(), Error> {
    for (whole, groups) in data.iter().zip(left_out) {
        let [contacts, lost] = in_contact(whole, groups);
        if lost as f64 > MOST * contacts as f64 {
            let measurement = &whole.experiment.measurement;
            return Err(Error::LeftOut(format!(
                "{}: {lost} of {contacts} points in contact are left out, more than a third: \
                 {}. Check the units, the fixed values and the model, free the zeros of the instrument that are not \
                 known to be 0, such as contact-point, baseline and baseline-slope, or allow points to be left out",
                measurement.name,
                text(groups, measurement.numbering)
            )));
        }
    }
    Ok(())
}

/// Returns the groups in words.
pub(crate) fn text(groups: &[LeftOut], numbering: Numbering) -> String {
    let one = |group: &LeftOut| {
        let [first, last] = group.lines;
        format!(
            "{} {} ({numbering}s {first} to {last})",
            group.points,
            group.reason.text()
        )
    };
    groups.iter().map(one).collect::<Vec<_>>().join(", ")
}
