//! Units, as columns name them and as people write them behind a number.

use std::fmt;

/// The kind of a physical quantity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dimension {
    /// In metres.
    Length,
    /// In newtons.
    Force,
    /// In volts.
    Voltage,
    /// In pascals: a modulus.
    Modulus,
    /// In newtons per metre: a stiffness. One joule per square metre, the unit of a work of
    /// adhesion, is one newton per metre.
    ForcePerLength,
    /// In metres per volt: the sensitivity of a deflection.
    LengthPerVoltage,
    /// In metres per newton: the compliance of a frame.
    Compliance,
    /// In square metres.
    Area,
    /// In radians.
    Angle,
    /// In pascals per metre: the stiffness of an interface, per area.
    ModulusPerLength,
    /// In seconds.
    Time,
    /// In metres per second.
    Speed,
}

impl Dimension {
    /// Returns the name with its article, the SI unit, and numbers with a unit as examples.
    const fn words(self) -> [&'static str; 3] {
        match self {
            Self::Length => ["a length", "m", "30um or 5e-7 m"],
            Self::Force => ["a force", "N", "2uN or 5e-9 N"],
            Self::Voltage => ["a voltage", "V", "20mV"],
            Self::Modulus => ["a modulus", "Pa", "3.5MPa or 70GPa"],
            Self::ForcePerLength => [
                "a stiffness or a work of adhesion",
                "N/m or J/m^2",
                "0.1N/m or 40mJ/m^2",
            ],
            Self::LengthPerVoltage => ["a sensitivity", "m/V", "30nm/V"],
            Self::Compliance => ["a compliance", "m/N", "0.2nm/mN"],
            Self::Area => ["an area", "m^2", "2e6nm^2"],
            Self::Angle => ["an angle", "rad", "12deg"],
            Self::ModulusPerLength => ["a stiffness per area", "Pa/m", "2e14 Pa/m or 200GPa/mm"],
            Self::Time => ["a time", "s", "0.5s or 20ms"],
            Self::Speed => ["a speed", "m/s", "2um/s"],
        }
    }

    /// Returns the SI unit.
    pub const fn unit(self) -> &'static str {
        self.words()[1]
    }

    /// Returns numbers with a unit, as examples.
    pub const fn examples(self) -> &'static str {
        self.words()[2]
    }
}

impl fmt::Display for Dimension {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.words()[0])
    }
}

/// A unit: a dimension, and its size in the SI unit of this dimension.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unit {
    /// The dimension.
    pub dimension: Dimension,
    /// The size in the SI unit.
    pub size: f64,
}

/// Prefixes: symbol, name, size. The size is a decimal exponent, so that it is rounded once.
const PREFIXES: [(&str, &str, i32); 14] = [
    ("", "", 0),
    ("c", "centi", -2),
    ("m", "milli", -3),
    ("u", "micro", -6),
    ("\u{b5}", "micro", -6),
    ("\u{3bc}", "micro", -6),
    ("n", "nano", -9),
    ("p", "pico", -12),
    ("f", "femto", -15),
    ("a", "atto", -18),
    ("k", "kilo", 3),
    ("M", "mega", 6),
    ("G", "giga", 9),
    ("T", "tera", 12),
];

/// Units without a prefix: symbol, names, dimension.
const BASES: [(&str, &[&str], Dimension); 4] = [
    ("m", &["metre", "meter"], Dimension::Length),
    ("N", &["newton"], Dimension::Force),
    ("V", &["volt"], Dimension::Voltage),
    ("Pa", &["pascal"], Dimension::Modulus),
];

/// Quotients of two symbols: numerator, denominator and its power, dimension.
const QUOTIENTS: [(&str, &str, i32, Dimension); 8] = [
    ("N", "m", 1, Dimension::ForcePerLength),
    ("J", "m", 2, Dimension::ForcePerLength),
    ("N", "m", 2, Dimension::Modulus),
    ("m", "V", 1, Dimension::LengthPerVoltage),
    ("m", "N", 1, Dimension::Compliance),
    ("Pa", "m", 1, Dimension::ModulusPerLength),
    ("N", "m", 3, Dimension::ModulusPerLength),
    ("m", "s", 1, Dimension::Speed),
];

impl Unit {
    /// The SI unit of a dimension.
    pub const fn si(dimension: Dimension) -> Self {
        Self {
            dimension,
            size: 1.0,
        }
    }

    /// Reads a symbol, `mN`, a name, `micrometres`, or a quotient of symbols, `mJ/m^2` or
    /// `mJ m^-2`. Symbols must have the case of the SI: `mN` and `MN` differ.
    pub fn parse(text: &str) -> Option<Self> {
        special(text).or_else(|| {
            let (dimension, exponent) = power_of_ten(text)?;
            let size = power(exponent);
            Some(Self { dimension, size })
        })
    }
}

/// Returns an angle, a time, a unit of older papers, or the force of a mass under standard gravity, which a balance
/// shows. Other prefixes of a time would make units of the ends of words.
pub(crate) fn special(text: &str) -> Option<Unit> {
    let (dimension, size) = match text.trim() {
        "rad" => (Dimension::Angle, 1.0),
        "mrad" => (Dimension::Angle, 1e-3),
        "deg" | "degree" | "degrees" | "\u{b0}" => (Dimension::Angle, std::f64::consts::PI / 180.0),
        "s" | "sec" | "second" | "seconds" => (Dimension::Time, 1.0),
        "ms" | "msec" | "milliseconds" => (Dimension::Time, 1e-3),
        "us" | "\u{b5}s" | "\u{3bc}s" | "microseconds" => (Dimension::Time, 1e-6),
        "min" | "minute" | "minutes" => (Dimension::Time, 60.0),
        "h" | "hour" | "hours" => (Dimension::Time, 3600.0),
        "g" | "gf" => (Dimension::Force, 9.80665e-3),
        "mg" | "mgf" => (Dimension::Force, 9.80665e-6),
        "kg" | "kgf" => (Dimension::Force, 9.80665),
        "dyn" | "dyne" | "dynes" => (Dimension::Force, 1e-5),
        "dyn/cm" | "erg/cm^2" | "erg/cm2" | "erg/cm\u{b2}" => (Dimension::ForcePerLength, 1e-3),
        "dyn/cm^2" | "dyn/cm2" | "dyn/cm\u{b2}" => (Dimension::Modulus, 0.1),
        "psi" => (Dimension::Modulus, 6894.757293168361),
        "kgf/mm^2" | "kgf/mm2" | "kgf/mm\u{b2}" => (Dimension::Modulus, 9.80665e6),
        "mil" | "mils" => (Dimension::Length, 2.54e-5),
        _ => return None,
    };
    Some(Unit { dimension, size })
}

/// Returns the dimension of a unit, and the power of ten that it is in the SI unit.
pub(crate) fn power_of_ten(text: &str) -> Option<(Dimension, i32)> {
    let text = text.trim();
    let word = text.to_lowercase();
    let word = word.strip_suffix('s').unwrap_or(&word);
    if matches!(text, "\u{c5}" | "\u{212b}") || word == "angstrom" {
        return Some((Dimension::Length, -10));
    }
    if word == "micron" {
        return Some((Dimension::Length, -6));
    }
    if let Some((above, below)) = text.split_once('/') {
        return quotient(above.trim(), below.trim());
    }
    let dots = [' ', '\u{b7}', '\u{22c5}'];
    if let Some((above, below)) = text.split_once(dots)
        && let Some((below, power)) = without_negative_power(below.trim_start_matches(dots))
    {
        return quotient(above, &format!("{below}{power}"));
    }
    if let Some(length) = without_square(text) {
        return Some((Dimension::Area, 2 * prefixed(length, "m")?));
    }
    BASES.into_iter().find_map(|(symbol, names, dimension)| {
        let of_name = |(_, name, exponent): &(&str, &str, i32)| {
            let base = word.strip_prefix(name)?;
            names.contains(&base).then_some(*exponent)
        };
        let exponent = prefixed(text, symbol).or_else(|| PREFIXES.iter().find_map(of_name));
        Some((dimension, exponent?))
    })
}

/// Returns the power of ten of the prefix before a symbol.
fn prefixed(text: &str, symbol: &str) -> Option<i32> {
    let prefix = text.strip_suffix(symbol)?;
    let known = PREFIXES.iter().find(|(known, ..)| *known == prefix);
    known.map(|(_, _, exponent)| *exponent)
}

/// Returns the dimension and the power of ten of a quotient.
fn quotient(above: &str, below: &str) -> Option<(Dimension, i32)> {
    let powers = [
        ("^2", 2),
        ("\u{b2}", 2),
        ("2", 2),
        ("^3", 3),
        ("\u{b3}", 3),
        ("3", 3),
    ];
    let raised = powers
        .into_iter()
        .find_map(|(power, exponent)| Some((below.strip_suffix(power)?, exponent)));
    let (below, exponent) = raised.unwrap_or((below, 1));
    QUOTIENTS
        .into_iter()
        .filter(|(_, _, own, _)| *own == exponent)
        .find_map(|(numerator, denominator, _, dimension)| {
            let above = prefixed(above, numerator)?;
            let below = prefixed(below, denominator)?;
            Some((dimension, above - exponent * below))
        })
}

/// Returns a symbol without its negative power, `m^-2` or with a superscript minus, and this power without its sign; none if it has
/// no such power.
fn without_negative_power(symbol: &str) -> Option<(&str, &str)> {
    let powers = [
        (["^-1", "-1", "\u{2212}1", "\u{207b}\u{b9}"], ""),
        (["^-2", "-2", "\u{2212}2", "\u{207b}\u{b2}"], "^2"),
        (["^-3", "-3", "\u{2212}3", "\u{207b}\u{b3}"], "^3"),
    ];
    powers.into_iter().find_map(|(signs, power)| {
        let symbol = signs
            .into_iter()
            .find_map(|sign| symbol.strip_suffix(sign))?;
        Some((symbol, power))
    })
}

/// Returns a symbol without its power of 2, if it has this power.
fn without_square(symbol: &str) -> Option<&str> {
    let mut squares = ["^2", "\u{b2}", "2"].into_iter();
    squares.find_map(|square| symbol.strip_suffix(square))
}

/// Returns the size of a prefix of the SI, by its symbol; 1 of an empty symbol, `None` of an unknown one.
pub fn prefix(symbol: &str) -> Option<f64> {
    prefixed(symbol, "").map(power)
}

/// Returns a power of ten, correctly rounded, which `powi` is not.
fn power(exponent: i32) -> f64 {
    format!("1e{exponent}").parse().expect("it is a number")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn symbols_and_names_have_the_sizes_of_the_si() {
        for (text, dimension, size) in [
            ("m", Dimension::Length, 1.0),
            ("nm", Dimension::Length, 1e-9),
            ("µm", Dimension::Length, 1e-6),
            ("μm", Dimension::Length, 1e-6),
            ("um", Dimension::Length, 1e-6),
            ("micron", Dimension::Length, 1e-6),
            ("Micrometers", Dimension::Length, 1e-6),
            ("\u{c5}", Dimension::Length, 1e-10),
            ("\u{212b}", Dimension::Length, 1e-10),
            ("mm", Dimension::Length, 1e-3),
            ("cm", Dimension::Length, 1e-2),
            ("N", Dimension::Force, 1.0),
            ("pN", Dimension::Force, 1e-12),
            ("mN", Dimension::Force, 1e-3),
            ("MN", Dimension::Force, 1e6),
            ("nanonewton", Dimension::Force, 1e-9),
            ("mV", Dimension::Voltage, 1e-3),
            ("volts", Dimension::Voltage, 1.0),
            ("GPa", Dimension::Modulus, 1e9),
            ("kilopascals", Dimension::Modulus, 1e3),
            ("N/mm^2", Dimension::Modulus, 1e6),
            ("N/m", Dimension::ForcePerLength, 1.0),
            ("pN/nm", Dimension::ForcePerLength, 1e-3),
            ("mJ/m^2", Dimension::ForcePerLength, 1e-3),
            ("mJ/m2", Dimension::ForcePerLength, 1e-3),
            ("mJ m-2", Dimension::ForcePerLength, 1e-3),
            ("mN\u{b7}m\u{207b}\u{b9}", Dimension::ForcePerLength, 1e-3),
            ("N mm^-3", Dimension::ModulusPerLength, 1e9),
            ("mJ \u{22c5} m\u{2212}2", Dimension::ForcePerLength, 1e-3),
            ("TPa", Dimension::Modulus, 1e12),
            ("J / cm\u{b2}", Dimension::ForcePerLength, 1e4),
            ("nm/V", Dimension::LengthPerVoltage, 1e-9),
            ("nm/mN", Dimension::Compliance, 1e-6),
            ("nm^2", Dimension::Area, 1e-18),
            ("um\u{b2}", Dimension::Area, 1e-12),
            ("deg", Dimension::Angle, std::f64::consts::PI / 180.0),
            ("mrad", Dimension::Angle, 1e-3),
            ("s", Dimension::Time, 1.0),
            ("ms", Dimension::Time, 1e-3),
            ("min", Dimension::Time, 60.0),
            ("h", Dimension::Time, 3600.0),
            ("um/s", Dimension::Speed, 1e-6),
            ("g", Dimension::Force, 9.80665e-3),
            ("mg", Dimension::Force, 9.80665e-6),
            ("kgf", Dimension::Force, 9.80665),
            ("dyn", Dimension::Force, 1e-5),
            ("dyn/cm", Dimension::ForcePerLength, 1e-3),
            ("erg/cm\u{b2}", Dimension::ForcePerLength, 1e-3),
            ("dyn/cm^2", Dimension::Modulus, 0.1),
            (
                "psi",
                Dimension::Modulus,
                0.45359237 * 9.80665 / (0.0254 * 0.0254),
            ),
            ("GPa/um", Dimension::ModulusPerLength, 1e15),
            ("N/mm^3", Dimension::ModulusPerLength, 1e9),
        ] {
            assert_eq!(Unit::parse(text), Some(Unit { dimension, size }), "{text}");
        }
        for text in [
            "", "x", "NM", "as", "N/s", "1", "measured", "a", "micro", "gpa", "J", "J/m", "m/",
            "/m", "m/V^2", "N/m/m", "N m", "N -1", "bar",
        ] {
            assert_eq!(Unit::parse(text), None, "{text}");
        }
    }
}
