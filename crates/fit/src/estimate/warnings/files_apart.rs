//! Several files with one value, of which they have values of their own: contacts at several places, or of several samples.

use super::wanted::{Gain, Score};
use crate::statistics::{BEYOND_CHANCE, extremes};
use crate::{Parameter, Warning, WarningKind};

/// A value that all files share, and of which file `e` seems to have its own.
pub(super) struct OwnValue {
    e: usize,
    parameter: Parameter,
    /// How much larger it is than the common one, over that.
    part: f64,
    chi_squared: f64,
    pub significance: f64,
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
        let Gain {
            chi_squared,
            significance,
            change,
        } = score.gain_of(e, slot.parameter, |_| true)?.0;
        let part = change / experiment.get(slot.parameter)?;
        let parameter = slot.parameter;
        Some(OwnValue {
            e,
            parameter,
            part,
            chi_squared,
            significance,
        })
    });
    let found = found.filter(|own| own.significance > BEYOND_CHANCE * BEYOND_CHANCE);
    found.max_by(|one, other| one.significance.total_cmp(&other.significance))
}

/// Names the files that have values of their own, unless one spring for all explains more. A spring and another modulus look
/// alike in one file, and springs of single files are not named then.
pub(super) fn add(warnings: &mut Vec<Warning>, score: &Score<'_>, apart: &[OwnValue]) {
    let gains = |one: &&OwnValue, other: &&OwnValue| one.chi_squared.total_cmp(&other.chi_squared);
    let Some(most) = apart.iter().max_by(gains) else {
        return;
    };
    let explained: f64 = apart.iter().map(|own| own.chi_squared).sum();
    if score.gain_of_one_spring() >= explained {
        return;
    }
    warnings.retain(|one| one.kind != WarningKind::SpringWanted);
    let parts = apart.iter().filter(|one| one.parameter == most.parameter);
    let [least, largest] = extremes(parts.map(|one| 100.0 * one.part));
    let assigned = &score.problem.assigned;
    warnings.push(WarningKind::PoorFit.with(format!(
        "the files do not have one {}: {} of {} would be described better with one of their own, some {:+.0} % to {:+.0} % off, \
         {} by a chi^2 that is lower by {:.0}, and no zero and no spring that they share explains as much. Find one for each file: the \
         error of their mean follows from their scatter, of which the standard error of a common value holds nothing; or \
         check what is given for each file, such as a thickness",
        most.parameter,
        apart.len(),
        assigned.len(),
        least.min(0.0),
        largest.max(0.0),
        assigned[most.e].experiment.measurement.name,
        most.chi_squared,
    )));
}
