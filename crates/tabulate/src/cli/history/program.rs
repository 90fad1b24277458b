//! `--program`: what is imposed in time, as text or from a CSV file.

use std::path::Path;

use anyhow::{Context, anyhow, bail, ensure};
use contact::named;
use units::Dimension;

use super::super::heading;
use super::super::quantity::{any, read, time};
use crate::csv_file::CsvFile;
use crate::{input, printable};

/// The largest number of bytes of a file.
const LONGEST: u64 = 1 << 28;

named! {
    /// What a program imposes.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum Imposed {
        Penetration = "penetration",
        Load = "load",
        Height = "height",
    }
}

impl Imposed {
    const fn dimension(self) -> Dimension {
        match self {
            Self::Load => Dimension::Force,
            Self::Penetration | Self::Height => Dimension::Length,
        }
    }
}

/// A program: what is imposed, and times (s) with values (m or N).
#[derive(Clone, Debug)]
pub struct Program {
    pub imposed: Imposed,
    pub points: Vec<(f64, f64)>,
}

/// Tells whether the text of `--program` is the name of a file.
pub fn file(text: &str) -> Option<&Path> {
    let inline = text.trim().contains(char::is_whitespace) && text.contains(':');
    (!inline).then(|| Path::new(text))
}

impl Program {
    /// Reads `penetration 0:0 1:1um 2:0`, or the file of this name.
    pub fn parse(text: &str) -> anyhow::Result<Self> {
        if let Some(path) = file(text) {
            return Self::open(path).with_context(|| printable::path(path));
        }
        let mut words = text.split_whitespace();
        let first = words.next().unwrap_or_default();
        let imposed = Imposed::of_name(first).ok_or_else(|| {
            anyhow!(
                "--program begins with {first:?}, and must begin with what is imposed: penetration, load or height; \
                 for example --program \"penetration 0:0 1:1um 2:0\""
            )
        })?;
        let point = |word: &str| {
            let (at, value) = word.split_once(':').ok_or_else(|| {
                anyhow!("--program: {word:?} is no point: write time:value, for example 1:1um")
            })?;
            let at = time(at).map_err(|error| {
                anyhow!("--program: the time of {word:?}: {error}; times are in seconds")
            })?;
            let value = read(value, Some(imposed.dimension())).map_err(|error| {
                anyhow!("--program: the {} of {word:?}: {error}", imposed.name())
            })?;
            anyhow::Ok((at, value))
        };
        let points = words.map(point).collect::<anyhow::Result<_>>()?;
        Ok(Self { imposed, points })
    }

    /// Reads the columns `time` and `penetration`, `load` or `height` of a CSV file, in SI units or with units in the
    /// headings or cells.
    fn open(path: &Path) -> anyhow::Result<Self> {
        let (bytes, _) = input::open(path, LONGEST).context(
            "it cannot be read; --program takes a CSV file, or text such as \"penetration 0:0 1:1um 2:0\"",
        )?;
        let mut reader = CsvFile::new(bytes);
        let header = reader.header()?;
        let (mut times, mut found) = (Vec::new(), Vec::new());
        for (i, text) in header.iter().enumerate() {
            if let Some(unit) = unit_of(text, "time", Dimension::Time)? {
                times.push((i, unit));
            }
            for imposed in Imposed::ALL {
                if let Some(unit) = unit_of(text, imposed.name(), imposed.dimension())? {
                    found.push((i, unit, imposed));
                }
            }
        }
        let [(of_time, unit_of_time)] = times[..] else {
            bail!(
                "the columns are {}: there must be one column of times, with the heading time, in s, or such as time [ms]",
                names(&header)
            )
        };
        let (column, unit, imposed) = match found[..] {
            [one] => one,
            [] => bail!(
                "the columns are {}: there must be one of what is imposed, with the heading penetration or height, in m, or \
                 load, in N, or with a unit, such as penetration [um]",
                names(&header)
            ),
            _ => bail!(
                "the columns are {}: only one of penetration, load and height can be imposed; take the others out",
                names(&header)
            ),
        };
        let mut points = Vec::new();
        let mut record = csv::StringRecord::new();
        while let Some(line) = reader.read(&mut record)? {
            let value = |column: usize, dimension: Dimension, unit: f64| {
                let text = record.get(column).unwrap_or_default();
                let value = any(text).and_then(|quantity| {
                    let value = quantity
                        .of(Some(dimension))
                        .map_err(|error| error.to_string())?;
                    // A unit in the cell stands for that of the heading.
                    Ok(if quantity.dimension.is_some() {
                        value
                    } else {
                        value * unit
                    })
                });
                value.map_err(|error| anyhow!("line {line}, column {}: {error}", &header[column]))
            };
            points.push((
                value(of_time, Dimension::Time, unit_of_time)?,
                value(column, imposed.dimension(), unit)?,
            ));
        }
        ensure!(!points.is_empty(), "it holds no points");
        Ok(Self { imposed, points })
    }
}

/// Returns the size of the unit in a heading of this name; `None` for the heading of another column.
fn unit_of(heading: &str, name: &str, dimension: Dimension) -> anyhow::Result<Option<f64>> {
    let before_brackets = heading.split(['[', '(']).next().unwrap_or_default();
    match heading::named(heading, dimension) {
        Ok((found, unit)) => Ok((found == name).then_some(unit)),
        Err(error) if before_brackets.trim().eq_ignore_ascii_case(name) => Err(error),
        Err(_) => Ok(None),
    }
}

/// Lists the columns of a file.
fn names(header: &csv::StringRecord) -> String {
    header
        .iter()
        .map(printable::lines)
        .collect::<Vec<_>>()
        .join(", ")
}
