//! Values that follow a value taken as given, or a calibration, far more than in proportion.

use crate::{Estimate, FixedValue, Warning, WarningKind};

/// The part by which a value changes with 1 % of a given one, or 0.01 of a Poisson ratio, from which on hardly anybody
/// knows the given one well enough.
const LARGE: f64 = 0.1;

/// Doubts values whose standard errors say little beside what given values do that are known to 1 %.
pub(in crate::estimate) fn doubts<'a>(
    estimates: &'a [Estimate],
    fixed_values: &'a [FixedValue],
) -> impl Iterator<Item = Warning> + 'a {
    estimates.iter().enumerate().filter_map(move |(i, estimate)| {
        let parameter = estimate.parameter;
        // The others are of the instrument.
        let is_of_contact = parameter.is_of_bodies() || parameter.is_work_of_adhesion();
        let least = (LARGE * estimate.value).max(estimate.standard_error);
        let is_large = |one: &&FixedValue| {
            let is_usual = one.quantity.errs_in_proportion() || one.quantity.is_poisson_ratio();
            is_usual && one.error.is_none() && one.changes[i].abs() > least
        };
        let rows = fixed_values.iter().filter(is_large);
        let mut rows: Vec<&FixedValue> = rows.filter(|_| is_of_contact && parameter.is_positive()).collect();
        rows.sort_by(|one, other| other.changes[i].abs().total_cmp(&one.changes[i].abs()));
        let first = rows.first()?;
        let by = 1e2 * first.changes[i] / estimate.value;
        let step = if first.quantity.is_poisson_ratio() {
            format!("{:+}", first.step)
        } else {
            format!("{:+.0} %", 1e2 * first.step / first.value)
        };
        let others: Vec<_> = rows[1..].iter().map(|one| one.quantity.name()).collect();
        let others = match &others[..] {
            [] => String::new(),
            names => format!(", and by more than 10 % with {}", names.join(", ")),
        };
        Some(WarningKind::Calibration.with(format!(
            "{parameter} changes by {by:+.0} % with {step} of {}{others}: its standard error holds nothing of that, unless \
             the errors of these values are given",
            first.quantity.name()
        )))
    })
}
