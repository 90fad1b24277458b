//! The doubt about a work of adhesion that ended at 0.

use super::doubts::Warnings;
use super::problem::Problem;
use super::search::range;
use crate::{Experiment, Kind, Parameter, WarningKind};

/// The work of adhesion times the radius of the sphere, over the range of the loads, below which a
/// work of adhesion ended at 0: it changes no load by more than one part in ten thousand.
const NO_ADHESION: f64 = 1e-9;

/// Tells whether a work of adhesion ended at 0.
pub(super) fn is_none(experiment: &Experiment, work_of_adhesion: f64) -> bool {
    let Some(radius) = experiment.bodies.probe().radius() else {
        return false;
    };
    !experiment.measurement.kind.is_stiffness()
        && experiment.measurement.kind != Kind::PenetrationRadius
        && work_of_adhesion * radius < NO_ADHESION * range(experiment)
}

/// Warns of works of adhesion that ended at 0, which their logarithms never reach.
pub(super) fn add(warnings: &mut Warnings, problem: &Problem<'_>) {
    for (i, slot) in problem.slots.iter().enumerate() {
        let parameter = slot.parameter;
        if !matches!(
            parameter,
            Parameter::WorkOfAdhesion | Parameter::WorkOfAdhesionReceding
        ) {
            continue;
        }
        let value = problem.value(i);
        let mut own = (problem.assigned.iter().enumerate())
            .filter(|(e, _)| slot.experiment.is_none_or(|own| own == *e));
        if own.all(|(_, assigned)| is_none(&assigned.experiment, value)) {
            warnings.add(
                WarningKind::AtBound,
                format!(
                    "{parameter} = {value:.1e} J/m^2 ended at 0, its bound: these data show no \
                     adhesion, and neither its standard error nor those of the other parameters \
                     hold there; fix it at 0, give it a prior, or measure the pull-off"
                ),
            );
        }
    }
}
