//! Settings of parameters, as the command line gives them: `NAME=VALUE`.

use std::str::FromStr;

use ::fit::report::UnitOf;
use ::fit::{Error, Experiment, Fixed, Free, Known, Parameter};
use anyhow::{bail, ensure};
use units::Dimension;

use super::experiments::KnownArguments;
use super::indentation::ReferenceArguments;
use crate::cli::quantity::{self, read};
use crate::cli::system::Value;

/// Values of a quantity, `NAME=VALUE` or `NAME=VALUE,VALUE,...` with one for each file.
#[derive(Clone, Debug, PartialEq)]
pub struct Values {
    pub quantity: Fixed,
    pub values: Vec<f64>,
}

/// A free parameter with two numbers: its bounds, or its mean and standard error.
pub type Pair = (Parameter, [f64; 2]);

/// What is known of a value that the fit takes as given, `NAME=VALUE+-ERROR`.
#[derive(Clone, Debug, PartialEq)]
pub struct Given {
    pub quantity: Fixed,
    /// The value, unless a flag, --value or a file gives it.
    pub value: Option<f64>,
    error: GivenError,
}

/// A standard error.
#[derive(Clone, Copy, Debug, PartialEq)]
enum GivenError {
    Absolute(f64),
    /// A part of the value.
    Relative(f64),
}

impl Given {
    /// Returns the error for a fit of the `data`, and of the experiment on a reference `sample` if there is one.
    pub fn known(&self, data: &[Experiment], sample: &[Experiment]) -> anyhow::Result<Known> {
        let quantity = self.quantity;
        let name = quantity.name();
        let values = |of: &[Experiment]| -> Vec<f64> {
            let values = of.iter().filter_map(|one| one.value_of(quantity));
            values.filter(|value| value.is_finite()).collect()
        };
        let mut all = values(data);
        if all.is_empty() {
            all = values(sample);
        }
        let is_factor = quantity.errs_in_proportion();
        // A value that is not there is refused by the fit.
        let first = all.first().copied().unwrap_or(1.0);
        let error = match self.error {
            GivenError::Absolute(error) => {
                ensure!(
                    !is_factor || all.iter().all(|value| *value == first),
                    "--known {name}: the files have different values, and {error:?} is the error of one: give a part of \
                     the values in per cent, {name}=+-3%, by which all err together"
                );
                error
            }
            GivenError::Relative(part) => {
                ensure!(
                    is_factor,
                    "--known {name}: an error in per cent is one of a value that is always positive: give that of \
                     {name} {}",
                    match quantity.unit() {
                        "1" => "as a number, such as +-0.02".to_owned(),
                        unit => format!("in {unit}"),
                    }
                );
                part * first
            }
        };
        Ok(Known { quantity, error })
    }

    /// Refuses a quantity to which a flag gives another value, or --value one for each file.
    pub fn accept_once(
        &self,
        flags: &KnownArguments,
        reference: &ReferenceArguments,
        values: &[Values],
    ) -> anyhow::Result<()> {
        let Some(known) = self.value else {
            return Ok(());
        };
        let name = self.quantity.name();
        let text = |value: f64| match self.quantity {
            Fixed::HalfAngle => format!("{}deg", (value.to_degrees() * 1e9).round() / 1e9),
            _ => format!("{value:?}"),
        };
        let of_bodies = Value::ALL.map(|value| {
            let given = flags.bodies.system.given(value);
            (value.flag(), flags.fixed(value), given)
        });
        let of_cantilever = Fixed::Parameter(Parameter::Stiffness);
        let half_angle = flags.bodies.system.shape.half_angle.map(f64::to_radians);
        let of_sample = reference.own().map(|(quantity, value)| {
            let flag = format!("--{}", quantity.name());
            (flag, quantity, value)
        });
        let of_bodies = of_bodies.into_iter().chain(of_sample);
        for (flag, quantity, other) in of_bodies.chain([
            ("--half-angle".to_owned(), Fixed::HalfAngle, half_angle),
            ("--stiffness".to_owned(), of_cantilever, flags.stiffness),
            ("--beta".to_owned(), Fixed::Beta, flags.indentation.beta),
        ]) {
            if let Some(other) = other.filter(|other| quantity == self.quantity && *other != known)
            {
                bail!(
                    "{flag} {} and --known {name}={} are two values of one quantity: leave one of them out",
                    text(other),
                    text(known)
                );
            }
        }
        ensure!(
            values.iter().all(|one| one.quantity != self.quantity),
            "--value {name} and --known {name}={} give one quantity twice: leave the value out of --known, such as \
             {name}=+-3%",
            text(known)
        );
        Ok(())
    }
}

impl FromStr for Given {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let how = "NAME=VALUE+-ERROR, such as film-thickness=2e-6+-1e-7, or NAME=+-ERROR, such as film-thickness=+-3%";
        let (name, known) = named(text, how)?;
        let quantity = Fixed::parse(name).ok_or_else(|| {
            format!(
                "{name:?} is no value of a fit: give sphere-radius, half-angle, substrate-modulus, \
                 substrate-poisson-ratio, reference-modulus, reference-poisson-ratio, beta, contact-radius, penetration, \
                 height, load or contact-stiffness for the scale of what is read, contact-radius-zero, position-drift, or a parameter that is not free, such as \
                 film-thickness"
            )
        })?;
        let (value, error) = parts(known, how)?;
        let dimension = quantity.dimension();
        let is_given = !value.trim().is_empty();
        for text in [value, error] {
            accept_angle(text, dimension)?;
        }
        let value = is_given.then(|| quantity::value(value, dimension));
        let error = match error.trim().strip_suffix('%') {
            Some(percent) => GivenError::Relative(quantity::number(percent.trim())? / 100.0),
            None => GivenError::Absolute(read(error, dimension)?),
        };
        Ok(Self {
            quantity,
            value: value.transpose()?,
            error,
        })
    }
}

impl FromStr for Values {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (name, values) = named(text, "NAME=VALUE, such as load-offset=1e-6")?;
        let unknown = || {
            let error = Error::UnknownParameter(name.to_owned());
            format!(
                "{error}; --value also takes sphere-radius, half-angle, substrate-modulus, substrate-poisson-ratio and beta"
            )
        };
        let quantity = Fixed::parse(name).ok_or_else(unknown)?;
        let value = |text| {
            accept_angle(text, quantity.dimension())?;
            quantity::value(text, quantity.dimension())
        };
        Ok(Self {
            quantity,
            values: values.split(',').map(value).collect::<Result<_, _>>()?,
        })
    }
}

/// Reads the bounds of a free parameter, `NAME=LEAST..MOST`.
pub fn bounds(text: &str) -> Result<Pair, String> {
    let how = "NAME=LEAST..MOST, such as film-modulus=1e5..1e8";
    let (parameter, range) = split(text, how)?;
    let ends = range.split_once("..");
    let (least, most) = ends.ok_or_else(|| format!("{range:?} has no ..: write {how}"))?;
    let end = |text| quantity::value(text, parameter.dimension());
    Ok((parameter, [end(least)?, end(most)?]))
}

/// Reads what is known of a free parameter from elsewhere, `NAME=MEAN+-ERROR`.
pub fn prior(text: &str) -> Result<Pair, String> {
    let how = "NAME=MEAN+-ERROR, such as film-thickness=1e-6+-5e-8";
    let (parameter, known) = split(text, how)?;
    let (value, error) = parts(known, how)?;
    let dimension = parameter.dimension();
    let both = [quantity::value(value, dimension)?, read(error, dimension)?];
    Ok((parameter, both))
}

/// Refuses an angle without a unit: degrees would be taken for radians.
fn accept_angle(text: &str, dimension: Option<Dimension>) -> Result<(), String> {
    let text = text.trim();
    if dimension == Some(Dimension::Angle) && text.parse::<f64>().is_ok() {
        return Err(format!(
            "{text:?} is an angle without a unit: write {text}deg or {text}rad"
        ));
    }
    Ok(())
}

/// Splits `VALUE+-ERROR`.
fn parts<'a>(text: &'a str, how: &str) -> Result<(&'a str, &'a str), String> {
    let signs = ["+-", "±", "+/-"];
    let ends = signs.into_iter().find_map(|sign| text.split_once(sign));
    ends.ok_or_else(|| format!("{text:?} has no +-: write {how}"))
}

/// Reads a unit for the report, `NAME=UNIT`.
pub fn unit_of(text: &str) -> Result<UnitOf, String> {
    let (parameter, unit) = split(text, "NAME=UNIT, such as film-modulus=MPa")?;
    let si = parameter.unit();
    UnitOf::new(parameter, unit)
        .ok_or_else(|| format!("{unit:?} is not {si} with a prefix of the SI, such as m{si}"))
}

/// Refuses a unit of a parameter that is not found.
pub fn check_units(units: &[UnitOf], free: &[Free]) -> anyhow::Result<()> {
    for (i, unit) in units.iter().enumerate() {
        ensure!(
            units[..i]
                .iter()
                .all(|before| before.parameter != unit.parameter),
            "--units {} is given twice: leave one out",
            unit.parameter
        );
        ensure!(
            free.iter().any(|free| free.parameter == unit.parameter),
            "--units {}: the fit does not find it: name a free parameter",
            unit.parameter
        );
    }
    Ok(())
}

/// Splits `NAME=...` with the name of a parameter.
fn split<'a>(text: &'a str, how: &str) -> Result<(Parameter, &'a str), String> {
    let (name, rest) = named(text, how)?;
    let parameter = name.parse::<Parameter>();
    Ok((parameter.map_err(|error| error.to_string())?, rest))
}

/// Splits `NAME=...`.
fn named<'a>(text: &'a str, how: &str) -> Result<(&'a str, &'a str), String> {
    let (name, rest) = text
        .split_once('=')
        .ok_or_else(|| format!("{text:?} has no =: write {how}"))?;
    Ok((name.trim(), rest.trim()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn settings_are_read() {
        let film = Parameter::FilmThickness;
        let values = "film-thickness=1e-6, 1e-5".parse::<Values>();
        assert!(
            values.is_ok_and(
                |one| one.quantity.parameter() == Some(film) && one.values == [1e-6, 1e-5]
            )
        );
        let radii = "sphere-radius = 1mm,2mm".parse::<Values>();
        assert!(
            radii
                .is_ok_and(|one| one.quantity == Fixed::SphereRadius && one.values == [1e-3, 2e-3])
        );
        let bounds = bounds("film-modulus = 1e5..1e8");
        assert_eq!(bounds, Ok((Parameter::FilmModulus, [1e5, 1e8])));
        for (text, value, error) in [
            (
                "sphere-radius=1e-3+-1e-5",
                Some(1e-3),
                GivenError::Absolute(1e-5),
            ),
            (
                "sphere-radius=1mm+-2 %",
                Some(1e-3),
                GivenError::Relative(0.02),
            ),
            ("sphere-radius=+/-2%", None, GivenError::Relative(0.02)),
        ] {
            let given = text.parse::<Given>();
            let quantity = Fixed::SphereRadius;
            assert_eq!(
                given,
                Ok(Given {
                    quantity,
                    value,
                    error
                })
            );
        }
        for text in ["baseline=-1e-9+-2e-10", "baseline=-1e-9 ± 2e-10"] {
            assert_eq!(prior(text), Ok((Parameter::Baseline, [-1e-9, 2e-10])));
        }
        let unit = UnitOf::new(Parameter::WorkOfAdhesion, "mJ/m^2");
        assert_eq!(unit_of("work-of-adhesion=mJ/m^2").ok(), unit);
    }

    #[test]
    fn what_is_no_setting_is_refused_with_an_example() {
        let values = |text: &str| text.parse::<Values>().err();
        let bounds = |text| bounds(text).err();
        let prior = |text| prior(text).err();
        let given = |text: &str| text.parse::<Given>().err();
        for (error, words) in [
            (values("load-offset"), "load-offset=1e-6"),
            (values("offset=1"), "load-offset"),
            (values("load-offset=1;2"), "\"1;2\""),
            (values("film-thickness=3GPa"), "a length is wanted"),
            (values("film-poisson-ratio=0.3um"), "without a unit"),
            (bounds("film-modulus=1e5"), "1e5..1e8"),
            (
                bounds("sphere-modulus=1..5"),
                "write 1kPa, 1MPa or 1GPa, or 1Pa",
            ),
            (prior("film-modulus=1e5"), "+-"),
            (given("film-thickness=2e-6"), "+-"),
            (given("thickness=2e-6+-1e-7"), "film-thickness"),
            (given("sphere-radius"), "has no ="),
            (unit_of("film-modulus=mN").err(), "Pa"),
        ] {
            assert!(error.is_some_and(|error| error.contains(words)), "{words}");
        }
    }
}
