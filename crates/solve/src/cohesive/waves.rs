//! Bessel functions and sums of cosines at groups of arguments.
//!
//! This is arithmetic without branches on [`LANES`] arguments, which the compiler turns into vector
//! instructions.

use std::array::from_fn;
use std::f64::consts::PI;

use crate::galerkin::bessel::LANES;
use crate::galerkin::sine::sine_and_versine;

/// A group of arguments or values.
pub type Group = [f64; LANES];

/// The argument from which on the asymptotic expansions of the Bessel functions leave 1e-16.
const FAR: f64 = 25.0;

/// The number of terms of each of these expansions.
const TERMS: usize = 9;

/// The coefficients of Hankel's expansions of the orders 0 and 1, `P` and `Q`, in powers of `1/z^2`
/// (Abramowitz and Stegun, 9.2.9 and 9.2.10).
const HANKEL: [[[f64; TERMS]; 2]; 2] = [hankel(0), hankel(1)];

const fn hankel(order: usize) -> [[f64; TERMS]; 2] {
    let mut both = [[0.0; TERMS]; 2];
    let mut term = 1.0;
    let mut k = 0;
    while k < 2 * TERMS {
        let sign = if k % 4 < 2 { 1.0 } else { -1.0 };
        both[k % 2][k / 2] = sign * term;
        k += 1;
        let odd = (2 * k - 1) as f64;
        term *= ((4 * order * order) as f64 - odd * odd) / (8 * k) as f64;
    }
    both
}

/// Returns the Bessel functions `J_0` and `J_1` at positive arguments in ascending order.
pub fn bessel(z: &Group) -> [Group; 2] {
    if z[0] < FAR {
        return [z.map(libm::j0), z.map(libm::j1)];
    }
    let [mut first, mut second] = [[0.0; LANES]; 2];
    for l in 0..LANES {
        let z = z[l];
        let [sine, versine] = sine_and_versine(z);
        let cosine = 1.0 - versine;
        let (inverse, scale) = (1.0 / z, 1.0 / (PI * z).sqrt());
        let square = inverse * inverse;
        let sum = |terms: &[f64; TERMS]| {
            let mut sum = terms[TERMS - 1];
            for coefficient in terms[..TERMS - 1].iter().rev() {
                sum = sum * square + coefficient;
            }
            sum
        };
        let (plus, minus) = (sine + cosine, sine - cosine);
        let [[p0, q0], [p1, q1]] = [
            [sum(&HANKEL[0][0]), inverse * sum(&HANKEL[0][1])],
            [sum(&HANKEL[1][0]), inverse * sum(&HANKEL[1][1])],
        ];
        first[l] = scale * (p0 * plus - q0 * minus);
        second[l] = scale * (p1 * minus + q1 * plus);
    }
    [first, second]
}

/// Returns `sum_k weights[k] cos(q[k] s)`; the lists have a multiple of [`LANES`] members.
pub fn cosine_sum(weights: &[f64], q: &[f64], s: f64) -> f64 {
    let mut sums = [0.0; LANES];
    for (weights, q) in weights.chunks_exact(LANES).zip(q.chunks_exact(LANES)) {
        let terms: Group = from_fn(|l| weights[l] * (1.0 - sine_and_versine(q[l] * s)[1]));
        for l in 0..LANES {
            sums[l] += terms[l];
        }
    }
    sums.iter().sum()
}
