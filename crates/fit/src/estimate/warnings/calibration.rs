//! Values that follow a value taken as given, or a calibration, far more than in proportion.

use crate::{Estimate, FixedValue, Warning, WarningKind};

/// The part by which a value changes with 1 % of a given one, 0.01 of a Poisson ratio, or readings that move by 0.5 % of
/// the largest, from which on hardly anybody knows the given one well enough.
const LARGE: f64 = 0.1;

/// Doubts values whose standard errors say little beside what given values do that are known to 1 %.
pub(in crate::estimate) fn doubts(
    estimates: &[Estimate],
    fixed_values: &[FixedValue],
) -> Vec<Warning> {
    let doubt = |(i, estimate): (usize, &Estimate)| {
        let parameter = estimate.parameter;
        // Others are of the instrument.
        let is_of_contact = parameter.is_of_bodies() || parameter.is_work_of_adhesion();
        if !is_of_contact || !parameter.is_positive() {
            return None;
        }
        let least = (LARGE * estimate.value).max(estimate.standard_error);
        let size = |one: &FixedValue| one.changes[i].abs();
        let is_large = |one: &&FixedValue| {
            let is_zero = !one.quantity.errs_in_proportion()
                && !one.quantity.is_poisson_ratio()
                && !one.quantity.moves_readings();
            !is_zero && one.error.is_none() && size(one) > least
        };
        let mut rows: Vec<_> = fixed_values.iter().filter(is_large).collect();
        rows.sort_by(|one, other| size(other).total_cmp(&size(one)));
        let (first, others) = rows.split_first()?;
        let by = 1e2 * first.changes[i] / estimate.value;
        let step = if first.quantity.is_poisson_ratio() {
            format!("{:+}", first.step)
        } else if first.quantity.moves_readings() {
            format!("{:+.1e} {}", first.step, first.quantity.unit())
        } else {
            format!("{:+.0} %", 1e2 * first.step / first.value)
        };
        let names: Vec<_> = others.iter().map(|one| one.quantity.name()).collect();
        let others = match &*names.join(", ") {
            "" => String::new(),
            names => format!(", and by more than {:.0} % with {names}", 1e2 * LARGE),
        };
        Some(WarningKind::Calibration.with(format!(
            "{parameter} changes by {by:+.0} % with {step} of {}{others}: its standard error holds nothing of that; give \
             the errors of such values",
            first.quantity.name()
        )))
    };
    estimates.iter().enumerate().filter_map(doubt).collect()
}
