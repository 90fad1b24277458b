//! Points as CSV: `a_over_t,e1_over_e2,nu1,e0_over_e2[,nu0]` in any order; for a table of one stack
//! of layers `a_over_t,e1_over_e2`.

use std::io::Write;
use std::path::Path;

use anyhow::{Context, anyhow, bail, ensure};
use interp::{Material, Quantity};

use super::output::Output;
use super::progress::progress_bar;
use crate::csv_file::CsvFile;
use crate::input::{self, Limited, Room};
use crate::printable;
use solve::parallel::try_map;

/// The largest number of points of a certificate or a comparison: they are held in memory, 200
/// bytes each.
pub const MOST_POINTS: i64 = 1_000_000;

/// One point to solve or look up.
#[derive(Clone, Copy)]
pub struct Point {
    /// The line of the file.
    pub line: u64,
    pub a_over_t: f64,
    pub material: Material,
}

/// The columns for films. The last, `nu0`, may be missing.
pub const COLUMNS: [&str; 5] = ["a_over_t", "e1_over_e2", "nu1", "e0_over_e2", "nu0"];

/// The number of columns for one stack of layers, the first of [`COLUMNS`].
const OF_STACK: usize = 2;

/// What completes the columns of a point.
#[derive(Clone, Copy)]
pub enum Given {
    /// Films, on substrates with this Poisson ratio where there is no column `nu0`.
    Films { nu0: f64 },
    /// One stack of layers: the Poisson ratio of its top layer, and of its base, and the ratio of
    /// their Young's moduli.
    Stack { nu1: f64, e0_over_e1: f64, nu0: f64 },
}

impl Given {
    fn columns(self) -> &'static [&'static str] {
        match self {
            Self::Films { .. } => &COLUMNS,
            Self::Stack { .. } => &COLUMNS[..OF_STACK],
        }
    }
}

/// The largest number of points in memory.
const BATCH: usize = 4096;
/// The largest number of bytes of a row, and of comments before it.
const LONGEST_ROW: u64 = 1 << 20;

/// The points of a file, which are read in batches. Errors name the file, the line and the value.
pub struct Points<'a> {
    path: &'a Path,
    /// The number of bytes of the file, 0 of a pipe.
    length: u64,
    reader: CsvFile<Limited>,
    /// The number of bytes that may be read until a row is complete.
    room: Room,
    columns: [Option<usize>; 5],
    given: Given,
}

impl<'a> Points<'a> {
    /// Opens a file and reads its header. What it does not hold is `given`.
    pub fn open(path: &'a Path, given: Given) -> anyhow::Result<Self> {
        let file = || printable::path(path);
        let (bytes, room) = input::open(path, LONGEST_ROW).with_context(file)?;
        let length = bytes.length();
        let mut reader = CsvFile::new(bytes);
        let header = reader.header().with_context(file)?;
        let columns = columns(&header, given.columns()).with_context(file)?;
        Ok(Self {
            path,
            length,
            reader,
            room,
            columns,
            given,
        })
    }

    /// Prints each point with its answer, in the order of the file. The points of a batch are
    /// answered in parallel, and printed before the next are read. `what` names the work, `further`
    /// the columns of [`Answer::further`].
    pub fn answer(
        mut self,
        what: &str,
        output: &Output<'_>,
        further: &[String],
        answer: impl Fn(&Point) -> anyhow::Result<Answer> + Sync,
    ) -> anyhow::Result<()> {
        let path = self.path;
        let bar = progress_bar(self.length as usize, &format!("{what}, bytes"));
        let answered = |point: anyhow::Result<Point>| {
            let point = point?;
            let answer = answer(&point).with_context(|| place(path, point.line))?;
            anyhow::Ok((point, answer))
        };
        output.stream(|out| {
            let mut writer = csv::Writer::from_writer(out);
            for number in 0.. {
                let batch = self.batch();
                ensure!(
                    number > 0 || !batch.is_empty(),
                    "{} holds no points",
                    printable::path(path)
                );
                if batch.is_empty() {
                    break;
                }
                // Nothing is written of a batch that fails, and no header where nothing follows.
                let answers = try_map(batch, answered)?;
                if number == 0 {
                    write_header(&mut writer, further)?;
                }
                for (point, answer) in &answers {
                    write_row(&mut writer, point, answer)?;
                }
                writer.flush()?;
                bar.set_position(self.reader.position());
            }
            Ok(())
        })
    }

    /// Reads the next points, none at the end of the file. The last may be an error.
    fn batch(&mut self) -> Vec<anyhow::Result<Point>> {
        let mut batch = Vec::new();
        while batch.len() < BATCH {
            let Some(point) = self.next().transpose() else {
                break;
            };
            let is_last = point.is_err();
            batch.push(point);
            if is_last {
                break;
            }
        }
        batch
    }

    fn next(&mut self) -> anyhow::Result<Option<Point>> {
        self.room.set(LONGEST_ROW);
        let mut record = csv::StringRecord::new();
        let read = self.reader.read(&mut record);
        let Some(line) = read.with_context(|| printable::path(self.path))? else {
            return Ok(None);
        };
        point(&record, self.columns, line, self.given)
            .with_context(|| place(self.path, line))
            .map(Some)
    }
}

/// Returns the position in the file of each of [`COLUMNS`], of which `names` are known.
fn columns(headers: &csv::StringRecord, names: &[&str]) -> anyhow::Result<[Option<usize>; 5]> {
    let unknown = |name: &&str| !names.contains(name);
    if let Some(name) = headers.iter().find(unknown) {
        let of_stack = if names.len() == OF_STACK && COLUMNS.contains(&name) {
            " for a table of one stack of layers"
        } else {
            ""
        };
        bail!(
            "the header has an unknown column {name:?}; the columns{of_stack} are {}",
            names.join(", ")
        );
    }
    let mut columns = [None; 5];
    for (column, &name) in columns.iter_mut().zip(names) {
        let mut places = headers
            .iter()
            .enumerate()
            .filter(|(_, header)| *header == name)
            .map(|(i, _)| i);
        *column = places.next();
        ensure!(
            column.is_some() || name == "nu0" || headers.is_empty(),
            "the header has no column {name}"
        );
        ensure!(
            places.next().is_none(),
            "the header has the column {name} twice"
        );
    }
    Ok(columns)
}

fn point(
    record: &csv::StringRecord,
    columns: [Option<usize>; 5],
    line: u64,
    given: Given,
) -> anyhow::Result<Point> {
    let mut values = match given {
        Given::Films { nu0 } => [0.0, 0.0, 0.0, 0.0, nu0],
        Given::Stack { nu1, nu0, .. } => [0.0, 0.0, nu1, 0.0, nu0],
    };
    for ((value, column), name) in values.iter_mut().zip(columns).zip(COLUMNS) {
        let Some(field) = column.and_then(|column| record.get(column)) else {
            continue;
        };
        *value = field.parse().map_err(|_| {
            anyhow!("{name} = {field:?} is not a number; the decimal mark is a point")
        })?;
    }
    let [a_over_t, e1_over_e2, nu1, mut e0_over_e2, nu0] = values;
    if let Given::Stack { e0_over_e1, .. } = given {
        // Under a rigid sphere it is `E0/E1` itself.
        let unit = if e1_over_e2 == 0.0 { 1.0 } else { e1_over_e2 };
        e0_over_e2 = e0_over_e1 * unit;
    }
    Ok(Point {
        line,
        a_over_t,
        material: Material::new(e1_over_e2, nu1, e0_over_e2, nu0)?,
    })
}

/// Returns the file and the line of a point, for an error message.
fn place(path: &Path, line: u64) -> String {
    format!("{}, line {line}", printable::path(path))
}

/// The numbers that are printed after those of a point.
pub struct Answer {
    /// None for a quantity that is missing.
    pub values: [Option<f64>; 4],
    /// The relative error.
    pub error: f64,
    /// The numbers of further columns. One that is not known is none.
    pub further: Vec<Option<f64>>,
}

fn write_header(writer: &mut csv::Writer<impl Write>, further: &[String]) -> csv::Result<()> {
    let header = COLUMNS
        .into_iter()
        .chain(Quantity::ALL.map(Quantity::name))
        .chain(["error"])
        .chain(further.iter().map(String::as_str));
    writer.write_record(header)
}

/// Writes a point and its answer. A missing number is an empty field.
fn write_row(
    writer: &mut csv::Writer<impl Write>,
    Point {
        a_over_t, material, ..
    }: &Point,
    answer: &Answer,
) -> csv::Result<()> {
    let parameters = [
        *a_over_t,
        material.e1_over_e2(),
        material.nu1(),
        material.e0_over_e2(),
        material.nu0(),
    ]
    .map(Some);
    let further = answer.further.iter().copied();
    let numbers = parameters
        .into_iter()
        .chain(answer.values)
        .chain([Some(answer.error)])
        .chain(further);
    writer.write_record(numbers.map(|value| value.map(number).unwrap_or_default()))
}

/// Returns the shortest decimal that reads back to the same f64.
pub fn number(value: f64) -> String {
    format!("{value:?}")
}

/// Returns value `i` of `count` evenly spaced ones. Between the ends it is rounded to 15 digits, so
/// that steps of 1 um print as such.
pub fn evenly([from, to]: [f64; 2], i: u32, count: u32) -> f64 {
    match i {
        0 => from,
        _ if i == count - 1 => to,
        _ => {
            let value = from + (to - from) * (f64::from(i) / f64::from(count - 1));
            format!("{value:.14e}").parse().unwrap_or(value)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hostile::each_damaged;

    #[test]
    fn damaged_points_are_refused_or_physical() {
        const SOUND: &str = "# points\na_over_t,e1_over_e2,nu1,e0_over_e2,nu0\n1,1.75,0.5,1e5,0.25\n\
             \"2\",0, 0.3 ,inf,0.1\n\n3e-1,1e-30,-0.9,1e30,0.5\n";
        const WORDS: &str = ",|\"|\"\"|\n|\r\n|\r|#|nan|-inf|1e999|0.5000001|\0| |nu0";
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("points.csv");
        let (mut refused, mut accepted) = (0, 0);
        each_damaged(SOUND.as_bytes(), WORDS, 4, |_, bytes| {
            std::fs::write(&path, bytes).expect("written");
            let Ok(mut points) = Points::open(&path, Given::Films { nu0: 0.25 }) else {
                refused += 1;
                return;
            };
            for point in points.batch() {
                if let Ok(point) = point {
                    assert!(point.material.nu1() > -1.0 && point.material.nu1() <= 0.5);
                    assert!(point.line as usize <= bytes.len() + 1);
                    accepted += 1;
                } else {
                    refused += 1;
                }
            }
        });
        println!("{refused} refused, {accepted} points accepted");
        assert!(refused > 0 && accepted > 0);
    }
}
