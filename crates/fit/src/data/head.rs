//! Values that the head of a file names: the cantilever.

use super::Cantilever;
use super::cells::comment;
use super::number::may_part_thousands;
use units::{Dimension, Unit};

/// A value that a line above the rows names.
#[derive(Clone, Debug, PartialEq)]
pub struct HeadValue {
    /// The value, in SI units.
    pub value: f64,
    /// Its name in the file.
    pub name: String,
    /// The line, from 1.
    pub line: u64,
}

/// What the head of a file tells.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Head {
    /// The stiffness of the cantilever, N/m.
    pub stiffness: Option<HeadValue>,
    /// The sensitivity, metres of deflection for each volt.
    pub sensitivity: Option<HeadValue>,
    /// A second value that differs from the first one, with the first.
    pub(super) conflict: Option<[HeadValue; 2]>,
    /// Why a line that names a value tells none.
    pub(super) untold: Option<String>,
}

/// A value that is looked for: names of small letters only.
struct Wanted {
    names: &'static [&'static str],
    /// The dimensions of the unit's numerator and denominator.
    unit: [Dimension; 2],
    /// The range in SI units in which a number without a unit is taken to be in SI units.
    bare: [f64; 2],
}

/// JPK, Asylum Research, Bruker, AFM Workshop and afmformats. `k` is that of Optics11.
const STIFFNESS: Wanted = Wanted {
    names: &[
        "springconstant",
        "forceconstant",
        "cantileverspringconstant",
        "cantileverstiffness",
        "springk",
        "k",
    ],
    unit: [Dimension::Force, Dimension::Length],
    bare: [1e-4, 1e4],
};

/// The sizes of the sensitivities of deflections, m/V.
pub const SENSITIVITIES: [f64; 2] = [1e-10, 1e-4];

const SENSITIVITY: Wanted = Wanted {
    names: &[
        "sensitivity",
        "invols",
        "deflectionsensitivity",
        "sensdeflsens",
        "sensdeflection",
        "cantileversensitivity",
    ],
    unit: [Dimension::Length, Dimension::Voltage],
    bare: SENSITIVITIES,
};

/// The inverse of a sensitivity.
const GAIN: Wanted = Wanted {
    names: &["lightlevergain"],
    unit: [Dimension::Voltage, Dimension::Length],
    bare: [f64::INFINITY, 0.0],
};

impl Head {
    /// Takes what a line that is no row names.
    pub fn read(&mut self, number: u64, line: &str) {
        let Some((name, unit, text)) = entry(comment(line).unwrap_or(line)) else {
            return;
        };
        let letters: String = name.chars().filter(|c| c.is_alphabetic()).collect();
        let letters = letters.to_lowercase();
        // These two are 1 in the files of instruments that are not calibrated.
        let is_workshop = matches!(letters.as_str(), "forceconstant" | "lightlevergain");
        for wanted in [STIFFNESS, SENSITIVITY, GAIN] {
            // One letter is a name together with its unit only.
            if !wanted.names.contains(&letters.as_str()) || (letters.len() == 1 && unit.is_none()) {
                continue;
            }
            let Some((value, size)) = wanted.value(&text, unit) else {
                continue;
            };
            let number_text = text.split_whitespace().next().unwrap_or_default();
            if may_part_thousands(number_text) {
                self.untold.get_or_insert_with(|| {
                    format!("line {number} has {number_text:?}, whose comma may part thousands or be a decimal mark")
                });
                continue;
            }
            if is_workshop && value == 1.0 {
                self.untold.get_or_insert_with(|| {
                    format!(
                        "line {number} has 1, the value of an instrument that is not calibrated"
                    )
                });
                continue;
            }
            let (value, slot) = match wanted.unit {
                [Dimension::Force, _] => (value * size, &mut self.stiffness),
                [Dimension::Length, _] => (value * size, &mut self.sensitivity),
                // A gain.
                _ => (1.0 / (value * size), &mut self.sensitivity),
            };
            let found = HeadValue {
                value,
                name: name.clone(),
                line: number,
            };
            match slot {
                None => *slot = Some(found),
                Some(first) if (first.value - value).abs() > 1e-6 * first.value => {
                    self.conflict.get_or_insert([first.clone(), found]);
                }
                Some(_) => {}
            }
        }
    }

    /// Tells whether a cantilever has another stiffness than the head names; `None` where one of them is not known.
    pub(super) fn differs_from(&self, used: Cantilever) -> Option<bool> {
        /// The rounding of units, as a part of the stiffness.
        const SAME: f64 = 1e-6;
        let named = self.stiffness.as_ref()?.value;
        Some((used.stiffness? / named - 1.0).abs() > SAME)
    }

    /// Returns the cantilever: what is given, completed by what the head names.
    pub fn complete(&self, given: Cantilever) -> Cantilever {
        let value = |found: &Option<HeadValue>| found.as_ref().map(|found| found.value);
        Cantilever {
            stiffness: given.stiffness.or_else(|| value(&self.stiffness)),
            sensitivity: given.sensitivity.or_else(|| value(&self.sensitivity)),
        }
    }
}

impl Wanted {
    /// Returns the number and the size of its unit. The unit is that of the name, or follows the
    /// number, or is missing.
    fn value(&self, text: &str, of_name: Option<&str>) -> Option<(f64, f64)> {
        let (number, after) = match text.split_once(char::is_whitespace) {
            Some((number, after)) => (number, Some(after.trim())),
            None => (text, None),
        };
        let value: f64 = number.replacen(',', ".", 1).parse().ok()?;
        if !(value.is_finite() && value > 0.0) {
            return None;
        }
        let size = match of_name.or(after.filter(|unit| !unit.is_empty())) {
            Some(unit) => self.size(unit)?,
            None if (self.bare[0]..=self.bare[1]).contains(&value) => 1.0,
            None => return None,
        };
        Some((value, size))
    }

    /// Returns the size of a unit such as `nN/nm`.
    fn size(&self, unit: &str) -> Option<f64> {
        let (above, below) = unit.split_once('/')?;
        let [above, below] = [Unit::parse(above)?, Unit::parse(below)?];
        ([above.dimension, below.dimension] == self.unit).then(|| above.size / below.size)
    }
}

/// Splits `name (unit): value unit`, with a tab, a colon, an equals sign, or in files of commas a
/// comma or semicolon after the name. Returns name, unit of the name and the rest.
fn entry(line: &str) -> Option<(String, Option<&str>, String)> {
    let separator = ['\t', ':', '=', ';', ','];
    let (name, value) = separator
        .iter()
        .filter_map(|&mark| line.split_once(mark))
        // `Force Constant, nN/nm: 0.1` has its unit after the comma.
        .find(|(_, value)| starts_as_a_value(value))?;
    let clean = |text: &str| {
        text.trim()
            .trim_matches(['"', '\\', '@', ':', '=', ' ', '\t'])
            .to_owned()
    };
    let name = name.trim().trim_end_matches(':');
    let (bare, unit) = match name.rsplit_once(['(', '[', '{']) {
        Some((bare, unit)) => (bare, Some(unit.trim_end_matches([')', ']', '}', ' ', '"']))),
        None => match name.rsplit_once(", ") {
            Some((bare, unit)) => (bare, Some(unit)),
            None => (name, None),
        },
    };
    // A voltage channel of Bruker has the letter V before the number.
    let value = clean(value);
    let value = value.strip_prefix("V ").unwrap_or(&value).trim();
    let value = value.trim_end_matches([',', ';', '"']).to_owned();
    Some((clean(bare), unit, value))
}

/// Tells whether the text after a separator is a number, perhaps after another separator.
fn starts_as_a_value(text: &str) -> bool {
    let text = text.trim_start_matches(['"', ' ', '\t', ':', '=']);
    let text = text.strip_prefix("V ").unwrap_or(text);
    text.starts_with(|c: char| c.is_ascii_digit() || c == '.')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_of_programs_of_instruments_are_read() {
        // Each line with its stiffness or its sensitivity.
        for case in [
            "# springConstant: 0.012233132341672661 -> 0.012233132341672661 N/m",
            "# sensitivity: 7.363581843930989E-8 -> 7.363581843930989e-8 m/V",
            "#   \"spring constant\": 0.02230065831827453, -> 0.02230065831827453 N/m",
            "#   \"sensitivity\": 9.120708714532604e-08, -> 9.120708714532604e-8 m/V",
            "k (N/m)\t0.019 -> 0.019 N/m",
            "k (N/m)\t0,019 -> 0.019 N/m",
            "Force Constant, nN/nm:\t0.25 -> 0.25 N/m",
            "Light Lever Gain, mV/nm:\t20.0 -> 5e-8 m/V",
            "\\Spring Constant: 0.06 -> 0.06 N/m",
            "\\@Sens. DeflSens: V 52.5 nm/V -> 52.5e-9 m/V",
            "SpringConstant: 0.08 -> 0.08 N/m",
            "InvOLS: 5.5e-08 -> 5.5e-8 m/V",
            "Spring constant [pN/nm];40 -> 0.04 N/m",
            "Cantilever stiffness = 0.5 N/m -> 0.5 N/m",
            "Spring constant: 0,100 N/m -> 0.1 N/m",
            // Not calibrated, without a unit, of another dimension, or of something else.
            "Force Constant, nN/nm:\t1.000000 -> ",
            "Light Lever Gain, mV/nm:\t1.000000 -> ",
            "Sensitivity: 52.5 -> ",
            "Spring constant (Pa): 3 -> ",
            "k: 3 -> ",
            "Stiffness (N/m): 1e4 -> ",
            // One or a thousand.
            "Spring constant: 1,000 mN/m -> ",
            "# force-settings.extend-k-length: 24000 -> ",
            "Date:\t15 January 2021 -> ",
        ] {
            let (line, expected) = case.split_once(" -> ").expect("two parts");
            let (number, unit) = expected.split_once(' ').unwrap_or(("NaN", ""));
            let expected: f64 = number.parse().expect("a number");
            let mut head = Head::default();
            head.read(1, line);
            for (of, found) in [("N/m", head.stiffness), ("m/V", head.sensitivity)] {
                let is_it = |found: HeadValue| {
                    (found.value - expected).abs() <= 4.0 * f64::EPSILON * expected
                };
                assert_eq!(found.map(is_it), (of == unit).then_some(true), "{line}");
            }
        }
    }
}
