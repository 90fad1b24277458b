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
//! where the last two are `g1(a; a) = Gamma(a)`. This is Goursat's problem. It is solved block by
//! block, from the corner outwards, by polynomials through 8 x 8 points. The blocks grow by
//! `sqrt(2)` in `p` and in `q`: in a block `a` is as large as its sides or larger, so that `W` is as
//! smooth there as the polynomials of the curve. As `Q(p, q) = P(q, p)`, half of the blocks suffice.

use std::f64::consts::SQRT_2;

use super::medium::Medium;
use super::polynomial::{CHEBYSHEV, POINTS};
use crate::Error;

/// The most iterations in a block. Each gains a digit or more.
const MOST_ITERATIONS: usize = 40;
/// The change at which the iterations end, relative to the largest value in the block.
const ENOUGH: f64 = 1e-15;

/// A function at the points of a block: `[p][q]`.
type Square = [[f64; POINTS]; POINTS];

/// The field up to a largest contact radius. Lengths are in units of the film's thickness.
#[derive(Clone, Debug)]
pub(super) struct Field {
    pub medium: Medium,
    /// The ends of the blocks: 0, the first one, and so on by factors of `sqrt(2)`.
    ends: Vec<f64>,
    /// `P - Q = dg1/ds/Gamma` on the blocks `[p][q]` with `q <= p`.
    slopes: Vec<Vec<Square>>,
    /// The largest contact radius.
    pub last: f64,
}

impl Field {
    /// Solves for contact radii up to `most`, or to the last node over `sqrt(2)` if that is less:
    /// the blocks reach beyond the largest contact.
    pub(super) fn new(medium: Medium, most: f64) -> Result<Self, Error> {
        let last = most.min(medium.last() / SQRT_2);
        let mut ends = vec![0.0, medium.thick().min(last)];
        while ends[ends.len() - 1] < 2.0 * last {
            ends.push(SQRT_2 * ends[ends.len() - 1]);
        }
        Self::on_blocks(medium, ends, last)
    }

    /// Solves for a material that differs from that of this field a little, on the same blocks, so
    /// that the errors of both nearly cancel in a difference.
    pub(super) fn with_medium(&self, medium: Medium) -> Result<Self, Error> {
        Self::on_blocks(medium, self.ends.clone(), self.last)
    }

    /// Solves on given blocks.
    fn on_blocks(medium: Medium, ends: Vec<f64>, last: f64) -> Result<Self, Error> {
        let count = ends.len() - 1;
        let points = &*CHEBYSHEV;
        let at = |block: usize, i: usize| {
            let (from, to) = (ends[block], ends[block + 1]);
            0.5 * ((from + to) + (to - from) * points.at[i])
        };
        // The values at the lower ends of the next block: `P` at its first `q`, `Q` at its first `p`.
        let mut of_p = Vec::with_capacity(count);
        for block in 0..count {
            let mut edge = [0.0; POINTS];
            for (i, edge) in edge.iter_mut().enumerate() {
                let a = (0.5 * at(block, i)).min(medium.last());
                *edge = 0.5 * medium.at(a)?.growth;
            }
            of_p.push(edge);
        }
        let mut of_q = of_p.clone();
        let mut slopes = Vec::with_capacity(count);
        for i in 0..count {
            let mut row = Vec::with_capacity(i + 1);
            for j in 0..=i {
                if ends[i] + ends[j] >= 2.0 * last {
                    break;
                }
                let mut growth = [[0.0; POINTS]; POINTS];
                for (k, growth) in growth.iter_mut().enumerate() {
                    for (l, growth) in growth.iter_mut().enumerate() {
                        let a = 0.5 * (at(i, k) + at(j, l));
                        *growth = 0.5 * medium.at(a.min(medium.last()))?.growth;
                    }
                }
                if i == j {
                    of_q[j] = of_p[i];
                }
                let halves = [i, j].map(|block: usize| 0.5 * (ends[block + 1] - ends[block]));
                row.push(block(&growth, halves, &mut of_p[i], &mut of_q[j]));
            }
            slopes.push(row);
        }
        Ok(Self {
            medium,
            ends,
            slopes,
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

    /// Returns `dg1/ds/Gamma` at `0 <= s <= a`.
    pub(super) fn slope(&self, a: f64, s: f64) -> f64 {
        let (p, q) = (a + s, a - s);
        // Rounding may move a point into a block beyond the largest contact.
        let i = self.block(p);
        let j = self.block(q).min(i).min(self.slopes[i].len() - 1);
        let place = |block: usize, coordinate: f64| {
            let (from, to) = (self.ends[block], self.ends[block + 1]);
            CHEBYSHEV.basis((2.0 * coordinate - from - to) / (to - from))
        };
        let (of_p, of_q) = (place(i, p), place(j, q));
        let values = self.slopes[i][j].iter().zip(of_p);
        values
            .map(|(row, weight)| {
                let sum: f64 = row.iter().zip(of_q).map(|(value, own)| value * own).sum();
                weight * sum
            })
            .sum()
    }
}

/// Solves on one block; `growth` is `W/2`, `halves` are half of the sides. `of_p` and `of_q` are the
/// values at the lower ends, and are replaced by those at the upper ends. Returns `P - Q`.
fn block(
    growth: &Square,
    halves: [f64; 2],
    of_p: &mut [f64; POINTS],
    of_q: &mut [f64; POINTS],
) -> Square {
    let points = &*CHEBYSHEV;
    let mut p: Square = std::array::from_fn(|i| [of_p[i]; POINTS]);
    let mut q: Square = std::array::from_fn(|_| *of_q);
    let all = p.iter().chain(&q).flatten();
    let size = all.fold(0.0, |most: f64, value| most.max(value.abs()));
    for _ in 0..MOST_ITERATIONS {
        let mut change: f64 = 0.0;
        for i in 0..POINTS {
            let rate: [f64; POINTS] = std::array::from_fn(|j| growth[i][j] * q[i][j]);
            for (value, weights) in p[i].iter_mut().zip(&points.integrals) {
                let terms = weights.iter().zip(rate).map(|(own, rate)| own * rate);
                let new = of_p[i] + halves[1] * terms.sum::<f64>();
                change = change.max((new - *value).abs());
                *value = new;
            }
        }
        for j in 0..POINTS {
            let rate: [f64; POINTS] = std::array::from_fn(|i| growth[i][j] * p[i][j]);
            for (i, row) in q.iter_mut().enumerate() {
                let weights = points.integrals[i].iter().zip(rate);
                let new = of_q[j] + halves[0] * weights.map(|(own, rate)| own * rate).sum::<f64>();
                change = change.max((new - row[j]).abs());
                row[j] = new;
            }
        }
        if change <= ENOUGH * size {
            break;
        }
    }
    let whole = |rate: [f64; POINTS]| -> f64 {
        points
            .whole
            .iter()
            .zip(rate)
            .map(|(own, rate)| own * rate)
            .sum()
    };
    for i in 0..POINTS {
        of_p[i] += halves[1] * whole(std::array::from_fn(|j| growth[i][j] * q[i][j]));
        of_q[i] += halves[0] * whole(std::array::from_fn(|k| growth[k][i] * p[k][i]));
    }
    std::array::from_fn(|i| std::array::from_fn(|j| p[i][j] - q[i][j]))
}
