//! A tensor train of coefficients, by successive singular value decompositions (I. V. Oseledets, SIAM J. Sci. Comput. 33 (2011) 2295).
//!
//! For one mode after the other, the rest of the tensor is projected on the leading left singular
//! vectors of its unfolding, which become the core of the mode. The functions belong to the last
//! mode: they share all other cores. The first three cores may be in any order. Each order is
//! tried, and that of the fewest bytes is kept.
//!
//! The numbers of the cores, times the weights of the next bond, are rounded to multiples of one
//! step: each rounding then adds equally to the mean square error. A small index of a bond, whose
//! numbers are of the order of the step, takes few bits, and is worth keeping down to a size of
//! some steps.

use faer::{Mat, MatRef};
use rayon::prelude::*;
use thiserror::Error;

use super::coefficients::{Axis, Coefficients};
use super::matrices::{larger, rank, row_major, singular_vectors};
use crate::IntegerTrain;
use crate::values::permuted;

/// The step, over the largest error allowed anywhere: the bounds of the search. For the
/// table of `interp` it ends between a hundredth and a thousandth.
const LOOSEST: f64 = 0.3;
const TIGHTEST: f64 = 1e-6;
/// The number of bisections. Each halves the range of the logarithm of the step, to 5 % in the end.
const BISECTIONS: usize = 8;
/// The root mean square left out at each bond, in steps: the larger one costs fewer multiplications
/// at an evaluation, the smaller one leaves out less in a small part of the box.
const LEFT_OUT: [f64; 2] = [20.0, 6.0];
/// The part left out at each bond, relative to [`LEFT_OUT`]. The few indices of the first bond cost
/// little.
const BONDS: [f64; 3] = [0.2, 1.0, 1.0];
/// The step, over the allowed error, with which the orders of the cores are compared.
const USUAL: f64 = 3e-3;
/// The orders of the variables of the first three cores.
const ORDERS: [[usize; 3]; 6] = [
    [1, 2, 3],
    [1, 3, 2],
    [2, 1, 3],
    [2, 3, 1],
    [3, 1, 2],
    [3, 2, 1],
];

/// No train keeps the error that was asked for.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[error("no train of integers keeps the error {error:e}: the best one has {reached:e}")]
pub struct NotReached {
    /// The largest error allowed at the nodes.
    pub error: f64,
    /// That of the best train.
    pub reached: f64,
}

/// Returns the train of functions in a box, in about as few bytes as `error` allows, the largest
/// error of the functions at the nodes of the box.
///
/// * `axes`: those of the variables 1, 2, 3 and 0.
/// * `count`: the number of functions, one at least.
/// * `values`: at all nodes, row-major over the axes in this order, then the functions; finite, and
///   below 1e9.
///
/// It works on all threads of the caller's pool of `rayon`.
///
/// # Errors
/// [`NotReached`] where the smallest steps have a larger error.
///
/// # Panics
/// If `values` has another length, or holds a number that is not finite.
pub fn compress(
    axes: [Axis; 4],
    count: usize,
    values: &[f64],
    error: f64,
) -> Result<IntegerTrain, NotReached> {
    let nodes: usize = axes.iter().map(|axis| axis.coordinates.len()).product();
    assert_eq!(values.len(), nodes * count, "values at all nodes");
    truncate(&Part::new(axes, count, values, error), error)
}

/// The functions in a box: their values at its nodes, and their coefficients.
struct Part {
    /// The axes of the variables 1, 2, 3 and 0.
    axes: [Axis; 4],
    /// The number of functions.
    count: usize,
    /// At the nodes of the box, row-major over the axes, then the functions.
    values: Vec<f64>,
    coefficients: Coefficients,
}

impl Part {
    /// Takes the nodes of the box from all `values`, row-major over the variables 1, 2, 3 and 0 and then
    /// the `count` functions. The coefficients are accurate enough for `error`.
    pub fn new(axes: [Axis; 4], count: usize, values: &[f64], error: f64) -> Self {
        let coefficients = Coefficients::new(&axes, count, values, error);
        let mut values = values.to_vec();
        let mut width = values.len();
        let mut before = 1;
        for axis in &axes {
            let (nodes, [first, last]) = (axis.coordinates.len(), axis.nodes);
            width /= nodes;
            values = values
                .chunks_exact(nodes * width)
                .flat_map(|block| &block[first * width..(last + 1) * width])
                .copied()
                .collect();
            before *= last - first + 1;
            debug_assert_eq!(values.len(), before * width);
        }
        Self {
            axes,
            count,
            values,
            coefficients,
        }
    }

    /// Returns the largest difference of the values at the nodes from those of a train.
    fn largest_difference(&self, train: &IntegerTrain) -> f64 {
        let axis = |variable: usize| &self.axes[(variable + 3) % 4];
        let ends = std::array::from_fn(|variable| axis(variable).ends());
        let places: [&[f64]; 4] = std::array::from_fn(|variable| {
            let Axis {
                coordinates,
                nodes: [first, last],
                ..
            } = axis(variable);
            &coordinates[*first..=*last]
        });
        let slowest = places[1];
        let width = self.values.len() / slowest.len();
        // One value of the variable 1 at a time, which takes little memory.
        let differences = (0..slowest.len()).into_par_iter().map(|i| {
            let mut places = places;
            places[1] = &slowest[i..=i];
            let found = train.values(ends, places);
            let exact = &self.values[i * width..][..width];
            let differences = found
                .iter()
                .zip(exact)
                .map(|(found, exact)| (found - exact).abs());
            differences.fold(0.0, larger)
        });
        differences.reduce(|| 0.0, larger)
    }
}

/// Returns a part as one tensor train, in about as few bytes as `error` allows, the largest error of
/// the functions at the nodes.
///
/// # Errors
/// [`NotReached`] where the smallest steps have a larger error.
fn truncate(part: &Part, error: f64) -> Result<IntegerTrain, NotReached> {
    let trains: Vec<_> = ORDERS
        .into_par_iter()
        .map(|order| {
            let train = Train::of(part, order, 1e-4 * error);
            let integers = train.truncated(part, LEFT_OUT[0], USUAL * error);
            (coded_bytes(&integers), train)
        })
        .collect();
    let (_, train) = trains
        .into_iter()
        .min_by_key(|(bytes, _)| *bytes)
        .expect("there are orders");
    let mut forms = Vec::new();
    let mut reached = f64::INFINITY;
    for left_out in LEFT_OUT {
        let (mut best, mut tight, mut loose) = (None, TIGHTEST.ln(), LOOSEST.ln());
        for i in 0..=BISECTIONS {
            // The last attempt is the tightest, if no other has kept the error.
            let step = match (i < BISECTIONS, &best) {
                (true, _) => 0.5 * (tight + loose),
                (false, None) => TIGHTEST.ln(),
                (false, Some(_)) => break,
            };
            let form = train.truncated(part, left_out, step.exp() * error);
            let found = part.largest_difference(&form);
            reached = reached.min(found);
            if found <= error {
                (best, tight) = (Some(form), step);
            } else {
                loose = step;
            }
        }
        forms.extend(best);
    }
    forms
        .into_iter()
        .min_by_key(coded_bytes)
        .ok_or(NotReached { error, reached })
}

/// Returns the number of bytes that the integers of a train take.
fn coded_bytes(train: &IntegerTrain) -> usize {
    train.coded_integers().len()
}

/// The coefficients of a part as a tensor train that leaves out next to nothing.
struct Train {
    /// The variables of the first three cores.
    order: [usize; 3],
    /// For each bond, the root mean square that each of its indices adds to the functions,
    /// descending.
    weights: [Vec<f64>; 3],
    /// The cores, row-major over the bond before, the function along the axis, and the next bond.
    /// The vectors of each index of a bond have the length 1. Those of the last core have the root
    /// mean square of the index.
    cores: [Vec<f64>; 4],
}

impl Train {
    /// Decomposes the coefficients of a part, with the cores in an order. Leaves out at most `tail`
    /// (root mean square) at each bond.
    fn of(part: &Part, order: [usize; 3], tail: f64) -> Self {
        let Coefficients { functions, core } = &part.coefficients;
        let held = part.count;
        // The mean is that over the functions.
        let scale = (held as f64).sqrt();
        let counts: Vec<usize> = functions.iter().map(Mat::ncols).collect();
        let mut rest = permuted(core, &counts, order);
        let (mut weights, mut cores) = ([const { Vec::new() }; 3], [const { Vec::new() }; 4]);
        let mut before = 1;
        for (i, variable) in order.into_iter().enumerate() {
            let rows = before * counts[variable - 1];
            let unfolding = MatRef::from_row_major_slice(&rest, rows, rest.len() / rows);
            let (vectors, values) = singular_vectors(unfolding, tail * scale);
            let projected = vectors.transpose() * unfolding;
            cores[i] = row_major(vectors.as_ref()).collect();
            rest = row_major(projected.as_ref()).collect();
            before = values.len();
            weights[i] = values.into_iter().map(|value| value / scale).collect();
        }
        cores[3] = rest;
        Self {
            order,
            weights,
            cores,
        }
    }

    /// Returns the train without the last indices of each bond, which leave out at most
    /// `left_out` steps (root mean square), and with numbers rounded to multiples of `step`.
    fn truncated(&self, part: &Part, left_out: f64, step: f64) -> IntegerTrain {
        let held = part.count;
        let functions = |i: usize| {
            let variable = self.order.get(i).copied().unwrap_or(4);
            &part.coefficients.functions[variable - 1]
        };
        // Steps finer than the rounding of f64 at the largest number are of no use.
        let largest = self.weights[0][0].max(f64::MIN_POSITIVE);
        let step = step.max(16.0 * f64::EPSILON * largest);
        let (mut kept, mut most) = ([0; 3], 1_usize);
        for (bond, weights) in self.weights.iter().enumerate() {
            let squares: Vec<f64> = weights.iter().map(|weight| weight * weight).collect();
            most =
                rank(&squares, BONDS[bond] * left_out * step).min(most * functions(bond).ncols());
            kept[bond] = most;
        }
        let exponents: [Vec<i8>; 3] = std::array::from_fn(|bond| {
            let weights = &self.weights[bond][..kept[bond]];
            weights
                .iter()
                .map(|weight| weight.log2().round().clamp(-99.0, 99.0) as i8)
                .collect()
        });
        let mut terms = [0; 4];
        let mut cores = [const { Vec::new() }; 4];
        for i in 0..4 {
            let functions = functions(i);
            let before = if i == 0 { 1 } else { kept[i - 1] };
            let (after, of_after) = if i == 3 {
                (held, held)
            } else {
                (kept[i], self.weights[i].len())
            };
            let count = functions.ncols();
            // From functions along the axis to polynomials, for all pairs of indices of the bonds.
            let of_functions = Mat::from_fn(count, before * after, |function, pair| {
                let (index, after) = (pair / after, pair % after);
                let weight = exponents
                    .get(i)
                    .map_or(1.0, |all| f64::from(all[after]).exp2());
                weight * self.cores[i][(index * count + function) * of_after + after]
            });
            let numbers = functions * of_functions;
            let integer =
                |degree: usize, pair: usize| (numbers[(degree, pair)] / step).round() as i64;
            // Degrees of zeros alone are left out, and as many are left in as the bonds need.
            let is_zero =
                |&degree: &usize| (0..before * after).all(|pair| integer(degree, pair) == 0);
            let needed = if i == 3 { 1 } else { after.div_ceil(before) };
            let zeros = (needed..numbers.nrows()).rev().take_while(is_zero).count();
            terms[i] = numbers.nrows() - zeros;
            let terms = terms[i];
            cores[i] = (0..before)
                .flat_map(|b| {
                    (0..terms).flat_map(move |k| (0..after).map(move |a| (k, b * after + a)))
                })
                .map(|(degree, pair)| integer(degree, pair))
                .collect();
        }
        let smooth_degree = |variable: usize| part.axes[(variable + 3) % 4].smooth_degree;
        let train = IntegerTrain::new(
            held,
            self.order,
            [0, 1, 2, 3].map(smooth_degree),
            terms,
            exponents,
            step,
            cores,
        );
        train.expect("values within the bounds of a train make one")
    }
}
