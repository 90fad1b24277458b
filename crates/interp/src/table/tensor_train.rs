//! A tensor train prepared for lookup: from its cores to the coefficients of the splines of one
//! material over `ln(a/t)`.
//!
//! Ten B-splines of an axis contribute at any point. Between two knots, however, a table is
//! smoother than a general sum of ten B-splines, and a bond index with a small weight needs few
//! digits. Therefore each core is expanded, over each interval between knots, in functions that
//! oscillate more and more. The contribution of a bond index and a function to a block of indices
//! of the next bond is dropped where it is far below the table's tolerance, and stored in single
//! precision where that is accurate enough. This leaves fewer multiplications, and more of them are
//! done at a time. All but the first two functions vanish at the knots: dropping them makes no jump
//! there.
//!
//! A function with an argument `simd` is compiled for several instruction sets, and that of the
//! processor is chosen at run time. It must be inlined, with its closures: only then is it compiled
//! for these instructions.

use std::f64::consts::PI;

use fearless_simd::prelude::*;
use fearless_simd::{Level, dispatch};

use crate::curve::bspline::{Basis, TABLE_DEGREE};
use crate::table::low_rank::LowRank;
use crate::table::mixed_precision::{BLOCK, MixedPrecision};
use crate::table::weighted_sum::add_rows;

/// The largest norm of a block that is dropped, relative to the table's tolerance.
///
/// Norms are root mean squares of contributions to the logarithms.
const NEGLIGIBLE: f64 = 1e-5;
/// The largest rounding to single precision, and the largest jump at a knot. Smaller than
/// [`NEGLIGIBLE`], because it acts as noise: a difference quotient of two lookups divides it by its
/// step.
const ROUNDING: f64 = 3e-7;

/// The largest number of functions on an interval.
const MOST_FUNCTIONS: usize = TABLE_DEGREE + 1;

/// The cores of a [`LowRank`] form, prepared for lookup.
#[derive(Clone, Debug)]
pub(crate) struct TensorTrain {
    /// The cores of `e0_over_e2`, `e1_over_e2` and `nu1`.
    cores: [Core; 3],
    /// The core of `a_over_t`: a row of coefficients over `ln(a/t)` for each index of the last
    /// bond, a group of the quantities for each B-spline.
    last: MixedPrecision,
}

/// A core of a material parameter.
#[derive(Clone, Debug)]
struct Core {
    /// The intervals between the knots of the axis.
    intervals: Vec<Interval>,
    /// The knots between the intervals.
    breaks: Vec<f64>,
    /// One over the weights of the next bond.
    scales: Vec<f64>,
}

/// A core over an interval: a row over the next bond for each function of the interval and each
/// index of the bond before.
#[derive(Clone, Debug)]
struct Interval {
    functions: Functions,
    rows: MixedPrecision,
}

/// The functions whose sum is a spline between two knots.
///
/// They are the Chebyshev polynomials `T0`, `T1`, `T2 - T0`, `T3 - T1`, `T4 - T0` and so on.
#[derive(Clone, Copy, Debug)]
struct Functions {
    /// The two knots.
    ends: [f64; 2],
    /// The number of functions.
    count: usize,
}

impl TensorTrain {
    /// Prepares `form`, accurate enough for `tolerance`, with the B-splines of `e1_over_e2`, `nu1`,
    /// `e0_over_e2`, and of `a_over_t`.
    pub(crate) fn new(
        form: &LowRank,
        [e1, nu, e0]: [&Basis; 3],
        a_over_t_basis: &Basis,
        tolerance: f64,
    ) -> Self {
        let ([a, b, c], [substrate, film_modulus, film, mut last]) = form.normalised();
        let core = |mut core: Vec<f64>, before: usize, basis: &Basis, after: &[f64]| {
            let width = after.len();
            core.chunks_exact_mut(basis.len() * width)
                .for_each(|slab| basis.interpolate(slab, width));
            let intervals = basis.intervals().enumerate().map(|(first, ends)| {
                let functions = Functions::new(basis, ends);
                let coefficients = |i: usize, spline: usize| {
                    &core[(i * basis.len() + first + spline) * width..][..width]
                };
                Interval::new(
                    functions,
                    &functions.transform(basis),
                    before,
                    coefficients,
                    tolerance,
                )
            });
            let intervals: Vec<Interval> = intervals.collect();
            let breaks = intervals[1..]
                .iter()
                .map(|interval| interval.functions.ends[0])
                .collect();
            Core {
                intervals,
                breaks,
                scales: after.iter().map(|weight| 1.0 / weight).collect(),
            }
        };
        let cores = [
            core(substrate, 1, e0, &a),
            core(film_modulus, a.len(), e1, &b),
            core(film, b.len(), nu, &c),
        ];
        let width = last.len() / c.len();
        last.chunks_exact_mut(width)
            .for_each(|row| a_over_t_basis.interpolate(row, width / a_over_t_basis.len()));
        // A column of the last core is a logarithm: the error of a dropped block is spread over its
        // columns, not summed.
        let limit = |share: f64| (BLOCK as f64).sqrt() * share * tolerance;
        Self {
            cores,
            last: MixedPrecision::new(&last, width, |_| limit(NEGLIGIBLE), limit(ROUNDING)),
        }
    }

    /// Returns the coefficients over `ln(a/t)` of the material with these coordinates of
    /// `e1_over_e2`, `nu1` and `e0_over_e2`.
    pub(crate) fn coefficients(&self, coordinates: [f64; 3]) -> Vec<f64> {
        dispatch!(Level::new(), simd => self.value(simd, coordinates))
    }

    /// Returns these coefficients, followed by their derivatives with respect to the three
    /// coordinates.
    pub(crate) fn coefficients_and_slopes(&self, coordinates: [f64; 3]) -> [Vec<f64>; 4] {
        dispatch!(Level::new(), simd => self.value_and_slopes(simd, coordinates))
    }

    #[inline(always)]
    fn value<S: Simd>(&self, simd: S, [e1, nu, e0]: [f64; 3]) -> Vec<f64> {
        let mut vector = vec![1.0];
        for (core, u) in self.cores.iter().zip([e0, e1, nu]) {
            let interval = core.interval(u);
            vector = core.multiply(simd, interval, &vector, &interval.functions.evaluate(u).0);
        }
        self.last.sum(simd, &vector)
    }

    #[inline(always)]
    fn value_and_slopes<S: Simd>(&self, simd: S, coordinates: [f64; 3]) -> [Vec<f64>; 4] {
        // The product of the cores so far, and its derivatives with respect to their coordinates.
        let mut vectors = vec![vec![1.0]];
        for (core, axis) in self.cores.iter().zip([2, 0, 1]) {
            let interval = core.interval(coordinates[axis]);
            let (values, slopes) = interval.functions.evaluate(coordinates[axis]);
            let slope = core.multiply(simd, interval, &vectors[0], &slopes);
            for vector in &mut vectors {
                *vector = core.multiply(simd, interval, vector, &values);
            }
            vectors.push(slope);
        }
        let [value, by_e0, by_e1, by_nu] = &vectors[..] else {
            unreachable!("the values, and the derivatives of three axes")
        };
        [
            self.last.sum(simd, value),
            self.last.sum(simd, by_e1),
            self.last.sum(simd, by_nu),
            self.last.sum(simd, by_e0),
        ]
    }
}

impl Core {
    /// Returns the interval that contains the coordinate `u`.
    fn interval(&self, u: f64) -> &Interval {
        &self.intervals[self.breaks.partition_point(|&end| end <= u)]
    }

    /// Multiplies the vector over the bond before by the core; returns the vector over the next
    /// bond.
    #[inline(always)]
    fn multiply<S: Simd>(
        &self,
        simd: S,
        interval: &Interval,
        before: &[f64],
        functions: &[f64; MOST_FUNCTIONS],
    ) -> Vec<f64> {
        let mut weights = vec![0.0; before.len() * interval.functions.count];
        for (weights, function) in weights.chunks_exact_mut(before.len()).zip(functions) {
            weights
                .iter_mut()
                .zip(before)
                .for_each(|(weight, entry)| *weight = function * entry);
        }
        let mut after = interval.rows.sum(simd, &weights);
        after
            .iter_mut()
            .zip(&self.scales)
            .for_each(|(entry, scale)| *entry *= scale);
        after
    }
}

impl Interval {
    /// Expands the core in the functions of an interval.
    ///
    /// `coefficients(i, spline)` is the row over the next bond of index `i`, below `before`, of the
    /// bond before. `transform` holds a row for each function.
    fn new<'a>(
        functions: Functions,
        transform: &[Vec<f64>],
        before: usize,
        coefficients: impl Fn(usize, usize) -> &'a [f64],
        tolerance: f64,
    ) -> Self {
        let length = coefficients(0, 0).len();
        let mut rows = vec![0.0; functions.count * before * length];
        for (rows, transform) in rows.chunks_exact_mut(before * length).zip(transform) {
            for (i, row) in rows.chunks_exact_mut(length).enumerate() {
                for (spline, weight) in transform.iter().enumerate() {
                    add_rows(row, &[*weight], coefficients(i, spline), length);
                }
            }
        }
        let jumps = Functions::AT_KNOTS * before;
        let negligible = |row| tolerance * if row < jumps { ROUNDING } else { NEGLIGIBLE };
        Self {
            functions,
            rows: MixedPrecision::new(&rows, length, negligible, ROUNDING * tolerance),
        }
    }
}

impl Functions {
    /// The number of functions that do not vanish at both ends; they are the first.
    const AT_KNOTS: usize = 2;

    /// Chooses the functions between two neighbouring knots.
    fn new(basis: &Basis, ends: [f64; 2]) -> Self {
        Self {
            ends,
            count: basis.degree() + 1,
        }
    }

    /// Evaluates the functions and their slopes at `u`.
    fn evaluate(&self, u: f64) -> ([f64; MOST_FUNCTIONS], [f64; MOST_FUNCTIONS]) {
        if self.count == 1 {
            // An axis of one node has no length: its only function is 1.
            let mut values = [0.0; MOST_FUNCTIONS];
            values[0] = 1.0;
            return (values, [0.0; MOST_FUNCTIONS]);
        }
        let [from, to] = self.ends;
        let length = to - from;
        let (values, slopes) = chebyshev((u - from - (to - u)) / length);
        (values, slopes.map(|slope| 2.0 / length * slope))
    }

    /// Returns the matrix from the coefficients of the B-splines that do not vanish on the interval
    /// to those of the functions: a row for each function.
    fn transform(&self, basis: &Basis) -> Vec<Vec<f64>> {
        let [from, to] = self.ends;
        let count = self.count;
        let angle = |point: usize| PI * (point as f64 + 0.5) / count as f64;
        let mut transform = vec![vec![0.0; count]; count];
        for point in 0..count {
            let s = 0.5 - 0.5 * angle(point).cos();
            let splines = basis.weights(to - (to - from) * s);
            for (function, row) in transform.iter_mut().enumerate() {
                let share = if function == 0 { 1.0 } else { 2.0 } / count as f64
                    * (function as f64 * angle(point)).cos();
                row.iter_mut()
                    .zip(splines.values)
                    .for_each(|(entry, value)| *entry += share * value);
            }
        }
        // From the Chebyshev polynomials to their differences from the first two.
        for function in 2..count {
            let (firsts, row) = transform.split_at_mut(function);
            firsts[function % 2]
                .iter_mut()
                .zip(&row[0])
                .for_each(|(first, entry)| *first += entry);
        }
        transform
    }
}

/// Evaluates `T0`, `T1`, `T2 - T0`, `T3 - T1`, `T4 - T0` and so on, and their derivatives, at `t`.
fn chebyshev(t: f64) -> ([f64; MOST_FUNCTIONS], [f64; MOST_FUNCTIONS]) {
    let (mut values, mut slopes) = ([1.0; MOST_FUNCTIONS], [0.0; MOST_FUNCTIONS]);
    (values[1], slopes[1]) = (t, 1.0);
    for k in 2..MOST_FUNCTIONS {
        values[k] = 2.0 * t * values[k - 1] - values[k - 2];
        slopes[k] = 2.0 * (values[k - 1] + t * slopes[k - 1]) - slopes[k - 2];
    }
    for k in 2..MOST_FUNCTIONS {
        values[k] -= values[k % 2];
        slopes[k] -= slopes[k % 2];
    }
    (values, slopes)
}
