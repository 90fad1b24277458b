//! What is known of a file before it is read, and what is read from it.

use std::fs::File;
use std::io::{BufRead, BufReader};
use std::path::Path;

use units::{Dimension, Quantity};

use super::column::{Column, Role};
use super::doubt::Doubt;
use super::failure::DataError;
use super::head::{Head, HeadValue};
use super::number::Marks;
use super::rows;
use super::segment::Split;
use super::source::Source;
use crate::{Direction, Kind, Measurement, PointErrors};

/// What is known about a file before it is read.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Format {
    /// The kind of the measurement; `None`: the only one that the columns fit.
    pub kind: Option<Kind>,
    /// Columns that the user names. Others are recognised.
    pub columns: Vec<Column>,
    /// The cantilever, which turns a deflection into a force. What it leaves open, the head of the
    /// file may name.
    pub cantilever: Cantilever,
    /// Where the directions come from.
    pub segments: Segments,
    /// The only direction to be kept. `None`: all, but of a contact stiffness at loads or depths
    /// that of approach.
    pub only: Option<Direction>,
    /// The least and the largest abscissa to be kept.
    pub between: Option<[Quantity; 2]>,
    /// Whether the rows in which the sphere rests are kept, which a history needs.
    pub keep_pauses: bool,
}

/// A cantilever.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Cantilever {
    /// The stiffness, N/m.
    pub stiffness: Option<f64>,
    /// The sensitivity, metres of deflection for each volt.
    pub sensitivity: Option<f64>,
}

named! {
    /// Where the directions of points come from.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
    pub enum Segments {
        /// From the file. Heights without a direction are split where they turn back.
        #[default]
        Auto = "auto",
        /// From the file only.
        File = "file",
        /// Points are split where the height, the penetration or the load as abscissa turns back, and at
        /// radii at the largest ordinate, whatever the file says.
        Split = "split",
    }
}

/// A measurement, and how it was read.
#[derive(Clone, Debug, PartialEq)]
pub struct Reading {
    /// The measurement, in SI units.
    pub measurement: Measurement,
    /// The standard deviations of the points, as far as the file has columns of them.
    pub errors: PointErrors,
    /// The load of each point, N, where a contact stiffness is measured at depths: those of
    /// [`Indentation`](crate::Indentation).
    pub loads: Vec<f64>,
    /// The phase of each point, rad, where a contact stiffness has one.
    pub phases: Vec<f64>,
    /// The time of each point, s, where there is a column of times.
    pub times: Vec<f64>,
    /// How it was read.
    pub notes: Notes,
}

/// How a measurement was read.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Notes {
    /// The columns used.
    pub columns: Vec<Source>,
    /// The headings of the other columns.
    pub unused: Vec<String>,
    /// The headings of those among them that can be named as times: with a unit of time, or with the name
    /// of one and `[UNIT]` in place of the unit.
    pub unused_times: Vec<String>,
    /// The first line whose time is missing, where there is a column of times; then it is not used.
    pub untimed: Option<u64>,
    /// The number of rows that were left out because their values are missing.
    pub missing: u64,
    /// The number of rows that were left out because the sphere rests in them.
    pub pauses: u64,
    /// The number of rows that were left out because they are of the direction that was not asked
    /// for.
    pub other_segments: u64,
    /// The number of rows that were left out because their abscissa is not between those asked for.
    pub outside: u64,
    /// The number of times that headings with rows below them stand in the file.
    pub blocks: u64,
    /// How the points were split, if they were.
    pub split: Option<Split>,
    /// The decimal marks of the numbers.
    pub marks: Marks,
    /// What the head of the file tells of the cantilever.
    pub head: Head,
    /// The cantilever that was used: the one given, completed by the head.
    pub cantilever: Cantilever,
    /// Doubts about how the file was read.
    pub doubts: Vec<Doubt>,
}

impl Notes {
    /// Tells whether forces are a deflection times the stiffness of the cantilever: where deflections are read, or forces
    /// with the stiffness that the head names, or beside separations, which hold the deflection.
    pub fn has_deflection(&self) -> bool {
        let has = |role| self.columns.iter().any(|column| column.role == role);
        let differs = self.head.differs_from(self.cantilever);
        let is_of_head = has(Role::Height) && differs == Some(false);
        has(Role::Deflection) || (has(Role::Load) && (has(Role::Separation) || is_of_head))
    }

    /// Tells whether a deflection is in volts, which needs the sensitivity.
    pub fn has_volts(&self) -> bool {
        let in_volts =
            |one: &Source| one.role == Role::Deflection && one.unit.dimension == Dimension::Voltage;
        self.columns.iter().any(in_volts)
    }

    /// Returns the values of the head that the columns need, in words, each with the one that was used.
    pub fn from_head(&self) -> Vec<String> {
        let mut roles = self.columns.iter().map(|one| one.role);
        let needs_stiffness =
            roles.any(|role| matches!(role, Role::Deflection | Role::Height | Role::Separation));
        let (head, given) = (&self.head, self.cantilever);
        let stiffness = head.stiffness.as_ref().zip(given.stiffness);
        let sensitivity = head.sensitivity.as_ref().zip(given.sensitivity);
        let text = |quantity, unit, (named, used): (&HeadValue, f64)| {
            let HeadValue { value, name, line } = named;
            // Without the rounding of the unit.
            let [used, value] =
                [used, *value].map(|one| format!("{one:.14e}").parse().unwrap_or(one));
            if used == value {
                format!("{quantity} {used} {unit} from line {line}, {name:?}")
            } else {
                format!("{quantity} {used} {unit} as given, and line {line}, {name:?}, has {value}")
            }
        };
        let stiffness = stiffness.filter(|_| needs_stiffness);
        let sensitivity = sensitivity.filter(|_| self.has_volts());
        let stiffness = stiffness.map(|found| text("stiffness", "N/m", found));
        let sensitivity = sensitivity.map(|found| text("sensitivity", "m/V", found));
        stiffness.into_iter().chain(sensitivity).collect()
    }
}

/// Reads a file.
///
/// A point takes 32 bytes; while the list grows it takes up to three times as much. The text is not
/// kept.
///
/// # Errors
/// [`DataError`] naming the line and the column.
pub fn read(path: &Path, format: &Format) -> Result<Reading, DataError> {
    let name = path.display().to_string();
    match File::open(path) {
        Ok(file) => read_from(BufReader::with_capacity(1 << 16, file), &name, format),
        Err(source) => Err(DataError {
            name,
            ..source.into()
        }),
    }
}

/// Reads text from any source. The `name` is that of the measurement.
///
/// # Errors
/// As [`read`].
pub fn read_from(source: impl BufRead, name: &str, format: &Format) -> Result<Reading, DataError> {
    rows::read(source, name, format).map_err(|error| DataError {
        name: name.to_owned(),
        ..error
    })
}
