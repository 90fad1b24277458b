//! Loading and unloading, as ways in which the points were measured.

use super::{Direction, Experiment};

/// The fewest points of a way.
const FEWEST: usize = 5;

impl Experiment {
    /// Returns the points of loading and those of unloading, each by descending imposed value;
    /// `None` where the data do not have both. Points without a direction have them if they come in
    /// the order of a loading and an unloading.
    pub(crate) fn ways(&self) -> Option<[Vec<usize>; 2]> {
        if self.measurement.kind.is_stiffness() {
            return None;
        }
        let points = &self.measurement.points;
        let segments: [Vec<usize>; 2] = self.segments().try_into().ok()?;
        let directions = [0, 1].map(|way| points[segments[way][0]].direction);
        let are_ways = directions == Direction::ALL.map(Some) || directions == [None; 2];
        let are_long = segments.iter().all(|way| way.len() >= FEWEST);
        (are_ways && are_long).then_some(segments)
    }
}
