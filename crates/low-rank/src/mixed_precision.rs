//! Weighted sums of rows that are stored in as few bytes as their accuracy needs.
//!
//! The columns are divided into blocks. In each block a row is dropped where it is negligible, and
//! stored in single precision where that is accurate enough.

use std::ops::Range;

use fearless_simd::prelude::*;
use fearless_simd::{f32x16, f64x8};

use crate::blocks::{Addends, Blocks};
use crate::vectors::{BLOCK, Vectors};

/// A weight for each row of a [`MixedPrecision`], in both precisions.
#[derive(Clone, Debug)]
pub(crate) struct RowWeights {
    double: Vec<f64>,
    single: Vec<f32>,
}

/// Which rows of a [`MixedPrecision`] add up to one, if groups of rows are summed with a weight for
/// each group.
#[derive(Clone, Debug)]
pub(crate) struct Contraction {
    double: Addends,
    single: Addends,
}

/// Rows of equal length, in blocks of two precisions.
#[derive(Clone, Debug)]
pub(crate) struct MixedPrecision {
    length: usize,
    double: Blocks<f64>,
    single: Blocks<f32>,
}

impl RowWeights {
    /// No weights.
    pub(crate) const EMPTY: Self = Self {
        double: Vec::new(),
        single: Vec::new(),
    };

    /// Returns no weights, with room for `count`.
    pub(crate) fn with_capacity(count: usize) -> Self {
        Self {
            double: Vec::with_capacity(count),
            single: Vec::with_capacity(count),
        }
    }

    /// Makes weights of their values.
    pub(crate) fn of(values: &[f64]) -> Self {
        let mut weights = Self::EMPTY;
        weights.set(&[1.0], values);
        weights
    }

    /// Replaces the weights by the products of each of the `factors` with each of the `values`, one
    /// factor after the other.
    #[inline(always)]
    pub(crate) fn set(&mut self, factors: &[f64], values: &[f64]) {
        self.double.clear();
        self.single.clear();
        for factor in factors {
            self.double
                .extend(values.iter().map(|value| factor * value));
        }
        self.single
            .extend(self.double.iter().map(|&weight| weight as f32));
    }
}

impl MixedPrecision {
    /// Drops blocks whose norm is at most `negligible(row)`; stores a block as f32 where that
    /// rounds it by at most `rounding`.
    ///
    /// `rows` holds rows of `length` numbers, one after the other. Norms are root sums of squares
    /// over the columns of one row in one block, for a weight of 1.
    pub(crate) fn new(
        rows: &[f64],
        length: usize,
        negligible: impl Fn(usize) -> f64,
        rounding: f64,
    ) -> Self {
        let (mut double, mut single) = (Blocks::new(), Blocks::new());
        for first in (0..length).step_by(BLOCK) {
            for (i, row) in rows.chunks_exact(length).enumerate() {
                let block = &row[first..length.min(first + BLOCK)];
                let size = block.iter().map(|entry| entry * entry).sum::<f64>().sqrt();
                if size <= negligible(i) {
                    continue;
                }
                if size * f64::from(0.5 * f32::EPSILON) <= rounding {
                    single.push(i, block.iter().map(|&entry| entry as f32));
                } else {
                    double.push(i, block.iter().copied());
                }
            }
            double.end_block();
            single.end_block();
        }
        Self {
            length,
            double,
            single,
        }
    }

    /// Prepares [`Self::contracted`] for groups of `count` successive rows.
    pub(crate) fn contraction(&self, count: usize) -> Contraction {
        Contraction {
            double: self.double.addends(count),
            single: self.single.addends(count),
        }
    }

    /// Returns the sum of the groups of rows, each times its weight: as many rows as a group has.
    ///
    /// A sum of blocks of single precision has this precision, too. Each of its addends is rounded
    /// by as much as in [`Self::sum`].
    #[inline(always)]
    pub(crate) fn contracted<S: Simd>(
        &self,
        simd: S,
        contraction: &Contraction,
        weights: &RowWeights,
    ) -> Self {
        let Contraction { double, single } = contraction;
        let RowWeights {
            double: in_double,
            single: in_single,
        } = weights;
        Self {
            length: self.length,
            double: self
                .double
                .contracted::<S, f64x8<S>>(simd, double, in_double),
            single: self
                .single
                .contracted::<S, f32x16<S>>(simd, single, in_single),
        }
    }

    /// Returns the sum of the rows, each times its weight.
    #[inline(always)]
    pub(crate) fn sum<S: Simd>(&self, simd: S, weights: &RowWeights) -> Vec<f64> {
        let mut sum = Vec::new();
        self.sum_to(simd, weights, &mut sum);
        sum
    }

    /// Writes the sum of the rows, each times its weight, to `sum`. What it held is lost.
    #[inline(always)]
    pub(crate) fn sum_to<S: Simd>(&self, simd: S, weights: &RowWeights, sum: &mut Vec<f64>) {
        sum.resize(self.length.next_multiple_of(BLOCK), 0.0);
        self.sum_blocks(simd, 0, weights, sum);
        sum.truncate(self.length);
    }

    /// Writes the `columns` of the sum of the rows, each times its weight.
    #[inline(always)]
    pub(crate) fn sum_of_columns<S: Simd>(
        &self,
        simd: S,
        weights: &RowWeights,
        columns: Range<usize>,
        mut target: &mut [f64],
    ) {
        let mut start = columns.start;
        while start < columns.end {
            let (block, before) = (start / BLOCK, start % BLOCK);
            let count = (BLOCK - before).min(columns.end - start);
            let mut sum = [0.0; BLOCK];
            self.sum_blocks(simd, block, weights, &mut sum);
            let (own, rest) = target.split_at_mut(count);
            own.copy_from_slice(&sum[before..][..count]);
            (target, start) = (rest, start + count);
        }
    }

    /// Writes the blocks of the sum of the rows, each times its weight, from the block number
    /// `first` on.
    #[inline(always)]
    pub(crate) fn sum_blocks<S: Simd>(
        &self,
        simd: S,
        first: usize,
        weights: &RowWeights,
        sum: &mut [f64],
    ) {
        let RowWeights { double, single } = weights;
        for (i, sum) in sum.chunks_exact_mut(BLOCK).enumerate() {
            let double = self
                .double
                .sum_of_block::<S, f64x8<S>, 2>(simd, first + i, double);
            let [single] = self
                .single
                .sum_of_block::<S, f32x16<S>, 1>(simd, first + i, single);
            store(double, single, sum);
        }
    }

    /// Writes `N` sums of the rows, each with its weights, padded to whole blocks. A row is read
    /// once for all of them.
    #[inline(always)]
    fn sums<S: Simd, const N: usize>(
        &self,
        simd: S,
        weights: [&RowWeights; N],
        sums: [&mut [f64]; N],
    ) {
        let (mut double, mut single): ([&[f64]; N], [&[f32]; N]) = ([&[]; N], [&[]; N]);
        for n in 0..N {
            (double[n], single[n]) = (&weights[n].double, &weights[n].single);
        }
        for i in 0..self.length.div_ceil(BLOCK) {
            let double = self
                .double
                .sums_of_block::<S, f64x8<S>, 2, N>(simd, i, &double);
            let single = self
                .single
                .sums_of_block::<S, f32x16<S>, 1, N>(simd, i, &single);
            for n in 0..N {
                let [single] = single[n];
                store(double[n], single, &mut sums[n][i * BLOCK..][..BLOCK]);
            }
        }
    }

    /// Returns the sums of the rows with each of several vectors as weights. The `buffers` hold up to
    /// four of them at a time, and what they held is lost.
    #[inline(always)]
    pub(crate) fn sum_all<S: Simd>(
        &self,
        simd: S,
        vectors: &Vectors,
        buffers: &mut [RowWeights; 4],
    ) -> Vectors {
        let mut sums = Vectors::zeros(vectors.count(), self.length);
        for first in (0..vectors.count()).step_by(buffers.len()) {
            let count = buffers.len().min(vectors.count() - first);
            for (i, weights) in buffers.iter_mut().enumerate().take(count) {
                weights.set(&[1.0], vectors.get(first + i));
            }
            self.few_sums(simd, &buffers[..count], first, &mut sums);
        }
        sums
    }

    /// Writes the sums of the rows with up to four weights to the vectors of `sums` from the number
    /// `first` on.
    #[inline(always)]
    pub(crate) fn few_sums<S: Simd>(
        &self,
        simd: S,
        weights: &[RowWeights],
        first: usize,
        sums: &mut Vectors,
    ) {
        match weights {
            [] => {}
            [a] => self.sum_blocks(simd, 0, a, sums.padded_mut(first)),
            [a, b] => self.sums(simd, [a, b], sums.several_mut(first)),
            [a, b, c] => self.sums(simd, [a, b, c], sums.several_mut(first)),
            [a, b, c, d, ..] => self.sums(simd, [a, b, c, d], sums.several_mut(first)),
        }
    }
}

/// Stores the sum of the two precisions of a block.
#[inline(always)]
fn store<S: Simd>([first, second]: [f64x8<S>; 2], single: f32x16<S>, sum: &mut [f64]) {
    let (first_half, second_half) = sum.split_at_mut(BLOCK / 2);
    first.store_slice(first_half);
    second.store_slice(second_half);
    sum.iter_mut()
        .zip(single.as_slice())
        .for_each(|(sum, &entry)| *sum += f64::from(entry));
}
