//! From splines over `ln(a/t)` to polynomials on pieces of `a/t`.
//!
//! On a piece the logarithm of a quantity is a polynomial that is linear in the coefficients of its
//! spline. The polynomial of the quantity itself is the exponential of that one.

use std::borrow::Cow;
use std::sync::Arc;

use fearless_simd::prelude::*;
use fearless_simd::{Level, dispatch, f64x4};

use crate::curve::bspline::Basis;
use crate::curve::grid::Grid;
use crate::curve::piecewise::{LOGARITHM, Logarithms, VALUE, Values, evaluate};
use crate::{Parameter, Quantity};

/// The linear map from the coefficients of a spline over `ln x` to the polynomials on the pieces of
/// a grid, made once for a table.
#[derive(Clone, Debug)]
pub(crate) struct Resampler {
    /// The pieces.
    pub(crate) grid: Arc<Grid>,
    /// The B-splines of each piece.
    spans: Vec<Span>,
    /// The polynomial of each B-spline on each piece where it does not vanish.
    weights: Vec<[f64; LOGARITHM]>,
}

/// The B-splines that do not vanish on one piece.
#[derive(Clone, Copy, Debug)]
struct Span {
    /// The number of the first B-spline.
    first: usize,
    count: usize,
    /// The index in `weights` of the polynomial of the first B-spline.
    start: usize,
}

impl Resampler {
    /// The binary logarithm of the largest number of pieces in an octave that is tried. Pieces as
    /// short as these follow everything but noise.
    const FINEST: u32 = 6;

    /// Finds the longest pieces on which `count` curves follow their splines to a relative `error`.
    ///
    /// `curve(i)` returns the coefficients of curve `i`: a group of the quantities `held` for each
    /// B-spline.
    pub(crate) fn fitting<Coefficients: AsRef<[f64]>>(
        basis: &Basis,
        range: [f64; 2],
        held: &[Quantity],
        count: usize,
        curve: impl Fn(usize) -> Coefficients,
        error: f64,
    ) -> Self {
        // A piece is shorter than the whole range. Otherwise the samples of a piece that extends
        // out of the range would lie closer to each other.
        let length = (range[1] - range[0]) / range[0];
        let coarsest = if length > 0.0 {
            (-length.log2()).ceil().clamp(0.0, 40.0) as u32
        } else {
            0
        };
        let finest = coarsest.max(Self::FINEST);
        let mut bits = vec![coarsest; Grid::most_octaves(range)];
        let mut resampler = Self::new(basis, range, &bits);
        // New lengths move the ends of all pieces. Therefore the search ends only after all curves,
        // one after another, were followed by the present pieces.
        let mut followed = 0;
        for i in (0..count).cycle() {
            let curve = curve(i);
            let coefficients = rows_of_four(curve.as_ref(), held);
            loop {
                let mut too_long = vec![false; bits.len()];
                for (piece, (octave, ends)) in resampler.grid.pieces(range[1]).enumerate() {
                    if bits[octave] < finest && !too_long[octave] {
                        too_long[octave] =
                            resampler.error(piece, ends, basis, range, &coefficients) > error;
                    }
                }
                if !too_long.contains(&true) {
                    break;
                }
                bits.iter_mut()
                    .zip(too_long)
                    .for_each(|(bits, too_long)| *bits += u32::from(too_long));
                resampler = Self::new(basis, range, &bits);
                followed = 0;
            }
            followed += 1;
            if followed == count {
                break;
            }
        }
        resampler
    }

    /// Samples the B-splines of `basis` on `2^bits[i]` pieces in octave `i` of `range`.
    fn new(basis: &Basis, range: [f64; 2], bits: &[u32]) -> Self {
        let grid = Grid::over(range, bits);
        let (mut spans, mut all_weights) = (Vec::new(), Vec::new());
        for (_, ends) in grid.pieces(range[1]) {
            let samples = chebyshev_points(ends, range.map(|x| x * grid.factor));
            let x = |y: f64| (y / grid.factor).clamp(range[0], range[1]);
            let splines = samples.map(|y| basis.weights(Parameter::AOverT.coordinate(x(y))));
            let polynomials =
                lagrange(samples.map(|y| (2.0 * y - ends[0] - ends[1]) / (ends[1] - ends[0])));
            let first = splines
                .iter()
                .map(|splines| splines.first)
                .min()
                .unwrap_or(0);
            let end = splines
                .iter()
                .map(|splines| splines.first + splines.count)
                .max()
                .unwrap_or(0);
            let start = all_weights.len();
            spans.push(Span {
                first,
                count: end - first,
                start,
            });
            all_weights.resize(start + end - first, [0.0; LOGARITHM]);
            for (splines, polynomial) in splines.iter().zip(polynomials) {
                let values = &splines.values[..splines.count];
                for (weights, value) in all_weights[start + splines.first - first..]
                    .iter_mut()
                    .zip(values)
                {
                    weights
                        .iter_mut()
                        .zip(polynomial)
                        .for_each(|(weight, coefficient)| *weight += value * coefficient);
                }
            }
        }
        Self {
            grid: Arc::new(grid),
            spans,
            weights: all_weights,
        }
    }

    /// Returns the polynomials of the logarithms on a piece, from the coefficients of their
    /// splines.
    #[inline(always)]
    fn logarithms<S: Simd>(
        &self,
        simd: S,
        piece: usize,
        coefficients: &[[f64; 4]],
    ) -> [f64x4<S>; LOGARITHM] {
        let span = self.spans[piece];
        let coefficients = &coefficients[span.first..span.first + span.count];
        let weights = &self.weights[span.start..span.start + span.count];
        // B-splines add up to one: a common part of the coefficients can be added at the end.
        // Without it the sums are small, and so is their rounding, which powers of `t` magnify.
        let common = f64x4::from_slice(simd, &coefficients[span.count / 2]);
        let mut logarithms = [f64x4::splat(simd, 0.0); LOGARITHM];
        for (weights, coefficients) in weights.iter().zip(coefficients) {
            let coefficients = f64x4::from_slice(simd, coefficients) - common;
            for (sum, &weight) in logarithms.iter_mut().zip(weights) {
                *sum = coefficients.mul_add(f64x4::splat(simd, weight), *sum);
            }
        }
        logarithms[0] += common;
        logarithms
    }

    /// Returns the polynomials of the derivatives of the logarithms, from the derivatives of the
    /// coefficients.
    pub(crate) fn derivatives(&self, coefficients: &[f64], held: &[Quantity]) -> Arc<[Logarithms]> {
        let rows = rows_of_four(coefficients, held);
        let mut pieces = zeros(self.spans.len());
        dispatch!(Level::new(), simd => {
            for (i, piece) in Arc::make_mut(&mut pieces).iter_mut().enumerate() {
                for (row, logarithms) in piece.iter_mut().zip(self.logarithms(simd, i, &rows)) {
                    logarithms.store_slice(row);
                }
            }
        });
        pieces
    }

    /// Returns the polynomials of the quantities themselves; `es` is the sphere-film modulus of
    /// their [scales](Quantity::scale).
    pub(crate) fn values(&self, coefficients: &[f64], held: &[Quantity], es: f64) -> Arc<[Values]> {
        let scales = Quantity::ALL.map(|quantity| quantity.scale(es));
        let rows = rows_of_four(coefficients, held);
        let mut pieces = zeros(self.spans.len());
        dispatch!(Level::new(), simd => {
            for (i, piece) in Arc::make_mut(&mut pieces).iter_mut().enumerate() {
                exponential(simd, self.logarithms(simd, i, &rows), scales, piece);
            }
        });
        pieces
    }

    /// Returns the largest relative difference between the quantities on a piece of a curve and
    /// their splines, midway between the samples; infinity if a difference is NaN.
    fn error(
        &self,
        piece: usize,
        ends: [f64; 2],
        basis: &Basis,
        range: [f64; 2],
        coefficients: &[[f64; 4]],
    ) -> f64 {
        let mut values = [[0.0; 4]; VALUE];
        dispatch!(Level::new(), simd => {
            let logarithms = self.logarithms(simd, piece, coefficients);
            exponential(simd, logarithms, [1.0; 4], &mut values);
        });
        let samples = chebyshev_points(ends, range.map(|x| x * self.grid.factor));
        let middles = samples
            .windows(2)
            .map(|pair| (pair[0].midpoint(pair[1]) / self.grid.factor).clamp(range[0], range[1]));
        // The samples of a piece that extends out of the range are shifted, some to the piece
        // before.
        let points = middles
            .map(|x| (x, self.grid.locate(x)))
            .filter(|(_, position)| position.piece == piece);
        let errors = points.flat_map(|(x, position)| {
            let splines = basis.weights(Parameter::AOverT.coordinate(x));
            let sum = move |quantity: usize| {
                let values = splines.values[..splines.count]
                    .iter()
                    .zip(&coefficients[splines.first..]);
                values
                    .map(|(value, row)| value * row[quantity])
                    .sum::<f64>()
            };
            (0..4).map(move |quantity| {
                (evaluate(&values, position, quantity) / sum(quantity).exp() - 1.0).abs()
            })
        });
        errors.fold(0.0, |largest, error| {
            if error.is_nan() {
                f64::INFINITY
            } else {
                largest.max(error)
            }
        })
    }
}

/// Returns a row of all four quantities for each B-spline, with 0 for a quantity that is not held.
fn rows_of_four<'a>(coefficients: &'a [f64], held: &[Quantity]) -> Cow<'a, [[f64; 4]]> {
    if held == Quantity::ALL {
        return Cow::Borrowed(coefficients.as_chunks().0);
    }
    let row = |group: &[f64]| {
        let mut row = [0.0; 4];
        held.iter()
            .zip(group)
            .for_each(|(&quantity, &value)| row[quantity as usize] = value);
        row
    };
    coefficients.chunks_exact(held.len()).map(row).collect()
}

/// Returns the Chebyshev points of the second kind on a piece. The points of a piece that extends
/// out of the range are shifted into it together, because the splines are not sampled beyond the
/// range.
fn chebyshev_points([from, to]: [f64; 2], range: [f64; 2]) -> [f64; LOGARITHM] {
    let length = to - from;
    let from = from.min(range[1] - length).max(range[0]);
    let to = (from + length).min(range[1]);
    std::array::from_fn(|i| {
        let share = 0.5 - 0.5 * (std::f64::consts::PI * i as f64 / (LOGARITHM - 1) as f64).cos();
        (from + (to - from) * share).clamp(range[0], range[1])
    })
}

/// Returns the Lagrange polynomials of the points, as coefficients of powers: each is 1 at its own
/// point and 0 at the others. If all points coincide, the first polynomial is 1 and the others are
/// 0.
fn lagrange(points: [f64; LOGARITHM]) -> [[f64; LOGARITHM]; LOGARITHM] {
    if points[0] == points[LOGARITHM - 1] {
        return std::array::from_fn(|i| {
            std::array::from_fn(|k| if i == 0 && k == 0 { 1.0 } else { 0.0 })
        });
    }
    std::array::from_fn(|i| {
        let mut polynomial = [0.0; LOGARITHM];
        polynomial[0] = 1.0;
        for other in points
            .iter()
            .enumerate()
            .filter(|&(j, _)| j != i)
            .map(|(_, &point)| point)
        {
            // Times (t - other) / (points[i] - other).
            let distance = points[i] - other;
            for k in (0..LOGARITHM).rev() {
                let lower = if k > 0 { polynomial[k - 1] } else { 0.0 };
                polynomial[k] = (lower - other * polynomial[k]) / distance;
            }
        }
        polynomial
    })
}

/// Computes the first terms of the exponential of a polynomial, times a scale.
#[inline(always)]
fn exponential<S: Simd>(
    simd: S,
    logarithms: [f64x4<S>; LOGARITHM],
    scales: [f64; 4],
    values: &mut Values,
) {
    let mut slopes = logarithms;
    for (j, slope) in slopes.iter_mut().enumerate() {
        *slope *= j as f64;
    }
    let constant = logarithms[0].as_array();
    let mut terms = [f64x4::splat(simd, 0.0); VALUE];
    terms[0] = f64x4::simd_from(simd, std::array::from_fn(|q| scales[q] * constant[q].exp()));
    // Not a loop: this way everything stays in registers.
    terms[1] = term::<S, 1>(&slopes, &terms);
    terms[2] = term::<S, 2>(&slopes, &terms);
    terms[3] = term::<S, 3>(&slopes, &terms);
    terms[4] = term::<S, 4>(&slopes, &terms);
    terms[5] = term::<S, 5>(&slopes, &terms);
    terms[6] = term::<S, 6>(&slopes, &terms);
    terms[7] = term::<S, 7>(&slopes, &terms);
    terms[8] = term::<S, 8>(&slopes, &terms);
    terms[9] = term::<S, 9>(&slopes, &terms);
    for (value, term) in values.iter_mut().zip(terms) {
        term.store_slice(value);
    }
}

/// Returns term `K` of `v = e^p` from those before it, by `v' = p' v`. `slopes[j]` is `j` times
/// term `j` of `p`.
#[inline(always)]
fn term<S: Simd, const K: usize>(
    slopes: &[f64x4<S>; LOGARITHM],
    terms: &[f64x4<S>; VALUE],
) -> f64x4<S> {
    // The term just before this one is used last, because it is ready last.
    let first = if K < LOGARITHM { K } else { LOGARITHM - 1 };
    let mut sum = slopes[first] * terms[K - first];
    for j in (1..first).rev() {
        sum = slopes[j].mul_add(terms[K - j], sum);
    }
    sum * (1.0 / K as f64)
}

/// Returns polynomials of zero on `pieces` pieces.
fn zeros<const N: usize>(pieces: usize) -> Arc<[[[f64; 4]; N]]> {
    std::iter::repeat_n([[0.0; 4]; N], pieces).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::curve::grid::Position;

    #[test]
    fn the_exponential_is_that_of_the_polynomial() {
        // Terms that fall by twenty, as on a piece.
        let logarithms: Logarithms = std::array::from_fn(|k| {
            std::array::from_fn(|q| (q as f64 - 1.7) * 0.05_f64.powi(k as i32))
        });
        let mut values = [[0.0; 4]; VALUE];
        dispatch!(Level::new(), simd => {
            let logarithms = logarithms.map(|row| f64x4::simd_from(simd, row));
            exponential(simd, logarithms, [2.0, 1.0, 1.0, 3.0], &mut values)
        });
        for t in [-1.0, -0.3, 0.0, 0.5, 1.0] {
            let position = Position { piece: 0, t };
            for (q, scale) in [2.0, 1.0, 1.0, 3.0].into_iter().enumerate() {
                let expected = scale * evaluate(&logarithms, position, q).exp();
                assert!(
                    (evaluate(&values, position, q) / expected - 1.0).abs() < 1e-11,
                    "{t}: {} {expected}",
                    evaluate(&values, position, q)
                );
            }
        }
    }
}
