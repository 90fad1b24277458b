//! Where the rows of numbers begin, what separates their cells, and which line names the columns.

use std::ops::RangeInclusive;

use super::cells::{Delimiter, comment};
use super::column::Role;
use super::failure::DataError;
use super::heading::Heading;
use super::number::{Cell, DecimalMark};
use units::Unit;

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
    /// The number of headings where there are fewer than cells, and at least half as many, between commas: a comma may be
    /// the decimal mark and separate the cells, too.
    pub fewer_headings: Option<usize>,
}

/// A line that could be the headings.
#[derive(Clone, Debug)]
pub struct Titles {
    pub headings: Vec<Heading>,
    /// The number of lines up to them, and to the line of units below them.
    pub head: usize,
    /// Whether the line says that it names the columns: `# columns: ...`.
    pub labelled: bool,
    /// A row on the same line, where the end of the line is lost.
    pub row: Option<String>,
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
    /// Of rows in which no cell may hold numbers that another delimiter separates.
    plain: Runs,
    /// Of all rows: a cell may hold a time stamp or a remark, `5 nm step`.
    all: Runs,
}

/// The last run and the longest one for each delimiter.
#[derive(Clone, Debug, Default)]
struct Runs {
    last: [Run; Delimiter::ALL.len()],
    longest: [Run; Delimiter::ALL.len()],
}

impl Runs {
    fn push(&mut self, index: usize, line: &str, is_row: fn(Delimiter, &str) -> bool) {
        let runs = self.last.iter_mut().zip(&mut self.longest);
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
    }

    /// Returns the number of rows of the longest run.
    fn most(&self) -> usize {
        self.longest.iter().map(|run| run.rows).max().unwrap_or(0)
    }
}

impl Search {
    /// Adds a line. Returns true when the rows are found.
    pub fn push(&mut self, line: &str) -> bool {
        let index = self.lines.len();
        self.lines.push(line.to_owned());
        if line.trim().is_empty() || comment(line).is_some() {
            return false;
        }
        self.plain.push(index, line, |delimiter, line| {
            is_row(delimiter, line) && !delimiter.split(line).any(may_be_split)
        });
        self.all.push(index, line, is_row);
        self.plain.most() >= ROWS
    }

    /// Returns the layout and the lines.
    pub fn finish(self) -> Result<(Layout, Vec<String>), DataError> {
        let is_plain = self.plain.most() >= ROWS.min(self.all.most());
        let runs = if is_plain { &self.plain } else { &self.all };
        let most = runs.most();
        let mut runs = Delimiter::ALL.into_iter().zip(runs.longest);
        let Some((delimiter, run)) = runs.find(|(_, run)| run.rows == most && most > 0) else {
            return Err(DataError::new(self.without_rows()));
        };
        // The run may begin with the headings.
        let head = run.first + usize::from(is_words(delimiter, &self.lines[run.first]));
        let last_is_empty = delimiter
            .split(&self.lines[head])
            .last()
            .is_some_and(str::is_empty);
        let before = &self.lines[..head];
        let fits = run.cells - usize::from(last_is_empty)..=run.cells;
        let titles_of = |fits| titles(before, delimiter, fits);
        let titles = titles_of(fits.clone());
        let is_doubtful = delimiter == Delimiter::Comma && titles.is_empty();
        let mut fewer = (run.cells.div_ceil(2)..*fits.start()).rev();
        let layout = Layout {
            delimiter,
            cells: run.cells,
            head,
            fewer_headings: fewer
                .find(|&count| is_doubtful && !titles_of(count..=count).is_empty()),
            titles,
        };
        Ok((layout, self.lines))
    }

    /// Returns why there is no layout.
    fn without_rows(self) -> String {
        /// The number of characters of the first line in a message.
        const SHOWN: usize = 60;
        let lines = self.lines.into_iter();
        let mut lines = lines.filter(|line| !line.trim().is_empty());
        let Some(first) = lines.next() else {
            return "the file is empty".to_owned();
        };
        let shown = |line: &str| line.trim().chars().take(SHOWN).collect::<String>();
        let mut all = std::iter::once(&first).cloned().chain(lines);
        let Some(headings) = all.find(|line| are_headings(line)) else {
            return format!(
                "no line holds two numbers, and the file begins with {:?}; a measurement is a table of \
                 two columns at least, separated by tabs, semicolons, commas or spaces",
                shown(&first)
            );
        };
        let is_row =
            |line: &String| comment(line).is_none() && line.contains(|c: char| c.is_ascii_digit());
        let row = all.find(is_row);
        let remedy = match &row {
            None => "save the rows of the measurement, too".to_owned(),
            Some(row) => match no_number(&headings, row) {
                Some(cell) => format!(
                    "the first line below is {:?}, in which {cell:?} is not a number: save plain numbers, \
                     such as 1.5e-3, with their unit in the heading",
                    shown(row)
                ),
                None => format!(
                    "the first line below is {:?}, which holds fewer than two numbers: write each point \
                     on a line of its own",
                    shown(row)
                ),
            },
        };
        format!(
            "{:?} are headings, but no row of numbers follows them; {remedy}",
            shown(&headings)
        )
    }
}

/// Returns the cell of a line below headings that was to be a number: the first that has a digit.
fn no_number(headings: &str, row: &str) -> Option<String> {
    let headings = comment(headings).unwrap_or(headings);
    let count = |delimiter: &Delimiter| delimiter.split_headings(headings).len();
    let delimiter = Delimiter::ALL.into_iter().find(|one| count(one) >= 2)?;
    let is_meant = |cell: &&str| {
        DecimalMark::default().read(cell) == Cell::Text
            && cell.contains(|c: char| c.is_ascii_digit())
    };
    delimiter.split(row).find(is_meant).map(str::to_owned)
}

/// Tells whether a line names two columns, of which one at least is recognised.
fn are_headings(line: &str) -> bool {
    let text = comment(line).unwrap_or(line);
    Delimiter::ALL.into_iter().any(|delimiter| {
        let cells = delimiter.split_headings(text);
        let is_known = |cell: &String| {
            let heading = Heading::parse(cell);
            let has_name = |role: Role| role.headings().contains(&heading.name.as_str());
            heading.unit.is_some() && Role::ALL.into_iter().any(has_name)
                || Role::ALL.into_iter().any(|role| role.is_si(cell))
        };
        // A list of properties has names with an equals sign.
        let is_list = text.contains('=');
        cells.len() >= 2 && !is_list && is_words(delimiter, text) && cells.iter().any(is_known)
    })
}

/// Tells whether a line holds words and no number.
pub fn is_words(delimiter: Delimiter, line: &str) -> bool {
    let mut cells = delimiter
        .split(line)
        .map(|cell| DecimalMark::default().read(cell))
        .filter(|cell| *cell != Cell::Missing)
        .peekable();
    cells.peek().is_some() && cells.all(|cell| cell == Cell::Text)
}

/// Tells whether a line is a row of numbers: it has two at least.
fn is_row(delimiter: Delimiter, line: &str) -> bool {
    let mut mark = DecimalMark::default();
    let is_number = |cell: &&str| !matches!(mark.read(cell), Cell::Text | Cell::Missing);
    delimiter.split(line).filter(is_number).count() >= 2
}

/// Tells whether a cell may hold numbers that another delimiter separates.
fn may_be_split(cell: &str) -> bool {
    cell.starts_with(|c: char| c.is_ascii_digit() || "+-.".contains(c))
        && cell.contains([';', ',', ' ', '\t'])
        && DecimalMark::default().read(cell) == Cell::Text
}

/// Returns the lines that could be headings of as many cells as `fits` allows, the last first, a
/// line of units joined to its names.
pub fn titles(lines: &[String], delimiter: Delimiter, fits: RangeInclusive<usize>) -> Vec<Titles> {
    let candidates = lines.iter().enumerate().rev().filter_map(|(i, line)| {
        let mut text = comment(line).unwrap_or(line);
        let mut labelled = false;
        for label in ["columns:", "units:"] {
            if let Some(rest) = text.strip_prefix(label) {
                (text, labelled) = (rest.trim(), label == "columns:");
            }
        }
        let mut cells = delimiter.split_headings(text);
        let row = first_row(text, delimiter, *fits.end());
        if let Some(row) = &row {
            cells = delimiter.split_headings(&text[..text.len() - row.len()]);
        }
        let words = cells
            .iter()
            .filter(|cell| cell.starts_with(|c: char| c.is_alphabetic() || "[({".contains(c)))
            .count();
        (fits.contains(&cells.len()) && words >= 2).then(|| Titles {
            headings: cells.iter().map(|cell| Heading::parse(cell)).collect(),
            head: i + 1,
            labelled,
            row,
        })
    });
    let mut found: Vec<Titles> = Vec::new();
    let mut units: Option<Titles> = None;
    for mut titles in candidates {
        if units.is_none() && found.is_empty() && are_units(&titles.headings) {
            units = Some(titles);
            continue;
        }
        if let Some(units) = &units {
            titles.head = units.head;
            for (heading, below) in titles.headings.iter_mut().zip(&units.headings) {
                heading.unit = heading.unit.or_else(|| unit(&below.text));
            }
        }
        found.push(titles);
    }
    found
}

/// Returns the first row where it follows the headings on their own line: versions of afmformats
/// have written no end of the line there.
fn first_row(text: &str, delimiter: Delimiter, cells: usize) -> Option<String> {
    let count = |text: &str| delimiter.split(text).count();
    if cells < 2 || count(text) != 2 * cells - 1 {
        return None;
    }
    let starts = text.char_indices().filter_map(|(at, c)| {
        let before = text[..at].chars().next_back()?;
        (before.is_alphabetic() || ")]}".contains(before))
            .then_some(at)
            .filter(|_| c.is_ascii_digit() || "+-.".contains(c))
    });
    let is_split = |at: &usize| {
        let (headings, row) = text.split_at(*at);
        count(headings) == cells
            && count(row) == cells
            && is_words(delimiter, headings)
            && is_row(delimiter, row)
    };
    let at = starts.into_iter().find(is_split)?;
    Some(text[at..].to_owned())
}

/// Returns true for a line of units: two cells at least are units, and no other cell is longer than
/// a unit's symbol.
fn are_units(headings: &[Heading]) -> bool {
    let mut cells = headings.iter().map(|heading| &heading.text);
    cells.clone().filter(|cell| unit(cell).is_some()).count() >= 2
        && cells.all(|cell| unit(cell).is_some() || cell.chars().count() <= 4)
}

fn unit(cell: &str) -> Option<Unit> {
    Unit::parse(cell.trim_matches(['[', ']', '(', ')', '{', '}']))
}
