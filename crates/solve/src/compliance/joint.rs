//! An interface in the solver: carries the minors of what lies below to the lower face of a layer.
//!
//! Springs add the jump of the displacements to the compliance of what lies below (`slab.rs` has
//! the notation):
//!
//! ```text
//! C -> C + k diag(1/kt, 1/kn)
//! ```
//!
//! with the stiffnesses per area `kt` and `kn` in the unit of `G k` of the layer. In the minors
//! this is, divided by the positive factor `1 + k/kt`,
//!
//! ```text
//! c22' = c22 + (k/kn) d        D' = D + (k/kn) c11
//! y -> (w d, w c11 + v d, w c12, w c22', w D' + v c22')        w = kt/(kt + k)        v = k/(kt + k)
//! ```
//!
//! All terms are positive, and no `kt` overflows. A sliding interface is `w = 0`, `v = 1`: it has
//! `d = 0`, an infinite compliance sideways. The layer above makes `d` positive again, so `y` is
//! divided by `d` after layers only. The slope `z = k dy/dk` takes the same linear step and in
//! addition, with the `y` below,
//!
//! ```text
//! (0, v d, 0, w (k/kn) d, v c22 + w (k/kn) c11 + 2 v (k/kn) d)
//! ```
//!
//! in which the slope of the factor is left out, since a factor of `y` is free.

use fearless_simd::prelude::*;

use crate::compliance::minors::{Minors, scaled, sum};
use crate::stack::Interface;

/// The `kt/G` below which springs count as sliding where poles are sought. Their poles, at its
/// root, move nothing that double precision shows.
const SLIDES: f64 = 1e-30;

/// The wave number that is added to all of a stack that slides. At exactly 0 a free layer has no
/// compliance.
const LEAST: f64 = 1e-100;

impl Interface {
    /// Returns the interface below a layer of shear modulus `shear` (Pa) as the solver takes it: its stiffnesses are
    /// wave numbers, `kt/G` and `kn/G`, with `unit` (m) as the unit of length.
    pub(crate) fn over(self, shear: f64, unit: f64) -> Self {
        match self.plain() {
            Self::Springs { tangential, normal } => Self::Springs {
                tangential: tangential / shear * unit,
                normal: normal / shear * unit,
            },
            plain => plain,
        }
    }

    /// Returns a wave number to be added to all: positive if the interface carries no shear stress, or
    /// hardly any.
    pub(crate) fn least(self) -> f64 {
        match self {
            Self::Sliding
            | Self::Springs {
                tangential: ..SLIDES,
                ..
            } => LEAST,
            _ => 0.0,
        }
    }

    /// Carries minors `y` and `z = k dy/dk`, in the unit of the layer, from below the interface to
    /// the lower face of the layer, at wave numbers `k`.
    #[inline(always)]
    pub(crate) fn pass<S: Simd>(
        self,
        simd: S,
        k: S::f64s,
        y: Minors<S>,
        z: Minors<S>,
    ) -> [Minors<S>; 2] {
        match self {
            Self::Bonded => [y, z],
            Self::Sliding => {
                let none = S::f64s::splat(simd, 0.0);
                [y, z].map(|[d, _, _, c22, _]| [none, d, none, none, c22])
            }
            Self::Springs { tangential, normal } => {
                let [w, v] = if tangential == f64::INFINITY {
                    [1.0, 0.0].map(|share| S::f64s::splat(simd, share))
                } else {
                    let unit = S::f64s::splat(simd, 1.0) / (k + tangential);
                    [unit * tangential, unit * k]
                };
                let normal = k * normal.recip();
                let y_above = joined::<S>([w, v, normal], y);
                let mut z_above = joined::<S>([w, v, normal], z);
                let [d, c11, _, c22, _] = y;
                let of_normal = w * normal;
                z_above[1] += v * d;
                z_above[3] += of_normal * d;
                z_above[4] += v * c22 + of_normal * c11 + v * normal * d * 2.0;
                [y_above, z_above]
            }
        }
    }

    /// Carries minors as power series in the wave number, one coefficient after the other. What
    /// follows is divided by the largest power of the wave number that all minors have.
    pub(crate) fn pass_series<S: Simd>(self, simd: S, y: &mut [Minors<S>]) {
        if self == Self::Bonded {
            return;
        }
        let [tangential, normal] = self.stiffnesses();
        // The weights of `y` and of `k` times what `v` multiplies: `kt` to 1, without overflow.
        let [w, v] = match tangential {
            ..SLIDES => [0.0, 1.0],
            ..1.0 => [tangential, 1.0],
            _ => [1.0, tangential.recip()],
        };
        let per_normal = S::f64s::splat(simd, normal.recip());
        for power in (1..y.len()).rev() {
            let [d, c11, ..] = y[power - 1];
            y[power][3] += per_normal * d;
            y[power][4] += per_normal * c11;
        }
        for power in (0..y.len()).rev() {
            y[power] = scaled::<S>(S::f64s::splat(simd, w), y[power]);
            if power > 0 {
                let [d, _, _, c22, _] = y[power - 1];
                y[power][1] += d * v;
                y[power][4] += c22 * v;
            }
        }
        let is_zero = |minors: &Minors<S>| minors.iter().all(|minor| minor[0] == 0.0);
        let lowest = y.iter().take_while(|minors| is_zero(minors)).count();
        y.rotate_left(lowest);
    }
}

/// Returns the linear step of springs with `[w, v, k/kn]`.
#[inline(always)]
fn joined<S: Simd>([w, v, normal]: [S::f64s; 3], y: Minors<S>) -> Minors<S> {
    let [d, c11, c12, c22, det] = y;
    #[expect(
        clippy::eq_op,
        reason = "zeros need no token of the vector instructions"
    )]
    let none = d - d;
    let y = [
        d,
        c11,
        c12,
        normal.mul_add(d, c22),
        normal.mul_add(c11, det),
    ];
    sum::<S>(scaled::<S>(w, y), v, [none, d, none, none, y[3]])
}
