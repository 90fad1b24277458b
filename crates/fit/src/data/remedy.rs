//! What a user can give so that a file is read: data, which a program and a package put in the
//! words of their users.

use super::column::Role;
use super::failure::{DataError, Missing, Problem};
use super::sign::Doubt;
use crate::Kind;

/// What helps against a [`Problem`] or a [`Doubt`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Remedy {
    /// To name columns: each by its heading with a unit. The heading is `HEADING [UNIT]` where it
    /// cannot be told, and begins with a minus where the numbers count in the opposite sense.
    Columns {
        /// The kind to be given, if several were tried.
        kind: Option<Kind>,
        /// What the columns hold, and their headings.
        columns: Vec<(Role, String)>,
    },
    /// To give one of these kinds.
    Kind(Vec<Kind>),
    /// To give the stiffness of the cantilever, and its sensitivity, too.
    Cantilever {
        /// Whether the sensitivity is needed.
        sensitivity: bool,
    },
    /// To split the points at the largest load.
    Split,
}

impl DataError {
    /// Returns what helps, if that is not to mend the file.
    pub fn remedy(&self) -> Option<Remedy> {
        let column = |role: Role, heading: String| Remedy::Columns {
            kind: None,
            columns: vec![(role, heading)],
        };
        Some(match &*self.problem {
            Problem::MissingColumns { kinds, columns } => {
                // The kind for which most columns can be told.
                let told = |one: &&Missing| one.candidates(columns).iter().flatten().count();
                let best = kinds.iter().rev().max_by_key(told)?;
                let candidates = best.candidates(columns);
                let named = best.roles.iter().zip(candidates).map(|(role, found)| {
                    let heading = found.map(|found| found.heading.clone());
                    (*role, heading.unwrap_or_else(|| any(*role)))
                });
                Remedy::Columns {
                    kind: (kinds.len() > 1).then_some(best.kind),
                    columns: named.collect(),
                }
            }
            Problem::UnknownHeading { role, .. }
            | Problem::WrongUnit { role, .. }
            | Problem::Constant { role, .. } => column(*role, any(*role)),
            Problem::SeveralKinds { kinds, .. } => Remedy::Kind(kinds.clone()),
            Problem::Duplicate { role, numbers } => column(*role, numbers[0].to_string()),
            Problem::NoUnit { role, heading } => {
                column(*role, format!("{heading} [{}]", role.example()))
            }
            Problem::NoHeadings { roles, .. } => Remedy::Columns {
                kind: None,
                columns: (1..)
                    .zip(roles)
                    .map(|(i, role)| (*role, format!("{i} [{}]", role.example())))
                    .collect(),
            },
            Problem::NoCantilever { volts, .. } => Remedy::Cantilever {
                sensitivity: *volts,
            },
            Problem::TwoValues { .. } => Remedy::Cantilever { sensitivity: true },
            Problem::Segment(_) => Remedy::Split,
            _ => return None,
        })
    }
}

impl Doubt {
    /// Returns what helps if the doubt is right.
    pub fn remedy(&self) -> Remedy {
        let minus = if self.abscissa.factor < 0.0 { "" } else { "-" };
        let heading = format!("{minus}{}", self.abscissa.heading);
        Remedy::Columns {
            kind: None,
            columns: vec![(self.abscissa.role, heading)],
        }
    }
}

/// A heading that the user has to fill in.
fn any(role: Role) -> String {
    format!("HEADING [{}]", role.example())
}
