//! The ladder over the curve, four pieces at a time.

use fearless_simd::f64x4;
use fearless_simd::prelude::*;

use super::beginning::Kernel;
use super::weights::{MOST_TERMS, Weights};
use crate::curve::piecewise::{VALUE, Values};
use crate::curve::series::{Series, economised, ends, integral, product, quotient, transposed};

/// The number of coefficients of a series on a piece.
const TERMS: usize = 12;

/// The values of the integrals at the end of the last piece.
pub(super) struct Running {
    /// Those of `y^(2k+1) mu_2k/es`.
    moments: [f64; MOST_TERMS],
    /// Those of `y^2k Delta_2k`.
    penetrations: [f64; MOST_TERMS],
    /// Those of load and penetration of the shape.
    sums: [f64; 2],
    /// The number of terms that are known.
    terms: usize,
}

impl Running {
    pub(super) fn new(kernel: &Kernel, weights: &Weights) -> Self {
        let sums = kernel.sums(weights);
        Self {
            moments: std::array::from_fn(|k| kernel.moment(2 * k)),
            penetrations: std::array::from_fn(|k| kernel.penetration(2 * k)),
            sums: [sums.load, sums.penetration],
            terms: MOST_TERMS,
        }
    }

    /// Guesses the integrals of terms that were not needed before, at the contact radius `y`. They
    /// grow so fast that their values there soon do not matter.
    fn extend(&mut self, terms: usize, y: f64) {
        for k in self.terms..terms {
            let n = (2 * k) as f64;
            self.moments[k] = self.moments[k - 1] * y * y * (n - 1.0) / (n + 1.0);
            self.penetrations[k] = self.moments[k - 1] * y * (n - 1.0);
        }
        self.terms = terms;
    }
}

/// Four pieces.
pub(super) struct Group<'a> {
    /// Their ends, in units of the grid.
    pub(super) ends: [[f64; 2]; 4],
    pub(super) weights: [Weights; 4],
    pub(super) pieces: [&'a Values; 4],
    /// The place of the first node on the first piece, in the first group.
    pub(super) start: Option<f64>,
    pub(super) number: usize,
}

impl Group<'_> {
    /// Returns the series of `Pi0` and `Delta0` of the shape on the pieces.
    #[inline(always)]
    pub(super) fn integrated<S: Simd>(
        &self,
        simd: S,
        es: f64,
        radius: f64,
        running: &mut Running,
    ) -> [[[f64; 2]; VALUE]; 4] {
        let vector = |values: [f64; 4]| f64x4::simd_from(simd, values);
        let half = vector(self.ends.map(|[from, to]| 0.5 * (to - from)));
        let middle = vector(self.ends.map(|[from, to]| 0.5 * (from + to)));
        let zero = f64x4::splat(simd, 0.0);
        let (mut stiffness, mut gamma, mut penetration): (
            Series<S, TERMS>,
            Series<S, TERMS>,
            Series<S, TERMS>,
        ) = ([zero; TERMS], [zero; TERMS], [zero; TERMS]);
        let inverse_es = f64x4::splat(simd, 1.0 / es);
        for k in 0..VALUE {
            let rows = self.pieces.map(|piece| f64x4::from_slice(simd, &piece[k]));
            let [_, eeq, own, delta0] = transposed(rows);
            stiffness[k] = eeq * inverse_es;
            gamma[k] = own * inverse_es;
            penetration[k] = delta0;
        }
        times_linear(&mut stiffness, middle, half);
        times_linear(&mut penetration, middle, half);
        times_linear(&mut penetration, middle, half);
        let square = product(&gamma, &gamma);
        let mut one = [zero; TERMS];
        one[0] = f64x4::splat(simd, 1.0);
        let inverse = quotient(simd, &one, &square);

        let terms = self.weights.iter().map(|weights| weights.terms);
        let terms = terms.max().unwrap_or(1);
        if terms > running.terms {
            running.extend(terms, self.ends[0][0]);
        }
        running.terms = terms;
        // The sum of the weighted moments. The moment of order 0 is that of the stiffness.
        let mut flux = stiffness;
        scale(&mut flux, vector(lanes_of(&self.weights, 0)));
        let mut moment = stiffness;
        for k in 1..terms {
            if k > 1 {
                let n = (2 * k) as f64;
                let rate = product(&moment, &inverse);
                let factor = half * f64x4::splat(simd, n * (n - 1.0));
                penetration = integral(simd, &rate, factor);
                continued(
                    simd,
                    self.start,
                    &mut penetration,
                    &mut running.penetrations[k],
                );
            }
            moment = integral(simd, &product(&square, &penetration), half);
            continued(simd, self.start, &mut moment, &mut running.moments[k]);
            let beta = vector(lanes_of(&self.weights, k));
            for i in 0..TERMS {
                flux[i] = beta.mul_add(moment[i], flux[i]);
            }
        }
        let rate = product(&flux, &inverse);
        let mut penetration = integral(simd, &rate, half);
        continued(simd, self.start, &mut penetration, &mut running.sums[1]);
        let work = product(&stiffness, &rate);
        let mut load = integral(simd, &work, half * f64x4::splat(simd, 4.0));
        continued(simd, self.start, &mut load, &mut running.sums[0]);

        let inverse = f64x4::splat(simd, 1.0) / middle;
        let slope = half * inverse;
        for _ in 0..2 {
            divide_by_linear(&mut penetration, inverse, slope);
        }
        for _ in 0..3 {
            divide_by_linear(&mut load, inverse, slope);
        }
        scale(&mut penetration, f64x4::splat(simd, radius));
        scale(&mut load, f64x4::splat(simd, es * radius));
        let penetration: Series<S, VALUE> = economised(simd, &penetration);
        let load: Series<S, VALUE> = economised(simd, &load);
        let mut pieces = [[[0.0; 2]; VALUE]; 4];
        for k in 0..VALUE {
            let (load, penetration) = (*load[k].as_array(), *penetration[k].as_array());
            for lane in 0..4 {
                pieces[lane][k] = [load[lane], penetration[lane]];
            }
        }
        pieces
    }
}

/// Adds the constants with which an integral goes on from piece to piece, from `at` on. In the
/// first group the first node is at the place `start` on the first piece.
#[inline(always)]
pub(in crate::curve) fn continued<S: Simd, const N: usize>(
    simd: S,
    start: Option<f64>,
    integral: &mut Series<S, N>,
    at: &mut f64,
) {
    let [from, to] = ends(integral);
    let (mut from, to) = (*from.as_array(), *to.as_array());
    if let Some(t) = start {
        from[0] = integral
            .iter()
            .rev()
            .fold(0.0, |sum, term| sum * t + term[0]);
    }
    let constants: [f64; 4] = std::array::from_fn(|lane| {
        let constant = *at - from[lane];
        *at = constant + to[lane];
        constant
    });
    integral[0] = f64x4::simd_from(simd, constants);
}

/// Returns the coefficients of a term on the four pieces.
#[inline(always)]
fn lanes_of([a, b, c, d]: &[Weights; 4], k: usize) -> [f64; 4] {
    [a.beta[k], b.beta[k], c.beta[k], d.beta[k]]
}

/// Multiplies a series by `middle + half t`.
#[inline(always)]
pub(in crate::curve) fn times_linear<S: Simd>(
    series: &mut Series<S, TERMS>,
    middle: f64x4<S>,
    half: f64x4<S>,
) {
    for k in (1..TERMS).rev() {
        series[k] = half.mul_add(series[k - 1], middle * series[k]);
    }
    series[0] *= middle;
}

/// Divides a series by `(1 + slope t)/inverse`.
#[inline(always)]
pub(in crate::curve) fn divide_by_linear<S: Simd>(
    series: &mut Series<S, TERMS>,
    inverse: f64x4<S>,
    slope: f64x4<S>,
) {
    series[0] *= inverse;
    for k in 1..TERMS {
        series[k] = (-slope).mul_add(series[k - 1], series[k] * inverse);
    }
}

/// Multiplies a series by a number.
#[inline(always)]
pub(in crate::curve) fn scale<S: Simd>(series: &mut Series<S, TERMS>, factor: f64x4<S>) {
    for term in series {
        *term *= factor;
    }
}
