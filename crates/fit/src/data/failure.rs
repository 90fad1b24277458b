//! The errors of reading. Each names the line, the column and what is wrong; what a user can do
//! about it, a program adds in the words of its users.

use std::{fmt, io};

use super::column::Role;
use super::head::Untold;
use super::heading::{Heading, Reduced};
use crate::Kind;
use units::QuantityError;

/// The longest line, in bytes. A longer one is not a row of a measurement.
pub const LONGEST: usize = 1 << 16;

/// Data that cannot be read.
#[derive(Debug, thiserror::Error)]
#[error("{name}{}: {problem}", place(self))]
pub struct DataError {
    /// The name of the measurement, for instance the path of its file.
    pub name: String,
    /// The line, from 1, if the problem is in one.
    pub line: Option<u64>,
    /// The column, if the problem is in one: its number from 1, and its heading.
    pub column: Option<(usize, String)>,
    /// What is wrong.
    pub problem: Box<Problem>,
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

/// The measurement and the place are named where they are known.
impl From<Problem> for DataError {
    fn from(problem: Problem) -> Self {
        Self {
            name: String::new(),
            line: None,
            column: None,
            problem: Box::new(problem),
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

/// What is wrong with data.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Problem {
    /// The file cannot be read.
    #[error(transparent)]
    Read(#[from] io::Error),
    /// The file is not text.
    #[error("this is {0}, not text; save or export the measurement as columns of text first")]
    Binary(&'static str),
    /// A line is too long.
    #[error("the line is longer than {LONGEST} bytes; save one row of numbers to a line")]
    LongLine,
    /// There is no text.
    #[error("the file is empty")]
    Empty,
    /// A cantilever that turns no deflection into a force.
    #[error(
        "a stiffness of {stiffness:?} N/m{} turns no deflection into a force; the stiffness must be \
         positive and finite, and the sensitivity (m/V) finite and not 0",
        .sensitivity.map_or_else(String::new, |value| format!(" with a sensitivity of {value:?} m/V"))
    )]
    NoForce {
        /// The stiffness of the cantilever, N/m.
        stiffness: f64,
        /// The sensitivity, m/V, of a deflection in volts.
        sensitivity: Option<f64>,
    },
    /// There are headings, and no rows of numbers.
    #[error(
        "{headings:?} are headings, but no row of numbers follows them; {}",
        match (row, cell) {
            (Some(row), Some(cell)) => format!(
                "the first line below is {row:?}, in which {cell:?} is not a number: save plain numbers, \
                 such as 1.5e-3, with their unit in the heading"
            ),
            (Some(row), None) => format!(
                "the first line below is {row:?}, which holds fewer than two numbers: write each point \
                 on a line of its own"
            ),
            _ => "save the rows of the measurement, too".to_owned(),
        }
    )]
    OnlyHeadings {
        /// The line of headings.
        headings: String,
        /// The first line below them that holds a digit.
        row: Option<String>,
        /// The first cell of this line that holds a digit and is no number.
        cell: Option<String>,
    },
    /// There are no rows of numbers.
    #[error(
        "no line holds two numbers, and the file begins with {start:?}; a measurement is a table of \
         two columns at least, separated by tabs, semicolons, commas or spaces"
    )]
    NoRows {
        /// The start of the first line.
        start: String,
    },
    /// A range of the abscissae with the unit of another quantity.
    #[error("the range asked for: {0}")]
    Between(#[source] QuantityError),
    /// All points are outside the range of the abscissae that was asked for.
    #[error(
        "no point is left to fit: the range asked for is from {least:?} to {most:?} {unit}, and the points are from {first:?} \
         to {last:?} {unit}; ask for a range that holds points, in SI units or with its unit",
        least = .asked[0], most = .asked[1], first = .found[0], last = .found[1]
    )]
    OutsideRange {
        /// The ends of the range.
        asked: [f64; 2],
        /// The least and the largest abscissa.
        found: [f64; 2],
        /// The SI unit.
        unit: &'static str,
    },
    /// There are no points after those left out.
    #[error(
        "{0} rows, but no point is left to fit: they are missing values, or of another segment"
    )]
    NoPoints(u64),
    /// A comma may be the decimal mark and separate the cells.
    #[error(
        "the rows of {cells} cells that begin here stand below {headings} headings: if the comma is the decimal mark and \
         also separates the cells, save the file with semicolons or tabs between the cells, or with decimal points; else \
         give each column a heading"
    )]
    TwofoldCommas {
        /// The number of cells of a row.
        cells: usize,
        /// The number of headings.
        headings: usize,
    },
    /// The columns have no headings.
    #[error(
        "the rows of {columns} cells that begin here have no line of {columns} headings above \
         them; add one, or name the columns by their numbers and units, such as {:?} of {}",
        roles[0].example(),
        roles[0].name()
    )]
    NoHeadings {
        /// The number of columns.
        columns: usize,
        /// The columns that are needed.
        roles: [Role; 2],
    },
    /// Columns that are needed are not recognised.
    #[error(
        "{}; the columns are {}{}",
        if let [one] = &kinds[..] { one.to_string() }
        else { format!("the headings fit no kind of measurement: {}", list(kinds, "; ")) },
        list(columns, ", "),
        if columns.iter().any(Found::is_to_convert) {
            "; convert the numbers of a column that is a diameter, a square or a multiple, or in an \
             unknown unit, and name the quantity and its unit in the heading"
        } else {
            ""
        }
    )]
    MissingColumns {
        /// The kinds that were tried, those that lack least first.
        kinds: Vec<Missing>,
        /// The columns of the file.
        columns: Vec<Found>,
    },
    /// A heading that the user names does not exist.
    #[error("no column is {wanted:?}, named as {}; the columns are {}", role.name(), list(columns, ", "))]
    UnknownHeading {
        /// The column.
        role: Role,
        /// The heading or number given.
        wanted: String,
        /// The columns of the file.
        columns: Vec<Found>,
    },
    /// The column that the user names has a unit of another dimension.
    #[error("{heading:?} is named as {}, and is not in a unit of {}", role.name(), role.dimension())]
    WrongUnit {
        /// What it is named as.
        role: Role,
        /// The heading.
        heading: String,
    },
    /// The headings fit several kinds of measurement.
    #[error(
        "the columns can be read as more than one kind of measurement, {}; the columns are {}",
        kinds.iter().map(|kind| kind.name()).collect::<Vec<_>>().join(", "),
        list(columns, ", ")
    )]
    SeveralKinds {
        /// The kinds that the headings fit.
        kinds: Vec<Kind>,
        /// The columns of the file.
        columns: Vec<Found>,
    },
    /// Two columns have the same name.
    #[error("columns {} and {} could both be {}; choose one by its number", numbers[0], numbers[1], role.name())]
    Duplicate {
        /// The column.
        role: Role,
        /// The numbers of the two columns, from 1.
        numbers: [usize; 2],
    },
    /// A column has no unit.
    #[error("{heading:?}, read as {}, has no unit; name its unit, such as {:?}", role.name(), role.example())]
    NoUnit {
        /// The column.
        role: Role,
        /// Its heading, or its number.
        heading: String,
    },
    /// A column has a unit that is not known.
    #[error(
        "{heading:?}, read as {}, is in {unit:?}, which is not a known unit{}; convert the numbers, or \
         name a unit that {unit:?} stands for, such as {:?}",
        role.name(),
        if unit.contains(|c: char| c.is_ascii_alphabetic()) && !unit.starts_with(char::is_alphanumeric) {
            ": its first letter, such as that of micro, is lost"
        } else {
            ""
        },
        role.example()
    )]
    UnknownUnit {
        /// The column.
        role: Role,
        /// Its heading.
        heading: String,
        /// What stands in place of a unit.
        unit: String,
    },
    /// A deflection needs the stiffness, and in volts the sensitivity.
    #[error(
        "a deflection is a force by the stiffness (N/m) of the cantilever{}, and the file does not \
         name {}{}",
        if *volts { " and, in volts, the sensitivity (m/V)" } else { "" },
        if *volts { "both" } else { "it" },
        untold.as_ref().map(|untold| format!(": {untold}")).unwrap_or_default(),
    )]
    NoCantilever {
        /// Whether the deflection is in volts.
        volts: bool,
        /// Why a line that names a value tells none.
        untold: Option<Untold>,
    },
    /// A separation needs the stiffness.
    #[error(
        "a separation of tip and sample is the height and the deflection together, and the height follows from it by the \
         force and the stiffness (N/m) of the cantilever, which the file does not name{}",
        .0.as_ref().map(|untold| format!(": {untold}")).unwrap_or_default(),
    )]
    NoStiffness(Option<Untold>),
    /// Two heads of a file differ in a value that is used.
    #[error(
        "{name:?} is {} in line {} and {} in line {}; say which one holds",
        values[0], lines[0], values[1], lines[1]
    )]
    TwoValues {
        /// Its name in the file.
        name: String,
        /// The two values, in SI units.
        values: [f64; 2],
        /// Their lines.
        lines: [u64; 2],
    },
    /// A row has another number of cells.
    #[error(
        "the row has {found} cells, and the headings are {expected}; {}",
        if found > expected {
            "if a comma is the decimal mark, separate the cells by tabs or semicolons"
        } else {
            "complete the row, or let the line begin with # to leave it out"
        }
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
    /// A word stands where all rows before have a number.
    #[error(
        "{0:?} stands in a column that has only numbers above; if this row is no point, let the line \
         begin with # to leave it out, else remove the word"
    )]
    Word(String),
    /// A cell is infinite.
    #[error("{0:?} is not finite; correct it, or let the line begin with # to leave it out")]
    Infinite(String),
    /// A cell is empty or NaN.
    #[error(
        "the value is missing (empty, NaN or above 1e300), but the row has another; complete it, \
         or let the line begin with # to leave it out"
    )]
    MissingValue,
    /// A number with another decimal mark than those before it.
    #[error(
        "{text:?} has another decimal mark than numbers before it; {}",
        match thousands {
            Some(mark) => format!(
                "if {mark:?} parts thousands, remove it from all numbers (replace {mark:?} by nothing); else \
                 write one decimal mark, point or comma"
            ),
            None => "use one, point or comma".to_owned(),
        }
    )]
    DecimalMark {
        /// The number.
        text: String,
        /// The mark that may part thousands, in this number or in those before it.
        thousands: Option<char>,
    },
    /// A number with a separator of thousands.
    #[error("{0:?} has a separator of thousands; save the numbers without it")]
    Thousands(String),
    /// A segment that is not known.
    #[error(
        "{0:?} is not a segment; write approach (extend, loading, 0), retract (unloading, 1) or \
         pause, or let the points be split where the motion turns back"
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
    /// Some points have standard deviations of a quantity, and others have none.
    #[error(
        "some rows have standard deviations of {} and others have none; give all rows a column of \
         them, or rename it",
        .0.name()
    )]
    SomeDeviations(Role),
    /// All values of a column are equal.
    #[error("all {points} values are {value:?} (SI); choose the column that was measured")]
    Constant {
        /// What the column is read as.
        role: Role,
        /// The number of points.
        points: usize,
        /// The value, in the SI unit.
        value: f64,
    },
}

fn list<T: fmt::Display>(items: &[T], separator: &str) -> String {
    let texts: Vec<String> = items.iter().map(ToString::to_string).collect();
    texts.join(separator)
}
