//! One layer: carries the minors of what lies below to its top, at several wave numbers at once.
//!
//! With `z` upwards and `' = d/d(kz)`, the fields `u_r = U J1(kr)`, `u_z = W J0(kr)`,
//! `s_rz = k G S J1(kr)` and `s_zz = k G P J0(kr)` of axisymmetric elasticity obey
//!
//! ```text
//! U' = W + S        W' = -l U + b P        S' = e U + l P        P' = -S
//! b = (1 - 2 nu)/(2 (1 - nu))       l = nu/(1 - nu)       e = 2/(1 - nu)
//! ```
//!
//! (Hooke's law and equilibrium, Hankel transformed; nothing is singular at `nu = 1/2`). The base
//! admits two of the four solutions. The surface of what lies below some height has a compliance,
//! the symmetric positive matrix `C` in `(U, W) = C (S, P)`, and `X = (E*/2) k C_22` at the top.
//! Every way to carry `C`, its inverse or the two solutions themselves upwards loses digits
//! somewhere. The five different 2 x 2 minors of the two solutions do not (the idea is Dunkin's,
//! Bull. Seismol. Soc. Am. 55, 335, 1965):
//!
//! ```text
//! y = (d, c11, c12, c22, D)      C = [[c11, c12], [c12, c22]]/d      det C = D/d
//! ```
//!
//! where only the ratios matter. The product rule gives a linear equation `y' = N y`,
//!
//! ```text
//! d' = e c11             c11' = d + 2 c12                c12' = c22 - l c11
//! c22' = b d - 2 l c12 + e D                             D' = c22 + b c11
//! ```
//!
//! in units of `1/G` of the layer. All coefficients are positive but the two with `l`. `N` has the
//! eigenvalues 2, -2 and three times 0, and `N^5 = 4 N^3`. With `q = k h` of a layer of thickness
//! `h`, its exact exponential is therefore
//!
//! ```text
//! y(top) = y + q N y + q^2/2 N^2 y                                                       (1)
//!          + (sinh 2q - 2q)/8 N^3 y + (cosh 2q - 1 - 2q^2)/16 N^4 y
//! ```
//!
//! Beyond `q = 1` the parts `P+` and `P-` that grow and fall like `e^{2q}` and `e^{-2q}` are split
//! off and all is divided by `e^{2q}`: with `E = e^{-2q}`
//!
//! ```text
//! l+ = ((1+b) d + 2 c11 + 4b c12 + 2 c22 + e D)/16         P+ = l+ (e, 2, 2b, 2, 1+b)
//! l- = ((1+b) d - 2 c11 + 4b c12 - 2 c22 + e D)/16         P- = l- (e, -2, 2b, -2, 1+b)
//! y(top) = P+ + E {E P- + (y - P+ - P-) + q (N y - 2 P+ + 2 P-)                          (2)
//!                  + q^2/2 (N^2 y - 4 P+ - 4 P-)}
//! ```
//!
//! # The top layer
//!
//! `X = (e/2) c22/d` at the top. Where `X` is close to 1, `X - 1` comes from the functional
//! `f(y) = c22 - (2/e) d`, which is 0 on `P+`. With `y` at the bottom of the top layer and
//! `d(top)` by (2),
//!
//! ```text
//! X - 1 = (e/2) E F/d(top)
//! F = f(y) + q f(N y) + q^2/2 f(N^2 y) + c 4 l- (1 - 2q + 2q^2 - E)        c = 1         (3)
//! ```
//!
//! The slope `k dX/dk` follows from `z = k dy/dk`, which takes the same steps as `y` and in each
//! layer `q N y(top)` in addition. Any multiple of `y` may be taken from `z`, as the factor of `y`
//! is free: with `q (N - 2) y(top)` instead, and with `d = 1` after every layer, `z` stays of the
//! size of `y` in thick layers, too.

use fearless_simd::prelude::*;

use crate::compliance::exponential::exponential;
use crate::compliance::hyperbolic_rests;
use crate::compliance::minors::{Minors, sum};
use crate::stack::Interface;

/// The largest `q` of a layer for which the power series of (1) are used; (2) is used beyond.
const SWITCH: f64 = 1.0;

/// The numbers of one layer.
#[derive(Clone, Copy, Debug)]
pub struct Slab {
    /// The thickness, in units of one over that of the wave number.
    pub thickness: f64,
    /// The shear modulus over that of the body below; 1 on a rigid base, whose minors have no unit.
    contrast: f64,
    /// The interface below.
    pub interface: Interface,
    /// `(1 - 2 nu)/(2 (1 - nu))`.
    pub b: f64,
    l: f64,
    /// `2/(1 - nu)`, the reduced modulus over half the shear modulus.
    e: f64,
}

/// A compliance at the top of a layer: one of the minors times `(e/2)/d`.
#[derive(Clone, Copy)]
pub struct Component {
    /// The place of the minor.
    pub place: usize,
    /// The limit at large wave numbers, the factor of `(2/e) d` in `f`.
    pub limit: f64,
    /// The factor `c` of (3), times 4.
    pub fall: f64,
}

impl Component {
    /// The displacement under a pressure.
    pub const NORMAL: Self = Self {
        place: 3,
        limit: 1.0,
        fall: 4.0,
    };
}

/// A compliance at the top of a layer, at several wave numbers.
#[derive(Clone, Copy)]
pub struct Samples<V> {
    /// `X`.
    pub x: V,
    /// `X - 1`.
    pub excess: V,
    /// `k dX/dk`.
    pub slope: V,
}

impl Slab {
    /// Takes the numbers of a layer of Poisson ratio `nu`.
    pub fn new(nu: f64, thickness: f64, contrast: f64, interface: Interface) -> Self {
        Self {
            thickness,
            contrast,
            interface,
            b: (1.0 - 2.0 * nu) / (2.0 * (1.0 - nu)),
            l: nu / (1.0 - nu),
            e: 2.0 / (1.0 - nu),
        }
    }

    /// Changes minors in the unit of the body below into the unit of this layer.
    #[inline(always)]
    pub fn in_unit<S: Simd>(&self, [d, c11, c12, c22, det]: Minors<S>) -> Minors<S> {
        let m = self.contrast;
        [d, c11 * m, c12 * m, c22 * m, det * (m * m)]
    }

    /// Carries minors `y` and `z = k dy/dk`, in the unit of the body below, through the interface
    /// into this layer, at wave numbers `k`.
    #[inline(always)]
    pub fn enter<S: Simd>(
        &self,
        simd: S,
        k: S::f64s,
        y: Minors<S>,
        z: Minors<S>,
    ) -> [Minors<S>; 2] {
        let (y, z) = (self.in_unit::<S>(y), self.in_unit::<S>(z));
        self.interface.pass(simd, k, y, z)
    }

    /// Returns `N y`.
    #[inline(always)]
    pub fn n_times<S: Simd>(&self, [d, c11, c12, c22, det]: Minors<S>) -> Minors<S> {
        [
            c11 * self.e,
            c12.mul_add(2.0, d),
            c11.mul_add(-self.l, c22),
            det.mul_add(self.e, c12.mul_add(-2.0 * self.l, d * self.b)),
            c11.mul_add(self.b, c22),
        ]
    }

    /// Carries minors `y` and `z = k dy/dk` from the bottom to the top of the layer, at wave
    /// numbers `k`. The result is divided by a function of `k`, whose slope is part of the result.
    #[inline(always)]
    pub fn cross<S: Simd>(
        &self,
        simd: S,
        k: S::f64s,
        y: Minors<S>,
        z: Minors<S>,
    ) -> [Minors<S>; 2] {
        let q = k * self.thickness;
        let thin = q.simd_le(SWITCH);
        if thin.all_true() {
            return self.cross_thin::<S>(q, y, z);
        }
        let mut crossed = self.cross_thick::<S>(q, exponential(simd, q * -2.0), y, z);
        if thin.any_true() {
            let of_thin = self.cross_thin::<S>(q, y, z);
            for (crossed, of_thin) in crossed.iter_mut().zip(of_thin) {
                for i in 0..5 {
                    crossed[i] = thin.select(of_thin[i], crossed[i]);
                }
            }
        }
        crossed
    }

    /// Equation (1).
    #[inline(always)]
    fn cross_thin<S: Simd>(&self, q: S::f64s, y: Minors<S>, z: Minors<S>) -> [Minors<S>; 2] {
        let [sinh, cosh] = hyperbolic_rests(q * 2.0);
        let factors = [q, q * q * 0.5, sinh * 0.125, cosh * 0.0625];
        let y_top = self.thin_step::<S>(factors, y);
        let z_top = self.thin_step::<S>(factors, z);
        [y_top, sum::<S>(z_top, q, self.n_times::<S>(y_top))]
    }

    /// The sum of (1), with the factors of `N y` to `N^4 y`.
    #[inline(always)]
    fn thin_step<S: Simd>(&self, factors: [S::f64s; 4], y: Minors<S>) -> Minors<S> {
        let (mut total, mut power) = (y, y);
        for factor in factors {
            power = self.n_times::<S>(power);
            total = sum::<S>(total, factor, power);
        }
        total
    }

    /// Equation (2), divided by `e^{2q}`. `e` is `E`.
    #[inline(always)]
    fn cross_thick<S: Simd>(
        &self,
        q: S::f64s,
        e: S::f64s,
        y: Minors<S>,
        z: Minors<S>,
    ) -> [Minors<S>; 2] {
        let (y_up, y_rest) = self.thick_step::<S>(q, e, y);
        let (z_up, z_rest) = self.thick_step::<S>(q, e, z);
        // `N - 2` is 0 on what grows: no digits are lost, however large `q` is.
        let mut change = self.n_times::<S>(y_rest);
        for (change, rest) in change.iter_mut().zip(y_rest) {
            *change = rest.mul_add(-2.0, *change);
        }
        [
            sum::<S>(y_up, e, y_rest),
            sum::<S>(sum::<S>(z_up, e, z_rest), q * e, change),
        ]
    }

    /// The two parts of (2): `P+`, and what is multiplied with `E`.
    #[inline(always)]
    fn thick_step<S: Simd>(&self, q: S::f64s, e: S::f64s, y: Minors<S>) -> (Minors<S>, Minors<S>) {
        let half_square = q * q * 0.5;
        let [grow, fall] = self.exponential_parts::<S>(y);
        let once = self.n_times::<S>(y);
        let twice = self.n_times::<S>(once);
        let shape = [self.e, 2.0, 2.0 * self.b, 2.0, 1.0 + self.b];
        let (mut all_up, mut rest) = (y, y);
        for i in 0..5 {
            let sign = if i % 2 == 0 { 1.0 } else { -1.0 };
            let (up, down) = (grow * shape[i], fall * (sign * shape[i]));
            all_up[i] = up;
            let flat = y[i] - up - down;
            let linear = (up - down).mul_add(-2.0, once[i]);
            let square = (up + down).mul_add(-4.0, twice[i]);
            rest[i] = e.mul_add(down, half_square.mul_add(square, q.mul_add(linear, flat)));
        }
        (all_up, rest)
    }

    /// Returns `l+` and `l-`.
    #[inline(always)]
    fn exponential_parts<S: Simd>(&self, [d, c11, c12, c22, det]: Minors<S>) -> [S::f64s; 2] {
        let even = det.mul_add(self.e, c12.mul_add(4.0 * self.b, d * (1.0 + self.b)));
        let odd = (c11 + c22) * 2.0;
        [(even + odd) * 0.0625, (even - odd) * 0.0625]
    }

    /// Returns compliances at the top of this layer, at wave numbers `k`, from minors `y` and
    /// `z = k dy/dk` at its bottom.
    #[inline(always)]
    pub fn sample<S: Simd, const N: usize>(
        &self,
        simd: S,
        k: S::f64s,
        y: Minors<S>,
        z: Minors<S>,
        components: [Component; N],
    ) -> [Samples<S::f64s>; N] {
        let q = k * self.thickness;
        let [y_top, z_top] = self.cross(simd, k, y, z);
        let half = 0.5 * self.e;
        let per_d = S::f64s::splat(simd, 1.0) / y_top[0];
        let mut samples = [Samples {
            x: per_d,
            excess: per_d,
            slope: per_d,
        }; N];
        for (own, Component { place, limit, .. }) in samples.iter_mut().zip(components) {
            own.x = y_top[place] * half * per_d;
            own.excess = (y_top[place] * half - y_top[0] * limit) * per_d;
            own.slope = (z_top[place] * half - own.x * z_top[0]) * per_d;
        }
        let thick = q.simd_gt(SWITCH);
        if thick.any_true() {
            let e = exponential(simd, q * -2.0);
            let square = q * q;
            let half_square = square * 0.5;
            let of_fall = square * 2.0 - q * 2.0 - e + 1.0;
            let slope_of_fall = square * 4.0 + q * (e - 1.0) * 2.0;
            let factor = e * half * per_d;
            let rate = z_top[0].mul_add(per_d, q * 2.0);
            let of_y = self.functionals::<S, N>(y, components);
            let of_z = self.functionals::<S, N>(z, components);
            for (i, own) in samples.iter_mut().enumerate() {
                // `F` of equation (3) and `k dF/dk`.
                let [flat, once, twice, fall] = of_y[i];
                let value =
                    fall.mul_add(of_fall, half_square.mul_add(twice, q.mul_add(once, flat)));
                let explicit = q * once + square * twice + fall * slope_of_fall;
                let [flat, once, twice, fall] = of_z[i];
                let slope =
                    fall.mul_add(of_fall, half_square.mul_add(twice, q.mul_add(once, flat)));
                let excess = factor * value;
                let slope = factor * (slope + explicit - value * rate);
                own.excess = thick.select(excess, own.excess);
                own.slope = thick.select(slope, own.slope);
            }
        }
        samples
    }

    /// Returns `f(y)`, `f(N y)`, `f(N^2 y)` and `c 4 l-` of each compliance.
    #[inline(always)]
    fn functionals<S: Simd, const N: usize>(
        &self,
        y: Minors<S>,
        components: [Component; N],
    ) -> [[S::f64s; 4]; N] {
        let once = self.n_times::<S>(y);
        let twice = self.n_times::<S>(once);
        let [_, fall] = self.exponential_parts::<S>(y);
        let mut functionals = [[fall; 4]; N];
        for (own, Component { place, limit, fall }) in functionals.iter_mut().zip(components) {
            let factor = -2.0 * limit / self.e;
            for (of, y) in own.iter_mut().zip([y, once, twice]) {
                *of = y[0].mul_add(factor, y[place]);
            }
            own[3] *= fall;
        }
        functionals
    }
}
