//! Weighted sums of rows that are stored in as few bytes as their accuracy needs.
//!
//! The columns are divided into blocks. In each block a row is dropped where it is negligible, and
//! stored in single precision where that is accurate enough.

use std::ops::Range;

use fearless_simd::prelude::*;
use fearless_simd::{f32x16, f64x8};

/// The number of columns of a block, small enough that the sum of a block stays in registers.
pub(crate) const BLOCK: usize = 16;

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

/// The sums of the entries of [`Blocks`].
#[derive(Clone, Debug)]
struct Addends {
    /// The group of each entry, and the number of the sum that it is an addend of.
    of_entries: Vec<[u32; 2]>,
    /// The row of each sum in a group.
    rows: Vec<u32>,
    /// The end of each block in `rows`.
    ends: Vec<usize>,
}

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

impl RowWeights {
    /// No weights.
    pub(crate) const EMPTY: Self = Self {
        double: Vec::new(),
        single: Vec::new(),
    };

    /// Makes weights of their values.
    pub(crate) fn of(values: &[f64]) -> Self {
        let mut weights = Self::EMPTY;
        weights.set(&[1.0], values);
        weights
    }

    /// Replaces the weights by the products of each of the `factors` with each of the `values`, one
    /// factor after the other.
    pub(crate) fn set(&mut self, factors: &[f64], values: &[f64]) {
        let count = factors.len() * values.len();
        self.double.clear();
        self.double.reserve(count);
        for factor in factors {
            self.double
                .extend(values.iter().map(|value| factor * value));
        }
        self.single.clear();
        self.single.reserve(count);
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
        let mut sum = vec![0.0; self.length.next_multiple_of(BLOCK)];
        for (i, sum) in sum.chunks_exact_mut(BLOCK).enumerate() {
            self.sum_block(simd, i, weights, sum);
        }
        sum.truncate(self.length);
        sum
    }

    /// Returns the `columns` of the sum of the rows, each times its weight.
    #[inline(always)]
    pub(crate) fn sum_of_columns<S: Simd>(
        &self,
        simd: S,
        weights: &RowWeights,
        columns: Range<usize>,
    ) -> Vec<f64> {
        let blocks = columns.start / BLOCK..columns.end.div_ceil(BLOCK);
        let before = columns.start - blocks.start * BLOCK;
        let mut sum = vec![0.0; blocks.len() * BLOCK];
        for (i, sum) in blocks.zip(sum.chunks_exact_mut(BLOCK)) {
            self.sum_block(simd, i, weights, sum);
        }
        sum.truncate(before + columns.len());
        sum.drain(..before);
        sum
    }

    /// Writes the columns of a block of the sum of the rows, each times its weight.
    #[inline(always)]
    fn sum_block<S: Simd>(&self, simd: S, block: usize, weights: &RowWeights, sum: &mut [f64]) {
        let RowWeights { double, single } = weights;
        let double = self
            .double
            .sum_of_block::<S, f64x8<S>, 2>(simd, block, double);
        let [single] = self
            .single
            .sum_of_block::<S, f32x16<S>, 1>(simd, block, single);
        store(double, single, sum);
    }

    /// Returns `N` sums of the rows, each with its weights. A row is read once for all of them.
    #[inline(always)]
    pub(crate) fn sums<S: Simd, const N: usize>(
        &self,
        simd: S,
        weights: [&RowWeights; N],
    ) -> [Vec<f64>; N] {
        let (mut double, mut single): ([&[f64]; N], [&[f32]; N]) = ([&[]; N], [&[]; N]);
        let mut sums = [const { Vec::new() }; N];
        for n in 0..N {
            (double[n], single[n]) = (&weights[n].double, &weights[n].single);
            sums[n] = vec![0.0; self.length.next_multiple_of(BLOCK)];
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
        for sum in &mut sums {
            sum.truncate(self.length);
        }
        sums
    }

    /// Returns the sums of the rows with each of several weights.
    #[inline(always)]
    pub(crate) fn sum_all<S: Simd>(&self, simd: S, weights: &[RowWeights]) -> Vec<Vec<f64>> {
        let mut sums = Vec::with_capacity(weights.len());
        let (groups, rest) = weights.as_chunks::<4>();
        for group in groups {
            sums.extend(self.sums(simd, group.each_ref()));
        }
        match rest {
            [first, second, third] => sums.extend(self.sums(simd, [first, second, third])),
            [first, second] => sums.extend(self.sums(simd, [first, second])),
            _ => {
                for weights in rest {
                    sums.push(self.sum(simd, weights));
                }
            }
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

    /// Finds which entries add up, if the row number `i` of each group of `count` rows is added to
    /// the others.
    fn addends(&self, count: usize) -> Addends {
        let mut addends = Addends {
            of_entries: Vec::with_capacity(self.rows.len()),
            rows: Vec::new(),
            ends: Vec::new(),
        };
        let mut start = 0;
        for &end in &self.ends {
            let first = addends.rows.len();
            let mut present: Vec<u32> = self.rows[start..end]
                .iter()
                .map(|row| row % count as u32)
                .collect();
            present.sort_unstable();
            present.dedup();
            for &row in &self.rows[start..end] {
                let sum = present.partition_point(|&other| other < row % count as u32);
                let sum = u32::try_from(first + sum).expect("no more sums than rows");
                addends.of_entries.push([row / count as u32, sum]);
            }
            addends.rows.extend(present);
            addends.ends.push(addends.rows.len());
            start = end;
        }
        addends
    }

    /// Returns the sums of the entries, each times the weight of its group.
    #[inline(always)]
    fn contracted<S: Simd, V: SimdFloat<S, Element = T>>(
        &self,
        simd: S,
        addends: &Addends,
        weights: &[T],
    ) -> Self {
        let mut sums = vec![Entries([T::default(); BLOCK]); addends.rows.len()];
        for (&[group, sum], entries) in addends.of_entries.iter().zip(&self.entries) {
            let weight = V::splat(simd, weights[group as usize]);
            let sum = sums[sum as usize].0.chunks_exact_mut(V::LEN);
            for (sum, entries) in sum.zip(entries.0.chunks_exact(V::LEN)) {
                let present = V::from_slice(simd, sum);
                V::from_slice(simd, entries)
                    .mul_add(weight, present)
                    .store_slice(sum);
            }
        }
        Self {
            entries: sums,
            rows: addends.rows.clone(),
            ends: addends.ends.clone(),
        }
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
        weights: &[&[T]; N],
    ) -> [[V; VECTORS]; N] {
        let block = if block == 0 { 0 } else { self.ends[block - 1] }..self.ends[block];
        let mut sums = [[V::splat(simd, T::default()); VECTORS]; N];
        for (&row, entries) in self.rows[block.clone()].iter().zip(&self.entries[block]) {
            for (sum, weights) in sums.iter_mut().zip(weights) {
                add(simd, sum, entries, weights[row as usize]);
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
            let sum =
                dispatch!(Level::new(), simd => rows_in_two.sum(simd, &RowWeights::of(&weights)));
            let columns = dispatch!(Level::new(), simd => {
                rows_in_two.sum_of_columns(simd, &RowWeights::of(&weights), BLOCK - 2..LENGTH - 1)
            });
            assert_eq!(columns, sum[BLOCK - 2..LENGTH - 1]);
            assert_eq!(sum.len(), LENGTH);
            // Seven sums, of which four are made at a time.
            let halved: Vec<f64> = weights.iter().map(|weight| 0.5 * weight).collect();
            let all = [
                &weights, &halved, &weights, &halved, &weights, &halved, &weights,
            ];
            let all = all.map(|weights| RowWeights::of(weights));
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
            dispatch!(Level::new(), simd => rows_in_two.sum(simd, &RowWeights::of(&[1.0, 0.0]))),
            [f64::from(1e-9_f32)]
        );
        assert_eq!(
            dispatch!(Level::new(), simd => rows_in_two.sum(simd, &RowWeights::of(&[0.0, 1.0]))),
            [0.0]
        );
        assert_eq!(
            dispatch!(Level::new(), simd => rows_in_two.sum(simd, &RowWeights::of(&[0.0, 0.0]))),
            [0.0]
        );
    }

    /// Three groups of four rows, of which some blocks are missing or in single precision.
    #[test]
    fn the_contracted_rows_have_the_sums_of_all_rows() {
        const LENGTH: usize = BLOCK + 3;
        let (groups, count) = ([0.7, -0.4, 0.1], 4);
        let entry = |row: usize, column: usize| {
            0.1_f64.powi((row % 5) as i32 * 2) * ((3 * row + column) as f64).sin()
        };
        let rows: Vec<f64> = (0..groups.len() * count)
            .flat_map(|row| (0..LENGTH).map(move |column| entry(row, column)))
            .collect();
        let rows = MixedPrecision::new(&rows, LENGTH, |_| 1e-7, 1e-13);
        assert!(!rows.single.rows.is_empty() && rows.double.rows.len() < 2 * groups.len() * count);
        let contraction = rows.contraction(count);
        let weights = [0.3, -1.0, 0.2, 0.5];
        let [all, contracted] = dispatch!(Level::new(), simd => {
            let mut of_all = RowWeights::EMPTY;
            of_all.set(&groups, &weights);
            let contracted = rows.contracted(simd, &contraction, &RowWeights::of(&groups));
            [rows.sum(simd, &of_all), contracted.sum(simd, &RowWeights::of(&weights))]
        });
        for (all, contracted) in all.iter().zip(&contracted) {
            assert!((all - contracted).abs() < 1e-12, "{all} {contracted}");
        }
    }
}
