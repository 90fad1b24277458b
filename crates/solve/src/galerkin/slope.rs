//! The forms of the matrix `C_mn = (2/pi) int q X' J_m J_n dz` that a contact needs.
//!
//! With `c` the first column of `C` without its first element and `C'` the rest, these are `c.v`
//! and `h.C'.v` of the vectors `v` of a contact, of which `h` is the first (`operator.rs`).

use faer::Mat;
use fearless_simd::prelude::*;
use fearless_simd::{Level, dispatch, f64x8};

use crate::galerkin::abscissae::{BesselValues, Block};
use crate::galerkin::bessel::LANES;

/// The matrix `C`, in the form in which its use costs least.
#[derive(Clone, Debug)]
pub enum Slope<'a> {
    /// Its lower triangle, for many contacts.
    Matrix(Mat<f64>),
    /// The Bessel values, and the factor of their products at every abscissa, for one contact: its
    /// forms are sums over the abscissae of products of `sum_n J_n v_n`.
    Values(&'a BesselValues, Vec<f64>),
}

impl Slope<'_> {
    /// Returns `c.v` and `h.C'.v` for every column `v` of `vectors`, the first of which is `h`.
    pub fn forms(&self, vectors: &Mat<f64>) -> Vec<[f64; 2]> {
        match self {
            Self::Matrix(matrix) => {
                let c = &matrix.col_as_slice(0)[1..];
                let h = vectors.col_as_slice(0);
                let forms = |v: &[f64]| [dot(c, v), form(matrix, h, v)];
                (0..vectors.ncols())
                    .map(|j| forms(vectors.col_as_slice(j)))
                    .collect()
            }
            Self::Values(bessel, factors) => {
                let mut sums = vec![[0.0; 2]; vectors.ncols()];
                for block in bessel.blocks() {
                    dispatch!(Level::new(), simd => add_forms(simd, block, factors, vectors, &mut sums));
                }
                sums
            }
        }
    }
}

/// Adds the parts of the forms at the abscissae of one block. `factors` are those of all abscissae.
#[inline(always)]
fn add_forms<S: Simd>(
    simd: S,
    block: Block<'_>,
    factors: &[f64],
    vectors: &Mat<f64>,
    forms: &mut [[f64; 2]],
) {
    // `sum_n J_n v_n` of every vector.
    let mut amplitudes = vec![0.0; block.rows * vectors.ncols()];
    let mut modes = block.values.chunks_exact(block.rows);
    let first = modes.next().expect("there is a mode");
    for (n, bessel) in modes.enumerate() {
        for (j, amplitudes) in amplitudes.chunks_exact_mut(block.rows).enumerate() {
            let v = vectors[(n, j)];
            for (amplitudes, bessel) in lanes_mut(amplitudes).zip(lanes(bessel)) {
                let sum = f64x8::from_slice(simd, amplitudes);
                let bessel = f64x8::from_slice(simd, bessel);
                bessel.mul_add(v, sum).store_slice(amplitudes);
            }
        }
    }
    let of_h = &amplitudes[..block.rows];
    for (form, of_v) in forms.iter_mut().zip(amplitudes.chunks_exact(block.rows)) {
        let mut sums = [f64x8::splat(simd, 0.0); 2];
        for (i, factors) in lanes(&factors[block.range()]).enumerate() {
            let group = |values: &[f64]| f64x8::from_slice(simd, &values[i * LANES..][..LANES]);
            let part = f64x8::from_slice(simd, factors) * group(of_v);
            sums[0] = part.mul_add(group(first), sums[0]);
            sums[1] = part.mul_add(group(of_h), sums[1]);
        }
        for (form, sums) in form.iter_mut().zip(sums) {
            *form += sums.iter().sum::<f64>();
        }
    }
}

/// Returns groups of [`LANES`] values.
#[inline(always)]
fn lanes(values: &[f64]) -> std::slice::ChunksExact<'_, f64> {
    values.chunks_exact(LANES)
}

/// Returns groups of [`LANES`] values that may be changed.
#[inline(always)]
fn lanes_mut(values: &mut [f64]) -> std::slice::ChunksExactMut<'_, f64> {
    values.chunks_exact_mut(LANES)
}

/// Returns `a.b` of two vectors of equal length. The products are added to eight sums in turn,
/// because an addition to a sum must wait for the one before it.
#[inline(always)]
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    debug_assert_eq!(a.len(), b.len());
    let (groups, rest) = a.as_chunks::<LANES>();
    let (groups_of_b, rest_of_b) = b.as_chunks::<LANES>();
    let mut sums = [0.0; LANES];
    for (a, b) in groups.iter().zip(groups_of_b) {
        for ((sum, a), b) in sums.iter_mut().zip(a).zip(b) {
            *sum += a * b;
        }
    }
    let products = rest.iter().zip(rest_of_b).map(|(a, b)| a * b);
    sums.iter().copied().chain(products).sum()
}

/// Returns `u.C.v` without the first row and column of `C`, whose lower triangle `matrix` holds.
fn form(matrix: &Mat<f64>, u: &[f64], v: &[f64]) -> f64 {
    let mut form = 0.0;
    for j in 0..u.len() {
        let column = &matrix.col_as_slice(j + 1)[j + 1..];
        let (u_j, v_j) = (u[j], v[j]);
        form += column[0] * u_j * v_j;
        for ((c, u), v) in column.iter().zip(&u[j..]).zip(&v[j..]).skip(1) {
            form += c * (u * v_j + u_j * v);
        }
    }
    form
}
