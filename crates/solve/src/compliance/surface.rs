//! What the solver asks of a coated half-space: its surface compliance in Hankel space.
//!
//! Under a normal pressure `p`, the surface displacement is `u(k) = 2 X/(E1* k) p(k)`, with the
//! reduced modulus `E1*` of what the sphere touches. Wave numbers `q` are in units of one over the
//! thickness of the top layer, beyond which `X` tends to 1 like `q^2 e^{-2q}`. One film
//! ([`Compliance`](crate::compliance::Compliance)) and a stack of layers
//! ([`LayeredCompliance`](crate::compliance::layered::LayeredCompliance), or a
//! [`SampledCompliance`](crate::compliance::sampled::SampledCompliance) of it) answer the same
//! questions.

use std::fmt::Debug;
use std::sync::Arc;

use fearless_simd::prelude::*;
use fearless_simd::{Level, dispatch};

/// `X - 1` and its slope at one wave number.
#[derive(Clone, Copy, Debug)]
pub struct Sample {
    /// `X(q) - 1`.
    pub excess: f64,
    /// `q X'(q)`.
    pub slope: f64,
}

/// `X - 1` and its slope at many wave numbers, in their order.
#[derive(Clone, Debug)]
pub struct AllSamples {
    /// `X(q) - 1`.
    pub excess: Vec<f64>,
    /// `q X'(q)`.
    pub slope: Vec<f64>,
}

impl AllSamples {
    /// Returns no samples, with memory for `count`.
    pub fn with_capacity(count: usize) -> Self {
        Self {
            excess: Vec::with_capacity(count),
            slope: Vec::with_capacity(count),
        }
    }

    /// Appends the samples at a group of wave numbers.
    pub fn extend(&mut self, excess: &[f64], slope: &[f64]) {
        self.excess.extend_from_slice(excess);
        self.slope.extend_from_slice(slope);
    }
}

/// The surface compliance `X(q)` of a coated half-space, without the sphere.
pub trait SurfaceCompliance: Debug + Send + Sync {
    /// Returns the number of points on a panel `[c, 4c]`, 16, 20, 24 or 32, with which Gauss's rule
    /// integrates `X` to a relative `tolerance` in spite of its poles. `oscillates` tells that
    /// panels are short beside their wave numbers for another reason, so that many points a panel
    /// are economical.
    fn points(&self, tolerance: f64, oscillates: bool) -> usize;

    /// Returns `X(q) - 1` and `q X'(q)` for a finite `q >= 0`, with an absolute error of a few
    /// rounding units of `max(X, 1)`.
    fn sample(&self, q: f64) -> Sample {
        let AllSamples { excess, slope } = self.sample_all(&[q]);
        Sample {
            excess: excess[0],
            slope: slope[0],
        }
    }

    /// Returns the samples at all `q`, in their order.
    fn sample_all(&self, q: &[f64]) -> AllSamples;

    /// Returns the smallest wave number on which `X` varies, at most 1: the length of the first
    /// panel.
    fn smallest_scale(&self) -> f64;

    /// Returns a bound of `|X - 1|`; 0 where `X = 1` everywhere.
    fn largest_excess(&self) -> f64;
}

/// Whatever the sphere touches, a film or a stack.
impl SurfaceCompliance for Arc<dyn SurfaceCompliance> {
    fn points(&self, tolerance: f64, oscillates: bool) -> usize {
        (**self).points(tolerance, oscillates)
    }

    fn sample_all(&self, q: &[f64]) -> AllSamples {
        (**self).sample_all(q)
    }

    fn smallest_scale(&self) -> f64 {
        (**self).smallest_scale()
    }

    fn largest_excess(&self) -> f64 {
        (**self).largest_excess()
    }
}

/// A compliance that vector instructions evaluate.
pub trait VectorCompliance {
    /// Returns `X - 1` and `q X'` at several finite `q >= 0`.
    fn samples<S: Simd>(&self, simd: S, q: S::f64s) -> [S::f64s; 2];
}

/// Returns the samples at all wave numbers, in their order.
pub fn sample_all(compliance: &impl VectorCompliance, q: &[f64]) -> AllSamples {
    let mut samples = AllSamples::with_capacity(q.len());
    dispatch!(Level::new(), simd => extend(simd, compliance, q, &mut samples));
    samples
}

#[inline(always)]
fn extend<S: Simd>(
    simd: S,
    compliance: &impl VectorCompliance,
    q: &[f64],
    samples: &mut AllSamples,
) {
    for group in q.chunks(S::f64s::LEN) {
        let [excess, slope] = compliance.samples(simd, filled(simd, group));
        let count = group.len();
        samples.extend(&excess.as_slice()[..count], &slope.as_slice()[..count]);
    }
}

/// Returns a group of wave numbers. One that is not full is filled up with its last one.
#[inline(always)]
pub fn filled<S: Simd>(simd: S, group: &[f64]) -> S::f64s {
    let mut wave_numbers = S::f64s::splat(simd, group[group.len() - 1]);
    wave_numbers.as_mut_slice()[..group.len()].copy_from_slice(group);
    wave_numbers
}

/// Returns a wave number beyond which `weight(q)` times `|X - 1|`, and `weight(q)` times `|q X'|`,
/// are at most `tolerance`, for every film on every substrate and every stack of layers. `weight`
/// must not grow with `q`.
///
/// `q X'` is the larger of the two. For a film it is at most `28 q^3 e^{-2q}` for `q >= 4`, as `|b|
/// <= 1` and `|a| <= 7` in the formulas of `compliance.rs`. Below the top layer of a stack lies a
/// body whose compliance is between those of free and rigid bodies, which `a` and `b` span.
pub fn cut_off(tolerance: f64, weight: impl Fn(f64) -> f64) -> f64 {
    const STEPS: [f64; 3] = [4.0, 1.0, 0.25];
    let is_large = |q: f64| decay(q) * weight(q) > tolerance;
    if !is_large(DECAYS) {
        return DECAYS;
    }
    // The last place where the integrand is still large, first in large steps, as it falls.
    let mut q = DECAYS;
    for step in STEPS {
        while is_large(q + step) {
            q += step;
        }
    }
    q + STEPS[2]
}

/// The wave number from which on [`decay`] is a bound.
const DECAYS: f64 = 4.0;

/// Returns a bound of `|X - 1|` and `|q X'|` for `q >= 4`, as [`cut_off`] explains, and 1 below.
pub fn decay(q: f64) -> f64 {
    if q < DECAYS {
        1.0
    } else {
        28.0 * q.powi(3) * (-2.0 * q).exp()
    }
}

#[cfg(test)]
pub mod tests {
    use super::*;
    use crate::estimate::larger;

    /// Asserts that beyond the cut-off `X - 1` and `q X'` of all compliances are below the
    /// tolerance.
    pub fn assert_that_the_cut_off_bounds_the_rest<C: SurfaceCompliance>(
        compliances: impl Iterator<Item = C>,
    ) {
        let mut worst: f64 = 0.0;
        for compliance in compliances {
            for tolerance in [1e-3, 1e-6, 1e-12] {
                let from = cut_off(tolerance, |_| 1.0);
                for q in (0..40).map(|i| from + 0.1 * f64::from(i)) {
                    let Sample { excess, slope } = compliance.sample(q);
                    worst = larger(worst, excess.abs() / tolerance);
                    worst = larger(worst, slope.abs() / tolerance);
                }
            }
        }
        println!("at most {worst:.2} of the tolerance is left beyond the cut-off");
        assert!(worst > 0.0 && worst <= 1.0);
    }
}
