//! Polynomial pieces over `x = a/t`, found and entered by the bits of `x`.
//!
//! Every octave of `y`, which is `x` but for a factor, is cut into `2^bits` pieces of equal length,
//! as many as it needs. The exponent of `y` and the first `bits` of its mantissa are then the
//! number of the piece, and the rest of the mantissa is the place on it: no logarithm, no search.
//! Within a piece each quantity is a polynomial in the place `t` from -1 to 1, the exponential of
//! another one that is linear in the coefficients of the spline.

use std::borrow::Cow;
use std::ops::RangeInclusive;
use std::sync::Arc;

use fearless_simd::prelude::*;
use fearless_simd::{Level, dispatch, f64x2, f64x4};

use crate::Parameter;
use crate::Quantity;
use crate::curve::bspline::Basis;

/// Coefficients of a logarithm on a piece, of `1, t, t^2, ...`
const LOGARITHM: usize = 8;
/// Coefficients of a quantity on a piece. The exponential of a polynomial of degree 7 has no end,
/// but on a piece its terms fall by a factor of ten.
const VALUE: usize = 10;

/// The logarithms of the quantities on one piece, or their derivatives with respect to something.
pub(crate) type Logarithms = [[f64; 4]; LOGARITHM];
/// The quantities on one piece.
pub(crate) type Values = [[f64; 4]; VALUE];

const MANTISSA_BITS: u32 = 52;
const MANTISSA: u64 = (1 << MANTISSA_BITS) - 1;
/// The bits of 1.
const ONE: u64 = 1.0_f64.to_bits();

/// Where the pieces are.
#[derive(Clone, Debug)]
pub(crate) struct Grid {
    /// `y/x`, such that `y` begins between 1 and 2, and that the range covers as much as it can of
    /// its first and its last piece: the polynomial of a piece that sticks out far has large
    /// coefficients, and rounding.
    factor: f64,
    /// From 1 to 2, from 2 to 4, ...
    octaves: Vec<Octave>,
}

/// The pieces of an octave.
#[derive(Clone, Copy, Debug)]
struct Octave {
    /// There are two to this power.
    bits: u32,
    /// The first of them.
    first: usize,
}

/// A place on a piece.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    pub(crate) piece: usize,
    /// From -1 to 1.
    t: f64,
}

impl Grid {
    /// The most octaves of a range, of which the first and the last are not whole.
    fn most_octaves([from, to]: [f64; 2]) -> usize {
        (to / from).log2() as usize + 2
    }

    /// Over a range of `x` between 1e-30 and 1e30, with pieces in the octaves as given, of which
    /// the last may not be needed.
    fn over([from, to]: [f64; 2], bits: &[u32]) -> Self {
        const STEPS: i32 = 16;
        let length = |octave: usize| 0.5_f64.powi(bits[octave] as i32);
        // The first piece begins so much before the range. None begins or ends within rounding of
        // it.
        let candidates = (1..STEPS).map(|step| {
            let before = f64::from(step) / f64::from(STEPS);
            let factor = (1.0 + before * length(0)) / from;
            let (last, mantissa) = split(to * factor);
            let covered = (mantissa - 1.0) / length(last) % 1.0;
            (
                if covered > 0.99 {
                    0.0
                } else {
                    covered.min(1.0 - before)
                },
                factor,
            )
        });
        let best = candidates.reduce(|best, other| if other.0 > best.0 { other } else { best });
        let (_, factor) = best.expect("there are candidates");
        let mut first = 0;
        let octaves = bits[..=split(to * factor).0].iter().map(|&bits| {
            let octave = Octave { bits, first };
            first += 1 << bits;
            octave
        });
        Self {
            factor,
            octaves: octaves.collect(),
        }
    }

    /// Where `x`, which must be in the range, lies.
    #[inline]
    pub(crate) fn place(&self, x: f64) -> Place {
        let y = x * self.factor;
        let Octave { bits, first } = self.octaves[split(y).0];
        let piece = first + ((y.to_bits() & MANTISSA) >> (MANTISSA_BITS - bits)) as usize;
        let from_1_to_2 = f64::from_bits(((y.to_bits() << bits) & MANTISSA) | ONE);
        Place {
            piece,
            t: 2.0 * from_1_to_2 - 3.0,
        }
    }

    /// `x dt/dx`.
    pub(crate) fn logarithmic_speed(&self, x: f64) -> f64 {
        let (octave, mantissa) = split(x * self.factor);
        2.0 * mantissa * (1_u64 << self.octaves[octave].bits) as f64
    }

    /// The pieces that begin before `x`: their octaves, and their ends as `y`.
    fn pieces(&self, x: f64) -> impl Iterator<Item = (usize, [f64; 2])> + '_ {
        let pieces = self.octaves.iter().enumerate().flat_map(|(i, octave)| {
            let (start, length) = (
                2.0_f64.powi(i as i32),
                2.0_f64.powi(i as i32 - octave.bits as i32),
            );
            (0..1_u64 << octave.bits)
                .map(move |piece| (i, [piece, piece + 1].map(|end| start + length * end as f64)))
        });
        pieces.take_while(move |(_, [start, _])| *start <= x * self.factor)
    }
}

/// The octave of a number that is 1 or larger, and where it is in it, from 1 to 2.
#[inline]
fn split(y: f64) -> (usize, f64) {
    let bits = y.to_bits();
    (
        (bits >> MANTISSA_BITS).wrapping_sub(ONE >> MANTISSA_BITS) as usize,
        f64::from_bits(bits & MANTISSA | ONE),
    )
}

/// The sum of a polynomial with these coefficients at a place, for one quantity.
#[inline]
pub(crate) fn one<const N: usize>(piece: &[[f64; 4]; N], place: Place, quantity: usize) -> f64 {
    // In pairs: the chain of operations that wait for each other is half as long as Horner's.
    let (t, square) = (place.t, place.t * place.t);
    let pair = |k: usize| piece[k][quantity] + piece[k + 1][quantity] * t;
    (0..N / 2 - 1)
        .rev()
        .fold(pair(N - 2), |sum, k| sum * square + pair(2 * k))
}

/// The same, with the fused operations that a processor may have.
#[inline(always)]
pub(crate) fn one_fused<S: Simd, const N: usize>(
    simd: S,
    piece: &[[f64; 4]; N],
    place: Place,
    quantity: usize,
) -> f64 {
    let number = |value: f64| f64x2::splat(simd, value);
    let (t, square) = (number(place.t), number(place.t * place.t));
    let pair = |k: usize| t.mul_add(number(piece[k + 1][quantity]), number(piece[k][quantity]));
    let mut sum = pair(N - 2);
    for k in (0..N / 2 - 1).rev() {
        sum = sum.mul_add(square, pair(2 * k));
    }
    sum[0]
}

/// The same for all four quantities.
#[inline]
pub(crate) fn all<const N: usize>(piece: &[[f64; 4]; N], place: Place) -> [f64; 4] {
    std::array::from_fn(|quantity| one(piece, place, quantity))
}

/// The first piece on which one of the quantities held may leave a range, and that quantity.
pub(crate) fn first_outside<'a>(
    range: &RangeInclusive<f64>,
    pieces: &'a [Values],
    held: [bool; 4],
) -> Option<(&'a Values, Quantity)> {
    dispatch!(Level::new(), simd => {
        for piece in pieces {
            if !all_surely_within(simd, range, piece) {
                let leaving = |&q: &Quantity| held[q as usize] && !stays_within(range, piece, q as usize);
                if let Some(quantity) = Quantity::ALL.into_iter().find(leaving) {
                    return Some((piece, quantity));
                }
            }
        }
        None
    })
}

/// Whether the size of the coefficients says that no quantity leaves a range, as it does on most
/// pieces.
#[inline(always)]
fn all_surely_within<S: Simd>(simd: S, range: &RangeInclusive<f64>, piece: &Values) -> bool {
    let mut size = f64x4::splat(simd, 0.0);
    for coefficients in &piece[1..] {
        size += f64x4::from_slice(simd, coefficients).abs();
    }
    let middle = f64x4::from_slice(simd, &piece[0]);
    let (least, most) = (
        f64x4::splat(simd, *range.start()),
        f64x4::splat(simd, *range.end()),
    );
    ((middle - size).simd_ge(least) & (middle + size).simd_le(most)).all_true()
}

/// Whether a quantity stays within a range everywhere on a piece: then so do its Bernstein
/// coefficients on a sound curve, of which the polynomial is a weighted mean.
fn stays_within(range: &RangeInclusive<f64>, piece: &Values, quantity: usize) -> bool {
    let choose = |n: usize, k: usize| {
        (0..k).fold(1.0, |product, i| product * (n - i) as f64 / (i + 1) as f64)
    };
    // Powers of `u = (t + 1)/2`, from 0 to 1.
    let power = |m: usize| {
        let terms = (m..VALUE).map(|k| if (k - m).is_multiple_of(2) { choose(k, m) } else { -choose(k, m) } * piece[k][quantity]);
        terms.sum::<f64>() * (1_u64 << m) as f64
    };
    let bernstein = |j: usize| {
        (0..=j)
            .map(|m| choose(j, m) / choose(VALUE - 1, m) * power(m))
            .sum::<f64>()
    };
    (0..VALUE).all(|j| range.contains(&bernstein(j)))
}

/// The derivatives of the polynomials with respect to `t`.
#[inline]
pub(crate) fn derivatives<const N: usize>(piece: &[[f64; 4]; N], place: Place) -> [f64; 4] {
    std::array::from_fn(|q| {
        (1..N)
            .rev()
            .fold(0.0, |sum, k| sum * place.t + k as f64 * piece[k][q])
    })
}

/// From coefficients of splines over `ln x` to pieces: a few numbers for each piece and spline,
/// made once for a table.
#[derive(Clone, Debug)]
pub(crate) struct Resampler {
    pub(crate) grid: Arc<Grid>,
    spans: Vec<Span>,
    /// For each piece and each spline that does not vanish on it, its polynomial.
    weights: Vec<[f64; LOGARITHM]>,
}

/// The splines that do not vanish on one piece.
#[derive(Clone, Copy, Debug)]
struct Span {
    first: usize,
    count: usize,
    /// Of their weights.
    start: usize,
}

impl Resampler {
    /// The most pieces of an octave that are tried, two to this power. Only noise is not followed
    /// by pieces as short as these.
    const FINEST: u32 = 6;

    /// The longest pieces on which so many curves, as coefficients of the quantities held, follow
    /// their splines to a relative error.
    pub(crate) fn fitting<Coefficients: AsRef<[f64]>>(
        basis: &Basis,
        range: [f64; 2],
        held: &[Quantity],
        count: usize,
        curve: impl Fn(usize) -> Coefficients,
        error: f64,
    ) -> Self {
        // Shorter than the whole range, so that the samples of a piece that sticks out of it need
        // not lie closer to each other.
        let length = (range[1] - range[0]) / range[0];
        let coarsest = if length > 0.0 {
            (-length.log2()).ceil().clamp(0.0, 40.0) as u32
        } else {
            0
        };
        let finest = coarsest.max(Self::FINEST);
        let mut bits = vec![coarsest; Grid::most_octaves(range)];
        let mut resampler = Self::new(basis, range, &bits);
        // As other lengths move the ends of all pieces, it takes all curves one after the other
        // that these are short enough for.
        let mut followed = 0;
        for i in (0..count).cycle() {
            let curve = curve(i);
            let coefficients = fours(curve.as_ref(), held);
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

    fn new(basis: &Basis, range: [f64; 2], bits: &[u32]) -> Self {
        let grid = Grid::over(range, bits);
        let (mut spans, mut all_weights) = (Vec::new(), Vec::new());
        for (_, ends) in grid.pieces(range[1]) {
            let samples = samples(ends, range.map(|x| x * grid.factor));
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

    /// The logarithms on a piece from the coefficients of their splines.
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
        // Splines add up to one. Without what they have in common the sums are small, and so is
        // their rounding, which powers of `t` magnify.
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

    /// The derivatives of logarithms, from those of the coefficients.
    pub(crate) fn derivatives(&self, coefficients: &[f64], held: &[Quantity]) -> Arc<[Logarithms]> {
        let rows = fours(coefficients, held);
        let mut pieces = zeros(self.spans.len());
        dispatch!(Level::new(), simd => {
            for (i, piece) in Arc::make_mut(&mut pieces).iter_mut().enumerate() {
                for (place, logarithms) in piece.iter_mut().zip(self.logarithms(simd, i, &rows)) {
                    logarithms.store_slice(place);
                }
            }
        });
        pieces
    }

    /// The quantities themselves, with `es` in those that are scaled by it.
    pub(crate) fn values(&self, coefficients: &[f64], held: &[Quantity], es: f64) -> Arc<[Values]> {
        let scales = Quantity::ALL.map(|quantity| quantity.scale(es));
        let rows = fours(coefficients, held);
        let mut pieces = zeros(self.spans.len());
        dispatch!(Level::new(), simd => {
            for (i, piece) in Arc::make_mut(&mut pieces).iter_mut().enumerate() {
                exponential(simd, self.logarithms(simd, i, &rows), scales, piece);
            }
        });
        pieces
    }

    /// The largest relative difference of a curve's piece from its splines, between the samples;
    /// infinite if one is NaN.
    fn error(
        &self,
        piece: usize,
        ends: [f64; 2],
        basis: &Basis,
        range: [f64; 2],
        coefficients: &[[f64; 4]],
    ) -> f64 {
        let mut values = [[0.0; 4]; VALUE];
        dispatch!(Level::new(), simd => exponential(simd, self.logarithms(simd, piece, coefficients), [1.0; 4], &mut values));
        let samples = samples(ends, range.map(|x| x * self.grid.factor));
        let middles = samples
            .windows(2)
            .map(|pair| (pair[0].midpoint(pair[1]) / self.grid.factor).clamp(range[0], range[1]));
        // A piece that sticks out of the range has samples before it, too.
        let places = middles
            .map(|x| (x, self.grid.place(x)))
            .filter(|(_, place)| place.piece == piece);
        let errors = places.flat_map(|(x, place)| {
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
                (one(&values, place, quantity) / sum(quantity).exp() - 1.0).abs()
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

/// One row of four for each coefficient; 0 for a quantity that is not held.
fn fours<'a>(coefficients: &'a [f64], held: &[Quantity]) -> Cow<'a, [[f64; 4]]> {
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

/// The Chebyshev points of the second kind on a piece. One that sticks out of the range is moved
/// into it as a whole, so that nothing is taken from beyond.
fn samples([from, to]: [f64; 2], range: [f64; 2]) -> [f64; LOGARITHM] {
    let length = to - from;
    let from = from.min(range[1] - length).max(range[0]);
    let to = (from + length).min(range[1]);
    std::array::from_fn(|i| {
        let place = 0.5 - 0.5 * (std::f64::consts::PI * i as f64 / (LOGARITHM - 1) as f64).cos();
        (from + (to - from) * place).clamp(range[0], range[1])
    })
}

/// The polynomials that are 1 at one of the places and 0 at the others, as coefficients of powers;
/// the first alone, a constant, if there is but one place.
fn lagrange(places: [f64; LOGARITHM]) -> [[f64; LOGARITHM]; LOGARITHM] {
    if places[0] == places[LOGARITHM - 1] {
        return std::array::from_fn(|i| {
            std::array::from_fn(|k| if i == 0 && k == 0 { 1.0 } else { 0.0 })
        });
    }
    std::array::from_fn(|i| {
        let mut polynomial = [0.0; LOGARITHM];
        polynomial[0] = 1.0;
        for other in places
            .iter()
            .enumerate()
            .filter(|&(j, _)| j != i)
            .map(|(_, &place)| place)
        {
            // Times (t - other) / (places[i] - other).
            let distance = places[i] - other;
            for k in (0..LOGARITHM).rev() {
                let lower = if k > 0 { polynomial[k - 1] } else { 0.0 };
                polynomial[k] = (lower - other * polynomial[k]) / distance;
            }
        }
        polynomial
    })
}

/// The first terms of the exponential of a polynomial, times a scale.
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
    // Not a loop, so that all of it stays in registers.
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

/// A term of `v = e^p` from those before it: of `v' = p' v`.
#[inline(always)]
fn term<S: Simd, const K: usize>(
    slopes: &[f64x4<S>; LOGARITHM],
    terms: &[f64x4<S>; VALUE],
) -> f64x4<S> {
    // The term just before this one comes last, as it is ready last.
    let first = if K < LOGARITHM { K } else { LOGARITHM - 1 };
    let mut sum = slopes[first] * terms[K - first];
    for j in (1..first).rev() {
        sum = slopes[j].mul_add(terms[K - j], sum);
    }
    sum * (1.0 / K as f64)
}

/// So many pieces to be filled.
fn zeros<const N: usize>(pieces: usize) -> Arc<[[[f64; 4]; N]]> {
    std::iter::repeat_n([[0.0; 4]; N], pieces).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_x_is_on_its_piece() {
        let cases: [([f64; 2], &[u32]); 5] = [
            ([1e-3, 1e3], &[0, 1, 2, 3, 4]),
            ([0.7, 0.71], &[7, 7]),
            ([1e-30, 1e30], &[3, 0]),
            ([1.0, 2.0], &[4, 2, 3]),
            ([3.0, 3.0], &[0, 0]),
        ];
        for (range, bits) in cases {
            let bits: Vec<u32> = (0..Grid::most_octaves(range))
                .map(|octave| bits[octave % bits.len()])
                .collect();
            let grid = Grid::over(range, &bits);
            let pieces: Vec<[f64; 2]> = grid.pieces(range[1]).map(|(_, ends)| ends).collect();
            let [first, last] = [pieces[0], pieces[pieces.len() - 1]];
            // A piece much longer than the first one cannot be covered better by moving that.
            if range[0] < range[1]
                && grid.octaves[0].bits <= grid.octaves[grid.octaves.len() - 1].bits
            {
                assert!((first[1] - range[0] * grid.factor) / (first[1] - first[0]) > 0.25);
                assert!((range[1] * grid.factor - last[0]) / (last[1] - last[0]) > 0.25);
            }
            for i in 0..=1000 {
                let x = (range[0] * (range[1] / range[0]).powf(f64::from(i) / 1000.0))
                    .clamp(range[0], range[1]);
                let Place { piece, t } = grid.place(x);
                assert!(
                    piece < pieces.len() && (-1.0..1.0).contains(&t),
                    "{x}: piece {piece} of {}, t = {t}",
                    pieces.len()
                );
                let [from, to] = pieces[piece];
                let y = x * grid.factor;
                assert!((from..to).contains(&y), "{y} in {from} .. {to}");
                let back = from.midpoint(to) + 0.5 * (to - from) * t;
                assert!((back / y - 1.0).abs() < 1e-15, "{x}: {back}");
                assert!(
                    (grid.logarithmic_speed(x) * (to - from) / (2.0 * y) - 1.0).abs() < 1e-15,
                    "{x}"
                );
            }
        }
    }

    #[test]
    fn the_exponential_is_that_of_the_polynomial() {
        // Terms that fall by twenty, as on a piece.
        let logarithms: Logarithms = std::array::from_fn(|k| {
            std::array::from_fn(|q| (q as f64 - 1.7) * 0.05_f64.powi(k as i32))
        });
        let mut values = [[0.0; 4]; VALUE];
        dispatch!(Level::new(), simd => {
            exponential(simd, logarithms.map(|four| f64x4::simd_from(simd, four)), [2.0, 1.0, 1.0, 3.0], &mut values)
        });
        for t in [-1.0, -0.3, 0.0, 0.5, 1.0] {
            let place = Place { piece: 0, t };
            for (q, scale) in [2.0, 1.0, 1.0, 3.0].into_iter().enumerate() {
                let expected = scale * one(&logarithms, place, q).exp();
                assert!(
                    (one(&values, place, q) / expected - 1.0).abs() < 1e-11,
                    "{t}: {} {expected}",
                    one(&values, place, q)
                );
            }
        }
    }
}
