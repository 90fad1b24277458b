//! The points of a file: those of the rows below each line of headings, joined, selected and checked.

use super::assignment::{Assignment, Pair, roles};
use super::beside::Beside;
use super::column::{Role, UNIT};
use super::doubt::{doubts, unloading};
use super::failure::DataError;
use super::heading::Heading;
use super::number::{Cell, DecimalMark};
use super::remedy::another;
use super::segment::split;
use super::source::Source;
use super::{Format, Notes, Reading, Segments};
use crate::statistics::extremes;
use crate::{Direction, Kind, Measurement, Numbering, Point, PointErrors};
use units::Quantity;

/// The number of rows that begin with a number, from which on a word there is none of a point.
const ENOUGH: u32 = 3;
/// The rounding of a number in its unit.
const ROUNDING: f64 = 1e-12;

/// The columns of the rows up to the next headings, and their points.
pub struct Block {
    pub headings: Vec<Heading>,
    pub assignment: Assignment,
    /// The points of each pair of columns.
    pub points: Vec<Points>,
    /// The number of rows whose first cell is a number, up to [`ENOUGH`]; `None` after another text.
    numbers: Option<u32>,
}

impl Block {
    pub fn new(headings: Vec<Heading>, assignment: Assignment) -> Self {
        Self {
            points: vec![Points::default(); assignment.pairs.len()],
            numbers: Some(0),
            headings,
            assignment,
        }
    }

    /// Returns the first cell of a row if it is a word where numbers stood before: the row is no point, such
    /// as `Mean;85.0;0.967`. Other columns that are not read may hold remarks.
    pub fn word<'a>(&mut self, cells: &[&'a str]) -> Option<&'a str> {
        let cell = *cells.first()?;
        let numbers = self.numbers?;
        let found = DecimalMark::default().read(cell);
        if numbers == ENOUGH {
            let is_word = cell.starts_with(char::is_alphabetic) && found == Cell::Text;
            return (is_word && self.assignment.segment != Some(0)).then_some(cell);
        }
        self.numbers = match found {
            Cell::Number(_) => Some(numbers + 1),
            Cell::Missing => Some(numbers),
            _ => None,
        };
        None
    }

    /// Returns the columns that are not read.
    fn unused(&self) -> impl Iterator<Item = &Heading> {
        let is_read = move |index: usize| {
            self.assignment.segment == Some(index) || self.sources().any(|one| one.index == index)
        };
        let headings = self.headings.iter().enumerate();
        headings
            .filter(move |(index, heading)| !is_read(*index) && !heading.text.is_empty())
            .map(|(_, heading)| heading)
    }

    /// Returns the columns of every pair.
    fn sources(&self) -> impl Iterator<Item = &Source> {
        self.assignment.pairs.iter().flat_map(|pair| {
            let errors = pair.errors.iter().flatten().chain(&pair.beside);
            pair.sources().into_iter().chain(errors)
        })
    }
}

/// Points, their standard deviations, and what stands beside them: of a contact stiffness, or the
/// time. A list of these is empty where the file does not have them.
#[derive(Clone, Default)]
pub struct Points {
    points: Vec<Point>,
    errors: PointErrors,
    beside: Vec<Beside>,
}

impl Points {
    /// Adds a point with the standard deviations of abscissa and ordinate.
    pub fn push(&mut self, point: Point, deviations: [Option<f64>; 2], beside: Option<Beside>) {
        self.points.push(point);
        self.errors.abscissa.extend(deviations[0]);
        self.errors.ordinate.extend(deviations[1]);
        self.beside.extend(beside);
    }

    fn append(&mut self, mut more: Self) {
        self.points.append(&mut more.points);
        self.errors.abscissa.append(&mut more.errors.abscissa);
        self.errors.ordinate.append(&mut more.errors.ordinate);
        self.beside.append(&mut more.beside);
    }

    /// Keeps some points and what belongs to them. Returns the number of the others.
    fn keep(&mut self, is_kept: impl Fn(&Point) -> bool) -> u64 {
        let kept: Vec<bool> = self.points.iter().map(is_kept).collect();
        retain(&mut self.points, &kept);
        retain(&mut self.errors.abscissa, &kept);
        retain(&mut self.errors.ordinate, &kept);
        retain(&mut self.beside, &kept);
        kept.iter().filter(|kept| !**kept).count() as u64
    }
}

/// Joins the points of all blocks, finds their directions, selects those asked for and checks them.
/// There were `rows` rows; `notes` tell what is known of them.
pub fn join(
    blocks: Vec<Block>,
    rows: u64,
    format: &Format,
    name: &str,
    mut notes: Notes,
) -> Result<Reading, DataError> {
    let first = &blocks[0].assignment;
    let (kind, pairs) = (first.kind, first.pairs.clone());
    let pair = &pairs[0];
    notes.blocks = blocks.len() as u64;
    let unused = || blocks[0].unused();
    notes.unused = unused().map(|heading| heading.text.clone()).collect();
    notes.unused_times = unused().filter_map(time_to_name).collect();
    for source in blocks.iter().flat_map(Block::sources) {
        if !notes.columns.contains(source) {
            notes.columns.push(source.clone());
        }
    }
    let mut lists = blocks.into_iter().flat_map(|block| block.points);
    let mut all = lists.next().unwrap_or_default();
    for more in lists {
        all.append(more);
    }
    if all.beside.len() != all.points.len() && !kind.is_stiffness() {
        // Times that are not those of all points tell nothing.
        all.beside.clear();
    }
    let lists = [&all.errors.abscissa, &all.errors.ordinate];
    for (list, source) in lists.into_iter().zip(pair.sources()) {
        if !list.is_empty() && list.len() != all.points.len() {
            return Err(DataError::new(format!(
                "some rows have standard deviations of {} and others have none; give all rows a column of \
                 them, or rename it",
                source.role.name()
            )));
        }
    }
    select(&mut all, kind, format, &mut notes)?;
    if all.points.is_empty() {
        return Err(DataError::new(format!(
            "{rows} rows, but no point is left to fit: they are missing values, or of another segment; check the columns, and the direction \
             asked for"
        )));
    }
    check_constant(&all.points, pair)?;
    notes.doubts = doubts(
        kind,
        &all.points,
        &pairs,
        &notes,
        (&all.errors, format.keep_pauses),
    );
    let known = |value: fn(&Beside) -> f64| -> Vec<f64> {
        let values = all.beside.iter().map(value);
        values.filter(|value| !value.is_nan()).collect()
    };
    let loads = known(|one| one.load);
    notes.doubts.extend(unloading(kind, &all.points, &loads));
    Ok(Reading {
        loads,
        phases: known(|one| one.phase),
        times: known(|one| one.time),
        measurement: Measurement {
            name: name.to_owned(),
            kind,
            numbering: Numbering::Lines,
            points: all.points,
        },
        errors: all.errors,
        notes,
    })
}

/// Finds the directions of points, where the motion turns back if need be, and keeps the points asked for.
fn select(
    all: &mut Points,
    kind: Kind,
    format: &Format,
    notes: &mut Notes,
) -> Result<(), DataError> {
    let known = all.points.iter().any(|point| point.direction.is_some());
    let splits = match format.segments {
        Segments::Auto => kind == Kind::ForceHeight && !known,
        Segments::File => false,
        Segments::Split => true,
    };
    if splits {
        notes.split = split(&mut all.points, kind);
    }
    // While a sample is unloaded its load and its depth do not tell the contact radius.
    let is_of_loading = matches!(kind, Kind::StiffnessLoad | Kind::StiffnessDepth)
        && all.points.iter().any(|point| point.direction.is_some());
    let only = is_of_loading.then_some(Direction::Approach);
    if let Some(only) = format.only.or(only) {
        notes.other_segments = all.keep(|point| point.direction == Some(only));
    }
    if let Some(ends) = &format.between {
        let dimension = Some(roles(kind)[0].dimension());
        let end = |end: &Quantity| {
            let refused = |error| DataError::new(format!("the range asked for: {error}"));
            end.of(dimension).map_err(refused)
        };
        let [least, most] = [end(&ends[0])?, end(&ends[1])?];
        // Numbers in another unit than those of the ends are rounded.
        let slack = ROUNDING * least.abs().max(most.abs());
        let [first, last] = extremes(all.points.iter().map(|point| point.abscissa));
        notes.outside = all.keep(|point| (least - slack..=most + slack).contains(&point.abscissa));
        if all.points.is_empty() && notes.outside > 0 {
            let [unit, _] = kind.units();
            return Err(DataError::new(format!(
                "no point is left to fit: the range asked for is from {least:?} to {most:?} {unit}, and the points are from {first:?} \
                 to {last:?} {unit}; ask for a range that holds points, in SI units or with its unit"
            )));
        }
    }
    Ok(())
}

/// Returns the heading under which a column can be named as times.
fn time_to_name(heading: &Heading) -> Option<String> {
    let is_time = || Role::Time.headings().contains(&heading.name.as_str());
    match heading.unit {
        Some(unit) => Role::Time.accepts(unit).then(|| heading.text.clone()),
        None => is_time().then(|| format!("{} {UNIT}", heading.text)),
    }
}

/// Retains the items of a list that belong to kept points. An empty list stays empty.
fn retain<T>(list: &mut Vec<T>, kept: &[bool]) {
    let mut kept = kept.iter();
    list.retain(|_| kept.next().is_some_and(|kept| *kept));
}

/// Refuses a column that holds one value only.
fn check_constant(points: &[Point], pair: &Pair) -> Result<(), DataError> {
    let values: [fn(&Point) -> f64; 2] = [|point| point.abscissa, |point| point.ordinate];
    for (source, value) in pair.sources().into_iter().zip(values) {
        let first = value(&points[0]);
        if points.len() > 1 && points.iter().all(|point| value(point) == first) {
            let constant = DataError::new(format!(
                "all {} values are {first:?} (SI); choose the column that was measured",
                points.len()
            ));
            let constant = constant.with(another(source.role));
            return Err(constant.in_column(source.index, &source.heading));
        }
    }
    Ok(())
}
