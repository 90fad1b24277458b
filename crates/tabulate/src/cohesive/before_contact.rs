//! The attraction across a gap, before any contact: a disc of constant traction on the surface.
//!
//! Under the traction `sigma0` on `r < c` the surface rises by
//!
//! ```text
//! -u(r) = tau c [ e(r/c)/es + (1/e1) int_0^inf (X-1) J1(qc) J0(qr)/q dq ],      e(0) = 1, e(1) = 2/pi
//! ```
//!
//! and the gap is `h0` at `r = c`: `delta = c^2/2R + u(c) - h0`, `F = -pi sigma0 c^2`. The contact
//! begins where the gap in the middle, `u(0) - delta`, is 0.

use std::f64::consts::FRAC_2_PI;

use crate::cohesive::surface::Surface;
use crate::solve::quadrature::Panels;
use crate::solve::surface::SurfaceCompliance;
use crate::solve::symbol::Symbol;

/// Returns `-u/tau` in the middle and at the edge of a disc of radius `c`.
pub fn rise(c: f64, symbol: &Symbol<Surface>) -> [f64; 2] {
    let es = symbol.modulus();
    let mut rise = [c / es, FRAC_2_PI * c / es];
    if symbol.contrast() == 0.0 {
        return rise;
    }
    const ACCURACY: f64 = 1e-14;
    let panels = Panels::new(
        c,
        [symbol.compliance()],
        ACCURACY / symbol.contrast().max(1.0),
    );
    for ends in panels.edges.windows(2) {
        let (middle, half) = (0.5 * (ends[0] + ends[1]), 0.5 * (ends[1] - ends[0]));
        for (t, w) in panels.rule.abscissae.iter().zip(&panels.rule.weights) {
            let q = middle + half * t;
            let excess = symbol.compliance().sample(q).excess;
            let term = symbol.film() / es * c * half * w * excess * libm::j1(q * c) / q;
            rise[0] += term;
            rise[1] += term * libm::j0(q * c);
        }
    }
    rise
}
