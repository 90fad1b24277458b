//! What a user can give so that a file is read: data, which a program and a package put in the
//! words of their users.

use super::column::{Role, UNIT};
use super::failure::{DataError, Found, Missing, Problem};
use super::heading::Reduced;
use crate::Kind;

/// What helps against a [`Problem`], or against what is doubted.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Remedy {
    /// To name columns, in one of these ways.
    Columns(Vec<Named>),
    /// To give one of these kinds.
    Kind(Vec<Kind>),
    /// To give the stiffness of the cantilever, and its sensitivity, too.
    Cantilever {
        /// Whether the sensitivity is needed.
        sensitivity: bool,
    },
    /// To split the points by the program.
    Split,
    /// To free the slope of the baseline, beside what else is free.
    BaselineSlope,
}

/// Columns that a user names.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Named {
    /// The kind to be given, if it is open.
    pub kind: Option<Kind>,
    /// What the columns hold, and their headings with units. A heading is `HEADING [UNIT]` where it
    /// cannot be told, ends in `[UNIT]` where the unit cannot, and begins with a minus where the numbers
    /// count in the opposite sense.
    pub columns: Vec<(Role, String)>,
    /// What one of the columns is in truth: a contact depth needs an epsilon of 0, and a separation the stiffness of the
    /// cantilever.
    pub reduced: Option<Reduced>,
}

impl Remedy {
    /// Returns what is to be filled in, in words.
    pub fn to_fill_in(&self) -> Option<String> {
        let Self::Columns(ways) = self else {
            return None;
        };
        let columns = ways.iter().flat_map(|way| &way.columns);
        let open = columns.filter(|(_, heading)| heading.ends_with(UNIT));
        let mut examples: Vec<&str> = open.map(|(role, _)| role.example()).collect();
        examples.sort_unstable();
        examples.dedup();
        let examples = examples.join(" or ");
        (!examples.is_empty())
            .then(|| format!("with the unit of the numbers in place of UNIT, such as {examples}"))
    }
}

impl DataError {
    /// Returns what helps, if that is not to mend the file.
    pub fn remedy(&self) -> Option<Remedy> {
        let column = |role: Role, heading: String| named(vec![(role, heading)]);
        Some(match &*self.problem {
            // What is missing may be among the columns that are to be converted.
            Problem::MissingColumns { kinds, columns }
                if columns.iter().any(Found::is_to_convert)
                    && kinds
                        .iter()
                        .all(|one| one.candidates(columns).contains(&None)) =>
            {
                return None;
            }
            Problem::MissingColumns { kinds, columns } => {
                // The kinds for which most columns can be told.
                let told = |one: &Missing| one.candidates(columns).iter().flatten().count();
                let most = kinds.iter().map(told).max()?;
                let likely = kinds.iter().filter(|one| told(one) == most);
                let way = |one: &Missing| {
                    let candidates = one.candidates(columns).into_iter();
                    let heading = |(role, found): (&Role, Option<&Found>)| match found {
                        Some(found) if found.heading.reduced() == Some(Reduced::Separation) => {
                            (Role::Separation, found.heading.text.clone())
                        }
                        Some(found) => (found.role.unwrap_or(*role), found.heading.text.clone()),
                        None => (*role, any()),
                    };
                    let reduced = candidates
                        .clone()
                        .flatten()
                        .find_map(|found| found.heading.reduced());
                    Named {
                        kind: (kinds.len() > 1).then_some(one.kind),
                        columns: one.roles.iter().zip(candidates).map(heading).collect(),
                        reduced,
                    }
                };
                Remedy::Columns(likely.map(way).collect())
            }
            Problem::UnknownHeading { role, .. }
            | Problem::WrongUnit { role, .. }
            | Problem::Constant { role, .. } => column(*role, any()),
            Problem::SeveralKinds { kinds, .. } => Remedy::Kind(kinds.clone()),
            Problem::Duplicate { role, numbers } => column(*role, numbers[0].to_string()),
            Problem::NoUnit { role, heading } | Problem::UnknownUnit { role, heading, .. } => {
                column(*role, format!("{heading} {UNIT}"))
            }
            Problem::NoHeadings { roles, .. } => {
                let numbered = (1..).zip(roles);
                let column = |(i, role): (usize, &Role)| (*role, format!("{i} {UNIT}"));
                named(numbered.map(column).collect())
            }
            Problem::NoCantilever { volts, .. } => Remedy::Cantilever {
                sensitivity: *volts,
            },
            Problem::NoStiffness(_) => Remedy::Cantilever { sensitivity: false },
            Problem::TwoValues { .. } => Remedy::Cantilever { sensitivity: true },
            Problem::Segment(_) => Remedy::Split,
            _ => return None,
        })
    }
}

/// Returns the remedy of columns for a kind that is known.
pub fn named(columns: Vec<(Role, String)>) -> Remedy {
    Remedy::Columns(vec![Named {
        kind: None,
        columns,
        reduced: None,
    }])
}

/// A heading that the user has to fill in.
fn any() -> String {
    format!("HEADING {UNIT}")
}
