//! Truncated power series in the position `t` on a piece, four side by side.
//!
//! The four are the quantities on one piece, or one quantity on four pieces. Products, exponentials
//! and integrals of truncated series need the terms before a term only.
//!
//! Loops, not closures: a closure is compiled without the vector instructions of its function.

use fearless_simd::f64x4;
use fearless_simd::prelude::*;

/// The first `N` coefficients of four series, of `1, t, t^2, ...`
pub(crate) type Series<S, const N: usize> = [f64x4<S>; N];

/// The largest number of terms of a series.
const MOST_TERMS: usize = 12;

/// Repeats a block for each term number below a number of terms. It is not a loop: all terms stay
/// in registers as far as there are enough.
macro_rules! for_each_term {
    ($k:ident below $terms:ident $block:block) => {
        for_each_term!($k below $terms $block 0 1 2 3 4 5 6 7 8 9 10 11)
    };
    ($k:ident below $terms:ident $block:block $($number:literal)*) => {
        $(if $number < $terms {
            let $k: usize = $number;
            $block
        })*
    };
}

/// Returns `constant` times the exponential of `factor` times a series. The constant term of the
/// series is not used: `constant` includes its exponential.
#[inline(always)]
pub(crate) fn exponential<S: Simd, const M: usize, const N: usize>(
    simd: S,
    constant: f64x4<S>,
    factor: f64,
    exponent: &Series<S, M>,
) -> Series<S, N> {
    // By `v' = p' v`; `slopes[j]` is `j` times term `j` of `p`.
    let mut slopes = *exponent;
    for (j, slope) in slopes.iter_mut().enumerate() {
        *slope *= factor * j as f64;
    }
    let mut terms = [f64x4::splat(simd, 0.0); N];
    terms[0] = constant;
    for_each_term!(k below N {
        // The term just before this one is used last, because it is ready last.
        if k > 0 {
            let first = if k < M { k } else { M - 1 };
            let mut sum = slopes[first] * terms[k - first];
            for j in (1..first).rev() {
                sum = slopes[j].mul_add(terms[k - j], sum);
            }
            terms[k] = sum * (1.0 / k as f64);
        }
    });
    terms
}

/// Returns the product of two series.
#[inline(always)]
pub(crate) fn product<S: Simd, const M: usize, const N: usize>(
    left: &Series<S, M>,
    right: &Series<S, N>,
) -> Series<S, N> {
    let mut terms = *right;
    for_each_term!(k below N {
        let mut sum = left[0] * right[k];
        for i in 1..if k < M { k + 1 } else { M } {
            sum = left[i].mul_add(right[k - i], sum);
        }
        terms[k] = sum;
    });
    terms
}

/// Returns the sum of two series.
#[inline(always)]
pub(crate) fn sum<S: Simd, const N: usize>(
    left: &Series<S, N>,
    right: &Series<S, N>,
) -> Series<S, N> {
    let mut terms = *left;
    for k in 0..N {
        terms[k] += right[k];
    }
    terms
}

/// Returns the difference of two series.
#[inline(always)]
pub(crate) fn difference<S: Simd, const N: usize>(
    left: &Series<S, N>,
    right: &Series<S, N>,
) -> Series<S, N> {
    let mut terms = *left;
    for k in 0..N {
        terms[k] -= right[k];
    }
    terms
}

/// Returns the first terms of a series.
#[inline(always)]
pub(crate) fn first_terms<S: Simd, const M: usize, const N: usize>(
    series: &Series<S, M>,
) -> Series<S, N> {
    let mut terms = [series[0]; N];
    terms.copy_from_slice(&series[..N]);
    terms
}

/// Returns the quotient of two series.
#[inline(always)]
pub(crate) fn quotient<S: Simd, const N: usize>(
    simd: S,
    numerator: &Series<S, N>,
    denominator: &Series<S, N>,
) -> Series<S, N> {
    let inverse = f64x4::splat(simd, 1.0) / denominator[0];
    let mut terms = *numerator;
    for_each_term!(k below N {
        let mut sum = numerator[k];
        // The term just before this one is used last, because it is ready last.
        for i in (1..k + 1).rev() {
            sum = (-denominator[i]).mul_add(terms[k - i], sum);
        }
        terms[k] = sum * inverse;
    });
    terms
}

/// Returns the integral of a series from 0, times a factor.
#[inline(always)]
pub(crate) fn integral<S: Simd, const N: usize>(
    simd: S,
    series: &Series<S, N>,
    factor: f64x4<S>,
) -> Series<S, N> {
    let mut terms = [f64x4::splat(simd, 0.0); N];
    for k in 1..N {
        terms[k] = series[k - 1] * factor * (1.0 / k as f64);
    }
    terms
}

/// Returns the values of a series at -1 and at 1.
#[inline(always)]
pub(crate) fn ends<S: Simd, const N: usize>(series: &Series<S, N>) -> [f64x4<S>; 2] {
    let (mut even, mut odd) = (series[N - 2], series[N - 1]);
    for k in (0..N / 2 - 1).rev() {
        even += series[2 * k];
        odd += series[2 * k + 1];
    }
    [even - odd, even + odd]
}

/// Returns the series of lower degree that is nearest to a series between -1 and 1, term by term.
///
/// The highest term `t^n` is replaced by `t^n - T_n(t)/2^(n-1)`, with Chebyshev's polynomial `T_n`.
/// This changes the sum by `2^(1-n)` of the coefficient, not by all of it as leaving it out does.
#[inline(always)]
pub(crate) fn economised<S: Simd, const M: usize, const N: usize>(
    simd: S,
    series: &Series<S, M>,
) -> Series<S, N> {
    let mut series = *series;
    let left = M - N;
    for_each_term!(i below left {
        let n = M - 1 - i;
        for j in 1..=n / 2 {
            let share = f64x4::splat(simd, ECONOMY[n][j]);
            series[n - 2 * j] = series[n].mul_add(share, series[n - 2 * j]);
        }
    });
    first_terms(&series)
}

/// The coefficients of `t^(n - 2j)` in `t^n - T_n(t)/2^(n-1)`, for `j` above 0:
/// `-(-1/4)^j n/(n - j) (n - j)!/(j! (n - 2j)!)`.
const ECONOMY: [[f64; MOST_TERMS]; MOST_TERMS] = {
    let mut table = [[0.0; MOST_TERMS]; MOST_TERMS];
    let mut n = 1;
    while n < MOST_TERMS {
        let mut share = -1.0;
        let mut j = 1;
        while 2 * j <= n {
            share *= -0.25 * ((n - 2 * j + 2) * (n - 2 * j + 1)) as f64 / (j * (n - j)) as f64;
            table[n][j] = share;
            j += 1;
        }
        n += 1;
    }
    table
};

/// Transposes four rows of four numbers.
#[inline(always)]
pub(crate) fn transposed<S: Simd>([a, b, c, d]: [f64x4<S>; 4]) -> [f64x4<S>; 4] {
    let ((ac, ac_high), (bd, bd_high)) = (a.interleave(c), b.interleave(d));
    let ((first, second), (third, fourth)) = (ac.interleave(bd), ac_high.interleave(bd_high));
    [first, second, third, fourth]
}

#[cfg(test)]
mod tests {
    use fearless_simd::{Level, dispatch};

    use super::*;

    const N: usize = 12;

    /// Four polynomials whose coefficients fall by three.
    fn coefficients(shift: f64) -> [[f64; 4]; N] {
        std::array::from_fn(|k| {
            std::array::from_fn(|lane| {
                (1.0 + (k + lane) as f64 + shift).sin() / 3_f64.powi(k as i32)
            })
        })
    }

    /// Returns the largest difference of the value of a series at `t` from a function of the lane.
    fn miss<const M: usize>(series: [[f64; 4]; M], t: f64, exact: impl Fn(usize) -> f64) -> f64 {
        let value = |lane| (0..M).rev().fold(0.0, |sum, k| sum * t + series[k][lane]);
        (0..4)
            .map(|lane| (value(lane) - exact(lane)).abs())
            .fold(0.0, f64::max)
    }

    #[test]
    fn operations_are_those_of_the_functions() {
        let (left, mut right) = (coefficients(0.0), coefficients(0.3));
        right[0] = [2.0, -3.0, 2.5, 4.0];
        let value = |terms: &[[f64; 4]; N], lane: usize, t: f64| {
            terms
                .iter()
                .rev()
                .fold(0.0, |sum, term| sum * t + term[lane])
        };
        dispatch!(Level::new(), simd => {
            let [a, b] = [left, right].map(|terms| terms.map(|term| f64x4::simd_from(simd, term)));
            let out = |series: Series<_, N>| series.map(|term| *term.as_array());
            // What is left out is of order `t^12`.
            for t in [-0.02, 0.03] {
                let (of_a, of_b) = (|lane| value(&left, lane, t), |lane| value(&right, lane, t));
                assert!(miss(out(product(&a, &b)), t, |lane| of_a(lane) * of_b(lane)) < 1e-15);
                assert!(miss(out(quotient(simd, &a, &b)), t, |lane| of_a(lane) / of_b(lane)) < 1e-15);
                let constant = f64x4::simd_from(simd, left[0].map(|term| (-2.0 * term).exp()));
                let exponential: Series<_, N> = exponential(simd, constant, -2.0, &a);
                assert!(miss(out(exponential), t, |lane| (-2.0 * of_a(lane)).exp()) < 1e-14);
            }
            let integral = out(integral(simd, &a, f64x4::splat(simd, 2.0)));
            let expected = |lane| {
                let terms = (0..N - 1).map(|k| 2.0 * left[k][lane] * 0.5_f64.powi(k as i32 + 1) / (k + 1) as f64);
                terms.sum()
            };
            assert!(miss(integral, 0.5, expected) < 1e-15);
            let [low, high] = ends(&a).map(|end| *end.as_array());
            assert!(miss([low], 0.0, |lane| value(&left, lane, -1.0)) < 1e-15);
            assert!(miss([high], 0.0, |lane| value(&left, lane, 1.0)) < 1e-15);
            let rows = transposed([a[0], a[1], a[2], a[3]]).map(|row| *row.as_array());
            assert_eq!(rows, std::array::from_fn(|i| std::array::from_fn(|k| left[k][i])));
        });
    }

    /// The highest terms, `t^11` and `t^10`, change by `T_n/2^(n-1)`.
    #[test]
    fn economising_changes_little() {
        let mut terms = coefficients(0.0);
        (terms[10], terms[11]) = ([1.0; 4], [-1.0; 4]);
        let economised: [[f64; 4]; 10] = dispatch!(Level::new(), simd => {
            let series = terms.map(|term| f64x4::simd_from(simd, term));
            economised::<_, N, 10>(simd, &series).map(|term| *term.as_array())
        });
        for i in 0..=100 {
            let t = f64::from(i) / 50.0 - 1.0;
            let exact = |lane: usize| {
                terms
                    .iter()
                    .rev()
                    .fold(0.0, |sum, term| sum * t + term[lane])
            };
            let bound = 1.0 / 512.0 + 1.0 / 1024.0 + 1e-15;
            let miss = miss(economised, t, exact);
            assert!(miss <= bound, "{t}: {miss:e}, {bound:e}");
        }
    }
}
