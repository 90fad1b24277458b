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
    /// The direction, if the text names one beside the quantity: `Retract Force(nN)`.
    pub direction: Option<Direction>,
}

/// Pairs of brackets around a unit.
const BRACKETS: [(char, char); 3] = [('[', ']'), ('(', ')'), ('{', '}')];

impl Heading {
    /// Reads a heading: `Force [mN]`, `Radius (um)`, `height_nm`, `Piezo/nm`, `Extend Force(nN)`,
    /// `stiffness_N_per_m`.
    pub fn parse(text: &str) -> Self {
        let text = text.trim();
        let (rest, mut unit) = bracketed_unit(text);
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
        if unit.is_none()
            && let [.., above, per, below] = words[..]
            && per.eq_ignore_ascii_case("per")
            && words.len() > 3
        {
            unit = Unit::parse(&format!("{above}/{below}"));
            if unit.is_some() {
                words.truncate(words.len() - 3);
            }
        }
        if unit.is_none() && words.len() > 1 {
            unit = words.last().and_then(|word| Unit::parse(word));
            if unit.is_some() {
                words.pop();
            }
        }
        Self {
            text: text.to_owned(),
            name: words.join(" ").to_lowercase(),
            unit,
            direction,
        }
    }
}

/// Splits off the last pair of brackets that holds a unit.
fn bracketed_unit(text: &str) -> (String, Option<Unit>) {
    let opens = text
        .char_indices()
        .rev()
        .filter_map(|(at, c)| Some((at, BRACKETS.iter().find(|(open, _)| *open == c)?.1)));
    for (at, close) in opens {
        let after = &text[at + 1..];
        if let Some((inner, rest)) = after.split_once(close)
            && let Some(unit) = Unit::parse(inner)
        {
            return (format!("{} {rest}", &text[..at]), Some(unit));
        }
    }
    (text.to_owned(), None)
}

/// Returns the direction that a word of a heading names.
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
    fn a_quotient_in_words_is_a_unit() {
        for (text, name, unit) in [
            ("stiffness_N_per_m", "stiffness", Unit::parse("N/m")),
            (
                "stiffness_sd_mN_per_nm",
                "stiffness sd",
                Unit::parse("mN/nm"),
            ),
            ("N_per_m", "n per", Unit::parse("m")),
            ("points per frame", "points per frame", None),
        ] {
            let heading = Heading::parse(text);
            assert_eq!(
                (heading.name.as_str(), heading.unit),
                (name, unit),
                "{text}"
            );
        }
    }
}
