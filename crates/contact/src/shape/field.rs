//! The field of the flat punch at all contact radii, from `Gamma` alone.
//!
//! Let `g1(s; a)` be the transform of the stress under a flat punch of radius `a`, as in the page
//! `curve/derived.rs` of the source, where `dg1/da = Gamma h` with one function `h(s; a)`. With the
//! odd solution of the same equation, `A h_o = -[k(s - a) - k(s + a)]`, also `dg1/ds = -Gamma h_o`.
//! Differentiating both equations, with terms of the edges as there, gives
//!
//! ```text
//! dh/da + dh_o/ds = W h        dh_o/da + dh/ds = -W h_o        W = dln(Gamma)/da
//! ```
//!
//! because `h(a) - h_o(a) = W`. In the coordinates `p = a + s` and `q = a - s` of the
//! characteristics, with `P = dg1/dp/Gamma` and `Q = dg1/dq/Gamma`,
//!
//! ```text
//! dP/dq = W Q/2        dQ/dp = W P/2        P(p, 0) = W(p/2)/2        Q(0, q) = W(q/2)/2
//! ```
//!
//! where the last two are `g1(a; a) = Gamma(a)`. Where `Gamma` grows, on a film softer than its
//! substrate, everything here is positive and nothing cancels.
//!
//! Where `Gamma` falls, on a film stiffer than its substrate, `g1` inside is a small difference of
//! such terms. There a second form has positive terms only. Let `U(a, s)` be the penetration without
//! adhesion under the cone `b = |r - s|` whose tip is at the distance `s`. It follows
//! `(Gamma^2 dU/da)/da = Gamma^2 d2U/ds2` from `U = |s|` and `dU/da = 0` at `a = 0`; and
//! `dU/da = es g1(s; a)/Gamma^2`, because `b'' = 2 delta(r - s)` in `delta0' = (es/Gamma^2) int b''
//! g1/2`. Its variables `P = Gamma/es dU/dp` and `Q = Gamma/es dU/dq` obey
//!
//! ```text
//! dP/dq = -W Q/2       dQ/dp = -W P/2       P(p, 0) = Gamma(p/2)/2/es       Q(0, q) = Gamma(q/2)/2/es
//! ```
//!
//! with `P + Q = g1/Gamma`.
//!
//! Both are Goursat's problem. It is solved block by block, from the corner outwards, by polynomials
//! through 12 x 12 points. The blocks grow by a constant ratio in `p` and in `q`: in a block `a` is as
//! large as its sides or larger, so that `W` is as smooth there as the polynomials of the curve. As
//! `Q(p, q) = P(q, p)`, half of the blocks suffice.

use std::f64::consts::SQRT_2;

use fearless_simd::prelude::*;
use fearless_simd::{Level, dispatch, f64x4};

use super::medium::Medium;
use super::polynomial::{CHEBYSHEV, POINTS};
use interp::Error;

/// The most iterations in a block. Each gains a digit or more.
const MOST_ITERATIONS: usize = 40;
/// The largest change at which the iterations end, relative to the largest value in the block, over
/// the tolerance.
const ENOUGH: f64 = 1e-3;
/// The tolerance from which on the blocks are [`COARSE`].
const LARGE_TOLERANCE: f64 = 1e-7;
/// The ratio by which coarse blocks grow, where `Gamma` grows and where it falls.
const COARSE: [f64; 2] = [3.0, 2.0];
/// The ratio by which other blocks grow.
const FINE: [f64; 2] = [2.0, 1.6];

/// The number of vectors of four in a row of a block.
const LANES: usize = POINTS / 4;

/// A function at the points of a block: `[p][q]`.
type Square = [[f64; POINTS]; POINTS];

/// The field up to a largest contact radius. Lengths are in units of the film's thickness.
#[derive(Clone, Debug)]
pub(super) struct Field {
    pub medium: Medium,
    /// Whether `Gamma` falls, so that the second form is used.
    pub falls: bool,
    /// The ends of the blocks: 0, the first one, and so on by a constant factor.
    ends: Vec<f64>,
    /// `P - Q`, or `P + Q` of the second form, on the blocks `[p][q]` with `q <= p`.
    values: Vec<Vec<Square>>,
    /// The largest contact radius.
    pub last: f64,
}

impl Field {
    /// Solves for contact radii up to `most`, or to the last node over `sqrt(2)` if that is less:
    /// the blocks reach beyond the largest contact.
    pub(super) fn new(medium: Medium, most: f64) -> Result<Self, Error> {
        let last = most.min(medium.last() / SQRT_2);
        let falls = medium.at(last)?.gamma < 1.0;
        let ratios = if medium.tolerance >= LARGE_TOLERANCE {
            COARSE
        } else {
            FINE
        };
        let ratio = ratios[usize::from(falls)];
        let mut ends = vec![0.0, medium.thick().min(last)];
        while ends[ends.len() - 1] < 2.0 * last {
            ends.push(ratio * ends[ends.len() - 1]);
        }
        Self::on_blocks(medium, ends, last, falls)
    }

    /// Solves for a material that differs from that of this field a little, on the same blocks, so
    /// that the errors of both nearly cancel in a difference.
    pub(super) fn with_medium(&self, medium: Medium) -> Result<Self, Error> {
        Self::on_blocks(medium, self.ends.clone(), self.last, self.falls)
    }

    /// Solves on given blocks.
    fn on_blocks(medium: Medium, ends: Vec<f64>, last: f64, falls: bool) -> Result<Self, Error> {
        let count = ends.len() - 1;
        let points = &*CHEBYSHEV;
        let end = medium.last();
        let at: Vec<[f64; POINTS]> = ends
            .windows(2)
            .map(|pair| {
                points
                    .at
                    .map(|t| 0.5 * ((pair[0] + pair[1]) + (pair[1] - pair[0]) * t))
            })
            .collect();
        // The values at the lower ends of the next block: `P` at its first `q`, `Q` at its first `p`.
        let mut of_p = Vec::with_capacity(count);
        for at in &at {
            let mut edge = [0.0; POINTS];
            for (edge, p) in edge.iter_mut().zip(at) {
                let [gamma, growth] = medium.gamma_and_growth((0.5 * p).min(end))?;
                *edge = 0.5 * if falls { gamma } else { growth };
            }
            of_p.push(edge);
        }
        let mut of_q = of_p.clone();
        let factor = if falls { -0.5 } else { 0.5 };
        let enough = ENOUGH * medium.tolerance;
        let mut values = Vec::with_capacity(count);
        for i in 0..count {
            let mut row = Vec::with_capacity(i + 1);
            for j in 0..=i {
                if ends[i] + ends[j] >= 2.0 * last {
                    break;
                }
                let mut rate = [[0.0; POINTS]; POINTS];
                for (rate, p) in rate.iter_mut().zip(&at[i]) {
                    for (rate, q) in rate.iter_mut().zip(&at[j]) {
                        let [_, growth] = medium.gamma_and_growth((0.5 * (p + q)).min(end))?;
                        *rate = factor * growth;
                    }
                }
                if i == j {
                    of_q[j] = of_p[i];
                }
                let block = Block {
                    rate,
                    halves: [i, j].map(|block: usize| 0.5 * (ends[block + 1] - ends[block])),
                    enough,
                };
                let [mut p, q] =
                    dispatch!(Level::new(), simd => block.solve(simd, &mut of_p[i], &mut of_q[j]));
                for (p, q) in p.iter_mut().flatten().zip(q.iter().flatten()) {
                    *p = if falls { *p + q } else { *p - q };
                }
                row.push(p);
            }
            values.push(row);
        }
        Ok(Self {
            medium,
            falls,
            ends,
            values,
            last,
        })
    }

    /// Returns the first end of a block that is not 0.
    pub(super) fn first(&self) -> f64 {
        self.ends[1]
    }

    /// Returns the ends of the blocks.
    pub(super) fn ends(&self) -> &[f64] {
        &self.ends
    }

    /// Returns the number of the block of a coordinate.
    fn block(&self, coordinate: f64) -> usize {
        let beyond = self.ends.partition_point(|&end| end <= coordinate);
        beyond.clamp(1, self.ends.len() - 1) - 1
    }

    /// Returns `dg1/ds/Gamma` at `0 <= s <= a`, or `g1/Gamma` if `Gamma` [falls](Self::falls).
    pub(super) fn at(&self, a: f64, s: f64) -> f64 {
        let (p, q) = (a + s, a - s);
        // Rounding may move a point into a block beyond the largest contact.
        let i = self.block(p);
        let j = self.block(q).min(i).min(self.values[i].len() - 1);
        let place = |block: usize, coordinate: f64| {
            let (from, to) = (self.ends[block], self.ends[block + 1]);
            CHEBYSHEV.basis((2.0 * coordinate - from - to) / (to - from))
        };
        let (of_p, of_q) = (place(i, p), place(j, q));
        let mut sums = [0.0; POINTS];
        for (row, weight) in self.values[i][j].iter().zip(of_p) {
            for (sum, value) in sums.iter_mut().zip(row) {
                *sum += weight * value;
            }
        }
        sums.iter().zip(of_q).map(|(sum, own)| sum * own).sum()
    }
}

/// A block: the factors of the two equations at its points, half of its sides in `p` and `q`, and
/// the relative change at which the iterations end.
struct Block {
    rate: Square,
    halves: [f64; 2],
    enough: f64,
}

impl Block {
    /// Solves, and returns `P` and `Q`. `of_p` and `of_q` are the values at the lower ends, and are
    /// replaced by those at the upper ends.
    #[inline(always)]
    fn solve<S: Simd>(
        &self,
        simd: S,
        of_p: &mut [f64; POINTS],
        of_q: &mut [f64; POINTS],
    ) -> [Square; 2] {
        let points = &*CHEBYSHEV;
        let load = |row: &[f64; POINTS]| -> [f64x4<S>; LANES] {
            std::array::from_fn(|lane| f64x4::from_slice(simd, &row[4 * lane..4 * lane + 4]))
        };
        let number = |value: f64| f64x4::splat(simd, value);
        let [in_p, in_q] = self.halves.map(number);
        let rate = self.rate.each_ref().map(load);
        let columns = points.columns.each_ref().map(load);
        let last = load(of_q);
        let mut p = of_p.map(|value| [number(value); LANES]);
        let mut q = [last; POINTS];
        let mut size: f64 = 0.0;
        for value in of_p.iter().chain(&*of_q) {
            size = size.max(value.abs());
        }
        let product = |a: [f64x4<S>; LANES], b: [f64x4<S>; LANES], factor: f64x4<S>| {
            std::array::from_fn(|lane| a[lane] * b[lane] * factor)
        };
        // Adds a multiple of a row to a row.
        let add = |sum: &mut [f64x4<S>; LANES], factor: f64, row: &[f64x4<S>; LANES]| {
            for (sum, row) in sum.iter_mut().zip(row) {
                *sum = number(factor).mul_add(*row, *sum);
            }
        };
        for _ in 0..MOST_ITERATIONS {
            let mut change = number(0.0);
            for i in 0..POINTS {
                let terms = product(rate[i], q[i], in_q);
                let mut new = [number(of_p[i]); LANES];
                for (j, column) in columns.iter().enumerate() {
                    add(&mut new, terms[j / 4][j % 4], column);
                }
                for (new, old) in new.iter().zip(p[i]) {
                    change = change.max((*new - old).abs());
                }
                p[i] = new;
            }
            let mut terms = p;
            for (term, rate) in terms.iter_mut().zip(rate) {
                *term = product(*term, rate, in_p);
            }
            for (own, weights) in q.iter_mut().zip(&points.integrals) {
                let mut new = last;
                for (term, &weight) in terms.iter().zip(weights) {
                    add(&mut new, weight, term);
                }
                for (new, old) in new.iter().zip(*own) {
                    change = change.max((*new - old).abs());
                }
                *own = new;
            }
            let change = change
                .as_array()
                .iter()
                .fold(0.0, |most: f64, own| most.max(*own));
            if change <= self.enough * size {
                break;
            }
        }
        let store = |rows: [[f64x4<S>; LANES]; POINTS]| {
            rows.map(|row| -> [f64; POINTS] { std::array::from_fn(|i| row[i / 4][i % 4]) })
        };
        let [p, q] = [store(p), store(q)];
        for i in 0..POINTS {
            for (j, whole) in points.whole.iter().enumerate() {
                of_p[i] += self.halves[1] * whole * self.rate[i][j] * q[i][j];
                of_q[i] += self.halves[0] * whole * self.rate[j][i] * p[j][i];
            }
        }
        [p, q]
    }
}
