//! The uncertainty of the values found, from the derivatives of the model at the minimum.

use nalgebra::{DMatrix, DVector};

use super::blocks::{Block, svd};
use super::loss::influence;
use super::problem::Problem;
use super::slot::Slot;
use crate::{Combination, Estimate, Loss};

/// The standard error, relative to the value (for offsets, to the range of the data), above which a
/// parameter or a combination of parameters counts as not determined.
pub(crate) const UNDETERMINED: f64 = 0.5;
/// The ratio of two singular values, with columns of length 1, at which rounding hides the smaller.
const SINGULAR: f64 = 1e-9;
/// The weight below which a parameter is no part of a combination.
const LIGHT: f64 = 0.1;

/// The uncertainty of the values found. Each value is measured by its size, itself or the unit of
/// its coordinate.
#[derive(Clone, Debug)]
pub(crate) struct Uncertainty {
    /// `(J^T J)^-1`, times the square of the scatter.
    pub covariance: DMatrix<f64>,
    /// The derivatives of the residuals with respect to the values in units of their sizes.
    pub jacobian: DMatrix<f64>,
    /// The blocks of these derivatives.
    pub blocks: Vec<Block>,
    /// A root of `(J^T J)^-1`, which keeps more digits.
    factor: DMatrix<f64>,
    /// The factor by which a robust loss widens the errors.
    scatter: f64,
    /// The share of each residual that the fit follows, `diag J (J^T J)^-1 J^T`.
    pub leverages: Vec<f64>,
    /// The growth of the loss, as a number of standard deviations, at one standard error: 1 of
    /// least squares.
    pub growth: f64,
    /// The columns of the Jacobian made orthonormal.
    orthonormal: DMatrix<f64>,
    /// The distance to the minimum of the linearised problem, in standard errors.
    pub short: f64,
    /// The size of each value.
    pub sizes: Vec<f64>,
}

impl Uncertainty {
    /// Computes the uncertainty at the present values; `None` where there are no derivatives.
    pub fn of(problem: &Problem<'_>) -> Option<Self> {
        let residuals = [problem.plain_residuals()?, problem.residuals_alone()?];
        let (jacobian, sizes) = problem.jacobian_of_sizes()?;
        if jacobian.nrows() < jacobian.ncols() {
            return None;
        }
        let blocks = problem.blocks();
        Some(Self::new(jacobian, blocks, residuals, problem.loss, sizes))
    }

    /// Computes the uncertainty from derivatives and residuals, and these in units of the standard deviation of each point
    /// alone, which tell how far they scatter.
    pub fn new(
        jacobian: DMatrix<f64>,
        blocks: Vec<Block>,
        [residuals, alone]: [DVector<f64>; 2],
        loss: Loss,
        sizes: Vec<f64>,
    ) -> Self {
        let count = jacobian.ncols();
        let lengths: Vec<f64> = jacobian
            .column_iter()
            .map(|column| column.norm().max(f64::MIN_POSITIVE.sqrt()))
            .collect();
        let scaled = DMatrix::from_fn(jacobian.nrows(), count, |i, j| {
            jacobian[(i, j)] / lengths[j]
        });
        let svd = svd(scaled, &blocks);
        let (left, right) = svd.u.zip(svd.v_t).expect("both were asked for");
        let least = SINGULAR * svd.singular_values.max();
        let values = svd.singular_values.map(|value| value.max(least));
        let factor = DMatrix::from_fn(right.nrows(), count, |i, j| {
            right[(i, j)] / values[i] / lengths[j]
        });
        let leverages = left.row_iter().map(|row| row.norm_squared()).collect();
        let psi = residuals.map(|residual| influence(loss, residual).0);
        let (scatter, slope) = scatter(loss, &alone, count);
        let short = left.tr_mul(&psi).norm() / scatter;
        Self {
            covariance: factor.tr_mul(&factor) * (scatter * scatter),
            jacobian,
            blocks,
            factor,
            scatter,
            leverages,
            growth: scatter * slope.sqrt(),
            orthonormal: left,
            short,
            sizes,
        }
    }

    /// Returns the uncertainty of the other values with these slots held at their values. The own error of the first of them
    /// stays; that of a further one is told with the ones before it held.
    pub fn holding(mut self, held: &[usize]) -> Self {
        for (k, &slot) in held.iter().enumerate() {
            let direction = self.factor.column(slot).normalize();
            for other in (0..self.sizes.len()).filter(|other| !held[..=k].contains(other)) {
                let mut column = self.factor.column_mut(other);
                let part = column.dot(&direction);
                column.axpy(-part, &direction, 1.0);
            }
        }
        self.covariance = self.factor.tr_mul(&self.factor) * (self.scatter * self.scatter);
        self
    }

    /// Returns what of a column is no combination of the derivatives.
    pub fn without_fitted(&self, column: &DVector<f64>) -> DVector<f64> {
        column - &self.orthonormal * self.orthonormal.tr_mul(column)
    }

    /// Returns the changes of the values found, in their standard errors, that follow a change of the residuals.
    pub fn changes_in_errors(&self, change: &DVector<f64>) -> Vec<f64> {
        let by = self.jacobian.tr_mul(change);
        let changes = -self.factor.tr_mul(&(&self.factor * by));
        let relative = changes.iter().enumerate();
        relative
            .map(|(i, change)| change / self.relative_error(i))
            .collect()
    }

    /// Returns the standard error of a value over its size.
    pub fn relative_error(&self, slot: usize) -> f64 {
        self.covariance[(slot, slot)].sqrt()
    }

    /// Returns the standard error of a value.
    pub fn error(&self, slot: usize) -> f64 {
        self.relative_error(slot) * self.sizes[slot]
    }

    /// Returns the correlation matrix.
    pub fn correlation(&self) -> Vec<Vec<f64>> {
        let count = self.sizes.len();
        let entry = |i: usize, j: usize| {
            let ratio = self.covariance[(i, j)] / (self.relative_error(i) * self.relative_error(j));
            // Rounded, it may be beyond 1.
            ratio.clamp(-1.0, 1.0)
        };
        (0..count)
            .map(|i| (0..count).map(|j| entry(i, j)).collect())
            .collect()
    }

    /// Lists the combinations whose standard error is above [`UNDETERMINED`]. A value that the data do not tell even with
    /// all others known is listed alone, as its error would hide the others.
    pub fn undetermined(&self, names: &[String]) -> Vec<Combination> {
        let combination = |weights: Vec<(usize, f64)>| {
            let parts: Vec<&str> = weights.iter().map(|&(slot, _)| &*names[slot]).collect();
            Combination {
                text: parts.join(" and "),
                weights,
            }
        };
        let is_told = |&slot: &usize| {
            let alone = self.scatter / self.jacobian.column(slot).norm();
            alone <= UNDETERMINED
        };
        let (slots, lost): (Vec<usize>, Vec<usize>) = (0..self.sizes.len()).partition(is_told);
        let lost = lost.into_iter().map(|slot| vec![(slot, 1.0)]);
        if slots.is_empty() {
            return lost.map(combination).collect();
        }
        let svd = self.factor.select_columns(&slots).svd(false, true);
        let directions = svd.v_t.expect("it was asked for");
        let large =
            (0..slots.len()).filter(|&k| self.scatter * svd.singular_values[k] > UNDETERMINED);
        let weights = large.map(|k| {
            let direction = directions.row(k);
            let weights = slots.iter().copied().zip(direction.iter().copied());
            weights.filter(|(_, weight)| weight.abs() > LIGHT).collect()
        });
        lost.chain(weights).map(combination).collect()
    }
}

/// Returns the factor by which a robust loss widens the errors of least squares: the standard
/// deviation of `psi` over the mean of `psi'`, with Huber's correction for the number of parameters
/// (Huber, *Robust Statistics*, 1981, 7.6). Returns that mean, too.
fn scatter(loss: Loss, residuals: &DVector<f64>, parameters: usize) -> (f64, f64) {
    if loss == Loss::Squares {
        return (1.0, 1.0);
    }
    let (n, p) = (residuals.len() as f64, parameters as f64);
    let (mut squares, mut slopes, mut slopes_squared) = (0.0, 0.0, 0.0);
    for residual in residuals.iter() {
        let (psi, slope) = influence(loss, *residual);
        squares += psi * psi;
        slopes += slope;
        slopes_squared += slope * slope;
    }
    let mean = slopes / n;
    let variance = slopes_squared / n - mean * mean;
    let correction = 1.0 + p / n * variance / (mean * mean);
    (correction * (squares / (n - p)).sqrt() / mean, mean)
}

/// Returns the values found, with their standard errors.
pub(crate) fn estimates(problem: &Problem<'_>, uncertainty: Option<&Uncertainty>) -> Vec<Estimate> {
    let estimate = |(i, slot): (usize, &Slot)| Estimate {
        parameter: slot.parameter,
        experiment: slot.experiment,
        value: problem.value(i),
        standard_error: uncertainty.map_or(f64::NAN, |uncertainty| uncertainty.error(i)),
        profile: None,
        prior: slot.prior,
        bounds: slot.bounds,
    };
    problem.slots.iter().enumerate().map(estimate).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Huber's proposal 7.6 by hand: `psi` is 0.5, 0.5, 1.345 and 1.345, and `psi'` 1, 1, 0 and 0.
    #[test]
    fn the_scatter_under_a_robust_loss_is_hubers() {
        let residuals = DVector::from_vec(vec![0.5, -0.5, 3.0, -9.0]);
        let (found, slope) = scatter(Loss::HUBER, &residuals, 1);
        let squares = 2.0 * (0.25 + 1.345 * 1.345);
        let expected = (1.0 + 0.25) * (squares / 3.0_f64).sqrt() / 0.5;
        assert!(
            (found / expected - 1.0).abs() < 1e-14 && slope == 0.5,
            "{found}"
        );
    }

    #[test]
    fn what_changes_next_to_nothing_hides_no_combination() {
        for tiny in [0.0, 1e-100, 1e-20, 1e-12, 1e-9] {
            // The first two change all ordinates alike, the last one hardly any.
            let row = |i: usize| {
                [
                    1.0,
                    1.0 + 1e-3 * i as f64,
                    1e3 * (i as f64).sin(),
                    tiny * i as f64,
                ]
            };
            let jacobian = DMatrix::from_fn(9, 4, |i, j| row(i)[j]);
            let uncertainty = Uncertainty::new(
                jacobian,
                Vec::new(),
                [DVector::zeros(9), DVector::zeros(9)],
                Loss::Squares,
                vec![1.0; 4],
            );
            let names = ["a", "b", "c", "d"].map(String::from);
            let found = uncertainty.undetermined(&names);
            let texts: Vec<&str> = found.iter().map(|one| one.text.as_str()).collect();
            assert_eq!(texts, ["d", "a and b"], "{tiny:e}");
            assert_eq!(found[0].weights, [(3, 1.0)]);
        }
    }
}
