//! The end of a series of tables: a budget that does not suffice, or a tolerance out of reach.

use cost::clock::human;

use crate::Error;
use crate::table::{Budget, Plan, Scene, default_points};

/// Accepts the next table of a series if the budget is likely to suffice, given the time of the last one per point.
///
/// # Errors
/// [`Error::Budget`] with the time that is left and the time that the table would take; those of [`Plan::new`].
pub fn check(scene: &Scene, budget: Budget<'_>, seconds_per_point: f64) -> Result<(), Error> {
    let plan = Plan::within(scene, Some(budget))?;
    let takes = seconds_per_point * points(scene, plan.points() as u64);
    let left = budget.left().as_secs_f64();
    if takes <= left {
        return Ok(());
    }
    let [left, takes] = [left, takes].map(human);
    Err(Error::Budget {
        spent: format!("but for {left}, and this table would take about {takes}"),
    })
}

/// Returns the number of points that are solved for a table with this number of nodes: the nodes
/// and the points of two certificates.
pub fn points(scene: &Scene, nodes: u64) -> f64 {
    nodes as f64 + 2.0 * default_points(scene.axes()) as f64
}

/// Whether an error says that a tolerance is out of reach, rather than that something is broken.
pub const fn is_limit(error: &Error) -> bool {
    use Error::{Budget, NoLowRank, Nodes, Packed, Solve};
    matches!(
        error,
        Budget { .. }
            | NoLowRank(_)
            | Nodes(_)
            | Packed(_)
            | Solve(solve::Error::NotConverged { .. })
    )
}
