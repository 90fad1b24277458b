//! The points that count at first: few of each branch, none near its end.

use super::assigned::Assigned;
use crate::Branch;
use crate::statistics::extremes;

/// The most points of each branch that count at first.
const FEW: usize = 40;
/// The part of the imposed values of a branch, counted from its end, that is held back at first.
const HELD_BACK: f64 = 0.03;

/// Leaves out the points near the end of a branch that ends within the data.
pub(crate) fn hold_back(assigned: &Assigned) -> Assigned {
    let mut assigned = assigned.clone();
    let experiment = &assigned.experiment;
    if !experiment.measurement.kind.at_positions() {
        return assigned;
    }
    let points = &experiment.measurement.points;
    for branch in Branch::CONTACTS {
        let own = points.iter().zip(&assigned.branches);
        let own = own.filter(|(_, own)| **own == branch);
        let positions = own.map(|(point, _)| experiment.sense() * point.abscissa);
        let [least, most] = extremes(positions);
        let adhesive = experiment.work_of(branch) > 0.0;
        let ends = least + HELD_BACK * (most - least);
        for (point, own) in points.iter().zip(&mut assigned.branches) {
            if adhesive && *own == branch && experiment.sense() * point.abscissa < ends {
                *own = Branch::LeftOut;
            }
        }
    }
    assigned
}

/// Leaves out all but [`FEW`] points of each branch, and without adhesion of contact and of flat ends.
pub(crate) fn thin(mut assigned: Assigned) -> Assigned {
    let parts = assigned.branches_without_flat_ends(true);
    for part in [
        Branch::Advancing,
        Branch::Receding,
        Branch::Baseline,
        Branch::LeftOut,
    ] {
        let own = |&i: &usize| parts[i] == part && assigned.branches[i] != Branch::LeftOut;
        let own: Vec<usize> = assigned.order.iter().copied().filter(own).collect();
        let stride = own.len().div_ceil(FEW).max(1);
        for (n, i) in own.into_iter().enumerate() {
            if n % stride != 0 {
                assigned.branches[i] = Branch::LeftOut;
            }
        }
    }
    assigned
}
