//! What the model predicts for the points of an experiment.

use super::Branch;

/// The predictions for all points of an experiment.
#[derive(Clone, Debug)]
pub(crate) struct Predicted {
    /// The ordinates; those of points that are left out mean nothing.
    pub values: Vec<f64>,
    /// The contact radii, m; 0 without a contact.
    pub radii: Vec<f64>,
    /// The points beyond the end of their branch.
    pub beyond: Vec<bool>,
    /// The points in the contact of the turn, whose line does not move.
    pub pinned: Vec<bool>,
    /// The derivatives with respect to each of the parameters asked for, point after point.
    pub derivatives: Vec<f64>,
}

impl Predicted {
    /// Takes the ordinates of points without a contact, with derivatives of 0 with respect to some parameters.
    pub fn new(values: Vec<f64>, parameters: usize) -> Self {
        let count = values.len();
        Self {
            values,
            radii: vec![0.0; count],
            beyond: vec![false; count],
            pinned: vec![false; count],
            derivatives: vec![0.0; count * parameters],
        }
    }

    /// Replaces the derivatives with respect to one of so many `parameters`.
    pub fn set_column(&mut self, column: usize, parameters: usize, derivatives: Vec<f64>) {
        let rows = self.derivatives.chunks_exact_mut(parameters);
        for (row, by) in rows.zip(derivatives) {
            row[column] = by;
        }
    }

    /// Returns the branch of a point that was assigned to a branch: pinned, where the line does not move.
    pub fn branch(&self, i: usize, assigned: Branch) -> Branch {
        if self.pinned[i] {
            Branch::Pinned
        } else {
            assigned
        }
    }
}

/// The end of a stable branch.
#[derive(Clone, Debug)]
pub(crate) struct BranchEnd {
    /// The abscissa at which it ends.
    pub abscissa: f64,
    /// The derivatives of this abscissa with respect to the parameters asked for.
    pub derivatives: Vec<f64>,
}

/// Returns the smallest and the largest of the contact radii (m) that are above 0: infinity and 0 without contacts.
pub(crate) fn ends_of_radii(radii: impl IntoIterator<Item = f64>) -> [f64; 2] {
    let of_contacts = radii.into_iter().filter(|radius| *radius > 0.0);
    of_contacts.fold([f64::INFINITY, 0.0], |[least, most]: [f64; 2], a| {
        [least.min(a), most.max(a)]
    })
}
