//! What a solution must also fulfil: the contact does not open inside, and the gap is within the
//! range of the attraction in the annulus and beyond it outside.

use std::array::from_fn;
use std::f64::consts::{FRAC_2_PI, FRAC_PI_2, PI};

use crate::cohesive::Cohesive;
use crate::cohesive::annulus::{Annulus, rule};
use crate::cohesive::fixed_radius::Part;
use crate::cohesive::waves::{Group, cosine_sum};
use crate::galerkin::bessel::LANES;
use crate::galerkin::slope::dot;
use crate::stick::integration::interpolation;

/// A solution at one contact radius, in the units of
/// [`fixed_radius`](crate::cohesive::fixed_radius).
pub struct Solution<'a> {
    /// The bodies.
    pub bodies: &'a Cohesive,
    /// The annulus.
    pub annulus: Annulus,
    /// The fields.
    pub part: Part,
    /// The wave numbers of its spectrum, a multiple of the lanes.
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
        let part = |t: &f64| {
            let v = 0.5 * (1.0 + t);
            (r * r + square * v * v).sqrt() / a
        };
        let groups = rule.abscissae.chunks_exact(LANES);
        let inside: f64 = groups
            .zip(rule.weights.chunks_exact(LANES))
            .map(|(t, w)| {
                let slopes = slopes_over_radius(&self.part.field, &from_fn(|l| part(&t[l])));
                let terms = slopes.iter().zip(w).map(|(slope, w)| w * slope);
                0.5 * terms.sum::<f64>() / (a * a)
            })
            .sum();
        // pi/2 - arcsin(y) of y = 2 (a^2-r^2)/(c^2-r^2) - 1.
        let share = square / ((c - r) * (c + r));
        let outside = 2.0 * (1.0 - share).max(0.0).sqrt().asin();
        let traction = self.bodies.traction;
        -FRAC_2_PI / traction * (square.sqrt() * inside + 0.5 * traction * outside)
    }

    /// Returns the least pressure over `sigma0` inside the contact.
    pub fn least_pressure(&self) -> f64 {
        const PLACES: usize = 32;
        let place = |i: usize| (FRAC_PI_2 * (i as f64 + 0.5) / PLACES as f64).sin();
        (0..PLACES)
            .map(|i| self.pressure(self.annulus.inner * place(i)))
            .fold(f64::INFINITY, f64::min)
    }

    /// Returns the gap at each of the radii `r >= a`, in any order.
    ///
    /// It is `(2/pi) int_a^r phi(s)/sqrt(r^2-s^2) ds`. The traction's own part of `phi` is known; the
    /// rest is interpolated between samples. The compliance smooths the rest over the thickness of the top layer, 1. Where
    /// the samples are farther apart than that, they are denser at `c`, where the rest changes most.
    pub fn gaps(&self, radii: &[f64]) -> Vec<f64> {
        const LEAST: usize = 16;
        const MOST: f64 = 48.0;
        let (a, c) = (self.annulus.inner, self.annulus.outer);
        let modulus = self.bodies.symbol.modulus();
        let end = radii.iter().copied().fold(a, f64::max);
        let rest = |s: f64| {
            let wave = cosine_sum(&self.part.spectrum, self.q, s);
            wave / modulus - self.part.penetration + s * s * self.bodies.curvature
        };
        let sampled = |from: f64, to: f64| {
            let count = LEAST + (4.0 * (to - from)).min(MOST) as usize;
            let place = |i: usize| 0.5 * (1.0 - (PI * (i as f64 + 0.5) / count as f64).cos());
            let nodes: Vec<f64> = (0..count).map(|i| from + (to - from) * place(i)).collect();
            let values: Vec<f64> = nodes.iter().map(|s| rest(*s)).collect();
            let factors = barycentric_factors(count);
            move |s: f64| dot(&interpolation(&nodes, &factors, s), &values)
        };
        let middle = if 4.0 * (end - a) > MOST {
            c.min(end)
        } else {
            end
        };
        let inner = sampled(a, middle);
        let outer = (middle < end).then(|| sampled(middle, end));
        let phi = |s: f64| {
            let height = ((c - s) * (c + s)).max(0.0).sqrt();
            let rest = match &outer {
                Some(outer) if s > middle => outer(s),
                _ => inner(s),
            };
            rest - self.bodies.traction * height / modulus
        };
        radii
            .iter()
            .map(|&r| FRAC_2_PI * abel(a, r, c, phi))
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

/// Returns the factors of [`interpolation`] for Chebyshev nodes of the first kind.
fn barycentric_factors(count: usize) -> Vec<f64> {
    let sign = |i: usize| if i.is_multiple_of(2) { 1.0 } else { -1.0 };
    (0..count)
        .map(|i| sign(i) * (PI * (i as f64 + 0.5) / count as f64).sin())
        .collect()
}

/// Returns `f'(rho)/rho` of a sum of even Legendre functions `sqrt(4n+1) P_2n`.
///
/// `(k+1) P_{k+1} = (2k+1) rho P_k - k P_{k-1}` and `P_{k+1}' = P_{k-1}' + (2k+1) P_k`, the odd ones
/// divided by `rho`.
fn slopes_over_radius(coefficients: &[f64], rho: &Group) -> Group {
    let square: Group = rho.map(|rho| rho * rho);
    let [mut even, mut odd] = [[1.0; LANES]; 2];
    let [mut slope, mut sum] = [[0.0; LANES]; 2];
    for (n, coefficient) in coefficients.iter().enumerate().skip(1) {
        let k = (2 * n - 1) as f64;
        let factor = coefficient * ((4 * n + 1) as f64).sqrt();
        let [first, second] = [(2.0 * k + 1.0) / (k + 1.0), k / (k + 1.0)];
        let [third, fourth] = [(2.0 * k + 3.0) / (k + 2.0), (k + 1.0) / (k + 2.0)];
        for l in 0..LANES {
            slope[l] += (2.0 * k + 1.0) * odd[l];
            sum[l] += factor * slope[l];
            even[l] = first * square[l] * odd[l] - second * even[l];
            odd[l] = third * even[l] - fourth * odd[l];
        }
    }
    sum
}
