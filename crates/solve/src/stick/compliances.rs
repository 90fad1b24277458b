//! The three surface compliances of a film or a stack of layers: normal, tangential and coupled.
//!
//! A pressure `p` and an inward shear traction `q` move the surface down by `u` and inwards by `v`,
//! in Hankel transforms of order 0 (`p`, `u`) and 1 (`q`, `v`)
//!
//! ```text
//! (u, v) = 2/(E1* k) [[X11, X12], [X12, X22]] (p, q)          X11, X22 -> 1,  X12 -> b   as kt -> inf
//! ```
//!
//! with `b = (1 - 2 nu)/(2 (1 - nu))` and `e = 2/(1 - nu)` of the top layer. The minors of
//! `slab.rs` give all three: `X11 = (e/2) c22/d` (the `X` of a contact without friction),
//! `X22 = (e/2) c11/d` and `X12 = (e/2) c12/d`. Beyond `q = 1` the limits are taken off as in
//! equation (3) there: with the minors `y` at the bottom of the top layer, `E = e^{-2q}` and `d` of
//! its top, each of `X11 - 1`, `X22 - 1` and `X12 - b` is `(e/2) E F/d`,
//!
//! ```text
//! F = f(y) + q f(N y) + q^2/2 f(N^2 y) + c 4 l- (1 - 2q + 2q^2 - E)
//! X11:  f = c22 - (2/e) d,  c = 1        X22:  f = c11 - (2/e) d,  c = 1        X12:  f = c12 - (2b/e) d,  c = 0
//! ```
//!
//! Measured (the tests of this file): the test value of an incompressible film on a rigid base to
//! rounding, and both forms agree where they meet.

use fearless_simd::prelude::*;
use fearless_simd::{Level, dispatch};

use crate::compliance::layered::LayeredCompliance;
use crate::compliance::slab::Component;
use crate::compliance::surface::filled;

/// `X11 - 1`, `X12 - b` and `X22 - 1`, or their slopes `q d/dq`, in this order.
pub type Three<T> = [T; 3];

/// The three compliances without their limits, and their slopes, at many wave numbers.
#[derive(Clone, Debug)]
pub struct Samples {
    /// `X11 - 1`, `X12 - b`, `X22 - 1`.
    pub excess: Three<Vec<f64>>,
    /// `X11` and `X22`, relatively accurate where they are small.
    pub whole: [Vec<f64>; 2],
    /// `q` times their derivatives with respect to `q`.
    pub slope: Three<Vec<f64>>,
}

/// Returns the compliances at the wave numbers `q`, in units of one over the thickness of the top
/// layer.
pub fn sample_all(surface: &LayeredCompliance, q: &[f64]) -> Samples {
    let mut samples = Samples {
        excess: [0; 3].map(|_| Vec::with_capacity(q.len())),
        whole: [0; 2].map(|_| Vec::with_capacity(q.len())),
        slope: [0; 3].map(|_| Vec::with_capacity(q.len())),
    };
    dispatch!(Level::new(), simd => extend(simd, surface, q, &mut samples));
    samples
}

#[inline(always)]
fn extend<S: Simd>(simd: S, surface: &LayeredCompliance, q: &[f64], samples: &mut Samples) {
    for group in q.chunks(S::f64s::LEN) {
        let wave_numbers = filled(simd, group) + surface.least();
        let [y, z] = surface.below_top(simd, wave_numbers);
        let components = [
            Component::NORMAL,
            Component {
                place: 2,
                limit: surface.top().b,
                fall: 0.0,
            },
            Component {
                place: 1,
                ..Component::NORMAL
            },
        ];
        let all = surface.top().sample(simd, wave_numbers, y, z, components);
        for (values, i) in samples.whole.iter_mut().zip([0, 2]) {
            values.extend_from_slice(&all[i].x.as_slice()[..group.len()]);
        }
        for (i, own) in all.iter().enumerate() {
            samples.excess[i].extend_from_slice(&own.excess.as_slice()[..group.len()]);
            samples.slope[i].extend_from_slice(&own.slope.as_slice()[..group.len()]);
        }
    }
}

#[cfg(test)]
mod tests {
    use interp::{Elastic, Material};

    use super::*;
    use crate::compliance::layered::tests::random_stack;
    use crate::estimate::larger;
    use crate::stack::{Interface, Layer, Stack};

    /// An incompressible film on a rigid base at `q = 0.7`, by another program in 20 digits, and in
    /// closed form elsewhere.
    #[test]
    fn the_test_values_are_met() {
        let film = Material::new(0.0, 0.5, f64::INFINITY, 0.0).expect("physical");
        let film = LayeredCompliance::of_film(&film);
        let samples = sample_all(&film, &[0.7]);
        let expected = [
            0.122_080_342_975_348_18 - 1.0,
            -0.237_236_525_712_266,
            0.799_898_987_867_536_8 - 1.0,
        ];
        for (found, expected) in samples.excess.iter().zip(expected) {
            assert!(
                (found[0] - expected).abs() <= 3e-16,
                "{}, not {expected}",
                found[0]
            );
        }
        let q: Vec<f64> = (1..200).map(|i| 0.06 * f64::from(i)).collect();
        let samples = sample_all(&film, &q);
        for (i, q) in q.iter().enumerate() {
            let d = (2.0 * q).cosh() + 1.0 + 2.0 * q * q;
            let exact = [
                ((2.0 * q).sinh() - 2.0 * q) / d - 1.0,
                -2.0 * q * q / d,
                ((2.0 * q).sinh() + 2.0 * q) / d - 1.0,
            ];
            for (found, exact) in samples.excess.iter().zip(exact) {
                assert!(
                    (found[i] - exact).abs() <= 3e-15,
                    "{q}: {}, not {exact}",
                    found[i]
                );
            }
        }
    }

    /// An incompressible film that slides on a rigid base is half of a layer that is pressed on both of
    /// its faces: `X11 = (cosh 2q - 1)/D`, `X22 = (cosh 2q + 1)/D`, `X12 = -2q/D`,
    /// `D = sinh 2q + 2q`.
    #[test]
    fn a_film_that_slides_has_its_closed_form() {
        let layer = Layer {
            solid: Elastic::new(0.75, 0.5).expect("physical"),
            thickness: 1.0,
            interface: Interface::Sliding,
        };
        let rigid = Elastic::new(f64::INFINITY, 0.0).expect("physical");
        let film = LayeredCompliance::new(&Stack::new(rigid, [layer]).expect("within limits"));
        let q: Vec<f64> = (0..200)
            .map(|i| 1e-6 * 10_f64.powf(0.04 * f64::from(i)))
            .collect();
        let samples = sample_all(&film, &q);
        for (i, q) in q.iter().enumerate().filter(|(_, q)| **q < 200.0) {
            let d = (2.0 * q).sinh() + 2.0 * q;
            let exact = [
                2.0 * q.sinh() * q.sinh() / d - 1.0,
                -2.0 * q / d,
                2.0 * q.cosh() * q.cosh() / d - 1.0,
            ];
            let unit = 1.0 + exact[2].abs();
            for (found, exact) in samples.excess.iter().zip(exact) {
                assert!(
                    (found[i] - exact).abs() <= 4e-15 * unit,
                    "{q}: {}, not {exact}",
                    found[i]
                );
            }
        }
    }

    /// The normal compliance is that of the contact without friction, the slopes are the derivatives
    /// of the values, and the matrix of the compliances is positive.
    #[test]
    fn stacks_have_compliances_with_their_slopes() {
        let (mut of_normal, mut of_slopes) = (0.0, 0.0);
        for seed in 0..60 {
            let surface = LayeredCompliance::new(&random_stack(seed));
            for i in 0..40 {
                let q = 10_f64.powf(-3.0 + 0.11 * f64::from(i));
                let step = 1e-4;
                let samples = sample_all(&surface, &[q * (1.0 - step), q, q * (1.0 + step)]);
                let known = crate::compliance::surface::SurfaceCompliance::sample(&surface, q);
                let unit = larger(1.0, (1.0 + known.excess).abs());
                of_normal = larger(
                    of_normal,
                    (samples.excess[0][1] - known.excess).abs() / unit,
                );
                let b = surface.top().b;
                let [x11, x12, x22] = [
                    1.0 + samples.excess[0][1],
                    b + samples.excess[1][1],
                    1.0 + samples.excess[2][1],
                ];
                assert!(
                    x11 > 0.0 && x22 > 0.0 && x12 * x12 < x11 * x22,
                    "{seed}, {q}"
                );
                for (excess, slope) in samples.excess.iter().zip(&samples.slope) {
                    let difference = (excess[2] - excess[0]) / (2.0 * step);
                    let unit = larger(unit, x22);
                    of_slopes = larger(of_slopes, (difference - slope[1]).abs() / unit);
                }
            }
        }
        println!("normal {of_normal:.1e}, slopes {of_slopes:.1e}");
        assert!(of_normal <= 1e-14 && of_slopes <= 1e-6);
    }
}
