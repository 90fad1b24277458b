//! A tensor train of small integers, one core for each variable: its parts, their bounds, its values.

use std::ops::RangeInclusive;

use crate::Malformed;
use crate::chebyshev::smoothness;
use crate::entropy;

/// The step, and the largest contribution of an integer: far from overflow.
const REASONABLE: RangeInclusive<f64> = 1e-30..=1e30;
/// The largest integer of a core: f64 holds whole numbers up to this one exactly.
const LARGEST_INTEGER: u64 = 1 << 53;
/// The largest binary logarithm of a weight: 2^99 is 6e29.
const LARGEST_WEIGHT: u8 = 99;

/// Functions of four variables in a box, as a tensor train (I. V. Oseledets, SIAM J. Sci. Comput. 33
/// (2011) 2295) of polynomials.
///
/// The variable number 0, here `y`, belongs to the last core. The variables 1, 2 and 3, here `u1`,
/// `u2` and `u3`, may be in any order. The function number `q` is
///
/// ```text
/// f_q(y, u1, u2, u3) = sum_{abc}  C1(u1)[a] / w1[a]  C2(u2)[a,b] / w2[b]  C3(u3)[b,c] / w3[c]  C4(y)[c,q]
/// C2(u)[a,b]         = step sum_k p_k(u) n2[a,k,b], and the other cores likewise
/// ```
///
/// The bonds `a`, `b` and `c` are the indices shared by neighbouring cores `C`; `w` are their
/// weights, powers of two; `n` are integers. The polynomials of the degrees `k = 0, 1, 2, ...`
/// along an axis are Chebyshev's between the ends of the box: `p_0 = 1`, and `p_k = 2^(1/2) T_k`
/// over `(1 + (k/s)^2)^(1/2)`, where `s` is the smooth degree of the variable. With these factors the
/// rounding to integers does not spoil derivatives.
///
/// The weight of a bond index is about the root mean square of its contribution to the functions.
/// With these weights each number of a core is about as large as its contribution, and all numbers
/// can be rounded to multiples of one step.
#[derive(Clone, Debug, PartialEq)]
pub struct IntegerTrain {
    functions: usize,
    order: [usize; 3],
    smooth_degrees: [f64; 4],
    terms: [usize; 4],
    weights: [Vec<i8>; 3],
    step: f64,
    cores: [Vec<i64>; 4],
}

/// Returns the shape of each core: the bond before, the terms, and the next bond, or the
/// functions.
fn shapes([a, b, c]: [usize; 3], terms: [usize; 4], functions: usize) -> [[usize; 3]; 4] {
    let bonds = [[1, a], [a, b], [b, c], [c, functions]];
    std::array::from_fn(|i| [bonds[i][0], terms[i], bonds[i][1]])
}

impl IntegerTrain {
    /// Makes the train from its parts.
    ///
    /// * `functions`: the number of functions.
    /// * `order`: the variables of the first three cores. The last core is that of the variable 0.
    /// * `smooth_degrees`: for each variable, the degree from which the factors of its polynomials
    ///   fall; positive.
    /// * `terms`: the number of polynomials of each core, from degree 0 on.
    /// * `weights`: the binary logarithms of the weights of the three bonds, one for each value of
    ///   the bond.
    /// * `step`: what an integer of 1 stands for.
    /// * `cores`: the integers of the cores, row-major over the bond before, the degree, and the
    ///   bond after (the functions, for the last core).
    ///
    /// # Errors
    /// [`Malformed`]
    ///
    /// * if a smooth degree is not positive;
    /// * if `order` does not hold 1, 2 and 3;
    /// * if a bond or a core is empty, the lengths contradict each other, or a bond is longer than
    ///   the product of the bond before and the terms between;
    /// * if a weight is not in `[-99, 99]`, the step not in `[1e-30, 1e30]`, an integer not in
    ///   `[-2^53, 2^53]`, or its product with the step not in `[-1e30, 1e30]`.
    pub fn new(
        functions: usize,
        order: [usize; 3],
        smooth_degrees: [f64; 4],
        terms: [usize; 4],
        weights: [Vec<i8>; 3],
        step: f64,
        cores: [Vec<i64>; 4],
    ) -> Result<Self, Malformed> {
        let malformed = |what: String| Err(Malformed(what));
        if !smooth_degrees.iter().all(|&degree| degree > 0.0) {
            return malformed(format!(
                "a train has the smooth degrees {smooth_degrees:?}: they must be positive"
            ));
        }
        if !(1..=3).all(|variable| order.contains(&variable)) {
            return malformed(format!(
                "the first cores of a train have the variables {order:?}: they must be 1, 2 and 3 \
                 in any order"
            ));
        }
        if !REASONABLE.contains(&step) {
            return malformed(format!(
                "a train has the step {step:?}, outside [1e-30, 1e30]"
            ));
        }
        if let Some(weight) = weights
            .iter()
            .flatten()
            .find(|weight| weight.unsigned_abs() > LARGEST_WEIGHT)
        {
            return malformed(format!(
                "a train has the weight 2^{weight}, outside [2^-99, 2^99]"
            ));
        }
        let ranks = weights.each_ref().map(Vec::len);
        let shapes = shapes(ranks, terms, functions);
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
            functions,
            order,
            smooth_degrees,
            terms,
            weights,
            step,
            cores,
        })
    }

    /// Makes the train from its parts, with the integers as [`coded_integers`](Self::coded_integers)
    /// returns them.
    ///
    /// # Errors
    /// [`Malformed`] as for [`new`](Self::new), and if the code is not that of integers of these shapes.
    pub fn of_code(
        functions: usize,
        order: [usize; 3],
        smooth_degrees: [f64; 4],
        terms: [usize; 4],
        weights: [Vec<i8>; 3],
        step: f64,
        integers: &[u8],
    ) -> Result<Self, Malformed> {
        let ranks = weights.each_ref().map(Vec::len);
        let cores = entropy::decode(shapes(ranks, terms, functions), integers)?;
        Self::new(
            functions,
            order,
            smooth_degrees,
            terms,
            weights,
            step,
            cores,
        )
    }

    /// Returns the number of functions.
    pub fn functions(&self) -> usize {
        self.functions
    }

    /// Returns the ranks: the lengths of the bonds between the cores.
    pub fn ranks(&self) -> [usize; 3] {
        self.weights.each_ref().map(Vec::len)
    }

    /// Returns the variables of the first three cores.
    pub fn order(&self) -> [usize; 3] {
        self.order
    }

    /// Returns the smooth degree of each variable.
    pub fn smooth_degrees(&self) -> [f64; 4] {
        self.smooth_degrees
    }

    /// Returns the number of polynomials of each core.
    pub fn terms(&self) -> [usize; 4] {
        self.terms
    }

    /// Returns the integers of the cores, row-major over the bond before, the degree, and the bond
    /// after (the functions, for the last core).
    pub fn cores(&self) -> &[Vec<i64>; 4] {
        &self.cores
    }

    /// Returns the integers of the cores in code, a few bits each.
    pub fn coded_integers(&self) -> Vec<u8> {
        entropy::encode(self.shapes(), &self.cores)
    }

    /// Returns the binary logarithms of the weights.
    pub fn exponents(&self) -> &[Vec<i8>; 3] {
        &self.weights
    }

    /// Returns what an integer of 1 stands for.
    pub fn step(&self) -> f64 {
        self.step
    }

    /// Returns the shape of each core: the bond before, the terms, and the next bond, or the
    /// functions.
    pub fn shapes(&self) -> [[usize; 3]; 4] {
        shapes(self.ranks(), self.terms, self.functions)
    }

    /// Returns the variable of each core.
    pub fn variables(&self) -> [usize; 4] {
        let [first, second, third] = self.order;
        [first, second, third, 0]
    }

    /// Returns the weights and the cores times the step, scaled such that each bond index has a
    /// root mean square of 1 over the cores before it, and its contribution to the functions as
    /// weight. Means are those over the angles of the polynomials.
    ///
    /// Recomputed, because a [`PreparedTrain`](crate::PreparedTrain) drops small entries and must not trust a file.
    pub(crate) fn normalised(&self) -> ([Vec<f64>; 3], [Vec<f64>; 4]) {
        let mut weights = self.weights();
        let mut cores = self.cores.each_ref().map(|core| {
            core.iter()
                .map(|&n| self.step * n as f64)
                .collect::<Vec<_>>()
        });
        let variables = self.variables();
        // The mean square of a row: the squares of the polynomials have the means `1 / w_k^2`.
        let means = |core: usize| -> Vec<f64> {
            let degrees = 0..self.terms[core];
            let weight = |k| smoothness(self.smooth_degrees[variables[core]], k);
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
            // The last core is a mean over the functions.
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
    pub(crate) fn weights(&self) -> [Vec<f64>; 3] {
        let weight = |&exponent: &i8| f64::from(exponent).exp2();
        self.weights
            .each_ref()
            .map(|exponents| exponents.iter().map(weight).collect())
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
