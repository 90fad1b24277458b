//! From splines over `ln(a/t)` to polynomials on pieces of `a/t`.
//!
//! On a piece the logarithm of a quantity is a polynomial that is linear in the coefficients of its
//! spline. The polynomial of the quantity itself is the exponential of that one.

use std::borrow::Cow;
use std::sync::Arc;

use fearless_simd::prelude::*;
use fearless_simd::{Level, dispatch, f64x4, f64x8};

use crate::curve::bspline::Basis;
use crate::curve::derived::{Constants, Derivation};
use crate::curve::grid::{Grid, Position};
use crate::curve::piecewise::{LOGARITHM, Logarithms, Polynomial, VALUE, Values};
use crate::curve::series::{LANES, Lanes, Series, exp, exponential, transposed_lanes};
use crate::curve::thick_film::ThickFilm;
use crate::{Parameter, Quantity};

/// The linear map from the coefficients of a spline over `ln x` to the polynomials on the pieces of
/// a grid, made once for a table.
#[derive(Clone, Debug)]
pub(crate) struct Resampler {
    /// The pieces.
    pub(crate) grid: Arc<Grid>,
    /// The number of pieces.
    pieces: usize,
    /// The B-splines of the pieces, in groups. The last piece is repeated until its group is full.
    spans: Vec<Span>,
    /// The polynomials of the first B-splines on the pieces: a row for each B-spline of a group.
    weights: Vec<[[f64; LOGARITHM]; LANES]>,
    /// The polynomials of the further B-splines of pieces that have many more than others.
    rest: Vec<[f64; LOGARITHM]>,
    /// The quantities of a sphere whose splines are given.
    pub(crate) held: Vec<Quantity>,
    /// Whether the spline of `Delta1` is given after them.
    holds_cone: bool,
    /// What follows from `Gamma`, if it is the only quantity of a sphere that is held.
    pub(super) derivation: Option<Derivation>,
}

/// The polynomials of the quantities on all pieces of a curve.
#[derive(Clone, Debug)]
pub(crate) struct Pieces {
    pub(crate) values: Arc<[Values]>,
    /// The polynomials of `Delta1`, if it is held.
    pub(crate) cone: Option<Arc<[Polynomial]>>,
    /// The estimated relative error that the quantities derived from `Gamma` have where their
    /// integrals begin; none if no quantity is derived.
    pub(crate) start_error: Option<f64>,
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

impl Resampler {
    /// The largest number of vanishing B-splines in [`Self::weights`] of a piece, which takes memory.
    const MOST_VANISHING: usize = 4;

    /// Samples the B-splines of `basis` for the quantities `held` on `2^bits[i]` pieces in octave
    /// `i` of `range`.
    pub(super) fn new(basis: &Basis, range: [f64; 2], held: &[Quantity], bits: &[u32]) -> Self {
        let grid = Grid::over(range, bits);
        let samples = |ends: [f64; 2]| {
            let samples = chebyshev_points(ends, range.map(|x| x * grid.factor));
            let x = |y: f64| (y / grid.factor).clamp(range[0], range[1]);
            let splines = samples.map(|y| basis.weights(Parameter::AOverT.coordinate(x(y))));
            (samples, splines)
        };
        let (mut spans, mut all_weights, mut rest) = (Vec::new(), Vec::new(), Vec::new());
        let mut all_ends = grid.pieces(range[1]).map(|(_, ends)| ends).peekable();
        let (mut pieces, mut last) = (0, range);
        while all_ends.peek().is_some() {
            let ends: [[f64; 2]; LANES] = std::array::from_fn(|_| {
                if let Some(ends) = all_ends.next() {
                    (pieces, last) = (pieces + 1, ends);
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
                first: reach.map(|[first, _]| first.min(basis.len() - count)),
                count,
                start: all_weights.len(),
                rest: [[0; 2]; LANES],
            };
            all_weights.resize(span.start + count, [[0.0; LOGARITHM]; LANES]);
            for (lane, (ends, (samples, splines))) in ends.iter().zip(&sampled).enumerate() {
                let polynomials =
                    lagrange(samples.map(|y| (2.0 * y - ends[0] - ends[1]) / (ends[1] - ends[0])));
                let further = rest.len();
                rest.resize(
                    further + counts[lane].saturating_sub(count),
                    [0.0; LOGARITHM],
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
        drop(all_ends);
        let (cone, held): (Vec<_>, Vec<_>) = held
            .iter()
            .partition(|&&quantity| quantity == Quantity::Delta1);
        let derivation = (held == [Quantity::Gamma]).then(|| Derivation::new(&grid, range));
        Self {
            grid: Arc::new(grid),
            pieces,
            spans,
            weights: all_weights,
            rest,
            held,
            holds_cone: !cone.is_empty(),
            derivation: derivation.flatten(),
        }
    }

    /// Splits coefficients into those of the quantities of a sphere and, if it is held, those of
    /// `Delta1`.
    fn split<'a>(&self, coefficients: &'a [f64]) -> (Cow<'a, [f64]>, Option<Vec<f64>>) {
        if !self.holds_cone {
            return (Cow::Borrowed(coefficients), None);
        }
        let count = self.held.len();
        let groups = coefficients.chunks_exact(count + 1);
        let cone = groups.clone().map(|group| group[count]).collect();
        let sphere = groups.flat_map(|group| &group[..count]).copied().collect();
        (sphere, Some(cone))
    }

    /// Returns the number of pieces.
    pub(super) fn pieces(&self) -> usize {
        self.pieces
    }

    /// Returns the polynomials of the B-splines on a piece, from the first one on.
    #[inline(always)]
    fn weights_on(&self, piece: usize) -> impl Iterator<Item = &[f64; LOGARITHM]> {
        let (span, lane) = (&self.spans[piece / LANES], piece % LANES);
        let [from, to] = span.rest[lane];
        let first = self.weights[span.start..][..span.count].iter();
        first.map(move |row| &row[lane]).chain(&self.rest[from..to])
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
        let (span, lane) = (&self.spans[piece / LANES], piece % LANES);
        let coefficients = &coefficients[span.first[lane]..];
        // B-splines add up to one: a common part of the coefficients can be added at the end.
        // Without it the sums are small, and so is their rounding, which powers of `t` magnify.
        let common = f64x4::from_slice(simd, &coefficients[span.count / 2]);
        let mut logarithms = [f64x4::splat(simd, 0.0); LOGARITHM];
        for (weights, coefficients) in self.weights_on(piece).zip(coefficients) {
            let coefficients = f64x4::from_slice(simd, coefficients) - common;
            for (sum, &weight) in logarithms.iter_mut().zip(weights) {
                *sum = coefficients.mul_add(f64x4::splat(simd, weight), *sum);
            }
        }
        logarithms[0] += common;
        logarithms
    }

    /// Returns the polynomials of the logarithm of a single quantity on a group of pieces, from the
    /// coefficients of its spline.
    #[inline(always)]
    fn logarithms_on_group<S: Simd>(
        &self,
        simd: S,
        group: usize,
        coefficients: &[f64],
    ) -> Series<Lanes<S>, LOGARITHM> {
        let span = &self.spans[group];
        let weights = &self.weights[span.start..][..span.count];
        let mut own = [&coefficients[..0]; LANES];
        let mut common = [0.0; LANES];
        for lane in 0..LANES {
            own[lane] = &coefficients[span.first[lane]..][..span.count];
            common[lane] = own[lane][span.count / 2];
        }
        // The pieces side by side, because a sum must wait for the addition before.
        let mut rows = [f64x8::splat(simd, 0.0); LANES];
        for (i, weights) in weights.iter().enumerate() {
            for lane in 0..LANES {
                let coefficient = f64x8::splat(simd, own[lane][i] - common[lane]);
                let weights = f64x8::from_slice(simd, &weights[lane]);
                rows[lane] = coefficient.mul_add(weights, rows[lane]);
            }
        }
        for lane in 0..LANES {
            let [from, to] = span.rest[lane];
            let coefficients = &coefficients[span.first[lane] + span.count..];
            for (weights, coefficient) in self.rest[from..to].iter().zip(coefficients) {
                let coefficient = f64x8::splat(simd, coefficient - common[lane]);
                let weights = f64x8::from_slice(simd, weights);
                rows[lane] = coefficient.mul_add(weights, rows[lane]);
            }
        }
        let mut logarithms = transposed_lanes(rows);
        logarithms[0] += Lanes::simd_from(simd, common);
        logarithms
    }

    /// Returns the polynomial of the logarithm of a single quantity on a piece.
    #[inline(always)]
    fn logarithm<S: Simd>(&self, simd: S, piece: usize, coefficients: &[f64]) -> f64x8<S> {
        let (span, lane) = (&self.spans[piece / LANES], piece % LANES);
        let coefficients = &coefficients[span.first[lane]..];
        // As in `logarithms`.
        let common = coefficients[span.count / 2];
        let mut logarithm = f64x8::splat(simd, 0.0);
        for (weights, coefficient) in self.weights_on(piece).zip(coefficients) {
            let coefficient = f64x8::splat(simd, coefficient - common);
            logarithm = coefficient.mul_add(f64x8::from_slice(simd, weights), logarithm);
        }
        logarithm[0] += common;
        logarithm
    }

    /// Returns the values of the spline of a single quantity where the integrals of the derived
    /// quantities begin.
    #[inline(always)]
    fn at_starts<S: Simd>(
        &self,
        simd: S,
        derivation: &Derivation,
        coefficients: &[f64],
    ) -> [f64; 3] {
        let mut values = [0.0; 3];
        for (value, &Position { piece, t }) in values.iter_mut().zip(&derivation.starts) {
            let (low, high) = self.logarithm(simd, piece, coefficients).split();
            let fourth = f64x4::splat(simd, t * t * t * t);
            let [constant, linear, quadratic, cubic] = *high.mul_add(fourth, low).as_array();
            *value = constant + t * (linear + t * (quadratic + t * cubic));
        }
        values
    }

    /// Returns the polynomials of the derivatives of the logarithms with respect to three
    /// parameters, from the coefficients and their derivatives.
    pub(crate) fn derivatives(
        &self,
        coefficients: &[f64],
        derivatives: [&[f64]; 3],
    ) -> [Arc<[Logarithms]>; 3] {
        let mut pieces = [(); 3].map(|()| zeros(self.pieces));
        let derivatives = derivatives.map(|coefficients| self.split(coefficients).0);
        if let Some(derivation) = &self.derivation {
            let (coefficients, _) = self.split(coefficients);
            let derivatives = derivatives.each_ref().map(|coefficients| &**coefficients);
            dispatch!(Level::new(), simd => {
                self.derived_derivatives(simd, derivation, &coefficients, derivatives, &mut pieces);
            });
            return pieces;
        }
        for (coefficients, pieces) in derivatives.iter().zip(&mut pieces) {
            let rows = rows_of_four(coefficients, &self.held);
            dispatch!(Level::new(), simd => {
                for (i, piece) in Arc::make_mut(pieces).iter_mut().enumerate() {
                    for (row, logarithms) in piece.iter_mut().zip(self.logarithms(simd, i, &rows)) {
                        logarithms.store_slice(row);
                    }
                }
            });
        }
        pieces
    }

    /// Returns the polynomials of the derivatives of `ln Delta1` with respect to three parameters,
    /// from the derivatives of the coefficients; none if it is not held.
    pub(crate) fn derivatives_of_cone(
        &self,
        derivatives: [&[f64]; 3],
    ) -> Option<[Arc<[[f64; LOGARITHM]]>; 3]> {
        self.holds_cone.then(|| {
            derivatives.map(|coefficients| {
                let cone = self.split(coefficients).1.unwrap_or_default();
                let mut pieces = Vec::with_capacity(LANES * self.spans.len());
                dispatch!(Level::new(), simd => {
                    for group in 0..self.spans.len() {
                        pieces.extend(by_lane(self.logarithms_on_group(simd, group, &cone)));
                    }
                });
                pieces.truncate(self.pieces);
                pieces.into()
            })
        })
    }

    /// Returns the polynomials of `Delta1`; none if it is not held.
    pub(super) fn cone(&self, coefficients: &[f64]) -> Option<Arc<[Polynomial]>> {
        let (_, cone) = self.split(coefficients);
        let cone = cone?;
        let mut pieces = Vec::with_capacity(LANES * self.spans.len());
        dispatch!(Level::new(), simd => {
            for group in 0..self.spans.len() {
                let logarithms = self.logarithms_on_group(simd, group, &cone);
                let middle = exp(simd, logarithms[0]);
                pieces.extend(by_lane(exponential(simd, middle, 1.0, &logarithms)));
            }
        });
        pieces.truncate(self.pieces);
        Some(pieces.into())
    }

    /// Returns the polynomials of the quantities themselves; `es` is the sphere-film modulus of
    /// their [scales](Quantity::scale).
    pub(crate) fn values(&self, coefficients: &[f64], es: f64) -> Pieces {
        let cone = self.cone(coefficients);
        let (coefficients, _) = self.split(coefficients);
        if let Some(derivation) = &self.derivation {
            return dispatch!(Level::new(), simd => {
                let start = self.thick_film(simd, derivation, &coefficients);
                let constants = Constants::Running(derivation.at_start(start.values()));
                Pieces {
                    values: self.derived(simd, derivation, &coefficients, es, constants),
                    cone,
                    start_error: Some(start.error),
                }
            });
        }
        let scales = Quantity::ALL.map(|quantity| quantity.scale(es));
        let rows = rows_of_four(&coefficients, &self.held);
        let mut pieces = zeros(self.pieces);
        dispatch!(Level::new(), simd => {
            for (i, piece) in Arc::make_mut(&mut pieces).iter_mut().enumerate() {
                exponentials(simd, self.logarithms(simd, i, &rows), scales, piece);
            }
        });
        let begins_nowhere = self.held == [Quantity::Gamma];
        Pieces {
            values: pieces,
            cone,
            start_error: begins_nowhere.then_some(f64::INFINITY),
        }
    }

    /// Returns the polynomials of the quantities that follow from the spline of `Gamma`, see
    /// [`Derivation::integrals`].
    #[inline(always)]
    fn derived<S: Simd>(
        &self,
        simd: S,
        derivation: &Derivation,
        coefficients: &[f64],
        es: f64,
        mut constants: Constants<'_>,
    ) -> Arc<[Values]> {
        let mut pieces = zeros(self.pieces);
        let mut last = [[[0.0; 4]; VALUE]; LANES];
        let all = Arc::make_mut(&mut pieces);
        for group in 0..derivation.groups() {
            let logarithms = self.logarithms_on_group(simd, group, coefficients);
            let integrals = derivation.integrals(simd, group, &logarithms, &mut constants);
            let own = all[LANES * group..].first_chunk_mut().unwrap_or(&mut last);
            derivation.values(simd, group, &logarithms, integrals, es, own);
        }
        complete(all, &last);
        pieces
    }

    /// Writes the polynomials of the derivatives of the logarithms of the quantities that follow
    /// from the spline of `Gamma`, see [`Derivation::sensitivities`].
    #[inline(always)]
    fn derived_derivatives<S: Simd>(
        &self,
        simd: S,
        derivation: &Derivation,
        coefficients: &[f64],
        derivatives: [&[f64]; 3],
        pieces: &mut [Arc<[Logarithms]>; 3],
    ) {
        let start = self.thick_film(simd, derivation, coefficients);
        let mut constants = Constants::Running(derivation.at_start(start.values()));
        let mut of_derivatives = [constants; 3];
        for (constants, coefficients) in of_derivatives.iter_mut().zip(derivatives) {
            let [first, second, _] = self.at_starts(simd, derivation, coefficients);
            let start = start.derivatives([first, second]);
            *constants = Constants::Running(derivation.at_start(start));
        }
        let mut last = [[[[0.0; 4]; LOGARITHM]; LANES]; 3];
        for group in 0..derivation.groups() {
            let logarithms = self.logarithms_on_group(simd, group, coefficients);
            let integrals = derivation.integrals(simd, group, &logarithms, &mut constants);
            for i in 0..3 {
                let gamma = self.logarithms_on_group(simd, group, derivatives[i]);
                let all = Arc::make_mut(&mut pieces[i]);
                let own = all[LANES * group..]
                    .first_chunk_mut()
                    .unwrap_or(&mut last[i]);
                let constants = &mut of_derivatives[i];
                derivation.sensitivities(simd, group, &integrals, &gamma, constants, own);
            }
        }
        for (pieces, last) in pieces.iter_mut().zip(&last) {
            complete(Arc::make_mut(pieces), last);
        }
    }

    /// Returns the quantities where the integrals begin.
    #[inline(always)]
    fn thick_film<S: Simd>(
        &self,
        simd: S,
        derivation: &Derivation,
        coefficients: &[f64],
    ) -> ThickFilm {
        ThickFilm::new(self.at_starts(simd, derivation, coefficients).map(f64::exp))
    }

    /// Returns the polynomials of the derived quantities over their scales. The integrals have the
    /// given values at the beginning of each piece.
    pub(super) fn derived_from(
        &self,
        derivation: &Derivation,
        coefficients: &[f64],
        beginnings: &[[f64; 3]],
    ) -> Arc<[Values]> {
        let (coefficients, _) = self.split(coefficients);
        dispatch!(Level::new(), simd => {
            let constants = Constants::Given(beginnings);
            self.derived(simd, derivation, &coefficients, 1.0, constants)
        })
    }
}

/// Returns a row of all four quantities for each B-spline, with 0 for a quantity that is not held.
pub(super) fn rows_of_four<'a>(coefficients: &'a [f64], held: &[Quantity]) -> Cow<'a, [[f64; 4]]> {
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
pub(super) fn chebyshev_points([from, to]: [f64; 2], range: [f64; 2]) -> [f64; LOGARITHM] {
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

/// Computes the first terms of the exponentials of the polynomials of four quantities, times their
/// scales.
#[inline(always)]
fn exponentials<S: Simd>(
    simd: S,
    logarithms: [f64x4<S>; LOGARITHM],
    scales: [f64; 4],
    values: &mut Values,
) {
    let constant = logarithms[0].as_array();
    let constant = std::array::from_fn(|q| scales[q] * constant[q].exp());
    let terms: [f64x4<S>; VALUE] =
        exponential(simd, f64x4::simd_from(simd, constant), 1.0, &logarithms);
    for (value, term) in values.iter_mut().zip(terms) {
        term.store_slice(value);
    }
}

/// Returns the coefficients of a series on several pieces, piece by piece.
#[inline(always)]
fn by_lane<S: Simd, const N: usize>(series: Series<Lanes<S>, N>) -> [[f64; N]; LANES] {
    let mut pieces = [[0.0; N]; LANES];
    for (k, term) in series.iter().enumerate() {
        for (piece, value) in pieces.iter_mut().zip(term.as_array()) {
            piece[k] = *value;
        }
    }
    pieces
}

/// Returns polynomials of zero on `pieces` pieces.
fn zeros<const N: usize>(pieces: usize) -> Arc<[[[f64; 4]; N]]> {
    (0..pieces).map(|_| [[0.0; 4]; N]).collect()
}

/// Copies the pieces of the last group, if it is not full.
fn complete<const N: usize>(all: &mut [[[f64; 4]; N]], last: &[[[f64; 4]; N]; LANES]) {
    let (_, rest) = all.as_chunks_mut::<LANES>();
    rest.copy_from_slice(&last[..rest.len()]);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::curve::piecewise::evaluate;

    #[test]
    fn the_exponential_is_that_of_the_polynomial() {
        // Terms that fall by twenty, as on a piece.
        let logarithms: Logarithms = std::array::from_fn(|k| {
            std::array::from_fn(|q| (q as f64 - 1.7) * 0.05_f64.powi(k as i32))
        });
        let mut values = [[0.0; 4]; VALUE];
        dispatch!(Level::new(), simd => {
            let logarithms = logarithms.map(|row| f64x4::simd_from(simd, row));
            exponentials(simd, logarithms, [2.0, 1.0, 1.0, 3.0], &mut values)
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
