//! The errors of reading. Each names the line, the column and what is wrong; what a user can do
//! about it, a program adds in the words of its users.

use std::{fmt, io};

use super::column::Role;
use super::heading::{Heading, Reduced};
use super::remedy::Remedy;
use crate::Kind;

/// Data that cannot be read.
#[derive(Debug, thiserror::Error)]
#[error("{name}{}: {what}", place(self))]
pub struct DataError {
    /// The name of the measurement, for instance the path of its file.
    pub name: String,
    /// The line, from 1, if the problem is in one.
    pub line: Option<u64>,
    /// The column, if the problem is in one: its number from 1, and its heading.
    pub column: Option<(usize, String)>,
    /// What is wrong, in words.
    pub what: String,
    /// What helps, if that is not to mend the file.
    pub remedy: Option<Box<Remedy>>,
    /// The error of the system, if the file cannot be read.
    pub of_system: Option<io::Error>,
    /// Whether the line may be no row, if it holds words.
    pub(super) may_be_a_head: bool,
}

impl DataError {
    /// The error of a problem in words, whose measurement and place are named where they are known.
    pub(super) fn new(what: impl Into<String>) -> Self {
        Self {
            name: String::new(),
            line: None,
            column: None,
            what: what.into(),
            remedy: None,
            of_system: None,
            may_be_a_head: false,
        }
    }

    pub(super) fn with(self, remedy: Remedy) -> Self {
        let remedy = Some(Box::new(remedy));
        Self { remedy, ..self }
    }

    /// Says that the line may be no row, if it holds words.
    pub(super) fn of_words(self) -> Self {
        Self {
            may_be_a_head: true,
            ..self
        }
    }

    pub(super) fn in_line(self, number: u64) -> Self {
        let line = Some(number);
        Self { line, ..self }
    }

    /// Names the column `index`, from 0.
    pub(super) fn in_column(self, index: usize, heading: &str) -> Self {
        let column = Some((index + 1, heading.to_owned()));
        Self { column, ..self }
    }
}

/// Returns the line and the column of an error, as text.
fn place(error: &DataError) -> String {
    let line = error.line.map(|line| format!(", line {line}"));
    let column = match &error.column {
        Some((number, heading)) if heading.is_empty() => format!(", column {number}"),
        Some((number, heading)) => format!(", column {number} {heading:?}"),
        None => String::new(),
    };
    line.unwrap_or_default() + &column
}

impl From<io::Error> for DataError {
    fn from(error: io::Error) -> Self {
        Self {
            what: error.to_string(),
            of_system: Some(error),
            ..Self::new("")
        }
    }
}

/// A column of a file, as far as its heading tells.
#[derive(Clone, Debug, PartialEq)]
pub struct Found {
    pub(super) heading: Heading,
    /// What it is recognised as.
    pub role: Option<Role>,
}

impl Found {
    /// Tells whether the numbers are to be converted before they are read.
    pub fn is_to_convert(&self) -> bool {
        let heading = &self.heading;
        let is_derived = heading.is_derived() && heading.unit.is_some();
        self.role.is_none() && (heading.unknown.is_some() || is_derived)
    }
}

impl fmt::Display for Found {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let heading = &self.heading;
        write!(f, "{:?}", heading.text)?;
        match (self.role, heading.unit, &heading.unknown) {
            (Some(role), ..) => write!(f, " ({})", role.name()),
            (None, Some(unit), _) => match heading.reduced() {
                Some(Reduced::ContactDepth) => {
                    write!(f, " (a contact depth, which is less than the penetration)")
                }
                Some(Reduced::Separation) => {
                    write!(f, " (a separation: the height and the deflection together)")
                }
                None if heading.is_derived() => write!(f, " ({}, to be converted)", unit.dimension),
                None => write!(f, " ({})", unit.dimension),
            },
            (None, None, Some(unknown)) => write!(f, " ({unknown:?} is not a known unit)"),
            (None, None, None) => Ok(()),
        }
    }
}

/// Quantities that a kind of measurement needs and no column is recognised as.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Missing {
    /// The kind.
    pub kind: Kind,
    /// What is missing.
    pub roles: Vec<Role>,
}

impl Missing {
    /// Returns the column that could be each missing one: the first of its dimension that is
    /// recognised as nothing else, each once. A contact area gives a contact radius. A contact depth can be
    /// a penetration only where a contact stiffness is measured. A separation gives a height beside a force.
    pub fn candidates<'a>(&self, columns: &'a [Found]) -> Vec<Option<&'a Found>> {
        let mut taken: Vec<&str> = Vec::new();
        let is_force = |found: &Found| {
            let in_newtons = found
                .heading
                .unit
                .is_some_and(|unit| Role::Load.accepts(unit));
            found.role == Some(Role::Load) || in_newtons
        };
        let has_force = columns.iter().any(is_force);
        let mut candidate = |role: &Role| {
            let is_free = |found: &&Found| {
                let can_be = match found.heading.reduced() {
                    None => true,
                    Some(Reduced::ContactDepth) => {
                        *role == Role::Penetration && self.kind == Kind::StiffnessDepth
                    }
                    Some(Reduced::Separation) => *role == Role::Height && has_force,
                };
                let is_alike = found.role.is_none()
                    && !found.heading.is_derived()
                    && can_be
                    && found.heading.unit.is_some_and(|unit| role.accepts(unit));
                let is_area = *role == Role::ContactRadius && found.role == Some(Role::ContactArea);
                (is_alike || is_area) && !taken.contains(&found.heading.text.as_str())
            };
            let found = columns.iter().find(is_free)?;
            taken.push(&found.heading.text);
            Some(found)
        };
        self.roles.iter().map(&mut candidate).collect()
    }
}

impl fmt::Display for Missing {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} lacks ", self.kind.name())?;
        for (i, role) in self.roles.iter().enumerate() {
            let and = if i > 0 { " and " } else { "" };
            write!(f, "{and}{} ({})", role.name(), role.dimension())?;
        }
        Ok(())
    }
}

/// Lists texts.
pub(super) fn list<T: fmt::Display>(items: &[T], separator: &str) -> String {
    let texts: Vec<String> = items.iter().map(ToString::to_string).collect();
    texts.join(separator)
}
