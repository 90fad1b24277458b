//! A tensor train prepared for evaluation: from three of its variables to the coefficients of splines
//! of the functions along the fourth.
//!
//! A core is a sum of polynomials of up to a high degree. Therefore the axis is divided into
//! intervals, equal in the angle of the Chebyshev polynomials, and on each of them the core is
//! expanded in eight functions that oscillate more and more. The contribution of a bond index and a
//! function to a block of indices of the next bond is dropped where it is far below the
//! tolerance, and stored in single precision where that is accurate enough. This leaves fewer
//! multiplications, and more of them are done at a time. All but the first two functions vanish at
//! the ends of an interval: dropping them makes no jump there. An interval is expanded at the first
//! evaluation in it, because a program that evaluates once needs one interval of each core.
//!
//! A function with an argument `simd` is compiled for several instruction sets, and that of the
//! processor is chosen at run time. It must be inlined, with its closures: only then is it compiled
//! for these instructions.

use std::f64::consts::PI;
use std::mem;

use fearless_simd::prelude::*;
use fearless_simd::{Level, dispatch};

use crate::chebyshev::polynomials;
use crate::functions::{Functions, MOST_FUNCTIONS};
use crate::integer_train::IntegerTrain;
use crate::mixed_precision::{Contraction, MixedPrecision, RowWeights};
use crate::once::Once;
use crate::vectors::{BLOCK, Vectors, WeightedSum};
use crate::weighted_sum::add_rows;
use piecewise::bspline::Basis;

/// The largest norm of a block that is dropped, relative to the tolerance.
///
/// Norms are root mean squares of contributions to the functions.
const NEGLIGIBLE: f64 = 3e-5;
/// The largest rounding to single precision, and the largest jump between intervals. Smaller than
/// [`NEGLIGIBLE`], because it acts as noise: a difference quotient of two values divides it by its
/// step.
const ROUNDING: f64 = 3e-7;

/// Returns the number of intervals of a core of so many `terms`.
///
/// On an interval of the angle `h`, the function number `j` of the expansion of `T_k` is about `2
/// (k h/4)^j / j!`. With two intervals for three degrees, what eight functions leave out of the
/// highest degree is 2e-4 of it, and of lower ones far less. On longer intervals more functions would
/// be needed, and an evaluation would take more time. Shorter intervals would take more memory.
pub(crate) const fn intervals(terms: usize) -> usize {
    if terms > MOST_FUNCTIONS {
        (2 * terms).div_ceil(3)
    } else {
        1
    }
}

/// The cores of an [`IntegerTrain`], prepared for evaluation.
#[derive(Clone, Debug)]
pub struct PreparedTrain {
    /// The cores of the variables 1, 2 and 3, in the order of the train.
    cores: [Core; 3],
    /// The core of the variable 0: a row of coefficients for each index of the last bond, a group of
    /// the functions for each B-spline.
    last: MixedPrecision,
}

/// The core of the variable 1, 2 or 3.
#[derive(Clone, Debug)]
struct Core {
    /// The number of its variable, less one.
    axis: usize,
    smooth_degree: f64,
    /// The normalised entries: row-major over the bond before, the polynomials, and the next bond.
    entries: Vec<f64>,
    /// The number of polynomials.
    terms: usize,
    /// The ends of the box.
    ends: [f64; 2],
    /// The ends of the intervals of the axis.
    parts: Vec<[f64; 2]>,
    /// The intervals, each expanded at its first use.
    intervals: Vec<Once<Interval>>,
    /// One over the weights of the next bond.
    scales: Vec<f64>,
    /// The tolerance of the functions.
    tolerance: f64,
}

/// A core over an interval: a row over the next bond for each function of the interval and each
/// index of the bond before.
#[derive(Clone, Debug)]
struct Interval {
    functions: Functions,
    rows: MixedPrecision,
    /// The rows of the functions add up to the core at one coordinate.
    contraction: Contraction,
}

impl PreparedTrain {
    /// Prepares `train` in a box with these `ends`, accurate enough for `tolerance`. `nodes` are the
    /// values of the variable 0 at which the functions are taken, and `basis` is that of the splines
    /// through them.
    pub fn new(
        train: &IntegerTrain,
        ends: [[f64; 2]; 4],
        nodes: &[f64],
        basis: &Basis,
        tolerance: f64,
    ) -> Self {
        let (weights, [first, second, third, of_last]) = train.normalised();
        let [.., [before, terms, functions]] = train.shapes();
        let mut entries = [first, second, third].into_iter();
        let cores = std::array::from_fn(|i| {
            let (variable, terms) = (train.order()[i], train.terms()[i]);
            let parts: Vec<_> = parts(ends[variable], intervals(terms)).collect();
            Core {
                axis: variable - 1,
                smooth_degree: train.smooth_degrees()[variable],
                entries: entries.next().expect("three cores"),
                terms,
                ends: ends[variable],
                intervals: vec![Once::new(); parts.len()],
                parts,
                scales: weights[i].iter().map(|weight| 1.0 / weight).collect(),
                tolerance,
            }
        });
        let width = nodes.len() * functions;
        let mut last = vec![0.0; before * width];
        for (node, &place) in nodes.iter().enumerate() {
            let polynomials = polynomials(train.smooth_degrees()[0], terms, ends[0], place);
            for (b, entries) in of_last.chunks_exact(terms * functions).enumerate() {
                let row = &mut last[b * width + node * functions..][..functions];
                add_rows(row, &polynomials, entries, functions);
            }
        }
        last.chunks_exact_mut(width)
            .for_each(|row| basis.interpolate(row, functions));
        // A column of the last core is a function at a node: the error of a dropped block is spread over its
        // columns, not summed.
        let limit = |share: f64| (BLOCK as f64).sqrt() * share * tolerance;
        Self {
            cores,
            last: MixedPrecision::new(&last, width, |_| limit(NEGLIGIBLE), limit(ROUNDING)),
        }
    }

    /// Returns the coefficients of the splines of the functions at these values of the variables 1, 2
    /// and 3.
    pub fn coefficients(&self, coordinates: [f64; 3]) -> Vec<f64> {
        dispatch!(Level::new(), simd => self.value(simd, coordinates))
    }

    /// Returns these coefficients, followed by their derivatives with respect to the three
    /// coordinates; those that are not `wanted` are empty.
    pub fn coefficients_and_slopes(
        &self,
        coordinates: [f64; 3],
        wanted: [bool; 3],
    ) -> [Vec<f64>; 4] {
        dispatch!(Level::new(), simd => self.value_and_slopes(simd, coordinates, wanted))
    }

    /// Replaces the columns of `coefficients` that `sums` name by weighted sums of the coefficients
    /// at coordinates that differ in one of the three, the number `axis`, which has the values `places`.
    pub fn sums_along(
        &self,
        coordinates: [f64; 3],
        axis: usize,
        places: &[f64],
        sums: &[WeightedSum<'_>],
        coefficients: &mut [f64],
    ) {
        dispatch!(Level::new(), simd => {
            self.values_along(simd, coordinates, axis, places, sums, coefficients);
        });
    }

    /// Returns a number of weights that suffices for every core.
    fn most_rows(&self) -> usize {
        MOST_FUNCTIONS * self.longest()
    }

    /// Returns the length of the longest bond, in whole blocks.
    fn longest(&self) -> usize {
        let bonds = self.cores.iter().map(|core| core.scales.len());
        bonds.max().unwrap_or(1).next_multiple_of(BLOCK)
    }

    #[inline(always)]
    fn value<S: Simd>(&self, simd: S, coordinates: [f64; 3]) -> Vec<f64> {
        // An allocation takes as long as many multiplications: all cores share these.
        let mut weights = RowWeights::with_capacity(self.most_rows());
        let [mut before, mut after] = [(); 2].map(|()| Vec::with_capacity(self.longest()));
        before.push(1.0);
        for core in &self.cores {
            core.multiply(
                simd,
                coordinates[core.axis],
                &before,
                &mut weights,
                &mut after,
            );
            mem::swap(&mut before, &mut after);
        }
        weights.set(&[1.0], &before);
        self.last.sum(simd, &weights)
    }

    #[inline(always)]
    fn value_and_slopes<S: Simd>(
        &self,
        simd: S,
        coordinates: [f64; 3],
        wanted: [bool; 3],
    ) -> [Vec<f64>; 4] {
        // The product of the cores so far, and its derivatives with respect to their coordinates.
        let mut vectors = Vectors::one();
        let mut weights = [(); 4].map(|()| RowWeights::with_capacity(self.most_rows()));
        for core in &self.cores {
            let with_slope = wanted[core.axis];
            vectors = core.products(
                simd,
                coordinates[core.axis],
                with_slope,
                &vectors,
                &mut weights,
            );
        }
        let sums = self.last.sum_all(simd, &vectors, &mut weights);
        let mut all = [sums.get(0).to_vec(), Vec::new(), Vec::new(), Vec::new()];
        let differentiated = self.cores.iter().filter(|core| wanted[core.axis]);
        for (core, i) in differentiated.zip(1..) {
            all[1 + core.axis] = sums.get(i).to_vec();
        }
        all
    }

    #[inline(always)]
    fn values_along<S: Simd>(
        &self,
        simd: S,
        coordinates: [f64; 3],
        axis: usize,
        places: &[f64],
        sums: &[WeightedSum<'_>],
        coefficients: &mut [f64],
    ) {
        // One vector until the core of this axis, one for each place from there on. The sums come last,
        // because a derivative that is a difference has more sums than places.
        let mut vectors = Vectors::one();
        for core in &self.cores {
            vectors = if core.axis == axis {
                core.multiply_along(simd, places, vectors.get(0))
            } else {
                core.multiply_all(simd, coordinates[core.axis], &vectors)
            };
        }
        let vectors = vectors.sums(sums);
        let mut weights = RowWeights::EMPTY;
        for (i, sum) in sums.iter().enumerate() {
            weights.set(&[1.0], vectors.get(i));
            let columns = sum.columns.clone();
            let target = &mut coefficients[columns.clone()];
            self.last.sum_of_columns(simd, &weights, columns, target);
        }
    }
}

impl Core {
    /// Returns the interval that contains the coordinate `u`.
    fn interval(&self, u: f64) -> &Interval {
        let number = self.parts[1..].partition_point(|&[from, _]| from <= u);
        self.intervals[number].get_or_init(|| self.expand(self.parts[number]))
    }

    /// Expands the core in the functions of the interval with these ends.
    #[cold]
    #[inline(never)]
    fn expand(&self, part: [f64; 2]) -> Interval {
        let functions = Functions {
            ends: part,
            count: self.terms.min(MOST_FUNCTIONS),
        };
        let (smooth_degree, terms, after) = (self.smooth_degree, self.terms, self.scales.len());
        let transform = functions.transform(|u| polynomials(smooth_degree, terms, self.ends, u));
        let before = self.entries.len() / (terms * after);
        let mut rows = vec![0.0; functions.count * before * after];
        for (rows, transform) in rows.chunks_exact_mut(before * after).zip(&transform) {
            let cores = self.entries.chunks_exact(terms * after);
            for (row, core) in rows.chunks_exact_mut(after).zip(cores) {
                add_rows(row, transform, core, after);
            }
        }
        let jumps = Functions::AT_ENDS * before;
        let negligible = |row| self.tolerance * if row < jumps { ROUNDING } else { NEGLIGIBLE };
        let rows = MixedPrecision::new(&rows, after, negligible, ROUNDING * self.tolerance);
        let contraction = rows.contraction(before);
        Interval {
            functions,
            rows,
            contraction,
        }
    }

    /// Writes the product of the vector over the bond before and the core at `u` to `after`. What
    /// `weights` and `after` held is lost.
    #[inline(always)]
    fn multiply<S: Simd>(
        &self,
        simd: S,
        u: f64,
        before: &[f64],
        weights: &mut RowWeights,
        after: &mut Vec<f64>,
    ) {
        let interval = self.interval(u);
        let (functions, _) = interval.functions.evaluate(u);
        weights.set(&functions[..interval.functions.count], before);
        interval.rows.sum_to(simd, weights, after);
        for (entry, scale) in after.iter_mut().zip(&self.scales) {
            *entry *= scale;
        }
    }

    /// Multiplies the vector over the bond before by the core at each of several places.
    #[inline(always)]
    fn multiply_along<S: Simd>(&self, simd: S, places: &[f64], before: &[f64]) -> Vectors {
        let mut after = Vectors::zeros(places.len(), self.scales.len());
        let mut weights = RowWeights::EMPTY;
        for (i, &u) in places.iter().enumerate() {
            let interval = self.interval(u);
            let (functions, _) = interval.functions.evaluate(u);
            weights.set(&functions[..interval.functions.count], before);
            let after = after.padded_mut(i);
            interval.rows.sum_blocks(simd, 0, &weights, after);
        }
        after.scale(&self.scales);
        after
    }

    /// Multiplies several vectors over the bond before by the core at `u`, which is computed once.
    #[inline(always)]
    fn multiply_all<S: Simd>(&self, simd: S, u: f64, before: &Vectors) -> Vectors {
        let interval = self.interval(u);
        let (functions, _) = interval.functions.evaluate(u);
        let functions = RowWeights::of(&functions[..interval.functions.count]);
        let core = interval
            .rows
            .contracted(simd, &interval.contraction, &functions);
        let mut weights = [const { RowWeights::EMPTY }; 4];
        let mut after = core.sum_all(simd, before, &mut weights);
        after.scale(&self.scales);
        after
    }

    /// Multiplies up to three vectors over the bond before by the core at `u`, and `with_slope` the
    /// first of them by its derivative, which comes last. What `weights` held is lost.
    #[inline(always)]
    fn products<S: Simd>(
        &self,
        simd: S,
        u: f64,
        with_slope: bool,
        before: &Vectors,
        weights: &mut [RowWeights; 4],
    ) -> Vectors {
        let interval = self.interval(u);
        let (values, slopes) = interval.functions.evaluate(u);
        let count = interval.functions.count;
        for (i, weights) in weights.iter_mut().enumerate().take(before.count()) {
            weights.set(&values[..count], before.get(i));
        }
        if with_slope {
            weights[before.count()].set(&slopes[..count], before.get(0));
        }
        let weights = &weights[..before.count() + usize::from(with_slope)];
        let mut after = Vectors::zeros(weights.len(), self.scales.len());
        interval.rows.few_sums(simd, weights, 0, &mut after);
        after.scale(&self.scales);
        after
    }
}

/// Returns the ends of `count` intervals between two coordinates, equal in the angle whose cosine
/// runs from one to the other.
fn parts([from, to]: [f64; 2], count: usize) -> impl Iterator<Item = [f64; 2]> {
    let place = move |i: usize| {
        let s = 0.5 - 0.5 * (PI * i as f64 / count as f64).cos();
        if i == count {
            to
        } else {
            from + (to - from) * s
        }
    };
    (0..count).map(move |i| [place(i), place(i + 1)])
}
