//! Units of lengths, forces and voltages, as columns name them.

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
}

impl fmt::Display for Dimension {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Length => "a length",
            Self::Force => "a force",
            Self::Voltage => "a voltage",
        })
    }
}

/// A unit: a dimension, and its size in the SI unit of this dimension.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unit {
    /// The dimension.
    pub dimension: Dimension,
    /// The size in metres, newtons or volts.
    pub size: f64,
}

/// Prefixes: symbol, name, size. The size is a decimal exponent, so that it is rounded once.
const PREFIXES: [(&str, &str, i32); 13] = [
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
];

/// Units without a prefix: symbol, names, dimension.
const BASES: [(&str, &[&str], Dimension); 3] = [
    ("m", &["metre", "meter"], Dimension::Length),
    ("N", &["newton"], Dimension::Force),
    ("V", &["volt"], Dimension::Voltage),
];

impl Unit {
    /// The SI unit of a dimension.
    pub const fn si(dimension: Dimension) -> Self {
        Self {
            dimension,
            size: 1.0,
        }
    }

    /// Reads a symbol, `mN`, or a name, `micrometres`. Symbols must have the case of the SI: `mN`
    /// and `MN` differ.
    pub fn parse(text: &str) -> Option<Self> {
        let text = text.trim();
        let word = text.to_lowercase();
        let word = word.strip_suffix('s').unwrap_or(&word);
        let of = |dimension, exponent| {
            let size = power(exponent);
            Some(Self { dimension, size })
        };
        if matches!(text, "\u{c5}" | "\u{212b}") || word == "angstrom" {
            return of(Dimension::Length, -10);
        }
        if word == "micron" {
            return of(Dimension::Length, -6);
        }
        for (symbol, names, dimension) in BASES {
            for (prefix, name, exponent) in PREFIXES {
                let matches = text.strip_prefix(prefix) == Some(symbol)
                    || names
                        .iter()
                        .any(|base| word.strip_prefix(name) == Some(base));
                if matches {
                    return of(dimension, exponent);
                }
            }
        }
        None
    }
}

/// Returns the size of a prefix of the SI, by its symbol; 1 of none.
pub fn prefix(symbol: &str) -> Option<f64> {
    PREFIXES
        .iter()
        .find(|(known, ..)| *known == symbol)
        .map(|(_, _, exponent)| power(*exponent))
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
            ("Å", Dimension::Length, 1e-10),
            ("mm", Dimension::Length, 1e-3),
            ("cm", Dimension::Length, 1e-2),
            ("N", Dimension::Force, 1.0),
            ("pN", Dimension::Force, 1e-12),
            ("mN", Dimension::Force, 1e-3),
            ("MN", Dimension::Force, 1e6),
            ("nanonewton", Dimension::Force, 1e-9),
            ("mV", Dimension::Voltage, 1e-3),
            ("volts", Dimension::Voltage, 1.0),
        ] {
            assert_eq!(Unit::parse(text), Some(Unit { dimension, size }), "{text}");
        }
        for text in [
            "", "x", "NM", "s", "N/m", "1", "measured", "a", "micro", "Pa",
        ] {
            assert_eq!(Unit::parse(text), None, "{text}");
        }
    }
}
