//! Values that follow a value taken as given, or a calibration, far more than in proportion.

use crate::{Estimate, FixedValue, Warning, WarningKind};

/// The part by which a value changes with 1 % of a given one, 0.01 of a Poisson ratio, or readings that move by 0.5 % of
/// the largest, from which on hardly anybody knows the given one well enough.
const LARGE: f64 = 0.1;

/// The per cents above which the change is not told: the data hardly determine the value.
const UNDETERMINED: f64 = 1000.0;

/// Doubts values, with these `names`, whose standard errors say little beside what given values do that are known to 1 %.
pub(in crate::estimate) fn doubts(
    names: &[String],
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
        let by = match 1e2 * first.changes[i] / estimate.value {
            by if by.abs() > UNDETERMINED => format!("more than {UNDETERMINED} %"),
            by => format!("{by:+.0} %"),
        };
        let step = if first.quantity.is_poisson_ratio() {
            format!("{:+}", first.step)
        } else if first.quantity.moves_readings() {
            format!("{:+.1e} {}", first.step, first.quantity.unit())
        } else {
            format!("{:+.0} %", 1e2 * first.step / first.value)
        };
        let others: Vec<_> = others.iter().map(|one| one.quantity.name()).collect();
        let others = match &*others.join(", ") {
            "" => String::new(),
            others => format!(", and by more than {:.0} % with {others}", 1e2 * LARGE),
        };
        Some(WarningKind::Calibration.with(format!(
            "{} changes by {by} with {step} of {}{others}: its standard error holds nothing of that; give \
             the errors of such values",
            names[i],
            first.quantity.name()
        )))
    };
    estimates.iter().enumerate().filter_map(doubt).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Fixed, Parameter, Scale};

    #[test]
    fn a_change_of_a_value_that_is_hardly_determined_is_told_by_its_size_alone() {
        for (change, words) in [(-0.2, "by -20 % with"), (-9e3, "by more than 1000 % with")] {
            let estimate = Estimate {
                parameter: Parameter::FilmModulus,
                experiment: None,
                value: 1.0,
                standard_error: 0.1,
                profile: None,
                prior: None,
                bounds: None,
            };
            let row = FixedValue {
                quantity: Fixed::Scale(Scale::Load),
                value: 1.0,
                values: Vec::new(),
                step: 0.01,
                changes: vec![change],
                error: None,
            };
            let doubts = doubts(&["film-modulus".to_owned()], &[estimate], &[row]);
            assert!(doubts[0].text.contains(words), "{doubts:?}");
        }
    }
}
