//! The values of a train on a grid of places.

use std::array;

use fearless_simd::prelude::*;
use fearless_simd::{Level, dispatch, f64x8};

use crate::IntegerTrain;
use crate::chebyshev::polynomials;
use crate::vectors::BLOCK;
use crate::weighted_sum::add_rows;

impl IntegerTrain {
    /// Returns the values at a grid of coordinates, row-major over those of the variables 1, 2, 3 and
    /// 0, and the functions.
    ///
    /// `ends` are the ends of the box, and `places` the coordinates of the grid, one at
    /// least: an entry for each variable, 0 to 3.
    pub fn values(&self, ends: [[f64; 2]; 4], places: [&[f64]; 4]) -> Vec<f64> {
        let (variables, bonds) = (self.variables(), self.weights());
        // Row-major over the places so far and the bond.
        let mut vectors = vec![1.0];
        for (i, [before, terms, after]) in self.shapes().into_iter().enumerate() {
            let (variable, at) = (variables[i], places[variables[i]]);
            let degree = self.smooth_degrees()[variable];
            let at_place = |&place: &f64| polynomials(degree, terms, ends[variable], place);
            let at_places: Vec<_> = at.iter().map(at_place).collect();
            let integers: Vec<f64> = self.cores()[i].iter().map(|&n| n as f64).collect();
            // Row-major over the bond before, the places and the bond after.
            let width = at.len() * after;
            let mut core = vec![0.0; before * width];
            for (b, rows) in core.chunks_exact_mut(width).enumerate() {
                let factor = self.step() / if i == 0 { 1.0 } else { bonds[i - 1][b] };
                let integers = &integers[b * terms * after..];
                for (row, polynomials) in rows.chunks_exact_mut(after).zip(&at_places) {
                    add_rows(row, polynomials, integers, after);
                    row.iter_mut().for_each(|entry| *entry *= factor);
                }
            }
            vectors = dispatch!(Level::new(), simd => product(simd, &vectors, &core, before));
        }
        // From the order of the cores to that of the variables.
        let counts = self.order().map(|variable| places[variable].len());
        let core = |variable: usize| {
            let core = self.order().iter().position(|&other| other == variable);
            1 + core.expect("the order holds each variable")
        };
        permuted(&vectors, &counts, [1, 2, 3].map(core))
    }
}

/// Returns the product of two matrices, row-major as they are. `inner` is the number of rows of the second.
///
/// A block of columns is multiplied by four rows at a time, whose sums stay in registers.
#[inline(always)]
fn product<S: Simd>(simd: S, first: &[f64], second: &[f64], inner: usize) -> Vec<f64> {
    let width = second.len() / inner;
    let mut product = vec![0.0; first.len() / inner * width];
    let mut block = vec![[0.0; BLOCK]; inner];
    for start in (0..width).step_by(BLOCK) {
        let columns = start..width.min(start + BLOCK);
        for (row, entries) in block.iter_mut().zip(second.chunks_exact(width)) {
            row[..columns.len()].copy_from_slice(&entries[columns.clone()]);
        }
        let fours = first.chunks(4 * inner).zip(product.chunks_mut(4 * width));
        for (rows, products) in fours {
            // Of less than four rows, the last one is repeated.
            let last = rows.len() / inner - 1;
            let rows: [&[f64]; 4] = array::from_fn(|r| &rows[r.min(last) * inner..][..inner]);
            let mut sums = [[f64x8::splat(simd, 0.0); BLOCK / 8]; 4];
            for (i, entries) in block.iter().enumerate() {
                for (row, sums) in rows.iter().zip(&mut sums) {
                    let weight = f64x8::splat(simd, row[i]);
                    for (sum, entries) in sums.iter_mut().zip(entries.chunks_exact(8)) {
                        *sum = f64x8::from_slice(simd, entries).mul_add(weight, *sum);
                    }
                }
            }
            for (products, sums) in products.chunks_exact_mut(width).zip(&sums) {
                let mut entries = [0.0; BLOCK];
                for (entries, sum) in entries.chunks_exact_mut(8).zip(sums) {
                    sum.store_slice(entries);
                }
                products[columns.clone()].copy_from_slice(&entries[..columns.len()]);
            }
        }
    }
    product
}

/// Returns a tensor of the axes 1, 2, 3 and the rest, with the first three in another order.
pub(crate) fn permuted(tensor: &[f64], counts: &[usize], order: [usize; 3]) -> Vec<f64> {
    let width = tensor.len() / counts[..3].iter().product::<usize>();
    let strides = [counts[1] * counts[2], counts[2], 1];
    let [first, second, third] = order.map(|axis| (counts[axis - 1], strides[axis - 1]));
    let mut result = Vec::with_capacity(tensor.len());
    for i in 0..first.0 {
        for j in 0..second.0 {
            for k in 0..third.0 {
                let at = i * first.1 + j * second.1 + k * third.1;
                result.extend_from_slice(&tensor[at * width..][..width]);
            }
        }
    }
    result
}
