//! The even Legendre moments of the curvature of a shape, `X_j = int_0^a b''(s) P_2j(s/a) ds`, in
//! closed form.
//!
//! A jump of `b'` at the axis counts as curvature there. Under a power law the moments of `s^(n-2)`
//! have a product formula. Where the slope `f'` of the shape is a linear function between knots, the
//! moments are taken on the surface: the transform `P_2j(s/a)` is that of the stress
//! `P_2j(u)/(P_2j(0) u)` with `u^2 = 1 - (r/a)^2`, and
//!
//! ```text
//! int b'' g ds = int (f'' + f'/r) r p dr
//! ```
//!
//! for every transform `g` of a stress `p` (see `even_powers`).
//! With `mu = m/a`, `u^2 = 1 - mu^2` and `J_n` the integral of `P_n(cos v)` from `arcsin(mu)` to
//! `pi/2`, a knot at the radius `m` with a jump `J` of the slope and a change `k` of its derivative
//! adds
//!
//! ```text
//! X_j = [2 a k (P_(n+1)(u) - P_(n-1)(u))/(2n + 1) + J mu P_n(u)/u + (J - k m) J_n]/P_n(0)       n = 2j
//! ```
//!
//! and `n^2 J_n = (n - 1)^2 J_(n-2) - (2n - 1) mu P_(n-1)(u)`. The other moments of the shape follow
//! by parts, each by differences of the one before:
//!
//! ```text
//! a   D_j = int b' P_(2j+1) ds = a   (X_j     - X_(j+1))/(4j + 3)
//! a^2 B_j = int b  P_2j     ds = a^2 (D_(j-1) - D_j)    /(4j + 1)       a^2 B_0 = int b ds
//! a^3 C_j = int (int b) P_(2j+1) ds = a^3 (B_j - B_(j+1))/(4j + 3)
//! ```

use fearless_simd::prelude::*;
use fearless_simd::{Level, dispatch, f64x4};

use super::legendre::{EVEN, MOST};
use super::modes::Coefficients;
use super::transform::Transform;

/// The knots that are summed side by side.
const LANES: usize = 4;

/// What a shape, or its derivative with respect to its size, has for curvature.
#[derive(Clone, Debug)]
pub(super) enum Curvature {
    /// That of `b` a factor times `s` to a power.
    Power { factor: f64, exponent: f64 },
    /// That of the slope of the surface at knots.
    Knots(Vec<Source>),
}

/// What the slope `f'` of the surface has at a radius.
#[derive(Clone, Copy, Debug)]
pub(super) struct Source {
    radius: f64,
    jump: f64,
    /// The change of its derivative.
    bend: f64,
    /// The factor of Dirac's function.
    impulse: f64,
}

impl Curvature {
    /// Returns the curvature of a shape; none of a sphere, which is a sum of even powers.
    pub(super) fn of(transform: &Transform) -> Option<Self> {
        Some(match transform {
            Transform::Sphere(_) => return None,
            &Transform::Power { factor, exponent } => Self::Power { factor, exponent },
            Transform::Knots(knots) => {
                let sources = knots.iter().map(|knot| Source {
                    radius: knot.radius,
                    jump: knot.jump,
                    bend: knot.bend,
                    impulse: 0.0,
                });
                Self::Knots(sources.collect())
            }
        })
    }

    /// Returns the derivative with respect to the logarithm of all lengths of the shape, `b - s b'`.
    pub(super) fn dilated(&self) -> Self {
        match self {
            &Self::Power { factor, exponent } => Self::Power {
                factor: (1.0 - exponent) * factor,
                exponent,
            },
            Self::Knots(sources) => {
                let dilated = sources.iter().map(|source| Source {
                    radius: source.radius,
                    jump: -source.bend * source.radius,
                    bend: -source.bend,
                    impulse: -source.jump * source.radius,
                });
                Self::Knots(dilated.collect())
            }
        }
    }

    /// Writes the moments at contact radius `a` to `sums`.
    fn write_moments(&self, a: f64, sums: &mut [f64]) {
        match self {
            &Self::Power { factor, exponent } => {
                let mut own = factor * exponent * a.powf(exponent - 1.0);
                for (j, sum) in sums.iter_mut().enumerate() {
                    let n = 2.0 * j as f64;
                    *sum = own;
                    own *= (exponent - n - 2.0) / (exponent + n + 1.0);
                }
            }
            Self::Knots(sources) => {
                sums.fill(0.0);
                let inside = sources.partition_point(|source| source.radius < a);
                dispatch!(Level::new(), simd => {
                    for sources in sources[..inside].chunks(LANES) {
                        add(simd, sums, sources, a);
                    }
                });
                for (sum, own) in sums.iter_mut().zip(EVEN.iter()) {
                    *sum *= own.at_0;
                }
            }
        }
    }

    /// Returns the integrals of a shape at contact radius `a` times functions that have coefficients.
    /// `integral` is that of `b`.
    pub(super) fn integrals(&self, a: f64, integral: f64, of: &Coefficients) -> Integrals {
        let mut moments = [0.0; MOST + 2];
        let moments = &mut moments[..of.len() + 2];
        self.write_moments(a, moments);
        let mut sums = [0.0; 4];
        let slope = |j: usize| (moments[j] - moments[j + 1]) * EVEN[j].inverse[1];
        let (mut of_slope, mut of_value) = (slope(0), integral / (a * a));
        for (j, [even, odd]) in of.iter().enumerate() {
            let next_slope = slope(j + 1);
            let next_value = (of_slope - next_slope) * EVEN[j + 1].inverse[0];
            let of_integral = (of_value - next_value) * EVEN[j].inverse[1];
            sums[0] += even * moments[j];
            sums[1] += odd * of_slope;
            sums[2] += even * of_value;
            sums[3] += odd * of_integral;
            (of_slope, of_value) = (next_slope, next_value);
        }
        let [curvature, slope, value, integral] = sums;
        Integrals {
            curvature,
            slope: a * slope,
            value: a * a * value,
            integral: a * a * a * integral,
        }
    }
}

/// Adds the moments of sources times `P_n(0)`.
#[inline(always)]
fn add<S: Simd>(simd: S, sums: &mut [f64], sources: &[Source], a: f64) {
    let mut u = [0.0; LANES];
    let mut mu = [0.0; LANES];
    // The integrals `J`, and the factors in the sum.
    let mut angle = [0.0; LANES];
    let (mut of_bend, mut of_value, mut of_angle) = ([0.0; LANES], [0.0; LANES], [0.0; LANES]);
    let mut of_slope = [0.0; LANES];
    for (lane, source) in sources.iter().enumerate() {
        let own = source.radius / a;
        let root = ((1.0 - own) * (1.0 + own)).sqrt();
        (mu[lane], u[lane]) = (own, root);
        angle[lane] = root.atan2(own);
        of_bend[lane] = 2.0 * a * source.bend;
        of_value[lane] = source.jump * own / root;
        of_angle[lane] = source.jump - source.bend * source.radius;
        if source.impulse != 0.0 {
            // `[mu P_n'(u) mu^2/u^2 - mu^3 P_n(u)/u^3]/m` with `mu^2 P_n' = n (P_(n-1) - u P_n)`.
            let impulse = source.impulse / a;
            of_slope[lane] = impulse / (root * root);
            of_value[lane] -= impulse * own * own / (root * root * root);
        }
    }
    let vector = |values: [f64; LANES]| f64x4::simd_from(simd, values);
    let (u, mu, mut angle) = (vector(u), vector(mu), vector(angle));
    let (of_bend, of_value) = (vector(of_bend), vector(of_value));
    let (of_angle, of_slope) = (vector(of_angle), vector(of_slope));
    let mut value = f64x4::splat(simd, 1.0);
    let mut before = f64x4::splat(simd, 0.0);
    for (j, (sum, own)) in sums.iter_mut().zip(EVEN.iter()).enumerate() {
        let next = (u * own.odd[0]).mul_add(value, before * -own.odd[1]);
        let slope = (before - u * value) * (2.0 * j as f64);
        let part = of_bend * (next - before) * own.inverse[0]
            + of_value * value
            + of_angle * angle
            + of_slope * slope;
        *sum += (part[0] + part[1]) + (part[2] + part[3]);
        angle = angle * own.angle[0] - mu * next * own.angle[1];
        value = (u * own.even[0]).mul_add(next, value * -own.even[1]);
        before = next;
    }
}

/// The integrals over the contact of `b''`, `b'`, `b` and the integral of `b` of a shape, each times
/// `E` or `O`.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Integrals {
    /// `int b'' E`.
    pub curvature: f64,
    /// `int b' O`.
    pub slope: f64,
    /// `int b E`.
    pub value: f64,
    /// `int (int b) O`.
    pub integral: f64,
}

impl Integrals {
    /// Returns these times a factor.
    pub(super) fn scaled(self, factor: f64) -> Self {
        Self {
            curvature: factor * self.curvature,
            slope: factor * self.slope,
            value: factor * self.value,
            integral: factor * self.integral,
        }
    }

    /// Returns the sums.
    pub(super) fn plus(self, other: Self) -> Self {
        Self {
            curvature: self.curvature + other.curvature,
            slope: self.slope + other.slope,
            value: self.value + other.value,
            integral: self.integral + other.integral,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::legendre::rule;

    /// Returns the Legendre polynomial of an order.
    fn legendre(order: usize, x: f64) -> f64 {
        let (mut before, mut value) = (0.0, 1.0);
        for n in 0..order {
            let n = n as f64;
            (before, value) = (
                value,
                ((2.0 * n + 1.0) * x * value - n * before) / (n + 1.0),
            );
        }
        value
    }

    /// Returns the integral of a function over the contact, by Gauss's rule over the root of the
    /// distance from the knot before.
    fn numeric(transform: &Transform, a: f64, of: impl Fn(f64) -> f64) -> f64 {
        let mut ends: Vec<f64> = transform.knots().iter().map(|knot| knot.radius).collect();
        ends.retain(|end| *end > 0.0 && *end < a);
        ends.insert(0, 0.0);
        ends.push(a);
        let on = |pair: &[f64]| -> f64 {
            let length = pair[1] - pair[0];
            let at = |t: f64| {
                let root = 0.5 * (t + 1.0);
                root * length * of(pair[0] + length * root * root)
            };
            let points = rule(9).iter();
            points.map(|&[t, weight]| weight * (at(t) + at(-t))).sum()
        };
        ends.windows(2).map(on).sum()
    }

    fn transforms() -> Vec<Transform> {
        use crate::shape::transform::Knot;
        let knot = |radius: f64, jump: f64, bend: f64| Knot { radius, jump, bend };
        vec![
            Transform::Power {
                factor: 0.7,
                exponent: 2.7,
            },
            Transform::Power {
                factor: 0.7,
                exponent: 1.0,
            },
            Transform::Knots(vec![knot(0.0, 0.4, 0.0)]),
            Transform::Knots(vec![knot(0.3, 0.4, 0.0)]),
            Transform::Knots(
                (0..6)
                    .map(f64::from)
                    .map(|i| knot(0.2 * i, 0.0, 0.3 + 0.1 * i))
                    .collect(),
            ),
        ]
    }

    /// Returns the integrals of a shape times a Legendre polynomial of even and the next odd order.
    fn of_order(curvature: &Curvature, j: usize, a: f64, integral: f64) -> Integrals {
        let mut coefficients = vec![[0.0; 2]; j + 1];
        coefficients[j] = [1.0; 2];
        curvature.integrals(a, integral, &coefficients)
    }

    #[test]
    fn integrals_are_those_of_a_quadrature() {
        let a = 0.9;
        for transform in transforms() {
            let curvature = Curvature::of(&transform).expect("no sphere");
            for j in [0, 1, 2, 7] {
                let own = of_order(&curvature, j, a, transform.integral(a));
                let [even, odd] =
                    [2 * j, 2 * j + 1].map(|order| move |s: f64| legendre(order, s / a));
                let value = numeric(&transform, a, |s| transform.value(s) * even(s));
                let slope = numeric(&transform, a, |s| transform.slope(s) * odd(s));
                let integral = numeric(&transform, a, |s| transform.integral(s) * odd(s));
                for (found, expected) in [
                    (own.value, value),
                    (own.slope, slope),
                    (own.integral, integral),
                ] {
                    assert!(
                        (found - expected).abs() < 1e-8,
                        "{transform:?}, {j}: {found}, not {expected}"
                    );
                }
                // By parts, with the slope of `P_2j` from that of the odd orders below.
                let steepness = |s: f64| -> f64 {
                    let orders = (1..2 * j).step_by(2);
                    let terms = orders.map(|n| (2 * n + 1) as f64 * legendre(n, s / a));
                    terms.sum::<f64>() / a
                };
                let rest = numeric(&transform, a, |s| transform.slope(s) * steepness(s));
                let expected = transform.slope(a) - rest;
                assert!(
                    (own.curvature - expected).abs() < 1e-6,
                    "{transform:?}, {j}: {}, not {expected}",
                    own.curvature
                );
            }
        }
    }

    #[test]
    fn dilated_shapes_are_the_differences_of_larger_and_smaller_ones() {
        let (a, step) = (0.9, 1e-5);
        for transform in transforms() {
            let curvature = Curvature::of(&transform).expect("no sphere");
            for j in [0, 1, 5] {
                let [more, less] = [1.0 + step, 1.0 - step].map(|factor| {
                    let other = transform.in_units_of(1.0 / factor);
                    let curvature = Curvature::of(&other).expect("no sphere");
                    of_order(&curvature, j, a, other.integral(a))
                });
                let integral = 2.0 * transform.integral(a) - a * transform.value(a);
                let own = of_order(&curvature.dilated(), j, a, integral);
                for (found, more, less) in [
                    (own.curvature, more.curvature, less.curvature),
                    (own.slope, more.slope, less.slope),
                    (own.value, more.value, less.value),
                    (own.integral, more.integral, less.integral),
                ] {
                    let expected = (more - less) / (2.0 * step);
                    assert!(
                        (found - expected).abs() < 1e-7 * (1.0 + expected.abs()),
                        "{transform:?}, {j}: {found}, not {expected}"
                    );
                }
            }
        }
    }
}
