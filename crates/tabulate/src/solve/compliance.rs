//! The surface compliance of a coated half-space in Hankel space.
//!
//! Under a normal pressure `p`, the surface displacement is `u(k) = 2 X(kt) / (E1* k) p(k)`, with
//! `X(0) = E1*/E0*` and `X(inf) = 1`. With `m = G1/G0` (shear moduli), `g = 3 - 4 nu` and `q = kt`,
//! `X = N/D`,
//!
//! ```text
//! N = c0/2 cosh 2q + c1/2 (sinh 2q - 2q)        + c2 q
//! D = c3/2         + c1/2 (cosh 2q - 1 - 2q^2)  + c0/2 sinh 2q + c4 q^2
//!
//! c0 = m (1+g1)(1+g0)            c3 = (1+g1)^2
//! c1 = 2 m^2 g0 + m (g0-1)(g1-1) + 2 g1
//! c2 = 4 m^2 g0 - 8 m nu1 (1-2 nu0) + 4 (1-2 nu1)
//! c4 = (1+g1) (m (g0-1) + 2)
//! ```
//!
//! which is used up to `q = 1` with both brackets summed as power series, so that nothing cancels
//! where `X` is small: a nearly incompressible film on a rigid substrate has `X ~ 2/3 q^3`. Beyond,
//! with `a = (m g0 - g1)/(1 + m g0)` and `b = (m-1)/(m+g1)`,
//!
//! ```text
//! X - 1 = [(a + b + 4 b q (1+q)) e^{-2q} - 2 a b e^{-4q}] / [1 - (a + b + 4 b q^2) e^{-2q} + a b e^{-4q}]
//! ```
//!
//! Both forms continue `X` into the right half of the complex plane, where `wiener_hopf.rs` uses
//! it. `N` and `D` are neither even nor odd: on the real line `X` is a function of `|q|`, and its
//! continuations from the right and from the left differ on the imaginary axis.

use std::ops::{Add, Mul};

use interp::Material;
use num_complex::ComplexFloat;

/// Real and complex wave numbers.
pub(crate) trait WaveNumber:
    ComplexFloat<Real = f64> + Add<f64, Output = Self> + Mul<f64, Output = Self>
{
}

impl<T: ComplexFloat<Real = f64> + Add<f64, Output = T> + Mul<f64, Output = T>> WaveNumber for T {}

/// Where the series form hands over to the exponential one. Both keep 14 digits of `X` on either
/// side.
const SWITCH: f64 = 1.0;

/// The function `X(q)` of one film on one substrate; the sphere is not part of it.
#[derive(Clone, Copy, Debug)]
pub struct Compliance {
    c: [f64; 5],
    a: f64,
    b: f64,
}

/// What the solve needs of `X` at one abscissa.
#[derive(Clone, Copy, Debug)]
pub struct Sample {
    /// `X(q) - 1`.
    pub excess: f64,
    /// `q X'(q)`.
    pub slope: f64,
}

impl Compliance {
    /// The compliance of the material's film on its substrate.
    pub fn new(material: &Material) -> Self {
        let (nu1, nu0) = (material.nu1(), material.nu0());
        let (g1, g0) = (3.0 - 4.0 * nu1, 3.0 - 4.0 * nu0);
        let m = material.film_over_substrate() * ((1.0 + nu0) / (1.0 + nu1));
        let c = [
            m * (1.0 + g1) * (1.0 + g0),
            2.0 * m * m * g0 + m * (g0 - 1.0) * (g1 - 1.0) + 2.0 * g1,
            4.0 * m * m * g0 - 8.0 * m * nu1 * (1.0 - 2.0 * nu0) + 4.0 * (1.0 - 2.0 * nu1),
            (1.0 + g1) * (1.0 + g1),
            (1.0 + g1) * (m * (g0 - 1.0) + 2.0),
        ];
        Self {
            c,
            a: (m * g0 - g1) / (1.0 + m * g0),
            b: (m - 1.0) / (m + g1),
        }
    }

    /// Film and substrate are one and the same material, in the sense of Dundurs: `X = 1`
    /// everywhere.
    pub fn is_homogeneous(&self) -> bool {
        self.a == 0.0 && self.b == 0.0
    }

    /// The smallest wave number, in units of `1/t`, on which `X` varies.
    ///
    /// A film much stiffer than its substrate has poles of `X` as low as `q ~ G0/G1` (shear lag)
    /// and `(G0/G1)^{1/3}` (bending); for all others the nearest pole is at `|q| > 1`.
    pub fn smallest_scale(&self) -> f64 {
        (0.5 * self.c[3] / self.c[0]).min(1.0)
    }

    /// `X(q)` for finite `q >= 0`, to 14 digits.
    pub fn x(&self, q: f64) -> f64 {
        self.continued(q)
    }

    /// `X(q)` where `Re q >= 0`.
    pub(crate) fn continued<T: WaveNumber>(&self, q: T) -> T {
        if q.abs() <= SWITCH {
            let [n, d] = self.fraction(q);
            n / d
        } else {
            let (sum, product) = (self.a + self.b, self.a * self.b);
            let e = (q * -2.0).exp();
            let numerator = ((q * q + q) * (4.0 * self.b) + sum) * e + e * e * (-2.0 * product);
            let denominator = (q * q * (4.0 * self.b) + sum) * e * -1.0 + e * e * product + 1.0;
            numerator / denominator + 1.0
        }
    }

    /// The coefficients of `1`, `q`, `q^2` and `q^3` in the power series of `N` and of `D`. All
    /// that follow are positive.
    pub(crate) fn leading(&self) -> [[f64; 4]; 2] {
        let [c0, c1, c2, c3, c4] = self.c;
        [
            [0.5 * c0, c2, c0, 2.0 / 3.0 * c1],
            [0.5 * c3, c0, c4, 2.0 / 3.0 * c0],
        ]
    }

    /// `X(q) - 1` and `q X'(q)` for finite `q >= 0`, with an absolute error of a few rounding units
    /// of `max(X, 1)`.
    pub fn sample(&self, q: f64) -> Sample {
        if q <= SWITCH {
            let [n, d] = self.fraction(q);
            let [n_prime, d_prime] = self.slopes(q);
            let x = n / d;
            Sample {
                excess: (n - d) / d,
                slope: q * (n_prime - x * d_prime) / d,
            }
        } else {
            let (a, b) = (self.a, self.b);
            let e = (-2.0 * q).exp();
            let (sum, product) = (a + b, a * b);
            let numerator = (sum + 4.0 * b * q * (1.0 + q)) * e - 2.0 * product * e * e;
            let denominator = 1.0 - (sum + 4.0 * b * q * q) * e + product * e * e;
            let numerator_prime =
                (4.0 * b * (1.0 + 2.0 * q) - 2.0 * (sum + 4.0 * b * q * (1.0 + q))) * e
                    + 8.0 * product * e * e;
            let denominator_prime =
                (2.0 * (sum + 4.0 * b * q * q) - 8.0 * b * q) * e - 4.0 * product * e * e;
            let excess = numerator / denominator;
            Sample {
                excess,
                slope: q * (numerator_prime - excess * denominator_prime) / denominator,
            }
        }
    }

    /// `N` and `D` for `|q| <= 1`.
    pub(crate) fn fraction<T: WaveNumber>(&self, q: T) -> [T; 2] {
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

    /// `N'` and `D'` for `q <= 1`.
    fn slopes(&self, q: f64) -> [f64; 2] {
        let [c0, c1, c2, _, c4] = self.c;
        let [sinh_rest, cosh_rest] = hyperbolic_rests(2.0 * q);
        let (sinh, cosh_less_one) = (sinh_rest + 2.0 * q, cosh_rest + 2.0 * q * q);
        [
            c0 * sinh + c1 * cosh_less_one + c2,
            c1 * sinh_rest + c0 * (cosh_less_one + 1.0) + 2.0 * c4 * q,
        ]
    }
}

/// `sinh s - s` and `cosh s - 1 - s^2/2` for `|s| <= 2`, to rounding, by their power series.
fn hyperbolic_rests<T: WaveNumber>(s: T) -> [T; 2] {
    /// The first neglected term at `s = 2` is below 1e-18 of the sum.
    const TERMS: u32 = 11;
    let square = s * s;
    let (mut sinh, mut cosh) = (T::one(), T::one());
    for k in (2..=TERMS).rev() {
        let k = f64::from(2 * k);
        sinh = sinh * square * (1.0 / (k * (k + 1.0))) + 1.0;
        cosh = cosh * square * (1.0 / ((k + 1.0) * (k + 2.0))) + 1.0;
    }
    [
        s * square * sinh * (1.0 / 6.0),
        square * square * cosh * (1.0 / 24.0),
    ]
}
