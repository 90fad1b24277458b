//! The end of the series of tables: the tightest tolerance, or a budget that does not suffice.

use std::time::Duration;

use cost::clock::human;
use cost::table::TOLERANCES;

use crate::Error;
use crate::table::{Budget, Plan, Scene, default_points};

/// The limits of a series of tables.
#[derive(Clone, Copy)]
pub struct Limits<'a> {
    /// The tightest tolerance of a table.
    pub tightest: f64,
    /// The time for all tables together; none if there is no limit.
    pub budget: Option<Duration>,
    /// Returns the time since the start of the series. Tests count work instead of time.
    pub clock: &'a dyn Fn() -> Duration,
}

impl Limits<'_> {
    /// Returns the [`TOLERANCES`] that are not below the tightest one.
    pub fn tolerances(&self) -> impl Iterator<Item = f64> {
        let tightest = self.tightest;
        TOLERANCES
            .into_iter()
            .filter(move |&tolerance| tolerance >= tightest)
    }

    /// Returns the part of the budget that is left.
    pub fn left(&self) -> Option<Duration> {
        let spent = (self.clock)();
        self.budget.map(|budget| budget.saturating_sub(spent))
    }

    /// Accepts the next table of a series if the budget is likely to suffice, given the time of the
    /// last one per point.
    ///
    /// # Errors
    /// [`Error::Budget`] with the time that is left and the time that the table would take; those
    /// of [`Plan::new`].
    pub fn check(&self, scene: &Scene, seconds_per_point: f64) -> Result<(), Error> {
        let Some(left) = self.left() else {
            return Ok(());
        };
        let plan = Plan::within(scene, Some(Budget::of(left)))?;
        let takes = seconds_per_point * points(scene, plan.points() as u64);
        let left = self.left().unwrap_or_default().as_secs_f64();
        if takes <= left {
            return Ok(());
        }
        let [left, takes] = [left, takes].map(human);
        Err(Error::Budget {
            spent: format!("but for {left}, and this table would take about {takes}"),
        })
    }
}

/// Returns the number of points that are solved for a table with this number of nodes: the nodes
/// and the points of two certificates.
pub fn points(scene: &Scene, nodes: u64) -> f64 {
    nodes as f64 + 2.0 * default_points(scene.axes()) as f64
}

/// Whether an error says that a tolerance is out of reach, rather than that something is broken.
pub const fn is_limit(error: &Error) -> bool {
    use Error::{Budget, NoRoom, Packed, Solve, TooLarge, Truncation, Unresolved};
    matches!(
        error,
        Budget { .. }
            | NoRoom { .. }
            | Packed { .. }
            | Solve(solve::Error::NotConverged { .. })
            | TooLarge { .. }
            | Truncation { .. }
            | Unresolved { .. }
    )
}
