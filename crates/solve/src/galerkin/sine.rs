//! The sine and the cosine, as arithmetic without branches that the compiler turns into vector
//! instructions.

use std::f64::consts::TAU;

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
