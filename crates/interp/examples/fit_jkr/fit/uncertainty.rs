//! The uncertainty of the parameters, from the Jacobian at the minimum of the sum of squares.

use nalgebra::{DMatrix, DVector};

/// The uncertainty of the parameters, in units of the columns of the Jacobian, for a model that is
/// linear in them over the size of their errors.
pub struct Uncertainty {
    /// The standard errors of the parameters.
    pub errors: Vec<f64>,
    /// The correlation matrix of the parameters.
    pub correlation: DMatrix<f64>,
    /// The ratio of the singular values of the Jacobian with columns of length 1.
    pub condition: f64,
    /// The distance to the minimum of the linearised problem, in standard errors.
    pub short: f64,
}

impl Uncertainty {
    /// Computes `(J^T J)^-1` from the singular values of `jacobian`, for `residuals` with standard
    /// deviation `scatter`.
    pub fn new(mut jacobian: DMatrix<f64>, residuals: &DVector<f64>, scatter: f64) -> Self {
        let lengths: Vec<f64> = jacobian
            .column_iter()
            .map(|column| column.norm().max(f64::MIN_POSITIVE))
            .collect();
        jacobian
            .column_iter_mut()
            .zip(&lengths)
            .for_each(|(mut column, length)| column /= *length);
        let count = lengths.len();
        let svd = jacobian.svd(true, true);
        let (left, right) = svd.u.zip(svd.v_t).expect("both were asked for");
        let values = svd
            .singular_values
            .map(|value| value.max(f64::MIN_POSITIVE));
        let factor = DMatrix::from_fn(count, count, |i, j| right[(i, j)] / values[i]);
        let norms: Vec<f64> = factor.column_iter().map(|column| column.norm()).collect();
        let correlation = DMatrix::from_fn(count, count, |i, j| {
            factor.column(i).dot(&factor.column(j)) / (norms[i] * norms[j])
        });
        let errors = norms
            .iter()
            .zip(&lengths)
            .map(|(norm, length)| scatter * norm / length)
            .collect();
        Self {
            errors,
            correlation,
            condition: values.max() / values.min(),
            short: left.tr_mul(residuals).norm() / scatter,
        }
    }
}
