//! A number for each of several pieces, side by side, and rows of four numbers for each piece.

use fearless_simd::prelude::*;
use fearless_simd::{f64x4, f64x8};

/// The number of pieces that are computed side by side.
///
/// A term of a series waits for the terms before it. With eight pieces a processor has enough to do
/// in the meantime, even one whose vectors hold four numbers.
pub const LANES: usize = 8;

/// A number for each of [`LANES`] pieces.
pub type Lanes<S> = f64x8<S>;

/// Transposes eight rows of eight numbers.
#[inline(always)]
pub(crate) fn transposed_lanes<S: Simd>(mut rows: [Lanes<S>; LANES]) -> [Lanes<S>; LANES] {
    // Each step is a perfect shuffle of all numbers. Three of them exchange rows and columns.
    for _ in 0..3 {
        let before = rows;
        for i in 0..LANES / 2 {
            (rows[2 * i], rows[2 * i + 1]) = before[i].interleave(before[i + LANES / 2]);
        }
    }
    rows
}

/// Returns the row of four numbers of each piece.
#[inline(always)]
fn rows_of_lanes<S: Simd>([a, b, c, d]: [Lanes<S>; 4]) -> [f64x4<S>; LANES] {
    let ((ac, ac_high), (bd, bd_high)) = (a.interleave(c), b.interleave(d));
    let (first, second) = ac.interleave(bd);
    let (third, fourth) = ac_high.interleave(bd_high);
    let ((p, q), (r, s)) = (first.split(), second.split());
    let ((t, u), (v, w)) = (third.split(), fourth.split());
    [p, q, r, s, t, u, v, w]
}

/// Returns four numbers for each piece from a row of them for each piece.
#[inline(always)]
pub fn lanes_of_rows<S: Simd>([p, q, r, s, t, u, v, w]: [f64x4<S>; LANES]) -> [Lanes<S>; 4] {
    let (ac, bd) = p.combine(q).deinterleave(r.combine(s));
    let (ac_high, bd_high) = t.combine(u).deinterleave(v.combine(w));
    let ((a, c), (b, d)) = (ac.deinterleave(ac_high), bd.deinterleave(bd_high));
    [a, b, c, d]
}

/// Writes the coefficients of four series to a row for each piece.
#[inline(always)]
pub fn write_by_piece<S: Simd, const N: usize>(
    [a, b, c, d]: [&[Lanes<S>; N]; 4],
    pieces: &mut [[[f64; 4]; N]; LANES],
) {
    for k in 0..N {
        let rows = rows_of_lanes([a[k], b[k], c[k], d[k]]);
        for (piece, row) in pieces.iter_mut().zip(rows) {
            row.store_slice(&mut piece[k]);
        }
    }
}
