//! The rows of a file, read one by one.

use std::io::BufRead;

use super::assignment::{Assignment, Pair, Source, assign, roles};
use super::cells::comment;
use super::column::Role;
use super::failure::Problem;
use super::heading::Heading;
use super::layout::{Layout, Search, Titles};
use super::lines::Lines;
use super::number::{Cell, DecimalMark};
use super::segment::{Segment, split};
use super::{Format, Notes, Reading, Segments, sign};
use crate::{Kind, Measurement, Point, PointErrors};

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
    let mut lines = Lines::new(source);
    let mut search = Search::default();
    while lines.number() < LONGEST_HEAD as u64 {
        let Some(line) = next(&mut lines)? else { break };
        if search.push(&line) {
            break;
        }
    }
    let (layout, start) = search.finish().ok_or(Problem::NoRows)?;
    let (Titles { headings, head }, assignment) = choose(&layout, format)?;
    let mut rows = Rows {
        layout: &layout,
        headings: &headings,
        assignment: &assignment,
        format,
        mark: DecimalMark::default(),
        segment: None,
        points: vec![Vec::new(); assignment.pairs.len()],
        errors: vec![PointErrors::default(); assignment.pairs.len()],
        count: 0,
        missing: 0,
        other_segments: 0,
    };
    for (number, line) in (1..).zip(&start) {
        rows.add(number, line, number > head as u64)?;
    }
    drop(start);
    while let Some(line) = next(&mut lines)? {
        let line = line.into_owned();
        rows.add(lines.number(), &line, true)?;
    }
    rows.finish(name)
}

/// Reads a line. An error names its number.
fn next<R: BufRead>(lines: &mut Lines<R>) -> Result<Option<std::borrow::Cow<'_, str>>, Failure> {
    let number = lines.number() + 1;
    lines.next().map_err(|problem| Failure {
        line: (!matches!(problem, Problem::Read(_))).then_some(number),
        ..problem.into()
    })
}

/// Chooses the line of headings: the nearest to the rows that names the columns needed. Without
/// headings, the user may name columns by their numbers.
fn choose(layout: &Layout, format: &Format) -> Result<(Titles, Assignment), Failure> {
    let unnamed = Titles {
        headings: vec![Heading::parse(""); layout.cells],
        head: layout.head,
    };
    let has_titles = !layout.titles.is_empty();
    let numbered = !has_titles && !format.columns.is_empty();
    let candidates = layout.titles.iter().chain(numbered.then_some(&unnamed));
    let mut first = None;
    for titles in candidates {
        match assign(&titles.headings, format) {
            Ok(assignment) => return Ok((titles.clone(), assignment)),
            Err((index, problem)) => {
                let text = |index: usize| titles.headings[index].text.clone();
                first.get_or_insert(Failure {
                    line: None,
                    column: index.map(|index| (index + 1, text(index))),
                    problem,
                });
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
                roles: roles(kind).map(Role::name),
            },
        }
    }))
}

/// The rows read so far.
struct Rows<'a> {
    layout: &'a Layout,
    headings: &'a [Heading],
    assignment: &'a Assignment,
    format: &'a Format,
    mark: DecimalMark,
    /// The segment that a comment line has begun.
    segment: Option<Segment>,
    /// The points of each pair of columns.
    points: Vec<Vec<Point>>,
    /// Their standard deviations.
    errors: Vec<PointErrors>,
    count: u64,
    missing: u64,
    other_segments: u64,
}

impl Rows<'_> {
    /// Adds the points of a line, or takes note of a segment that a comment begins.
    fn add(&mut self, number: u64, line: &str, is_row: bool) -> Result<(), Failure> {
        if let Some(text) = comment(line) {
            self.segment = Segment::of_comment(text).or(self.segment);
            return Ok(());
        }
        if !is_row || line.trim().is_empty() {
            return Ok(());
        }
        self.count += 1;
        let cells: Vec<&str> = self.layout.delimiter.split(line).collect();
        let expected = self.headings.len();
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
        let column = self.assignment.segment;
        let segment = match column.filter(|_| self.format.segments != Segments::Split) {
            Some(index) => Some(Segment::parse(cells[index]).ok_or_else(|| {
                self.failure(number, index, Problem::Segment(cells[index].to_owned()))
            })?),
            None => self.segment,
        };
        let direction = match segment {
            Some(Segment::Pause) => {
                self.other_segments += 1;
                return Ok(());
            }
            Some(Segment::Moving(direction)) => Some(direction),
            None => None,
        };
        for i in 0..self.assignment.pairs.len() {
            let pair = &self.assignment.pairs[i];
            let values = [
                self.value(number, &cells, &pair.abscissa)?,
                self.value(number, &cells, &pair.ordinate)?,
            ];
            let [abscissa, ordinate] = match values {
                [Some(abscissa), Some(ordinate)] => [abscissa, ordinate],
                [None, None] => {
                    self.missing += 1;
                    continue;
                }
                [None, _] => {
                    return Err(self.failure(number, pair.abscissa.index, Problem::Missing));
                }
                [_, None] => {
                    return Err(self.failure(number, pair.ordinate.index, Problem::Missing));
                }
            };
            let of_radius = matches!(
                self.assignment.kind,
                Kind::LoadRadius | Kind::PenetrationRadius
            );
            if of_radius && abscissa < 0.0 {
                let problem = Problem::Radius(abscissa);
                return Err(self.failure(number, pair.abscissa.index, problem));
            }
            let [of_abscissa, of_ordinate] = [0, 1].map(|k| {
                let source = pair.errors[k].as_ref()?;
                Some(self.deviation(number, &cells, source, k == 0))
            });
            self.errors[i].abscissa.extend(of_abscissa.transpose()?);
            self.errors[i].ordinate.extend(of_ordinate.transpose()?);
            let point = Point {
                line: number,
                abscissa,
                ordinate,
                direction: pair.direction.or(direction),
            };
            self.points[i].push(point);
        }
        Ok(())
    }

    /// Returns the value of a column in SI units; none if it is missing.
    fn value(
        &mut self,
        line: u64,
        cells: &[&str],
        source: &Source,
    ) -> Result<Option<f64>, Failure> {
        let text = cells[source.index];
        let problem = match self.mark.read(text) {
            Cell::Number(value) => return Ok(Some(value * source.factor)),
            Cell::Missing => return Ok(None),
            Cell::Infinite => Problem::Infinite(text.to_owned()),
            Cell::OtherMark => Problem::DecimalMark(text.to_owned()),
            Cell::Text => Problem::NotANumber(text.to_owned()),
        };
        Err(self.failure(line, source.index, problem))
    }

    /// Returns the standard deviation of a point; one of 0 only if `may_be_exact`.
    fn deviation(
        &mut self,
        line: u64,
        cells: &[&str],
        source: &Source,
        may_be_exact: bool,
    ) -> Result<f64, Failure> {
        let problem = match self.value(line, cells, source)? {
            Some(value) if value > 0.0 || may_be_exact && value == 0.0 => return Ok(value),
            Some(value) => Problem::Deviation(value),
            None => Problem::Missing,
        };
        Err(self.failure(line, source.index, problem))
    }

    fn failure(&self, line: u64, index: usize, problem: Problem) -> Failure {
        Failure {
            line: Some(line),
            column: Some((index + 1, self.headings[index].text.clone())),
            problem,
        }
    }

    /// Joins the points, finds their directions and checks them.
    fn finish(mut self, name: &str) -> Result<Reading, Failure> {
        let Assignment { kind, pairs, .. } = self.assignment;
        let mut points = std::mem::take(&mut self.points[0]);
        for more in &mut self.points[1..] {
            points.append(more);
        }
        let mut errors = PointErrors::default();
        for more in &mut self.errors {
            errors.abscissa.append(&mut more.abscissa);
            errors.ordinate.append(&mut more.ordinate);
        }
        let known = points.iter().any(|point| point.direction.is_some());
        let split_now = match self.format.segments {
            Segments::Auto => *kind == Kind::ForceHeight && !known,
            Segments::File => false,
            Segments::Split => true,
        };
        if split_now {
            split(&mut points);
        }
        if let Some(only) = self.format.only {
            let before = points.len();
            for list in [&mut errors.abscissa, &mut errors.ordinate] {
                let mut of_points = points.iter();
                list.retain(|_| {
                    of_points
                        .next()
                        .is_some_and(|point| point.direction == Some(only))
                });
            }
            points.retain(|point| point.direction == Some(only));
            self.other_segments += (before - points.len()) as u64;
        }
        if points.is_empty() {
            return Err(Problem::NoPoints(self.count).into());
        }
        check_constant(&points, &pairs[0])?;
        let columns = pairs.iter().flat_map(|pair| {
            let values = [pair.abscissa.clone(), pair.ordinate.clone()];
            values
                .into_iter()
                .chain(pair.errors.iter().flatten().cloned())
        });
        let notes = Notes {
            columns: columns.collect(),
            missing: self.missing,
            other_segments: self.other_segments,
            split: split_now,
            doubt: sign::doubt(*kind, &points, &pairs[0]),
        };
        let measurement = Measurement {
            name: name.to_owned(),
            kind: *kind,
            points,
        };
        Ok(Reading {
            measurement,
            errors,
            notes,
        })
    }
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
                    points: points.len(),
                    value: first,
                },
            });
        }
    }
    Ok(())
}
