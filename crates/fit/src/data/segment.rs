//! Segments of a measurement: approach, pause, retract.

use std::fmt;

use super::assignment::roles;
use super::column::Role;
use crate::statistics::median;
use crate::{Direction, Kind, Point};

/// The number of neighbouring abscissae of which the middle one counts: two that stand out are no turn.
const NEIGHBOURS: usize = 5;
/// The number of points up to which each abscissa counts.
const FEW: usize = 2 * NEIGHBOURS;
/// The part of its range by which an abscissa that turns goes back.
const TURNS: f64 = 0.02;

/// A segment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Segment {
    /// Approach or retract.
    Moving(Direction),
    /// The sphere rests.
    Pause,
}

impl Segment {
    /// Reads the words or the number of a segment. The Python package afmformats writes 0 or False
    /// for approach and 1 or True for retract; programs of nanoindenters write several words, `Unload
    /// From Peak Segment`, of which the first that is known counts. A number counts where it stands
    /// alone: in `2_retract` it numbers the segments.
    pub fn parse(words: &str) -> Option<Self> {
        let words = words.trim().to_lowercase();
        let number = match &*words {
            "0" | "0.0" => Some(Self::Moving(Direction::Approach)),
            "1" | "1.0" => Some(Self::Moving(Direction::Retract)),
            _ => None,
        };
        let mut before = "";
        let of_word = |word| {
            // `un-loading` is one word.
            let joined = if before == "un" { "un" } else { "" }.to_owned() + word;
            before = word;
            Self::of_word(&joined)
        };
        number.or_else(|| {
            words
                .split(|c: char| c.is_whitespace() || "_-".contains(c))
                .find_map(of_word)
        })
    }

    fn of_word(word: &str) -> Option<Self> {
        Some(match word {
            "approach" | "approaching" | "extend" | "extension" | "trace" | "loading" | "load"
            | "advance" | "advancing" | "forward" | "in" | "down" | "false" => {
                Self::Moving(Direction::Approach)
            }
            "retract" | "retracting" | "retraction" | "retrace" | "withdraw" | "unloading"
            | "unload" | "recede" | "receding" | "backward" | "out" | "up" | "true" => {
                Self::Moving(Direction::Retract)
            }
            "pause" | "hold" | "dwell" | "rest" | "intermediate" => Self::Pause,
            _ => return None,
        })
    }

    /// Reads the comment line that begins a segment: `segment: retract`.
    pub fn of_comment(comment: &str) -> Option<Self> {
        let (label, word) = comment.split_once(':')?;
        let label = label.trim().to_lowercase();
        (label == "segment" || label == "phase").then(|| Self::parse(word))?
    }
}

/// How points without a direction were split.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Split {
    /// By the course of the abscissa: where it turns back, or as a whole where it goes one way.
    Course(Role),
    /// At the largest ordinate.
    Largest(Role),
}

impl fmt::Display for Split {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Course(role) => write!(f, "by the course of the {}", role.name()),
            Self::Largest(role) => write!(f, "at the largest {}", role.name()),
        }
    }
}

/// Splits points into an approach and a retract: where a height, a penetration or a load as abscissa turns
/// back, and at the largest ordinate where the abscissa is a radius, which may rest while the load falls. A course
/// that goes one way is one direction as a whole.
pub fn split(points: &mut [Point], kind: Kind) -> Option<Split> {
    let ordinate = |&i: &usize| points[i].ordinate;
    let of_ordinate = |a: &usize, b: &usize| ordinate(a).total_cmp(&ordinate(b));
    let largest = (0..points.len()).max_by(of_ordinate)?;
    let [abscissa, ordinate] = roles(kind);
    let (turn, [before, after], split) = match course(points, kind, largest) {
        Some((turn, directions)) => (turn, directions, Split::Course(abscissa)),
        None => (largest, Direction::ALL, Split::Largest(ordinate)),
    };
    for (i, point) in points.iter_mut().enumerate() {
        point.direction = Some(if i <= turn { before } else { after });
    }
    Some(split)
}

/// Returns the last point of the first way, and the directions of the two ways. The signs of abscissa and
/// ordinate do not move it. At the point of the `largest` ordinate near the turn an abscissa that rests has
/// turned.
fn course(points: &[Point], kind: Kind, largest: usize) -> Option<(usize, [Direction; 2])> {
    // The part of the range within which the turn is that of the ordinate: a penetration goes on while a load
    // falls that has pressed bodies which relax.
    let (inwards, near) = match kind {
        Kind::ForceHeight => (-1.0, 0.01),
        Kind::LoadPenetration | Kind::StiffnessDepth | Kind::StiffnessLoad => (1.0, 0.05),
        Kind::LoadRadius | Kind::PenetrationRadius | Kind::StiffnessRadius => return None,
    };
    let depth = |point: &Point| inwards * point.abscissa;
    let neighbours = if points.len() > FEW { NEIGHBOURS } else { 1 };
    let smooth = points.windows(neighbours);
    let smooth = smooth.map(|some| median(some.iter().map(depth).collect()));
    let smooth: Vec<f64> = smooth.collect();
    let of_depth = |a: &usize, b: &usize| smooth[*a].total_cmp(&smooth[*b]);
    let farthest = (0..smooth.len()).min_by(of_depth)?;
    let deepest = (0..smooth.len()).max_by(of_depth)?;
    let [first, last] = [smooth[0], smooth[smooth.len() - 1]];
    let range = smooth[deepest] - smooth[farthest];
    let inward = smooth[deepest] - first.max(last);
    let outward = first.min(last) - smooth[farthest];
    let [approach, retract] = Direction::ALL;
    if inward.max(outward) <= TURNS * range {
        let one = if first <= last { approach } else { retract };
        return (range > 0.0).then_some((points.len() - 1, [one; 2]));
    }
    let (turn, sense) = if inward >= outward {
        (deepest, 1.0)
    } else {
        (farthest, -1.0)
    };
    let is_near = (depth(&points[largest]) - smooth[turn]).abs() <= near * range;
    let far_in = |i: &usize| sense * depth(&points[*i]);
    let of_sense = |a: &usize, b: &usize| far_in(a).total_cmp(&far_in(b));
    let at = if is_near {
        largest
    } else {
        // Of equal ones the first.
        (turn..turn + neighbours).rev().max_by(of_sense)?
    };
    // Where the turn is apart, the retract came first, or the abscissa counts in the opposite sense and the
    // contact is at the turn: where the ordinate is farthest from most others.
    let middle = median(points.iter().map(|point| point.ordinate).collect());
    let far = |point: &&Point| (point.ordinate - middle).abs();
    let contact = points.iter().max_by(|a, b| far(a).total_cmp(&far(b)))?;
    let is_reversed = sense < 0.0 && depth(contact) - smooth[farthest] > 0.5 * range;
    let directions = if is_reversed {
        [retract, approach]
    } else {
        [approach, retract]
    };
    Some((at, directions))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_count_before_numbers_and_a_number_counts_alone() {
        let [approach, retract] =
            [Direction::Approach, Direction::Retract].map(|one| Some(Segment::Moving(one)));
        for (text, expected) in [
            ("1_extend", approach),
            ("2_retract", retract),
            ("0 retract", retract),
            ("loading", approach),
            ("un-loading", retract),
            ("Un_Load segment", retract),
            ("Unload From Peak Segment", retract),
            ("run-in", approach),
            (" 0.0", approach),
            ("TRUE", retract),
            ("1-hold", Some(Segment::Pause)),
            // Which of the two is the approach is not said.
            ("-1", None),
            ("2", None),
            ("segment 1", None),
        ] {
            assert_eq!(Segment::parse(text), expected, "{text}");
        }
    }

    /// Points of heights, and of forces that an index gives.
    fn points(heights: &[f64], force: impl Fn(usize, f64) -> f64) -> Vec<Point> {
        let point = |(i, &abscissa): (usize, &f64)| Point {
            line: i as u64 + 1,
            abscissa,
            ordinate: force(i, abscissa),
            direction: None,
        };
        heights.iter().enumerate().map(point).collect()
    }

    /// The number of points of the first way, and whether it is the approach.
    fn first_way(kind: Kind, mut points: Vec<Point>) -> (usize, bool) {
        split(&mut points, kind).expect("points");
        let first = points[0].direction;
        let same = points.iter().take_while(|point| point.direction == first);
        (same.count(), first == Some(Direction::Approach))
    }

    #[test]
    fn a_height_splits_where_it_turns_whatever_the_signs() {
        let noise = |i: usize| ((i * 7919) % 101) as f64 / 101.0;
        let down = || (0..100).map(|i| 100.0 - f64::from(i));
        let up = || (0..100).map(|i| 1.0 + f64::from(i));
        let cycle: Vec<f64> = down().chain(up()).collect();
        let short: Vec<f64> = down().chain(up().take(10)).collect();
        let held: Vec<f64> = down().chain([1.3; 20]).chain(up()).collect();
        let reversed: Vec<f64> = up().chain(down()).collect();
        let mut spiked = cycle.clone();
        spiked[30..32].fill(-50.0);
        let pushed = |i: usize, z: f64| (20.0 - z).max(0.0) + noise(i);
        let pulled = |i: usize, z: f64| -(20.0 - z).max(0.0) + noise(i);
        let tilted = |i: usize, z: f64| pushed(i, z) + z;
        let one_way = |ways: &mut dyn Iterator<Item = f64>| ways.collect::<Vec<f64>>();
        let few = vec![5.0, 4.0, 3.0, 2.0, 1.0, 3.0];
        for (name, heights, expected) in [
            ("a cycle", &cycle, (100, true)),
            ("few points", &few, (5, true)),
            ("a short retract", &short, (100, true)),
            ("a spike", &spiked, (100, true)),
            ("a retract first", &reversed, (100, false)),
            ("an approach", &one_way(&mut down()), (100, true)),
            ("a retract", &one_way(&mut up()), (100, false)),
        ] {
            let found = [points(heights, pushed), points(heights, pulled)]
                .map(|points| first_way(Kind::ForceHeight, points));
            assert_eq!(found, [expected; 2], "{name}, pushed and pulled");
        }
        let of_tilted = points(&cycle, tilted);
        assert_eq!(first_way(Kind::ForceHeight, of_tilted), (100, true));
        // Heights in the opposite sense, and a hold, whose end is that of the largest load.
        let opposite: Vec<f64> = cycle.iter().map(|z| -z).collect();
        let of_opposite = points(&opposite, |i, z| pushed(i, -z));
        assert_eq!(first_way(Kind::ForceHeight, of_opposite), (100, true));
        let last = |i: usize| if i == 104 { 9.0 } else { 0.0 };
        let relaxed = points(&held, |i, z| pushed(i, z) + last(i));
        assert_eq!(first_way(Kind::ForceHeight, relaxed), (105, true));
        // A penetration goes on while the load falls; a radius does not tell.
        let depths: Vec<f64> = cycle.iter().map(|z| 101.0 - z).collect();
        let pressed = points(&depths, |i, x| x - if i > 97 { 9.0 } else { 0.0 });
        assert_eq!(first_way(Kind::LoadPenetration, pressed), (98, true));
        let resting = points(&depths, |i, x| x - if i > 90 { 60.0 } else { 0.0 });
        assert_eq!(first_way(Kind::LoadRadius, resting.clone()), (91, true));
        assert_eq!(first_way(Kind::LoadPenetration, resting), (100, true));
    }
}
