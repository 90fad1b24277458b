//! The field of the flat punch at all contact radii in Legendre polynomials of `s/a`.
//!
//! `P + Q` of the [field](super::field) is even in `s`, and `Q - P` is odd. Between two ends of its
//! blocks their coefficients are polynomials in the contact radius.

use fearless_simd::prelude::*;
use fearless_simd::{Level, dispatch, f64x4};

use super::field::{Field, LANES, dot, load};
use super::legendre::{EVEN, MOST, SIZES, rule};
use super::polynomial::{POINTS, basis_on, points_on};
use crate::Error;

/// The largest coefficients that are left out at the end, relative to the first ones, over the
/// tolerance. The moments of a shape fall with the order, too.
const ENOUGH: f64 = 1.0;
/// The orders that every field needs, and those per root of the contact radius over the thickness of the film or top layer
/// and per power of ten of the tolerance, for the boundary layer at the edge.
const ORDERS: [f64; 2] = [5.0, 1.1];

/// The part of the contact radius near the edge in which a polynomial of the highest order hardly
/// oscillates, times the square of the number of orders.
const NEAR: f64 = 16.0;
/// The number of the quadrature for the parts near the edge.
const SHORT: usize = 0;

/// The coefficients of `P + Q` and of `Q - P`, by order.
pub(super) type Coefficients = [[f64; 2]];

/// The coefficients between two contact radii.
#[derive(Clone, Debug)]
pub(super) struct Modes {
    ends: [f64; 2],
    /// By order, those of `P + Q` and of `Q - P` at each of the points.
    at_points: Vec<[[f64; POINTS]; 2]>,
}

impl Modes {
    /// Takes the field, whose blocks it may have to solve. A derivative of a field has as many
    /// coefficients as the field `of`.
    pub(super) fn new(field: &Field, ends: [f64; 2], of: Option<&Self>) -> Result<Self, Error> {
        field.solve_to(ends[1])?;
        let (tolerance, a_over_top) = (field.medium.tolerance, ends[1] / field.medium.top);
        let orders = match of {
            Some(of) => of.at_points.len() as f64,
            None => ORDERS[0] - ORDERS[1] * tolerance.log10() * a_over_top.sqrt(),
        };
        let size = SIZES.partition_point(|&size| (size as f64) < orders);
        let (radii, size) = (points_on(ends), size.min(SIZES.len() - 1));
        let mut at_points =
            dispatch!(Level::new(), simd => coefficients(simd, field, &radii, size));
        let largest = |of: &[[f64; POINTS]; 2]| -> f64 {
            let all = of.as_flattened().iter();
            all.fold(0.0, |most, own| most.max(own.abs()))
        };
        let first = at_points.first().map_or(0.0, largest);
        let counts = |own| of.is_some() || largest(own) > ENOUGH * tolerance * first;
        let count = at_points.iter().rposition(counts);
        at_points.truncate(count.map_or(1, |last| last + 1));
        Ok(Self { ends, at_points })
    }

    /// Returns the coefficients at a contact radius. `sums` is a place for them.
    pub(super) fn at<'a>(&self, x: f64, sums: &'a mut [[f64; 2]; MOST]) -> &'a Coefficients {
        let basis = basis_on(self.ends, x);
        dispatch!(Level::new(), simd => {
            let basis = load(simd, &basis);
            for (sums, at) in sums.iter_mut().zip(&self.at_points) {
                for (sum, at) in sums.iter_mut().zip(at) {
                    *sum = dot(load(simd, at), basis);
                }
            }
        });
        &sums[..self.at_points.len()]
    }
}

/// Returns the coefficients at the points for the [size](SIZES) by number. The quadrature is split
/// where blocks end in `a - s`, because the field near the edge has the small errors of the curve of
/// the material at small `a/t`.
#[inline(always)]
fn coefficients<S: Simd>(
    simd: S,
    field: &Field,
    radii: &[f64; POINTS],
    size: usize,
) -> Vec<[[f64; POINTS]; 2]> {
    let mut sums = vec![[[0.0; POINTS]; 2]; SIZES[size]];
    let ends = field.ends();
    let near = (NEAR / (SIZES[size] * SIZES[size]) as f64).min(0.5) * radii[0];
    let split = ends.partition_point(|&end| end <= near).max(1);
    for part in 0..split {
        // The distances from the edge; the last part goes to the axis.
        let last = part + 1 == split;
        let rule = rule(if last { size.saturating_sub(1) } else { SHORT });
        for number in 0..2 * rule.len() {
            let [mut t, weight] = rule[number / 2];
            if number % 2 == 1 {
                t = -t;
            }
            let (mut rho, mut even, mut odd) = ([0.0; POINTS], [0.0; POINTS], [0.0; POINTS]);
            for (i, a) in radii.iter().enumerate() {
                let [from, to] = [ends[part], if last { *a } else { ends[part + 1] }];
                let half = 0.5 * (to - from);
                let s = (a - 0.5 * (from + to) + half * t).max(0.0);
                let values = field.at(simd, *a, s);
                rho[i] = s / a;
                even[i] = half / a * weight * values[0];
                odd[i] = half / a * weight * values[1];
            }
            let (rho, weights) = (load(simd, &rho), [load(simd, &even), load(simd, &odd)]);
            let mut value = load(simd, &[1.0; POINTS]);
            let mut before = load(simd, &[0.0; POINTS]);
            for ([of_even, of_odd], own) in sums.iter_mut().zip(EVEN.iter()) {
                for lane in 0..LANES {
                    let (rho, old) = (rho[lane], value[lane]);
                    let next = (rho * own.odd[0]).mul_add(old, before[lane] * -own.odd[1]);
                    add(
                        simd,
                        &mut of_even[4 * lane..4 * lane + 4],
                        weights[0][lane] * old,
                    );
                    add(
                        simd,
                        &mut of_odd[4 * lane..4 * lane + 4],
                        weights[1][lane] * next,
                    );
                    value[lane] = (rho * own.even[0]).mul_add(next, old * -own.even[1]);
                    before[lane] = next;
                }
            }
        }
    }
    for (sums, own) in sums.iter_mut().zip(EVEN.iter()) {
        for (sums, inverse) in sums.iter_mut().zip(own.inverse) {
            sums.iter_mut().for_each(|sum| *sum /= inverse);
        }
    }
    sums
}

/// Adds a vector to four numbers.
#[inline(always)]
fn add<S: Simd>(simd: S, sums: &mut [f64], own: f64x4<S>) {
    let sum = f64x4::from_slice(simd, sums) + own;
    sums.copy_from_slice(sum.as_array());
}
