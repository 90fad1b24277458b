//! Coulomb wave functions, which make the transforms of the edge functions of a sticking contact.
//!
//! The contact's normal and tangential fields are expanded together in
//! `((1-s)/(1+s))^{i eps} P_n^{(i eps, -i eps)}(s)` on `[-1, 1]`, whose Fourier transforms are
//! Coulomb wave functions `F_n` (DLMF 33). With `s+_n = +,+,-,-,+,+,..` and `s-_n = (-1)^n s+_n`
//!
//! ```text
//! P+-_n(z) = s+-_n sqrt(2n+1) e^{-+ pi eps/2} F_n(-+eps, z)/z          p_n = (P+ + P-)/2      q_n = (P+ - P-)/2
//! ```
//!
//! For `eps = 0` these are Legendre polynomials and spherical Bessel functions: `p_n` is 0 for odd
//! `n` and `q_n` for even `n`. With `eta = -+eps`, `R_n^2 = 1 + (eps/n)^2` and
//! `F_n(eta, z)/z = e^{-pi eta/2} c0 R_1 .. R_n rho_n g_n`, `c0^2 = pi eps/sinh(pi eps)`,
//! `rho_0 = rho_1 = 1`, `rho_n = rho_{n-2}/R_n^2`, the recurrence of DLMF 33.4 is
//!
//! ```text
//! g_{n-1} = (2n+1) (rho_n/rho_{n-1}) (1/z + eta/(n(n+1))) g_n - g_{n+1}
//! ```
//!
//! It is run downwards (Miller), and scaled by the expansion of `e^{-izs}` at `s = 0`,
//! `sum_n (2n+1) r_n rho_n g_n = 1` with `r_0 = 1`, `r_1 = -eta`, `r_n = ((n-1)^2 + eps^2)/(n(n-1)) r_{n-2}`:
//! no sines and cosines are needed. Where all orders are below 0.95 `z` it is run upwards, from the
//! asymptotic series of `F_0` and `F_1` (DLMF 33.11).

use std::f64::consts::PI;

use fearless_simd::prelude::*;
use fearless_simd::{Level, dispatch, f64x8};

/// The number of arguments handled at once.
pub const LANES: usize = 8;

/// The least `z` at which asymptotic series are exact to rounding.
pub const ASYMPTOTIC: f64 = 40.0;

/// The number of terms of the asymptotic series: at `z = 40` the next one is below 1e-17.
const TERMS: usize = 20;

/// Evaluates `g_n` up to twice the number of `modes`.
#[derive(Clone, Debug)]
pub struct Coulomb {
    pub eps: f64,
    pub modes: usize,
    /// The recurrence and the scaling sum, order by order.
    pub steps: Vec<Step>,
    /// `s+_n sqrt(2n+1) c0 R_1 .. R_n rho_n/2`.
    pub scale: Vec<f64>,
    /// `arg Gamma(1 + i eps)`.
    phase: f64,
    /// `e^{pi eta/2}/c0` for `eta = -eps` and `eta = eps`.
    amplitude: [f64; 2],
}

/// The coefficients at order `n`, for `eta = eps`. `eps` changes its sign with `eta`.
#[derive(Clone, Copy, Debug)]
pub struct Step {
    /// `(2n+1) rho_n/rho_{n-1}`.
    pub per_z: f64,
    /// The same times `eps/(n(n+1))`; 0 at `n = 0`.
    pub charge: f64,
    /// `(2n+1) r_n rho_n`.
    weight: f64,
}

/// `g_n` at a group of arguments for `N` signs of `eta`: first `-eps`, then `eps`.
pub type Functions<S, const N: usize> = [f64x8<S>; N];

/// The sign of `eta/eps` of each of the [`Functions`].
const SIGNS: [f64; 2] = [-1.0, 1.0];

impl Coulomb {
    /// Prepares an even number of `modes` for arguments up to `largest`.
    pub fn new(eps: f64, modes: usize, largest: f64) -> Self {
        debug_assert!(modes >= 2 && modes.is_multiple_of(2));
        // A group of arguments that begins below `upwards` ends below twice that.
        let count = top(largest.min(2.0 * upwards(modes))).max(2 * modes) + 2;
        let square = |n: usize| 1.0 + (eps / n as f64).powi(2);
        let (mut r, mut rho) = ([1.0, -eps], [1.0; 2]);
        let step = |n: usize| {
            let m = n as f64;
            if n >= 2 {
                r[n % 2] *= ((m - 1.0).powi(2) + eps * eps) / (m * (m - 1.0));
                rho[n % 2] /= square(n);
            }
            let odd = 2.0 * m + 1.0;
            let per_z = odd * rho[n % 2] / rho[(n + 1) % 2];
            Step {
                per_z,
                charge: if n == 0 {
                    0.0
                } else {
                    per_z * eps / (m * (m + 1.0))
                },
                weight: odd * r[n % 2] * rho[n % 2],
            }
        };
        let steps = (0..count).map(step).collect();
        // The products `R_1 .. R_n rho_n` of even and odd orders.
        let (mut products, mut root) = ([0.5 * c0(eps); 2], 1.0);
        let scale = |n: usize| {
            if n > 0 {
                let next = square(n).sqrt();
                products[n % 2] *= if n == 1 { next } else { root / next };
                root = next;
            }
            let sign = if n % 4 < 2 { 1.0 } else { -1.0 };
            sign * ((2 * n + 1) as f64).sqrt() * products[n % 2]
        };
        Self {
            eps,
            modes,
            steps,
            scale: (0..modes).map(scale).collect(),
            phase: phase_of_gamma(eps),
            amplitude: SIGNS.map(|sign| (0.5 * sign * PI * eps).exp() / c0(eps)),
        }
    }

    /// Returns `g_n` of `eta = -eps` at one argument.
    pub fn functions_at(&self, z: f64) -> Vec<f64> {
        dispatch!(Level::new(), simd => self.first_lane(simd, z))
    }

    #[inline(always)]
    fn first_lane<S: Simd>(&self, simd: S, z: f64) -> Vec<f64> {
        let mut functions = vec![[[f64x8::splat(simd, 0.0)]]; 2 * self.modes];
        self.functions(simd, &[z; LANES], &mut functions, 0);
        functions.iter().map(|[[value]]| value[0]).collect()
    }

    /// Writes `g_n` of each sign of `eta`, as the group number `at` of each order.
    #[inline(always)]
    pub fn functions<S: Simd, const N: usize, const GROUPS: usize>(
        &self,
        simd: S,
        z: &[f64; LANES],
        g: &mut [[Functions<S, N>; GROUPS]],
        at: usize,
    ) {
        let zero = f64x8::splat(simd, 0.0);
        let inverse = f64x8::splat(simd, 1.0) / f64x8::simd_from(simd, *z);
        let factor = |step: &Step, i: usize| {
            inverse.mul_add(step.per_z, f64x8::splat(simd, SIGNS[i] * step.charge))
        };
        if z[0] >= upwards(self.modes) {
            let [mut before, mut now] = self.first_two(simd, z);
            [g[0][at], g[1][at]] = [before, now];
            for (g, step) in g[2..].iter_mut().zip(&self.steps[1..]) {
                for i in 0..N {
                    let after = factor(step, i).mul_sub(now[i], before[i]);
                    (before[i], now[i]) = (now[i], after);
                }
                g[at] = now;
            }
            return;
        }
        let top = top(z[LANES - 1]);
        // Nothing overflows from here: the spread of a group makes its smallest argument grow by
        // less than 1e300.
        let mut after = [zero; N];
        let mut now = [f64x8::splat(simd, 1e-200); N];
        let mut sum = [zero; N];
        for g in g.iter_mut().skip(top + 1) {
            g[at] = [zero; N];
        }
        for n in (1..=top).rev() {
            if n < g.len() {
                g[n][at] = now;
            }
            let step = &self.steps[n];
            for i in 0..N {
                // The weights of odd orders have the sign of `-eta`.
                let weight = if n % 2 == 1 {
                    SIGNS[i] * step.weight
                } else {
                    step.weight
                };
                sum[i] = now[i].mul_add(weight, sum[i]);
                let before = factor(step, i).mul_sub(now[i], after[i]);
                (after[i], now[i]) = (now[i], before);
            }
        }
        g[0][at] = now;
        for i in 0..N {
            let factor = f64x8::splat(simd, 1.0) / (sum[i] + now[i]);
            for g in g.iter_mut().take(top + 1) {
                g[at][i] *= factor;
            }
        }
    }

    /// Returns `g_0` and `g_1` by their asymptotic series, which ends at once for `eps = 0`.
    #[inline(always)]
    fn first_two<S: Simd, const N: usize>(
        &self,
        simd: S,
        z: &[f64; LANES],
    ) -> [Functions<S, N>; 2] {
        let (mut sine, mut cosine) = ([0.0; LANES], [0.0; LANES]);
        let (mut sine_of_phase, mut cosine_of_phase) = ([0.0; LANES], [1.0; LANES]);
        for (l, z) in z.iter().enumerate() {
            (sine[l], cosine[l]) = z.sin_cos();
            if self.eps != 0.0 {
                (sine_of_phase[l], cosine_of_phase[l]) =
                    (self.phase - self.eps * (2.0 * z).ln()).sin_cos();
            }
        }
        let [sin, cos, s, c] =
            [sine, cosine, sine_of_phase, cosine_of_phase].map(|v| f64x8::simd_from(simd, v));
        let inverse = f64x8::splat(simd, 1.0) / f64x8::simd_from(simd, *z);
        let mut functions = [[inverse; N]; 2];
        for i in 0..N {
            let eta = SIGNS[i] * self.eps;
            let factor = inverse * self.amplitude[i];
            let s = s * SIGNS[i];
            let (sin, cos) = (sin * c + cos * s, cos * c - sin * s);
            // The phase of `F_1` is larger by `atan(eta) - pi/2`, and `g_1` has a factor `1/R_1`.
            let square = 1.0 / (1.0 + eta * eta);
            let (sin_1, cos_1) = ((sin * eta - cos) * square, (cos * eta + sin) * square);
            functions[0][i] = factor * asymptotic(simd, inverse, 0.0, eta, [sin, cos]);
            functions[1][i] = factor * asymptotic(simd, inverse, 1.0, eta, [sin_1, cos_1]);
        }
        functions
    }
}

/// Returns the asymptotic series of `F_l` at descending values of `1/z`.
#[inline(always)]
fn asymptotic<S: Simd>(
    simd: S,
    inverse: f64x8<S>,
    l: f64,
    eta: f64,
    [sin, cos]: [f64x8<S>; 2],
) -> f64x8<S> {
    let (mut f, mut g) = (f64x8::splat(simd, 1.0), f64x8::splat(simd, 0.0));
    let (mut sum_f, mut sum_g) = (f, g);
    for k in 0..TERMS {
        let k = k as f64;
        let unit = inverse * (0.5 / (k + 1.0));
        let lambda = unit * ((2.0 * k + 1.0) * eta);
        let mu = unit * (l * (l + 1.0) - k * (k + 1.0) + eta * eta);
        (f, g) = (lambda * f - mu * g, lambda * g + mu * f);
        sum_f += f;
        sum_g += g;
        // The smallest argument is the first.
        if f[0].abs() + g[0].abs() < 1e-18 {
            break;
        }
    }
    sum_g * cos + sum_f * sin
}

/// Returns `(pi eps/sinh(pi eps))^{1/2}`.
pub fn c0(eps: f64) -> f64 {
    let argument = PI * eps;
    if argument == 0.0 {
        1.0
    } else {
        (argument / argument.sinh()).sqrt()
    }
}

/// Returns `arg Gamma(1 + i eps)`, by Stirling's series after 20 steps of the recurrence.
fn phase_of_gamma(eps: f64) -> f64 {
    const STEPS: usize = 20;
    let n = STEPS as f64 + 1.0;
    let below: f64 = (1..=STEPS).map(|k| (eps / k as f64).atan()).sum();
    let square = n * n + eps * eps;
    // Im[(w - 1/2) ln w - w + 1/(12 w) - 1/(360 w^3) + 1/(1260 w^5)] at w = n + i eps.
    let angle = eps.atan2(n);
    let inverse =
        |power: i32| -(f64::from(power) * angle).sin() / square.powf(0.5 * f64::from(power));
    0.5 * eps * square.ln() + (n - 0.5) * angle - eps + inverse(1) / 12.0 - inverse(3) / 360.0
        + inverse(5) / 1260.0
        - below
}

/// Returns the argument from which on the recurrence is run upwards, to twice the number of `modes`.
fn upwards(modes: usize) -> f64 {
    ASYMPTOTIC.max(2.1 * modes as f64)
}

/// Returns the order at which the downward recurrence begins for arguments up to `z`.
///
/// Beyond the turning point `n = z` the functions fall like `exp(-2/3 xi^{3/2})` with
/// `xi = (n - z)/(z/2)^{1/3}`, and for small `z` like `z^n`.
fn top(z: f64) -> usize {
    if z < 1e-2 {
        return (20.0 / -z.log10()).ceil() as usize + 2;
    }
    (z + 15.0 * (0.5 * z).cbrt() + 12.0).ceil() as usize
}
