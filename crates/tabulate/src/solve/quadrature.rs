//! Gauss-Legendre quadrature over the wave number, on panels that follow the integrand.
//!
//! The integrand is `X(q) - 1` times a product of two spherical Bessel functions of `z = q a/t`.
//! Three lengths matter:
//!
//! * `X` is analytic but for poles that lie more than 50 degrees off the real axis, the nearest at
//!   `|q| ~ s`
//!   ([`Compliance::smallest_scale`](crate::solve::compliance::Compliance::smallest_scale)). On a
//!   panel `[c, 4c]` an `n`-point rule therefore converges like `2.5^{-2n}`: panels grow
//!   geometrically from `[0, s]`.
//! * The Bessel product oscillates like `cos 2z`. An `n`-point rule on a panel `w` long in `z` has
//!   an error of about `(e w / (4 n))^{2n}`, which bounds the width.
//! * `X - 1` dies out like `q^2 e^{-2q}`: the last panel ends where what is left out is below the
//!   tolerance.

use std::f64::consts::{E, PI};
use std::sync::LazyLock;

/// An `n`-point Gauss-Legendre rule on `[-1, 1]`, exact to degree `2n - 1`.
#[derive(Clone, Debug)]
pub struct GaussLegendre {
    /// The abscissae, ascending.
    pub abscissae: Vec<f64>,
    /// The weights.
    pub weights: Vec<f64>,
    /// What a function's values are multiplied with and summed to its Legendre coefficients of
    /// degree `n - 8` to `n - 1`; where `n < 8`, of those from 0 on.
    pub coefficients: [Vec<f64>; 8],
}

impl GaussLegendre {
    /// Newton's method on `P_n` from Tricomi's initial guess; abscissae and weights to a few
    /// rounding units for `n <= 1024`.
    pub fn new(n: usize) -> Self {
        let mut rule = Self {
            abscissae: vec![0.0; n],
            weights: vec![0.0; n],
            coefficients: Default::default(),
        };
        for i in 0..n.div_ceil(2) {
            let mut x = (PI * (i as f64 + 0.75) / (n as f64 + 0.5)).cos();
            let mut slope = 0.0;
            for _ in 0..6 {
                let (value, previous) = legendre(n, x);
                slope = n as f64 * (previous - x * value) / (1.0 - x * x);
                x -= value / slope;
            }
            if 2 * i + 1 == n {
                x = 0.0;
            }
            let weight = 2.0 / ((1.0 - x * x) * slope * slope);
            (rule.abscissae[i], rule.abscissae[n - 1 - i]) = (-x, x);
            (rule.weights[i], rule.weights[n - 1 - i]) = (weight, weight);
        }
        rule.coefficients = std::array::from_fn(|k| {
            let degree = (n + k).saturating_sub(8);
            let coefficient =
                |(&x, &w): (&f64, &f64)| (degree as f64 + 0.5) * w * legendre(degree, x).0;
            rule.abscissae
                .iter()
                .zip(&rule.weights)
                .map(coefficient)
                .collect()
        });
        rule
    }
}

/// `P_n(x)` and `P_{n-1}(x)`.
fn legendre(n: usize, x: f64) -> (f64, f64) {
    let (mut previous, mut value) = (0.0, 1.0);
    for k in 0..n {
        let k = k as f64;
        (previous, value) = (
            value,
            ((2.0 * k + 1.0) * x * value - k * previous) / (k + 1.0),
        );
    }
    (value, previous)
}

/// The panels in `q` for one `a/t`, and the rule on each of them.
#[derive(Clone, Debug)]
pub struct Panels {
    /// Ends of the panels, ascending from 0.
    pub edges: Vec<f64>,
    /// The rule that serves every panel.
    pub rule: &'static GaussLegendre,
    /// What the cut-off and the panels' width may cost of `g.C.g`, relative to `g(1)^2`.
    pub design_error: f64,
}

/// Rules of 16, 20, 24 and 32 points.
static RULES: LazyLock<[GaussLegendre; 4]> =
    LazyLock::new(|| [16, 20, 24, 32].map(GaussLegendre::new));

/// A panel at most this many times its lower end long keeps the poles of `X` outside the ellipse of
/// convergence 2.5.
const GROWTH: f64 = 3.0;

/// The last panel may be this much longer.
const STRETCH: f64 = 1.1;

/// The part of the tolerance that the cut-off and the panels' width are each designed to keep.
const SHARE: f64 = 0.1;

impl Panels {
    /// Panels for `x = a/t`, for compliances that vary on no scale below `smallest_scale`, to the
    /// relative accuracy `tolerance`.
    pub fn new(x: f64, smallest_scale: f64, tolerance: f64) -> Self {
        // Many points a panel are economical where the oscillation rules, few where poles and decay
        // do.
        let rule = &RULES[match tolerance {
            _ if x > 5.0 => 3,
            1e-6.. => 0,
            3e-11.. => 1,
            _ => 2,
        }];
        let n = rule.abscissae.len() as f64;
        // `e^{-2q}` asks for as much as an oscillation at `x = 1`.
        let width = 4.0 * n / E * (SHARE * tolerance).powf(0.5 / n) / (1.0 + x * x).sqrt();
        let end = cutoff(x, SHARE * tolerance);
        let mut edges = vec![0.0];
        let mut last = 0.0;
        while last < end {
            let length = if last == 0.0 {
                smallest_scale
            } else {
                GROWTH * last
            };
            // A panel more for a little more range is not worth its points.
            let length = if last + STRETCH * length >= end {
                end - last
            } else {
                length
            };
            last = (last + length.min(width)).min(end);
            edges.push(last);
        }
        Self {
            edges,
            rule,
            design_error: 2.0 * SHARE * tolerance,
        }
    }
}

/// Where the integral may end for an error of at most `tolerance`.
///
/// There `q X'` is the larger symbol, at most `28 q^3 e^{-2q}` as `|b| <= 1` and `|a| <= 7`. It
/// comes times `a/t` where the Bessel product has not begun to decay and times `x/z^2` where it
/// has.
fn cutoff(x: f64, tolerance: f64) -> f64 {
    let mut q: f64 = 4.0;
    while 28.0 * q.powi(3) * (-2.0 * q).exp() * x / (1.0 + x * x * q * q) > tolerance {
        q += 0.25;
    }
    q
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `int cos(kx) = 2 sin(k)/k` and `int x^2 = 2/3` over `[-1, 1]`. Measured: 3e-16.
    #[test]
    fn rules_of_all_sizes_integrate_to_rounding() {
        for (n, k) in [
            (4, 0.1),
            (8, 1.0),
            (64, 50.0),
            (256, 200.0),
            (1024, 900.0_f64),
        ] {
            let rule = GaussLegendre::new(n);
            let integral = |f: &dyn Fn(f64) -> f64| {
                rule.abscissae
                    .iter()
                    .zip(&rule.weights)
                    .map(|(&x, w)| w * f(x))
                    .sum::<f64>()
            };
            let errors = [
                integral(&|x| (k * x).cos()) - 2.0 * k.sin() / k,
                integral(&|x| x * x) - 2.0 / 3.0,
            ];
            println!("{n}: {errors:?}");
            assert!(
                errors.iter().all(|error| error.abs() <= 2e-14),
                "{n}: {errors:?}"
            );
        }
    }
}
