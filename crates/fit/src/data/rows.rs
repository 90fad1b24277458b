//! The rows of a file, read one by one.

use std::io::BufRead;

use super::assignment::{Assignment, Pair, Source, assign, roles};
use super::beside::{Beside, beside};
use super::cells::{Delimiter, comment};
use super::column::Role;
use super::failure::Problem;
use super::head::Head;
use super::heading::Heading;
use super::layout::{Layout, Search, Titles, is_words, titles};
use super::lines::Lines;
use super::number::{Cell, DecimalMark};
use super::segment::{Segment, split};
use super::{Format, Notes, Reading, Segments, sign};
use crate::{Direction, Kind, Measurement, Point, PointErrors};

/// The rounding of a number in its unit.
const ROUNDING: f64 = 1e-12;

/// The number of lines that may stand before the rows of numbers.
const LONGEST_HEAD: usize = 10_000;

/// A problem with its place.
#[derive(Debug)]
pub struct Failure {
    pub line: Option<u64>,
    pub column: Option<(usize, String)>,
    pub problem: Problem,
}

impl From<Problem> for Failure {
    fn from(problem: Problem) -> Self {
        Self {
            line: None,
            column: None,
            problem,
        }
    }
}

/// Reads all rows.
pub fn read(source: impl BufRead, name: &str, format: &Format) -> Result<Reading, Failure> {
    let mut lines = Lines::new(source)?;
    let mut search = Search::default();
    while lines.number() < LONGEST_HEAD as u64 {
        let Some(line) = next(&mut lines)? else { break };
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
    let (titles, assignment) = choose(&layout, &format, head.uncalibrated)?;
    let mut rows = Rows {
        delimiter: layout.delimiter,
        format: &format,
        head,
        columns: vec![Columns {
            headings: titles.headings,
            points: vec![Vec::new(); assignment.pairs.len()],
            errors: vec![PointErrors::default(); assignment.pairs.len()],
            beside: vec![Vec::new(); assignment.pairs.len()],
            assignment,
        }],
        waiting: Waiting::default(),
        mark: DecimalMark::default(),
        segment: None,
        moved: None,
        count: 0,
        missing: 0,
        pauses: 0,
        other_segments: 0,
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
    while let Some(line) = next(&mut lines)? {
        let line = line.into_owned();
        rows.add(lines.number(), &line)?;
    }
    rows.finish(name)
}

/// Reads a line. An error names its number.
fn next<R: BufRead>(lines: &mut Lines<R>) -> Result<Option<std::borrow::Cow<'_, str>>, Failure> {
    let number = lines.number() + 1;
    lines.next().map_err(|problem| Failure {
        line: (!matches!(problem, Problem::Read(_) | Problem::Binary(_))).then_some(number),
        ..problem.into()
    })
}

/// Chooses the line of headings: the nearest to the rows that names the columns needed. Without
/// headings, the user may name columns by their numbers.
fn choose(
    layout: &Layout,
    format: &Format,
    uncalibrated: Option<u64>,
) -> Result<(Titles, Assignment), Failure> {
    let unnamed = Titles {
        headings: vec![Heading::parse(""); layout.cells],
        head: layout.head,
        labelled: false,
        row: None,
    };
    let has_titles = !layout.titles.is_empty();
    let numbered = !has_titles && !format.columns.is_empty();
    let candidates = layout.titles.iter().chain(numbered.then_some(&unnamed));
    let mut first = None;
    for titles in candidates {
        match assigned(titles, format, uncalibrated) {
            Ok(assignment) => return Ok((titles.clone(), assignment)),
            Err(failure) => {
                first.get_or_insert(failure);
            }
        }
    }
    Err(first.unwrap_or_else(|| {
        let kind = format.kind.unwrap_or(Kind::LoadRadius);
        Failure {
            line: Some(layout.head as u64 + 1),
            column: None,
            problem: Problem::NoHeadings {
                columns: layout.cells,
                roles: roles(kind),
            },
        }
    }))
}

/// Assigns the columns of headings.
fn assigned(
    titles: &Titles,
    format: &Format,
    uncalibrated: Option<u64>,
) -> Result<Assignment, Failure> {
    assign(&titles.headings, format, uncalibrated).map_err(|(index, problem)| Failure {
        line: None,
        column: index.map(|index| (index + 1, titles.headings[index].text.clone())),
        problem,
    })
}

/// The columns of the rows up to the next headings, and their points.
struct Columns {
    headings: Vec<Heading>,
    assignment: Assignment,
    /// The points of each pair of columns.
    points: Vec<Vec<Point>>,
    /// Their standard deviations.
    errors: Vec<PointErrors>,
    /// What stands beside them: of a contact stiffness, or the time.
    beside: Vec<Vec<Beside>>,
}

/// Lines below the first rows that may be the head of further rows.
#[derive(Default)]
struct Waiting {
    lines: Vec<String>,
    /// The number of the last line.
    last: u64,
    /// The failure of the first of them that is no comment.
    failure: Option<Failure>,
}

impl Waiting {
    fn push(&mut self, number: u64, line: &str, failure: Option<Failure>) {
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
    head: Head,
    /// One for each line of headings with rows below it.
    columns: Vec<Columns>,
    waiting: Waiting,
    mark: DecimalMark,
    /// The segment that a comment line has begun, or that of the last row that names one.
    segment: Option<Segment>,
    /// The last direction, which a pause has that is kept.
    moved: Option<Direction>,
    count: u64,
    missing: u64,
    pauses: u64,
    other_segments: u64,
}

impl Rows<'_> {
    /// Adds the points of a line, or takes note of what a line between rows says.
    fn add(&mut self, number: u64, line: &str) -> Result<(), Failure> {
        if let Some(text) = comment(line) {
            self.segment = Segment::of_comment(text).or(self.segment);
            self.head.read(number, text);
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
            Err(failure) if failure.may_be_a_head(&cells) => {
                self.head.read(number, line);
                self.waiting.push(number, line, Some(failure));
                Ok(())
            }
            Err(failure) => Err(self.waiting.failure.take().unwrap_or(failure)),
        }
    }

    /// Takes the columns of headings among the lines that wait, if there are any for a row of this
    /// number of cells. Returns whether there are.
    fn begin(&mut self, number: u64, cells: usize) -> Result<bool, Failure> {
        if self.waiting.lines.is_empty() || self.is_pause() {
            return Ok(false);
        }
        let format = Format {
            kind: Some(self.columns[0].assignment.kind),
            cantilever: self.head.complete(self.format.cantilever),
            ..self.format.clone()
        };
        for titles in titles(&self.waiting.lines, self.delimiter, cells..=cells) {
            match assigned(&titles, &format, self.head.uncalibrated) {
                Ok(assignment) => {
                    self.columns.push(Columns {
                        headings: titles.headings,
                        points: vec![Vec::new(); assignment.pairs.len()],
                        errors: vec![PointErrors::default(); assignment.pairs.len()],
                        beside: vec![Vec::new(); assignment.pairs.len()],
                        assignment,
                    });
                    self.waiting = Waiting::default();
                    return Ok(true);
                }
                // Other comments may look like headings.
                Err(failure) if titles.labelled => {
                    return Err(Failure {
                        line: Some(number),
                        ..failure
                    });
                }
                Err(_) => {}
            }
        }
        Ok(false)
    }

    /// Tells whether a comment has begun a pause.
    fn is_pause(&self) -> bool {
        let columns = self.columns.last();
        !self.format.keep_pauses
            && self.segment == Some(Segment::Pause)
            && columns.is_none_or(|columns| columns.assignment.segment.is_none())
    }

    /// Adds the points of a row.
    fn row(&mut self, number: u64, cells: &[&str]) -> Result<(), Failure> {
        if self.is_pause() {
            self.count += 1;
            self.pauses += 1;
            return Ok(());
        }
        let Columns {
            headings,
            assignment,
            points,
            errors,
            beside: all_beside,
        } = self
            .columns
            .last_mut()
            .expect("there are the first columns");
        let expected = headings.len();
        let extra = cells.iter().skip(expected);
        if cells.len() < expected || !extra.clone().all(|cell| cell.is_empty()) {
            return Err(Failure {
                line: Some(number),
                column: None,
                problem: Problem::CellCount {
                    expected,
                    found: cells.len(),
                },
            });
        }
        let failure = |index: usize, problem| Failure {
            line: Some(number),
            column: Some((index + 1, headings[index].text.clone())),
            problem,
        };
        let index = assignment.segment;
        if let Some(index) = index.filter(|_| self.format.segments != Segments::Split) {
            let word = cells[index];
            // Where the cell is empty the segment is that of the row before.
            if !word.is_empty() {
                let segment = Segment::parse(word);
                let unknown = || failure(index, Problem::Segment(word.to_owned()));
                self.segment = Some(segment.ok_or_else(unknown)?);
                // Before the surface is found there is no contact.
                if assignment.kind.is_stiffness() && word.to_lowercase().contains("surface") {
                    self.segment = Some(Segment::Pause);
                }
            }
        }
        let direction = match self.segment {
            Some(Segment::Pause) if self.format.keep_pauses => self.moved,
            Some(Segment::Pause) => {
                self.count += 1;
                self.pauses += 1;
                return Ok(());
            }
            Some(Segment::Moving(direction)) => Some(direction),
            None => None,
        };
        self.moved = direction;
        let mut found = Vec::with_capacity(assignment.pairs.len());
        for pair in &assignment.pairs {
            let mut value = |source: &Source| {
                value(&mut self.mark, cells[source.index], source)
                    .map_err(|problem| failure(source.index, problem))
            };
            let [abscissa, ordinate] = match [value(&pair.abscissa)?, value(&pair.ordinate)?] {
                [Some(abscissa), Some(ordinate)] => [abscissa, ordinate],
                [None, None] => {
                    found.push(None);
                    continue;
                }
                // Not all rows of a nanoindenter have a stiffness.
                [_, None] if assignment.kind.is_stiffness() => {
                    found.push(None);
                    continue;
                }
                [None, _] => return Err(failure(pair.abscissa.index, Problem::MissingValue)),
                [_, None] => return Err(failure(pair.ordinate.index, Problem::MissingValue)),
            };
            if assignment.kind.at_radii() && abscissa < 0.0 {
                return Err(failure(pair.abscissa.index, Problem::Radius(abscissa)));
            }
            let abscissa = match pair.abscissa.role {
                Role::ContactArea => (abscissa / std::f64::consts::PI).sqrt(),
                _ => abscissa,
            };
            let Some(beside) = beside(&pair.beside, ordinate, &mut value)? else {
                found.push(None);
                continue;
            };
            let mut deviations = [None; 2];
            for (k, source) in pair.errors.iter().enumerate() {
                let Some(source) = source else { continue };
                let problem = match value(source)? {
                    Some(own) if own > 0.0 || k == 0 && own == 0.0 => {
                        deviations[k] = Some(own);
                        continue;
                    }
                    Some(own) => Problem::Deviation(own),
                    None => Problem::MissingValue,
                };
                return Err(failure(source.index, problem));
            }
            let point = Point {
                line: number,
                abscissa,
                ordinate,
                direction: pair.direction.or(direction),
            };
            found.push(Some((point, deviations, beside)));
        }
        self.count += 1;
        let lists = points.iter_mut().zip(errors).zip(all_beside);
        for (((points, errors), all_beside), point) in lists.zip(found) {
            match point {
                Some((point, [of_abscissa, of_ordinate], beside)) => {
                    if assignment.kind.is_stiffness() || !beside.time.is_nan() {
                        all_beside.push(beside);
                    }
                    points.push(point);
                    errors.abscissa.extend(of_abscissa);
                    errors.ordinate.extend(of_ordinate);
                }
                None => self.missing += 1,
            }
        }
        Ok(())
    }

    /// Joins the points, finds their directions and checks them.
    fn finish(mut self, name: &str) -> Result<Reading, Failure> {
        if let Some(failure) = self.waiting.failure {
            return Err(failure);
        }
        self.check_head()?;
        let kind = self.columns[0].assignment.kind;
        let pair = self.columns[0].assignment.pairs[0].clone();
        let blocks = self.columns.len() as u64;
        let mut lists = self.columns.iter_mut().flat_map(|one| &mut one.points);
        let mut points = lists.next().map(std::mem::take).unwrap_or_default();
        for more in lists {
            points.append(more);
        }
        let mut errors = PointErrors::default();
        for more in self.columns.iter_mut().flat_map(|one| &mut one.errors) {
            errors.abscissa.append(&mut more.abscissa);
            errors.ordinate.append(&mut more.ordinate);
        }
        let lists = self.columns.iter_mut().flat_map(|one| &mut one.beside);
        let mut beside: Vec<Beside> = lists.flat_map(std::mem::take).collect();
        if beside.len() != points.len() && !kind.is_stiffness() {
            // Times that are not those of all points tell nothing.
            beside.clear();
        }
        for (list, source) in [
            (&errors.abscissa, &pair.abscissa),
            (&errors.ordinate, &pair.ordinate),
        ] {
            if !list.is_empty() && list.len() != points.len() {
                return Err(Problem::SomeDeviations(source.role).into());
            }
        }
        let known = points.iter().any(|point| point.direction.is_some());
        let split_now = match self.format.segments {
            Segments::Auto => kind == Kind::ForceHeight && !known,
            Segments::File => false,
            Segments::Split => true,
        };
        if split_now {
            split(&mut points);
        }
        // While a sample is unloaded its load and its depth do not tell the contact radius.
        let is_of_loading = matches!(kind, Kind::StiffnessLoad | Kind::StiffnessDepth)
            && points.iter().any(|point| point.direction.is_some());
        let only = self
            .format
            .only
            .or(is_of_loading.then_some(Direction::Approach));
        let mut keep = |is_kept: &dyn Fn(&Point) -> bool| {
            let kept: Vec<bool> = points.iter().map(is_kept).collect();
            retain(&mut points, &kept);
            retain(&mut errors.abscissa, &kept);
            retain(&mut errors.ordinate, &kept);
            retain(&mut beside, &kept);
            kept.iter().filter(|kept| !**kept).count() as u64
        };
        if let Some(only) = only {
            self.other_segments += keep(&|point| point.direction == Some(only));
        }
        let outside = self.format.between.map_or(0, |[least, most]| {
            // Numbers in another unit than those of the ends are rounded.
            let slack = ROUNDING * least.abs().max(most.abs());
            keep(&|point| (least - slack..=most + slack).contains(&point.abscissa))
        });
        if points.is_empty() {
            return Err(Problem::NoPoints(self.count).into());
        }
        check_constant(&points, &pair)?;
        let mut columns: Vec<Source> = Vec::new();
        for pair in self.columns.iter().flat_map(|one| &one.assignment.pairs) {
            let errors = pair.errors.iter().flatten().chain(&pair.beside);
            for source in [&pair.abscissa, &pair.ordinate].into_iter().chain(errors) {
                if !columns.contains(source) {
                    columns.push(source.clone());
                }
            }
        }
        let notes = Notes {
            columns,
            missing: self.missing,
            pauses: self.pauses,
            other_segments: self.other_segments,
            outside,
            blocks,
            split: split_now,
            cantilever: self.format.cantilever,
            head: self.head,
            doubt: sign::doubt(kind, &points, &pair),
        };
        let measurement = Measurement {
            name: name.to_owned(),
            kind,
            points,
        };
        let loads = beside
            .iter()
            .map(|one| one.load)
            .filter(|load| !load.is_nan());
        let phases = beside.iter().map(|one| one.phase);
        let times = beside
            .iter()
            .map(|one| one.time)
            .filter(|time| !time.is_nan());
        Ok(Reading {
            measurement,
            errors,
            loads: loads.collect(),
            phases: phases.filter(|phase| !phase.is_nan()).collect(),
            times: times.collect(),
            notes,
        })
    }

    /// Refuses heads that differ in a value that was used.
    fn check_head(&self) -> Result<(), Failure> {
        let used = self.format.cantilever;
        match &self.head.conflict {
            Some([first, second])
                if [used.stiffness, used.sensitivity].contains(&Some(first.value)) =>
            {
                Err(Problem::TwoValues {
                    name: first.name.clone(),
                    values: [first.value, second.value],
                    lines: [first.line, second.line],
                }
                .into())
            }
            _ => Ok(()),
        }
    }
}

impl Failure {
    /// Tells whether the line that fails may be no row: it holds words.
    fn may_be_a_head(&self, cells: &[&str]) -> bool {
        let is_word = |cell: &&str| DecimalMark::default().read(cell) == Cell::Text;
        matches!(
            self.problem,
            Problem::NotANumber(_) | Problem::CellCount { .. } | Problem::Segment(_)
        ) && cells.iter().any(is_word)
    }
}

/// Retains the items of a list that belong to kept points. An empty list stays empty.
fn retain<T>(list: &mut Vec<T>, kept: &[bool]) {
    let mut kept = kept.iter();
    list.retain(|_| kept.next().is_some_and(|kept| *kept));
}

/// Returns the value of a cell in SI units; none if it is missing.
fn value(mark: &mut DecimalMark, text: &str, source: &Source) -> Result<Option<f64>, Problem> {
    Err(match mark.read(text) {
        Cell::Number(value) => return Ok(Some(value * source.factor)),
        Cell::Missing => return Ok(None),
        Cell::Infinite => Problem::Infinite(text.to_owned()),
        Cell::OtherMark => Problem::DecimalMark(text.to_owned()),
        Cell::Thousands => Problem::Thousands(text.to_owned()),
        Cell::Text => Problem::NotANumber(text.to_owned()),
    })
}

/// Refuses a column that holds one value only.
fn check_constant(points: &[Point], pair: &Pair) -> Result<(), Failure> {
    for (source, value) in [
        (
            &pair.abscissa,
            (|point| point.abscissa) as fn(&Point) -> f64,
        ),
        (&pair.ordinate, |point| point.ordinate),
    ] {
        let first = value(&points[0]);
        if points.len() > 1 && points.iter().all(|point| value(point) == first) {
            return Err(Failure {
                line: None,
                column: Some((source.index + 1, source.heading.clone())),
                problem: Problem::Constant {
                    role: source.role,
                    points: points.len(),
                    value: first,
                },
            });
        }
    }
    Ok(())
}
