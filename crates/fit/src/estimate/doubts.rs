//! The list of the doubts about a result, and the limit of what chance explains.

use crate::{Warning, WarningKind};

/// The largest excess of a sum of squares, or lack of runs, that chance explains, in standard
/// deviations: one fit in 300,000 exceeds it.
pub(super) const BEYOND_CHANCE: f64 = 4.5;
/// The doubts so far.
#[derive(Default)]
pub(super) struct Warnings(Vec<Warning>);

impl Warnings {
    /// Adds a doubt.
    pub fn add(&mut self, kind: WarningKind, text: String) {
        self.0.push(Warning { kind, text });
    }

    /// Returns the doubts in the order in which they were added.
    pub fn into_list(self) -> Vec<Warning> {
        self.0
    }
}

/// The most groups of lines of a file that a doubt names.
const SHOWN: usize = 10;

/// Names ascending lines of a file, such as `line 3` or `lines 3, 5, 8 to 12`; of many, the first ones.
pub(super) fn lines(numbers: &[u64]) -> String {
    let groups: Vec<String> = numbers
        .chunk_by(|one, next| *next == one + 1)
        .map(|group| match *group {
            [first, _, .., last] => format!("{first} to {last}"),
            [first, last] => format!("{first}, {last}"),
            _ => group[0].to_string(),
        })
        .collect();
    let more = if groups.len() > SHOWN { ", ..." } else { "" };
    let plural = if numbers.len() == 1 { "" } else { "s" };
    let shown = groups.len().min(SHOWN);
    format!("line{plural} {}{more}", groups[..shown].join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbouring_lines_are_one_group() {
        assert_eq!(lines(&[7]), "line 7");
        assert_eq!(lines(&[3, 4, 8, 9, 10, 20]), "lines 3, 4, 8 to 10, 20");
        let apart: Vec<u64> = (1..=11).map(|i| 2 * i).collect();
        assert!(lines(&apart).ends_with("18, 20, ..."));
    }
}
