//! Polynomial pieces over `x = a/t`, found and entered by the bits of `x`.
//!
//! Every octave of `y`, which is `x` but for a factor near 1, is cut into `2^bits` pieces of equal length. The exponent of `y` and the first `bits` of
//! its mantissa are then the number of the piece, and the rest of the mantissa is the place on it: no logarithm, no search. Within a piece each quantity is a polynomial in the place
//! `t` from -1 to 1, the exponential of another one that is linear in the coefficients of the spline.

use std::sync::Arc;

use crate::Quantity;
use crate::schema::Parameter;
use crate::spline::Basis;

/// One number for each of the four quantities.
pub(crate) type Four = [f64; 4];

/// Coefficients of a logarithm on a piece, of `1, t, t^2, ...`
const LOGARITHM: usize = 8;
/// Coefficients of a quantity on a piece. The exponential of a polynomial of degree 7 has no end, but on a piece its terms fall by a factor of ten.
const VALUE: usize = 10;

/// The logarithms of the quantities on one piece, or their derivatives with respect to something.
pub(crate) type Logarithms = [Four; LOGARITHM];
/// The quantities on one piece.
pub(crate) type Values = [Four; VALUE];

const MANTISSA_BITS: u32 = 52;
const MANTISSA: u64 = (1 << MANTISSA_BITS) - 1;

/// Where the pieces are.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Grid {
    /// `y/x`, such that the range covers no piece by less than a quarter: the polynomial of a piece that sticks out has large coefficients, and rounding.
    factor: f64,
    /// Pieces in an octave: two to this power.
    bits: u32,
    /// The number of the first piece.
    first: u64,
    count: usize,
}

/// A place on a piece.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    pub(crate) piece: usize,
    /// From -1 to 1.
    t: f64,
}

impl Grid {
    /// Over a range of `x` between 1e-30 and 1e30.
    fn over([from, to]: [f64; 2], bits: u32) -> Self {
        const STEPS: i32 = 16;
        let number = |y: f64| y.to_bits() >> (MANTISSA_BITS - bits);
        let mut best = (f64::NEG_INFINITY, Self { factor: 1.0, bits, first: number(from), count: 1 });
        for step in 1..STEPS {
            // The first piece begins so much before the range. None begins or ends within rounding of it.
            let before = f64::from(step) / f64::from(STEPS);
            let mut grid = best.1;
            let [start, end] = grid.ends_of(number(from));
            grid.factor = (start + before * (end - start)) / from;
            let last = to * grid.factor;
            grid.count = (number(last) - grid.first) as usize + 1;
            let [start, end] = grid.ends_of(number(last));
            let after = (end - last) / (end - start);
            let covered = if after < 0.01 { 0.0 } else { (1.0 - before).min(1.0 - after) };
            if covered > best.0 {
                best = (covered, grid);
            }
        }
        best.1
    }

    /// Where `x`, which must be in the range, lies.
    #[inline]
    pub(crate) fn place(&self, x: f64) -> Place {
        let bits = (x * self.factor).to_bits();
        let piece = ((bits >> (MANTISSA_BITS - self.bits)) - self.first) as usize;
        let from_1_to_2 = f64::from_bits(((bits << self.bits) & MANTISSA) | 1.0_f64.to_bits());
        Place { piece, t: 2.0 * from_1_to_2 - 3.0 }
    }

    /// `x dt/dx`.
    #[inline]
    pub(crate) fn logarithmic_speed(&self, x: f64) -> f64 {
        let y = x * self.factor;
        let octave = f64::from_bits(y.to_bits() & !MANTISSA);
        2.0 * (y / octave) * (1_u64 << self.bits) as f64
    }

    /// The ends of a piece, as `y`.
    fn ends(&self, piece: usize) -> [f64; 2] {
        self.ends_of(self.first + piece as u64)
    }

    fn ends_of(&self, number: u64) -> [f64; 2] {
        [number, number + 1].map(|number| f64::from_bits(number << (MANTISSA_BITS - self.bits)))
    }
}

/// The sum of a polynomial with these coefficients at a place, for one quantity.
#[inline]
pub(crate) fn one<const N: usize>(piece: &[Four; N], place: Place, quantity: usize) -> f64 {
    // In pairs: the chain of operations that wait for each other is half as long as Horner's.
    let (t, square) = (place.t, place.t * place.t);
    let pair = |k: usize| piece[k][quantity] + piece[k + 1][quantity] * t;
    (0..N / 2 - 1).rev().fold(pair(N - 2), |sum, k| sum * square + pair(2 * k))
}

/// The same for all four quantities.
#[inline]
pub(crate) fn all<const N: usize>(piece: &[Four; N], place: Place) -> Four {
    std::array::from_fn(|quantity| one(piece, place, quantity))
}

/// The derivatives of the polynomials with respect to `t`.
#[inline]
pub(crate) fn derivatives<const N: usize>(piece: &[Four; N], place: Place) -> Four {
    std::array::from_fn(|q| (1..N).rev().fold(0.0, |sum, k| sum * place.t + k as f64 * piece[k][q]))
}

/// From coefficients of splines over `ln x` to pieces: a few numbers for each piece and spline, made once for a table.
#[derive(Clone, Debug)]
pub(crate) struct Resampler {
    pub(crate) grid: Grid,
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
    /// The coarsest pieces that are tried: four to an octave, eighty to six decades.
    const COARSEST: u32 = 2;
    /// The finest that are tried for accuracy. On pieces as short as these only noise is not followed.
    const FINEST: u32 = 6;

    /// The coarsest pieces on which the given curves, as coefficients of the quantities held, follow their splines to a relative error.
    pub(crate) fn fitting(basis: &Basis, range: [f64; 2], held: &[Quantity], curves: &[Vec<f64>], error: f64) -> Self {
        // Shorter than the whole range, so that the samples of a piece that sticks out of it need not lie closer to each other.
        let shortest = (range[0] / (range[1] - range[0])).log2().ceil().clamp(0.0, 40.0) as u32;
        let coarsest = if range[0] == range[1] { Self::COARSEST } else { shortest.max(Self::COARSEST) };
        let finest = coarsest.max(Self::FINEST);
        let mut resampler = Self::new(basis, range, coarsest);
        for bits in coarsest + 1..=finest {
            if curves.iter().all(|curve| resampler.error(basis, range, held, curve) <= error) {
                break;
            }
            resampler = Self::new(basis, range, bits);
        }
        resampler
    }

    fn new(basis: &Basis, range: [f64; 2], bits: u32) -> Self {
        let grid = Grid::over(range, bits);
        let mut resampler = Self { grid, spans: Vec::with_capacity(grid.count), weights: Vec::new() };
        for piece in 0..grid.count {
            let ends = grid.ends(piece);
            let samples = samples(ends, range.map(|x| x * grid.factor));
            let x = |y: f64| (y / grid.factor).clamp(range[0], range[1]);
            let splines = samples.map(|y| basis.weights(Parameter::AOverT.coordinate(x(y))));
            let polynomials = lagrange(samples.map(|y| (2.0 * y - ends[0] - ends[1]) / (ends[1] - ends[0])));
            let first = splines.iter().map(|splines| splines.first).min().unwrap_or(0);
            let end = splines.iter().map(|splines| splines.first + splines.count).max().unwrap_or(0);
            let start = resampler.weights.len();
            resampler.spans.push(Span { first, count: end - first, start });
            resampler.weights.resize(start + end - first, [0.0; LOGARITHM]);
            for (splines, polynomial) in splines.iter().zip(polynomials) {
                let values = &splines.values[..splines.count];
                for (weights, value) in resampler.weights[start + splines.first - first..].iter_mut().zip(values) {
                    weights.iter_mut().zip(polynomial).for_each(|(weight, coefficient)| *weight += value * coefficient);
                }
            }
        }
        resampler
    }

    /// The logarithms on all pieces from the coefficients of their splines, those of the quantities held one after the other.
    fn pieces<'a>(&'a self, coefficients: &'a [Four]) -> impl ExactSizeIterator<Item = Logarithms> + 'a {
        self.spans.iter().map(|span| {
            let coefficients = &coefficients[span.first..span.first + span.count];
            let weights = &self.weights[span.start..span.start + span.count];
            // Splines add up to one. Without what they have in common the sums are small, and so is their rounding, which powers of `t` magnify.
            let common = coefficients[span.count / 2];
            // Half of the sums at a time stay in registers.
            let half = |first: usize| {
                let mut sums = [[0.0; 4]; LOGARITHM / 2];
                for (weights, coefficients) in weights.iter().zip(coefficients) {
                    let coefficients: Four = std::array::from_fn(|q| coefficients[q] - common[q]);
                    for (sum, weight) in sums.iter_mut().zip(&weights[first..first + LOGARITHM / 2]) {
                        sum.iter_mut().zip(&coefficients).for_each(|(sum, coefficient)| *sum += weight * coefficient);
                    }
                }
                sums
            };
            let [mut low, high] = [half(0), half(LOGARITHM / 2)];
            low[0].iter_mut().zip(common).for_each(|(sum, common)| *sum += common);
            std::array::from_fn(|k| if k < LOGARITHM / 2 { low[k] } else { high[k - LOGARITHM / 2] })
        })
    }

    /// The derivatives of logarithms, from those of the coefficients.
    pub(crate) fn derivatives(&self, coefficients: &[f64], held: &[Quantity]) -> Arc<[Logarithms]> {
        self.pieces(&fours(coefficients, held)).collect()
    }

    /// The quantities themselves, with `es` in those that are scaled by it.
    pub(crate) fn values(&self, coefficients: &[f64], held: &[Quantity], es: f64) -> Arc<[Values]> {
        let scales = Quantity::ALL.map(|quantity| quantity.scale(es));
        self.pieces(&fours(coefficients, held)).map(|logarithms| exponential(&logarithms, scales)).collect()
    }

    /// The largest relative difference of a curve's pieces from its splines, between the samples.
    fn error(&self, basis: &Basis, range: [f64; 2], held: &[Quantity], coefficients: &[f64]) -> f64 {
        let pieces = self.values(coefficients, held, 1.0);
        let rows = fours(coefficients, held);
        let mut largest = 0.0_f64;
        for (piece, values) in pieces.iter().enumerate() {
            let samples = samples(self.grid.ends(piece), range.map(|x| x * self.grid.factor));
            for y in samples.windows(2).map(|pair| pair[0].midpoint(pair[1])) {
                let x = (y / self.grid.factor).clamp(range[0], range[1]);
                let place = self.grid.place(x);
                if place.piece != piece {
                    continue;
                }
                let splines = basis.weights(Parameter::AOverT.coordinate(x));
                let sum = |quantity: usize| {
                    let values = splines.values[..splines.count].iter().zip(&rows[splines.first..]);
                    values.map(|(value, row)| value * row[quantity]).sum::<f64>()
                };
                let miss = |quantity: usize| (one(values, place, quantity) / sum(quantity).exp() - 1.0).abs();
                largest = (0..4).map(miss).fold(largest, f64::max);
            }
        }
        largest
    }
}

/// One row of four for each coefficient; 0 for a quantity that is not held.
fn fours(coefficients: &[f64], held: &[Quantity]) -> Vec<Four> {
    if let Ok(all) = <[Quantity; 4]>::try_from(held) {
        debug_assert_eq!(all, Quantity::ALL);
        return coefficients.as_chunks().0.to_vec();
    }
    let row = |group: &[f64]| {
        let mut row = [0.0; 4];
        held.iter().zip(group).for_each(|(&quantity, &value)| row[quantity as usize] = value);
        row
    };
    coefficients.chunks_exact(held.len()).map(row).collect()
}

/// The Chebyshev points of the second kind on a piece. One that sticks out of the range is moved into it as a whole, so that nothing is taken from beyond.
fn samples([from, to]: [f64; 2], range: [f64; 2]) -> [f64; LOGARITHM] {
    let length = to - from;
    let from = from.min(range[1] - length).max(range[0]);
    let to = (from + length).min(range[1]);
    std::array::from_fn(|i| {
        let place = 0.5 - 0.5 * (std::f64::consts::PI * i as f64 / (LOGARITHM - 1) as f64).cos();
        (from + (to - from) * place).clamp(range[0], range[1])
    })
}

/// The polynomials that are 1 at one of the places and 0 at the others, as coefficients of powers; the first alone, a constant, if there is but one place.
fn lagrange(places: [f64; LOGARITHM]) -> [[f64; LOGARITHM]; LOGARITHM] {
    if places[0] == places[LOGARITHM - 1] {
        return std::array::from_fn(|i| std::array::from_fn(|k| if i == 0 && k == 0 { 1.0 } else { 0.0 }));
    }
    std::array::from_fn(|i| {
        let mut polynomial = [0.0; LOGARITHM];
        polynomial[0] = 1.0;
        for other in places.iter().enumerate().filter(|&(j, _)| j != i).map(|(_, &place)| place) {
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

/// The first terms of the exponential of a polynomial, times a scale: of `v = e^p`, `v' = p' v`.
fn exponential(logarithms: &Logarithms, scales: Four) -> Values {
    let mut values = [[0.0; 4]; VALUE];
    values[0] = std::array::from_fn(|q| scales[q] * logarithms[0][q].exp());
    // Two quantities at a time stay in registers.
    for pair in [0, 2] {
        let slopes: [[f64; 2]; LOGARITHM] = std::array::from_fn(|j| std::array::from_fn(|q| j as f64 * logarithms[j][pair + q]));
        let mut sums = [[0.0; 2]; VALUE];
        sums[0] = [values[0][pair], values[0][pair + 1]];
        for k in 0..VALUE {
            if k > 0 {
                sums[k] = sums[k].map(|sum| sum * (1.0 / k as f64));
                values[k][pair..pair + 2].copy_from_slice(&sums[k]);
            }
            for j in 1..LOGARITHM.min(VALUE - k) {
                for q in 0..2 {
                    sums[k + j][q] += slopes[j][q] * sums[k][q];
                }
            }
        }
    }
    values
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_x_is_on_its_piece() {
        for (range, bits) in [([1e-3, 1e3], 2), ([0.7, 0.71], 6), ([1e-30, 1e30], 3), ([1.0, 2.0], 4), ([3.0, 3.0], 2)] {
            let grid = Grid::over(range, bits);
            let covered = |piece: usize, part: fn(f64, [f64; 2]) -> f64, end: f64| {
                let ends = grid.ends(piece);
                part(end * grid.factor, ends) / (ends[1] - ends[0])
            };
            if range[0] < range[1] {
                assert!(covered(0, |y, ends| ends[1] - y, range[0]) > 0.25);
                assert!(covered(grid.count - 1, |y, ends| y - ends[0], range[1]) > 0.25);
            }
            for i in 0..=1000 {
                let x = (range[0] * (range[1] / range[0]).powf(f64::from(i) / 1000.0)).clamp(range[0], range[1]);
                let Place { piece, t } = grid.place(x);
                assert!(piece < grid.count && (-1.0..1.0).contains(&t), "{x}: piece {piece} of {}, t = {t}", grid.count);
                let [from, to] = grid.ends(piece);
                let y = x * grid.factor;
                assert!((from..to).contains(&y), "{y} in {from} .. {to}");
                let back = from.midpoint(to) + 0.5 * (to - from) * t;
                assert!((back / y - 1.0).abs() < 1e-15, "{x}: {back}");
                assert!((grid.logarithmic_speed(x) * (to - from) / (2.0 * y) - 1.0).abs() < 1e-15, "{x}");
            }
        }
    }

    #[test]
    fn the_exponential_is_that_of_the_polynomial() {
        // Terms that fall by twenty, as on a piece.
        let logarithms: Logarithms = std::array::from_fn(|k| std::array::from_fn(|q| (q as f64 - 1.7) * 0.05_f64.powi(k as i32)));
        let values = exponential(&logarithms, [2.0, 1.0, 1.0, 3.0]);
        for t in [-1.0, -0.3, 0.0, 0.5, 1.0] {
            let place = Place { piece: 0, t };
            for (q, scale) in [2.0, 1.0, 1.0, 3.0].into_iter().enumerate() {
                let expected = scale * one(&logarithms, place, q).exp();
                assert!((one(&values, place, q) / expected - 1.0).abs() < 1e-11, "{t}: {} {expected}", one(&values, place, q));
            }
        }
    }
}
