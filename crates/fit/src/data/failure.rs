//! The errors of reading. Each names the line, the column and the next step.

use std::fmt;
use std::io;

use super::lines::LONGEST;
use super::unit::Dimension;
use crate::Kind;

/// Data that cannot be read.
#[derive(Debug, thiserror::Error)]
#[error("{name}{}: {problem}", Place(self))]
pub struct DataError {
    /// The name of the measurement, for instance the path of its file.
    pub name: String,
    /// The line, from 1, if the problem is in one.
    pub line: Option<u64>,
    /// The column, if the problem is in one: its number from 1, and its heading.
    pub column: Option<(usize, String)>,
    /// What is wrong, and what to do.
    pub problem: Box<Problem>,
}

/// The line and the column of an error, as text.
struct Place<'a>(&'a DataError);

impl fmt::Display for Place<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(line) = self.0.line {
            write!(f, ", line {line}")?;
        }
        if let Some((number, heading)) = &self.0.column {
            write!(f, ", column {number}")?;
            if !heading.is_empty() {
                write!(f, " {heading:?}")?;
            }
        }
        Ok(())
    }
}

/// What is wrong with data, and what to do.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Problem {
    /// The file cannot be read.
    #[error(transparent)]
    Read(#[from] io::Error),
    /// The file is not text.
    #[error(
        "this is not text; export the curve as columns of text first, for example with the Python \
         package afmformats"
    )]
    Binary,
    /// The file is UTF-16.
    #[error("this is text in UTF-16; save it as UTF-8")]
    Utf16,
    /// Lines end in a carriage return alone.
    #[error("a line holds a carriage return; let lines end in LF or CR LF")]
    CarriageReturn,
    /// A line is too long.
    #[error("the line is longer than {LONGEST} bytes; save one row of numbers to a line")]
    LongLine,
    /// There are no rows of numbers.
    #[error(
        "no line holds two numbers; rows must hold two columns at least, separated by tabs, \
         semicolons, commas or spaces"
    )]
    NoRows,
    /// There are no points after those left out.
    #[error("{0} rows, but no point is left to fit: they are missing values or of another segment")]
    NoPoints(u64),
    /// The columns have no headings.
    #[error(
        "the rows of {columns} cells that begin here have no line of {columns} headings above \
         them; add one, or name the columns by their numbers and units: --column \"{0}=1 [um]\" \
         --column \"{1}=2 [mN]\"",
        roles[0], roles[1]
    )]
    NoHeadings {
        /// The number of columns.
        columns: usize,
        /// The columns that are needed.
        roles: [&'static str; 2],
    },
    /// A column that is needed is not recognised.
    #[error(
        "no column is recognised as {role} ({dimension}){}; the headings are {}; name the column: \
         --column \"{role}=HEADING [UNIT]\"",
        wrong
            .as_ref()
            .map(|heading| format!(": {heading:?} is not in a unit of {dimension}"))
            .unwrap_or_default(),
        list(headings)
    )]
    MissingColumn {
        /// The column.
        role: &'static str,
        /// What it must hold.
        dimension: Dimension,
        /// A heading that names it, with a unit of another dimension.
        wrong: Option<String>,
        /// The headings.
        headings: Vec<String>,
    },
    /// A heading that the user names does not exist.
    #[error(
        "no column is {wanted:?}, named as {role}; the headings are {}",
        list(headings)
    )]
    UnknownHeading {
        /// The column.
        role: &'static str,
        /// The heading or number given.
        wanted: String,
        /// The headings.
        headings: Vec<String>,
    },
    /// The headings fit no kind of measurement, or several.
    #[error(
        "{}; the headings are {}; give the kind, --kind {}, and name columns that are not \
         recognised: --column \"load=HEADING [UNIT]\"",
        if fitting.is_empty() { "the columns are recognised as no kind of measurement" }
        else { "the columns can be read as more than one kind of measurement" },
        list(headings),
        if fitting.is_empty() { Kind::ALL.map(Kind::name).join("|") }
        else { fitting.iter().map(|kind| kind.name()).collect::<Vec<_>>().join("|") }
    )]
    UnknownKind {
        /// The kinds that the headings fit.
        fitting: Vec<Kind>,
        /// The headings.
        headings: Vec<String>,
    },
    /// Two columns have the same name.
    #[error(
        "columns {} and {} could both be {role}; choose one by its number: --column {role}={}",
        numbers[0], numbers[1], numbers[0]
    )]
    Duplicate {
        /// The column.
        role: &'static str,
        /// The numbers of the two columns, from 1.
        numbers: [usize; 2],
    },
    /// A column has no unit.
    #[error("the column has no unit; name it: --column \"{role}={heading} [{example}]\"")]
    NoUnit {
        /// The column.
        role: &'static str,
        /// Its heading.
        heading: String,
        /// A unit.
        example: &'static str,
    },
    /// A deflection needs the stiffness, and in volts the sensitivity.
    #[error("a deflection is a force by the stiffness of the cantilever; give {0}")]
    NoCantilever(&'static str),
    /// A row has another number of cells.
    #[error(
        "the row has {found} cells, and the headings are {expected}; if a comma is the decimal \
         mark, separate the cells by tabs or semicolons"
    )]
    CellCount {
        /// The number of headings.
        expected: usize,
        /// The number of cells.
        found: usize,
    },
    /// A cell is no number.
    #[error("{0:?} is not a number; correct it, or let the line begin with # to leave it out")]
    NotANumber(String),
    /// A cell is infinite.
    #[error("{0:?} is not finite; correct it, or let the line begin with # to leave it out")]
    Infinite(String),
    /// A cell is empty or NaN.
    #[error(
        "the value is missing (empty or NaN), but the row has another; complete it, or let the \
         line begin with # to leave it out"
    )]
    Missing,
    /// A number with another decimal mark than those before it.
    #[error("{0:?} has another decimal mark than numbers before it; use one, point or comma")]
    DecimalMark(String),
    /// A segment that is not known.
    #[error(
        "{0:?} is not a segment; write approach (extend, loading, 0), retract (unloading, 1) or \
         pause, or split at the largest load: --segments split"
    )]
    Segment(String),
    /// A contact radius that is negative.
    #[error("contact radius = {0:?} m must not be below 0; a row without contact has 0")]
    Radius(f64),
    /// A standard deviation that cannot be.
    #[error(
        "standard deviation = {0:?} (SI) must be positive and finite, and may be 0 for a radius, \
         penetration or height; correct it, or rename the column if it is something else"
    )]
    Deviation(f64),
    /// All values of a column are equal.
    #[error(
        "all {points} values are {value:?} (SI); choose the column that was measured: --column"
    )]
    Constant {
        /// The number of points.
        points: usize,
        /// The value, in the SI unit.
        value: f64,
    },
}

/// Returns headings as text.
fn list(headings: &[String]) -> String {
    headings
        .iter()
        .map(|heading| format!("{heading:?}"))
        .collect::<Vec<_>>()
        .join(", ")
}
