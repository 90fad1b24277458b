//! Products of the transforms of a contact at many wave numbers, summed to a symmetric matrix.

use faer::linalg::matmul::matmul;
use faer::linalg::matmul::triangular::{self, BlockStructure};
use faer::{Accum, Mat, MatRef, Par};
use fearless_simd::prelude::*;
use fearless_simd::{Level, dispatch, f64x8};

use crate::stick::coulomb::LANES;

/// The number of columns from which on the products of a matrix library are faster.
const LIBRARY: usize = 24;

/// The number of wave numbers that a matrix library sums at once. The elements of the contact of a
/// thin film nearly cancel the unit matrix, and sums of fewer terms have smaller rounding errors.
const BLOCK: usize = 64;

/// Adds `left^T right` to the rows `first..` of the lower triangle of `target`. Both matrices are
/// given by their columns of `rows` values; `rows` is a multiple of [`LANES`]. `right` has at least
/// as many columns as `target`.
pub fn add_lower(target: &mut Mat<f64>, first: usize, left: &[f64], right: &[f64], rows: usize) {
    let count = left.len() / rows;
    if count + first < LIBRARY {
        dispatch!(Level::new(), simd => add_small(simd, target, first, left, right, rows));
        return;
    }
    let left = MatRef::from_column_major_slice(left, rows, count);
    let right = &right[..(first + count) * rows];
    let right = MatRef::from_column_major_slice(right, rows, first + count);
    let mut part = target.as_mut().subrows_mut(first, count);
    for from in (0..rows).step_by(BLOCK) {
        let length = BLOCK.min(rows - from);
        let left = left.subrows(from, length).transpose();
        let right = right.subrows(from, length);
        if first > 0 {
            let target = part.as_mut().subcols_mut(0, first);
            matmul(
                target,
                Accum::Add,
                left,
                right.subcols(0, first),
                1.0,
                Par::Seq,
            );
        }
        triangular::matmul(
            part.as_mut().subcols_mut(first, count),
            BlockStructure::TriangularLower,
            Accum::Add,
            left,
            BlockStructure::Rectangular,
            right.subcols(first, count),
            BlockStructure::Rectangular,
            1.0,
            Par::Seq,
        );
    }
}

/// [`add_lower`] for few columns.
#[inline(always)]
fn add_small<S: Simd>(
    simd: S,
    target: &mut Mat<f64>,
    first: usize,
    left: &[f64],
    right: &[f64],
    rows: usize,
) {
    /// The number of columns that are multiplied at once.
    const AT_ONCE: usize = 4;
    let count = left.len() / rows;
    for j in 0..first + count {
        let right = &right[j * rows..][..rows];
        // Row `first + i` of the target is column `i` of `left`.
        let from = j.saturating_sub(first);
        let target = &mut target.col_as_slice_mut(j)[first + from..first + count];
        let left = &left[from * rows..];
        let (several, rest) = target.as_chunks_mut::<AT_ONCE>();
        let (of_several, of_rest) = left.split_at(several.len() * AT_ONCE * rows);
        for (target, left) in several
            .iter_mut()
            .zip(of_several.chunks_exact(AT_ONCE * rows))
        {
            add_dots(simd, target, left, right);
        }
        for (target, left) in rest.iter_mut().zip(of_rest.chunks_exact(rows)) {
            add_dots(simd, std::array::from_mut(target), left, right);
        }
    }
}

/// Adds the scalar products of `N` columns with `right`.
#[inline(always)]
fn add_dots<S: Simd, const N: usize>(simd: S, target: &mut [f64; N], left: &[f64], right: &[f64]) {
    let rows = right.len();
    let mut sums = [f64x8::splat(simd, 0.0); N];
    for (i, right) in right.chunks_exact(LANES).enumerate() {
        let right = f64x8::from_slice(simd, right);
        for (k, sum) in sums.iter_mut().enumerate() {
            let left = f64x8::from_slice(simd, &left[k * rows + i * LANES..][..LANES]);
            *sum = left.mul_add(right, *sum);
        }
    }
    for (target, sum) in target.iter_mut().zip(sums) {
        *target += sum.iter().sum::<f64>();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Few and many columns, with and without rows left out.
    #[test]
    fn products_are_those_of_the_definition() {
        for (first, count) in [(0, 3), (2, 5), (0, 30), (20, 20)] {
            let (rows, size) = (16, first + count);
            let left: Vec<f64> = (0..rows * count).map(|i| (i as f64 * 0.7).sin()).collect();
            let right: Vec<f64> = (0..rows * size).map(|i| (i as f64 * 0.3).cos()).collect();
            let mut target = Mat::<f64>::zeros(size, size);
            add_lower(&mut target, first, &left, &right, rows);
            for i in 0..size {
                for j in 0..=i {
                    let expected: f64 = if i < first {
                        0.0
                    } else {
                        (0..rows)
                            .map(|k| left[(i - first) * rows + k] * right[j * rows + k])
                            .sum()
                    };
                    assert!((target[(i, j)] - expected).abs() < 1e-13, "{i} {j}");
                }
            }
        }
    }
}
