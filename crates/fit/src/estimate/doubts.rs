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
