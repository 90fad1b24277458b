//! Segments of a measurement: approach, pause, retract.

use crate::{Direction, Point};

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
    /// From Peak Segment`, of which the first that is known counts.
    pub fn parse(words: &str) -> Option<Self> {
        words
            .to_lowercase()
            .split(|c: char| c.is_whitespace() || "_-".contains(c))
            .find_map(Self::of_word)
    }

    fn of_word(word: &str) -> Option<Self> {
        Some(match word {
            "approach" | "approaching" | "extend" | "extension" | "trace" | "loading" | "load"
            | "advance" | "advancing" | "forward" | "in" | "down" | "0" | "0.0" | "false" => {
                Self::Moving(Direction::Approach)
            }
            "retract" | "retracting" | "retraction" | "retrace" | "withdraw" | "unloading"
            | "unload" | "recede" | "receding" | "backward" | "out" | "up" | "1" | "1.0"
            | "true" => Self::Moving(Direction::Retract),
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

/// Splits points at the largest ordinate: the points up to it are the approach, the rest is the
/// retract.
pub fn split(points: &mut [Point]) {
    let largest = points
        .iter()
        .enumerate()
        .max_by(|(_, a), (_, b)| a.ordinate.total_cmp(&b.ordinate));
    let Some((largest, _)) = largest else { return };
    for (i, point) in points.iter_mut().enumerate() {
        point.direction = Some(if i <= largest {
            Direction::Approach
        } else {
            Direction::Retract
        });
    }
}
