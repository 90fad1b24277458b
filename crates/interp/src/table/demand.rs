//! What the first lookup in a low-rank table needs, and how much of it the parts may ask for.

use low_rank::Needs;
use piecewise::Fitting;

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

/// What the first lookup in a low-rank table needs: [what its trains need](Needs), and the curves of
/// 125 materials at most, on which the pieces of a curve are tested, each up to [six
/// times](Fitting::ROUNDS). The comparison of these curves with the pieces does not depend on the
/// size of the trains, and has its own limit.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Demand(Needs);

impl Demand {
    /// Adds up the needs of tiles on axes of `shape` nodes. A number that overflows counts as the
    /// largest u64.
    pub(crate) fn of(tiles: &[Tile], shape: [usize; 4]) -> Self {
        let [n_a, of_material @ ..] = shape;
        let free = of_material.into_iter().filter(|&nodes| nodes > 1);
        let materials = free.fold(1, |materials, _| materials * (PARTS + 1));
        let curves = (materials * Fitting::ROUNDS) as u64;
        let each = tiles.iter().map(|tile| Needs::of(&tile.form, n_a));
        let mut all = each.fold(Needs::default(), |all, needs| Needs {
            integers: all.integers.saturating_add(needs.integers),
            numbers: all.numbers.saturating_add(needs.numbers),
            products: all.products.saturating_add(needs.products),
            // All curves may be in one tile.
            of_evaluation: all.of_evaluation.max(needs.of_evaluation),
        });
        let of_curves = all.of_evaluation.saturating_mul(curves);
        all.products = all.products.saturating_add(of_curves);
        Self(all)
    }

    /// Accepts tiles on axes with these numbers of nodes, unless they need too much.
    ///
    /// # Errors
    /// [`Error::LowRankTooLarge`]
    pub(crate) fn check(&self, tiles: &[Tile], nodes: [usize; 4]) -> Result<(), Error> {
        let limit = |each: u64, always: u64| each.saturating_mul(self.0.integers).max(always);
        let [numbers, products] = ALWAYS_ALLOWED;
        let limits = [
            (
                "numbers",
                self.0.numbers,
                limit(NUMBERS_FOR_AN_INTEGER, numbers).min(MOST_NUMBERS),
            ),
            (
                "products",
                self.0.products,
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
        let Demand(all) = Demand::of(tiles, table.shape());
        let [numbers, products] = [all.numbers, all.products].map(|number| number / all.integers);
        println!("{numbers} numbers and {products} products for each integer");
        assert!(numbers <= NUMBERS_FOR_AN_INTEGER / 2 && products <= PRODUCTS_FOR_AN_INTEGER / 2);
    }
}
