//! From splines over `ln x` to polynomials on the pieces of a grid.
//!
//! On a piece a spline is a polynomial that is linear in its coefficients. A function whose logarithm is
//! the spline is the exponential of that polynomial, which is a polynomial again.

use std::borrow::Cow;
use std::sync::Arc;

use fearless_simd::prelude::*;
use fearless_simd::{Level, dispatch, f64x4};

use crate::bspline::Basis;
use crate::functions::{Piecewise, Polynomials};
use crate::grid::{Grid, Position};
use crate::lanes::Lanes;
use crate::series::{Series, exponential};
use crate::spans::Spans;
use crate::{FUNCTION_TERMS, SPLINE_TERMS};

/// The linear map from the coefficients of splines over `ln x` to polynomials on the pieces of a grid,
/// made once for all splines of a [`Basis`].
#[derive(Clone, Debug)]
pub struct Resampler {
    /// The binary logarithm of the number of pieces in each octave.
    bits: Vec<u32>,
    grid: Arc<Grid>,
    spans: Spans,
    /// The places of the functions whose splines are given among four.
    functions: Vec<usize>,
}

impl Resampler {
    /// Samples the B-splines of `basis` over `ln x` on `2^bits[i]` pieces in octave `i` of `range`, for
    /// splines of these `functions` of four.
    ///
    /// # Panics
    /// As [`Grid::over`].
    pub fn new(basis: &Basis, range: [f64; 2], functions: &[usize], bits: &[u32]) -> Self {
        let grid = Grid::over(range, bits);
        Self {
            bits: bits.to_vec(),
            spans: Spans::new(basis, &grid),
            grid: Arc::new(grid),
            functions: functions.to_vec(),
        }
    }

    /// Returns the binary logarithm of the number of pieces in each octave.
    pub fn bits(&self) -> &[u32] {
        &self.bits
    }

    /// Returns the pieces.
    pub fn grid(&self) -> &Arc<Grid> {
        &self.grid
    }

    /// Returns the places of the functions whose splines are given among four.
    pub fn functions(&self) -> &[usize] {
        &self.functions
    }

    /// Returns the polynomials of the splines. `coefficients` holds a group of the functions for each
    /// B-spline; a function that is not given is 0.
    ///
    /// # Panics
    /// If there are fewer groups than B-splines.
    pub fn splines(&self, coefficients: &[f64]) -> Piecewise<SPLINE_TERMS> {
        let rows = self.rows_of_four(coefficients);
        let mut pieces = Vec::with_capacity(self.grid.count());
        dispatch!(Level::new(), simd => {
            let mut piece = [[0.0; 4]; SPLINE_TERMS];
            for i in 0..self.grid.count() {
                let splines = self.spans.on_piece(simd, i, &rows);
                for (row, term) in piece.iter_mut().zip(splines) {
                    term.store_slice(row);
                }
                pieces.push(piece);
            }
        });
        Piecewise::new(self.grid.clone(), pieces)
    }

    /// Returns the polynomials of the functions whose logarithms, after division by `scales`, are the
    /// splines. `coefficients` is that of [`Resampler::splines`].
    ///
    /// # Panics
    /// As [`Resampler::splines`].
    pub fn exponentials(
        &self,
        coefficients: &[f64],
        scales: [f64; 4],
    ) -> Piecewise<FUNCTION_TERMS> {
        let rows = self.rows_of_four(coefficients);
        let mut pieces = Vec::with_capacity(self.grid.count());
        dispatch!(Level::new(), simd => {
            let mut piece = [[0.0; 4]; FUNCTION_TERMS];
            for i in 0..self.grid.count() {
                let logarithms = self.spans.on_piece(simd, i, &rows);
                exponentials(simd, logarithms, scales, &mut piece);
                pieces.push(piece);
            }
        });
        Piecewise::new(self.grid.clone(), pieces)
    }

    /// Returns the polynomials of the spline of a single function on a group of
    /// [pieces](crate::lanes::LANES), from its coefficients. The last piece is repeated until its
    /// group is full.
    #[inline(always)]
    pub fn spline_on_group<S: Simd>(
        &self,
        simd: S,
        group: usize,
        coefficients: &[f64],
    ) -> Series<Lanes<S>, SPLINE_TERMS> {
        self.spans.single_on_group(simd, group, coefficients)
    }

    /// Returns the value of the spline of a single function, from its coefficients.
    #[inline(always)]
    pub fn spline_at<S: Simd>(
        &self,
        simd: S,
        Position { piece, t }: Position,
        coefficients: &[f64],
    ) -> f64 {
        let (low, high) = self
            .spans
            .single_on_piece(simd, piece, coefficients)
            .split();
        let fourth = f64x4::splat(simd, t * t * t * t);
        let [constant, linear, quadratic, cubic] = *high.mul_add(fourth, low).as_array();
        constant + t * (linear + t * (quadratic + t * cubic))
    }

    /// Returns a row of all four functions for each B-spline, with 0 for a function that is not given.
    fn rows_of_four<'a>(&self, coefficients: &'a [f64]) -> Cow<'a, [[f64; 4]]> {
        if self.functions == [0, 1, 2, 3] {
            return Cow::Borrowed(coefficients.as_chunks().0);
        }
        let row = |group: &[f64]| {
            let mut row = [0.0; 4];
            let given = self.functions.iter().zip(group);
            given.for_each(|(&function, &value)| row[function] = value);
            row
        };
        coefficients
            .chunks_exact(self.functions.len())
            .map(row)
            .collect()
    }
}

/// Computes the first terms of the exponentials of four polynomials, times `scales`.
#[inline(always)]
fn exponentials<S: Simd>(
    simd: S,
    logarithms: [f64x4<S>; SPLINE_TERMS],
    scales: [f64; 4],
    values: &mut Polynomials<FUNCTION_TERMS>,
) {
    let constant = logarithms[0].as_array();
    let constant = std::array::from_fn(|i| scales[i] * constant[i].exp());
    let terms: [f64x4<S>; FUNCTION_TERMS] =
        exponential(simd, f64x4::simd_from(simd, constant), 1.0, &logarithms);
    for (value, term) in values.iter_mut().zip(terms) {
        term.store_slice(value);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_exponential_is_that_of_the_polynomial() {
        // Terms that fall by twenty, as on a short piece.
        let logarithms: Polynomials<SPLINE_TERMS> = std::array::from_fn(|k| {
            std::array::from_fn(|i| (i as f64 - 1.7) * 0.05_f64.powi(k as i32))
        });
        let mut values = [[0.0; 4]; FUNCTION_TERMS];
        dispatch!(Level::new(), simd => {
            let logarithms = logarithms.map(|row| f64x4::simd_from(simd, row));
            exponentials(simd, logarithms, [2.0, 1.0, 1.0, 3.0], &mut values)
        });
        let grid = Arc::new(Grid::over([3.0, 3.0], &[0, 0]));
        let of = Piecewise::new(grid.clone(), vec![logarithms]);
        let values = Piecewise::new(grid, vec![values]);
        for t in [-1.0, -0.3, 0.0, 0.5, 1.0] {
            let position = Position { piece: 0, t };
            let (found, of) = (values.values_at(position), of.values_at(position));
            for (i, scale) in [2.0, 1.0, 1.0, 3.0].into_iter().enumerate() {
                let expected = scale * of[i].exp();
                assert!(
                    (found[i] / expected - 1.0).abs() < 1e-11,
                    "{t}: {} {expected}",
                    found[i]
                );
            }
        }
    }
}
