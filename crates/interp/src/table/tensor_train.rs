//! A tensor train prepared for lookup: from its splines at a material to those over `ln(a/t)`.
//!
//! Ten splines of an axis do not vanish at a point, but between two knots a table is smoother than
//! they could be, and the less an index of the train weighs, the fewer of its digits matter.
//! Therefore each core is expanded, over each interval between knots, in functions that oscillate
//! more and more. What an index and a function add to a block of indices after them is kept where
//! it is not far below the table's tolerance, and in single precision where that is enough: fewer
//! multiplications, and more of them at a time. All but the first two functions, or three next to a
//! flat end, vanish at the knots, so that leaving them out makes no jump there.
//!
//! What begins with `simd` is compiled several times, and chosen at run time for the instructions
//! that the processor has. All of it must be inlined, closures too, as only then it is compiled for
//! them.

use std::f64::consts::PI;

use fearless_simd::prelude::*;
use fearless_simd::{Level, dispatch};

use crate::curve::bspline::{Basis, TABLE_DEGREE};
use crate::table::low_rank::LowRank;
use crate::table::mixed_precision::{BLOCK, MixedPrecision};
use crate::table::weighted_sum::add_rows;

/// What may be left out of a block, and how much a rounding to single precision may be, in parts of
/// the table's tolerance: root mean squares of what is added to the logarithms. Next to a flat end
/// the derivative with respect to the parameter itself divides what is left out by the cube of the
/// interval. A rounding, or a jump at a knot, is that small because it is a noise, which a
/// difference quotient of two lookups divides by its step.
const NEGLIGIBLE: f64 = 1e-5;
const NEGLIGIBLE_AT_FLAT_END: f64 = 3e-6;
const ROUNDING: f64 = 3e-7;

/// The most functions on an interval.
const MOST: usize = TABLE_DEGREE + 1;

/// The cores of a [`LowRank`] form.
#[derive(Clone, Debug)]
pub(crate) struct TensorTrain {
    /// Of `e0_over_e2`, `e1_over_e2` and `nu1`.
    cores: [Core; 3],
    /// A row for each value of the last index: coefficients over `ln(a/t)`, all quantities of one
    /// after those of the other.
    last: MixedPrecision,
}

#[derive(Clone, Debug)]
struct Core {
    /// For each interval of the axis.
    intervals: Vec<Interval>,
    /// The ends between them.
    breaks: Vec<f64>,
    /// One over the weights of the index after it.
    scales: Vec<f64>,
}

/// A core over an interval: for each function of the interval, and each index before the core, a
/// row over the index after it.
#[derive(Clone, Debug)]
struct Interval {
    functions: Functions,
    rows: MixedPrecision,
}

/// What a spline is a sum of between two knots: the Chebyshev polynomials `T0`, `T1`, `T2 - T0`,
/// `T3 - T1`, `T4 - T0` and so on; next to a flat end, 1 and `s^3` times each of these, where `s`
/// is the distance from the end.
#[derive(Clone, Copy, Debug)]
struct Functions {
    ends: [f64; 2],
    count: usize,
    flat: bool,
}

impl TensorTrain {
    /// With the bases of `e1_over_e2`, `nu1`, `e0_over_e2`, and of `a_over_t`, to be as accurate as
    /// `tolerance` needs.
    pub(crate) fn new(
        form: &LowRank,
        [e1, nu, e0]: [&Basis; 3],
        along: &Basis,
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
            .for_each(|row| along.interpolate(row, width / along.len()));
        // A column of these is a logarithm: what is left out of a block is spread over its columns,
        // and not added up.
        let limit = |share: f64| (BLOCK as f64).sqrt() * share * tolerance;
        Self {
            cores,
            last: MixedPrecision::new(&last, width, |_| limit(NEGLIGIBLE), limit(ROUNDING)),
        }
    }

    /// The coefficients over `ln(a/t)` at the coordinates `e1_over_e2`, `nu1` and `e0_over_e2` of a
    /// material.
    pub(crate) fn at(&self, place: [f64; 3]) -> Vec<f64> {
        dispatch!(Level::new(), simd => self.value(simd, place))
    }

    /// The same, followed by the derivatives with respect to the three coordinates, each of them
    /// where it says.
    pub(crate) fn with_slopes(&self, place: [f64; 3], slopes_at: [f64; 3]) -> [Vec<f64>; 4] {
        dispatch!(Level::new(), simd => self.value_and_slopes(simd, place, slopes_at))
    }

    #[inline(always)]
    fn value<S: Simd>(&self, simd: S, [e1, nu, e0]: [f64; 3]) -> Vec<f64> {
        let mut vector = vec![1.0];
        for (core, u) in self.cores.iter().zip([e0, e1, nu]) {
            let interval = core.interval(u);
            vector = core.after(simd, interval, &vector, &interval.functions.at(u).0);
        }
        self.last.sum(simd, &vector)
    }

    #[inline(always)]
    fn value_and_slopes<S: Simd>(
        &self,
        simd: S,
        place: [f64; 3],
        slopes_at: [f64; 3],
    ) -> [Vec<f64>; 4] {
        // The vector, and its derivatives with respect to the coordinates so far.
        let mut vectors = vec![vec![1.0]];
        for (core, axis) in self.cores.iter().zip([2, 0, 1]) {
            let interval = core.interval(slopes_at[axis]);
            let by_this = core.after(
                simd,
                interval,
                &vectors[0],
                &interval.functions.at(slopes_at[axis]).1,
            );
            let interval = core.interval(place[axis]);
            let (values, _) = interval.functions.at(place[axis]);
            for vector in &mut vectors {
                *vector = core.after(simd, interval, vector, &values);
            }
            vectors.push(by_this);
        }
        let [value, by_e0, by_e1, by_nu] = &vectors[..] else {
            unreachable!("one for each axis and one more")
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
    /// The interval that a coordinate is on.
    fn interval(&self, u: f64) -> &Interval {
        &self.intervals[self.breaks.partition_point(|&end| end <= u)]
    }

    /// The vector after a core, from that before it.
    #[inline(always)]
    fn after<S: Simd>(
        &self,
        simd: S,
        interval: &Interval,
        before: &[f64],
        functions: &[f64; MOST],
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
    /// From the coefficients of an index before it, one of so many, and a spline; `transform` holds
    /// a row for each function.
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
        let jumps = functions.constant_and_line() * before;
        let inside = if functions.flat {
            NEGLIGIBLE_AT_FLAT_END
        } else {
            NEGLIGIBLE
        };
        let negligible = |row| tolerance * if row < jumps { ROUNDING } else { inside };
        Self {
            functions,
            rows: MixedPrecision::new(&rows, length, negligible, ROUNDING * tolerance),
        }
    }
}

impl Functions {
    /// Between two neighbouring knots.
    fn new(basis: &Basis, ends: [f64; 2]) -> Self {
        let flat = basis.is_flat_at(ends[1]);
        Self {
            ends,
            count: if flat {
                basis.degree() - 1
            } else {
                basis.degree() + 1
            },
            flat,
        }
    }

    /// How many come before those that vanish at both ends.
    fn constant_and_line(&self) -> usize {
        if self.flat { 3 } else { 2 }
    }

    /// The values and the slopes.
    fn at(&self, u: f64) -> ([f64; MOST], [f64; MOST]) {
        if self.count == 1 {
            // An axis of one node, which has no length: only 1 is left.
            let mut values = [0.0; MOST];
            values[0] = 1.0;
            return (values, [0.0; MOST]);
        }
        let [from, to] = self.ends;
        let length = to - from;
        if !self.flat {
            let (values, slopes) = chebyshev((u - from - (to - u)) / length);
            return (values, slopes.map(|slope| 2.0 / length * slope));
        }
        let s = (to - u) / length;
        let (polynomials, derivatives) = chebyshev(1.0 - 2.0 * s);
        let (mut values, mut slopes) = ([0.0; MOST], [0.0; MOST]);
        values[0] = 1.0;
        for (i, (polynomial, derivative)) in polynomials
            .iter()
            .zip(derivatives)
            .take(MOST - 1)
            .enumerate()
        {
            values[i + 1] = s * s * s * polynomial;
            slopes[i + 1] = (2.0 * s * derivative - 3.0 * polynomial) * s * s / length;
        }
        (values, slopes)
    }

    /// Their coefficients in terms of those of the splines that do not vanish here: a row for each
    /// function.
    fn transform(&self, basis: &Basis) -> Vec<Vec<f64>> {
        let [from, to] = self.ends;
        // The polynomials, and as many Chebyshev points.
        let skipped = usize::from(self.flat);
        let count = self.count - skipped;
        let angle = |point: usize| PI * (point as f64 + 0.5) / count as f64;
        let splines = basis.weights(from.midpoint(to)).count;
        let mut transform = vec![vec![0.0; splines]; self.count];
        for point in 0..count {
            let s = 0.5 - 0.5 * angle(point).cos();
            let splines = basis.weights(to - (to - from) * s);
            // At a flat end the last spline is 1, and all others fall like `s^3`. They add up to
            // one, so that its difference from 1 is that of the others from 0, without
            // cancellation.
            let last = splines.count - 1;
            let value = |spline: usize| match self.flat {
                false => splines.values[spline],
                true if spline < last => splines.values[spline] / s.powi(3),
                true => -splines.values[..last].iter().sum::<f64>() / s.powi(3),
            };
            for (function, row) in transform[skipped..][..count].iter_mut().enumerate() {
                let share = if function == 0 { 1.0 } else { 2.0 } / count as f64
                    * (function as f64 * angle(point)).cos();
                row.iter_mut()
                    .enumerate()
                    .for_each(|(spline, entry)| *entry += share * value(spline));
            }
            if self.flat {
                transform[0][last] = 1.0;
            }
        }
        // From the polynomials to their differences from the first two.
        let polynomials = &mut transform[skipped..];
        for function in 2..count {
            let (firsts, row) = polynomials.split_at_mut(function);
            firsts[function % 2]
                .iter_mut()
                .zip(&row[0])
                .for_each(|(first, entry)| *first += entry);
        }
        transform
    }
}

/// `T0`, `T1`, `T2 - T0`, `T3 - T1`, `T4 - T0` and so on, and their derivatives.
fn chebyshev(t: f64) -> ([f64; MOST], [f64; MOST]) {
    let (mut values, mut slopes) = ([1.0; MOST], [0.0; MOST]);
    (values[1], slopes[1]) = (t, 1.0);
    for k in 2..MOST {
        values[k] = 2.0 * t * values[k - 1] - values[k - 2];
        slopes[k] = 2.0 * (values[k - 1] + t * slopes[k - 1]) - slopes[k - 2];
    }
    for k in 2..MOST {
        values[k] -= values[k % 2];
        slopes[k] -= slopes[k % 2];
    }
    (values, slopes)
}
