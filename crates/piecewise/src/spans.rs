//! The B-splines over `ln x` as polynomials on the pieces of a grid: from the coefficients of splines to
//! polynomials.

use fearless_simd::prelude::*;
use fearless_simd::{f64x4, f64x8};

use crate::SPLINE_TERMS;
use crate::bspline::Basis;
use crate::grid::Grid;
use crate::lanes::{LANES, Lanes, transposed_lanes};
use crate::series::Series;

/// The B-splines on all pieces of a grid, as polynomials.
#[derive(Clone, Debug)]
pub(crate) struct Spans {
    /// The B-splines of the pieces, in groups. The last piece is repeated until its group is full.
    spans: Vec<Span>,
    /// The polynomials of the first B-splines on the pieces: a row for each B-spline of a group.
    weights: Vec<[[f64; SPLINE_TERMS]; LANES]>,
    /// The polynomials of the further B-splines of pieces that have many more than others.
    rest: Vec<[f64; SPLINE_TERMS]>,
}

/// The B-splines that do not vanish on a group of pieces.
#[derive(Clone, Copy, Debug)]
struct Span {
    /// The number of the first B-spline of each piece.
    first: [usize; LANES],
    /// The number of B-splines of a piece in `weights`. Some may vanish on it.
    count: usize,
    /// The index in `weights` of the first row.
    start: usize,
    /// The indices in `rest` of the further B-splines of each piece, from the first to the end.
    rest: [[usize; 2]; LANES],
}

impl Spans {
    /// The largest number of vanishing B-splines of a piece in [`Self::weights`], which take
    /// memory.
    const MOST_VANISHING: usize = 4;

    /// Samples the B-splines of `basis` on the pieces of a `grid`.
    pub(crate) fn new(basis: &Basis, grid: &Grid) -> Self {
        let (range, factor) = (grid.range(), grid.factor());
        let samples = |ends: [f64; 2]| {
            let samples = chebyshev_points(ends, range.map(|x| x * factor));
            let x = |y: f64| (y / factor).clamp(range[0], range[1]);
            let splines = samples.map(|y| basis.weights(x(y).ln()));
            (samples, splines)
        };
        let (mut spans, mut all_weights, mut rest) = (Vec::new(), Vec::new(), Vec::new());
        let mut all_ends = grid.pieces().map(|(_, ends)| ends).peekable();
        let mut last = range;
        while all_ends.peek().is_some() {
            let ends: [[f64; 2]; LANES] = std::array::from_fn(|_| {
                if let Some(ends) = all_ends.next() {
                    last = ends;
                }
                last
            });
            let sampled = ends.map(samples);
            let reach = sampled.map(|(_, splines)| {
                let first = splines.iter().map(|splines| splines.first);
                let end = splines.iter().map(|splines| splines.first + splines.count);
                [first.min().unwrap_or(0), end.max().unwrap_or(0)]
            });
            let counts = reach.map(|[first, end]| end - first);
            let [least, most] = [counts.iter().min(), counts.iter().max()];
            let [least, most] = [least, most].map(|count| count.copied().unwrap_or(0));
            let count = most.min(least + Self::MOST_VANISHING);
            let mut span = Span {
                first: reach.map(|[first, _]| first.min(basis.count() - count)),
                count,
                start: all_weights.len(),
                rest: [[0; 2]; LANES],
            };
            all_weights.resize(span.start + count, [[0.0; SPLINE_TERMS]; LANES]);
            for (lane, (ends, (samples, splines))) in ends.iter().zip(&sampled).enumerate() {
                let polynomials =
                    lagrange(samples.map(|y| (2.0 * y - ends[0] - ends[1]) / (ends[1] - ends[0])));
                let further = rest.len();
                rest.resize(
                    further + counts[lane].saturating_sub(count),
                    [0.0; SPLINE_TERMS],
                );
                span.rest[lane] = [further, rest.len()];
                for (splines, polynomial) in splines.iter().zip(polynomials) {
                    for (i, value) in splines.values[..splines.count].iter().enumerate() {
                        let number = splines.first + i - span.first[lane];
                        let weights = if number < count {
                            &mut all_weights[span.start + number][lane]
                        } else {
                            &mut rest[further + number - count]
                        };
                        weights
                            .iter_mut()
                            .zip(polynomial)
                            .for_each(|(weight, coefficient)| *weight += value * coefficient);
                    }
                }
            }
            spans.push(span);
        }
        Self {
            spans,
            weights: all_weights,
            rest,
        }
    }

    /// Returns the polynomials of the B-splines on a piece, from the first one on.
    #[inline(always)]
    fn weights_on(&self, piece: usize) -> impl Iterator<Item = &[f64; SPLINE_TERMS]> {
        let (span, lane) = (&self.spans[piece / LANES], piece % LANES);
        let [from, to] = span.rest[lane];
        let first = self.weights[span.start..][..span.count].iter();
        first.map(move |row| &row[lane]).chain(&self.rest[from..to])
    }

    /// Returns the polynomials of four splines on a piece, from their coefficients.
    #[inline(always)]
    pub(crate) fn on_piece<S: Simd>(
        &self,
        simd: S,
        piece: usize,
        coefficients: &[[f64; 4]],
    ) -> [f64x4<S>; SPLINE_TERMS] {
        let (span, lane) = (&self.spans[piece / LANES], piece % LANES);
        let coefficients = &coefficients[span.first[lane]..];
        // B-splines add up to one: a common part of the coefficients can be added at the end.
        // Without it the sums are small, and so is their rounding, which powers of `t` magnify.
        let common = f64x4::from_slice(simd, &coefficients[span.count / 2]);
        let mut splines = [f64x4::splat(simd, 0.0); SPLINE_TERMS];
        for (weights, coefficients) in self.weights_on(piece).zip(coefficients) {
            let coefficients = f64x4::from_slice(simd, coefficients) - common;
            for (sum, &weight) in splines.iter_mut().zip(weights) {
                *sum = coefficients.mul_add(f64x4::splat(simd, weight), *sum);
            }
        }
        splines[0] += common;
        splines
    }

    /// Returns the polynomials of a single spline on a group of pieces, from its coefficients.
    #[inline(always)]
    pub(crate) fn single_on_group<S: Simd>(
        &self,
        simd: S,
        group: usize,
        coefficients: &[f64],
    ) -> Series<Lanes<S>, SPLINE_TERMS> {
        let mut rows = [f64x8::splat(simd, 0.0); LANES];
        for (lane, row) in rows.iter_mut().enumerate() {
            *row = self.single_on_piece(simd, LANES * group + lane, coefficients);
        }
        transposed_lanes(rows)
    }

    /// Returns the polynomial of a single spline on a piece, from its coefficients.
    #[inline(always)]
    pub(crate) fn single_on_piece<S: Simd>(
        &self,
        simd: S,
        piece: usize,
        coefficients: &[f64],
    ) -> f64x8<S> {
        let (span, lane) = (&self.spans[piece / LANES], piece % LANES);
        let (first, further) = coefficients[span.first[lane]..].split_at(span.count);
        // As in `on_piece`.
        let common = f64x8::splat(simd, first[span.count / 2]);
        let [from, to] = span.rest[lane];
        let mut spline = f64x8::splat(simd, 0.0);
        for (weights, &coefficient) in self.weights[span.start..].iter().zip(first) {
            let coefficient = f64x8::splat(simd, coefficient) - common;
            let weights = f64x8::from_slice(simd, &weights[lane]);
            spline = coefficient.mul_add(weights, spline);
        }
        for (weights, &coefficient) in self.rest[from..to].iter().zip(further) {
            let coefficient = f64x8::splat(simd, coefficient) - common;
            spline = coefficient.mul_add(f64x8::from_slice(simd, weights), spline);
        }
        spline[0] += common[0];
        spline
    }
}

/// Returns the Chebyshev points of the second kind on a piece. The points of a piece that extends
/// out of the range are shifted into it together, because the splines are not sampled beyond the
/// range.
pub(crate) fn chebyshev_points([from, to]: [f64; 2], range: [f64; 2]) -> [f64; SPLINE_TERMS] {
    let length = to - from;
    let from = from.min(range[1] - length).max(range[0]);
    let to = (from + length).min(range[1]);
    std::array::from_fn(|i| {
        let share = 0.5 - 0.5 * (std::f64::consts::PI * i as f64 / (SPLINE_TERMS - 1) as f64).cos();
        (from + (to - from) * share).clamp(range[0], range[1])
    })
}

/// Returns the Lagrange polynomials of the points, as coefficients of powers: each is 1 at its own
/// point and 0 at the others. If all points coincide, the first polynomial is 1 and the others are
/// 0.
fn lagrange(points: [f64; SPLINE_TERMS]) -> [[f64; SPLINE_TERMS]; SPLINE_TERMS] {
    if points[0] == points[SPLINE_TERMS - 1] {
        return std::array::from_fn(|i| {
            std::array::from_fn(|k| if i == 0 && k == 0 { 1.0 } else { 0.0 })
        });
    }
    std::array::from_fn(|i| {
        let mut polynomial = [0.0; SPLINE_TERMS];
        polynomial[0] = 1.0;
        for other in points
            .iter()
            .enumerate()
            .filter(|&(j, _)| j != i)
            .map(|(_, &point)| point)
        {
            // Times (t - other) / (points[i] - other).
            let distance = points[i] - other;
            for k in (0..SPLINE_TERMS).rev() {
                let lower = if k > 0 { polynomial[k - 1] } else { 0.0 };
                polynomial[k] = (lower - other * polynomial[k]) / distance;
            }
        }
        polynomial
    })
}
