//! Numbers with a unit, as people write them: `30um`, `5 mN/m`, `70GPa`.

use std::str::FromStr;

use crate::unit::{Dimension, Unit, power_of_ten, special};

/// The longest text that is read as a number, in bytes.
const LONGEST: usize = 400;

/// A number, in SI units, with the dimension of the unit behind it.
#[derive(Clone, Debug, PartialEq)]
pub struct Quantity {
    /// The text, for messages.
    text: String,
    /// The value in the SI unit of its dimension.
    pub value: f64,
    /// The dimension; `None` without a unit.
    pub dimension: Option<Dimension>,
}

/// A text that is not the quantity wanted, in a sentence that names it and what is wanted.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct QuantityError(String);

impl From<f64> for Quantity {
    /// Takes a number in SI units.
    fn from(value: f64) -> Self {
        Self {
            text: value.to_string(),
            value,
            dimension: None,
        }
    }
}

impl FromStr for Quantity {
    type Err = QuantityError;

    /// Reads a number with or without a unit. The value is correctly rounded: `30um` is `3e-5`.
    fn from_str(text: &str) -> Result<Self, QuantityError> {
        let text = text.trim();
        let not_a_number = || {
            let text: String = text.chars().take(LONGEST).collect();
            let mark = if text.contains(',') {
                ": the decimal mark is a point"
            } else {
                ""
            };
            QuantityError(format!("{text:?} is not a number{mark}"))
        };
        if text.len() > LONGEST {
            return Err(not_a_number());
        }
        let of = |value: f64, dimension: Option<Dimension>| Self {
            text: text.to_owned(),
            value,
            dimension,
        };
        let (value, end) = (1..=text.len())
            .rev()
            .filter(|&end| text.is_char_boundary(end))
            .find_map(|end| Some((text[..end].parse::<f64>().ok()?, end)))
            .ok_or_else(not_a_number)?;
        let (number, unit) = (&text[..end], text[end..].trim());
        if unit.is_empty() {
            return Ok(of(value, None));
        }
        if unit.starts_with(',') {
            return Err(not_a_number());
        }
        if let Some(Unit { dimension, size }) = special(unit) {
            return Ok(of(value * size, Some(dimension)));
        }
        let unknown = || {
            let remedy = if unit.contains(',') {
                "one value is wanted here, and no list"
            } else if unit.contains('%') {
                "give the number in the unit of the quantity, and no percentage"
            } else {
                "units are such as um, mN, kPa, N/m, mJ/m^2 or s, and case counts: mN and MN, Pa and not pa"
            };
            QuantityError(format!(
                "{unit:?} in {text:?} is not a unit that is known; {remedy}"
            ))
        };
        let (dimension, exponent) = power_of_ten(unit).ok_or_else(unknown)?;
        let value = times_power_of_ten(number, exponent).unwrap_or(value);
        Ok(of(value, Some(dimension)))
    }
}

impl Quantity {
    /// Reads a quantity of a dimension, `None` for a plain number, and returns its value in SI
    /// units. A number without a unit is in SI units.
    ///
    /// # Errors
    /// [`QuantityError`] naming the text, and the dimension wanted.
    ///
    /// ```
    /// use units::{Dimension, Quantity};
    ///
    /// assert_eq!(Quantity::read("30um", Some(Dimension::Length)), Ok(3e-5));
    /// assert_eq!(Quantity::read("3e-5", Some(Dimension::Length)), Ok(3e-5));
    /// let error = Quantity::read("30GPa", Some(Dimension::Length)).unwrap_err();
    /// assert!(error.to_string().contains("is a modulus, and a length is wanted"));
    /// ```
    pub fn read(text: &str, wanted: Option<Dimension>) -> Result<f64, QuantityError> {
        text.parse::<Self>()?.of(wanted)
    }

    /// Returns the value in SI units of a quantity of a dimension, `None` for a plain number.
    ///
    /// # Errors
    /// [`QuantityError`] for a unit of another dimension.
    pub fn of(&self, wanted: Option<Dimension>) -> Result<f64, QuantityError> {
        let text = &self.text;
        match self.dimension {
            Some(found) if Some(found) != wanted => Err(QuantityError(match wanted {
                Some(wanted) => format!(
                    "{text:?} is {found}, and {wanted} is wanted: write it in {}, or with a unit, such as {}",
                    wanted.unit(),
                    wanted.examples()
                ),
                None => format!("{text:?} is {found}, and a number without a unit is wanted"),
            })),
            _ => Ok(self.value),
        }
    }
}

/// Returns the number of a text times a power of ten, correctly rounded; `None` for a number
/// without digits, such as `inf`.
fn times_power_of_ten(number: &str, exponent: i32) -> Option<f64> {
    let (digits, own) = number.split_once(['e', 'E']).unwrap_or((number, "0"));
    let exponent = own.parse::<i32>().ok()?.checked_add(exponent)?;
    format!("{digits}e{exponent}").parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_with_units_are_rounded_once() {
        for (text, wanted, value) in [
            ("30um", Dimension::Length, 3e-5),
            ("30 \u{b5}m", Dimension::Length, 3e-5),
            ("30\u{3bc}m", Dimension::Length, 3e-5),
            ("1e-6 m", Dimension::Length, 1e-6),
            ("0.35E2nm", Dimension::Length, 3.5e-8),
            ("-5nm", Dimension::Length, -5e-9),
            ("3e-5", Dimension::Length, 3e-5),
            ("70GPa", Dimension::Modulus, 7e10),
            ("inf", Dimension::Modulus, f64::INFINITY),
            ("inf GPa", Dimension::Modulus, f64::INFINITY),
            ("5mN/m", Dimension::ForcePerLength, 5e-3),
            ("40mJ/m^2", Dimension::ForcePerLength, 0.04),
            ("40mJ/m2", Dimension::ForcePerLength, 0.04),
            ("2.5nN", Dimension::Force, 2.5e-9),
            ("30nm/V", Dimension::LengthPerVoltage, 3e-8),
            ("12 deg", Dimension::Angle, 12.0_f64.to_radians()),
            ("1 g", Dimension::Force, 9.80665e-3),
            ("2 mil", Dimension::Length, 5.08e-5),
            ("1 kgf/mm2", Dimension::Modulus, 9.80665e6),
        ] {
            assert_eq!(Quantity::read(text, Some(wanted)), Ok(value), "{text}");
        }
        assert_eq!(Quantity::read("0.45", None), Ok(0.45));
    }

    #[test]
    fn other_texts_are_named() {
        let length = Some(Dimension::Length);
        for (text, wanted, words) in [
            ("", length, "\"\"; is not a number"),
            ("um", length, "\"um\"; is not a number"),
            ("0,1", length, "\"0,1\"; mark is a point"),
            ("5e", length, "\"e\" in \"5e\"; case counts"),
            ("30UM", length, "\"UM\"; case counts"),
            ("1um,2um", length, "no list"),
            ("10%", length, "no percentage"),
            ("30GPa", length, "a length is wanted; 30um"),
            (
                "30um",
                Some(Dimension::Modulus),
                "a modulus is wanted; 70GPa",
            ),
            ("0.5um", None, "is a length; without a unit"),
        ] {
            let message = Quantity::read(text, wanted).unwrap_err().to_string();
            let has_all = words.split("; ").all(|word| message.contains(word));
            assert!(has_all, "{text}: {message}");
        }
        assert!("1".repeat(LONGEST + 1).parse::<Quantity>().is_err());
    }
}
