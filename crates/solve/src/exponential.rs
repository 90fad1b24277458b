//! The exponential function of several numbers at once.

use std::f64::consts::LOG2_E;

use fearless_simd::prelude::*;

/// The smallest exponent. The exponentials of smaller ones, below 1e-304, add nothing to any minor.
const LEAST: f64 = -700.0;

/// The upper 21 bits of `ln 2`, so that small integers times it are exact, and the rest.
const LN_2: [f64; 2] = [0.693_146_705_627_441_4, 4.749_325_039_031_673e-7];

/// Adding this number leaves the nearest integer in the lowest bits of the sum.
const TO_INTEGER: f64 = 6_755_399_441_055_744.0;

/// The number of bits of a fraction.
const FRACTION_BITS: u32 = f64::MANTISSA_DIGITS - 1;

/// The degree of the power series: the first term left out is below 1e-17 of the sum.
const DEGREE: usize = 13;

/// `1/k!`
const COEFFICIENTS: [f64; DEGREE + 1] = {
    let mut coefficients = [1.0; DEGREE + 1];
    let mut k = 1;
    while k <= DEGREE {
        coefficients[k] = coefficients[k - 1] / k as f64;
        k += 1;
    }
    coefficients
};

/// Returns `e^x` for `-700 <= x <= 0` with a relative error of at most two rounding units, and
/// `e^-700` for smaller `x`.
///
/// With `x = n ln 2 + r` and `|r| <= ln(2)/2` it is `2^n e^r`, and `e^r` is a power series.
#[inline(always)]
pub fn exponential<S: Simd>(simd: S, x: S::f64s) -> S::f64s {
    let x = x.max(LEAST);
    let shifted = x.mul_add(LOG2_E, TO_INTEGER);
    let n = shifted - TO_INTEGER;
    let r = n.mul_add(-LN_2[1], n.mul_add(-LN_2[0], x));
    let mut sum = S::f64s::splat(simd, COEFFICIENTS[DEGREE]);
    for coefficient in COEFFICIENTS[..DEGREE].iter().rev() {
        sum = sum.mul_add(r, *coefficient);
    }
    // Adds `n` to the exponent.
    SimdFloat::from_bits(sum.to_bits() + (shifted.to_bits() << FRACTION_BITS))
}

#[cfg(test)]
mod tests {
    use fearless_simd::{Level, dispatch};

    use super::*;
    use crate::estimate::larger;

    #[inline(always)]
    fn one<S: Simd>(simd: S, x: f64) -> f64 {
        exponential(simd, S::f64s::splat(simd, x))[0]
    }

    /// Against the function of the standard library. Measured: 2.2e-16.
    #[test]
    fn it_is_the_exponential_of_the_standard_library() {
        let mut worst = 0.0;
        for i in 0..=70_000 {
            let x = -0.01 * f64::from(i);
            let found = dispatch!(Level::new(), simd => one(simd, x));
            worst = larger(worst, (found / x.exp() - 1.0).abs());
        }
        println!("exponential: {worst:.1e}");
        assert!(worst <= 4.5e-16);
        let least = dispatch!(Level::new(), simd => one(simd, -1e300));
        assert!(least > 0.0 && least < 1e-303);
    }
}
