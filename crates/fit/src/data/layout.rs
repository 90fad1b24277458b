//! Where the rows of numbers begin, what separates their cells, and which line names the columns.

use super::cells::{Delimiter, comment};
use super::heading::Heading;
use super::number::{Cell, DecimalMark};
use super::unit::Unit;

/// The number of equal lines in a row that are taken for rows of numbers.
const ROWS: usize = 3;

/// The layout of a file.
#[derive(Clone, Debug)]
pub struct Layout {
    /// What separates the cells.
    pub delimiter: Delimiter,
    /// The number of cells of a row.
    pub cells: usize,
    /// The first row of numbers, as an index into the lines at the start of the file.
    pub first_row: usize,
    /// The lines that could be the headings, the nearest to the rows first.
    pub headings: Vec<Vec<Heading>>,
}

/// Lines with the same number of cells, two of them numbers, for one delimiter.
#[derive(Clone, Copy, Debug, Default)]
struct Run {
    cells: usize,
    first: usize,
    rows: usize,
}

/// Searches the lines at the start of a file for rows of numbers.
#[derive(Clone, Debug, Default)]
pub struct Search {
    lines: Vec<String>,
    runs: [Run; Delimiter::ALL.len()],
}

impl Search {
    /// Adds a line. Returns true when the rows are found.
    pub fn push(&mut self, line: &str) -> bool {
        let index = self.lines.len();
        self.lines.push(line.to_owned());
        if line.trim().is_empty() || comment(line).is_some() {
            return false;
        }
        for (delimiter, run) in Delimiter::ALL.into_iter().zip(&mut self.runs) {
            let cells = row(delimiter, line).unwrap_or(0);
            if cells != run.cells {
                *run = Run {
                    cells,
                    first: index,
                    rows: 0,
                };
            }
            run.rows += usize::from(cells > 0);
        }
        self.found(ROWS).is_some()
    }

    /// Returns the layout and the lines; `None` without rows of numbers.
    pub fn finish(self) -> Option<(Layout, Vec<String>)> {
        let (delimiter, run) = self.found(ROWS).or_else(|| self.found(1))?;
        let last_is_empty = delimiter
            .split(&self.lines[run.first])
            .last()
            .is_some_and(str::is_empty);
        let layout = Layout {
            delimiter,
            cells: run.cells,
            first_row: run.first,
            headings: headings(&self.lines[..run.first], delimiter, |cells| {
                cells == run.cells || (last_is_empty && cells + 1 == run.cells)
            }),
        };
        Some((layout, self.lines))
    }

    fn found(&self, rows: usize) -> Option<(Delimiter, Run)> {
        Delimiter::ALL
            .into_iter()
            .zip(self.runs)
            .find(|(_, run)| run.rows >= rows)
    }
}

/// Returns the number of cells of a row of numbers; `None` for any other line.
fn row(delimiter: Delimiter, line: &str) -> Option<usize> {
    let mut mark = DecimalMark::default();
    let (mut cells, mut numbers) = (0, 0);
    for cell in delimiter.split(line) {
        cells += 1;
        match mark.read(cell) {
            Cell::Number(_) | Cell::Infinite => numbers += 1,
            // Numbers that another delimiter separates.
            Cell::Text
                if cell.starts_with(|c: char| c.is_ascii_digit() || "+-.".contains(c))
                    && cell.contains([';', ',', ' ', '\t']) =>
            {
                return None;
            }
            _ => {
                // A missing number counts only in a row that has others.
                numbers += usize::from(cell.eq_ignore_ascii_case("nan"));
            }
        }
    }
    (numbers >= 2).then_some(cells)
}

/// Returns the lines that could be headings, the last first, a line of units joined to its names.
fn headings(
    lines: &[String],
    delimiter: Delimiter,
    fits: impl Fn(usize) -> bool,
) -> Vec<Vec<Heading>> {
    let texts = lines.iter().rev().filter_map(|line| {
        let mut text = comment(line).unwrap_or_else(|| line.trim_end_matches(['\r', '\n']));
        for label in ["columns:", "units:"] {
            text = text.strip_prefix(label).map_or(text, str::trim);
        }
        let cells = delimiter.split_headings(text);
        let words = cells
            .iter()
            .filter(|cell| cell.starts_with(char::is_alphabetic) || cell.starts_with(['[', '(']))
            .count();
        (fits(cells.len()) && words >= 2).then_some(cells)
    });
    let mut found: Vec<Vec<Heading>> = Vec::new();
    let mut units: Option<Vec<String>> = None;
    for cells in texts {
        if units.is_none() && are_units(&cells) {
            units = Some(cells);
            continue;
        }
        let unit = |i: usize| units.as_ref().and_then(|units| unit(units.get(i)?));
        found.push(
            cells
                .iter()
                .enumerate()
                .map(|(i, text)| {
                    let heading = Heading::parse(text);
                    Heading {
                        unit: heading.unit.or_else(|| unit(i)),
                        ..heading
                    }
                })
                .collect(),
        );
    }
    found
}

/// Returns true for a line of units: two cells at least are units, and no other cell is longer than
/// a unit's symbol.
fn are_units(cells: &[String]) -> bool {
    cells.iter().filter(|cell| unit(cell).is_some()).count() >= 2
        && cells
            .iter()
            .all(|cell| unit(cell).is_some() || cell.chars().count() <= 4)
}

fn unit(cell: &str) -> Option<Unit> {
    Unit::parse(cell.trim_matches(['[', ']', '(', ')', '{', '}']))
}
