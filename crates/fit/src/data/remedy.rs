//! What a user can give so that a file is read: data, which a program and a package put in the
//! words of their users.

use super::column::{Role, UNIT};
use super::heading::Reduced;
use crate::Kind;

/// What helps against a [`DataError`](super::DataError), or against what is doubted.
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

/// Returns the remedy of columns for a kind that is known.
pub fn named(columns: Vec<(Role, String)>) -> Remedy {
    Remedy::Columns(vec![Named {
        kind: None,
        columns,
        reduced: None,
    }])
}

/// Returns the remedy of one column that the user has to name.
pub fn another(role: Role) -> Remedy {
    named(vec![(role, any())])
}

/// A heading that the user has to fill in.
pub fn any() -> String {
    format!("HEADING {UNIT}")
}
