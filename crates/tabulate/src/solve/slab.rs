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
//! F = f(y) + q f(N y) + q^2/2 f(N^2 y) + 4 l- (1 - 2q + 2q^2 - E)                        (3)
//! ```
//!
//! The slope `k dX/dk` follows from `z = k dy/dk`, which takes the same steps as `y` and in each
//! layer `q N y(top)` in addition. Any multiple of `y` may be taken from `z`, as the factor of `y`
//! is free: with `q (N - 2) y(top)` instead, and with `d = 1` after every layer, `z` stays of the
//! size of `y` in thick layers, too.

use std::array::from_fn;
use std::ops::{Add, Mul, Sub};

use crate::solve::compliance::hyperbolic_rests;

/// The largest `q` of a layer for which the power series of (1) are used; (2) is used beyond.
const SWITCH: f64 = 1.0;

/// One value at each of `L` wave numbers. The operations are independent of each other and fill the
/// processor's vector registers.
#[derive(Clone, Copy, Debug)]
pub struct Lanes<const L: usize>(pub [f64; L]);

impl<const L: usize> Lanes<L> {
    /// Returns one value everywhere.
    #[inline]
    pub fn all(value: f64) -> Self {
        Self([value; L])
    }

    /// Applies a function to every value.
    #[inline]
    pub fn map(mut self, f: impl Fn(f64) -> f64) -> Self {
        for value in &mut self.0 {
            *value = f(*value);
        }
        self
    }

    /// Returns the values of `first` where `choose` holds for that of `self`, elsewhere those of
    /// `second`.
    fn choose(self, choose: impl Fn(f64) -> bool, first: Self, mut second: Self) -> Self {
        for i in 0..L {
            if choose(self.0[i]) {
                second.0[i] = first.0[i];
            }
        }
        second
    }
}

impl<const L: usize> Add for Lanes<L> {
    type Output = Self;
    #[inline]
    fn add(mut self, other: Self) -> Self {
        for (value, other) in self.0.iter_mut().zip(other.0) {
            *value += other;
        }
        self
    }
}

impl<const L: usize> Add<f64> for Lanes<L> {
    type Output = Self;
    #[inline]
    fn add(self, other: f64) -> Self {
        self + Self::all(other)
    }
}

impl<const L: usize> Sub for Lanes<L> {
    type Output = Self;
    #[inline]
    fn sub(mut self, other: Self) -> Self {
        for (value, other) in self.0.iter_mut().zip(other.0) {
            *value -= other;
        }
        self
    }
}

impl<const L: usize> Mul for Lanes<L> {
    type Output = Self;
    #[inline]
    fn mul(mut self, other: Self) -> Self {
        for (value, other) in self.0.iter_mut().zip(other.0) {
            *value *= other;
        }
        self
    }
}

impl<const L: usize> Mul<f64> for Lanes<L> {
    type Output = Self;
    #[inline]
    fn mul(self, other: f64) -> Self {
        self * Self::all(other)
    }
}

/// The minors `(d, c11, c12, c22, D)`, or their derivatives.
pub type Minors<const L: usize> = [Lanes<L>; 5];

/// The numbers of one layer.
#[derive(Clone, Copy, Debug)]
pub struct Slab {
    /// The thickness, in units of one over that of the wave number.
    pub thickness: f64,
    /// The shear modulus over that of the body below; 1 on a rigid base, whose minors have no unit.
    contrast: f64,
    b: f64,
    l: f64,
    /// `2/(1 - nu)`, the reduced modulus over half the shear modulus.
    pub e: f64,
}

impl Slab {
    /// Takes the numbers of a layer of Poisson ratio `nu`.
    pub fn new(nu: f64, thickness: f64, contrast: f64) -> Self {
        Self {
            thickness,
            contrast,
            b: (1.0 - 2.0 * nu) / (2.0 * (1.0 - nu)),
            l: nu / (1.0 - nu),
            e: 2.0 / (1.0 - nu),
        }
    }

    /// Changes minors in the unit of the body below into the unit of this layer.
    #[inline]
    pub fn enter<const L: usize>(&self, [d, c11, c12, c22, det]: Minors<L>) -> Minors<L> {
        let m = self.contrast;
        [d, c11 * m, c12 * m, c22 * m, det * (m * m)]
    }

    /// Returns `N y`.
    #[inline]
    pub fn n_times<const L: usize>(&self, [d, c11, c12, c22, det]: Minors<L>) -> Minors<L> {
        [
            c11 * self.e,
            d + c12 * 2.0,
            c22 - c11 * self.l,
            d * self.b - c12 * (2.0 * self.l) + det * self.e,
            c22 + c11 * self.b,
        ]
    }

    /// Carries minors `y` and `z = k dy/dk` from the bottom to the top of the layer, at wave
    /// numbers `k`. The result is divided by a function of `k`, whose slope is part of the result.
    #[inline]
    pub fn cross<const L: usize>(&self, k: Lanes<L>, y: Minors<L>, z: Minors<L>) -> [Minors<L>; 2] {
        let q = k * self.thickness;
        let is_thin = |q: f64| q <= SWITCH;
        let thin = q.0.iter().filter(|&&q| is_thin(q)).count();
        if thin == L {
            return self.cross_thin(q, y, z);
        }
        let thick = self.cross_thick(q, y, z);
        if thin == 0 {
            return thick;
        }
        let thin = self.cross_thin(q, y, z);
        from_fn(|j| from_fn(|i| q.choose(is_thin, thin[j][i], thick[j][i])))
    }

    /// Equation (1).
    #[inline]
    fn cross_thin<const L: usize>(
        &self,
        q: Lanes<L>,
        y: Minors<L>,
        z: Minors<L>,
    ) -> [Minors<L>; 2] {
        let [sinh, cosh] = hyperbolic_rests(q * 2.0);
        let factors = [q, q * q * 0.5, sinh * 0.125, cosh * 0.0625];
        let y_top = self.thin_step(factors, y);
        let z_top = self.thin_step(factors, z);
        [y_top, sum(z_top, q, self.n_times(y_top))]
    }

    /// The sum of (1), with the factors of `N y` to `N^4 y`.
    fn thin_step<const L: usize>(&self, factors: [Lanes<L>; 4], y: Minors<L>) -> Minors<L> {
        let (mut total, mut power) = (y, y);
        for factor in factors {
            power = self.n_times(power);
            total = sum(total, factor, power);
        }
        total
    }

    /// Equation (2), divided by `e^{2q}`.
    #[inline]
    fn cross_thick<const L: usize>(
        &self,
        q: Lanes<L>,
        y: Minors<L>,
        z: Minors<L>,
    ) -> [Minors<L>; 2] {
        let e = (q * -2.0).map(f64::exp);
        let (y_up, y_rest) = self.thick_step(q, e, y);
        let (z_up, z_rest) = self.thick_step(q, e, z);
        // `N - 2` is 0 on what grows: no digits are lost, however large `q` is.
        let change = sum(self.n_times(y_rest), Lanes::all(-2.0), y_rest);
        [
            sum(y_up, e, y_rest),
            sum(sum(z_up, e, z_rest), q * e, change),
        ]
    }

    /// The two parts of (2): `P+`, and what is multiplied with `E`.
    fn thick_step<const L: usize>(
        &self,
        q: Lanes<L>,
        e: Lanes<L>,
        y: Minors<L>,
    ) -> (Minors<L>, Minors<L>) {
        let half_square = q * q * 0.5;
        let [grow, fall] = self.exponential_parts(y);
        let once = self.n_times(y);
        let twice = self.n_times(once);
        let shape = [self.e, 2.0, 2.0 * self.b, 2.0, 1.0 + self.b];
        let (mut all_up, mut rest) = (y, y);
        for i in 0..5 {
            let sign = if i % 2 == 0 { 1.0 } else { -1.0 };
            let (up, down) = (grow * shape[i], fall * (sign * shape[i]));
            all_up[i] = up;
            rest[i] = e * down
                + (y[i] - up - down)
                + q * (once[i] - (up - down) * 2.0)
                + half_square * (twice[i] - (up + down) * 4.0);
        }
        (all_up, rest)
    }

    /// Returns `l+` and `l-`.
    #[inline]
    fn exponential_parts<const L: usize>(
        &self,
        [d, c11, c12, c22, det]: Minors<L>,
    ) -> [Lanes<L>; 2] {
        let even = d * (1.0 + self.b) + c12 * (4.0 * self.b) + det * self.e;
        let odd = (c11 + c22) * 2.0;
        [(even + odd) * 0.0625, (even - odd) * 0.0625]
    }

    /// Returns `X - 1` and `k dX/dk` at the top of this layer, at wave numbers `k`, from minors `y`
    /// and `z = k dy/dk` at its bottom.
    #[inline]
    pub fn sample<const L: usize>(&self, k: Lanes<L>, y: Minors<L>, z: Minors<L>) -> [Lanes<L>; 2] {
        let q = k * self.thickness;
        let [y_top, z_top] = self.cross(k, y, z);
        let per_d = y_top[0].map(f64::recip);
        let half = 0.5 * self.e;
        let is_thin = |q: f64| q <= SWITCH;
        let thin = q.0.iter().filter(|&&q| is_thin(q)).count();
        let small = || {
            let x = y_top[3] * half * per_d;
            [
                (y_top[3] * half - y_top[0]) * per_d,
                (z_top[3] * half - x * z_top[0]) * per_d,
            ]
        };
        if thin == L {
            return small();
        }
        let e = (q * -2.0).map(f64::exp);
        let [value, slope] = self.departure(q, e, y, z);
        let factor = e * half * per_d;
        let large = [
            factor * value,
            factor * (slope - value * (q * 2.0 + z_top[0] * per_d)),
        ];
        if thin == 0 {
            return large;
        }
        let small = small();
        from_fn(|i| q.choose(is_thin, small[i], large[i]))
    }

    /// Returns `F` of equation (3) and `k dF/dk`.
    #[inline]
    fn departure<const L: usize>(
        &self,
        q: Lanes<L>,
        e: Lanes<L>,
        y: Minors<L>,
        z: Minors<L>,
    ) -> [Lanes<L>; 2] {
        let square = q * q;
        let of_fall = square * 2.0 - q * 2.0 - e + 1.0;
        let [of_y, once, twice, fall] = self.functionals(y);
        let value = of_y + q * once + square * twice * 0.5 + fall * of_fall;
        let explicit =
            q * once + square * twice + fall * (square * 4.0 + q * (e - Lanes::all(1.0)) * 2.0);
        let [of_z, once, twice, fall] = self.functionals(z);
        let slope = of_z + q * once + square * twice * 0.5 + fall * of_fall + explicit;
        [value, slope]
    }

    /// Returns `f(y)`, `f(N y)`, `f(N^2 y)` and `4 l-`.
    fn functionals<const L: usize>(&self, y: Minors<L>) -> [Lanes<L>; 4] {
        let factor = 2.0 / self.e;
        let once = self.n_times(y);
        let twice = self.n_times(once);
        let [_, fall] = self.exponential_parts(y);
        [
            y[3] - y[0] * factor,
            once[3] - once[0] * factor,
            twice[3] - twice[0] * factor,
            fall * 4.0,
        ]
    }
}

/// Returns `a + factor b`.
#[inline]
pub fn sum<const L: usize>(mut a: Minors<L>, factor: Lanes<L>, b: Minors<L>) -> Minors<L> {
    for (a, b) in a.iter_mut().zip(b) {
        *a = *a + factor * b;
    }
    a
}

/// Returns `factor a`.
#[inline]
pub fn scaled<const L: usize>(factor: Lanes<L>, mut a: Minors<L>) -> Minors<L> {
    for a in &mut a {
        *a = *a * factor;
    }
    a
}
