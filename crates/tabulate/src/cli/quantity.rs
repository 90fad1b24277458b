//! Numbers with a unit, as the command line gives them: `30um`, `70GPa`, or `3e-5` in SI units.

use std::f64::consts::FRAC_PI_2;

use units::{Dimension, Quantity};

pub fn length(text: &str) -> Result<f64, String> {
    read(text, Some(Dimension::Length))
}

pub fn modulus(text: &str) -> Result<f64, String> {
    value(text, Some(Dimension::Modulus))
}

pub fn force(text: &str) -> Result<f64, String> {
    read(text, Some(Dimension::Force))
}

/// Reads a stiffness or a work of adhesion.
pub fn force_per_length(text: &str) -> Result<f64, String> {
    read(text, Some(Dimension::ForcePerLength))
}

/// Reads an angle in degrees. A number without a unit that may be one in radians is refused.
pub fn degrees(text: &str) -> Result<f64, String> {
    let angle = any(text)?;
    match angle.dimension {
        None if angle.value > 0.0 && angle.value <= FRAC_PI_2 => Err(format!(
            "{0:?} is in degrees, and no probe is so sharp: write {0:?}rad if radians are meant, which are {1:.4} degrees, \
             or {0:?}deg",
            angle.value,
            angle.value.to_degrees()
        )),
        None => Ok(angle.value),
        Some(Dimension::Angle) => Ok(angle.value.to_degrees()),
        Some(found) => Err(format!(
            "{text:?} is {found}, and an angle is wanted: write it in degrees, or with a unit, such as 1.2rad"
        )),
    }
}

/// Reads a number without a unit.
pub fn number(text: &str) -> Result<f64, String> {
    read(text, None)
}

/// Reads a quantity of a dimension that is known later. Refuses the next flag in place of a value that
/// is missing.
pub fn any(text: &str) -> Result<Quantity, String> {
    if text.starts_with("--") {
        return Err(format!(
            "{text} is a flag, and the value before it is missing"
        ));
    }
    text.parse::<Quantity>().map_err(|error| {
        if is_list(text) {
            format!(
                "{text:?} are several values, and one is wanted: call the command once for each (`tabulate fit` takes one \
                 for each of several files: --value NAME=VALUE,VALUE)"
            )
        } else {
            error.to_string()
        }
    })
}

/// Tells whether a text is several values between commas, of which none is a decimal mark.
fn is_list(text: &str) -> bool {
    let Some((first, _)) = text.split_once(',') else {
        return false;
    };
    let digits = first.trim_start_matches(['+', '-']);
    let is_whole = digits.bytes().all(|byte| byte.is_ascii_digit());
    !is_whole && text.split(',').all(|part| part.parse::<Quantity>().is_ok())
}

/// Reads a quantity of a dimension, or a plain number.
pub fn read(text: &str, wanted: Option<Dimension>) -> Result<f64, String> {
    any(text)?.of(wanted).map_err(|error| error.to_string())
}

/// The modulus (Pa) below which hardly any solid is, and a number needs a unit.
pub const PLAIN_MODULUS: f64 = 1e3;

/// Reads the value of a quantity, as [`read`]. A small modulus needs a unit: MPa or GPa were probably
/// meant.
pub fn value(text: &str, wanted: Option<Dimension>) -> Result<f64, String> {
    let value = read(text, wanted)?;
    let number = text.trim();
    let is_small = wanted == Some(Dimension::Modulus) && value > 0.0 && value < PLAIN_MODULUS;
    if is_small && number.parse::<f64>().is_ok() {
        return Err(format!(
            "{number} has no unit and is in Pa, softer than almost all solids: write {number}kPa, {number}MPa or \
             {number}GPa, or {number}Pa if pascals are meant"
        ));
    }
    Ok(value)
}

/// Parses a time in s.
pub fn time(text: &str) -> Result<f64, String> {
    read(text, Some(Dimension::Time))
}
