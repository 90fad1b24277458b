//! The exponential function of several numbers side by side.

use std::f64::consts::LOG2_E;

use fearless_simd::prelude::*;

/// Returns the exponential function of each number, to about two units in the last place.
///
/// It is exact to rounding for numbers from -700 to 700. A smaller or larger one gives a result that
/// is not in `[1e-300, 1e300]`, and NaN gives NaN.
#[inline(always)]
pub fn exp<S: Simd, V: SimdFloat<S, Element = f64>>(simd: S, x: V) -> V {
    /// The logarithm of 2 as a sum; the first part has few digits, so that its multiples are exact.
    const LN_2: [f64; 2] = [0.693_147_180_369_123_8, 1.908_214_929_270_587_7e-10];
    /// A number whose last digit counts whole numbers.
    const WHOLE: f64 = (3_u64 << 51) as f64;
    /// One over the factorials from `13!` down to `0!`.
    const INVERSE_FACTORIALS: [f64; 14] = {
        let mut inverses = [1.0; 14];
        let (mut k, mut factorial) = (1, 1.0);
        while k < 14 {
            factorial *= k as f64;
            inverses[13 - k] = 1.0 / factorial;
            k += 1;
        }
        inverses
    };
    let number = |value: f64| V::splat(simd, value);
    let within = x.max(number(-700.0)).min(number(700.0));
    // `x = n ln 2 + r` with a whole number `n`, and `r` at most half of `ln 2`.
    let shifted = within.mul_add(number(LOG2_E), number(WHOLE));
    let n = shifted - WHOLE;
    let r = n.mul_add(number(-LN_2[1]), n.mul_add(number(-LN_2[0]), x));
    // Horner's scheme in `r^2` for the even and for the odd powers, which do not wait for each other.
    let square = r * r;
    let [mut odd, mut even] = [0, 1].map(|i| number(INVERSE_FACTORIALS[i]));
    for inverses in INVERSE_FACTORIALS[2..].as_chunks::<2>().0 {
        odd = odd.mul_add(square, number(inverses[0]));
        even = even.mul_add(square, number(inverses[1]));
    }
    let sum = odd.mul_add(r, even);
    // The bits of `2^n`: those of the whole number, as the exponent.
    let power = V::from_bits((shifted.to_bits() + 1023) << 52);
    sum * power
}
