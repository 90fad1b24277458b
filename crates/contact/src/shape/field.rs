//! The field of the flat punch at all contact radii, from `Gamma` alone.
//!
//! Let `g1(s; a)` be the transform of the stress under a flat punch of radius `a`, as in the page
//! `interp/src/curve/derived.rs` of the source, where `dg1/da = Gamma h` with one function `h(s; a)`. With the
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
//! `Q(p, q) = P(q, p)`, half of the blocks suffice. The blocks of larger `p` are solved when they are
//! needed.
//!
//! The derivatives of `P` and `Q` with respect to a parameter follow from the same equations with
//! the sources `dW Q/2` and `dW P/2`.

use std::f64::consts::SQRT_2;
use std::sync::{Arc, OnceLock};

use fearless_simd::prelude::*;
use fearless_simd::{Level, dispatch, f64x4};

use super::medium::{Change, Medium};
use super::polynomial::{CHEBYSHEV, POINTS, basis_on, points_on};
use crate::Error;
use crate::made::made;

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
pub(super) const LANES: usize = POINTS / 4;

/// A function at the points of a block: `[p][q]`.
type Square = [[f64; POINTS]; POINTS];

/// The field up to a largest contact radius, or its derivative with respect to a parameter. Lengths
/// are in units of the film's thickness.
#[derive(Clone, Debug)]
pub(super) struct Field {
    pub medium: Arc<Medium>,
    /// Whether `Gamma` falls, so that the second form is used.
    pub falls: bool,
    /// The ends of the blocks: 0, the first one, and so on by a constant factor.
    ends: Arc<[f64]>,
    /// The blocks between two ends of `p`.
    rows: Vec<OnceLock<Row>>,
    /// The largest contact radius.
    pub last: f64,
    /// The field whose derivative this is, and the parameter.
    of: Option<(Arc<Field>, Change)>,
}

/// The blocks `[q]` with `q <= p` between two ends of `p`.
#[derive(Clone, Debug)]
struct Row {
    /// `P` and `Q`.
    blocks: Vec<[Square; 2]>,
    /// The factor of the two equations; none for a derivative, whose factor it is, too.
    rates: Vec<Square>,
    /// `Q` at the upper end of `p`.
    of_q: Vec<[f64; POINTS]>,
}

impl Field {
    /// Prepares contact radii up to `most`, or to the last node over `sqrt(2)` if that is less: the
    /// blocks reach beyond the largest contact.
    pub(super) fn new(medium: Medium, most: f64) -> Result<Self, Error> {
        let last = most.min(medium.last() / SQRT_2);
        let falls = medium.at(last)?.gamma < 1.0;
        let ratios = if medium.tolerance >= LARGE_TOLERANCE {
            COARSE
        } else {
            FINE
        };
        let first = medium.thick().min(last);
        let count = ((last / first).ln() / ratios[usize::from(falls)].ln()).ceil();
        let ratio = (last / first).powf(1.0 / count.max(1.0));
        let mut ends = vec![0.0];
        ends.extend((0..count as usize).map(|i| first * ratio.powi(i as i32)));
        // The largest contact is the end of a block, and twice as large `p` that of the last one.
        ends.push(last);
        ends.push(2.0 * last);
        Ok(Self {
            medium: Arc::new(medium),
            falls,
            rows: vec![OnceLock::new(); ends.len() - 1],
            ends: ends.into(),
            last,
            of: None,
        })
    }

    /// Prepares the derivative of a field with respect to a parameter.
    pub(super) fn derivative(of: &Arc<Self>, change: Change) -> Self {
        Self {
            medium: of.medium.clone(),
            ends: of.ends.clone(),
            rows: vec![OnceLock::new(); of.rows.len()],
            of: Some((of.clone(), change)),
            ..**of
        }
    }

    /// Solves for contacts up to the radius `a`.
    pub(super) fn solve_to(&self, a: f64) -> Result<(), Error> {
        if let Some((of, _)) = &self.of {
            of.solve_to(a)?;
        }
        for i in 0..=self.block(2.0 * a) {
            made(&self.rows[i], || self.solve(i))?;
        }
        Ok(())
    }

    /// Solves between two ends of `p`.
    fn solve(&self, i: usize) -> Result<Row, Error> {
        let Self { medium, ends, .. } = self;
        let end = medium.last();
        let interval = |i: usize| [ends[i], ends[i + 1]];
        let at_p = points_on(interval(i));
        // `P` at the lower end of `q`.
        let mut of_p = [0.0; POINTS];
        for (edge, p) in of_p.iter_mut().zip(at_p) {
            let x = (0.5 * p).min(end);
            let [gamma, growth] = medium.gamma_and_growth(x)?;
            let own = if self.falls { gamma } else { growth };
            *edge = 0.5
                * match self.of {
                    None => own,
                    Some((_, change)) => {
                        let changed = medium.changed(change, x)?;
                        if self.falls {
                            gamma * changed.ln_gamma
                        } else {
                            changed.growth
                        }
                    }
                };
        }
        let before = i.checked_sub(1).and_then(|before| self.rows[before].get());
        let mut of_q = before.map_or(Vec::new(), |row| row.of_q.clone());
        let factor = if self.falls { -0.5 } else { 0.5 };
        let count = (0..=i).take_while(|&j| ends[i] + ends[j] < 2.0 * self.last);
        let mut blocks = Vec::with_capacity(i + 1);
        let mut rates = Vec::with_capacity(i + 1);
        for j in count {
            let at_q = points_on(interval(j));
            let mut block = Block {
                rate: [[0.0; POINTS]; POINTS],
                sources: [[[0.0; POINTS]; POINTS]; 2],
                halves: [i, j].map(|block: usize| 0.5 * (ends[block + 1] - ends[block])),
                enough: ENOUGH * medium.tolerance,
            };
            for (k, p) in at_p.iter().enumerate() {
                for (l, q) in at_q.iter().enumerate() {
                    let x = (0.5 * (p + q)).min(end);
                    if let Some((of, change)) = &self.of {
                        let (of, by) = (of.row(i), factor * medium.changed(*change, x)?.growth);
                        let [p, q] = &of.blocks[j];
                        block.rate[k][l] = of.rates[j][k][l];
                        block.sources[0][k][l] = by * q[k][l];
                        block.sources[1][k][l] = by * p[k][l];
                    } else {
                        let [_, growth] = medium.gamma_and_growth(x)?;
                        block.rate[k][l] = factor * growth;
                    }
                }
            }
            if j == of_q.len() {
                of_q.push(of_p);
            }
            let values =
                dispatch!(Level::new(), simd => block.solve(simd, &mut of_p, &mut of_q[j]));
            blocks.push(values);
            if self.of.is_none() {
                rates.push(block.rate);
            }
        }
        Ok(Row {
            blocks,
            rates,
            of_q,
        })
    }

    /// Returns the blocks between two ends of `p`, which must have been solved.
    fn row(&self, i: usize) -> &Row {
        self.rows[i].get().expect("solved before it is asked for")
    }

    /// Returns the ends of the blocks.
    pub(super) fn ends(&self) -> &[f64] {
        &self.ends
    }

    /// Returns the number of the block of a coordinate.
    pub(super) fn block(&self, coordinate: f64) -> usize {
        let beyond = self.ends.partition_point(|&end| end <= coordinate);
        beyond.clamp(1, self.ends.len() - 1) - 1
    }

    /// Returns `P + Q` and `Q - P` at `0 <= s <= a`, to which it must have been solved.
    #[inline(always)]
    pub(super) fn at<S: Simd>(&self, simd: S, a: f64, s: f64) -> [f64; 2] {
        let (p, q) = (a + s, a - s);
        let i = self.block(p);
        let blocks = &self.row(i).blocks;
        // Rounding may move a point into a block beyond the largest contact.
        let j = self.block(q).min(blocks.len() - 1);
        let basis = |block: usize, coordinate: f64| {
            basis_on([self.ends[block], self.ends[block + 1]], coordinate)
        };
        let (of_p, of_q) = (basis(i, p), load(simd, &basis(j, q)));
        // Loops, because closures are not always compiled for the vectors of `simd`.
        let mut both = [0.0; 2];
        for (value, values) in both.iter_mut().zip(&blocks[j]) {
            let mut sums = [f64x4::splat(simd, 0.0); LANES];
            for k in 0..POINTS {
                let (row, weight) = (load(simd, &values[k]), f64x4::splat(simd, of_p[k]));
                for lane in 0..LANES {
                    sums[lane] = weight.mul_add(row[lane], sums[lane]);
                }
            }
            *value = dot(sums, of_q);
        }
        let [p, q] = both;
        [p + q, q - p]
    }
}

/// Returns the sum of the products of two rows.
#[inline(always)]
pub(super) fn dot<S: Simd>(a: [f64x4<S>; LANES], b: [f64x4<S>; LANES]) -> f64 {
    let mut total = a[0] * b[0];
    for lane in 1..LANES {
        total = a[lane].mul_add(b[lane], total);
    }
    (total[0] + total[1]) + (total[2] + total[3])
}

/// Returns a row of a block as vectors.
#[inline(always)]
pub(super) fn load<S: Simd>(simd: S, row: &[f64; POINTS]) -> [f64x4<S>; LANES] {
    let mut lanes = [f64x4::splat(simd, 0.0); LANES];
    for (lane, values) in lanes.iter_mut().zip(row.chunks_exact(4)) {
        *lane = f64x4::from_slice(simd, values);
    }
    lanes
}

/// A block: the factor of the two equations at its points and their sources, half of its sides in `p`
/// and `q`, and the relative change at which the iterations end.
struct Block {
    rate: Square,
    sources: [Square; 2],
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
        let load = |row: &[f64; POINTS]| load(simd, row);
        let number = |value: f64| f64x4::splat(simd, value);
        let [in_p, in_q] = self.halves.map(number);
        let rate = self.rate.each_ref().map(load);
        let [source_p, source_q] = self.sources.each_ref().map(|of| of.each_ref().map(load));
        let columns = points.columns.each_ref().map(load);
        let last = load(of_q);
        let mut p = of_p.map(|value| [number(value); LANES]);
        let mut q = [last; POINTS];
        let mut size: f64 = 0.0;
        for value in of_p.iter().chain(&*of_q) {
            size = size.max(value.abs());
        }
        for (sources, half) in self.sources.iter().zip([self.halves[1], self.halves[0]]) {
            for source in sources.as_flattened() {
                size = size.max(half * source.abs());
            }
        }
        // The right-hand side `a b + c`, times half of a side.
        let side = |a: [f64x4<S>; LANES], b: [f64x4<S>; LANES], c: [f64x4<S>; LANES], half| {
            std::array::from_fn(|lane| a[lane].mul_add(b[lane], c[lane]) * half)
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
                let terms: [f64x4<S>; LANES] = side(rate[i], q[i], source_p[i], in_q);
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
            for i in 0..POINTS {
                terms[i] = side(p[i], rate[i], source_q[i], in_p);
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
                let by_q = self.rate[i][j] * q[i][j] + self.sources[0][i][j];
                let by_p = self.rate[j][i] * p[j][i] + self.sources[1][j][i];
                of_p[i] += self.halves[1] * whole * by_q;
                of_q[i] += self.halves[0] * whole * by_p;
            }
        }
        [p, q]
    }
}
