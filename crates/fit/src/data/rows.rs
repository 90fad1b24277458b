//! The rows of a file, read one by one.

use std::io::BufRead;

use super::assignment::{Assignment, assign, roles};
use super::cells::{Delimiter, comment};
use super::column::{Role, UNIT};
use super::failure::DataError;
use super::head::Head;
use super::heading::Heading;
use super::layout::{Layout, Search, Titles, is_words, titles};
use super::lines::Lines;
use super::number::{Cell, DecimalMark, Marks};
use super::points::{Block, join};
use super::remedy::{Remedy, named};
use super::row::{Row, has_cells};
use super::segment::Segment;
use super::{Format, Notes, Reading, Segments};
use crate::{Direction, Kind};

/// The number of lines that may stand before the rows of numbers.
const LONGEST_HEAD: usize = 10_000;

/// Reads all rows.
pub fn read(source: impl BufRead, name: &str, format: &Format) -> Result<Reading, DataError> {
    let mut lines = Lines::new(source)?;
    let mut search = Search::default();
    while lines.number() < LONGEST_HEAD as u64 {
        let Some(line) = lines.next()? else { break };
        if search.push(&line) {
            break;
        }
    }
    let (layout, start) = search.finish()?;
    let mut head = Head::default();
    for (number, line) in (1..).zip(&start[..layout.head]) {
        head.read(number, line);
    }
    let format = Format {
        cantilever: head.complete(format.cantilever),
        ..format.clone()
    };
    let (titles, assignment) = choose(&layout, &format, head.untold.as_deref())?;
    let mut rows = Rows {
        delimiter: layout.delimiter,
        format: &format,
        notes: Notes {
            head,
            ..Notes::default()
        },
        blocks: vec![Block::new(titles.headings, assignment)],
        waiting: Waiting::default(),
        mark: DecimalMark::default(),
        segment: None,
        moved: None,
        count: 0,
    };
    if let Some(row) = &titles.row {
        rows.add(titles.head as u64, row)?;
    }
    for (number, line) in (1..).zip(&start) {
        if number > titles.head as u64 {
            rows.add(number, line)?;
        } else if let Some(text) = comment(line) {
            rows.segment = Segment::of_comment(text).or(rows.segment);
        }
    }
    drop(start);
    while let Some(line) = lines.next()? {
        let line = line.into_owned();
        rows.add(lines.number(), &line)?;
    }
    rows.finish(name)
}

/// Chooses the line of headings: the nearest to the rows that names the columns needed. Without
/// headings, the user may name columns by their numbers.
fn choose(
    layout: &Layout,
    format: &Format,
    untold: Option<&str>,
) -> Result<(Titles, Assignment), DataError> {
    let columns = layout.cells;
    let at_rows = |what: String| DataError::new(what).in_line(layout.head as u64 + 1);
    if let Some(headings) = layout.fewer_headings {
        return Err(at_rows(format!(
            "the rows of {columns} cells that begin here stand below {headings} headings: if the comma is the decimal mark and \
             also separates the cells, save the file with semicolons or tabs between the cells, or with decimal points; else \
             give each column a heading"
        )));
    }
    let unnamed = Titles {
        headings: vec![Heading::parse(""); columns],
        head: layout.head,
        labelled: false,
        row: None,
    };
    let has_titles = !layout.titles.is_empty();
    let numbered = !has_titles && !format.columns.is_empty();
    let candidates = layout.titles.iter().chain(numbered.then_some(&unnamed));
    let mut first = None;
    for titles in candidates {
        match assign(&titles.headings, format, untold) {
            Ok(assignment) => return Ok((titles.clone(), assignment)),
            Err(failure) => {
                first.get_or_insert(failure);
            }
        }
    }
    Err(first.unwrap_or_else(|| {
        let roles = roles(format.kind.unwrap_or(Kind::LoadRadius));
        let numbered = (1..).zip(roles);
        let column = |(i, role): (usize, Role)| (role, format!("{i} {UNIT}"));
        at_rows(format!(
            "the rows of {columns} cells that begin here have no line of {columns} headings above \
             them; add one, or name the columns by their numbers and units, such as {:?} of {}",
            roles[0].example(),
            roles[0].name()
        ))
        .with(named(numbered.map(column).collect()))
    }))
}

/// Lines below the first rows that may be the head of further rows.
#[derive(Default)]
struct Waiting {
    lines: Vec<String>,
    /// The number of the last line.
    last: u64,
    /// The failure of the first of them that is no comment.
    failure: Option<DataError>,
}

impl Waiting {
    fn push(&mut self, number: u64, line: &str, failure: Option<DataError>) {
        if self.lines.len() == LONGEST_HEAD {
            self.lines.remove(0);
        }
        self.lines.push(line.to_owned());
        self.last = number;
        if self.failure.is_none() {
            self.failure = failure;
        }
    }
}

/// The rows read so far.
struct Rows<'a> {
    delimiter: Delimiter,
    format: &'a Format,
    notes: Notes,
    /// One for each line of headings with rows below it.
    blocks: Vec<Block>,
    waiting: Waiting,
    mark: DecimalMark,
    /// The segment that a comment line has begun, or that of the last row that names one.
    segment: Option<Segment>,
    /// The last direction, which a pause has that is kept.
    moved: Option<Direction>,
    count: u64,
}

impl Rows<'_> {
    /// Adds the points of a line, or takes note of what a line between rows says.
    fn add(&mut self, number: u64, line: &str) -> Result<(), DataError> {
        if let Some(text) = comment(line) {
            self.segment = Segment::of_comment(text).or(self.segment);
            self.notes.head.read(number, text);
            self.waiting.push(number, line, None);
            return Ok(());
        }
        if line.trim().is_empty() {
            return Ok(());
        }
        let cells: Vec<&str> = self.delimiter.split(line).collect();
        let begun = !is_words(self.delimiter, line) && self.begin(number, cells.len())?;
        match self.row(number, &cells) {
            Ok(()) => match self.waiting.failure.take() {
                Some(failure) if !begun => Err(failure),
                _ => {
                    self.waiting.lines.clear();
                    Ok(())
                }
            },
            // It may belong to the head of further rows.
            Err(failure) if failure.may_be_a_head && cells.iter().any(is_word) => {
                self.notes.head.read(number, line);
                self.waiting.push(number, line, Some(failure));
                Ok(())
            }
            Err(failure) => Err(self.waiting.failure.take().unwrap_or(failure)),
        }
    }

    /// Takes the columns of headings among the lines that wait, if there are any for a row of this
    /// number of cells. Returns whether there are.
    fn begin(&mut self, number: u64, cells: usize) -> Result<bool, DataError> {
        if self.waiting.lines.is_empty() || self.is_pause() {
            return Ok(false);
        }
        let format = Format {
            kind: Some(self.blocks[0].assignment.kind),
            cantilever: self.notes.head.complete(self.format.cantilever),
            ..self.format.clone()
        };
        for titles in titles(&self.waiting.lines, self.delimiter, cells..=cells) {
            match assign(&titles.headings, &format, self.notes.head.untold.as_deref()) {
                Ok(assignment) => {
                    self.blocks.push(Block::new(titles.headings, assignment));
                    self.waiting = Waiting::default();
                    return Ok(true);
                }
                // Other comments may look like headings.
                Err(failure) if titles.labelled => {
                    return Err(failure.in_line(number));
                }
                Err(_) => {}
            }
        }
        Ok(false)
    }

    /// Tells whether a comment has begun a pause.
    fn is_pause(&self) -> bool {
        let block = self.blocks.last();
        !self.format.keep_pauses
            && self.segment == Some(Segment::Pause)
            && block.is_none_or(|block| block.assignment.segment.is_none())
    }

    /// Adds the points of a row.
    fn row(&mut self, number: u64, cells: &[&str]) -> Result<(), DataError> {
        if self.is_pause() {
            self.count += 1;
            self.notes.pauses += 1;
            return Ok(());
        }
        let block = self.blocks.last_mut().expect("there is the first block");
        has_cells(cells, block.headings.len()).map_err(|error| error.in_line(number))?;
        let word = block.word(cells);
        let Block {
            headings,
            assignment,
            points,
            ..
        } = block;
        let row = Row {
            number,
            cells,
            headings,
        };
        if let Some(word) = word {
            return Err(row.is_no_point(word));
        }
        let segments = assignment.segment;
        if let Some(index) = segments.filter(|_| self.format.segments != Segments::Split) {
            let is_stiffness = assignment.kind.is_stiffness();
            self.segment = row
                .segment(index, is_stiffness, self.moved)?
                .or(self.segment);
        }
        let direction = match self.segment {
            Some(Segment::Pause) if self.format.keep_pauses => self.moved,
            Some(Segment::Pause) => {
                self.count += 1;
                self.notes.pauses += 1;
                return Ok(());
            }
            Some(Segment::Moving(direction)) => Some(direction),
            None => None,
        };
        self.moved = direction;
        let pairs = assignment.pairs.iter();
        let found = pairs.map(|pair| row.point(pair, assignment.kind, direction, &mut self.mark));
        let found: Vec<_> = found.collect::<Result<_, _>>()?;
        self.count += 1;
        let mut beside = assignment.pairs.iter().flat_map(|pair| &pair.beside);
        let has_times = beside.any(|source| source.role == Role::Time);
        for (points, found) in points.iter_mut().zip(found) {
            match found {
                Some((point, deviations, beside)) => {
                    let is_known = assignment.kind.is_stiffness() || !beside.time.is_nan();
                    if !is_known && has_times {
                        self.notes.untimed.get_or_insert(number);
                    }
                    points.push(point, deviations, is_known.then_some(beside));
                }
                None => self.notes.missing += 1,
            }
        }
        Ok(())
    }

    /// Joins the points.
    fn finish(mut self, name: &str) -> Result<Reading, DataError> {
        if let Some(failure) = self.waiting.failure {
            return Err(failure);
        }
        // Heads must not differ in a value that was used.
        let used = self.format.cantilever;
        if let Some([first, second]) = &self.notes.head.conflict
            && [used.stiffness, used.sensitivity].contains(&Some(first.value))
        {
            let differ = DataError::new(format!(
                "{:?} is {} in line {} and {} in line {}; say which one holds",
                first.name, first.value, first.line, second.value, second.line
            ));
            return Err(differ.with(Remedy::Cantilever { sensitivity: true }));
        }
        // Between semicolons commas are decimal marks as a rule, and points may part thousands.
        let is_clear = self.delimiter != Delimiter::Semicolon;
        self.notes.marks = match self.mark.marks() {
            Marks::UnclearPoints if is_clear => Marks::Points,
            marks => marks,
        };
        self.notes.cantilever = used;
        join(self.blocks, self.count, self.format, name, self.notes)
    }
}

/// Tells whether a cell is a word.
fn is_word(cell: &&str) -> bool {
    DecimalMark::default().read(cell) == Cell::Text
}
