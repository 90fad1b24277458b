//! Rows in one precision, in blocks of columns, each without the rows that are negligible there; and
//! their weighted sums.

use fearless_simd::prelude::*;

use crate::vectors::BLOCK;

/// The blocks of rows that are stored in one precision, block by block.
#[derive(Clone, Debug)]
pub(crate) struct Blocks<T> {
    entries: Vec<Entries<T>>,
    /// The number of the row of each entry.
    pub(crate) rows: Vec<u32>,
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

/// The sums of the entries of [`Blocks`].
#[derive(Clone, Debug)]
pub(crate) struct Addends {
    /// The group of each entry, and the number of the sum that it is an addend of.
    of_entries: Vec<[u32; 2]>,
    /// The row of each sum in a group.
    rows: Vec<u32>,
    /// The end of each block in `rows`.
    ends: Vec<usize>,
}

impl<T: Copy + Default> Blocks<T> {
    /// Returns no blocks.
    pub(crate) fn new() -> Self {
        Self {
            entries: Vec::new(),
            rows: Vec::new(),
            ends: Vec::new(),
        }
    }

    /// Appends the columns of `row` to the present block.
    pub(crate) fn push(&mut self, row: usize, block: impl Iterator<Item = T>) {
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
    pub(crate) fn end_block(&mut self) {
        self.ends.push(self.rows.len());
    }

    /// Finds which entries add up, if the row number `i` of each group of `count` rows is added to
    /// the others.
    pub(crate) fn addends(&self, count: usize) -> Addends {
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
    pub(crate) fn contracted<S: Simd, V: SimdFloat<S, Element = T>>(
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
    pub(crate) fn sum_of_block<S: Simd, V: SimdFloat<S, Element = T>, const VECTORS: usize>(
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
    pub(crate) fn sums_of_block<
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
