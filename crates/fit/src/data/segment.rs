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
}
