//! The polynomials on the pieces of a curve: their values, derivatives and bounds.
//!
//! On a piece each quantity is a polynomial in the position `t` from -1 to 1.

use std::ops::RangeInclusive;

use fearless_simd::prelude::*;
use fearless_simd::{Level, dispatch, f64x2, f64x4};

use crate::Quantity;
use crate::curve::grid::Position;

/// The number of coefficients of a logarithm on a piece, of `1, t, t^2, ...`
pub(crate) const LOGARITHM: usize = 8;
/// The number of coefficients of a quantity on a piece.
///
/// The exponential of a polynomial of degree 7 has infinitely many terms, but on a piece each is
/// about ten times smaller than the one before.
pub(crate) const VALUE: usize = 10;

/// The polynomials, on one piece, of the logarithms of the quantities or of their derivatives.
pub(crate) type Logarithms = [[f64; 4]; LOGARITHM];
/// The polynomials of the quantities on one piece.
pub(crate) type Values = [[f64; 4]; VALUE];
/// The polynomial of one quantity on one piece.
pub(crate) type Polynomial = [f64; VALUE];

/// Evaluates the polynomial of one quantity.
#[inline]
pub(crate) fn evaluate<const N: usize>(
    piece: &[[f64; 4]; N],
    position: Position,
    quantity: usize,
) -> f64 {
    // Horner's scheme in `t^2` over pairs of terms: the chain of dependent operations is half as
    // long.
    let (t, square) = (position.t, position.t * position.t);
    let pair = |k: usize| piece[k][quantity] + piece[k + 1][quantity] * t;
    (0..N / 2 - 1)
        .rev()
        .fold(pair(N - 2), |sum, k| sum * square + pair(2 * k))
}

/// Evaluates as [`evaluate`], with fused multiplications and additions if the processor has them.
#[inline(always)]
pub(crate) fn evaluate_fused<S: Simd, const N: usize>(
    simd: S,
    piece: &[[f64; 4]; N],
    position: Position,
    quantity: usize,
) -> f64 {
    let number = |value: f64| f64x2::splat(simd, value);
    let (t, square) = (number(position.t), number(position.t * position.t));
    let pair = |k: usize| t.mul_add(number(piece[k + 1][quantity]), number(piece[k][quantity]));
    let mut sum = pair(N - 2);
    for k in (0..N / 2 - 1).rev() {
        sum = sum.mul_add(square, pair(2 * k));
    }
    sum[0]
}

/// Evaluates the polynomials of all four quantities.
#[inline]
pub(crate) fn evaluate_all<const N: usize>(piece: &[[f64; 4]; N], position: Position) -> [f64; 4] {
    std::array::from_fn(|quantity| evaluate(piece, position, quantity))
}

/// Evaluates the derivatives of the polynomials of all four quantities with respect to `t`.
#[inline]
pub(crate) fn evaluate_derivatives<const N: usize>(
    piece: &[[f64; 4]; N],
    position: Position,
) -> [f64; 4] {
    std::array::from_fn(|q| {
        (1..N)
            .rev()
            .fold(0.0, |sum, k| sum * position.t + k as f64 * piece[k][q])
    })
}

/// Returns the first piece on which one of the known quantities may leave `range`, and that
/// quantity.
pub(crate) fn first_piece_outside<'a>(
    range: &RangeInclusive<f64>,
    pieces: &'a [Values],
    known: [bool; 4],
) -> Option<(&'a Values, Quantity)> {
    dispatch!(Level::new(), simd => {
        for piece in pieces {
            if !are_surely_within(simd, range, piece) {
                let leaving = |&quantity: &Quantity| {
                    known[quantity as usize]
                        && !is_within(range, &piece.map(|row| row[quantity as usize]))
                };
                if let Some(quantity) = Quantity::ALL.into_iter().find(leaving) {
                    return Some((piece, quantity));
                }
            }
        }
        None
    })
}

/// Returns whether the sizes of the coefficients prove that all quantities stay within `range`.
///
/// On most pieces they do, which saves the dearer test of [`is_within`].
#[inline(always)]
fn are_surely_within<S: Simd>(simd: S, range: &RangeInclusive<f64>, piece: &Values) -> bool {
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
pub(crate) fn is_within(range: &RangeInclusive<f64>, polynomial: &Polynomial) -> bool {
    let choose = |n: usize, k: usize| {
        (0..k).fold(1.0, |product, i| product * (n - i) as f64 / (i + 1) as f64)
    };
    // The coefficient of `u^m`, with `u = (t + 1)/2` from 0 to 1.
    let power = |m: usize| {
        let terms = (m..VALUE).map(|k| {
            let sign = if (k - m).is_multiple_of(2) { 1.0 } else { -1.0 };
            sign * choose(k, m) * polynomial[k]
        });
        terms.sum::<f64>() * (1_u64 << m) as f64
    };
    let bernstein = |j: usize| {
        (0..=j)
            .map(|m| choose(j, m) / choose(VALUE - 1, m) * power(m))
            .sum::<f64>()
    };
    (0..VALUE).all(|j| range.contains(&bernstein(j)))
}
