//! The ladder over the curve, [several pieces](LANES) at a time.

use fearless_simd::prelude::*;
use fearless_simd::{Level, dispatch, f64x4};
use piecewise::lanes::{LANES, Lanes, lanes_of_rows, write_by_piece};
use piecewise::series::{
    QUOTIENT_TERMS, Series, continued, divided_by_powers, economised, integral, product, quotient,
    scale, times_linear,
};
use piecewise::{FUNCTION_TERMS, Polynomials};

use interp::Quantity;

use super::beginning::Kernel;
use super::weights::{MOST_TERMS, Weights};

/// The number of coefficients of a series on a piece.
const TERMS: usize = 12;

/// The values of the integrals at the end of the last piece.
pub(super) struct Running {
    /// Those of `y^(2k+1) mu_2k/(2k)!`.
    moments: [f64; MOST_TERMS],
    /// Those of `y^2k Delta_2k/(2k)!`. With these factors no integral needs one.
    penetrations: [f64; MOST_TERMS],
    /// Those of a quarter of the load, and of the penetration of the shape.
    sums: [f64; 2],
    /// The number of terms that are known.
    terms: usize,
}

impl Running {
    pub(super) fn new(kernel: &Kernel, weights: &Weights, es: f64) -> Self {
        let sums = kernel.sums(weights);
        let mut factorials = [1.0; MOST_TERMS];
        for k in 1..MOST_TERMS {
            factorials[k] = factorials[k - 1] * (2 * k * (2 * k - 1)) as f64;
        }
        Self {
            moments: std::array::from_fn(|k| es * kernel.moment(2 * k) / factorials[k]),
            penetrations: std::array::from_fn(|k| kernel.penetration(2 * k) / factorials[k]),
            sums: [0.25 * es * sums.load, sums.penetration],
            terms: MOST_TERMS,
        }
    }

    /// Guesses the integrals of terms that were not needed before, at the contact radius `y` where `es/Gamma^2`
    /// is `rate`: as if `Gamma` were the same at all smaller radii. They grow so fast that their values there
    /// soon do not matter.
    fn extend(&mut self, terms: usize, y: f64, rate: f64) {
        for k in self.terms..terms {
            let n = (2 * k) as f64;
            self.moments[k] = self.moments[k - 1] * y * y / (n * (n + 1.0));
            self.penetrations[k] = self.moments[k - 1] * y * rate / n;
        }
        self.terms = terms;
    }
}

/// The pieces that are computed side by side.
pub(super) struct Group<'a> {
    /// Their ends, in units of the grid.
    pub(super) ends: [[f64; 2]; LANES],
    pub(super) weights: [Weights; LANES],
    pub(super) pieces: [&'a Polynomials<FUNCTION_TERMS>; LANES],
    /// The place of the first node on the first piece, in the first group.
    pub(super) start: Option<f64>,
}

impl Group<'_> {
    /// Writes the polynomials of the quantities on the pieces, with `Pi0` and `Delta0` of the shape.
    pub(super) fn integrated(
        &self,
        es: f64,
        radius: f64,
        running: &mut Running,
        target: &mut [Polynomials<FUNCTION_TERMS>; LANES],
    ) {
        dispatch!(Level::new(), simd => self.integrate(simd, es, radius, running, target));
    }

    /// [`Group::integrated`] with vector instructions.
    #[inline(always)]
    fn integrate<S: Simd>(
        &self,
        simd: S,
        es: f64,
        radius: f64,
        running: &mut Running,
        target: &mut [Polynomials<FUNCTION_TERMS>; LANES],
    ) {
        let vector = |values: [f64; LANES]| Lanes::simd_from(simd, values);
        let half = vector(self.ends.map(|[from, to]| 0.5 * (to - from)));
        let middle = vector(self.ends.map(|[from, to]| 0.5 * (from + to)));
        let zero = Lanes::splat(simd, 0.0);
        let [mut stiffness, mut own_gamma, mut penetration]: [Series<_, TERMS>; 3] =
            [[zero; TERMS]; 3];
        let [mut eeq, mut gamma]: [Series<_, FUNCTION_TERMS>; 2] = [[zero; FUNCTION_TERMS]; 2];
        for k in 0..FUNCTION_TERMS {
            let mut rows = [f64x4::splat(simd, 0.0); LANES];
            for (row, piece) in rows.iter_mut().zip(self.pieces) {
                *row = f64x4::from_slice(simd, &piece[k]);
            }
            let delta0;
            [_, eeq[k], gamma[k], delta0] = lanes_of_rows(rows);
            (stiffness[k], own_gamma[k]) = (eeq[k], gamma[k]);
            penetration[k] = delta0 * 0.5;
        }
        times_linear(&mut stiffness, middle, half);
        times_linear(&mut penetration, middle, half);
        times_linear(&mut penetration, middle, half);
        // Half of the length of a piece is a factor of the integrands: the integrals are those over
        // `t`.
        let mut square = product(simd, &gamma, &own_gamma);
        scale(&mut square, half * (1.0 / es));
        // Over `square` this is `es/Gamma^2` times half of the length.
        let over_square = half * half;

        let terms = self.weights.iter().map(|weights| weights.terms);
        let terms = terms.max().unwrap_or(1);
        if terms > running.terms {
            // At the beginning of the first piece, which is at -1.
            let alternating = |sum: f64, (k, row): (usize, &[f64; 4])| match k % 2 {
                0 => sum + row[Quantity::Gamma as usize],
                _ => sum - row[Quantity::Gamma as usize],
            };
            let gamma = self.pieces[0].iter().enumerate().fold(0.0, alternating);
            running.extend(terms, self.ends[0][0], es / (gamma * gamma));
        }
        running.terms = terms;
        // The sum of the weighted moments. The moment of order 0 is that of the stiffness.
        let mut flux = stiffness;
        scale(&mut flux, over_square * vector(lanes_of(&self.weights, 0)));
        let (mut moment, mut factorial) = (stiffness, 1.0);
        for k in 1..terms {
            if k > 1 {
                scale(&mut moment, over_square);
                penetration = integral(simd, &quotient(simd, &moment, &square), 1.0);
                let at = &mut running.penetrations[k];
                continued(simd, self.start, &mut penetration, at);
            }
            moment = integral(simd, &product(simd, &square, &penetration), 1.0);
            continued(simd, self.start, &mut moment, &mut running.moments[k]);
            factorial *= (2 * k * (2 * k - 1)) as f64;
            let beta = over_square * vector(lanes_of(&self.weights, k)) * factorial;
            for i in 0..TERMS {
                flux[i] = beta.mul_add(moment[i], flux[i]);
            }
        }
        let rate = quotient(simd, &flux, &square);
        let mut penetration = integral(simd, &rate, 1.0);
        continued(simd, self.start, &mut penetration, &mut running.sums[1]);
        let mut load = integral(simd, &product(simd, &stiffness, &rate), 1.0);
        continued(simd, self.start, &mut load, &mut running.sums[0]);

        let inverse = Lanes::splat(simd, 1.0) / middle;
        let [_, penetration, load]: [Series<_, QUOTIENT_TERMS>; 3] =
            divided_by_powers(simd, &[stiffness, penetration, load], half * inverse);
        let mut penetration: Series<Lanes<S>, FUNCTION_TERMS> = economised(simd, &penetration);
        let mut load: Series<Lanes<S>, FUNCTION_TERMS> = economised(simd, &load);
        let factor = inverse * inverse * radius;
        scale(&mut penetration, factor);
        scale(&mut load, factor * inverse * 4.0);
        write_by_piece([&load, &eeq, &gamma, &penetration], target);
    }
}

/// Returns the coefficients of a term on the pieces.
#[inline(always)]
fn lanes_of(weights: &[Weights; LANES], k: usize) -> [f64; LANES] {
    let mut lanes = [0.0; LANES];
    for (lane, weights) in lanes.iter_mut().zip(weights) {
        *lane = weights.beta[k];
    }
    lanes
}
