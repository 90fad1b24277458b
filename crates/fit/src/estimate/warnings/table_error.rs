//! The doubt about a table that is less accurate than the data.

use crate::estimate::problem::Problem;
use crate::{Fit, Warning, WarningKind};

/// The largest error of a table, relative to a load, that is never doubted: hardly any instrument measures five digits.
const ACCURATE: f64 = 1e-5;
/// The part of a standard deviation that an error of the table may be.
const LARGE: f64 = 0.3;

/// Warns of films that are looked up in a table whose error is not small beside the noise: the error is no noise, and
/// moves the values by more than their standard errors.
pub(crate) fn add(warnings: &mut Vec<Warning>, fit: &Fit, problem: &Problem<'_>) {
    let error = problem.table.description().certificate.max_error;
    if error <= ACCURATE {
        return;
    }
    for (fitted, assigned) in fit.experiments.iter().zip(&problem.assigned) {
        let experiment = &assigned.experiment;
        let in_contact = fitted
            .points
            .iter()
            .filter(|point| point.contact_radius.is_some());
        let ratios = in_contact.filter_map(|point| {
            let load = point.fit? - experiment.baseline_at(point.abscissa);
            Some(load.abs() / point.deviation)
        });
        let deviations = error * ratios.fold(0.0, f64::max);
        if experiment.bodies.are_coated() && deviations > LARGE {
            warnings.push(WarningKind::TableError.with(format!(
                "{}: the table is accurate to {error:.1e} of an ordinate, which is up to {deviations:.1} of its standard \
                 deviations: values may be wrong by more than their standard errors; use the embedded table, or one \
                 of a smaller tolerance",
                fitted.name
            )));
        }
    }
}
