//! Forces that show adhesion, of a fit without.

use interp::Probe;

use crate::Experiment;
use crate::Parameter;
use crate::estimate::problem::Problem;

/// Returns the force by which the contact of experiment `e` pulls, N, if forces against positions are fitted without
/// adhesion and show a pull.
pub(super) fn unfitted_pull(problem: &Problem<'_>, e: usize) -> Option<f64> {
    let assigned = &problem.assigned[e];
    let experiment = &assigned.experiment;
    let kind = experiment.measurement.kind;
    let is_free = |parameter: &Parameter| parameter.is_work_of_adhesion();
    let is_without = kind.at_positions()
        && experiment.work_of_adhesion == 0.0
        && experiment
            .work_of_adhesion_receding
            .is_none_or(|work| work == 0.0)
        && !problem.parameters_of(e).iter().any(is_free);
    let noise = assigned.local_noise.unwrap_or(assigned.noise);
    is_without.then(|| experiment.pull(noise)).flatten()
}

/// Says that data show adhesion, with the force by which the contact pulls, N.
pub(super) fn adhesion_seen(experiment: &Experiment, pull: f64) -> String {
    let advice = if experiment.relaxing.is_some() {
        "contacts that relax are fitted without: leave the points of the retract out, and keep those of approach and hold"
    } else if let Probe::FlatPunch { .. } = experiment.bodies.probe {
        "the work of adhesion is 0 and not fitted: the pull-off load alone tells that of a flat punch; give a larger one than \
         that, such as 1 J/m^2, for the fit of the rest"
    } else {
        "the work of adhesion is 0 and not fitted: free it (work-of-adhesion); without it the modulus and the zeros of the \
         instrument make up for it"
    };
    format!(
        "{}: the force falls {pull:.1e} N below the baseline and jumps back to it where the contact ends, which is \
         adhesion, and {advice}",
        experiment.measurement.name
    )
}
