//! Weighted sums of rows that are stored in as few bytes as their accuracy needs.
//!
//! The columns are divided into blocks. In each block a row is dropped where it is negligible, and
//! stored in single precision where that is accurate enough.

use fearless_simd::prelude::*;
use fearless_simd::{f32x16, f64x8};

/// The number of columns of a block, small enough that the sum of a block stays in registers.
pub(crate) const BLOCK: usize = 16;

/// Rows of equal length, in blocks of two precisions.
#[derive(Clone, Debug)]
pub(crate) struct MixedPrecision {
    length: usize,
    double: Blocks<f64>,
    single: Blocks<f32>,
}

/// The blocks of rows that are stored in one precision, block by block.
#[derive(Clone, Debug)]
struct Blocks<T> {
    entries: Vec<Entries<T>>,
    /// The number of the row of each entry.
    rows: Vec<u32>,
    /// The end of each block in `entries` and `rows`.
    ends: Vec<usize>,
}

/// The columns of one row in one block, padded with zeros in the last block.
///
/// It is aligned to cache lines, because a read that begins in the middle of a line takes twice the
/// time.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
struct Entries<T>([T; BLOCK]);

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

    /// Returns the sum of the rows, each times its weight.
    #[inline(always)]
    pub(crate) fn sum<S: Simd>(&self, simd: S, weights: &[f64]) -> Vec<f64> {
        let single: Vec<f32> = weights.iter().map(|&weight| weight as f32).collect();
        let mut sum = vec![0.0; self.length.next_multiple_of(BLOCK)];
        for (i, sum) in sum.chunks_exact_mut(BLOCK).enumerate() {
            let double = self.double.sum_of_block::<S, f64x8<S>, 2>(simd, i, weights);
            let [single] = self
                .single
                .sum_of_block::<S, f32x16<S>, 1>(simd, i, &single);
            store(double, single, sum);
        }
        sum.truncate(self.length);
        sum
    }

    /// Returns `N` sums of the rows, each with its weights. A row is read once for all of them.
    #[inline(always)]
    pub(crate) fn sums<S: Simd, const N: usize>(
        &self,
        simd: S,
        weights: [&[f64]; N],
    ) -> [Vec<f64>; N] {
        let double: Vec<[f64; N]> = (0..weights[0].len())
            .map(|row| weights.map(|weights| weights[row]))
            .collect();
        let single: Vec<[f32; N]> = double
            .iter()
            .map(|weights| weights.map(|weight| weight as f32))
            .collect();
        let mut sums = weights.map(|_| vec![0.0; self.length.next_multiple_of(BLOCK)]);
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
        sums.iter_mut().for_each(|sum| sum.truncate(self.length));
        sums
    }

    /// Returns the sums of the rows with each of several weights.
    #[inline(always)]
    pub(crate) fn sum_all<S: Simd>(&self, simd: S, weights: &[Vec<f64>]) -> Vec<Vec<f64>> {
        let mut sums = Vec::with_capacity(weights.len());
        let (groups, rest) = weights.as_chunks::<4>();
        for group in groups {
            sums.extend(self.sums(simd, group.each_ref().map(Vec::as_slice)));
        }
        for weights in rest {
            sums.push(self.sum(simd, weights));
        }
        sums
    }
}

impl<T: Copy + Default> Blocks<T> {
    /// Returns no blocks.
    fn new() -> Self {
        Self {
            entries: Vec::new(),
            rows: Vec::new(),
            ends: Vec::new(),
        }
    }

    /// Appends the columns of `row` to the present block.
    fn push(&mut self, row: usize, block: impl Iterator<Item = T>) {
        let mut entries = [T::default(); BLOCK];
        entries
            .iter_mut()
            .zip(block)
            .for_each(|(entry, value)| *entry = value);
        self.entries.push(Entries(entries));
        self.rows
            .push(u32::try_from(row).expect("a row that fits in memory"));
    }

    /// Ends the present block.
    fn end_block(&mut self) {
        self.ends.push(self.rows.len());
    }

    /// Returns the weighted sum of a block, in as many vectors as a block fills.
    ///
    /// Every fourth row is added to a sum of its own, because an addition to a sum must wait for
    /// the one before it.
    #[inline(always)]
    fn sum_of_block<S: Simd, V: SimdFloat<S, Element = T>, const VECTORS: usize>(
        &self,
        simd: S,
        block: usize,
        weights: &[T],
    ) -> [V; VECTORS] {
        let block = if block == 0 { 0 } else { self.ends[block - 1] }..self.ends[block];
        let (fours, rest) = self.rows[block.clone()].as_chunks::<4>();
        let (fours_of_entries, rest_of_entries) = self.entries[block].as_chunks::<4>();
        let mut sums = [[V::splat(simd, T::default()); VECTORS]; 4];
        for (rows, entries) in fours.iter().zip(fours_of_entries) {
            for (sum, (&row, entries)) in sums.iter_mut().zip(rows.iter().zip(entries)) {
                add(simd, sum, entries, weights[row as usize]);
            }
        }
        let [mut first, second, third, fourth] = sums;
        for (&row, entries) in rest.iter().zip(rest_of_entries) {
            add(simd, &mut first, entries, weights[row as usize]);
        }
        for i in 0..VECTORS {
            first[i] += second[i] + (third[i] + fourth[i]);
        }
        first
    }

    /// Returns `N` weighted sums of a block, which are independent.
    #[inline(always)]
    fn sums_of_block<
        S: Simd,
        V: SimdFloat<S, Element = T>,
        const VECTORS: usize,
        const N: usize,
    >(
        &self,
        simd: S,
        block: usize,
        weights: &[[T; N]],
    ) -> [[V; VECTORS]; N] {
        let block = if block == 0 { 0 } else { self.ends[block - 1] }..self.ends[block];
        let mut sums = [[V::splat(simd, T::default()); VECTORS]; N];
        for (&row, entries) in self.rows[block.clone()].iter().zip(&self.entries[block]) {
            for (sum, &weight) in sums.iter_mut().zip(&weights[row as usize]) {
                add(simd, sum, entries, weight);
            }
        }
        sums
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

/// Adds a row of a block, times its weight, to the sum.
#[inline(always)]
fn add<S: Simd, V: SimdFloat<S>>(
    simd: S,
    sum: &mut [V],
    entries: &Entries<V::Element>,
    weight: V::Element,
) {
    let weight = V::splat(simd, weight);
    for (sum, entries) in sum.iter_mut().zip(entries.0.chunks_exact(V::LEN)) {
        *sum = V::from_slice(simd, entries).mul_add(weight, *sum);
    }
}

#[cfg(test)]
mod tests {
    use fearless_simd::{Level, dispatch};

    use super::*;

    #[test]
    fn each_row_keeps_the_digits_that_it_needs() {
        const LENGTH: usize = 2 * BLOCK + 5;
        const ROUNDING: f64 = 1e-13;
        const NEGLIGIBLE: f64 = 1e-11;
        // A row for each power of ten, whose columns fall by ten from block to block.
        let size = |row: usize, column: usize| 0.1_f64.powi((row + column / BLOCK) as i32);
        let entry =
            |row: usize, column: usize| size(row, column) * ((7 * row + 3 * column) as f64).sin();
        let count = 15;
        let rows: Vec<f64> = (0..count)
            .flat_map(|row| (0..LENGTH).map(move |column| entry(row, column)))
            .collect();
        let rows_in_two = MixedPrecision::new(&rows, LENGTH, |_| NEGLIGIBLE, ROUNDING);
        for row in 0..count {
            let mut weights = vec![0.0; count];
            weights[row] = 1.0 / 3.0;
            let sum = dispatch!(Level::new(), simd => rows_in_two.sum(simd, &weights));
            assert_eq!(sum.len(), LENGTH);
            // Five sums, of which four are made at a time.
            let halved: Vec<f64> = weights.iter().map(|weight| 0.5 * weight).collect();
            let all = [&weights, &halved, &weights, &halved, &weights].map(Vec::clone);
            let sums = dispatch!(Level::new(), simd => rows_in_two.sum_all(simd, &all));
            for (i, found) in sums.iter().enumerate() {
                let factor = if i % 2 == 0 { 1.0 } else { 0.5 };
                for (found, sum) in found.iter().zip(&sum) {
                    assert_eq!(*found, factor * sum, "sum {i} of row {row}");
                }
            }
            for (column, value) in sum.iter().enumerate() {
                let error = (value - entry(row, column) / 3.0).abs();
                // Entry and weight are rounded to single precision where a block of 16 columns of
                // this size allows it.
                let allowed = match size(row, column) {
                    size if size > 1.1e-6 => f64::EPSILON * size,
                    size if size > 1.1e-11 => 2.0 * ROUNDING,
                    _ => NEGLIGIBLE,
                };
                assert!(
                    error <= allowed,
                    "row {row}, column {column}: {value}, wrong by {error}"
                );
            }
        }
        let sizes = [rows_in_two.double.rows.len(), rows_in_two.single.rows.len()];
        assert!(
            sizes[0] <= 7 + 6 + 5 && sizes[1] <= 6 * 3,
            "{sizes:?} rows of blocks in double and in single precision"
        );
    }

    #[test]
    fn what_must_not_be_left_out_is_not() {
        let rows = [1e-9, 1e-9];
        let rows_in_two =
            MixedPrecision::new(&rows, 1, |row| if row == 0 { 1e-13 } else { 1e-8 }, 1e-13);
        assert_eq!(
            dispatch!(Level::new(), simd => rows_in_two.sum(simd, &[1.0, 0.0])),
            [f64::from(1e-9_f32)]
        );
        assert_eq!(
            dispatch!(Level::new(), simd => rows_in_two.sum(simd, &[0.0, 1.0])),
            [0.0]
        );
        assert_eq!(
            dispatch!(Level::new(), simd => rows_in_two.sum(simd, &[0.0, 0.0])),
            [0.0]
        );
    }
}
