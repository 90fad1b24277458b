//! A surface compliance from samples: for stacks of so many layers that each evaluation counts.

use std::array::from_fn;
use std::f64::consts::PI;

use fearless_simd::prelude::*;
use fearless_simd::{Level, dispatch};

use crate::compliance::FLAT;
use crate::compliance::layered::LayeredCompliance;
use crate::compliance::surface::{AllSamples, SurfaceCompliance};

/// The samples of a panel. With poles at 26 degrees from the real axis, the ellipse of convergence
/// of a panel `[c, 1.4c]` is 5.5, and that of the first panel, whose length is half the distance of
/// the nearest pole, is 6.2: the interpolation error is that of rounding.
const POINTS: usize = 20;

/// The upper over the lower end of a panel.
const RATIO: f64 = 1.4;

/// The compliance of a stack of layers, interpolated between samples up to the wave number beyond
/// which it is 1 to rounding, and evaluated beyond.
#[derive(Clone, Debug)]
pub struct SampledCompliance {
    whole: LayeredCompliance,
    /// The ends of the panels, ascending from 0.
    edges: Vec<f64>,
    /// The panels between them.
    panels: Vec<Panel>,
}

/// The Chebyshev coefficients of `X - 1` and `q X'`.
type Panel = [[f64; 2]; POINTS];

impl SampledCompliance {
    /// Samples `compliance`.
    pub fn new(compliance: LayeredCompliance) -> Self {
        let mut edges = vec![0.0, 0.5 * compliance.smallest_scale()];
        while edges[edges.len() - 1] < FLAT {
            edges.push(RATIO * edges[edges.len() - 1]);
        }
        let cosine = |i: usize, k: usize| (PI * (i as f64 + 0.5) * k as f64 / POINTS as f64).cos();
        // The factors of the values at the nodes that give the coefficients of a panel.
        let factors: [[f64; POINTS]; POINTS] = from_fn(|k| {
            let weight = if k == 0 { 1.0 } else { 2.0 } / POINTS as f64;
            from_fn(|i| weight * cosine(i, k))
        });
        let panel = |ends: &[f64]| {
            let (middle, half) = (0.5 * (ends[0] + ends[1]), 0.5 * (ends[1] - ends[0]));
            let nodes: [f64; POINTS] = from_fn(|i| middle + half * cosine(i, 1));
            let samples = compliance.sample_all(&nodes);
            factors.map(|row| {
                let sum = |values: &[f64]| row.iter().zip(values).map(|(a, b)| a * b).sum();
                [sum(&samples.excess), sum(&samples.slope)]
            })
        };
        let panels = edges.windows(2).map(panel).collect();
        Self {
            whole: compliance,
            edges,
            panels,
        }
    }
}

impl SurfaceCompliance for SampledCompliance {
    fn points(&self, tolerance: f64, oscillates: bool) -> usize {
        self.whole.points(tolerance, oscillates)
    }

    fn sample_all(&self, q: &[f64]) -> AllSamples {
        let mut samples = AllSamples::with_capacity(q.len());
        let mut rest = q;
        while let Some(&first) = rest.first() {
            let above = self.edges.partition_point(|&edge| edge <= first);
            let from = self.edges[above - 1];
            let to = self.edges.get(above).copied().unwrap_or(f64::INFINITY);
            let within = |q: &&f64| from <= **q && **q < to;
            let (on_panel, others) = rest.split_at(rest.iter().take_while(within).count());
            match self.panels.get(above - 1) {
                Some(panel) => {
                    dispatch!(Level::new(), simd => extend(simd, panel, [from, to], on_panel, &mut samples));
                }
                None => {
                    let AllSamples { excess, slope } = self.whole.sample_all(on_panel);
                    samples.extend(&excess, &slope);
                }
            }
            rest = others;
        }
        samples
    }

    fn smallest_scale(&self) -> f64 {
        self.whole.smallest_scale()
    }

    fn largest_excess(&self) -> f64 {
        self.whole.largest_excess()
    }
}

/// Appends the samples at wave numbers `q` on the panel between two ends, several at once by
/// Clenshaw's recurrence.
#[inline(always)]
fn extend<S: Simd>(
    simd: S,
    [constant, rest @ ..]: &Panel,
    [from, to]: [f64; 2],
    q: &[f64],
    samples: &mut AllSamples,
) {
    let zero = S::f64s::splat(simd, 0.0);
    for group in q.chunks(S::f64s::LEN) {
        let mut position = zero;
        for (i, q) in group.iter().enumerate() {
            position[i] = ((q - from) - (to - q)) / (to - from);
        }
        let twice = position * 2.0;
        let mut sums = [zero; 2];
        for (i, sum) in sums.iter_mut().enumerate() {
            let (mut next, mut after) = (zero, zero);
            for coefficient in rest.iter().rev() {
                (next, after) = (
                    twice.mul_add(next, S::f64s::splat(simd, coefficient[i]) - after),
                    next,
                );
            }
            *sum = position.mul_add(next, S::f64s::splat(simd, constant[i]) - after);
        }
        let [excess, slope] = sums;
        let count = group.len();
        samples.extend(&excess.as_slice()[..count], &slope.as_slice()[..count]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compliance::layered::tests::{random_stack, random_stack_with_interfaces};
    use crate::estimate::larger;
    use crate::stack::{Layer, Stack};
    use interp::Elastic;

    /// A plate on a thin soft layer on a rigid base, compressible or not: poles at 45 and 30
    /// degrees.
    fn plate(poisson: f64) -> Stack {
        let layer = |young: f64, poisson: f64, thickness: f64| {
            Layer::bonded(Elastic::new(young, poisson).expect("physical"), thickness)
        };
        let base = Elastic::new(f64::INFINITY, 0.0).expect("physical");
        Stack::new(base, [layer(1e-6, poisson, 0.1), layer(1.0, 0.3, 1.0)]).expect("within limits")
    }

    /// Wave numbers on both sides of the last panel. Measured: 3.3e-13 of the larger of 1, `X` and
    /// the slope.
    #[test]
    fn samples_stand_for_the_compliance() {
        let mut worst = 0.0;
        let bonded = (0..300).map(random_stack).chain([plate(0.2), plate(0.5)]);
        let stacks = bonded.chain((0..300).map(random_stack_with_interfaces));
        for stack in stacks {
            let whole = LayeredCompliance::new(&stack);
            let sampled = SampledCompliance::new(whole.clone());
            for i in 0..400 {
                let q = whole.smallest_scale() * 10_f64.powf(-2.0 + 0.01 * f64::from(i))
                    + 0.1 * f64::from(i);
                let (found, truth) = (sampled.sample(q), whole.sample(q));
                let unit = (1.0 + truth.excess).max(1.0).max(truth.slope.abs());
                worst = larger(worst, (found.excess - truth.excess).abs() / unit);
                worst = larger(worst, (found.slope - truth.slope).abs() / unit);
            }
        }
        println!("samples: {worst:.1e}");
        assert!(worst <= 1e-12);
    }
}
