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
    /// The number of lines before the first row of numbers, if no line of headings is above it.
    pub head: usize,
    /// The lines that could be the headings, the nearest to the rows first.
    pub titles: Vec<Titles>,
}

/// A line that could be the headings.
#[derive(Clone, Debug)]
pub struct Titles {
    /// The headings.
    pub headings: Vec<Heading>,
    /// The number of lines up to them, and to the line of units below them.
    pub head: usize,
}

/// Lines with one number of cells for one delimiter.
#[derive(Clone, Copy, Debug, Default)]
struct Run {
    cells: usize,
    /// The index of the first line.
    first: usize,
    /// The number of lines with two numbers at least.
    rows: usize,
}

/// Searches the lines at the start of a file for rows of numbers.
#[derive(Clone, Debug, Default)]
pub struct Search {
    lines: Vec<String>,
    runs: [Run; Delimiter::ALL.len()],
    longest: [Run; Delimiter::ALL.len()],
}

impl Search {
    /// Adds a line. Returns true when the rows are found.
    pub fn push(&mut self, line: &str) -> bool {
        let index = self.lines.len();
        self.lines.push(line.to_owned());
        if line.trim().is_empty() || comment(line).is_some() {
            return false;
        }
        let runs = self.runs.iter_mut().zip(&mut self.longest);
        for (delimiter, (run, longest)) in Delimiter::ALL.into_iter().zip(runs) {
            let cells = delimiter.split(line).count();
            if cells != run.cells || is_words(delimiter, line) {
                *run = Run {
                    cells,
                    first: index,
                    rows: 0,
                };
            }
            run.rows += usize::from(is_row(delimiter, line));
            if run.rows > longest.rows {
                *longest = *run;
            }
        }
        self.longest.iter().any(|run| run.rows >= ROWS)
    }

    /// Returns the layout and the lines; `None` without rows of numbers.
    pub fn finish(self) -> Option<(Layout, Vec<String>)> {
        let most = self.longest.iter().map(|run| run.rows).max()?;
        let mut runs = Delimiter::ALL.into_iter().zip(self.longest);
        let (delimiter, run) = runs.find(|(_, run)| run.rows == most && most > 0)?;
        // The run may begin with the headings.
        let head = run.first + usize::from(is_words(delimiter, &self.lines[run.first]));
        let last_is_empty = delimiter
            .split(&self.lines[head])
            .last()
            .is_some_and(str::is_empty);
        let layout = Layout {
            delimiter,
            cells: run.cells,
            head,
            titles: titles(&self.lines[..head], delimiter, |cells| {
                cells == run.cells || (last_is_empty && cells + 1 == run.cells)
            }),
        };
        Some((layout, self.lines))
    }
}

/// Tells whether a line holds words and no number.
fn is_words(delimiter: Delimiter, line: &str) -> bool {
    let mut cells = delimiter
        .split(line)
        .map(|cell| DecimalMark::default().read(cell))
        .filter(|cell| *cell != Cell::Missing)
        .peekable();
    cells.peek().is_some() && cells.all(|cell| cell == Cell::Text)
}

/// Tells whether a line is a row of numbers.
fn is_row(delimiter: Delimiter, line: &str) -> bool {
    let mut mark = DecimalMark::default();
    let mut numbers = 0;
    for cell in delimiter.split(line) {
        match mark.read(cell) {
            Cell::Number(_) | Cell::Infinite => numbers += 1,
            // Numbers that another delimiter separates.
            Cell::Text
                if cell.starts_with(|c: char| c.is_ascii_digit() || "+-.".contains(c))
                    && cell.contains([';', ',', ' ', '\t']) =>
            {
                return false;
            }
            _ => {}
        }
    }
    numbers >= 2
}

/// Returns the lines that could be headings, the last first, a line of units joined to its names.
fn titles(lines: &[String], delimiter: Delimiter, fits: impl Fn(usize) -> bool) -> Vec<Titles> {
    let texts = lines.iter().enumerate().rev().filter_map(|(i, line)| {
        let mut text = comment(line).unwrap_or(line);
        for label in ["columns:", "units:"] {
            text = text.strip_prefix(label).map_or(text, str::trim);
        }
        let cells = delimiter.split_headings(text);
        let words = cells
            .iter()
            .filter(|cell| cell.starts_with(|c: char| c.is_alphabetic() || "[({".contains(c)))
            .count();
        (fits(cells.len()) && words >= 2).then_some((i + 1, cells))
    });
    let mut found = Vec::new();
    let mut units: Option<(usize, Vec<String>)> = None;
    for (head, cells) in texts {
        if units.is_none() && found.is_empty() && are_units(&cells) {
            units = Some((head, cells));
            continue;
        }
        let unit = |i: usize| unit(units.as_ref()?.1.get(i)?);
        let heading = |(i, text): (usize, &String)| {
            let heading = Heading::parse(text);
            Heading {
                unit: heading.unit.or_else(|| unit(i)),
                ..heading
            }
        };
        found.push(Titles {
            headings: cells.iter().enumerate().map(heading).collect(),
            head: units.as_ref().map_or(head, |(head, _)| *head),
        });
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
