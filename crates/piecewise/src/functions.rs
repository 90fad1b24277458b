//! Four functions of one variable as polynomials on the pieces of a grid: their values, derivatives
//! and bounds.

use std::ops::RangeInclusive;
use std::sync::Arc;

use fearless_simd::prelude::*;
use fearless_simd::{Level, dispatch, f64x2, f64x4};

use crate::grid::{Grid, Position};

/// The polynomials of four functions on one piece: a row of their coefficients for each of
/// `1, t, t^2, ...`, with the position `t` from -1 to 1.
pub type Polynomials<const N: usize> = [[f64; 4]; N];

/// Four functions of `x`, as polynomials with `N` coefficients on the pieces of a [`Grid`].
///
/// Four numbers fill the vectors of most processors; functions that are not needed are 0. An `x` must be
/// in the range of the grid. A clone shares the pieces.
#[derive(Clone, Debug)]
pub struct Piecewise<const N: usize> {
    grid: Arc<Grid>,
    pieces: Arc<Vec<Polynomials<N>>>,
}

/// Its evaluations are inlined: a caller that needs some of the functions computes no others.
impl<const N: usize> Piecewise<N> {
    /// Takes the polynomials on the pieces of `grid`. `N` must be even.
    ///
    /// # Panics
    /// If the number of pieces is not that of the grid.
    pub fn new(grid: Arc<Grid>, pieces: Vec<Polynomials<N>>) -> Self {
        const {
            assert!(
                N >= 2 && N.is_multiple_of(2),
                "the terms are added in pairs"
            )
        };
        assert_eq!(pieces.len(), grid.count(), "pieces of another grid");
        Self {
            grid,
            pieces: Arc::new(pieces),
        }
    }

    /// Returns the grid.
    #[inline]
    pub fn grid(&self) -> &Arc<Grid> {
        &self.grid
    }

    /// Returns the polynomials on the pieces.
    #[inline]
    pub fn pieces(&self) -> &[Polynomials<N>] {
        &self.pieces
    }

    /// Returns the value of one of the four functions at `x`.
    #[inline(always)]
    pub fn value(&self, function: usize, x: f64) -> f64 {
        self.value_at(function, self.grid.locate(x))
    }

    /// Returns the value of one of the four functions at a position on the grid.
    #[inline(always)]
    pub fn value_at(&self, function: usize, position: Position) -> f64 {
        evaluate(&self.pieces[position.piece], position, function)
    }

    /// Writes the value of a function at each `x` to `values`, in the order given; where `x` is outside
    /// the range that of `outside`.
    ///
    /// The values are those of [`Self::value`] except for rounding, in two thirds of the time.
    ///
    /// # Errors
    /// The first of `outside`; the values before it are written.
    ///
    /// # Panics
    /// If there is no such function.
    #[inline]
    pub fn value_at_all<E>(
        &self,
        function: usize,
        x: &[f64],
        values: &mut [f64],
        outside: impl Fn(f64) -> Result<f64, E>,
    ) -> Result<(), E> {
        let (grid, pieces, [from, to]) = (&*self.grid, &self.pieces[..], self.grid.range());
        dispatch!(Level::new(), simd => {
            // Once, not for each coefficient.
            assert!(function < 4, "there are four functions");
            for (value, &x) in values.iter_mut().zip(x) {
                *value = if x >= from && x <= to {
                    let position = grid.locate(x);
                    evaluate_fused(simd, &pieces[position.piece], position, function)
                } else {
                    outside(x)?
                };
            }
            Ok(())
        })
    }

    /// Returns the values of all four functions at `x`.
    #[inline(always)]
    pub fn values(&self, x: f64) -> [f64; 4] {
        self.values_at(self.grid.locate(x))
    }

    /// Returns the values of all four functions at a position on the grid.
    #[inline(always)]
    pub fn values_at(&self, position: Position) -> [f64; 4] {
        let piece = &self.pieces[position.piece];
        std::array::from_fn(|function| evaluate(piece, position, function))
    }

    /// Returns the values of all four functions at `x`, and their logarithmic slopes `x df/dx`.
    #[inline]
    pub fn values_and_slopes(&self, x: f64) -> [[f64; 4]; 2] {
        let (position, speed) = (self.grid.locate(x), self.grid.logarithmic_speed(x));
        dispatch!(Level::new(), simd => {
            let [values, derivatives] = self.values_and_derivatives(simd, position);
            [*values.as_array(), *(derivatives * speed).as_array()]
        })
    }

    /// Returns the values of all four functions at a position on the grid, side by side.
    #[inline(always)]
    pub fn values_side_by_side<S: Simd>(&self, simd: S, position: Position) -> f64x4<S> {
        let piece = &self.pieces[position.piece];
        let t = f64x4::splat(simd, position.t);
        let square = t * t;
        let mut sum = f64x4::splat(simd, 0.0);
        for pair in piece.as_chunks::<2>().0.iter().rev() {
            let [even, odd] = [0, 1].map(|i| f64x4::from_slice(simd, &pair[i]));
            sum = sum.mul_add(square, odd.mul_add(t, even));
        }
        sum
    }

    /// Returns the values of all four functions at a position on the grid, and their derivatives with
    /// respect to `t`, side by side.
    #[inline(always)]
    pub fn values_and_derivatives<S: Simd>(&self, simd: S, position: Position) -> [f64x4<S>; 2] {
        let t = f64x4::splat(simd, position.t);
        let square = t * t;
        // Sums over pairs of terms in `t^2`, the derivative of the first with respect to `t^2`, and the
        // derivatives of the pairs. The first has the rounding of `evaluate`.
        let [mut sum, mut rate, mut slopes] = [f64x4::splat(simd, 0.0); 3];
        for pair in self.pieces[position.piece].as_chunks::<2>().0.iter().rev() {
            let [even, odd] = [0, 1].map(|i| f64x4::from_slice(simd, &pair[i]));
            rate = rate.mul_add(square, sum);
            slopes = slopes.mul_add(square, odd);
            sum = sum * square + (even + odd * t);
        }
        [sum, rate.mul_add(t + t, slopes)]
    }

    /// Returns the value of a function at `x`, and its derivative with respect to `x`.
    #[inline]
    pub fn value_and_rate(&self, function: usize, x: f64) -> [f64; 2] {
        let position = self.grid.locate(x);
        let piece = &self.pieces[position.piece];
        let terms = piece.iter().rev().map(|row| row[function]);
        let [value, rate] = terms.fold([0.0; 2], |[value, rate], term| {
            [value * position.t + term, rate * position.t + value]
        });
        [value, rate * self.grid.logarithmic_speed(x) / x]
    }

    /// Returns one of the chosen `functions` that may leave `range`, with its value in the middle of the
    /// first piece on which it may; none if it is certain that all stay within.
    pub fn leaving(
        &self,
        range: &RangeInclusive<f64>,
        functions: [bool; 4],
    ) -> Option<(usize, f64)> {
        dispatch!(Level::new(), simd => {
            for piece in &*self.pieces {
                if !are_surely_within(simd, range, piece) {
                    let leaving = |&function: &usize| {
                        functions[function] && !is_within(range, &piece.map(|row| row[function]))
                    };
                    if let Some(function) = (0..4).find(leaving) {
                        return Some((function, piece[0][function]));
                    }
                }
            }
            None
        })
    }
}

/// Evaluates the polynomial of one function.
#[inline(always)]
fn evaluate<const N: usize>(piece: &Polynomials<N>, position: Position, function: usize) -> f64 {
    // Horner's scheme in `t^2` over pairs of terms: the chain of dependent operations is half as
    // long.
    let (t, square) = (position.t, position.t * position.t);
    let pair = |k: usize| piece[k][function] + piece[k + 1][function] * t;
    (0..N / 2 - 1)
        .rev()
        .fold(pair(N - 2), |sum, k| sum * square + pair(2 * k))
}

/// Evaluates as [`evaluate`], with fused multiplications and additions if the processor has them.
#[inline(always)]
fn evaluate_fused<S: Simd, const N: usize>(
    simd: S,
    piece: &Polynomials<N>,
    position: Position,
    function: usize,
) -> f64 {
    let number = |value: f64| f64x2::splat(simd, value);
    let (t, square) = (number(position.t), number(position.t * position.t));
    let pair = |k: usize| t.mul_add(number(piece[k + 1][function]), number(piece[k][function]));
    let mut sum = pair(N - 2);
    for k in (0..N / 2 - 1).rev() {
        sum = sum.mul_add(square, pair(2 * k));
    }
    sum[0]
}

/// Returns whether the sizes of the coefficients prove that all functions stay within `range`.
///
/// On most pieces they do, which saves the dearer test of [`is_within`].
#[inline(always)]
fn are_surely_within<S: Simd, const N: usize>(
    simd: S,
    range: &RangeInclusive<f64>,
    piece: &Polynomials<N>,
) -> bool {
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

/// Returns whether the Bernstein coefficients of a polynomial on a piece are within `range`.
///
/// The polynomial is a weighted mean of them and is then within the range, too.
fn is_within<const N: usize>(range: &RangeInclusive<f64>, polynomial: &[f64; N]) -> bool {
    let choose = |n: usize, k: usize| {
        (0..k).fold(1.0, |product, i| product * (n - i) as f64 / (i + 1) as f64)
    };
    // The coefficient of `u^m`, with `u = (t + 1)/2` from 0 to 1.
    let power = |m: usize| {
        let terms = (m..N).map(|k| {
            let sign = if (k - m).is_multiple_of(2) { 1.0 } else { -1.0 };
            sign * choose(k, m) * polynomial[k]
        });
        terms.sum::<f64>() * (1_u64 << m) as f64
    };
    let bernstein = |j: usize| {
        (0..=j)
            .map(|m| choose(j, m) / choose(N - 1, m) * power(m))
            .sum::<f64>()
    };
    (0..N).all(|j| range.contains(&bernstein(j)))
}
