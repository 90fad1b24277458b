//! The exponential function of several numbers at once.

use fearless_simd::prelude::*;
use piecewise::exp::exp;

/// The smallest exponent. The exponentials of smaller ones, below 1e-304, add nothing to any minor.
const LEAST: f64 = -700.0;

/// Returns `e^x` for `-700 <= x <= 0` with a relative error of at most two rounding units, and
/// `e^-700` for smaller `x`, of which [`exp`] gives no exponential.
#[inline(always)]
pub fn exponential<S: Simd>(simd: S, x: S::f64s) -> S::f64s {
    exp(simd, x.max(LEAST))
}

#[cfg(test)]
mod tests {
    use fearless_simd::{Level, dispatch};

    use super::*;

    #[inline(always)]
    fn one<S: Simd>(simd: S, x: f64) -> f64 {
        exponential(simd, S::f64s::splat(simd, x))[0]
    }

    #[test]
    fn exponentials_of_small_numbers_are_the_least() {
        for (x, expected) in [
            (-1.0, (-1.0_f64).exp()),
            (-700.0, LEAST.exp()),
            (-1e300, LEAST.exp()),
        ] {
            let found = dispatch!(Level::new(), simd => one(simd, x));
            assert!((found / expected - 1.0).abs() <= 4.5e-16, "{x}: {found:e}");
        }
    }
}
