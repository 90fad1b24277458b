//! The surface compliance of a coated half-space in Hankel space.
//!
//! Under a normal pressure `p`, the surface displacement is `u(k) = 2 X(kt) / (E1* k) p(k)`, with `X(0) = E1*/E0*` and
//! `X(inf) = 1`. With `m = G1/G0` (shear moduli), `g = 3 - 4 nu` and `q = kt`, `X = N/D`,
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
//! which is used up to `q = 1` with both brackets summed as power series, so that nothing cancels where `X` is small: a nearly
//! incompressible film on a rigid substrate has `X ~ 2/3 q^3`. Beyond, with `a = (m g0 - g1)/(1 + m g0)` and
//! `b = (m-1)/(m+g1)`,
//!
//! ```text
//! X - 1 = [(a + b + 4 b q (1+q)) e^{-2q} - 2 a b e^{-4q}] / [1 - (a + b + 4 b q^2) e^{-2q} + a b e^{-4q}]
//! ```

use interp::Material;

/// Where the series form hands over to the exponential one. Both keep 14 digits of `X` on either side.
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
        Self { c, a: (m * g0 - g1) / (1.0 + m * g0), b: (m - 1.0) / (m + g1) }
    }

    /// Film and substrate are one and the same material, in the sense of Dundurs: `X = 1` everywhere.
    pub fn is_homogeneous(&self) -> bool {
        self.a == 0.0 && self.b == 0.0
    }

    /// The smallest wave number, in units of `1/t`, on which `X` varies.
    ///
    /// A film much stiffer than its substrate has poles of `X` as low as `q ~ G0/G1` (shear lag) and `(G0/G1)^{1/3}` (bending);
    /// for all others the nearest pole is at `|q| > 1`.
    pub fn smallest_scale(&self) -> f64 {
        (0.5 * self.c[3] / self.c[0]).min(1.0)
    }

    /// `X(q)` for finite `q >= 0`, to 14 digits.
    pub fn x(&self, q: f64) -> f64 {
        if q <= SWITCH {
            let [n, d, ..] = self.fraction(q);
            n / d
        } else {
            1.0 + self.sample(q).excess
        }
    }

    /// `X(q) - 1` and `q X'(q)` for finite `q >= 0`, with an absolute error of a few rounding units of `max(X, 1)`.
    pub fn sample(&self, q: f64) -> Sample {
        if q <= SWITCH {
            let [n, d, n_prime, d_prime] = self.fraction(q);
            let x = n / d;
            Sample { excess: (n - d) / d, slope: q * (n_prime - x * d_prime) / d }
        } else {
            let (a, b) = (self.a, self.b);
            let e = (-2.0 * q).exp();
            let (sum, product) = (a + b, a * b);
            let numerator = (sum + 4.0 * b * q * (1.0 + q)) * e - 2.0 * product * e * e;
            let denominator = 1.0 - (sum + 4.0 * b * q * q) * e + product * e * e;
            let numerator_prime = (4.0 * b * (1.0 + 2.0 * q) - 2.0 * (sum + 4.0 * b * q * (1.0 + q))) * e + 8.0 * product * e * e;
            let denominator_prime = (2.0 * (sum + 4.0 * b * q * q) - 8.0 * b * q) * e - 4.0 * product * e * e;
            let excess = numerator / denominator;
            Sample { excess, slope: q * (numerator_prime - excess * denominator_prime) / denominator }
        }
    }

    /// `N`, `D`, `N'`, `D'`.
    fn fraction(&self, q: f64) -> [f64; 4] {
        let [c0, c1, c2, c3, c4] = self.c;
        let s = 2.0 * q;
        let (sinh_rest, cosh_rest) = hyperbolic_rests(s);
        let sinh = s + sinh_rest;
        let cosh = 1.0 + 0.5 * s * s + cosh_rest;
        [
            0.5 * (c0 * cosh + c1 * sinh_rest) + c2 * q,
            0.5 * (c3 + c1 * cosh_rest + c0 * sinh) + c4 * q * q,
            c0 * sinh + c1 * (cosh - 1.0) + c2,
            c1 * sinh_rest + c0 * cosh + 2.0 * c4 * q,
        ]
    }
}

/// `sinh s - s` and `cosh s - 1 - s^2/2` for `0 <= s <= 2`, to rounding, by their power series.
fn hyperbolic_rests(s: f64) -> (f64, f64) {
    /// The first neglected term at `s = 2` is below 1e-18 of the sum.
    const TERMS: u32 = 11;
    let square = s * s;
    let (mut sinh, mut cosh) = (1.0, 1.0);
    for k in (2..=TERMS).rev() {
        let k = f64::from(2 * k);
        sinh = 1.0 + sinh * (square / (k * (k + 1.0)));
        cosh = 1.0 + cosh * (square / ((k + 1.0) * (k + 2.0)));
    }
    (sinh * s * square / 6.0, cosh * square * square / 24.0)
}
