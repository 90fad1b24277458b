//! The low-rank form of a table, or of a tile of it: a tensor train, one core for each axis.

use crate::curve::nodes::REASONABLE;
use crate::table::chebyshev::{polynomials, smoothness};
use crate::table::entropy;
use crate::table::weighted_sum::add_rows;
use crate::{Error, Quantity};

/// The largest integer of a core: f64 holds whole numbers up to this one exactly.
const LARGEST_INTEGER: u64 = 1 << 53;
/// The largest binary logarithm of a weight: 2^99 is 6e29.
const LARGEST_WEIGHT: u8 = 99;

/// The logarithms of a table's quantities in a box of its parameters, as a tensor train (I. V.
/// Oseledets, SIAM J. Sci. Comput. 33 (2011) 2295) of polynomials.
///
/// With the scale `s = es`, or 1 for `Delta0`, and at the coordinates `y`, `u1`, `u2`,
/// `u3` of `a/t` and of the parameters of the material, in an order of their own,
///
/// ```text
/// ln(Q_q / s) = sum_{abc}  C1(u1)[a] / w1[a]  C2(u2)[a,b] / w2[b]  C3(u3)[b,c] / w3[c]  C4(y)[c,q]
/// C2(u)[a,b]  = step sum_k p_k(u) n2[a,k,b], and the other cores likewise
/// ```
///
/// The bonds `a`, `b` and `c` are the indices shared by neighbouring cores `C`; `w` are their
/// weights, powers of two; `n` are integers. The polynomials of the degrees `k = 0, 1, 2, ...`
/// along an axis are Chebyshev's between the ends of the box: `p_0 = 1`, and `p_k = 2^(1/2) T_k`
/// over `(1 + (k/s)^2)^(1/2)`, where `s` is 40 for `a/t`, 2 for `nu1` and 20 for the moduli. With
/// these factors the rounding to integers does not spoil derivatives.
///
/// The weight of a bond index is about the root mean square of its contribution to the logarithms.
/// With these weights each number of a core is about as large as its contribution, and all numbers
/// can be rounded to multiples of one step.
///
/// Along `a/t` a table takes the values at its nodes, and the spline through them. Along the other
/// axes the lookup evaluates the polynomials.
#[derive(Clone, Debug, PartialEq)]
pub struct LowRank {
    quantities: Vec<Quantity>,
    order: [usize; 3],
    terms: [usize; 4],
    weights: [Vec<i8>; 3],
    step: f64,
    cores: [Vec<i64>; 4],
}

/// Returns the shape of each core: the bond before, the terms, and the next bond, or the
/// quantities.
pub(crate) fn shapes(
    [a, b, c]: [usize; 3],
    terms: [usize; 4],
    quantities: usize,
) -> [[usize; 3]; 4] {
    let bonds = [[1, a], [a, b], [b, c], [c, quantities]];
    std::array::from_fn(|i| [bonds[i][0], terms[i], bonds[i][1]])
}

impl LowRank {
    /// Makes the form from its parts.
    ///
    /// * `quantities`: the quantities held, ascending.
    /// * `order`: the dimensions of the first three cores, see [`Table::parameters`]: 1 for the
    ///   film's modulus, 2 for `nu1`, 3 for the substrate's modulus. The last core is that of
    ///   `a/t`.
    /// * `terms`: the number of polynomials of each core, from degree 0 on.
    /// * `weights`: the binary logarithms of the weights of the three bonds, one for each value of
    ///   the bond.
    /// * `step`: what an integer of 1 stands for.
    /// * `cores`: the integers of the cores, row-major over the bond before, the degree, and the
    ///   bond after (the quantities held, for the last core).
    ///
    /// [`Table::parameters`]: crate::Table::parameters
    ///
    /// # Errors
    /// [`Error::Malformed`]
    ///
    /// * if no quantity of a sphere ([`Quantity::ALL`]) is given, one is given twice, or they are
    ///   not in order;
    /// * if `order` does not hold 1, 2 and 3;
    /// * if a bond or a core is empty, the lengths contradict each other, or a bond is longer than
    ///   the product of the bond before and the terms between;
    /// * if a weight is not in `[-99, 99]`, the step not in `[1e-30, 1e30]`, an integer not in
    ///   `[-2^53, 2^53]`, or its product with the step not in `[-1e30, 1e30]`.
    pub fn new(
        quantities: Vec<Quantity>,
        order: [usize; 3],
        terms: [usize; 4],
        weights: [Vec<i8>; 3],
        step: f64,
        cores: [Vec<i64>; 4],
    ) -> Result<Self, Error> {
        let malformed = |what: String| Err(Error::Malformed(what));
        let of_sphere = |quantity: &Quantity| Quantity::ALL.contains(quantity);
        if !quantities.iter().any(of_sphere) || !quantities.is_sorted_by(|a, b| a < b) {
            return malformed(format!(
                "a low-rank form holds {quantities:?}: it must hold one quantity of a sphere at least, \
                 in order"
            ));
        }
        if !(1..=3).all(|dimension| order.contains(&dimension)) {
            return malformed(format!(
                "the cores of a low-rank form have the dimensions {order:?}: they must be 1, 2 and 3 \
                 in any order"
            ));
        }
        if !REASONABLE.contains(&step) {
            return malformed(format!(
                "a low-rank form has the step {step:?}, outside [1e-30, 1e30]"
            ));
        }
        if let Some(weight) = weights
            .iter()
            .flatten()
            .find(|weight| weight.unsigned_abs() > LARGEST_WEIGHT)
        {
            return malformed(format!(
                "a low-rank form has the weight 2^{weight}, outside [2^-99, 2^99]"
            ));
        }
        let ranks = weights.each_ref().map(Vec::len);
        let shapes = shapes(ranks, terms, quantities.len());
        for (i, (core, shape)) in cores.iter().zip(shapes).enumerate() {
            let [before, terms, after] = shape;
            let count = before
                .checked_mul(terms)
                .and_then(|rows| rows.checked_mul(after));
            let is_sound = count == Some(core.len()) && !core.is_empty();
            if !is_sound || i < 3 && after > before * terms {
                return malformed(format!(
                    "a core of {} integers cannot have {terms} terms between bonds of {before} and \
                     {after}",
                    core.len()
                ));
            }
            let allowed = |integer: &&i64| {
                integer.unsigned_abs() <= LARGEST_INTEGER
                    && integer.unsigned_abs() as f64 * step <= *REASONABLE.end()
            };
            if let Some(integer) = core.iter().find(|integer| !allowed(integer)) {
                return malformed(format!(
                    "a core holds {integer} times {step:?}: integers must be in [-2^53, 2^53], and \
                     their products with the step in [-1e30, 1e30]"
                ));
            }
        }
        Ok(Self {
            quantities,
            order,
            terms,
            weights,
            step,
            cores,
        })
    }

    /// Returns the quantities held, in the order of [`Quantity::ALL`].
    pub fn quantities(&self) -> &[Quantity] {
        &self.quantities
    }

    /// Returns the ranks: the lengths of the bonds between the cores.
    pub fn ranks(&self) -> [usize; 3] {
        self.weights.each_ref().map(Vec::len)
    }

    /// Returns the dimensions of the first three cores: 1 for the film's modulus, 2 for `nu1`, 3
    /// for the substrate's modulus.
    pub fn order(&self) -> [usize; 3] {
        self.order
    }

    /// Returns the number of polynomials of each core.
    pub fn terms(&self) -> [usize; 4] {
        self.terms
    }

    /// Returns the number of bytes that the integers take in a file.
    pub fn coded_bytes(&self) -> usize {
        entropy::encode(self.shapes(), &self.cores).len()
    }

    /// Returns the binary logarithms of the weights.
    pub(crate) fn exponents(&self) -> &[Vec<i8>; 3] {
        &self.weights
    }

    /// Returns what an integer of 1 stands for.
    pub(crate) fn step(&self) -> f64 {
        self.step
    }

    /// Returns the integers of the cores.
    pub(crate) fn integers(&self) -> &[Vec<i64>; 4] {
        &self.cores
    }

    /// Returns the shape of each core: the bond before, the terms, and the next bond, or the
    /// quantities.
    pub(crate) fn shapes(&self) -> [[usize; 3]; 4] {
        shapes(self.ranks(), self.terms, self.quantities.len())
    }

    /// Returns the dimension of each core.
    pub(crate) fn dimensions(&self) -> [usize; 4] {
        let [first, second, third] = self.order;
        [first, second, third, 0]
    }

    /// Returns the weights and the cores times the step, scaled such that each bond index has a
    /// root mean square of 1 over the cores before it, and its contribution to the logarithms as
    /// weight. Means are those over the angles of the polynomials.
    ///
    /// Recomputed, because lookup drops small entries and must not trust the file.
    pub(crate) fn normalised(&self) -> ([Vec<f64>; 3], [Vec<f64>; 4]) {
        let mut weights = self.weights();
        let mut cores = self.cores.each_ref().map(|core| {
            core.iter()
                .map(|&n| self.step * n as f64)
                .collect::<Vec<_>>()
        });
        let dimensions = self.dimensions();
        // The mean square of a row: the squares of the polynomials have the means `1 / w_k^2`.
        let means = |core: usize| -> Vec<f64> {
            let degrees = 0..self.terms[core];
            let weight = |k| smoothness(dimensions[core], k);
            degrees.map(|k| weight(k).powi(-2)).collect()
        };
        // A bond index without any contribution vanishes in both cores, and one with next to none
        // is not scaled.
        let sound = |scale: f64| {
            if REASONABLE.contains(&scale) || scale == 0.0 {
                scale
            } else {
                1.0
            }
        };
        for bond in 0..3 {
            let means = means(bond);
            let (before, after) = cores.split_at_mut(bond + 1);
            let (core, next, width) = (&before[bond], &mut after[0], weights[bond].len());
            let length = next.len() / width;
            for (j, (weight, row)) in weights[bond]
                .iter_mut()
                .zip(next.chunks_exact_mut(length))
                .enumerate()
            {
                let entries = core[j..].iter().step_by(width);
                let size = mean_square(entries, &means, 1).sqrt() / *weight;
                let size = sound(size);
                *weight *= if size > 0.0 { size } else { 1.0 };
                row.iter_mut().for_each(|entry| *entry *= size);
            }
        }
        for bond in (0..3).rev() {
            let means = means(bond + 1);
            let (before, after) = cores.split_at_mut(bond + 1);
            let (core, next, width) = (&mut before[bond], &after[0], weights[bond].len());
            let length = next.len() / width;
            let after = length / self.terms[bond + 1];
            // The last core is a mean over the quantities.
            let averaged = if bond == 2 { after as f64 } else { 1.0 };
            for (j, (weight, row)) in weights[bond]
                .iter_mut()
                .zip(next.chunks_exact(length))
                .enumerate()
            {
                let share = (mean_square(row.iter(), &means, after) / averaged).sqrt() / *weight;
                let share = sound(share);
                *weight *= if share > 0.0 { share } else { 1.0 };
                core[j..]
                    .iter_mut()
                    .step_by(width)
                    .for_each(|entry| *entry *= share);
            }
        }
        (weights, cores)
    }

    /// Returns the weights of the bonds.
    fn weights(&self) -> [Vec<f64>; 3] {
        let weight = |&exponent: &i8| f64::from(exponent).exp2();
        self.weights
            .each_ref()
            .map(|exponents| exponents.iter().map(weight).collect())
    }

    /// Returns the logarithms at a grid of coordinates, row-major over those of the film's modulus,
    /// of `nu1`, of the substrate's modulus and of `a/t`, and the quantities held.
    ///
    /// `ends` are the ends of the box, and `places` the coordinates of the grid. Both have an entry
    /// for each dimension of a table: `a/t`, the film's modulus, `nu1`, the substrate's modulus.
    pub fn logarithms(&self, ends: [[f64; 2]; 4], places: [&[f64]; 4]) -> Vec<f64> {
        let dimensions = self.dimensions();
        let mut vectors = vec![1.0];
        for (i, [before, terms, after]) in self.shapes().into_iter().enumerate() {
            let dimension = dimensions[i];
            let weights = match i {
                0 => vec![self.step; before],
                _ => self.weights()[i - 1]
                    .iter()
                    .map(|weight| self.step / weight)
                    .collect(),
            };
            let integers: Vec<f64> = self.cores[i].iter().map(|&n| n as f64).collect();
            // The core at each place: a row over the next bond for each index of the bond before.
            let mut at_places = Vec::with_capacity(places[dimension].len() * before * after);
            for &place in places[dimension] {
                let polynomials = polynomials(dimension, terms, ends[dimension], place);
                for (b, rows) in integers.chunks_exact(terms * after).enumerate() {
                    let mut row = vec![0.0; after];
                    add_rows(&mut row, &polynomials, rows, after);
                    at_places.extend(row.iter().map(|entry| weights[b] * entry));
                }
            }
            let mut next =
                Vec::with_capacity(vectors.len() / before * places[dimension].len() * after);
            for vector in vectors.chunks_exact(before) {
                for core in at_places.chunks_exact(before * after) {
                    let mut row = vec![0.0; after];
                    add_rows(&mut row, vector, core, after);
                    next.extend(row);
                }
            }
            vectors = next;
        }
        // From the order of the cores to that of the dimensions.
        let counts = self.order.map(|dimension| places[dimension].len());
        let strides = [counts[1] * counts[2], counts[2], 1];
        let stride = |dimension: usize| {
            let core = self.order.iter().position(|&other| other == dimension);
            strides[core.expect("the order holds each dimension")]
        };
        let [by_film, by_nu, by_substrate] = [1, 2, 3].map(stride);
        let width = places[0].len() * self.quantities.len();
        let mut logarithms = Vec::with_capacity(vectors.len());
        for film in 0..places[1].len() {
            for nu in 0..places[2].len() {
                for substrate in 0..places[3].len() {
                    let row = film * by_film + nu * by_nu + substrate * by_substrate;
                    logarithms.extend_from_slice(&vectors[row * width..][..width]);
                }
            }
        }
        logarithms
    }
}

/// Returns the sum of squares, each times the mean of its term. There are `after` entries for each
/// term, one term after the other, repeatedly.
fn mean_square<'a>(entries: impl Iterator<Item = &'a f64>, means: &[f64], after: usize) -> f64 {
    entries
        .enumerate()
        .map(|(i, entry)| means[i / after % means.len()] * entry * entry)
        .sum()
}

#[cfg(all(test, feature = "embedded"))]
mod tests {
    use crate::{Material, Table};

    /// Factors that cancel between two neighbouring cores.
    #[test]
    fn what_a_lookup_leaves_out_depends_on_the_product_only() {
        let embedded = Table::embedded();
        let tiles = embedded.low_rank().expect("it is low-rank");
        let material = Material::new(1e-3, 0.4999, 2e5, 0.25).expect("physical");
        let look_up = |table: &Table| {
            table
                .curve(&material)
                .and_then(|curve| curve.quantities(0.5))
                .expect("inside")
                .to_array()
        };
        let expected = look_up(embedded);
        for bond in 0..3 {
            for factor in [-7_i8, 7] {
                let mut tiles = tiles.to_vec();
                for tile in &mut tiles {
                    // The step is a factor of all four cores.
                    tile.form.weights[bond]
                        .iter_mut()
                        .for_each(|weight| *weight += 4 * factor);
                    tile.form.step *= f64::from(factor).exp2();
                }
                let (description, axes) = (embedded.description().clone(), embedded.axes());
                let table = Table::from_low_rank(description, axes, tiles).expect("sound forms");
                for (found, expected) in look_up(&table).into_iter().zip(expected) {
                    assert!(
                        (found / expected - 1.0).abs() < 1e-12,
                        "bond {bond}, {factor}: {found}, not {expected}"
                    );
                }
            }
        }
    }
}
