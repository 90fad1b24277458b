//! What the preparation of a train takes: its memory and its work are known before it begins.

use crate::IntegerTrain;
use crate::functions::MOST_FUNCTIONS;
use crate::prepared_train::intervals;
use crate::vectors::BLOCK;

/// What a [`PreparedTrain`](crate::PreparedTrain) of an [`IntegerTrain`] needs once all its intervals
/// are in use. A number that overflows counts as the largest u64.
///
/// A core of the variable 1, 2 or 3 with `n` terms, between bonds of the lengths `a` and `b`, has
/// `a n b` integers. Eight times `a` rows of the length `b` are made of it on each of about `2/3 n`
/// intervals, by `n` products for each number. The last core becomes `a` rows of the functions at the
/// nodes of the variable 0.
#[derive(Clone, Copy, Debug, Default)]
pub struct Needs {
    /// The integers of all cores.
    pub integers: u64,
    /// The f64 that are kept: two for each integer, and the intervals.
    pub numbers: u64,
    /// The products that make the intervals.
    pub products: u64,
    /// The largest number of products of one evaluation: those of an interval of each core, and of the
    /// whole last core.
    pub of_evaluation: u64,
}

impl Needs {
    /// Returns what a train needs whose functions are taken at `nodes` values of the variable 0.
    pub fn of(train: &IntegerTrain, nodes: usize) -> Self {
        let product = |factors: &[usize]| {
            let factors = factors.iter().map(|&factor| factor as u64);
            factors.fold(1, u64::saturating_mul)
        };
        let padded = |length: usize| length.checked_next_multiple_of(BLOCK).unwrap_or(length);
        let mut needs = Self::default();
        for (i, [before, terms, after]) in train.shapes().into_iter().enumerate() {
            let integers = product(&[before, terms, after]);
            let (kept, row) = if i < 3 {
                let functions = terms.min(MOST_FUNCTIONS);
                let row = product(&[before, functions, padded(after)]);
                (row.saturating_mul(intervals(terms) as u64), row)
            } else {
                let row = product(&[before, padded(nodes.saturating_mul(after))]);
                (row, row)
            };
            let add = |sum: &mut u64, number: u64| *sum = sum.saturating_add(number);
            add(&mut needs.integers, integers);
            add(&mut needs.numbers, integers.saturating_mul(2));
            add(&mut needs.numbers, kept);
            add(&mut needs.products, kept.saturating_mul(terms as u64));
            add(&mut needs.of_evaluation, row);
        }
        needs
    }
}
