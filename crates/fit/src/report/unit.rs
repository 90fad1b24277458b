//! Numbers for people: a unit with a prefix, and as many digits as the error leaves.

use crate::{Estimate, Parameter};
use units::prefix;

/// The unit in which a report shows a parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct UnitOf {
    /// The parameter.
    pub parameter: Parameter,
    /// The prefix before the SI unit.
    prefix: String,
    /// The size in SI units.
    size: f64,
}

impl UnitOf {
    /// Makes it from the parameter's SI unit with a prefix, such as `MPa`; `None` for another unit.
    pub fn new(parameter: Parameter, unit: &str) -> Option<Self> {
        let found = unit.strip_suffix(parameter.unit())?;
        Some(Self {
            parameter,
            prefix: found.to_owned(),
            size: prefix(found)?,
        })
    }
}

/// The prefixes that are chosen, the largest first.
const PREFIXES: [&str; 8] = ["G", "M", "k", "", "m", "u", "n", "p"];
/// The number below which a power of ten is written: no prefix makes it a usual number.
const LEAST: f64 = 1e-9;
/// The number above which a power of ten is written.
const MOST: f64 = 1e9;
/// The part of its standard error, and the size (J/m^2), below which a work of adhesion has ended at 0.
const NOTHING: f64 = 1e-4;
const NO_ADHESION: f64 = 1e-9;

/// Returns the prefix of a unit and its size: as asked for, or so that the number before it is at
/// least 1.
pub fn unit(parameter: Parameter, value: f64, error: f64, asked: &[UnitOf]) -> (String, f64) {
    if let Some(asked) = asked.iter().rfind(|asked| asked.parameter == parameter) {
        return (format!("{}{}", asked.prefix, parameter.unit()), asked.size);
    }
    let size = if value == 0.0 { error } else { value };
    scaled(parameter.unit(), size)
}

/// Returns a unit with a prefix, and its size, so that the number before it is at least 1.
pub fn scaled(unit: &str, value: f64) -> (String, f64) {
    let sizes = PREFIXES.map(|prefix| (prefix, units::prefix(prefix).unwrap_or(1.0)));
    let usual = || sizes.into_iter().find(|(_, size)| value.abs() >= *size);
    match unit {
        "1" => (String::new(), 1.0),
        _ if value == 0.0 || !value.is_finite() => (unit.to_owned(), 1.0),
        _ => {
            let (prefix, size) = usual().unwrap_or(sizes[sizes.len() - 1]);
            (format!("{prefix}{unit}"), size)
        }
    }
}

/// Tells whether a positive value has ended at 0, which its logarithm never reaches: no prefix makes it a usual number,
/// or, of a work of adhesion, it is nothing beside its error.
pub fn is_zero(estimate: &Estimate) -> bool {
    let (parameter, value) = (estimate.parameter, estimate.value);
    let (_, size) = scaled(parameter.unit(), value);
    let is_nothing = parameter.is_work_of_adhesion()
        && value < NO_ADHESION.min(NOTHING * estimate.standard_error);
    parameter.is_positive() && (value / size < LEAST || is_nothing)
}

/// Returns a value and its error, both in `unit`, with two digits of the error.
fn with_error(value: f64, error: f64, unit: &str) -> String {
    let decimals = decimals(value, error);
    let is_known = error.is_finite();
    let size = value.abs().max(if is_known { error } else { 0.0 });
    let is_usual = size <= MOST && (value == 0.0 || value.abs() >= LEAST);
    let text = |number: f64| {
        if is_usual {
            format!("{number:.decimals$}")
        } else {
            format!("{number:.1e}")
        }
    };
    if !is_known {
        return format!("{} {unit}, without an error", text(value));
    }
    format!("{} +- {} {unit}", text(value), text(error))
        .trim_end()
        .to_owned()
}

/// Returns value, error and unit of an estimate, and its interval.
pub fn value(estimate: &Estimate, asked: &[UnitOf]) -> String {
    if is_zero(estimate) {
        let [_, most] = estimate.profile.unwrap_or([0.0, f64::NAN]);
        let (unit, size) = unit(estimate.parameter, most, 0.0, asked);
        return if most.is_finite() {
            format!("0 (0 to {:.2} {unit})", most / size)
        } else {
            format!("0 {}, without an error", estimate.parameter.unit())
        };
    }
    let (unit, size) = unit(
        estimate.parameter,
        estimate.value,
        estimate.standard_error,
        asked,
    );
    let [value, error] = [estimate.value, estimate.standard_error].map(|number| number / size);
    let mut text = with_error(value, error, &unit);
    if let Some(profile) = estimate.profile {
        let decimals = decimals(value, error);
        let [low, high] = profile.map(|end| match end / size {
            end if end.is_nan() => "not found".to_owned(),
            end if end.is_infinite() => "no limit".to_owned(),
            end => format!("{end:.decimals$}"),
        });
        // The unit, if there is one, follows the last number.
        let unit = format!(" {unit}");
        let unit = unit.trim_end();
        text += &match profile.map(f64::is_finite) {
            [_, true] => format!(" ({low} to {high}{unit})"),
            [true, false] => format!(" ({low}{unit} to {high})"),
            [false, false] => format!(" ({low} to {high})"),
        };
    }
    text
}

/// Returns the prior and the bounds that were given of an estimate, after a comma each.
pub fn given(estimate: &Estimate, asked: &[UnitOf]) -> String {
    let both = |word: &str, [one, other]: [f64; 2], between: &str| {
        let (unit, size) = unit(estimate.parameter, one.abs().max(other.abs()), 0.0, asked);
        let [one, other] = [one, other].map(|value| (value / size * 1e9).round() / 1e9);
        let text = format!(", {word} {one} {between} {other} {unit}");
        text.trim_end().to_owned()
    };
    let prior = estimate
        .prior
        .map(|one| both("prior", [one.mean, one.width], "+-"));
    let bounds = estimate.bounds.map(|ends| both("bounds", ends, "to"));
    prior.into_iter().chain(bounds).collect()
}

pub fn three_digits(value: f64, unit: &str) -> String {
    let (unit, size) = scaled(unit, value);
    let number = value / size;
    if value == 0.0 {
        return format!("0 {unit}");
    }
    if number < 1e-3 {
        return format!("{number:.2e} {unit}");
    }
    let decimals = decimals_of_three(number);
    format!("{number:.decimals$} {unit}")
}

/// Returns the number of decimals that shows three digits of a number, at most five.
pub fn decimals_of_three(number: f64) -> usize {
    decimals(number, 0.1 * number.abs().max(1e-3))
}

/// Returns the number of decimals that shows two digits of the error, or without an error three of the value.
pub fn decimals(value: f64, error: f64) -> usize {
    if value == 0.0 && !error.is_finite() {
        return 0;
    }
    let smallest = if error > 0.0 && error.is_finite() {
        error
    } else {
        1e-2 * value.abs().max(f64::MIN_POSITIVE)
    };
    (1.0 - smallest.log10().floor()).clamp(0.0, 12.0) as usize
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_and_digits_follow_value_and_error() {
        let modulus = |value, error| {
            let (unit, size) = unit(Parameter::FilmModulus, value, error, &[]);
            with_error(value / size, error / size, &unit)
        };
        assert_eq!(modulus(2.0134e6, 1.2e4), "2.013 +- 0.012 MPa");
        assert_eq!(modulus(999.0, 123.0), "999 +- 123 Pa");
        assert_eq!(modulus(999.9e3, 1e3), "999.9 +- 1.0 kPa");
        assert_eq!(modulus(2e6, f64::INFINITY), "2.000 MPa, without an error");
        assert_eq!(modulus(3e-60, 2e-23), "3.0e-48 +- 2.0e-11 pPa");
        assert_eq!(modulus(3e140, 2e139), "3.0e131 +- 2.0e130 GPa");
        assert_eq!(modulus(3e140, f64::NAN), "3.0e131 GPa, without an error");
        assert_eq!(modulus(2e6, 1.3e17), "2.0e0 +- 1.3e11 MPa");
        let asked = [UnitOf::new(Parameter::FilmModulus, "kPa").expect("a unit")];
        let (unit_name, size) = unit(Parameter::FilmModulus, 2e6, 1e4, &asked);
        assert_eq!((unit_name.as_str(), size), ("kPa", 1e3));
        assert_eq!(scaled("m", -2.5e-7), ("nm".to_owned(), 1e-9));
        assert_eq!(scaled("1", 0.5), (String::new(), 1.0));
        assert_eq!(scaled("N", 0.0), ("N".to_owned(), 1.0));
        assert_eq!(three_digits(2.5e-8, "m"), "25.0 nm");
        assert_eq!(three_digits(1.15e-19, "N"), "1.15e-7 pN");
    }
}
