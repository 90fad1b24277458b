//! Columns of standard deviations.

use super::failure::DataError;
use super::heading::Heading;
use super::source::{Columns, Source, unique};
use crate::Direction;
use units::Unit;

/// The words of which one makes the heading of a quantity that of its standard deviations.
const WORDS: [&str; 12] = [
    "error",
    "errors",
    "err",
    "std",
    "stdev",
    "stddev",
    "sd",
    "sigma",
    "\u{3c3}",
    "uncertainty",
    "deviation",
    "deviations",
];
/// Words that may stand beside them.
const BESIDE: [&str; 3] = ["standard", "of", "in"];
/// The words that are too usual in other headings to stand alone.
const NOT_ALONE: [&str; 5] = ["error", "errors", "err", "deviation", "deviations"];

impl Columns<'_> {
    /// Returns the column of the standard deviations of a quantity: the one that the user names, or
    /// the one that is recognised. `alone`: whether a heading without a quantity is meant.
    pub(super) fn deviation(
        &self,
        of: &Source,
        alone: bool,
        direction: Option<Direction>,
    ) -> Result<Option<Source>, DataError> {
        let Some(role) = of.role.error() else {
            return Ok(None);
        };
        let named = self.format.columns.iter().find(|one| one.role == role);
        let found: Option<(usize, Option<Unit>)> = match named {
            Some(column) => self.named(column).map(|one| Some((one.index, one.unit)))?,
            None => {
                let matches = |heading: &Heading| {
                    let is_own = quantity(heading).is_some_and(|name| {
                        of.role.headings().contains(&name.as_str()) || alone && name.is_empty()
                    });
                    is_own
                        && (heading.direction.is_none() || heading.direction == direction)
                        && heading.unit.is_none_or(|unit| role.accepts(unit))
                };
                let found = self.positions(matches);
                // Of several, that of this direction.
                let own = |index: &&usize| self.headings[**index].direction == direction;
                let own: Vec<usize> = found.iter().filter(own).copied().collect();
                let found = if own.len() == 1 { own } else { found };
                unique(role, &found)?.map(|index| (index, self.headings[index].unit))
            }
        };
        let Some((index, unit)) = found else {
            return Ok(None);
        };
        // Without a unit it has that of its quantity.
        let source = self.source(role, index, Some(unit.unwrap_or(of.unit)), false)?;
        Ok(Some(Source {
            assumed_si: unit.is_none() && of.assumed_si,
            compliance: 0.0,
            ..source
        }))
    }
}

/// Returns the quantity of which a heading names the standard deviations, empty if it names none;
/// `None` if it names no deviations.
fn quantity(heading: &Heading) -> Option<String> {
    if heading.text.contains('%') {
        return None;
    }
    let words: Vec<&str> = heading.name.split(' ').collect();
    if !words.iter().any(|word| WORDS.contains(word)) {
        return None;
    }
    if words.len() == 1 && NOT_ALONE.contains(&words[0]) {
        return None;
    }
    let is_other = |word: &&str| !WORDS.contains(word) && !BESIDE.contains(word);
    let rest = words.into_iter().filter(is_other);
    Some(rest.collect::<Vec<_>>().join(" "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn headings_of_deviations_name_their_quantity() {
        for (text, expected) in [
            ("radius_error", Some("radius")),
            ("load error [mN]", Some("load")),
            ("sigma_F", Some("f")),
            ("standard deviation of force (nN)", Some("force")),
            ("std", Some("")),
            ("standard error", Some("")),
            ("Sigma [mN]", Some("")),
            ("error", None),
            ("Load", None),
            ("std (%)", None),
            ("load error [%]", None),
        ] {
            let found = quantity(&Heading::parse(text));
            assert_eq!(found.as_deref(), expected, "{text}");
        }
    }
}
