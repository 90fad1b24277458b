//! Truncated power series in the position `t` on a piece, several side by side.
//!
//! They are several functions on one piece, or one function on [`LANES`] pieces. Products,
//! exponentials and integrals of truncated series need the terms before a term only.
//!
//! ```
//! use fearless_simd::prelude::*;
//! use fearless_simd::{Level, dispatch};
//! use piecewise::lanes::Lanes;
//! use piecewise::series::{Series, integral, product};
//!
//! // The integral of `(1 + t)^2` from 0, on eight pieces: `t + t^2 + t^3/3`.
//! let terms = dispatch!(Level::new(), simd => {
//!     let [zero, one] = [0.0, 1.0].map(|number| Lanes::splat(simd, number));
//!     let linear: Series<_, 4> = [one, one, zero, zero];
//!     integral(simd, &product(simd, &linear, &linear), 1.0).map(|term| *term.as_array())
//! });
//! assert_eq!(terms.map(|term| term[7]), [0.0, 1.0, 1.0, 1.0 / 3.0]);
//! ```
//!
//! Loops, not closures: a closure is compiled without the vector instructions of its function.

use fearless_simd::prelude::*;

use crate::lanes::{LANES, Lanes};

/// The first `N` coefficients of several series, of `1, t, t^2, ...`
pub type Series<V, const N: usize> = [V; N];

/// The largest number of terms of a series.
const MOST_TERMS: usize = 14;
/// The number of terms of the quotients of integrals and of powers of `x` on the longest pieces of a
/// curve, whose ends differ by a factor of 2: `1/x^3` converges slowly there.
pub const QUOTIENT_TERMS: usize = MOST_TERMS;

/// Repeats a block for each term number below a number of terms. It is no loop where vectors hold four numbers or more:
/// all terms stay in registers as far as there are enough.
macro_rules! for_each_term {
    ($simd:ident, $k:ident below $terms:ident $block:block) => {
        if const { is_unrolled::<$simd>() } {
            for_each_term!($k below $terms $block 0 1 2 3 4 5 6 7 8 9 10 11 12 13);
        } else {
            for $k in 0..$terms $block
        }
    };
    ($k:ident below $terms:ident $block:block $($number:literal)*) => {
        $(if $number < $terms {
            let $k: usize = $number;
            $block
        })*
    };
}

/// Returns whether `for_each_term` is no loop. With x86's vectors of two numbers there are too few registers for a gain:
/// loops take as long there, and far less time to compile.
const fn is_unrolled<S: Simd>() -> bool {
    let is_x86 = cfg!(any(target_arch = "x86", target_arch = "x86_64"));
    !is_x86 || size_of::<S::f64s>() > 2 * size_of::<f64>()
}

/// Returns `constant` times the exponential of `factor` times a series. The constant term of the
/// series is not used: `constant` includes its exponential.
#[inline(always)]
pub fn exponential<S: Simd, V: SimdFloat<S, Element = f64>, const M: usize, const N: usize>(
    simd: S,
    constant: V,
    factor: f64,
    exponent: &Series<V, M>,
) -> Series<V, N> {
    linear_solution(simd, constant, factor, exponent, &[])
}

/// Returns the solution `v` of `v' = factor (p' v + source)` that is `constant` at `t = 0`, with the
/// series `p` and a prime for `d/dt`.
#[inline(always)]
pub fn linear_solution<
    S: Simd,
    V: SimdFloat<S, Element = f64>,
    const M: usize,
    const N: usize,
    const K: usize,
>(
    simd: S,
    constant: V,
    factor: f64,
    p: &Series<V, M>,
    source: &Series<V, K>,
) -> Series<V, N> {
    let mut slopes = *p;
    for (j, slope) in slopes.iter_mut().enumerate() {
        *slope *= j as f64;
    }
    let mut terms = [V::splat(simd, 0.0); N];
    terms[0] = constant;
    for_each_term!(S, k below N {
        // The term just before this one is used last, because it is ready last.
        if k > 0 {
            let first = if k < M { k } else { M - 1 };
            let mut sum = if k <= K {
                slopes[first].mul_add(terms[k - first], source[k - 1])
            } else {
                slopes[first] * terms[k - first]
            };
            for j in (1..first).rev() {
                sum = slopes[j].mul_add(terms[k - j], sum);
            }
            terms[k] = sum * (factor / k as f64);
        }
    });
    terms
}

/// Returns the product of two series.
#[inline(always)]
pub fn product<S: Simd, V: SimdFloat<S, Element = f64>, const M: usize, const N: usize>(
    _: S,
    left: &Series<V, M>,
    right: &Series<V, N>,
) -> Series<V, N> {
    let mut terms = *right;
    for_each_term!(S, k below N {
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
pub fn sum<S: Simd, const N: usize>(
    left: &Series<Lanes<S>, N>,
    right: &Series<Lanes<S>, N>,
) -> Series<Lanes<S>, N> {
    let mut terms = *left;
    for k in 0..N {
        terms[k] += right[k];
    }
    terms
}

/// Returns the difference of two series, of which the second may have fewer terms.
#[inline(always)]
pub fn difference<S: Simd, const M: usize, const N: usize>(
    left: &Series<Lanes<S>, N>,
    right: &Series<Lanes<S>, M>,
) -> Series<Lanes<S>, N> {
    let mut terms = *left;
    for k in 0..M {
        terms[k] -= right[k];
    }
    terms
}

/// Multiplies a series by a number for each piece.
#[inline(always)]
pub fn scale<S: Simd, const N: usize>(series: &mut Series<Lanes<S>, N>, factor: Lanes<S>) {
    for term in series {
        *term *= factor;
    }
}

/// Multiplies a series by `middle + half t`.
#[inline(always)]
pub fn times_linear<S: Simd, const N: usize>(
    series: &mut Series<Lanes<S>, N>,
    middle: Lanes<S>,
    half: Lanes<S>,
) {
    for k in (1..N).rev() {
        series[k] = half.mul_add(series[k - 1], middle * series[k]);
    }
    series[0] *= middle;
}

/// Divides three polynomials by `1 + ratio t` to the powers 1, 2 and 3. The quotients may have more
/// terms than the polynomials.
///
/// A term of a quotient waits for the one before it. Therefore all divisions are made term by term
/// together.
#[inline(always)]
pub fn divided_by_powers<S: Simd, const M: usize, const N: usize>(
    simd: S,
    [first, second, third]: &[Series<Lanes<S>, M>; 3],
    ratio: Lanes<S>,
) -> [Series<Lanes<S>, N>; 3] {
    const {
        assert!(
            N <= MOST_TERMS,
            "there are no more terms in `for_each_term`"
        )
    };
    let (minus, zero) = (-ratio, Lanes::splat(simd, 0.0));
    let mut quotients = [[zero; N]; 3];
    let [by_1, by_2, by_3] = &mut quotients;
    (by_1[0], by_2[0], by_3[0]) = (first[0], second[0], third[0]);
    let (mut second_by_1, mut third_by_1, mut third_by_2) = (second[0], third[0], third[0]);
    for_each_term!(S, k below N {
        if k > 0 {
            let [mut of_first, mut of_second, mut of_third] = [zero; 3];
            if k < M {
                (of_first, of_second, of_third) = (first[k], second[k], third[k]);
            }
            by_1[k] = minus.mul_add(by_1[k - 1], of_first);
            second_by_1 = minus.mul_add(second_by_1, of_second);
            by_2[k] = minus.mul_add(by_2[k - 1], second_by_1);
            third_by_1 = minus.mul_add(third_by_1, of_third);
            third_by_2 = minus.mul_add(third_by_2, third_by_1);
            by_3[k] = minus.mul_add(by_3[k - 1], third_by_2);
        }
    });
    quotients
}

/// Returns the first terms of a series.
#[inline(always)]
pub fn first_terms<V: Copy, const M: usize, const N: usize>(series: &Series<V, M>) -> Series<V, N> {
    let mut terms = [series[0]; N];
    terms.copy_from_slice(&series[..N]);
    terms
}

/// Returns the quotient of two series.
#[inline(always)]
pub fn quotient<S: Simd, V: SimdFloat<S, Element = f64>, const N: usize>(
    simd: S,
    numerator: &Series<V, N>,
    denominator: &Series<V, N>,
) -> Series<V, N> {
    let inverse = V::splat(simd, 1.0) / denominator[0];
    let mut terms = *numerator;
    for_each_term!(S, k below N {
        let mut sum = numerator[k];
        // The term just before this one is used last, because it is ready last.
        for i in (1..k + 1).rev() {
            sum = (-denominator[i]).mul_add(terms[k - i], sum);
        }
        terms[k] = sum * inverse;
    });
    terms
}

/// Returns `factor` times the integral of a series from 0.
#[inline(always)]
pub fn integral<S: Simd, const N: usize>(
    simd: S,
    series: &Series<Lanes<S>, N>,
    factor: f64,
) -> Series<Lanes<S>, N> {
    let mut terms = [Lanes::splat(simd, 0.0); N];
    for k in 1..N {
        terms[k] = series[k - 1] * (factor / k as f64);
    }
    terms
}

/// Returns the values of a series at -1 and at 1.
#[inline(always)]
fn ends<S: Simd, const N: usize>(series: &Series<Lanes<S>, N>) -> [Lanes<S>; 2] {
    const { assert!(N.is_multiple_of(2), "the terms are added in pairs") };
    let (mut even, mut odd) = (series[N - 2], series[N - 1]);
    for k in (0..N / 2 - 1).rev() {
        even += series[2 * k];
        odd += series[2 * k + 1];
    }
    [even - odd, even + odd]
}

/// Returns the values of an integral, without its constants, at the beginnings and at the ends of the
/// pieces. On the first piece it begins at the position `start`, if there is one.
#[inline(always)]
pub fn limits<S: Simd, const N: usize>(
    start: Option<f64>,
    integral: &Series<Lanes<S>, N>,
) -> [Lanes<S>; 2] {
    let [mut from, to] = ends(integral);
    if let Some(t) = start {
        from[0] = integral
            .iter()
            .rev()
            .fold(0.0, |sum, term| sum * t + term[0]);
    }
    [from, to]
}

/// Adds the constants with which an integral goes on from piece to piece. `at` is its value where the
/// first piece begins, or at the position `start` on it, and becomes its value at the end of the last
/// piece.
#[inline(always)]
pub fn continued<S: Simd, const N: usize>(
    simd: S,
    start: Option<f64>,
    integral: &mut Series<Lanes<S>, N>,
    at: &mut f64,
) {
    integral[0] = constants_of_integration(simd, at, limits(start, integral));
}

/// Returns the constants with which an integral goes on from piece to piece, and changes `at`, its
/// value at the beginning of the first piece, to its value at the end of the last one. The [`limits`]
/// are its values without the constants at the beginnings and at the ends of the pieces.
#[inline(always)]
pub fn constants_of_integration<S: Simd>(
    simd: S,
    at: &mut f64,
    [from, to]: [Lanes<S>; 2],
) -> Lanes<S> {
    let zero = Lanes::splat(simd, 0.0);
    // The sums over the pieces up to each one.
    let mut sums = to - from;
    sums += zero.slide::<7>(sums);
    sums += zero.slide::<6>(sums);
    sums += zero.slide::<4>(sums);
    let constants = zero.slide::<7>(sums) - from + *at;
    *at += sums[LANES - 1];
    constants
}

/// Returns the series of lower degree that is nearest to a series between -1 and 1, term by term.
///
/// The highest term `t^n` is replaced by `t^n - T_n(t)/2^(n-1)`, with Chebyshev's polynomial `T_n`.
/// This changes the sum by `2^(1-n)` of the coefficient, not by all of it as leaving it out does.
#[inline(always)]
pub fn economised<S: Simd, V: SimdFloat<S, Element = f64>, const M: usize, const N: usize>(
    simd: S,
    series: &Series<V, M>,
) -> Series<V, N> {
    let mut series = *series;
    let left = M - N;
    for_each_term!(S, i below left {
        let n = M - 1 - i;
        for j in 1..=n / 2 {
            let share = V::splat(simd, ECONOMY[n][j]);
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

#[cfg(test)]
mod tests {
    use fearless_simd::{Level, dispatch};

    use super::*;

    const N: usize = 12;

    /// Polynomials whose coefficients fall by three.
    fn coefficients(shift: f64) -> [[f64; LANES]; N] {
        std::array::from_fn(|k| {
            std::array::from_fn(|lane| {
                (1.0 + (k + lane) as f64 + shift).sin() / 3_f64.powi(k as i32)
            })
        })
    }

    /// Returns the largest difference of the value of a series at `t` from a function of the lane.
    fn miss<const M: usize>(
        series: [[f64; LANES]; M],
        t: f64,
        exact: impl Fn(usize) -> f64,
    ) -> f64 {
        let value = |lane| (0..M).rev().fold(0.0, |sum, k| sum * t + series[k][lane]);
        (0..LANES)
            .map(|lane| (value(lane) - exact(lane)).abs())
            .fold(0.0, f64::max)
    }

    #[test]
    fn operations_are_those_of_the_functions() {
        let (left, mut right) = (coefficients(0.0), coefficients(0.3));
        right[0] = [2.0, -3.0, 2.5, 4.0, -2.0, 3.0, -2.5, 5.0];
        let value = |terms: &[[f64; LANES]; N], lane: usize, t: f64| {
            terms
                .iter()
                .rev()
                .fold(0.0, |sum, term| sum * t + term[lane])
        };
        dispatch!(Level::new(), simd => {
            let [a, b] = [left, right].map(|terms| terms.map(|term| Lanes::simd_from(simd, term)));
            let out = |series: Series<Lanes<_>, N>| series.map(|term| *term.as_array());
            // What is left out is of order `t^12`.
            for t in [-0.02, 0.03] {
                let (of_a, of_b) = (|lane| value(&left, lane, t), |lane| value(&right, lane, t));
                assert!(miss(out(product(simd, &a, &b)), t, |lane| of_a(lane) * of_b(lane)) < 1e-15);
                assert!(miss(out(quotient(simd, &a, &b)), t, |lane| of_a(lane) / of_b(lane)) < 1e-15);
                let constant = Lanes::simd_from(simd, left[0].map(|term| (-2.0 * term).exp()));
                let exponential: Series<Lanes<_>, N> = exponential(simd, constant, -2.0, &a);
                assert!(miss(out(exponential), t, |lane| (-2.0 * of_a(lane)).exp()) < 1e-14);
                let solution: Series<Lanes<_>, N> = linear_solution(simd, b[0], -2.0, &a, &b);
                let solution = out(solution);
                let slope = |terms: &[[f64; LANES]; N], lane: usize| {
                    let term = |k: usize| k as f64 * terms[k][lane] * t.powi(k as i32 - 1);
                    (1..N).map(term).sum::<f64>()
                };
                for lane in 0..LANES {
                    let product = slope(&left, lane) * value(&solution, lane, t);
                    let exact = -2.0 * (product + of_b(lane));
                    assert!((slope(&solution, lane) - exact).abs() < 1e-13);
                }
            }
            let ratio = [0.5, -0.3, 0.2, 0.0, 0.1, -0.5, 0.4, 0.3];
            let (half, one) = (Lanes::simd_from(simd, ratio), Lanes::splat(simd, 1.0));
            let mut powers = [a; 3];
            for (i, power) in powers.iter_mut().enumerate() {
                (0..=i).for_each(|_| times_linear(power, one, half));
            }
            for quotient in divided_by_powers::<_, N, N>(simd, &powers, half).map(out) {
                for (quotient, expected) in quotient.iter().flatten().zip(left.iter().flatten()) {
                    assert!((quotient - expected).abs() < 1e-15);
                }
            }
            // Quotients of more terms than the polynomials.
            let longer = divided_by_powers::<_, N, QUOTIENT_TERMS>(simd, &[a; 3], half * 0.1);
            for (quotient, power) in longer.iter().zip(1..) {
                let quotient = quotient.map(|term| *term.as_array());
                let exact = |lane| value(&left, lane, 0.3) / (1.0_f64 + 0.03 * ratio[lane]).powi(power);
                assert!(miss(quotient, 0.3, exact) < 1e-14);
            }
            let mut doubled = a;
            scale(&mut doubled, one + one);
            assert_eq!(out(doubled), left.map(|term| term.map(|number| 2.0 * number)));
            let integral = out(integral(simd, &a, 1.0));
            let expected = |lane| {
                let terms = (0..N - 1).map(|k| left[k][lane] * 0.5_f64.powi(k as i32 + 1) / (k + 1) as f64);
                terms.sum()
            };
            assert!(miss(integral, 0.5, expected) < 1e-15);
            let [low, high] = ends(&a).map(|end| *end.as_array());
            assert!(miss([low], 0.0, |lane| value(&left, lane, -1.0)) < 1e-15);
            assert!(miss([high], 0.0, |lane| value(&left, lane, 1.0)) < 1e-15);
            let mut at = 0.7;
            let constants = constants_of_integration(simd, &mut at, [a[0], b[0]]);
            let mut expected = 0.7;
            for lane in 0..LANES {
                let constant = constants.as_array()[lane];
                assert!((constant - (expected - left[0][lane])).abs() < 1e-14);
                expected += right[0][lane] - left[0][lane];
            }
            assert!((at - expected).abs() < 1e-14);
        });
    }

    /// The highest terms, `t^11` and `t^10`, change by `T_n/2^(n-1)`.
    #[test]
    fn economising_changes_little() {
        let mut terms = coefficients(0.0);
        (terms[10], terms[11]) = ([1.0; LANES], [-1.0; LANES]);
        let economised: [[f64; LANES]; 10] = dispatch!(Level::new(), simd => {
            let series = terms.map(|term| Lanes::simd_from(simd, term));
            economised::<_, _, N, 10>(simd, &series).map(|term| *term.as_array())
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
