//! The cells of one row, and the points that they make.

use super::assignment::Pair;
use super::beside::{Beside, beside};
use super::column::Role;
use super::failure::DataError;
use super::heading::Heading;
use super::number::{Cell, DecimalMark};
use super::remedy::Remedy;
use super::segment::Segment;
use super::source::Source;
use crate::{Direction, Kind, Point};

/// A point, the standard deviations of its abscissa and ordinate, and what stands beside it.
type Found = (Point, [Option<f64>; 2], Beside);

/// Refuses a row with another number of cells than `headings`; empty ones may be more.
pub fn has_cells(cells: &[&str], headings: usize) -> Result<(), DataError> {
    let found = cells.len();
    let mut extra = cells.iter().skip(headings);
    if found >= headings && extra.all(|cell| cell.is_empty()) {
        return Ok(());
    }
    let remedy = if found > headings {
        "if a comma is the decimal mark, separate the cells by tabs or semicolons"
    } else {
        "complete the row, or let the line begin with # to leave it out"
    };
    let unlike = DataError::new(format!(
        "the row has {found} cells, and the headings are {headings}; {remedy}"
    ));
    Err(unlike.of_words())
}

/// A row below its headings.
pub struct Row<'a> {
    /// The number of the line.
    pub number: u64,
    pub cells: &'a [&'a str],
    pub headings: &'a [Heading],
}

impl Row<'_> {
    /// Returns the error of a row that begins with a word where numbers stood before.
    pub fn is_no_point(&self, word: &str) -> DataError {
        let what = format!(
            "{word:?} stands in a column that has only numbers above; if this row is no point, let the line \
             begin with # to leave it out, else remove the word"
        );
        self.failure(0, what).of_words()
    }

    /// Returns the segment that a column names; `None` where the cell is empty, and the segment is that of the row before.
    /// `moved` is the last direction.
    pub fn segment(
        &self,
        index: usize,
        is_stiffness: bool,
        moved: Option<Direction>,
    ) -> Result<Option<Segment>, DataError> {
        let word = self.cells[index].to_lowercase();
        if word.is_empty() {
            return Ok(None);
        }
        let segment = match &*word {
            // Where a history has no contact, or its line rests, it goes on in its way.
            "separated" | "resting" => Some(Segment::Moving(moved.unwrap_or(Direction::Approach))),
            _ => Segment::parse(self.cells[index]),
        };
        let unknown = || {
            let what = format!(
                "{:?} is not a segment; write approach (extend, loading, 0), retract (unloading, 1) or \
                 pause, or let the points be split where the motion turns back",
                self.cells[index]
            );
            self.failure(index, what).with(Remedy::Split).of_words()
        };
        let segment = segment.ok_or_else(unknown)?;
        // Before the surface is found there is no contact.
        let is_before = is_stiffness && word.contains("surface");
        Ok(Some(if is_before { Segment::Pause } else { segment }))
    }

    /// Returns the point of a pair of columns; `None` where the row has none.
    pub fn point(
        &self,
        pair: &Pair,
        kind: Kind,
        direction: Option<Direction>,
        mark: &mut DecimalMark,
    ) -> Result<Option<Found>, DataError> {
        let mut value = |source: &Source| {
            value(mark, self.cells[source.index], source)
                .map_err(|error| self.place(source.index, error))
        };
        let [abscissa, ordinate] = match [value(&pair.abscissa)?, value(&pair.ordinate)?] {
            [Some(abscissa), Some(ordinate)] => [abscissa, ordinate],
            [None, None] => return Ok(None),
            // Not all rows of a nanoindenter have a stiffness.
            [_, None] if kind.is_stiffness() => return Ok(None),
            [None, _] => return Err(self.failure(pair.abscissa.index, MISSING.to_owned())),
            [_, None] => return Err(self.failure(pair.ordinate.index, MISSING.to_owned())),
        };
        if kind.at_radii() && abscissa < 0.0 {
            let what = format!(
                "contact radius = {abscissa:?} m must not be below 0; a row without contact has 0. If the numbers \
                 are loads, exchange the headings of the two columns"
            );
            return Err(self.failure(pair.abscissa.index, what));
        }
        let abscissa = match pair.abscissa.role {
            Role::ContactArea => (abscissa / std::f64::consts::PI).sqrt(),
            _ => abscissa - pair.abscissa.compliance * ordinate,
        };
        let Some(beside) = beside(&pair.beside, ordinate, &mut value)? else {
            return Ok(None);
        };
        let mut deviations = [None; 2];
        for (k, source) in pair.errors.iter().enumerate() {
            let Some(source) = source else { continue };
            let what = match value(source)? {
                Some(own) if own > 0.0 || k == 0 && own == 0.0 => {
                    deviations[k] = Some(own);
                    continue;
                }
                Some(own) => format!(
                    "standard deviation = {own:?} (SI) must be positive and finite, and may be 0 for a radius, \
                     penetration or height; correct it, or rename the column if it is something else"
                ),
                None => MISSING.to_owned(),
            };
            return Err(self.failure(source.index, what));
        }
        let point = Point {
            line: self.number,
            abscissa,
            ordinate,
            direction: pair.direction.or(direction),
        };
        Ok(Some((point, deviations, beside)))
    }

    /// Returns the error of a cell.
    fn failure(&self, index: usize, what: String) -> DataError {
        self.place(index, DataError::new(what))
    }

    /// Returns an error with the place of its cell.
    fn place(&self, index: usize, error: DataError) -> DataError {
        error
            .in_line(self.number)
            .in_column(index, &self.headings[index].text)
    }
}

/// What is wrong with a cell that has no number, where another cell of the row has one.
const MISSING: &str = "the value is missing (empty, NaN or above 1e300), but the row has another; complete it, \
     or let the line begin with # to leave it out";

/// Returns the value of a cell in SI units; none if it is missing.
fn value(mark: &mut DecimalMark, text: &str, source: &Source) -> Result<Option<f64>, DataError> {
    let refused = |what: String| Err(DataError::new(what));
    match mark.read(text) {
        Cell::Number(value) => Ok(Some(value * source.factor)),
        Cell::Missing => Ok(None),
        Cell::Infinite => refused(format!(
            "{text:?} is not finite; correct it, or let the line begin with # to leave it out"
        )),
        Cell::OtherMark => {
            let remedy = match mark.thousands(text) {
                Some(mark) => format!(
                    "if {mark:?} parts thousands, remove it from all numbers (replace {mark:?} by nothing); else \
                     write one decimal mark, point or comma"
                ),
                None => "use one, point or comma".to_owned(),
            };
            refused(format!(
                "{text:?} has another decimal mark than numbers before it; {remedy}"
            ))
        }
        Cell::Thousands => refused(format!(
            "{text:?} has a separator of thousands; save the numbers without it"
        )),
        Cell::Text => {
            let what = format!(
                "{text:?} is not a number; correct it, or let the line begin with # to leave it out"
            );
            Err(DataError::new(what).of_words())
        }
    }
}
