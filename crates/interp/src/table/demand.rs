//! What the first lookup in a low-rank table needs, and how much of it the parts may ask for.

use crate::Error;
use crate::curve::bspline::TABLE_DEGREE;
use crate::curve::resampler::Resampler;
use crate::table::lookup::PARTS;
use crate::table::mixed_precision::BLOCK;

/// The largest number of f64 that a first lookup may keep, 0.8 GB: it protects the memory of a
/// program that reads a table of any size.
const MOST_NUMBERS: u64 = 100_000_000;
/// The largest number of f64 for each byte of the form in a file. It protects a program that limits
/// the size of the files that it reads. The embedded table needs 13.
const NUMBERS_FOR_A_BYTE: u64 = 100;
/// The largest number of products for each byte. The embedded table needs 392.
const PRODUCTS_FOR_A_BYTE: u64 = 2500;
/// The numbers and products that a form of any size may need: 8 MB, and a tenth of a second.
const ALWAYS_ALLOWED: [u64; 2] = [1_000_000, 100_000_000];

/// What the first lookup in a low-rank form needs. All four cores count.
///
/// A core of `n` nodes and `f` functions, between bonds of the lengths `a` and `b`, has `a f b`
/// entries in a file, and `n f` values of functions. The lookup makes of it `a n b` numbers at the
/// nodes, by `n` products for each entry, and the coefficients of splines, by 20 products for each
/// number. The core of a material parameter then has `10 a` rows of length `b` on each of up to `n`
/// intervals, by ten products for each number. The curves of 125 materials at most, on which the
/// pieces of a curve are tested, take a product for each number of one interval of these cores, and
/// of the whole last core, up to [six times](Resampler::ROUNDS). The comparison of these curves with
/// the pieces does not depend on the size of the form, and has its own limit.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Demand {
    /// The f64 at the nodes and those that are kept.
    numbers: u64,
    products: u64,
    /// The least size of the form in a file: a byte for each entry, eight for other numbers.
    bytes: u64,
}

impl Demand {
    /// Adds up the needs of the cores of a form with bonds of the lengths `ranks`. A number that
    /// overflows counts as the largest u64.
    pub(crate) fn new(
        ranks: [usize; 3],
        nodes: [usize; 4],
        functions: &[Vec<f64>; 4],
        cores: [&[i64]; 4],
        quantities: usize,
    ) -> Self {
        let product = |factors: &[usize]| {
            let factors = factors.iter().map(|&factor| factor as u64);
            factors.fold(1, u64::saturating_mul)
        };
        let splines = TABLE_DEGREE + 1;
        let free = nodes[..3].iter().filter(|&&nodes| nodes > 1);
        let materials = free.fold(1, |materials, _| materials * (PARTS + 1));
        let [a, b, c] = ranks;
        let mut demand = Self::default();
        for (i, [before, after]) in [[1, a], [a, b], [b, c], [c, quantities]]
            .into_iter()
            .enumerate()
        {
            let at_nodes = product(&[before, nodes[i], after]);
            let [kept, made, used] = if i < 3 {
                let interval = product(&[before, splines, after.next_multiple_of(BLOCK)]);
                let kept = interval.saturating_mul(nodes[i] as u64);
                [kept, kept.saturating_mul(splines as u64), interval]
            } else {
                let length = nodes[i].saturating_mul(after);
                let whole = product(&[
                    before,
                    length.checked_next_multiple_of(BLOCK).unwrap_or(length),
                ]);
                [whole, 0, whole]
            };
            let add = |sum: &mut u64, number: u64| *sum = sum.saturating_add(number);
            add(&mut demand.numbers, at_nodes);
            add(&mut demand.numbers, kept);
            add(&mut demand.products, product(&[cores[i].len(), nodes[i]]));
            add(
                &mut demand.products,
                at_nodes.saturating_mul(2 * splines as u64),
            );
            add(&mut demand.products, made);
            let curves = (materials * Resampler::ROUNDS) as u64;
            add(&mut demand.products, used.saturating_mul(curves));
            add(&mut demand.bytes, cores[i].len() as u64);
            add(&mut demand.bytes, product(&[8, functions[i].len()]));
            add(
                &mut demand.bytes,
                product(&[8, ranks.get(i).copied().unwrap_or(0)]),
            );
        }
        demand
    }

    /// Returns the needs of two forms together.
    pub(crate) fn plus(self, other: Self) -> Self {
        Self {
            numbers: self.numbers.saturating_add(other.numbers),
            products: self.products.saturating_add(other.products),
            bytes: self.bytes.saturating_add(other.bytes),
        }
    }

    /// Accepts a form of these ranks and nodes, unless it needs too much.
    ///
    /// # Errors
    /// [`Error::LowRankTooLarge`]
    pub(crate) fn check(&self, ranks: [usize; 3], nodes: [usize; 4]) -> Result<(), Error> {
        let for_bytes = |each: u64, always: u64| each.saturating_mul(self.bytes).max(always);
        let [numbers, products] = ALWAYS_ALLOWED;
        let limits = [
            (
                "numbers",
                self.numbers,
                for_bytes(NUMBERS_FOR_A_BYTE, numbers).min(MOST_NUMBERS),
            ),
            (
                "products",
                self.products,
                for_bytes(PRODUCTS_FOR_A_BYTE, products),
            ),
        ];
        match limits.into_iter().find(|(_, needed, most)| needed > most) {
            Some((what, needed, most)) => Err(Error::LowRankTooLarge {
                ranks,
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
    use crate::{LowRank, Table};

    #[test]
    fn the_embedded_table_needs_a_fraction_of_what_is_allowed() {
        let tiles = Table::embedded().low_rank().expect("it is low-rank");
        let all = tiles.forms().iter().map(LowRank::demand);
        let all = all.fold(Demand::default(), Demand::plus);
        let [numbers, products] = [all.numbers, all.products].map(|number| number / all.bytes);
        println!("{numbers} numbers and {products} products for each byte");
        assert!(numbers <= NUMBERS_FOR_A_BYTE / 5 && products <= PRODUCTS_FOR_A_BYTE / 5);
    }
}
