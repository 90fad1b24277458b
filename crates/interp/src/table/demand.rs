//! What the first lookup in a low-rank table needs, and how much of it the parts may ask for.

use crate::curve::resampler::Resampler;
use crate::table::tensor_train::{MOST_FUNCTIONS, intervals};
use crate::table::vectors::BLOCK;
use crate::{Error, Tile};

/// The number of parts into which the materials with which the pieces are tested divide each axis.
/// Two parts gave an error of 0.28 tolerances for other materials of the embedded table.
pub(crate) const PARTS: usize = 4;

/// The largest number of f64 that a first lookup may keep, 0.8 GB: it protects the memory of a
/// program that reads a table of any size.
const MOST_NUMBERS: u64 = 100_000_000;
/// The largest number of f64 for each integer of the cores. It protects a program that limits the
/// size of the files that it reads, because a byte holds a limited number of integers.
const NUMBERS_FOR_AN_INTEGER: u64 = 16;
/// The largest number of products for each integer.
const PRODUCTS_FOR_AN_INTEGER: u64 = 4000;
/// The numbers and products that a form of any size may need: 8 MB, and a tenth of a second.
const ALWAYS_ALLOWED: [u64; 2] = [1_000_000, 100_000_000];

/// What the first lookup in a low-rank form needs. All four cores count.
///
/// A core of a material parameter with `n` terms, between bonds of the lengths `a` and `b`, has `a
/// n b` integers in a file. The lookup makes of it `10 a` rows of length `b` on each of about `n/2`
/// intervals, by `n` products for each number. The last core becomes `a` rows of the quantities at
/// the nodes of `a/t`. The curves of 125 materials at most, on which the pieces of a curve are
/// tested, take a product for each number of one interval of the cores of one tile, and of its
/// whole last core, up to [six times](Resampler::ROUNDS). The comparison of these curves with the
/// pieces does not depend on the size of the form, and has its own limit.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Demand {
    /// The integers, and the f64 that are kept: one for each integer, and the intervals.
    numbers: u64,
    products: u64,
    integers: u64,
}

impl Demand {
    /// Adds up the needs of tiles on axes of `shape` nodes. A number that overflows counts as the
    /// largest u64.
    pub(crate) fn of(tiles: &[Tile], shape: [usize; 4]) -> Self {
        let product = |factors: &[usize]| {
            let factors = factors.iter().map(|&factor| factor as u64);
            factors.fold(1, u64::saturating_mul)
        };
        let padded = |length: usize| length.checked_next_multiple_of(BLOCK).unwrap_or(length);
        let [n_a, of_material @ ..] = shape;
        let free = of_material.into_iter().filter(|&nodes| nodes > 1);
        let materials = free.fold(1, |materials, _| materials * (PARTS + 1));
        let curves = (materials * Resampler::ROUNDS) as u64;
        let (mut demand, mut largest) = (Self::default(), 0);
        for tile in tiles {
            let mut used = 0_u64;
            for (i, [before, terms, after]) in tile.form.shapes().into_iter().enumerate() {
                let integers = product(&[before, terms, after]);
                let (kept, row) = if i < 3 {
                    let functions = terms.min(MOST_FUNCTIONS);
                    let row = product(&[before, functions, padded(after)]);
                    (row.saturating_mul(intervals(terms) as u64), row)
                } else {
                    let row = product(&[before, padded(n_a.saturating_mul(after))]);
                    (row, row)
                };
                let add = |sum: &mut u64, number: u64| *sum = sum.saturating_add(number);
                add(&mut demand.integers, integers);
                add(&mut demand.numbers, integers.saturating_mul(2));
                add(&mut demand.numbers, kept);
                add(&mut demand.products, kept.saturating_mul(terms as u64));
                add(&mut used, row);
            }
            largest = largest.max(used);
        }
        demand.products = demand
            .products
            .saturating_add(largest.saturating_mul(curves));
        demand
    }

    /// Accepts tiles on axes with these numbers of nodes, unless they need too much.
    ///
    /// # Errors
    /// [`Error::LowRankTooLarge`]
    pub(crate) fn check(&self, tiles: &[Tile], nodes: [usize; 4]) -> Result<(), Error> {
        let limit = |each: u64, always: u64| each.saturating_mul(self.integers).max(always);
        let [numbers, products] = ALWAYS_ALLOWED;
        let limits = [
            (
                "numbers",
                self.numbers,
                limit(NUMBERS_FOR_AN_INTEGER, numbers).min(MOST_NUMBERS),
            ),
            (
                "products",
                self.products,
                limit(PRODUCTS_FOR_AN_INTEGER, products),
            ),
        ];
        match limits.into_iter().find(|(_, needed, most)| needed > most) {
            Some((what, needed, most)) => Err(Error::LowRankTooLarge {
                ranks: tiles.iter().map(|tile| tile.form.ranks()).collect(),
                nodes,
                what,
                needed,
                most,
            }),
            None => Ok(()),
        }
    }
}

#[cfg(all(test, feature = "embedded"))]
mod tests {
    use super::*;
    use crate::Table;

    #[test]
    fn the_embedded_table_needs_a_fraction_of_what_is_allowed() {
        let table = Table::embedded();
        let tiles = table.low_rank().expect("it is low-rank");
        let all = Demand::of(tiles, table.shape());
        let [numbers, products] = [all.numbers, all.products].map(|number| number / all.integers);
        println!("{numbers} numbers and {products} products for each integer");
        assert!(numbers <= NUMBERS_FOR_AN_INTEGER / 2 && products <= PRODUCTS_FOR_AN_INTEGER / 2);
    }
}
