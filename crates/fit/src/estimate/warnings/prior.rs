//! Priors that the data contradict.

use nalgebra::DVector;

use crate::estimate::problem::Problem;
use crate::estimate::problem::uncertainty::Uncertainty;
use crate::{Warning, WarningKind};

/// The distance of data and prior, in standard errors of both, from which one of them is doubted: one
/// sound prior in 15,000 exceeds it.
const FAR: f64 = 4.0;
/// The part of a prior that the data must add to: below it rounding hides the distance.
const ADDED: f64 = 1e-6;

/// Warns of priors that are far from what the data tell without them.
pub(crate) fn add(
    warnings: &mut Vec<Warning>,
    problem: &Problem<'_>,
    uncertainty: &Uncertainty,
    residuals: &DVector<f64>,
) {
    let names = problem.slot_names();
    let with_prior = problem.slots.iter().enumerate();
    let with_prior = with_prior.filter_map(|(i, slot)| Some((i, slot.parameter, slot.prior?)));
    for (row, (slot, parameter, prior)) in (problem.counting()..).zip(with_prior) {
        // The residual of a prior that is followed in part has a part of its variance.
        let own = 1.0 - uncertainty.leverages[row];
        let distance = residuals[row].abs() / own.sqrt();
        if own > ADDED && distance > FAR {
            let unit = parameter.after_number();
            warnings.push(WarningKind::Prior.with(format!(
                "the prior of {}, {:.4e} +- {:.1e}{unit}, and the data are {distance:.0} standard \
                 errors apart, and the fit, {:.4e}{unit}, lies between them: check the prior, the \
                 values that are fixed, and the units; or leave the prior out",
                names[slot],
                prior.mean,
                prior.width,
                problem.value(slot)
            )));
        }
    }
}
