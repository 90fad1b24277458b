//! What a solution must also fulfil: the contact does not open inside, and the gap is within the
//! range of the attraction in the annulus and beyond it outside.

use std::f64::consts::{FRAC_2_PI, FRAC_PI_2, PI};

use crate::cohesive::annulus::{Annulus, rule};
use crate::cohesive::fixed_radius::Part;

/// A solution at one contact radius, in the units of
/// [`fixed_radius`](crate::cohesive::fixed_radius).
pub struct Solution<'a> {
    /// The annulus.
    pub annulus: Annulus,
    /// `1/R`.
    pub curvature: f64,
    /// `tau = 2 sigma0`.
    pub traction: f64,
    /// The modulus `es`.
    pub modulus: f64,
    /// The fields.
    pub part: Part,
    /// The wave numbers of its spectrum.
    pub q: &'a [f64],
}

impl Solution<'_> {
    /// Returns the pressure over `sigma0` at the radius `r < a`, positive in compression:
    ///
    /// ```text
    /// p(r)/sigma0 = -(2/(pi tau)) [int_r^a g'(s)/sqrt(s^2-r^2) ds + (tau/2)(pi/2 - arcsin((2a^2-c^2-r^2)/(c^2-r^2)))]
    /// ```
    ///
    /// It is -1 at `r = a`.
    pub fn pressure(&self, r: f64) -> f64 {
        const POINTS: usize = 32;
        let (a, c) = (self.annulus.inner, self.annulus.outer);
        // s^2 = r^2 + (a^2 - r^2) v^2, which leaves sqrt(a^2-r^2) int_0^1 g'(s)/s dv.
        let square = (a - r) * (a + r);
        let rule = rule(POINTS);
        let inside: f64 = rule
            .abscissae
            .iter()
            .zip(&rule.weights)
            .map(|(t, w)| {
                let v = 0.5 * (1.0 + t);
                let s = (r * r + square * v * v).sqrt();
                0.5 * w * slope_over_radius(&self.part.field, s / a) / (a * a)
            })
            .sum();
        // pi/2 - arcsin(y) of y = 2 (a^2-r^2)/(c^2-r^2) - 1.
        let share = square / ((c - r) * (c + r));
        let outside = 2.0 * (1.0 - share).max(0.0).sqrt().asin();
        -FRAC_2_PI / self.traction * (square.sqrt() * inside + 0.5 * self.traction * outside)
    }

    /// Returns the least pressure over `sigma0` inside the contact, and its radius.
    pub fn least_pressure(&self) -> (f64, f64) {
        const PLACES: usize = 32;
        let place = |i: usize| (FRAC_PI_2 * (i as f64 + 0.5) / PLACES as f64).sin();
        (0..PLACES)
            .map(|i| self.annulus.inner * place(i))
            .map(|r| (self.pressure(r), r))
            .fold((f64::INFINITY, 0.0), |least, next| {
                if next.0 < least.0 { next } else { least }
            })
    }

    /// Returns the gap at each of the radii `r > a`, which ascend.
    ///
    /// It is `(2/pi) int_a^r phi(s)/sqrt(r^2-s^2) ds`. The traction's own part of `phi` is known; the
    /// rest is interpolated between samples.
    pub fn gaps(&self, radii: &[f64]) -> Vec<f64> {
        const LEAST: usize = 16;
        let (a, c) = (self.annulus.inner, self.annulus.outer);
        let end = radii[radii.len() - 1];
        // The compliance smooths the rest over the thickness of the top layer, 1.
        let count = LEAST + (4.0 * (end - a)).min(48.0) as usize;
        let nodes: Vec<f64> = (0..count)
            .map(|i| a + (end - a) * 0.5 * (1.0 - (PI * (i as f64 + 0.5) / count as f64).cos()))
            .collect();
        let rest: Vec<f64> = nodes
            .iter()
            .map(|s| {
                let waves = self.part.spectrum.iter().zip(self.q);
                let wave: f64 = waves.map(|(g, q)| g * (q * s).cos()).sum();
                wave / self.modulus - self.part.penetration + s * s * self.curvature
            })
            .collect();
        let phi = |s: f64| {
            let height = ((c - s) * (c + s)).max(0.0).sqrt();
            barycentric(&nodes, &rest, s) - self.traction * height / self.modulus
        };
        radii
            .iter()
            .map(|&r| FRAC_2_PI * abel(a, r, c.min(r), phi))
            .collect()
    }
}

/// Integrates `phi(s)/sqrt(r^2 - s^2)` from `a` to `r`, with a kink of `phi` at `kink`.
fn abel(a: f64, r: f64, kink: f64, phi: impl Fn(f64) -> f64) -> f64 {
    const POINTS: usize = 32;
    // s = r cos(psi). A root at the kink is smooth in v^2.
    let [start, bend] = [a, kink].map(|s| (s / r).min(1.0).acos());
    let rule = rule(POINTS);
    let piece = |from: f64, to: f64, towards: f64| -> f64 {
        let terms = rule.abscissae.iter().zip(&rule.weights);
        terms
            .map(|(t, w)| {
                let v = 0.5 * (1.0 + t);
                let psi = from + (to - from) * v * v;
                w * v * (to - from) * phi(r * psi.cos())
            })
            .sum::<f64>()
            * towards
    };
    piece(bend, start, 1.0) + piece(bend, 0.0, -1.0)
}

/// Returns the value at `s` of the polynomial through `values` at Chebyshev `nodes` of the first
/// kind, by the barycentric formula (Berrut and Trefethen, SIAM Review 46, 501, 2004).
fn barycentric(nodes: &[f64], values: &[f64], s: f64) -> f64 {
    let (mut numerator, mut denominator) = (0.0, 0.0);
    for (i, (node, value)) in nodes.iter().zip(values).enumerate() {
        if s == *node {
            return *value;
        }
        let sign = if i % 2 == 0 { 1.0 } else { -1.0 };
        let weight = sign * (PI * (i as f64 + 0.5) / nodes.len() as f64).sin() / (s - node);
        numerator += weight * value;
        denominator += weight;
    }
    numerator / denominator
}

/// Returns `f'(rho)/rho` of a sum of even Legendre functions `sqrt(4n+1) P_2n`.
///
/// `(k+1) P_{k+1} = (2k+1) rho P_k - k P_{k-1}` and `P_{k+1}' = P_{k-1}' + (2k+1) P_k`, the odd ones
/// divided by `rho`.
fn slope_over_radius(coefficients: &[f64], rho: f64) -> f64 {
    let (mut even, mut odd, mut slope, mut sum) = (1.0, 1.0, 0.0, 0.0);
    for (n, coefficient) in coefficients.iter().enumerate().skip(1) {
        let k = (2 * n - 1) as f64;
        slope += (2.0 * k + 1.0) * odd;
        sum += coefficient * ((4 * n + 1) as f64).sqrt() * slope;
        even = ((2.0 * k + 1.0) * rho * rho * odd - k * even) / (k + 1.0);
        odd = ((2.0 * k + 3.0) * even - (k + 1.0) * odd) / (k + 2.0);
    }
    sum
}
