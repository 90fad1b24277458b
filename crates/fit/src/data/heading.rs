//! The heading of a column: a name, a unit and perhaps a direction.

use crate::Direction;
use units::Unit;

/// A heading, read.
#[derive(Clone, Debug, PartialEq)]
pub struct Heading {
    /// The text in the file.
    pub text: String,
    /// The words without unit and direction, in lower case, one space between them.
    pub name: String,
    /// The unit, if the text names one.
    pub unit: Option<Unit>,
    /// What stands in brackets like a unit, and is none that is known: `x10 nN`.
    pub unknown: Option<String>,
    /// The direction, if the text names one beside the quantity: `Retract Force(nN)`.
    pub direction: Option<Direction>,
}

/// Pairs of brackets around a unit.
const BRACKETS: [(char, char); 3] = [('[', ']'), ('(', ')'), ('{', '}')];
/// Units that end the names of other quantities: `depth h`.
const IN_BRACKETS_ONLY: [&str; 5] = ["h", "min", "g", "mg", "kg"];
/// What separates the words of a heading.
const SEPARATORS: &str =
    "_/-,:;|=.<>)]}\"'`*#@~\\$\u{b7}\u{2022}\u{2013}\u{2014}\u{2215}\u{ff08}\u{ff09}";
/// The codes of the two letters for micro, which some programs write in their place.
const MICRO_SIGNS: [&str; 2] = ["U.00B5", "U.03BC"];
/// Words for what is no length or force of the contact itself.
const OTHERS: [&str; 9] = [
    "diam", "area", "aire", "square", "squared", "width", "log", "sqrt", "\u{f8}",
];
/// Parts of words for a diameter or an area, in several languages.
const OTHER_PARTS: [&str; 11] = [
    "diamet",
    "diam\u{e8}t",
    "di\u{e1}m",
    "durchmesser",
    "fl\u{e4}che",
    "flaeche",
    "superfic",
    "\u{76f4}\u{5f84}",
    "\u{76f4}\u{5f91}",
    "\u{9762}\u{79ef}",
    "\u{9762}\u{7a4d}",
];
/// Parts of words for a separation of tip and sample; `distance` is one unless it is that of the scanner.
const SEPARATIONS: [&str; 5] = [
    "separation",
    "s\u{e9}paration",
    "distance",
    "abstand",
    "\u{8ddd}\u{79bb}",
];
/// Parts of words for a scanner.
const SCANNERS: [&str; 4] = ["piezo", "scan", "height", "sensor"];
/// Names of a contact depth.
const CONTACT_DEPTHS: [&str; 6] = [
    "contact depth",
    "depth of contact",
    "hc",
    "h c",
    "kontakttiefe",
    "profondeur de contact",
];

/// A length that differs from a penetration or a height.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reduced {
    /// The depth of the contact below its edge: a penetration where epsilon is 0.
    ContactDepth,
    /// The separation of tip and sample: the height and the deflection together.
    Separation,
}

impl Heading {
    /// Reads a heading: `Force [mN]`, `Radius (um)`, `height_nm`, `Piezo/nm`, `Extend Force(nN)`,
    /// `stiffness_N_per_m`.
    pub fn parse(text: &str) -> Self {
        let text = text.trim();
        let (rest, mut unit) = bracketed_unit(text);
        let unknown = unknown_unit(text)
            .or_else(|| damaged_unit(text))
            .filter(|_| unit.is_none());
        let may_end_in_unit = unit.is_none() && unknown.is_none();
        let mut words: Vec<&str> = rest
            .split(|c: char| !c.is_alphanumeric())
            .filter(|word| !word.is_empty())
            .collect();
        let mut direction = None;
        if words.len() > 1 {
            words.retain(|word| match direction_of_heading(word) {
                Some(found) if direction.is_none() => {
                    direction = Some(found);
                    false
                }
                _ => true,
            });
        }
        // `stiffness_N_per_m`.
        if may_end_in_unit
            && let [.., above, per, below] = words[..]
            && per.eq_ignore_ascii_case("per")
            && words.len() > 3
        {
            unit = Unit::parse(&format!("{above}/{below}"));
            if unit.is_some() {
                words.truncate(words.len() - 3);
            }
        }
        if may_end_in_unit && unit.is_none() && words.len() > 1 {
            let last = words.last().filter(|word| !IN_BRACKETS_ONLY.contains(word));
            unit = last.and_then(|word| Unit::parse(word));
            if unit.is_some() {
                words.pop();
            }
        }
        // `Load in mN`.
        if unit.is_some() && words.len() > 1 && words.last() == Some(&"in") {
            words.pop();
        }
        Self {
            text: text.to_owned(),
            name: words.join(" ").to_lowercase(),
            unit,
            unknown,
            direction,
        }
    }

    /// Tells whether the text says that the numbers are not those of a quantity itself, but of its
    /// double, its square or a multiple: `contact diameter`, `2a`, `a^2`, `10^3 F`.
    pub fn is_derived(&self) -> bool {
        // A number alone counts columns, as `1st` does.
        let is_digit = |c: char| c.is_numeric();
        let is_multiple = |word: &str| {
            let rest = word.trim_start_matches(is_digit);
            rest.len() == 1 || rest.contains(is_digit)
        };
        let is_factor = |word: &str| {
            word.starts_with(is_digit) && is_multiple(word)
                || word.starts_with(['x', 'e']) && word[1..].starts_with(is_digit)
        };
        self.reduced().is_none()
            && (self.names_another()
                || self.text.contains(['^', '*', '\u{d7}', '\u{b2}'])
                || self.name.split(' ').any(is_factor))
    }

    /// Tells whether a word says so: `contact diameter`, `area`.
    pub fn names_another(&self) -> bool {
        let is_other = |word: &str| {
            OTHERS.contains(&word) || OTHER_PARTS.iter().any(|part| word.contains(part))
        };
        let is_area = self.name == "surface" || self.name.starts_with("surface de contact");
        is_area || self.name.split(' ').any(is_other)
    }

    /// Returns the unit that stands in brackets.
    pub fn unit_in_brackets(&self) -> Option<Unit> {
        bracketed_unit(&self.text).1
    }

    /// Returns the length that the text names, if it is one that differs.
    pub fn reduced(&self) -> Option<Reduced> {
        let has = |parts: &[&str]| parts.iter().any(|part| self.name.contains(part));
        let begins =
            |name: &&str| self.name == **name || self.name.starts_with(&format!("{name} "));
        if CONTACT_DEPTHS.iter().any(&begins) {
            Some(Reduced::ContactDepth)
        } else if (has(&SEPARATIONS) || begins(&"gap")) && !has(&SCANNERS) && !begins(&"z") {
            Some(Reduced::Separation)
        } else {
            None
        }
    }
}

/// Returns the places of opening brackets, the last one first, with the brackets that close.
fn opens(text: &str) -> impl Iterator<Item = (usize, char)> {
    let closing = |c| BRACKETS.iter().find(|(open, _)| *open == c);
    let places = text.char_indices().rev();
    places.filter_map(move |(at, c)| Some((at, closing(c)?.1)))
}

/// Returns the text of the last pair of brackets if it looks like a unit.
fn unknown_unit(text: &str) -> Option<String> {
    let (at, close) = opens(text).next()?;
    let (inner, _) = text[at + 1..].split_once(close)?;
    let inner = inner.trim();
    let has_sign = inner.contains(|c: char| c.is_numeric() || "^*/\\%\u{b7}\u{d7}".contains(c));
    let is_short = inner.split(' ').any(|word| word.chars().count() == 1);
    let is_square = close == ']' && direction_of_heading(inner).is_none();
    (!inner.is_empty() && (has_sign || is_short || is_square)).then(|| inner.to_owned())
}

/// Returns a unit that is the last word with the sign before it, where this is none that separates words: `?N`, as is
/// left of `\u{b5}N` in a file that has been read with another encoding, or `U.00B5.N`.
fn damaged_unit(text: &str) -> Option<String> {
    let is_sign = |c: char| !c.is_alphanumeric();
    let text = text.trim_end_matches(is_sign);
    let before = text.trim_end_matches(char::is_alphanumeric);
    // A unit with a prefix has lost nothing.
    let unit = &text[before.len()..];
    Unit::parse(unit).filter(|one| one.size == 1.0 || unit == "g")?;
    let words = before.trim_end_matches(is_sign);
    if let Some(code) = MICRO_SIGNS.iter().find(|code| words.ends_with(*code)) {
        return Some(text[words.len() - code.len()..].to_owned());
    }
    let (opens, signs) = match before[words.len()..].rsplit_once(['(', '[', '{']) {
        Some((_, inside)) => (true, inside),
        None => (false, &before[words.len()..]),
    };
    let separates = |c: char| c.is_whitespace() || !opens && SEPARATORS.contains(c);
    let signs = signs.trim_start_matches(separates);
    let is_damaged = !words.is_empty() && !signs.is_empty();
    is_damaged.then(|| text[before.len() - signs.len()..].to_owned())
}

/// Splits off the last pair of brackets that holds a unit.
fn bracketed_unit(text: &str) -> (String, Option<Unit>) {
    for (at, close) in opens(text) {
        let after = &text[at + 1..];
        if let Some((inner, rest)) = after.split_once(close)
            && let Some(unit) = Unit::parse(inner)
        {
            return (format!("{} {rest}", &text[..at]), Some(unit));
        }
    }
    (text.to_owned(), None)
}

fn direction_of_heading(word: &str) -> Option<Direction> {
    match word.to_lowercase().as_str() {
        "approach" | "extend" | "ex" | "trace" | "loading" => Some(Direction::Approach),
        "retract" | "retraction" | "rt" | "retrace" | "unloading" => Some(Direction::Retract),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_unit_is_in_brackets_or_in_the_last_words() {
        for (text, name, unit) in [
            ("stiffness_N_per_m", "stiffness", "N/m"),
            ("stiffness_sd_mN_per_nm", "stiffness sd", "mN/nm"),
            ("N_per_m", "n per", "m"),
            ("points per frame", "points per frame", ""),
            ("Load in mN", "load", "mN"),
            ("force (in mN)", "force", "mN"),
            // The first direction is that of the column.
            ("Retract trace force [mN]", "trace force", "mN"),
            ("Load [g]", "load", "gf"),
            ("contact depth h", "contact depth h", ""),
            // A number or a letter before the unit may be a factor.
            ("Force (x10 nN)", "force x10 nn", ""),
            ("a [1e-6 m]", "a 1e 6 m", ""),
            ("a [\\mu m]", "a mu m", ""),
            ("F (k N)", "f k n", ""),
            // Nor is a unit one whose first letter is lost.
            ("Load (?N)", "load n", ""),
            ("Load/\u{fffd}N", "load n", ""),
            ("Load..U.00B5.N.", "load u 00b5 n", ""),
            ("Load..N.", "load", "N"),
            ("Load ( N)", "load", "N"),
            ("Force [retract] N", "force", "N"),
            ("Force \u{2013} uN", "force", "uN"),
            ("Load <N>", "load", "N"),
            ("\u{8377}\u{91cd}\u{ff08}N\u{ff09}", "\u{8377}\u{91cd}", "N"),
            ("contact.radius", "contact radius", ""),
        ] {
            let found = Heading::parse(text);
            assert_eq!(
                (&*found.name, found.unit),
                (name, Unit::parse(unit)),
                "{text}"
            );
        }
    }

    #[test]
    fn a_unit_that_is_not_known_and_another_quantity_are_told() {
        for (text, unknown, is_derived) in [
            ("a [um]", None, false),
            ("Load 2 [mN]", None, false),
            ("Load_01 [mN]", None, false),
            ("1st load [mN]", None, false),
            ("Load (cor)", None, false),
            ("x10 force [nN]", None, true),
            ("Height (measured)", None, false),
            ("Force [retract]", None, false),
            ("Force (x10 nN)", Some("x10 nN"), true),
            ("a [px]", Some("px"), false),
            ("contact diameter [um]", None, true),
            ("2a [um]", None, true),
            ("a^2 [um]", None, true),
            ("1e6*a [m]", None, true),
            ("a e6 m", None, true),
            ("Load (?N)", Some("?N"), false),
            ("Load (?mN)", None, false),
            ("Load_\u{200b}N", Some("\u{200b}N"), false),
            ("Load (-N)", Some("-N"), false),
            ("Load..U.00B5.N.", Some("U.00B5.N"), true),
            ("contact.radius", None, false),
        ] {
            let heading = Heading::parse(text);
            let found = (heading.unknown.as_deref(), heading.is_derived());
            assert_eq!(found, (unknown, is_derived), "{text}");
        }
    }
}
