//! Integrals over the annulus `a < s < c` in which the attraction acts, without cancellation for a
//! thin annulus.
//!
//! With `a = c cos(phi)`,
//!
//! ```text
//! H(q) = int_a^c sqrt(c^2 - s^2) cos(qs) ds            P(q) = int_a^c [cos(qs) - cos(qa)]/sqrt(c^2 - s^2) ds
//! ```
//!
//! For a thin annulus, `s = c cos(psi)` and Gauss-Legendre quadrature in `psi`, with `s - a = 2c
//! sin((phi+psi)/2) sin((phi-psi)/2)` and the sine and `1 - cos` of `q (s - a)`. For a wide one,
//! the integrals over the whole disc, `(pi c/2q) J1(qc)` and `(pi/2) J0(qc)`, less those over the
//! contact, where the roots have rapidly converging series in Legendre polynomials.

use std::f64::consts::FRAC_PI_2;

use interp::once::{Lazy, Once};

use crate::cohesive::waves;
use crate::galerkin::bessel::LANES;
use crate::galerkin::quadrature::{GaussLegendre, legendre};
use crate::galerkin::sine::sine_and_versine;

/// The `c/a` from which on an annulus is wide.
pub const WIDE: f64 = 1.3;

/// The number of Legendre polynomials for the roots over the contact of a wide annulus: they leave
/// 1e-16 at `c/a = 1.3`.
pub const TERMS: usize = 24;

/// An annulus.
#[derive(Clone, Copy, Debug)]
pub struct Annulus {
    /// The inner radius `a`.
    pub inner: f64,
    /// The outer radius `c = a/cos(phi)`.
    pub outer: f64,
    /// `phi`.
    pub angle: f64,
}

impl Annulus {
    /// Returns the annulus of an inner radius and `tan(phi)`.
    pub fn new(inner: f64, tangent: f64) -> Self {
        Self {
            inner,
            outer: inner * tangent.hypot(1.0),
            angle: tangent.atan(),
        }
    }

    /// Returns `sqrt(c^2 - a^2)`.
    pub fn root(&self) -> f64 {
        self.inner * self.angle.tan()
    }

    /// Returns `tan(phi) - phi`.
    fn excess_of_tangent(&self) -> f64 {
        let phi = self.angle;
        if phi > 0.3 {
            return phi.tan() - phi;
        }
        // phi^3/3 + 2 phi^5/15 + ...
        const SERIES: [f64; 9] = [
            1.0 / 3.0,
            2.0 / 15.0,
            17.0 / 315.0,
            62.0 / 2835.0,
            1382.0 / 155_925.0,
            21844.0 / 6_081_075.0,
            929_569.0 / 638_512_875.0,
            6_404_582.0 / 10_854_718_875.0,
            443_861_162.0 / 1_856_156_927_625.0,
        ];
        let square = phi * phi;
        phi * square * SERIES.iter().rev().fold(0.0, |sum, c| sum * square + c)
    }

    /// Returns `int_a^c sqrt(c^2 - s^2) ds`.
    pub fn area(&self) -> f64 {
        let tangent = self.angle.tan();
        0.5 * self.inner * self.inner * (self.angle * tangent * tangent - self.excess_of_tangent())
    }

    /// Returns `int_a^c (s^2 - a^2)/sqrt(c^2 - s^2) ds`: the gap that the paraboloid opens.
    pub fn opening_of_paraboloid(&self) -> f64 {
        let tangent = self.angle.tan();
        0.5 * self.inner * self.inner * (self.angle * tangent * tangent + self.excess_of_tangent())
    }

    /// Returns `int_a^c [r - sqrt(c^2 - s^2)]/sqrt(c^2 - s^2) ds`, `r` the [`Annulus::root`]: the gap
    /// that the traction opens at short waves.
    pub fn opening_of_traction(&self) -> f64 {
        let half = (0.5 * self.angle).sin();
        self.inner * (self.angle * self.angle.tan() - 2.0 * half * half / self.angle.cos())
    }

    /// Returns `H` and `P` at the wave numbers `q`, which ascend in groups of [`LANES`].
    /// `bessel(n)` holds the transforms of the first [`TERMS`] even Legendre functions at `q a`,
    /// which a wide annulus needs.
    pub fn transforms<'a>(
        &self,
        q: &[f64],
        bessel: impl Fn(usize) -> &'a [f64],
    ) -> (Vec<f64>, Vec<f64>) {
        if q.is_empty() {
            (Vec::new(), Vec::new())
        } else if self.outer < WIDE * self.inner {
            self.thin_transforms(q)
        } else {
            self.wide_transforms(q, bessel)
        }
    }

    /// With `theta = q (s - a)`,
    ///
    /// ```text
    /// H = int (c sin psi)^2 cos(qa + theta) d psi
    /// P = -int [cos(qa) (1 - cos theta) + sin(qa) sin theta] d psi
    /// ```
    fn thin_transforms(&self, q: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let Self {
            inner,
            outer,
            angle,
        } = *self;
        let width = outer * 2.0 * (0.5 * angle).sin().powi(2);
        // `s - a`, and the weights of both integrals.
        let points_of = |rule: &GaussLegendre| -> Vec<[f64; 3]> {
            let point = |(t, w): (&f64, &f64)| {
                let psi = 0.5 * angle * (1.0 + t);
                let weight = 0.5 * angle * w;
                let height = outer * psi.sin();
                let beyond =
                    2.0 * outer * (0.5 * (angle + psi)).sin() * (0.5 * (angle - psi)).sin();
                [beyond, weight * height * height, weight]
            };
            rule.abscissae
                .iter()
                .zip(&rule.weights)
                .map(point)
                .collect()
        };
        let (mut h, mut p) = (vec![0.0; q.len()], vec![0.0; q.len()]);
        let groups = h.chunks_exact_mut(LANES).zip(p.chunks_exact_mut(LANES));
        let mut points: Vec<[f64; 3]> = Vec::new();
        for (q, (h, p)) in q.chunks_exact(LANES).zip(groups) {
            let rule = rule(14 + (0.5 * q[LANES - 1] * width).ceil() as usize);
            if rule.abscissae.len() != points.len() {
                points = points_of(rule);
            }
            let [mut even, mut odd, mut versines, mut sines] = [[0.0; LANES]; 4];
            let mut total = 0.0;
            for &[beyond, area, weight] in &points {
                total += area;
                for l in 0..LANES {
                    let [sine, versine] = sine_and_versine(q[l] * beyond);
                    even[l] += area * versine;
                    odd[l] += area * sine;
                    versines[l] += weight * versine;
                    sines[l] += weight * sine;
                }
            }
            for l in 0..LANES {
                let [sine, versine] = sine_and_versine(q[l] * inner);
                let cosine = 1.0 - versine;
                h[l] = cosine * (total - even[l]) - sine * odd[l];
                p[l] = -(cosine * versines[l] + sine * sines[l]);
            }
        }
        (h, p)
    }

    fn wide_transforms<'a>(
        &self,
        q: &[f64],
        bessel: impl Fn(usize) -> &'a [f64],
    ) -> (Vec<f64>, Vec<f64>) {
        let Self {
            inner,
            outer,
            angle,
        } = *self;
        let (mut h, mut p) = (vec![0.0; q.len()], vec![0.0; q.len()]);
        let groups = h.chunks_exact_mut(LANES).zip(p.chunks_exact_mut(LANES));
        for (q, (h, p)) in q.chunks_exact(LANES).zip(groups) {
            let [j0, j1] = waves::bessel(&std::array::from_fn(|l| q[l] * outer));
            for l in 0..LANES {
                let [_, versine] = sine_and_versine(q[l] * inner);
                h[l] = FRAC_PI_2 * outer / q[l] * j1[l];
                p[l] = FRAC_PI_2 * j0[l] - angle * (1.0 - versine);
            }
        }
        for (n, [root, inverse]) in self.roots_over_contact().into_iter().enumerate() {
            for ((h, p), j) in h.iter_mut().zip(&mut p).zip(bessel(n)) {
                *h -= inner * root * j;
                *p -= inner * inverse * j;
            }
        }
        (h, p)
    }

    /// Returns the Legendre coefficients of `sqrt(c^2 - s^2)` and of its inverse over the contact.
    fn roots_over_contact(&self) -> [[f64; 2]; TERMS] {
        static BASIS: Lazy<Vec<[f64; TERMS]>> = Lazy::new(|| {
            let values = |t: &f64| {
                let mut even = legendre(0.5 * (1.0 + t)).step_by(2);
                let mut value = || even.next().expect("there is one of each degree");
                std::array::from_fn(|n| ((4 * n + 1) as f64).sqrt() * value())
            };
            rule(64).abscissae.iter().map(values).collect()
        });
        let rule = rule(64);
        let mut coefficients = [[0.0; 2]; TERMS];
        for ((t, w), basis) in rule.abscissae.iter().zip(&rule.weights).zip(BASIS.iter()) {
            let s = 0.5 * self.inner * (1.0 + t);
            let root = ((self.outer - s) * (self.outer + s)).sqrt();
            for (coefficient, phi) in coefficients.iter_mut().zip(basis) {
                coefficient[0] += 0.5 * w * phi * root;
                coefficient[1] += 0.5 * w * phi / root;
            }
        }
        coefficients
    }
}

/// The numbers of points for which rules are kept.
const STEP: usize = 4;

/// Returns a rule of at least `points` points.
pub fn rule(points: usize) -> &'static GaussLegendre {
    static RULES: [Once<GaussLegendre>; 256] = [const { Once::new() }; 256];
    let n = points.div_ceil(STEP).clamp(1, RULES.len());
    RULES[n - 1].get_or_init(|| GaussLegendre::new(STEP * n))
}
