//! `--program`: what is imposed in time, as text or from a CSV file.

use std::path::Path;

use anyhow::{Context, anyhow, bail, ensure};
use units::Dimension;

use super::super::quantity::{read, time};
use crate::csv_file::CsvFile;
use crate::input;
use crate::printable;

/// The largest number of bytes of a file.
const LONGEST: u64 = 1 << 28;

/// What a program imposes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Imposed {
    Penetration,
    Load,
    Height,
}

impl Imposed {
    const ALL: [Self; 3] = [Self::Penetration, Self::Load, Self::Height];

    const fn word(self) -> &'static str {
        match self {
            Self::Penetration => "penetration",
            Self::Load => "load",
            Self::Height => "height",
        }
    }

    const fn dimension(self) -> Dimension {
        match self {
            Self::Load => Dimension::Force,
            Self::Penetration | Self::Height => Dimension::Length,
        }
    }

    fn of_word(word: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|imposed| imposed.word() == word)
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
        let imposed = Imposed::of_word(first).ok_or_else(|| {
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
                anyhow!("--program: the {} of {word:?}: {error}", imposed.word())
            })?;
            anyhow::Ok((at, value))
        };
        let points = words.map(point).collect::<anyhow::Result<_>>()?;
        Ok(Self { imposed, points })
    }

    /// Reads the columns `time` and `penetration`, `load` or `height` of a CSV file.
    fn open(path: &Path) -> anyhow::Result<Self> {
        let (bytes, _) = input::open(path, LONGEST).context(
            "it cannot be read; --program takes a CSV file, or text such as \"penetration 0:0 1:1um 2:0\"",
        )?;
        let mut reader = CsvFile::new(bytes);
        let header = reader.header()?;
        let mut times = (0..header.len()).filter(|&i| header[i] == *"time");
        let (Some(of_time), None) = (times.next(), times.next()) else {
            bail!(
                "the columns are {}: there must be one column named time (s)",
                names(&header)
            )
        };
        let found: Vec<(usize, Imposed)> = header
            .iter()
            .enumerate()
            .filter_map(|(i, name)| Some((i, Imposed::of_word(name)?)))
            .collect();
        let (column, imposed) = match found[..] {
            [one] => one,
            [] => bail!(
                "the columns are {}: there must be one named penetration (m), load (N) or height (m), which is imposed",
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
            let value = |column: usize, dimension: Dimension| {
                let text = record.get(column).unwrap_or_default();
                read(text, Some(dimension))
                    .map_err(|error| anyhow!("line {line}, column {}: {error}", &header[column]))
            };
            points.push((
                value(of_time, Dimension::Time)?,
                value(column, imposed.dimension())?,
            ));
        }
        ensure!(!points.is_empty(), "it holds no points");
        Ok(Self { imposed, points })
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
