//! The film on its substrate: the surface compliance of a coated half-space in Hankel space.
//!
//! Under a normal pressure `p`, the surface displacement is `u(k) = 2 X(kt) / (E1* k) p(k)`, with
//! `X(0) = E1*/E0*` and `X(inf) = 1`. With `m = G1/G0` (shear moduli), `g = 3 - 4 nu` and `q = kt`,
//! `X = N/D`,
//!
//! ```text
//! N = c0/2 cosh 2q + c1/2 (sinh 2q - 2q)        + c2 q
//! D = c3/2         + c1/2 (cosh 2q - 1 - 2q^2)  + c0/2 sinh 2q + c4 q^2
//! ```
//!
//! with [`Material::compliance_coefficients`]. This form is used up to `q = 1`. Both brackets are
//! summed as power series, so that nothing cancels where `X` is small: a nearly incompressible film
//! on a rigid substrate has `X ~ 2/3 q^3`. Beyond `q = 1`, with `a = (m g0 - g1)/(1 + m g0)` and `b = (m-1)/(m+g1)`,
//!
//! ```text
//! X - 1 = [(a + b + 4 b q (1+q)) e^{-2q} - 2 a b e^{-4q}] / [1 - (a + b + 4 b q^2) e^{-2q} + a b e^{-4q}]
//! ```
//!
//! Both forms continue `X` into the right half of the complex plane, where `wiener_hopf.rs` uses
//! it. `N` and `D` are neither even nor odd: on the real line `X` is a function of `|q|`, and its
//! continuations from the right and from the left differ on the imaginary axis.
//!
//! The contact's symbol adds the sphere: `S = sphere + film X` with two constants `sphere >= 0` and
//! `film > 0`. Its zeros follow from `N` and `D` ([`zero`](crate::compliance::zero)).

use std::ops::{Add, Mul, Sub};

use fearless_simd::prelude::*;
use interp::Material;
use num_complex::{Complex64, ComplexFloat};

use crate::compliance::exponential::exponential;
use crate::compliance::surface::{AllSamples, SurfaceCompliance, VectorCompliance, sample_all};

/// A real or complex wave number: `f64` or [`Complex64`].
pub trait WaveNumber:
    ComplexFloat<Real = f64> + Add<f64, Output = Self> + Mul<f64, Output = Self>
{
}

impl<T: ComplexFloat<Real = f64> + Add<f64, Output = T> + Mul<f64, Output = T>> WaveNumber for T {}

/// The sine of 52 degrees. No zero and no pole of `S` was found within 53 degrees of the real axis,
/// for any film, substrate and sphere; a test looks for them.
pub const SINE_OF_FREE_ANGLE: f64 = 0.788;

/// The wave number beyond which `X` differs from 1 by less than rounding, for every film.
pub const FLAT: f64 = 24.0;

/// The largest `|q|` of the series form; the exponential form is used beyond. Both give 14 digits
/// of `X` on either side.
pub(crate) const SWITCH: f64 = 1.0;

/// The function `X(q)` of one film on one substrate; the sphere is not part of it.
#[derive(Clone, Copy, Debug)]
pub struct Compliance {
    c: [f64; 5],
    a: f64,
    b: f64,
}

impl Compliance {
    /// Returns the compliance of the film of `material` on its substrate.
    pub fn new(material: &Material) -> Self {
        let (nu1, nu0) = (material.nu1(), material.nu0());
        let (g1, g0) = (3.0 - 4.0 * nu1, 3.0 - 4.0 * nu0);
        let m = material.film_over_substrate() * ((1.0 + nu0) / (1.0 + nu1));
        Self {
            c: material.compliance_coefficients(),
            a: (m * g0 - g1) / (1.0 + m * g0),
            b: (m - 1.0) / (m + g1),
        }
    }

    /// Returns `X(q)` to 14 digits, for a finite `q >= 0` or a complex `q` with `Re q >= 0`.
    pub fn x<T: WaveNumber>(&self, q: T) -> T {
        // By squares: a modulus takes longer.
        if q.re() * q.re() + q.im() * q.im() <= SWITCH * SWITCH {
            let [n, d] = self.fraction(q);
            n / d
        } else {
            let [[numerator, denominator], _] = self.exponential_fraction(q, (q * -2.0).exp());
            numerator / denominator + 1.0
        }
    }

    /// Returns `X` at several finite `q >= 0`, as [`Compliance::x`].
    #[inline(always)]
    pub(crate) fn x_of_group<S: Simd>(&self, simd: S, q: S::f64s) -> S::f64s {
        let [n, d] = self.fraction(q);
        let thin = q.simd_le(SWITCH);
        if thin.all_true() {
            return n / d;
        }
        let [[numerator, denominator], _] =
            self.exponential_fraction(q, exponential(simd, q * -2.0));
        thin.select(n / d, numerator / denominator + 1.0)
    }

    /// Returns `X - 1` and `q X'` at several `q` by the series, for `q <= 1`.
    #[inline(always)]
    fn series_samples<S: Simd>(&self, q: S::f64s) -> [S::f64s; 2] {
        let [n, d] = self.fraction(q);
        let [n_prime, d_prime] = self.slopes(q);
        let x = n / d;
        [(n - d) / d, q * (n_prime - x * d_prime) / d]
    }

    /// Returns `X - 1` and `q X'` at several `q` by exponential functions, for `q > 1`. `e` is
    /// `e^{-2q}`.
    #[inline(always)]
    fn exponential_samples<S: Simd>(&self, q: S::f64s, e: S::f64s) -> [S::f64s; 2] {
        let [
            [numerator, denominator],
            [numerator_prime, denominator_prime],
        ] = self.exponential_fraction(q, e);
        let excess = numerator / denominator;
        [
            excess,
            q * (numerator_prime - excess * denominator_prime) / denominator,
        ]
    }

    /// Returns the numerator and the denominator of `X`, and their slopes at a zero of their sum
    /// with any weights. Beyond the switch of the two forms all have another factor.
    pub(crate) fn fraction_and_slopes(&self, q: Complex64) -> [[Complex64; 2]; 2] {
        if q.norm() <= SWITCH {
            [self.fraction(q), self.slopes(q)]
        } else {
            self.exponential_fraction(q, (q * -2.0).exp())
                .map(|[numerator, denominator]| [numerator + denominator, denominator])
        }
    }

    /// Returns the numerator and the denominator of `X - 1` by exponential functions, for
    /// `|q| > 1`, and their slopes. `e` is `e^{-2q}`.
    #[inline(always)]
    fn exponential_fraction<T>(&self, q: T, e: T) -> [[T; 2]; 2]
    where
        T: Copy
            + Add<Output = T>
            + Sub<Output = T>
            + Mul<Output = T>
            + Add<f64, Output = T>
            + Mul<f64, Output = T>,
    {
        let (sum, product, b) = (self.a + self.b, self.a * self.b, self.b);
        let (square, e_square) = (q * q, e * e);
        let of_numerator = (square + q) * (4.0 * b) + sum;
        let of_denominator = square * (4.0 * b) + sum;
        [
            [
                of_numerator * e - e_square * (2.0 * product),
                e_square * product - of_denominator * e + 1.0,
            ],
            [
                (q * (8.0 * b) + 4.0 * b - of_numerator * 2.0) * e + e_square * (8.0 * product),
                (of_denominator * 2.0 - q * (8.0 * b)) * e - e_square * (4.0 * product),
            ],
        ]
    }

    /// Returns a wave number, at most 1, below which `S = sphere + film X` hardly varies: there its
    /// numerator `sphere D + film N` and its denominator `D` keep close to their values at 0. Needs
    /// `S(0) > 0`.
    pub(crate) fn smallest_scale_of_sum(&self, sphere: f64, film: f64) -> f64 {
        let scale = |[value, rest @ ..]: [f64; 4]| {
            let [linear, quadratic, cubic] = rest.map(|coefficient| value / coefficient.abs());
            linear.min(quadratic.sqrt()).min(cubic.cbrt()).min(1.0)
        };
        scale(self.leading_of_sum(sphere, film)).min(scale(self.leading()[1]))
    }

    /// Returns the coefficients of `1`, `q`, `q^2` and `q^3` in the power series of `N` and of `D`.
    /// All that follow are positive.
    fn leading(&self) -> [[f64; 4]; 2] {
        let [c0, c1, c2, c3, c4] = self.c;
        [
            [0.5 * c0, c2, c0, 2.0 / 3.0 * c1],
            [0.5 * c3, c0, c4, 2.0 / 3.0 * c0],
        ]
    }

    /// Returns the coefficients of `1`, `q`, `q^2` and `q^3` in the power series of
    /// `sphere D + film N`, the numerator of `S`.
    pub(crate) fn leading_of_sum(&self, sphere: f64, film: f64) -> [f64; 4] {
        let [n, d] = self.leading();
        std::array::from_fn(|i| sphere * d[i] + film * n[i])
    }

    /// Returns `N` and `D` for `|q| <= 1`.
    #[inline(always)]
    pub(crate) fn fraction<T>(&self, q: T) -> [T; 2]
    where
        T: Copy + Add<Output = T> + Mul<Output = T> + Add<f64, Output = T> + Mul<f64, Output = T>,
    {
        let [c0, c1, c2, c3, c4] = self.c;
        let [sinh_rest, cosh_rest] = hyperbolic_rests(q * 2.0);
        let square = q * q;
        let sinh = sinh_rest + q * 2.0;
        let cosh = cosh_rest + square * 2.0 + 1.0;
        [
            cosh * (0.5 * c0) + sinh_rest * (0.5 * c1) + q * c2,
            cosh_rest * (0.5 * c1) + sinh * (0.5 * c0) + square * c4 + 0.5 * c3,
        ]
    }

    /// Returns the real and imaginary parts of `N` and `D` at `q = i p`, for `0 <= p <= 1`.
    #[inline(always)]
    pub(crate) fn fraction_on_axis<T>(&self, p: T) -> [[T; 2]; 2]
    where
        T: Copy + Add<Output = T> + Mul<Output = T> + Add<f64, Output = T> + Mul<f64, Output = T>,
    {
        let [c0, c1, c2, c3, c4] = self.c;
        let square = p * p * -1.0;
        // `sinh 2q = i sin 2p`.
        let [sine_rest, cosh_rest] = rests(p * 2.0, square * 4.0);
        let sine = sine_rest + p * 2.0;
        let cosh = cosh_rest + square * 2.0 + 1.0;
        [
            [cosh * (0.5 * c0), sine_rest * (0.5 * c1) + p * c2],
            [
                cosh_rest * (0.5 * c1) + square * c4 + 0.5 * c3,
                sine * (0.5 * c0),
            ],
        ]
    }

    /// Returns `N'` and `D'` for `0 <= q <= 1`.
    #[inline(always)]
    fn slopes<T>(&self, q: T) -> [T; 2]
    where
        T: Copy + Add<Output = T> + Mul<Output = T> + Add<f64, Output = T> + Mul<f64, Output = T>,
    {
        let [c0, c1, c2, _, c4] = self.c;
        let [sinh_rest, cosh_rest] = hyperbolic_rests(q * 2.0);
        let (sinh, cosh_less_one) = (sinh_rest + q * 2.0, cosh_rest + q * q * 2.0);
        [
            sinh * c0 + cosh_less_one * c1 + c2,
            sinh_rest * c1 + (cosh_less_one + 1.0) * c0 + q * (2.0 * c4),
        ]
    }
}

impl VectorCompliance for Compliance {
    #[inline(always)]
    fn samples<S: Simd>(&self, simd: S, q: S::f64s) -> [S::f64s; 2] {
        let thin = q.simd_le(SWITCH);
        if thin.all_true() {
            return self.series_samples::<S>(q);
        }
        let mut samples = self.exponential_samples::<S>(q, exponential(simd, q * -2.0));
        if thin.any_true() {
            let [excess, slope] = self.series_samples::<S>(q);
            samples = [
                thin.select(excess, samples[0]),
                thin.select(slope, samples[1]),
            ];
        }
        samples
    }
}

impl SurfaceCompliance for Compliance {
    /// No zero and no pole of a film is nearer to the real axis than 53 degrees: the
    /// ellipse of convergence of a panel `[c, 4c]` is 2.5.
    fn points(&self, tolerance: f64, oscillates: bool) -> usize {
        match tolerance {
            _ if oscillates => 32,
            1e-6.. => 16,
            3e-11.. => 20,
            _ => 24,
        }
    }

    fn sample_all(&self, q: &[f64]) -> AllSamples {
        sample_all(self, q)
    }

    /// A film much stiffer than its substrate has poles of `X` as low as `q ~ G0/G1` (shear lag)
    /// and `(G0/G1)^{1/3}` (bending). For all other films the nearest pole is at `|q| > 1`.
    ///
    /// Below `1e-20 (G0/G1)^{1/3}` lies no more than `1e-20` of the integral of `X`.
    fn smallest_scale(&self) -> f64 {
        let shear_lag = 0.5 * self.c[3] / self.c[0];
        shear_lag.max(1e-20 * shear_lag.cbrt()).min(1.0)
    }

    /// `X` lies between 0 and the larger of `2 X(0)` and 2. It is 1 everywhere where film and
    /// substrate are one material in the sense of Dundurs.
    fn largest_excess(&self) -> f64 {
        if self.a == 0.0 && self.b == 0.0 {
            0.0
        } else {
            2.0 * (self.c[0] / self.c[3]).max(1.0)
        }
    }
}

/// Returns `sinh s - s` and `cosh s - 1 - s^2/2` for `|s| <= 2`, to rounding, by their power
/// series.
// Without closures, which are compiled without the vector instructions of their function.
#[inline(always)]
pub fn hyperbolic_rests<T>(s: T) -> [T; 2]
where
    T: Copy + Mul<Output = T> + Add<f64, Output = T> + Mul<f64, Output = T>,
{
    rests(s, s * s)
}

/// Returns [`hyperbolic_rests`] of the root of `square`, which may be negative: `factor` over this root
/// is a factor of the first one.
#[inline(always)]
fn rests<T>(factor: T, square: T) -> [T; 2]
where
    T: Copy + Mul<Output = T> + Add<f64, Output = T> + Mul<f64, Output = T>,
{
    let [of_sinh, of_cosh] = REST_FACTORS[TERMS - 1];
    let (mut sinh, mut cosh) = (square * of_sinh + 1.0, square * of_cosh + 1.0);
    for [of_sinh, of_cosh] in REST_FACTORS[1..TERMS - 1].iter().rev() {
        sinh = sinh * square * *of_sinh + 1.0;
        cosh = cosh * square * *of_cosh + 1.0;
    }
    [
        factor * square * sinh * (1.0 / 6.0),
        square * square * cosh * (1.0 / 24.0),
    ]
}

/// The number of terms of both power series. The first neglected one at `s = 2` is below 1e-18 of
/// the sum.
const TERMS: usize = 11;

/// The ratios of neighbouring terms of both power series over `s^2`.
const REST_FACTORS: [[f64; 2]; TERMS] = {
    let mut factors = [[0.0; 2]; TERMS];
    let mut i = 0;
    while i < TERMS {
        let k = 2.0 * (i + 1) as f64;
        factors[i] = [1.0 / (k * (k + 1.0)), 1.0 / ((k + 1.0) * (k + 2.0))];
        i += 1;
    }
    factors
};

#[cfg(test)]
mod tests {
    use rand::SeedableRng;
    use rand_pcg::Pcg64Mcg;

    use crate::compliance::surface::tests::assert_that_the_cut_off_bounds_the_rest;
    use crate::compliance::zero::tests::Sum;

    /// Beyond the cut-off, `X - 1` and `q X'` are below the tolerance for all films. Measured: at
    /// most 0.27 of the tolerance.
    #[test]
    fn the_cut_off_bounds_the_rest() {
        let mut random = Pcg64Mcg::seed_from_u64(3);
        assert_that_the_cut_off_bounds_the_rest(
            (0..1000).map(|_| Sum::random(&mut random).compliance),
        );
    }
}
