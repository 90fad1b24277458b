//! The minimisation of the problem, by the crate `levenberg-marquardt`.

use levenberg_marquardt::{LeastSquaresProblem, LevenbergMarquardt, TerminationReason};
use nalgebra::storage::Owned;
use nalgebra::{DMatrix, DVector, Dyn};

use super::problem::{Ending, Problem};

/// The residuals at parameters without a contact, such as those outside the table. They are so
/// large that the method rejects the step.
const REFUSED: f64 = 1e100;

impl Problem<'_> {
    /// Minimises from the present values, until relative changes are below `tolerance`.
    pub fn minimise(mut self, patience: usize, tolerance: f64) -> Self {
        self.ending = Ending::Converged;
        if self.slots.is_empty() {
            return self;
        }
        (self.refused, self.beyond_table) = (false, false);
        // The coordinates are scaled already, by a factor of e or by the range of the data.
        let method = LevenbergMarquardt::new()
            .with_scale_diag(false)
            .with_stepbound(1.0)
            .with_ftol(tolerance)
            .with_xtol(tolerance)
            .with_gtol(0.0)
            .with_patience(patience);
        let (mut problem, report) = method.minimize(self);
        problem.ending = match report.termination {
            _ if problem.ending == Ending::Known => Ending::Known,
            // A fit that rounding has stopped has converged.
            TerminationReason::NoImprovementPossible(_) => Ending::Converged,
            TerminationReason::LostPatience => Ending::OutOfPatience,
            ref reason if reason.was_successful() => Ending::Converged,
            _ => Ending::Failed,
        };
        problem
    }
}

impl LeastSquaresProblem<f64, Dyn, Dyn> for Problem<'_> {
    type ResidualStorage = Owned<f64, Dyn>;
    type JacobianStorage = Owned<f64, Dyn, Dyn>;
    type ParameterStorage = Owned<f64, Dyn>;

    fn set_params(&mut self, x: &DVector<f64>) {
        self.x.copy_from(x);
        if self.known.iter().any(|basin| basin.holds(x)) {
            self.ending = Ending::Known;
        }
        if self.ending == Ending::Known {
            return;
        }
        if let Err(error) = self.update() {
            self.predicted = None;
            self.refused = true;
            self.beyond_table |= error.is_beyond_table();
        }
    }

    fn params(&self) -> DVector<f64> {
        self.x.clone()
    }

    fn residuals(&self) -> Option<DVector<f64>> {
        if self.ending == Ending::Known {
            return None;
        }
        if let Some((_, residuals)) = self.compressed() {
            return Some(residuals);
        }
        let refused = || DVector::from_element(self.residual_count(), REFUSED);
        Some(self.weighted_residuals().unwrap_or_else(refused))
    }

    fn jacobian(&self) -> Option<DMatrix<f64>> {
        let compressed = self.compressed().map(|(jacobian, _)| jacobian);
        compressed.or_else(|| self.weighted_jacobian())
    }
}
