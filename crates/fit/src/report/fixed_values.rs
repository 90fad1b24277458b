//! What the values that a fit takes as given do to its result.

use super::name::{NAME, name};
use super::unit::{decimals_of_three, is_zero, scaled};
use crate::{Estimate, Experiment, Fixed, FixedValue, Kind, Parameter};

/// The smallest width of a column.
const COLUMN: usize = 10;
/// The per cents from which on a power of ten is written.
const MANY: f64 = 1e5;

/// Writes a row for each given value, with the change of each estimate that follows from a change
/// of the value, and below it what the rows do not say, and the errors that known values add.
pub fn write(
    out: &mut String,
    (estimates, fixed_values): (&[Estimate], &[FixedValue]),
    experiments: &[Experiment],
    files: &[&str],
) {
    if fixed_values.is_empty() {
        return;
    }
    let names: Vec<String> = estimates.iter().map(|one| name(one, files)).collect();
    let header = names.iter().map(|name| format!("  {name:>COLUMN$}"));
    let (header, width) = (header.collect::<String>(), 2 * NAME);
    let is_known = fixed_values.iter().any(|one| one.error.is_some());
    let beside = if is_known {
        ""
    } else {
        " (not in the errors above)"
    };
    let title = format!("what the fixed values do{beside}");
    *out += &format!("\n{title:<width$}{header}\n");
    for one in fixed_values {
        let cells = estimates.iter().zip(&one.changes).zip(&names);
        let cells = cells.map(|((estimate, change), name)| {
            format!(
                "  {:>width$}",
                cell(estimate, *change),
                width = name.len().max(COLUMN)
            )
        });
        let (what, by, cells) = (one.quantity.name(), step(one), cells.collect::<String>());
        *out += &format!("  {what:<NAME$} {by:<width$}{cells}\n", width = NAME - 3);
    }
    let of_cantilever = Fixed::Parameter(Parameter::Stiffness);
    let are_forces =
        |one: &Experiment| one.measurement.kind == Kind::ForceHeight && !one.from_deflection;
    if fixed_values.iter().any(|one| one.quantity == of_cantilever)
        && experiments.iter().any(are_forces)
    {
        *out += "(the row of stiffness leaves the loads as they were read: if they are the deflection times this stiffness, \
                 another stiffness multiplies them, too, and the rows of load and stiffness add up)\n";
    }
    for one in fixed_values.iter().filter(|one| one.error.is_some()) {
        let error = one.error.unwrap_or(0.0);
        let are_apart = !one.values.is_empty() && one.quantity.errs_in_proportion();
        let (unit, size) = if are_apart || matches!(one.quantity, Fixed::Scale(_)) {
            // A part of each value.
            ("%".to_owned(), 1e-2 * one.value)
        } else if one.quantity == Fixed::HalfAngle {
            ("deg".to_owned(), 1_f64.to_radians())
        } else {
            // That of a zero has the prefix of the error.
            scaled(one.quantity.unit(), one.value.abs().max(error))
        };
        let known = plain(error / size);
        let parts = names.iter().enumerate().map(|(i, name)| {
            let error = one.error_of(i);
            match scaled(estimates[i].parameter.unit(), error) {
                (unit, _) if unit.is_empty() => format!("{error:.1e} of {name}"),
                (unit, size) => format!("{:.2} {unit} of {name}", error / size),
            }
        });
        let known = format!("{known} {unit}");
        *out += &format!(
            "the standard errors hold those of {} +- {}: {}\n",
            one.quantity.name(),
            known.trim_end(),
            parts.collect::<Vec<_>>().join(", ")
        );
    }
}

/// Returns a number without the rounding of a factor.
fn plain(value: f64) -> f64 {
    (value * 1e9).round() / 1e9
}

/// Returns the change of a given value.
fn step(one: &FixedValue) -> String {
    let relative = one.step / one.value;
    if one.quantity.is_poisson_ratio() {
        let [from, to] = [one.value, one.value + one.step].map(plain);
        return format!("{from} -> {to}");
    }
    if one.value == 0.0 || !one.quantity.errs_in_proportion() {
        let (unit, size) = scaled(one.quantity.unit(), one.step);
        return format!("{:+.2} {unit}", one.step / size);
    }
    format!("{:+.0} %", 1e2 * relative)
}

/// Returns the change of an estimate, in per cent where it is positive.
fn cell(estimate: &Estimate, change: f64) -> String {
    if change.is_nan() {
        return "not known".to_owned();
    }
    if is_zero(estimate) {
        return "stays 0".to_owned();
    }
    if estimate.parameter.is_positive() {
        let percent = 1e2 * change / estimate.value;
        if percent.abs() >= MANY {
            return format!("{percent:+.1e} %");
        }
        return format!("{percent:+.2} %");
    }
    let (unit, size) = scaled(estimate.parameter.unit(), change);
    let number = change / size;
    let decimals = decimals_of_three(number);
    format!("{number:+.decimals$} {unit}").trim_end().to_owned()
}
