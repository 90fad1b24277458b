//! Several files with one value, of which they have values of their own: contacts at several places, or of several samples.

use nalgebra::DVector;

use super::wanted::{Gain, LEFT, Score};
use crate::estimate::problem::assigned::Assigned;
use crate::statistics::{BEYOND_CHANCE, extremes};
use crate::{Kind, Parameter, Warning, WarningKind};

/// The part of what values of their own explain from which on a spring that explains less by chance alone is named.
const HARDLY_LESS: f64 = 0.7;

/// A value that all files share, and of which file `e` seems to have its own.
pub(super) struct OwnValue {
    e: usize,
    parameter: Parameter,
    /// How much larger it is than the common one, over that.
    part: f64,
    chi_squared: f64,
    pub significance: f64,
    /// The derivatives of the residuals with respect to it.
    column: DVector<f64>,
}

/// Returns the modulus or work of adhesion, shared by several files, of which a value of its own would describe file `e` better
/// than any other, if by more than chance.
pub(super) fn own_value(score: &Score<'_>, e: usize) -> Option<OwnValue> {
    let problem = score.problem;
    if problem.assigned.len() < 2 {
        return None;
    }
    let experiment = &problem.assigned[e].experiment;
    let shared = problem.slots.iter().filter(|slot| {
        let parameter = slot.parameter;
        slot.experiment.is_none()
            && (parameter.is_modulus() || parameter.is_work_of_adhesion())
            && slot.is_of(e, experiment)
    });
    let found = shared.filter_map(|slot| {
        let (gain, column) = score.gain_of(e, slot.parameter, |_| true)?;
        Some(OwnValue {
            e,
            parameter: slot.parameter,
            part: gain.change / experiment.get(slot.parameter)?,
            chi_squared: gain.chi_squared,
            significance: gain.significance,
            column,
        })
    });
    let found = found.filter(|own| own.significance > BEYOND_CHANCE * BEYOND_CHANCE);
    found.max_by(|one, other| one.significance.total_cmp(&other.significance))
}

/// Names the files that have values of their own, or one spring for all where it explains more. A spring and another modulus
/// look alike in one file, and springs of single files are not named beside the files.
pub(super) fn add(warnings: &mut Vec<Warning>, score: &Score<'_>, apart: &[OwnValue]) {
    let gains = |one: &&OwnValue, other: &&OwnValue| one.chi_squared.total_cmp(&other.chi_squared);
    let Some(most) = apart.iter().max_by(gains) else {
        return;
    };
    let explained = gain_of_all(score, apart);
    let spring = one_spring(score);
    let by_spring = spring.as_ref().map_or(0.0, |gain| gain.chi_squared);
    if let Some(spring) = spring.filter(|_| by_spring >= explained) {
        let is_named = |one: &Warning| one.kind == WarningKind::SpringWanted;
        if !warnings.iter().any(is_named) {
            warnings.push(WarningKind::SpringWanted.with(format!(
                "one spring in series with the contacts of all files, a compliance of {:+.1e} m/N beside what is given, would lower \
                 chi^2 by {by_spring:.0}, more than a {} of each file's own: check the frame, the load cell and the stiffness of \
                 the cantilever, and take load/stiffness off the positions",
                spring.change, most.parameter
            )));
        }
        return;
    }
    warnings.retain(|one| one.kind != WarningKind::SpringWanted);
    let parts = apart.iter().filter(|one| one.parameter == most.parameter);
    let [least, largest] = extremes(parts.map(|one| 100.0 * one.part));
    let off = if least == largest {
        format!("{least:+.0} %")
    } else {
        format!("{least:+.0} % to {largest:+.0} %")
    };
    let assigned = &score.problem.assigned;
    let otherwise = if by_spring > HARDLY_LESS * explained {
        "a spring in series with all of them explains hardly less, so check frame and cantilever first"
    } else {
        "no zero and no spring that they share explains as much"
    };
    warnings.push(WarningKind::PoorFit.with(format!(
        "the files do not have one {}: {} of {} would be described better with one of their own, some {off} off, \
         {} by a chi^2 that is lower by {:.0}, and {otherwise}. Find one for each file: the \
         error of their mean follows from their scatter, of which the standard error of a common value holds nothing; or \
         check what is given for each file, such as a thickness",
        most.parameter,
        apart.len(),
        assigned.len(),
        assigned[most.e].experiment.measurement.name,
        most.chi_squared,
    )));
}

/// Returns the gain of one spring in series with the contacts of all files; `None` where they are not against positions, and
/// where none has the sign of a spring.
fn one_spring(score: &Score<'_>) -> Option<Gain> {
    let assigned = &score.problem.assigned;
    let mut column = DVector::zeros(score.residuals.len());
    for (e, one) in assigned.iter().enumerate() {
        let kind = one.experiment.measurement.kind;
        if !matches!(kind, Kind::LoadPenetration | Kind::ForceHeight) {
            return None;
        }
        column += score.spring_column(e)?;
    }
    let gain = score.gain(&column)?;
    let given = |one: &Assigned| one.experiment.stiffness.map_or(0.0, f64::recip);
    let is_spring = assigned.iter().all(|one| given(one) + gain.change > 0.0);
    is_spring.then_some(gain)
}

/// Returns the decrease of the sum of squares by all these values together. That of two files is the same by a value of one
/// or of the other.
fn gain_of_all(score: &Score<'_>, apart: &[OwnValue]) -> f64 {
    let mut directions: Vec<DVector<f64>> = Vec::new();
    for OwnValue { column, .. } in apart {
        let mut rest = score.uncertainty.without_fitted(column);
        for direction in &directions {
            rest -= direction * direction.dot(&rest);
        }
        let length = rest.norm();
        if length > LEFT * column.norm() {
            directions.push(rest / length);
        }
    }
    let gains = directions
        .iter()
        .map(|one| one.dot(&score.residuals).powi(2));
    gains.sum()
}
