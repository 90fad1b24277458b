//! Sines, cosines and Bessel functions at groups of arguments.
//!
//! This is arithmetic without branches on [`LANES`] arguments, which the compiler turns into vector
//! instructions.

use std::array::from_fn;
use std::f64::consts::{PI, TAU};

use crate::bessel::LANES;

/// A group of arguments or values.
pub type Group = [f64; LANES];

/// `2 pi` in three parts. The products of the first two with a whole number below 2^20 are exact.
const TURN: [f64; 3] = [
    6.283_185_306_936_502_5,
    2.430_840_202_521_586_4e-10,
    8.089_064_995_183_803e-21,
];

/// The Taylor coefficients of `sin(y)/y` and of `cos(y)` in powers of `y^2`. They leave 1e-17 at
/// `pi/2`.
const SINE: [f64; 12] = series(1);
const COSINE: [f64; 12] = series(0);

/// Returns `(-1)^n/(2n + odd)!`.
const fn series(odd: usize) -> [f64; 12] {
    let mut coefficients = [1.0; 12];
    let mut n = 1;
    while n < coefficients.len() {
        let last = 2 * n + odd;
        coefficients[n] = -coefficients[n - 1] / ((last - 1) * last) as f64;
        n += 1;
    }
    coefficients
}

/// Returns `sin(theta)` and `1 - cos(theta)`, the latter without cancellation for small angles.
///
/// They are `2 sin(y) cos(y)` and `2 sin(y)^2` of `y = theta/2`, brought to `[-pi/2, pi/2]`. The
/// error is at most 1e-15 for angles up to 1e5.
#[inline(always)]
pub fn sine_and_versine(theta: f64) -> [f64; 2] {
    /// A number so large that adding it rounds to whole numbers.
    const ROUNDS: f64 = 6_755_399_441_055_744.0;
    let turns = (theta * (1.0 / TAU) + ROUNDS) - ROUNDS;
    let y = 0.5 * (((theta - turns * TURN[0]) - turns * TURN[1]) - turns * TURN[2]);
    let square = y * y;
    let sum = |terms: &[f64; 12]| {
        let mut sum = terms[11];
        for coefficient in terms[..11].iter().rev() {
            sum = sum * square + coefficient;
        }
        sum
    };
    let (sine, cosine) = (y * sum(&SINE), sum(&COSINE));
    [2.0 * sine * cosine, 2.0 * sine * sine]
}

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

/// Returns the sum of the products of the members of two lists, which have a multiple of [`LANES`]
/// members.
pub fn product(a: &[f64], b: &[f64]) -> f64 {
    let mut sums = [0.0; LANES];
    for (a, b) in a.chunks_exact(LANES).zip(b.chunks_exact(LANES)) {
        for l in 0..LANES {
            sums[l] += a[l] * b[l];
        }
    }
    sums.iter().sum()
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::estimate::larger;

    /// Arguments from 1e-9 to 1e5.
    fn arguments() -> impl Iterator<Item = f64> {
        (0..20_000).map(|i| 1e-9 * 10_f64.powf(7e-4 * f64::from(i)))
    }

    #[test]
    fn sines_and_versines_are_those_of_the_standard_library() {
        let [mut worst, mut small] = [0.0; 2];
        for theta in arguments() {
            let [sine, versine] = sine_and_versine(theta);
            let half = (0.5 * theta).sin();
            worst = larger(worst, (sine - theta.sin()).abs());
            worst = larger(worst, (versine - 2.0 * half * half).abs());
            if theta < 1.0 {
                small = larger(small, (versine / (2.0 * half * half) - 1.0).abs());
                small = larger(small, (sine / theta.sin() - 1.0).abs());
            }
        }
        println!("{worst:.1e}, relative to small values {small:.1e}");
        assert!(worst < 1e-15 && small < 2e-15, "{worst} {small}");
    }

    /// On both sides of the argument where the expansions begin.
    #[test]
    fn bessel_functions_are_those_of_libm() {
        let mut worst = 0.0;
        for z in arguments().filter(|z| (20.0..5e3).contains(z)) {
            let [first, second] = bessel(&[z; LANES]);
            worst = larger(worst, (first[0] - libm::j0(z)).abs() * z.sqrt());
            worst = larger(worst, (second[LANES - 1] - libm::j1(z)).abs() * z.sqrt());
        }
        println!("{worst:.1e}");
        assert!(worst > 0.0 && worst < 3e-15, "{worst}");
    }
}
