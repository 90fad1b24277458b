//! Coulomb wave functions, as the transforms of the edge functions of a sticking contact.
//!
//! The contact's normal and tangential fields are expanded together in
//! `((1-s)/(1+s))^{i eps} P_n^{(i eps, -i eps)}(s)` on `[-1, 1]`, whose Fourier transforms are
//! Coulomb wave functions `F_n` (DLMF 33). With `s+_n = +,+,-,-,+,+,..` and `s-_n = (-1)^n s+_n`
//!
//! ```text
//! P+-_n(z) = s+-_n sqrt(2n+1) e^{-+ pi eps/2} F_n(-+eps, z)/z          p_n = (P+ + P-)/2      q_n = (P+ - P-)/2
//! ```
//!
//! For `eps = 0` these are Legendre polynomials and spherical Bessel functions: `p_n` is 0 for odd
//! `n` and `q_n` for even `n`. With `eta = -+eps`, `R_n^2 = 1 + (eps/n)^2` and
//! `F_n(eta, z)/z = e^{-pi eta/2} c0 R_1 .. R_n g_n`, `c0^2 = pi eps/sinh(pi eps)`, the recurrence of
//! DLMF 33.4 is
//!
//! ```text
//! g_{n-1} = (2n+1) (1/z + eta/(n(n+1))) g_n - R_{n+1}^2 g_{n+1}
//! ```
//!
//! It is run downwards (Miller), and scaled by the expansion of `e^{-izs}` at `s = 0`,
//! `sum_n (2n+1) r_n g_n = 1` with `r_0 = 1`, `r_1 = -eta`, `r_n = ((n-1)^2 + eps^2)/(n(n-1)) r_{n-2}`:
//! no sines and cosines are needed. Where all orders are below 0.8 `z` it is run upwards, from the
//! asymptotic series of `F_0` and `F_1` (DLMF 33.11).
//!
//! One pass over the arguments writes the transforms of all modes and sums the products with the
//! first two of them, up to twice the number of modes: `lattice.rs` makes the matrix of them.

use std::f64::consts::PI;

use fearless_simd::prelude::*;
use fearless_simd::{Level, dispatch, f64x8};

/// The number of arguments handled at once.
pub const LANES: usize = 8;

/// The least `z` at which asymptotic series are exact to rounding.
pub const ASYMPTOTIC: f64 = 40.0;

/// The number of terms of the asymptotic series: at `z = 40` the next one is below 1e-17.
const TERMS: usize = 20;

/// Evaluates `p_n` and `q_n` for `n < modes`, and products of orders up to `2 modes`.
#[derive(Clone, Debug)]
pub struct Coulomb {
    pub eps: f64,
    pub modes: usize,
    /// The recurrence and the scaling sum, order by order.
    pub steps: Vec<Step>,
    /// `s+_n sqrt(2n+1) c0 R_1 .. R_n/2`.
    pub scale: Vec<f64>,
    /// `arg Gamma(1 + i |eps|)`.
    phase: f64,
    /// `e^{pi eta/2}/c0` for the negative and the positive `eta`.
    amplitude: [f64; 2],
}

/// The coefficients at order `n`, for `eta = eps`. `eps` changes its sign with `eta`.
#[derive(Clone, Copy, Debug)]
pub struct Step {
    /// `2n+1`.
    pub per_z: f64,
    /// `(2n+1) eps/(n(n+1))`, 0 at `n = 0`.
    pub charge: f64,
    /// `R_{n+1}^2`.
    pub next: f64,
    /// `(2n+1) r_n`.
    weight: f64,
}

/// The transforms at many arguments, and their products with the first two.
#[derive(Clone, Debug)]
pub struct Transforms {
    /// The columns of `p_n`, by [`column`], of `rows` values each.
    pub p: Vec<f64>,
    /// The columns of `q_n`; for `eps = 0` those of odd `n` only.
    pub q: Vec<f64>,
    /// The number of arguments.
    pub rows: usize,
    /// The sums of products: for every order, those of `lattice.rs`.
    pub sums: Vec<Sums>,
}

/// The sums of the products of one order with the first two.
pub type Sums = [f64; 8];

impl Transforms {
    /// Returns `sum c_n p_n` and `sum c_n q_n` at all arguments.
    pub fn sum(&self, c: &[f64]) -> [Vec<f64>; 2] {
        let mut ordered = vec![0.0; c.len()];
        for (n, value) in c.iter().enumerate() {
            ordered[column(n, c.len())] = *value;
        }
        let of_p = &ordered[..self.p.len() / self.rows];
        let of_q = &ordered[c.len() - self.q.len() / self.rows..];
        [(&self.p, of_p), (&self.q, of_q)].map(
            |(columns, c)| dispatch!(Level::new(), simd => combined(simd, columns, c, self.rows)),
        )
    }
}

/// Returns the place of order `n` among `orders` (an even number): even orders come first.
pub const fn column(n: usize, orders: usize) -> usize {
    n / 2 + (n % 2) * (orders / 2)
}

impl Coulomb {
    /// Prepares an even number of `modes` for arguments up to `largest`.
    pub fn new(eps: f64, modes: usize, largest: f64) -> Self {
        debug_assert!(modes >= 2 && modes.is_multiple_of(2));
        let count = top(largest).max(2 * modes) + 2;
        let square = |n: usize| 1.0 + (eps / n as f64).powi(2);
        let mut r = [1.0, -eps];
        let step = |n: usize| {
            let m = n as f64;
            if n >= 2 {
                r[n % 2] *= ((m - 1.0).powi(2) + eps * eps) / (m * (m - 1.0));
            }
            let odd = 2.0 * m + 1.0;
            Step {
                per_z: odd,
                charge: if n == 0 {
                    0.0
                } else {
                    odd * eps / (m * (m + 1.0))
                },
                next: square(n + 1),
                weight: odd * r[n % 2],
            }
        };
        let steps = (0..count).map(step).collect();
        let mut product = 0.5 * c0(eps);
        let scale = |n: usize| {
            if n > 0 {
                product *= square(n).sqrt();
            }
            let sign = if n % 4 < 2 { 1.0 } else { -1.0 };
            sign * ((2 * n + 1) as f64).sqrt() * product
        };
        Self {
            eps,
            modes,
            steps,
            scale: (0..modes).map(scale).collect(),
            phase: phase_of_gamma(eps.abs()),
            amplitude: [-1.0, 1.0].map(|sign| (0.5 * sign * PI * eps.abs()).exp() / c0(eps)),
        }
    }

    /// Returns the numbers of columns of `p` and of `q`.
    pub const fn columns(&self) -> [usize; 2] {
        if self.eps == 0.0 {
            [self.modes / 2; 2]
        } else {
            [self.modes; 2]
        }
    }

    /// Returns `p_n` and `q_n` at positive, ascending arguments `z`, a multiple of [`LANES`], and
    /// the sums of their products with the `factors` of both normal, of mixed and of both tangential
    /// transforms.
    pub fn transforms(&self, z: &[f64], factors: [&[f64]; 3]) -> Transforms {
        let [of_p, of_q] = self.columns();
        let mut transforms = Transforms {
            p: vec![0.0; of_p * z.len()],
            q: vec![0.0; of_q * z.len()],
            rows: z.len(),
            sums: Vec::new(),
        };
        dispatch!(Level::new(), simd => self.fill(simd, z, factors, &mut transforms));
        transforms
    }

    /// Returns `g_n` of `eta = -eps` at one argument.
    pub fn functions_at(&self, z: f64) -> Vec<f64> {
        dispatch!(Level::new(), simd => self.first_lane(simd, z))
    }

    #[inline(always)]
    fn first_lane<S: Simd>(&self, simd: S, z: f64) -> Vec<f64> {
        let mut functions = vec![f64x8::splat(simd, 0.0); 2 * self.modes];
        self.functions(simd, &[z; LANES], -1.0, &mut functions);
        functions.iter().map(|value| value[0]).collect()
    }

    #[inline(always)]
    fn fill<S: Simd>(
        &self,
        simd: S,
        arguments: &[f64],
        factors: [&[f64]; 3],
        target: &mut Transforms,
    ) {
        let zero = f64x8::splat(simd, 0.0);
        let orders = 2 * self.modes;
        let (mut plus, mut minus) = (vec![zero; orders], vec![zero; orders]);
        let (mut sums_of_plus, mut sums_of_minus) =
            (vec![[zero; 4]; orders], vec![[zero; 4]; orders]);
        let stride = arguments.len();
        for (group, z) in arguments.as_chunks::<LANES>().0.iter().enumerate() {
            let at = group * LANES;
            let normal = f64x8::from_slice(simd, &factors[0][at..][..LANES]);
            let mixed = f64x8::from_slice(simd, &factors[1][at..][..LANES]);
            let shear = f64x8::from_slice(simd, &factors[2][at..][..LANES]);
            self.functions(simd, z, -1.0, &mut plus);
            if self.eps == 0.0 {
                for (n, scale) in self.scale.iter().enumerate() {
                    let values = if n % 2 == 0 {
                        &mut target.p
                    } else {
                        &mut target.q
                    };
                    let value = plus[n] * (2.0 * scale);
                    value.store_slice(&mut values[n / 2 * stride + at..][..LANES]);
                }
                let [of_p, of_q] = [plus[0], plus[1]];
                let even = [of_p * normal, of_q * mixed, of_p * shear];
                let odd = [of_p * mixed, of_q * normal, of_q * shear];
                add_products(&mut sums_of_plus, &plus, [even, odd]);
                continue;
            }
            self.functions(simd, z, 1.0, &mut minus);
            for (n, scale) in self.scale.iter().enumerate() {
                let place = column(n, self.modes) * stride + at;
                let plus = plus[n] * *scale;
                let minus = minus[n] * if n % 2 == 0 { *scale } else { -scale };
                (plus + minus).store_slice(&mut target.p[place..][..LANES]);
                (plus - minus).store_slice(&mut target.q[place..][..LANES]);
            }
            let (sum, unlike) = (normal + shear, normal - shear);
            let [of_plus, of_minus] = [mixed.mul_add(2.0, sum), mixed.mul_add(-2.0, sum)];
            let beside = [
                plus[0] * of_plus,
                plus[1] * of_plus,
                minus[0] * unlike,
                minus[1] * unlike,
            ];
            add_products(&mut sums_of_plus, &plus, [beside; 2]);
            let beside = [
                minus[0] * of_minus,
                minus[1] * of_minus,
                plus[0] * unlike,
                plus[1] * unlike,
            ];
            add_products(&mut sums_of_minus, &minus, [beside; 2]);
        }
        let reduce = |(plus, minus): (&[f64x8<S>; 4], &[f64x8<S>; 4])| -> Sums {
            std::array::from_fn(|i| {
                let lanes = if i < 4 { plus[i] } else { minus[i - 4] };
                lanes.iter().sum()
            })
        };
        target.sums = sums_of_plus
            .iter()
            .zip(&sums_of_minus)
            .map(reduce)
            .collect();
    }

    /// Writes `g_n` of `eta = sign * eps`.
    #[inline(always)]
    fn functions<S: Simd>(&self, simd: S, z: &[f64; LANES], sign: f64, g: &mut [f64x8<S>]) {
        let arguments = f64x8::simd_from(simd, *z);
        let inverse = f64x8::splat(simd, 1.0) / arguments;
        if z[0] >= ASYMPTOTIC.max(2.5 * self.modes as f64) {
            [g[0], g[1]] = self.first_two(simd, z, sign * self.eps);
            for n in 1..g.len() - 1 {
                let step = self.steps[n];
                let factor = inverse.mul_add(step.per_z, f64x8::splat(simd, sign * step.charge));
                let share = 1.0 / step.next;
                g[n + 1] = (factor * share).mul_sub(g[n], g[n - 1] * share);
            }
            return;
        }
        let top = top(z[LANES - 1]);
        let zero = f64x8::splat(simd, 0.0);
        // Nothing overflows from here: the spread of a group makes its smallest argument grow by
        // less than 1e300.
        let (mut after, mut now, mut sum) = (zero, f64x8::splat(simd, 1e-200), zero);
        for value in g.iter_mut().skip(top + 1) {
            *value = zero;
        }
        for n in (1..=top).rev() {
            if n < g.len() {
                g[n] = now;
            }
            let step = self.steps[n];
            // The weights of odd orders have the sign of `-eta`.
            let weight = if n % 2 == 1 {
                sign * step.weight
            } else {
                step.weight
            };
            sum = now.mul_add(weight, sum);
            let factor = inverse.mul_add(step.per_z, f64x8::splat(simd, sign * step.charge));
            let before = factor.mul_sub(now, after * step.next);
            (after, now) = (now, before);
        }
        g[0] = now;
        let factor = f64x8::splat(simd, 1.0) / (sum + now);
        for value in g.iter_mut().take(top + 1) {
            *value *= factor;
        }
    }

    /// Returns `g_0` and `g_1` by their asymptotic series, which ends at once for `eta = 0`.
    #[inline(always)]
    fn first_two<S: Simd>(&self, simd: S, z: &[f64; LANES], eta: f64) -> [f64x8<S>; 2] {
        let phase = if eta < 0.0 { -self.phase } else { self.phase };
        let (mut sine, mut cosine) = ([0.0; LANES], [0.0; LANES]);
        for (l, z) in z.iter().enumerate() {
            (sine[l], cosine[l]) = z.sin_cos();
            if eta != 0.0 {
                let (s, c) = (phase - eta * (2.0 * z).ln()).sin_cos();
                let [sin, cos] = [sine[l], cosine[l]];
                (sine[l], cosine[l]) = (sin * c + cos * s, cos * c - sin * s);
            }
        }
        let (sin, cos) = (f64x8::simd_from(simd, sine), f64x8::simd_from(simd, cosine));
        let inverse = f64x8::splat(simd, 1.0) / f64x8::simd_from(simd, *z);
        let factor = inverse * self.amplitude[usize::from(eta > 0.0)];
        // The phase of `F_1` is larger by `atan(eta) - pi/2`, and `g_1` has a factor `1/R_1`.
        let square = 1.0 / (1.0 + eta * eta);
        let (sin_1, cos_1) = ((sin * eta - cos) * square, (cos * eta + sin) * square);
        [
            factor * asymptotic(simd, inverse, 0.0, eta, [sin, cos]),
            factor * asymptotic(simd, inverse, 1.0, eta, [sin_1, cos_1]),
        ]
    }
}

/// Returns the asymptotic series of `F_l` at descending values of `1/z`.
#[inline(always)]
fn asymptotic<S: Simd>(
    simd: S,
    inverse: f64x8<S>,
    l: f64,
    eta: f64,
    [sin, cos]: [f64x8<S>; 2],
) -> f64x8<S> {
    let (mut f, mut g) = (f64x8::splat(simd, 1.0), f64x8::splat(simd, 0.0));
    let (mut sum_f, mut sum_g) = (f, g);
    for k in 0..TERMS {
        let k = k as f64;
        let unit = inverse * (0.5 / (k + 1.0));
        let lambda = unit * ((2.0 * k + 1.0) * eta);
        let mu = unit * (l * (l + 1.0) - k * (k + 1.0) + eta * eta);
        (f, g) = (lambda * f - mu * g, lambda * g + mu * f);
        sum_f += f;
        sum_g += g;
        // The smallest argument is the first.
        if f[0].abs() + g[0].abs() < 1e-18 {
            break;
        }
    }
    sum_g * cos + sum_f * sin
}

/// Returns the sum of `columns` of `rows` values, each times its factor.
#[inline(always)]
fn combined<S: Simd>(simd: S, columns: &[f64], factors: &[f64], rows: usize) -> Vec<f64> {
    let mut sums = vec![0.0; rows];
    for (i, sums) in sums.as_chunks_mut::<LANES>().0.iter_mut().enumerate() {
        let mut sum = f64x8::splat(simd, 0.0);
        for (column, factor) in columns.chunks_exact(rows).zip(factors) {
            let values = f64x8::from_slice(simd, &column[i * LANES..][..LANES]);
            sum = values.mul_add(*factor, sum);
        }
        sum.store_slice(sums);
    }
    sums
}

/// Adds the products of the functions `g` with the values `beside` even and odd orders.
#[inline(always)]
fn add_products<S: Simd, const N: usize>(
    sums: &mut [[f64x8<S>; 4]],
    g: &[f64x8<S>],
    beside: [[f64x8<S>; N]; 2],
) {
    let [even, odd] = beside;
    for (sums, g) in sums
        .as_chunks_mut::<2>()
        .0
        .iter_mut()
        .zip(g.as_chunks::<2>().0)
    {
        for i in 0..N {
            sums[0][i] = g[0].mul_add(even[i], sums[0][i]);
            sums[1][i] = g[1].mul_add(odd[i], sums[1][i]);
        }
    }
}

/// Returns `(pi eps/sinh(pi eps))^{1/2}`.
pub fn c0(eps: f64) -> f64 {
    let argument = PI * eps;
    if argument == 0.0 {
        1.0
    } else {
        (argument / argument.sinh()).sqrt()
    }
}

/// Returns `arg Gamma(1 + i eps)`, by Stirling's series after 20 steps of the recurrence.
fn phase_of_gamma(eps: f64) -> f64 {
    const STEPS: usize = 20;
    let n = STEPS as f64 + 1.0;
    let below: f64 = (1..=STEPS).map(|k| (eps / k as f64).atan()).sum();
    let square = n * n + eps * eps;
    // Im[(w - 1/2) ln w - w + 1/(12 w) - 1/(360 w^3) + 1/(1260 w^5)] at w = n + i eps.
    let angle = eps.atan2(n);
    let inverse =
        |power: i32| -(f64::from(power) * angle).sin() / square.powf(0.5 * f64::from(power));
    0.5 * eps * square.ln() + (n - 0.5) * angle - eps + inverse(1) / 12.0 - inverse(3) / 360.0
        + inverse(5) / 1260.0
        - below
}

/// Returns the order at which the downward recurrence begins for arguments up to `z`.
///
/// Beyond the turning point `n = z` the functions fall like `exp(-2/3 xi^{3/2})` with
/// `xi = (n - z)/(z/2)^{1/3}`, and for small `z` like `z^n`.
fn top(z: f64) -> usize {
    if z < 1e-2 {
        return (20.0 / -z.log10()).ceil() as usize + 2;
    }
    (z + 15.0 * (0.5 * z).cbrt() + 12.0).ceil() as usize
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::estimate::larger;

    /// Returns `p_n` and `q_n` of all orders at one argument.
    fn values(eps: f64, orders: usize, z: f64) -> [Vec<f64>; 2] {
        let coulomb = Coulomb::new(eps, orders, z);
        let nothing = [0.0; LANES];
        let Transforms { p, q, .. } = coulomb.transforms(&[z; LANES], [&nothing; 3]);
        let first = orders - coulomb.columns()[1];
        let at = |values: &[f64], place: Option<usize>| {
            place
                .and_then(|place| values.get(place * LANES))
                .copied()
                .unwrap_or(0.0)
        };
        [
            (0..orders)
                .map(|n| at(&p, Some(column(n, orders))))
                .collect(),
            (0..orders)
                .map(|n| at(&q, column(n, orders).checked_sub(first)))
                .collect(),
        ]
    }

    /// Legendre polynomials: `p_n` and `q_n` are spherical Bessel functions of even and odd order.
    #[test]
    fn without_coupling_they_are_spherical_bessel_functions() {
        for z in [1e-30, 1e-4, 0.3, 3.0_f64, 30.0, 80.0, 300.0] {
            let [p, q] = values(0.0, 20, z);
            let j1 = if z < 0.1 {
                z / 3.0 * (1.0 - z * z / 10.0)
            } else {
                (z.sin() / z - z.cos()) / z
            };
            let size = 1.0 / z.max(1.0);
            assert!((p[0] - z.sin() / z).abs() <= 1e-14 * size, "{z}");
            assert!((q[1] - 3_f64.sqrt() * j1).abs() <= 2e-14 * size, "{z}");
            assert_eq!([p[1], q[0]], [0.0; 2]);
        }
    }

    /// The upward recurrence from the asymptotic series meets the downward one, which is scaled in
    /// another way.
    #[test]
    fn both_directions_of_the_recurrence_agree() {
        let mut worst = 0.0;
        for eps in [-0.3, -0.1, 0.0, 0.02, 0.175, 0.3] {
            for z in [45.0, 61.3, 120.0, 400.0] {
                // With more orders the same arguments are below the switch.
                let few = values(eps, 20, z);
                let many = values(eps, 2 * z as usize, z);
                for (few, many) in few.iter().zip(&many) {
                    for (few, many) in few.iter().zip(many) {
                        worst = larger(worst, z * (few - many).abs());
                    }
                }
            }
        }
        println!("directions agree to {worst:.1e}");
        assert!(worst <= 1e-12);
    }
}
