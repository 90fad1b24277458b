//! Vectors of equal length in one piece of memory, and weighted sums of them.

use std::array;
use std::ops::Range;

/// The number of entries of a block, small enough that the sum of a block stays in registers.
pub(crate) const BLOCK: usize = 16;

/// Vectors of equal length, padded to whole blocks.
#[derive(Clone, Debug)]
pub struct Vectors {
    length: usize,
    /// One vector after the other.
    entries: Vec<f64>,
}

/// Which vectors make one sum, and of which entries the sum is asked for.
#[derive(Clone, Debug)]
pub struct WeightedSum<'a> {
    /// The numbers of the vectors, with their weights.
    pub weights: &'a [(usize, f64)],
    /// The columns of the coefficients that the sum replaces.
    pub columns: Range<usize>,
}

impl Vectors {
    /// Returns `count` vectors of `length` zeros.
    pub fn zeros(count: usize, length: usize) -> Self {
        Self {
            length,
            entries: vec![0.0; count * length.next_multiple_of(BLOCK)],
        }
    }

    /// Returns one vector of the single entry 1.
    pub(crate) fn one() -> Self {
        let mut one = Self::zeros(1, 1);
        one.entries[0] = 1.0;
        one
    }

    /// Returns the number of vectors.
    pub(crate) fn count(&self) -> usize {
        self.entries.len() / self.stride()
    }

    /// Returns the vector number `i`, without its padding.
    pub fn get(&self, i: usize) -> &[f64] {
        &self.entries[i * self.stride()..][..self.length]
    }

    /// Returns the vector number `i`, without its padding. It may be changed.
    pub fn get_mut(&mut self, i: usize) -> &mut [f64] {
        let start = i * self.stride();
        &mut self.entries[start..][..self.length]
    }

    /// Returns the vector number `i` with its padding. It may be changed.
    pub(crate) fn padded_mut(&mut self, i: usize) -> &mut [f64] {
        let [vector] = self.several_mut(i);
        vector
    }

    /// Returns `N` vectors from the number `first` on, with their padding. They may be changed.
    #[inline(always)]
    pub(crate) fn several_mut<const N: usize>(&mut self, first: usize) -> [&mut [f64]; N] {
        let stride = self.stride();
        let mut vectors = self.entries[first * stride..].chunks_exact_mut(stride);
        array::from_fn(|_| {
            vectors
                .next()
                .expect("there are `N` vectors from `first` on")
        })
    }

    /// Multiplies the entries of each vector by `factors`.
    #[inline(always)]
    pub(crate) fn scale(&mut self, factors: &[f64]) {
        for i in 0..self.count() {
            let entries = self.get_mut(i).iter_mut();
            for (entry, factor) in entries.zip(factors) {
                *entry *= factor;
            }
        }
    }

    /// Returns weighted sums of the vectors, with all their entries.
    #[inline(always)]
    pub(crate) fn sums(&self, sums: &[WeightedSum<'_>]) -> Self {
        let mut result = Self::zeros(sums.len(), self.length);
        for (i, sum) in sums.iter().enumerate() {
            for &(vector, weight) in sum.weights {
                let entries = self.get(vector).iter();
                for (sum, entry) in result.get_mut(i).iter_mut().zip(entries) {
                    *sum += weight * entry;
                }
            }
        }
        result
    }

    /// Returns the distance from the beginning of one vector to that of the next.
    fn stride(&self) -> usize {
        self.length.next_multiple_of(BLOCK)
    }
}
