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
//! Measured by the contacts that they make (`tests/truth/stick.rs`).

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
