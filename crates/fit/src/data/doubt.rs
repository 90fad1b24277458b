//! Doubts about how a file was read.

use super::assignment::Pair;
use super::number::Marks;
use super::remedy::{Remedy, named};
use super::segment::Split;
use super::sign::opposite;
use super::tilt::is_tilted;
use super::turns::{jumps, turns};
use super::{Notes, Role};
use crate::statistics::extremes;
use crate::{Direction, Kind, Point, PointErrors};

/// The number of points that tell the course of a curve.
const ENOUGH: usize = 10_000;

named! {
    /// What a doubt about a file is about.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    #[non_exhaustive]
    pub enum DoubtKind {
        /// Columns may count in the opposite sense.
        Sign = "sign",
        /// The commas of the numbers may part thousands.
        Commas = "commas",
        /// The points of the numbers may part thousands.
        Points = "points",
        /// The baseline is tilted, so that the force falls where the bodies are closer.
        Tilt = "tilt",
        /// Forces are in newtons, and the file names another stiffness than the one given.
        Stiffness = "stiffness",
        /// A row without contact has a load, as at the pull-off.
        PullOff = "pull-off",
        /// Some standard deviations are 0, and others are not.
        Exact = "exact",
        /// The abscissa turns back more often than that of one curve.
        Curves = "several-curves",
        /// The abscissa jumps to and fro, and the rows have no direction.
        Order = "order",
        /// The abscissa goes there and back in the rows of one direction.
        Directions = "directions",
    }
}

/// A doubt about how a file was read.
#[derive(Clone, Debug, PartialEq)]
pub struct Doubt {
    /// What it is about.
    pub kind: DoubtKind,
    /// The doubt, and what to change in the file.
    pub text: String,
    /// What helps if the doubt is right, if that is not to change the file.
    pub remedy: Option<Remedy>,
}

impl DoubtKind {
    /// Returns the doubt of this kind with a text.
    fn with(self, text: impl Into<String>) -> Doubt {
        Doubt {
            kind: self,
            text: text.into(),
            remedy: None,
        }
    }
}

/// Tells whether the abscissae and the ordinates of `points` may count in the opposite sense. Loads are positive where
/// they press the bodies together; penetrations grow, and heights fall, where the bodies come closer. `None` if neither
/// seem to, and where the baseline is tilted.
pub fn opposite_sense(kind: Kind, points: &[Point]) -> Option<[bool; 2]> {
    opposite(kind, points).filter(|_| !is_tilted(kind, points))
}

/// Returns the doubts about a file: its points, the pairs of its columns, the errors of the points, and what else was noted.
/// `paused` points stay where they are in part, so that their course tells nothing.
pub fn doubts(
    kind: Kind,
    points: &[Point],
    pairs: &[Pair],
    notes: &Notes,
    (errors, paused): (&PointErrors, bool),
) -> Vec<Doubt> {
    let marks = match notes.marks {
        Marks::UnclearCommas => Some(DoubtKind::Commas.with(
            "each comma stands before three digits, and is read as a decimal mark: 1,249 is 1.249; \
             if the commas part thousands, take the commas out of the numbers",
        )),
        Marks::UnclearPoints => Some(DoubtKind::Points.with(
            "each decimal point stands before three digits, and is read as one: 1.249 is not 1249; if these marks \
             part thousands, take the marks out of the numbers",
        )),
        Marks::Points | Marks::Commas => None,
    };
    let course = || course(points, &pairs[0], notes.split);
    let course = if paused { None } else { course() };
    let sign = sign(kind, points, pairs);
    let stiffness = stiffness(&pairs[0], notes);
    let all = sign.into_iter().chain(marks).chain(stiffness);
    let all = all.chain(pull_off(kind, points)).chain(exact(kind, errors));
    all.chain(course).collect()
}

/// Returns the doubt that forces were made with another stiffness than the one given.
fn stiffness(pair: &Pair, notes: &Notes) -> Option<Doubt> {
    /// A cantilever that is stiffer by this factor stands for a rigid one, of heights without the deflection.
    const RIGID: f64 = 1e3;
    let (named, given) = (notes.head.stiffness.as_ref()).zip(notes.cantilever.stiffness)?;
    let are_forces = matches!(
        pair.sources().map(|source| source.role),
        [Role::Height | Role::Separation, Role::Load]
    );
    let differs = notes.head.differs_from(notes.cantilever)? && given < RIGID * named.value;
    let forces = &pair.ordinate.heading;
    let (line, of_head, factor) = (named.line, named.value, given / named.value);
    (are_forces && differs).then(|| {
        DoubtKind::Stiffness.with(format!(
            "{forces:?} holds forces, and line {line} names the stiffness {of_head} N/m, with which they were probably \
             made from the deflection; the stiffness as given, {given} N/m, leaves the forces as they are: multiply the \
             forces by {factor:.6}, or give the deflection in place of the forces"
        ))
    })
}

/// Returns the doubt that a row with a radius of 0 holds the load of the pull-off.
fn pull_off(kind: Kind, points: &[Point]) -> Option<Doubt> {
    /// The most rows of such a kind: more are the zero of the load.
    const FEW: usize = 2;
    /// The load of such a row over the range of all others.
    const PART: f64 = 0.05;
    if kind != Kind::LoadRadius {
        return None;
    }
    let is_apart = |point: &&Point| point.abscissa == 0.0;
    let contacts = points.iter().filter(|point| !is_apart(point));
    let [least, most] = extremes(contacts.map(|point| point.ordinate));
    let is_pull = |point: &&Point| {
        point.ordinate < least.min(0.0) && point.ordinate.abs() > PART * (most - least)
    };
    let row = points.iter().filter(is_apart).find(is_pull)?;
    (points.iter().filter(is_apart).count() <= FEW).then(|| {
        DoubtKind::PullOff.with(format!(
            "line {}: the contact radius is 0, so that the load should be 0, and it is {:?} N, below those of all contacts: if \
             this is the load of the pull-off, take the row out of the file, because without contact it counts as the zero \
             of the load",
            row.line, row.ordinate
        ))
    })
}

/// Returns the doubt that some of the errors of the abscissae are not known, and are 0 in the file.
fn exact(kind: Kind, errors: &PointErrors) -> Option<Doubt> {
    let count = errors.abscissa.len();
    let zeros = errors
        .abscissa
        .iter()
        .filter(|error| **error == 0.0)
        .count();
    (zeros > 0 && zeros < count).then(|| {
        DoubtKind::Exact.with(format!(
            "{zeros} of {count} standard deviations of the {} are 0, and these points count as exact there, as if they were \
             the best ones: write the deviations that they have, such as that of the others",
            kind.names()[0]
        ))
    })
}

/// Returns the doubt that columns count in the opposite sense, or that the baseline is tilted, which looks like it.
fn sign(kind: Kind, points: &[Point], pairs: &[Pair]) -> Option<Doubt> {
    let opposite = opposite(kind, points)?;
    let [abscissa, ordinate] = pairs[0].sources().map(|source| &source.heading);
    if is_tilted(kind, points) {
        return Some(Doubt {
            remedy: Some(Remedy::BaselineSlope),
            ..DoubtKind::Tilt.with(format!(
                "{ordinate:?} falls along a straight line while {abscissa:?} says that the bodies come \
                 closer, and rises near the end: the baseline may be tilted"
            ))
        });
    }
    let text = if opposite == [true; 2] {
        format!(
            "{ordinate:?} is flat, or bends down, where {abscissa:?} says that the bodies are \
             closer; both may count in the opposite sense"
        )
    } else {
        format!(
            "{ordinate:?} is smaller where {abscissa:?} says that the bodies are closer; \
             {:?} may count in the opposite sense",
            if opposite[0] { abscissa } else { ordinate }
        )
    };
    let mut turned = Vec::new();
    for (source, is_opposite) in pairs
        .iter()
        .flat_map(|pair| pair.sources().into_iter().zip(opposite))
    {
        let minus = if source.factor < 0.0 { "" } else { "-" };
        let column = (source.role, format!("{minus}{}", source.typed));
        if is_opposite && !turned.contains(&column) {
            turned.push(column);
        }
    }
    Some(Doubt {
        remedy: Some(named(turned)),
        ..DoubtKind::Sign.with(text)
    })
}

/// Returns the doubt that the points jump to and fro, are several curves, or that their directions are wrong. A curve
/// goes there and back, and in one direction it does not turn.
fn course(points: &[Point], pair: &Pair, split: Option<Split>) -> Option<Doubt> {
    let abscissa = &pair.abscissa.heading;
    let abscissae: Vec<f64> = points.iter().map(|point| point.abscissa).collect();
    if matches!(split, Some(Split::Course(_))) && jumps(&abscissae) {
        return Some(DoubtKind::Order.with(format!(
            "{abscissa:?} jumps to and fro from row to row: the rows are in no order, or hold many short curves, and those of \
             approach and retract cannot be told; sort the rows by time, or name the direction of each row in a column of \
             segments, approach or retract"
        )));
    }
    Direction::OF_POINTS.into_iter().find_map(|direction| {
        let points = points.iter().filter(|point| point.direction == direction);
        let step = points.clone().count() / ENOUGH + 1;
        let abscissae = points.map(|point| point.abscissa).step_by(step);
        match (turns(&abscissae.collect::<Vec<_>>()), direction) {
            (turns @ 2.., _) => Some(DoubtKind::Curves.with(format!(
                "{abscissa:?} turns back {turns} times, as where a file holds several curves, and they \
                 are fitted as one; if they are several, save each as a file of its own and fit the \
                 files together"
            ))),
            (1, Some(direction)) => Some(directions(abscissa, direction, split)),
            _ => None,
        }
    })
}

/// Returns the doubt that a contact stiffness is also of unloading, where its points have no direction and their `loads`, or
/// the loads that are its abscissae, go up and down once.
pub fn unloading(kind: Kind, points: &[Point], loads: &[f64]) -> Option<Doubt> {
    let abscissae = || points.iter().map(|point| point.abscissa).collect();
    let loads = match kind {
        Kind::StiffnessLoad => abscissae(),
        Kind::StiffnessDepth => loads.to_vec(),
        _ => return None,
    };
    let is_known = points.iter().any(|point| point.direction.is_some());
    (!is_known && turns(&loads) == 1).then(|| Doubt {
        remedy: Some(Remedy::Split),
        ..DoubtKind::Directions.with(
            "the loads go up and down, and all points are taken for loading: while a sample is unloaded its load and its \
             depth do not tell the contact radius, and the values found are wrong; keep the rows of the loading",
        )
    })
}

/// Returns the doubt that the abscissa goes there and back in the rows of one direction.
fn directions(abscissa: &str, direction: Direction, split: Option<Split>) -> Doubt {
    let (step, remedy) = match split {
        Some(split) => (
            format!(
                "the points were split {split}: name the direction of each row in a column of \
                 segments, approach or retract"
            ),
            None,
        ),
        None => (
            "their direction may be wrong".to_owned(),
            Some(Remedy::Split),
        ),
    };
    let name = direction.name();
    Doubt {
        remedy,
        ..DoubtKind::Directions.with(format!(
            "{abscissa:?} goes there and back in the rows that are read as {name}; {step}"
        ))
    }
}
