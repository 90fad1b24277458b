//! The B-splines over `ln x` as polynomials on the pieces of a grid: from the coefficients of splines to
//! polynomials.

use fearless_simd::prelude::*;
use fearless_simd::{f64x4, f64x8};

use crate::SPLINE_TERMS;
use crate::bspline::Basis;
use crate::grid::Grid;
use crate::lagrange::lagrange;
use crate::lanes::{LANES, Lanes, transposed_lanes};
use crate::series::Series;

/// The B-splines on all pieces of a grid, as polynomials.
#[derive(Clone, Debug)]
pub(crate) struct Spans {
    /// The B-splines of each piece. The last piece is repeated until a [group](LANES) is full.
    spans: Vec<Span>,
    /// The polynomials of the B-splines on the pieces, piece by piece.
    weights: Vec<[f64; SPLINE_TERMS]>,
}

/// The B-splines that do not vanish where a piece is sampled.
#[derive(Clone, Copy, Debug)]
struct Span {
    /// The number of the first B-spline.
    first: usize,
    /// The number of B-splines.
    count: usize,
    /// The index of the first one in the weights.
    start: usize,
}

impl Spans {
    /// Samples the B-splines of `basis` on the pieces of a `grid`.
    pub(crate) fn new(basis: &Basis, grid: &Grid) -> Self {
        let (range, factor) = (grid.range(), grid.factor());
        let splines = |y: f64| basis.weights((y / factor).clamp(range[0], range[1]).ln());
        let samples = |ends: [f64; 2]| chebyshev_points(ends, range.map(|x| x * factor));
        let mut spans = Vec::with_capacity(grid.count().next_multiple_of(LANES));
        let mut start = 0;
        for (_, ends) in grid.pieces() {
            // The number of the first B-spline that does not vanish grows with `x`.
            let [low, .., high] = samples(ends);
            let [low, high] = [low, high].map(&splines);
            let count = high.first + high.count - low.first;
            spans.push(Span {
                first: low.first,
                count,
                start,
            });
            start += count;
        }
        let mut weights = vec![[0.0; SPLINE_TERMS]; start];
        for ((_, ends), span) in grid.pieces().zip(&spans) {
            let samples = samples(ends);
            let polynomials =
                lagrange(&samples.map(|y| (2.0 * y - ends[0] - ends[1]) / (ends[1] - ends[0])));
            for (splines, polynomial) in samples.map(&splines).iter().zip(polynomials) {
                let own = &mut weights[span.start + splines.first - span.first..];
                for (weights, value) in own.iter_mut().zip(&splines.values[..splines.count]) {
                    for (weight, coefficient) in weights.iter_mut().zip(polynomial) {
                        *weight += value * coefficient;
                    }
                }
            }
        }
        if let Some(&last) = spans.last() {
            spans.resize(spans.len().next_multiple_of(LANES), last);
        }
        Self { spans, weights }
    }

    /// Returns the polynomials of the B-splines of a span.
    #[inline(always)]
    fn weights(&self, span: Span) -> &[[f64; SPLINE_TERMS]] {
        &self.weights[span.start..][..span.count]
    }

    /// Returns the polynomials of four splines on a piece, from their coefficients.
    #[inline(always)]
    pub(crate) fn on_piece<S: Simd>(
        &self,
        simd: S,
        piece: usize,
        coefficients: &[[f64; 4]],
    ) -> [f64x4<S>; SPLINE_TERMS] {
        let span = self.spans[piece];
        let coefficients = &coefficients[span.first..][..span.count];
        // B-splines add up to one: a common part of the coefficients can be added at the end.
        // Without it the sums are small, and so is their rounding, which powers of `t` magnify.
        let common = f64x4::from_slice(simd, &coefficients[span.count / 2]);
        let mut splines = [f64x4::splat(simd, 0.0); SPLINE_TERMS];
        for (weights, coefficients) in self.weights(span).iter().zip(coefficients) {
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
        let span = self.spans[piece];
        let coefficients = &coefficients[span.first..][..span.count];
        // As in `on_piece`.
        let common = coefficients[span.count / 2];
        let mut spline = f64x8::splat(simd, 0.0);
        for (weights, &coefficient) in self.weights(span).iter().zip(coefficients) {
            let coefficient = f64x8::splat(simd, coefficient - common);
            spline = coefficient.mul_add(f64x8::from_slice(simd, weights), spline);
        }
        spline[0] += common;
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
