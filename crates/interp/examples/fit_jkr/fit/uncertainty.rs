//! What the Jacobian where the sum of squares is least says of the errors.

use nalgebra::{DMatrix, DVector};

/// The errors of the parameters, in their units, if the model is linear over them.
pub struct Uncertainty {
    /// The standard error of each.
    pub errors: Vec<f64>,
    pub correlation: DMatrix<f64>,
    /// The ratio of the singular values of the Jacobian with columns of length 1.
    pub condition: f64,
    /// How far it is from the minimum of the linearised problem, in standard errors.
    pub short: f64,
}

impl Uncertainty {
    /// From residuals with standard deviation `scatter`: `(J^T J)^-1` by the singular values of
    /// `J`.
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
