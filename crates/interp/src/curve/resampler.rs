//! From splines over `ln(a/t)` to polynomials on pieces of `a/t`.
//!
//! On a piece the logarithm of a quantity is a polynomial that is linear in the coefficients of its
//! spline. The polynomial of the quantity itself is the exponential of that one.

use std::borrow::Cow;
use std::sync::Arc;

use fearless_simd::prelude::*;
use fearless_simd::{Level, dispatch, f64x4};
use low_rank::bspline::Basis;

use crate::Quantity;
use crate::curve::derived::{Constants, Derivation};
use crate::curve::grid::{Grid, Position};
use crate::curve::piecewise::{LOGARITHM, Logarithms, VALUE, Values};
use crate::curve::series::{LANES, exponential};
use crate::curve::spans::Spans;
use crate::curve::thick_film::ThickFilm;

/// The linear map from the coefficients of a spline over `ln x` to the polynomials on the pieces of
/// a grid, made once for a table.
#[derive(Clone, Debug)]
pub(crate) struct Resampler {
    /// The binary logarithm of the number of pieces in each octave.
    pub(crate) bits: Vec<u32>,
    /// The pieces.
    pub(crate) grid: Arc<Grid>,
    /// The B-splines on the pieces.
    spans: Spans,
    /// The quantities whose splines are given.
    pub(crate) held: Vec<Quantity>,
    /// What follows from `Gamma`, if it is the only quantity that is held.
    pub(super) derivation: Option<Derivation>,
}

/// The polynomials of the quantities on all pieces of a curve.
#[derive(Clone, Debug)]
pub(crate) struct Pieces {
    pub(crate) values: Arc<[Values]>,
    /// The estimated relative error that the quantities derived from `Gamma` have where their
    /// integrals begin; none if no quantity is derived.
    pub(crate) start_error: Option<f64>,
}

/// The derivatives of the derived quantities with respect to one parameter.
struct ParameterDerivatives<'a> {
    /// The derivatives of the coefficients.
    coefficients: &'a [f64],
    /// The derivatives of the integrals where the next group of pieces begins.
    constants: Constants<'a>,
    /// The result on all pieces.
    all: &'a mut [Logarithms],
    /// The result on the last group of pieces, if it is not full.
    last: [Logarithms; LANES],
}

impl Resampler {
    /// Samples the B-splines of `basis` for the quantities `held` on `2^bits[i]` pieces in octave
    /// `i` of `range`.
    pub(crate) fn new(basis: &Basis, range: [f64; 2], held: &[Quantity], bits: &[u32]) -> Self {
        let grid = Grid::over(range, bits);
        let spans = Spans::new(basis, &grid, range);
        let derivation = (held == [Quantity::Gamma]).then(|| Derivation::new(&grid, range));
        Self {
            bits: bits.to_vec(),
            grid: Arc::new(grid),
            spans,
            held: held.to_vec(),
            derivation: derivation.flatten(),
        }
    }

    /// Returns the number of pieces.
    pub(super) fn pieces(&self) -> usize {
        self.spans.pieces()
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
            let (low, high) = self.spans.logarithm(simd, piece, coefficients).split();
            let fourth = f64x4::splat(simd, t * t * t * t);
            let [constant, linear, quadratic, cubic] = *high.mul_add(fourth, low).as_array();
            *value = constant + t * (linear + t * (quadratic + t * cubic));
        }
        values
    }

    /// Returns the polynomials of the quantities themselves; `es` is the sphere-film modulus of
    /// their [scales](Quantity::scale).
    pub(crate) fn values(&self, coefficients: &[f64], es: f64) -> Pieces {
        let (pieces, []) = self.values_and_derivatives(coefficients, [], es);
        pieces
    }

    /// Returns the polynomials of the quantities, and those of the derivatives of their logarithms
    /// with respect to `N` parameters, from the coefficients and their derivatives.
    pub(crate) fn values_and_derivatives<const N: usize>(
        &self,
        coefficients: &[f64],
        derivatives: [&[f64]; N],
        es: f64,
    ) -> (Pieces, [Arc<[Logarithms]>; N]) {
        let mut of_derivatives = [(); N].map(|()| zeros(self.pieces()));
        let (values, start_error) = if let Some(derivation) = &self.derivation {
            let of_derivatives = of_derivatives.each_mut().map(Arc::make_mut);
            dispatch!(Level::new(), simd => {
                let (values, error) =
                    self.derive(simd, derivation, coefficients, derivatives, es, of_derivatives);
                (values, Some(error))
            })
        } else {
            for (coefficients, pieces) in derivatives.into_iter().zip(&mut of_derivatives) {
                let rows = rows_of_four(coefficients, &self.held);
                dispatch!(Level::new(), simd => {
                    for (i, piece) in Arc::make_mut(pieces).iter_mut().enumerate() {
                        let logarithms = self.spans.logarithms(simd, i, &rows);
                        for (row, term) in piece.iter_mut().zip(logarithms) {
                            term.store_slice(row);
                        }
                    }
                });
            }
            let begins_nowhere = self.held == [Quantity::Gamma];
            let start_error = begins_nowhere.then_some(f64::INFINITY);
            (self.exponentials_on_pieces(coefficients, es), start_error)
        };
        let pieces = Pieces {
            values,
            start_error,
        };
        (pieces, of_derivatives)
    }

    /// Returns the polynomials of the quantities whose splines are given.
    fn exponentials_on_pieces(&self, coefficients: &[f64], es: f64) -> Arc<[Values]> {
        let scales = Quantity::ALL.map(|quantity| quantity.scale(es));
        let rows = rows_of_four(coefficients, &self.held);
        let mut pieces = zeros(self.pieces());
        dispatch!(Level::new(), simd => {
            for (i, piece) in Arc::make_mut(&mut pieces).iter_mut().enumerate() {
                exponentials(simd, self.spans.logarithms(simd, i, &rows), scales, piece);
            }
        });
        pieces
    }

    /// Returns the polynomials of the quantities that follow from the spline of `Gamma`, with the
    /// error of the integrals where they begin; writes those of the derivatives of their logarithms.
    #[inline(always)]
    fn derive<S: Simd, const N: usize>(
        &self,
        simd: S,
        derivation: &Derivation,
        coefficients: &[f64],
        derivatives: [&[f64]; N],
        es: f64,
        of_derivatives: [&mut [Logarithms]; N],
    ) -> (Arc<[Values]>, f64) {
        let starts = self.at_starts(simd, derivation, coefficients);
        let start = ThickFilm::new(starts.map(f64::exp));
        let mut parameters = of_derivatives.map(|all| ParameterDerivatives {
            coefficients: &[],
            constants: Constants::Running([0.0; 3]),
            all,
            last: [[[0.0; 4]; LOGARITHM]; LANES],
        });
        for (parameter, coefficients) in parameters.iter_mut().zip(derivatives) {
            let [first, second, _] = self.at_starts(simd, derivation, coefficients);
            parameter.coefficients = coefficients;
            let start = start.derivatives([first, second]);
            parameter.constants = Constants::Running(derivation.at_start(start));
        }
        let constants = Constants::Running(derivation.at_start(start.values()));
        let pieces = self.derived(
            simd,
            derivation,
            coefficients,
            es,
            constants,
            &mut parameters,
        );
        (pieces, start.error)
    }

    /// Returns the polynomials of the quantities that follow from the spline of `Gamma`, see
    /// [`Derivation::integrals`]; writes those of the derivatives of their logarithms, see
    /// [`Derivation::sensitivities`].
    #[inline(always)]
    fn derived<S: Simd, const N: usize>(
        &self,
        simd: S,
        derivation: &Derivation,
        coefficients: &[f64],
        es: f64,
        mut constants: Constants<'_>,
        parameters: &mut [ParameterDerivatives<'_>; N],
    ) -> Arc<[Values]> {
        let mut pieces = zeros(self.pieces());
        let mut last = [[[0.0; 4]; VALUE]; LANES];
        let all = Arc::make_mut(&mut pieces);
        for group in 0..derivation.groups() {
            let logarithms = self.spans.logarithms_on_group(simd, group, coefficients);
            let integrals = derivation.integrals(simd, group, &logarithms, &mut constants);
            for parameter in parameters.iter_mut() {
                let ParameterDerivatives {
                    coefficients,
                    constants,
                    all,
                    last,
                } = parameter;
                let gamma = self.spans.logarithms_on_group(simd, group, coefficients);
                let own = all[LANES * group..].first_chunk_mut().unwrap_or(last);
                derivation.sensitivities(simd, group, &integrals, &gamma, constants, own);
            }
            let own = all[LANES * group..].first_chunk_mut().unwrap_or(&mut last);
            derivation.values(simd, group, &logarithms, integrals, es, own);
        }
        complete(all, &last);
        for parameter in parameters {
            complete(parameter.all, &parameter.last);
        }
        pieces
    }

    /// Returns the polynomials of the derived quantities over their scales. The integrals have the
    /// given values at the beginning of each piece.
    pub(super) fn derived_from(
        &self,
        derivation: &Derivation,
        coefficients: &[f64],
        beginnings: &[[f64; 3]],
    ) -> Arc<[Values]> {
        dispatch!(Level::new(), simd => {
            let constants = Constants::Given(beginnings);
            self.derived(simd, derivation, coefficients, 1.0, constants, &mut [])
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
