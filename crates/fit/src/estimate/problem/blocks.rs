//! The blocks of the Jacobian of many experiments.
//!
//! An experiment depends on few of the parameters of such a fit: its rows of the Jacobian are 0 but for a few columns.
//! The decomposition `Q R` of each block by itself leaves a matrix of all `R`, which is much smaller than the Jacobian,
//! and has its singular values.

use std::ops::Range;

use nalgebra::{DMatrix, DVector, Dyn, SVD};

use super::problem::Problem;
use crate::model::Predicted;

/// The number of experiments from which on the blocks are used.
const MANY: usize = 10;

/// The rows of an experiment, and the columns of its parameters.
#[derive(Clone, Debug)]
pub(crate) struct Block {
    rows: Range<usize>,
    columns: Vec<usize>,
}

impl Problem<'_> {
    /// Returns the blocks of the experiments; none of few, which need no shorter way.
    pub(crate) fn blocks(&self) -> Vec<Block> {
        if self.assigned.len() < MANY {
            return Vec::new();
        }
        let block = |(e, rows): (usize, Range<usize>)| Block {
            rows,
            columns: self.slots_of(e),
        };
        let rows = self.rows_of_experiments();
        rows.into_iter().enumerate().map(block).collect()
    }

    /// Returns fewer derivatives and residuals for [`Self::minimise`]: the `R` of `[J r] = Q R` hold `J^T J`, `J^T r` and
    /// `r^T r`. `None` without blocks, and where derivatives are not known without further work.
    pub(crate) fn compressed(&self) -> Option<(DMatrix<f64>, DVector<f64>)> {
        let blocks = self.blocks();
        let predicted = self.predicted.as_ref()?;
        let is_known = |(block, one): (&Block, &Predicted)| {
            one.derivatives.len() == one.values.len() * block.columns.len()
        };
        if blocks.is_empty() || !blocks.iter().zip(predicted).all(is_known) {
            return None;
        }
        let (jacobian, residuals) = (self.weighted_jacobian()?, self.weighted_residuals()?);
        let count = jacobian.ncols();
        let mut both = jacobian.insert_column(count, 0.0);
        both.set_column(count, &residuals);
        let with_residuals = |mut block: Block| {
            block.columns.push(count);
            block
        };
        let blocks: Vec<Block> = blocks.into_iter().map(with_residuals).collect();
        let (both, _) = triangles(both, &blocks);
        let residuals = both.column(count).into_owned();
        Some((both.remove_column(count), residuals))
    }
}

/// Returns the singular values and vectors of a matrix with some blocks.
pub(crate) fn svd(matrix: DMatrix<f64>, blocks: &[Block]) -> SVD<f64, Dyn, Dyn> {
    let height = matrix.nrows();
    let (small, orthonormal) = triangles(matrix, blocks);
    let mut svd = small.svd(true, true);
    if let (false, Some(few)) = (blocks.is_empty(), &svd.u) {
        let mut left = DMatrix::zeros(height, few.ncols());
        let (mut row, mut from) = (0, 0);
        for q in orthonormal {
            let part = &q * few.rows(from, q.ncols());
            left.rows_mut(row, q.nrows()).copy_from(&part);
            (row, from) = (row + q.nrows(), from + q.ncols());
        }
        let rest = height - row;
        left.rows_mut(row, rest).copy_from(&few.rows(from, rest));
        svd.u = Some(left);
    }
    svd
}

/// Replaces each block of a matrix by the `R` of its decomposition. Returns the `Q`, too. Rows after the blocks stay.
fn triangles(matrix: DMatrix<f64>, blocks: &[Block]) -> (DMatrix<f64>, Vec<DMatrix<f64>>) {
    let Some(last) = blocks.last().map(|block| block.rows.end) else {
        return (matrix, Vec::new());
    };
    let rest = matrix.nrows() - last;
    let kept = blocks.iter().map(Block::kept).sum::<usize>();
    // With as many singular values as columns.
    let height = usize::max(kept + rest, matrix.ncols());
    let mut small = DMatrix::zeros(height, matrix.ncols());
    let mut row = 0;
    let mut orthonormal = Vec::with_capacity(blocks.len());
    for block in blocks.iter().filter(|block| !block.rows.is_empty()) {
        let rows = matrix.rows(block.rows.start, block.rows.len());
        let (q, r) = rows.select_columns(&block.columns).qr().unpack();
        for (k, &column) in block.columns.iter().enumerate() {
            small
                .view_mut((row, column), (r.nrows(), 1))
                .copy_from(&r.column(k));
        }
        row += r.nrows();
        orthonormal.push(q);
    }
    small
        .rows_mut(row, rest)
        .copy_from(&matrix.rows(last, rest));
    (small, orthonormal)
}

impl Block {
    /// Returns the number of rows of its `R`.
    fn kept(&self) -> usize {
        self.rows.len().min(self.columns.len())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two parameters of all experiments and one of each, a short experiment, and a prior.
    fn matrix() -> (DMatrix<f64>, Vec<Block>) {
        let mut blocks = Vec::new();
        let mut end = 0;
        for (e, height) in [40, 2, 25].into_iter().enumerate() {
            blocks.push(Block {
                rows: end..end + height,
                columns: vec![0, 1, 2 + e],
            });
            end += height;
        }
        let mut matrix = DMatrix::zeros(end + 1, 5);
        for block in &blocks {
            for (i, &k) in block
                .rows
                .clone()
                .flat_map(|i| block.columns.iter().map(move |k| (i, k)))
            {
                matrix[(i, k)] = (1.0 + (7 * i + 3 * k + i * i % 11) as f64).sin();
            }
        }
        matrix[(end, 1)] = 2.0;
        (matrix, blocks)
    }

    #[test]
    fn the_normal_equations_are_those_of_the_whole_matrix() {
        let (matrix, blocks) = matrix();
        let (small, _) = triangles(matrix.clone(), &blocks);
        assert_eq!(small.nrows(), 3 + 2 + 3 + 1);
        let difference = small.tr_mul(&small) - matrix.tr_mul(&matrix);
        assert!(difference.amax() < 1e-13, "{difference}");
    }

    #[test]
    fn the_singular_values_and_vectors_are_those_of_the_whole_matrix() {
        let (matrix, blocks) = matrix();
        let found = svd(matrix.clone(), &blocks);
        let values = &found.singular_values - matrix.singular_values();
        assert!(values.amax() < 1e-13, "{values}");
        let left = found.u.as_ref().expect("asked for");
        let product = left.tr_mul(left) - DMatrix::identity(5, 5);
        assert!(product.amax() < 1e-13, "{product}");
        let again = found.recompose().expect("all parts are there") - matrix;
        assert!(again.amax() < 1e-13, "{again}");
    }
}
