//! Products of one matrix, prepared once, with many short vectors.
//!
//! In most solves by the Wiener-Hopf method the matrices have a hundred rows or fewer. The call of
//! a matrix library then takes as long as the product itself.

use fearless_simd::prelude::*;
use fearless_simd::{Level, dispatch, f64x8};

/// The rows of a group, which are multiplied side by side.
const LANES: usize = 8;

/// The number of groups of rows at once. Their sums are independent: the processor need not wait for
/// one addition before it begins the next.
const AT_ONCE: usize = 4;

/// The number of columns whose products are summed by themselves: rounding errors of one long sum would be
/// larger.
const BLOCK: usize = 32;

/// A real matrix.
#[derive(Debug)]
pub struct Matrix {
    rows: usize,
    columns: usize,
    /// Groups of [`LANES`] rows, padded with zeros. Up to [`AT_ONCE`] groups lie together, column by
    /// column.
    groups: Vec<[f64; LANES]>,
}

impl Matrix {
    /// Makes a matrix of its columns of `rows` elements, one after the other.
    ///
    /// # Panics
    /// If there is no row or no column, or if the last column is incomplete.
    pub fn from_columns(rows: usize, elements: &[f64]) -> Self {
        assert!(rows > 0 && !elements.is_empty() && elements.len().is_multiple_of(rows));
        let columns = elements.chunks_exact(rows);
        let count = columns.len();
        let mut groups = vec![[0.0; LANES]; rows.div_ceil(LANES) * count];
        for (j, column) in columns.enumerate() {
            let several = groups.chunks_mut(AT_ONCE * count);
            for (groups, part) in several.zip(column.chunks(AT_ONCE * LANES)) {
                let together = groups.len() / count;
                let of_column = &mut groups[j * together..][..together];
                of_column.as_flattened_mut()[..part.len()].copy_from_slice(part);
            }
        }
        Self {
            rows,
            columns: count,
            groups,
        }
    }

    /// Overwrites `out` with the product with `vector`. The matrix may have more columns than the
    /// vector has elements.
    ///
    /// # Panics
    /// If `out` has not as many elements as the matrix has rows, or `vector` has more elements than
    /// the matrix has columns.
    pub fn multiply(&self, vector: &[f64], out: &mut [f64]) {
        assert_eq!(out.len(), self.rows);
        assert!(vector.len() <= self.columns);
        dispatch!(Level::new(), simd => self.multiply_by(simd, vector, out));
    }

    #[inline(always)]
    fn multiply_by<S: Simd>(&self, simd: S, vector: &[f64], out: &mut [f64]) {
        let several = self.groups.chunks(AT_ONCE * self.columns);
        for (groups, out) in several.zip(out.chunks_mut(AT_ONCE * LANES)) {
            match groups.len() / self.columns {
                1 => multiply_groups::<S, 1>(simd, groups, vector, out),
                2 => multiply_groups::<S, 2>(simd, groups, vector, out),
                3 => multiply_groups::<S, 3>(simd, groups, vector, out),
                _ => multiply_groups::<S, AT_ONCE>(simd, groups, vector, out),
            }
        }
    }
}

/// Multiplies `N` groups of rows.
#[inline(always)]
fn multiply_groups<S: Simd, const N: usize>(
    simd: S,
    groups: &[[f64; LANES]],
    vector: &[f64],
    out: &mut [f64],
) {
    let (columns, _) = groups.as_chunks::<N>();
    let mut sums = [f64x8::splat(simd, 0.0); N];
    for (columns, vector) in columns.chunks(BLOCK).zip(vector.chunks(BLOCK)) {
        let mut parts = [f64x8::splat(simd, 0.0); N];
        for (column, &factor) in columns.iter().zip(vector) {
            for (part, group) in parts.iter_mut().zip(column) {
                *part = f64x8::simd_from(simd, *group).mul_add(factor, *part);
            }
        }
        for (sum, part) in sums.iter_mut().zip(parts) {
            *sum += part;
        }
    }
    for (out, sum) in out.chunks_mut(LANES).zip(&sums) {
        out.copy_from_slice(&sum.as_slice()[..out.len()]);
    }
}
