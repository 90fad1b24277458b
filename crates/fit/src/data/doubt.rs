//! Doubts about how a file was read.

use std::fmt;

use super::assignment::Pair;
use super::number::Marks;
use super::segment::Split;
use super::sign::{Sign, opposite, sign};
use super::tilt::is_tilted;
use super::turns::{jumps, turns};
use super::{Notes, Role};
use crate::{Direction, Kind, Point};

/// The number of points that tell the course of a curve.
const ENOUGH: usize = 10_000;

/// A doubt about how a file was read.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Doubt {
    /// Columns may count in the opposite sense.
    Sign(Sign),
    /// The commas of the numbers may part thousands.
    Commas,
    /// The points of the numbers may part thousands.
    Points,
    /// The baseline is tilted, so that the force falls where the bodies are closer.
    Tilt {
        /// The heading of the ordinate.
        ordinate: String,
        /// The heading of the abscissa.
        abscissa: String,
    },
    /// Forces are in newtons, and the file names another stiffness than the one given.
    Stiffness {
        /// The heading of the forces.
        ordinate: String,
        /// The stiffness in the head of the file, N/m, and its line.
        of_head: (f64, u64),
        /// The one given, N/m.
        given: f64,
    },
    /// The abscissa turns back more often than that of one curve.
    Curves {
        /// The heading of the abscissa.
        abscissa: String,
        /// The number of turns in the rows of one direction, or in all rows without a direction.
        turns: usize,
    },
    /// The abscissa jumps to and fro, and the rows have no direction.
    Order {
        /// The heading of the abscissa.
        abscissa: String,
    },
    /// The abscissa goes there and back in the rows of one direction.
    Directions {
        /// The heading of the abscissa.
        abscissa: String,
        /// The direction that these rows are read as.
        direction: Direction,
        /// How the points were split, if the file does not tell their directions.
        split: Option<Split>,
    },
}

impl Doubt {
    /// Returns the kind, as a word.
    pub const fn kind(&self) -> &'static str {
        match self {
            Self::Sign(_) => "sign",
            Self::Commas => "commas",
            Self::Points => "points",
            Self::Tilt { .. } => "tilt",
            Self::Stiffness { .. } => "stiffness",
            Self::Curves { .. } => "several-curves",
            Self::Order { .. } => "order",
            Self::Directions { .. } => "directions",
        }
    }
}

impl fmt::Display for Doubt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Sign(sign) => sign.fmt(f),
            Self::Commas => write!(
                f,
                "each comma stands before three digits, and is read as a decimal mark: 1,249 is 1.249; \
                 if the commas part thousands, take the commas out of the numbers"
            ),
            Self::Points => write!(
                f,
                "each decimal point stands before three digits, and is read as one: 1.249 is not 1249; if these marks \
                 part thousands, take the marks out of the numbers"
            ),
            Self::Tilt { ordinate, abscissa } => write!(
                f,
                "{ordinate:?} falls along a straight line while {abscissa:?} says that the bodies come \
                 closer, and rises near the end: the baseline may be tilted"
            ),
            Self::Stiffness {
                ordinate,
                of_head: (of_head, line),
                given,
            } => write!(
                f,
                "{ordinate:?} holds forces, and line {line} names the stiffness {of_head} N/m, with which they were probably \
                 made from the deflection; the stiffness as given, {given} N/m, leaves them as they are: multiply them by \
                 {:.6}, or give the deflection in place of the forces",
                given / of_head
            ),
            Self::Curves { abscissa, turns } => write!(
                f,
                "{abscissa:?} turns back {turns} times, as where a file holds several curves, and they \
                 are fitted as one; if they are several, save each as a file of its own and fit the \
                 files together"
            ),
            Self::Order { abscissa } => write!(
                f,
                "{abscissa:?} jumps to and fro from row to row: the rows are in no order, or hold many short curves, and those of \
                 approach and retract cannot be told; sort the rows by time, or name the direction of each row in a column of \
                 segments, approach or retract"
            ),
            Self::Directions {
                abscissa,
                direction,
                split,
            } => write!(
                f,
                "{abscissa:?} goes there and back in the rows that are read as {}; {}",
                direction.name(),
                match split {
                    Some(split) => format!(
                        "the points were split {split}: name the direction of each row in a column of \
                         segments, approach or retract"
                    ),
                    None => "their direction may be wrong".to_owned(),
                }
            ),
        }
    }
}

/// Tells whether the abscissae and the ordinates of `points` may count in the opposite sense. Loads are positive where
/// they press the bodies together; penetrations grow, and heights fall, where the bodies come closer. `None` if neither
/// seem to, and where the baseline is tilted.
pub fn opposite_sense(kind: Kind, points: &[Point]) -> Option<[bool; 2]> {
    opposite(kind, points).filter(|_| !is_tilted(kind, points))
}

/// Returns the doubts about a file: its points, the pairs of its columns, and what else was noted.
/// `paused` points stay where they are in part, so that their course tells nothing.
pub fn doubts(
    kind: Kind,
    points: &[Point],
    pairs: &[Pair],
    notes: &Notes,
    paused: bool,
) -> Vec<Doubt> {
    let pair = &pairs[0];
    let sign = sign(kind, points, pairs).map(|sign| {
        if is_tilted(kind, points) {
            let [ordinate, abscissa] =
                [&pair.ordinate, &pair.abscissa].map(|source| source.heading.clone());
            Doubt::Tilt { ordinate, abscissa }
        } else {
            Doubt::Sign(sign)
        }
    });
    let marks = match notes.marks {
        Marks::UnclearCommas => Some(Doubt::Commas),
        Marks::UnclearPoints => Some(Doubt::Points),
        Marks::Points | Marks::Commas => None,
    };
    let course = || course(points, pair, notes.split);
    let course = if paused { None } else { course() };
    let stiffness = stiffness(pair, notes);
    let all = sign.into_iter().chain(marks).chain(stiffness);
    all.chain(course).collect()
}

/// Returns the doubt that forces were made with another stiffness than the one given.
fn stiffness(pair: &Pair, notes: &Notes) -> Option<Doubt> {
    const SAME: f64 = 1e-6;
    /// A cantilever that is stiffer by this factor stands for a rigid one, of heights without the deflection.
    const RIGID: f64 = 1e3;
    let (named, given) = (notes.head.stiffness.as_ref()).zip(notes.cantilever.stiffness)?;
    let are_forces = [pair.abscissa.role, pair.ordinate.role] == [Role::Height, Role::Load];
    let differs = (given / named.value - 1.0).abs() > SAME && given < RIGID * named.value;
    (are_forces && differs).then(|| Doubt::Stiffness {
        ordinate: pair.ordinate.heading.clone(),
        of_head: (named.value, named.line),
        given,
    })
}

/// Returns the doubt that the points jump to and fro, are several curves, or that their directions are wrong. A curve
/// goes there and back, and in one direction it does not turn.
fn course(points: &[Point], pair: &Pair, split: Option<Split>) -> Option<Doubt> {
    let heading = || pair.abscissa.heading.clone();
    let of = |direction: Option<Direction>| {
        let points = points.iter().filter(|point| point.direction == direction);
        let step = points.clone().count() / ENOUGH + 1;
        let abscissae = points.map(|point| point.abscissa).step_by(step);
        let abscissae: Vec<f64> = abscissae.collect();
        match (turns(&abscissae), direction) {
            (turns @ 2.., _) => Some(Doubt::Curves {
                abscissa: heading(),
                turns,
            }),
            (1, Some(direction)) => Some(Doubt::Directions {
                abscissa: heading(),
                direction,
                split,
            }),
            _ => None,
        }
    };
    let abscissae = || -> Vec<f64> { points.iter().map(|point| point.abscissa).collect() };
    if matches!(split, Some(Split::Course(_))) && jumps(&abscissae()) {
        return Some(Doubt::Order {
            abscissa: heading(),
        });
    }
    of(None)
        .or_else(|| of(Some(Direction::Approach)))
        .or_else(|| of(Some(Direction::Retract)))
}
