//! The symbol of the contact's integral equation: `S(q) = 1 + X(q)/e1`, the compliances of sphere
//! and coated substrate together.
//!
//! In units where `S(inf) = 1/es` is 1, `S(0) = es/einf`. Like `X`, it is a function of `|q|` on
//! the real line and is continued from the right into `Re q >= 0`. Its zeros and poles there were
//! found to lie more than 53 degrees off the real axis, for all materials; a test looks for them.

use interp::Material;

use crate::solve::compliance::{Compliance, WaveNumber};

/// `S(q)/S(inf)` of one contact.
#[derive(Clone, Copy, Debug)]
pub struct Symbol {
    compliance: Compliance,
    sphere: f64,
    film: f64,
}

impl Symbol {
    /// The symbol of the material.
    pub fn new(material: &Material) -> Self {
        Self {
            compliance: Compliance::new(material),
            sphere: material.sphere_compliance(),
            film: 1.0 / material.film_modulus(),
        }
    }

    /// Film and substrate are one and the same material, in the sense of Dundurs.
    pub fn is_constant(&self) -> bool {
        self.compliance.is_homogeneous()
    }

    /// The symbol of the same film and substrate under a softer sphere, which adds `share` of
    /// `S(inf)` to every compliance.
    pub fn softened(self, share: f64) -> Self {
        Self {
            sphere: self.sphere + share / self.modulus(),
            ..self
        }
    }

    /// The compound modulus `es` that the symbol is divided by.
    pub fn modulus(&self) -> f64 {
        1.0 / (self.sphere + self.film)
    }

    /// `S(q)/S(inf)` for `Re q >= 0`, to 14 digits wherever it is not close to a zero.
    pub fn at<T: WaveNumber>(&self, q: T) -> T {
        (self.compliance.continued(q) * self.film + self.sphere) * self.modulus()
    }

    /// Numerator and denominator: the coefficients of `1`, `q`, `q^2`, `q^3`.
    fn leading(&self) -> [[f64; 4]; 2] {
        let [n, d] = self.compliance.leading();
        [
            std::array::from_fn(|i| self.sphere * d[i] + self.film * n[i]),
            d,
        ]
    }

    /// A wave number below which `S` hardly varies: there numerator and denominator keep close to
    /// their values at 0. Needs `S(0) > 0`.
    pub fn smallest_scale(&self) -> f64 {
        let scale = |[value, rest @ ..]: [f64; 4]| {
            let reach = |(power, coefficient): (usize, f64)| {
                (value / coefficient.abs()).powf(1.0 / (power + 1) as f64)
            };
            rest.into_iter().enumerate().map(reach).fold(1.0, f64::min)
        };
        let [numerator, denominator] = self.leading().map(scale);
        numerator.min(denominator)
    }

    /// A radius such that `S` has no zero but 0 in the quarter disc within it, at most 1; 0 if that
    /// is tiny.
    pub fn zero_free_radius(&self) -> f64 {
        if self.is_zero_free(1.0) {
            return 1.0;
        }
        const LEAST: f64 = 1e-9;
        let (mut free, mut beyond): (f64, f64) = (LEAST, 1.0);
        if !self.is_zero_free(free) {
            return 0.0;
        }
        // To 1 %.
        while beyond > 1.01 * free {
            let middle = (free * beyond).sqrt();
            if self.is_zero_free(middle) {
                free = middle
            } else {
                beyond = middle
            }
        }
        free
    }

    /// Whether it is certain that `S` has no zero with `0 < |q| <= radius <= 1` in the quarter
    /// plane.
    ///
    /// The numerator is `c + d q` and higher powers with positive coefficients. Their sum is at
    /// most what it is on the real axis, and `|c + d q|` at least what it is on the imaginary axis,
    /// or if `d < 0` on the real one. As the higher powers fall faster towards 0, a comparison at
    /// `radius` holds for all `q` within.
    fn is_zero_free(&self, radius: f64) -> bool {
        let [n, d] = self.compliance.fraction(radius);
        let [[value, slope, ..], _] = self.leading();
        let rest = self.sphere * d + self.film * n - value - slope * radius;
        let linear = if slope >= 0.0 {
            value.hypot(slope * radius)
        } else {
            value + slope * radius
        };
        linear > rest
    }
}

/// The sine of an angle, 52 degrees, that no zero and no pole of `S` lies below.
pub const HEIGHT: f64 = 0.788;

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, PI};

    use num_complex::Complex64;
    use rand::{RngExt, SeedableRng};
    use rand_pcg::Pcg64Mcg;

    use super::*;
    use crate::solve::solve::{E0_OVER_E2, E1_OVER_E2};

    /// How often a function winds around 0 along the boundary of the sector `arg q <= angle`,
    /// `inner <= |q| <= outer`.
    fn winding(
        function: impl Fn(Complex64) -> Complex64,
        angle: f64,
        inner: f64,
        outer: f64,
    ) -> f64 {
        const STEPS: usize = 4000;
        let ray = |angle: f64| {
            move |t: f64| Complex64::from_polar(inner * (outer / inner).powf(t), angle)
        };
        let arc = |radius: f64| move |t: f64| Complex64::from_polar(radius, angle * t);
        let turned = |from: Complex64, to: Complex64| (function(to) / function(from)).arg();
        let along = |path: &dyn Fn(f64) -> Complex64| -> f64 {
            (0..STEPS)
                .map(|i| {
                    turned(
                        path(i as f64 / STEPS as f64),
                        path((i + 1) as f64 / STEPS as f64),
                    )
                })
                .sum()
        };
        (along(&ray(0.0)) + along(&arc(outer)) - along(&ray(angle)) - along(&arc(inner)))
            / (2.0 * PI)
    }

    /// Any material of the solve's domain, its ends included.
    fn random_symbol(random: &mut Pcg64Mcg) -> Symbol {
        let mut log_uniform = |[from, to]: [f64; 2], special: f64| match random.random_range(0..10)
        {
            0 => special,
            1 => from,
            2 => to,
            _ => random.random_range(from.ln()..to.ln()).exp(),
        };
        let (e1, e0) = (
            log_uniform(E1_OVER_E2, 0.0),
            log_uniform(E0_OVER_E2, f64::INFINITY),
        );
        let mut nu = || {
            if random.random_bool(0.3) {
                0.5
            } else {
                random.random_range(-0.99..0.5)
            }
        };
        Symbol::new(&Material::new(e1, nu(), e0, nu()).expect("physical"))
    }

    /// What the ray of the Wiener-Hopf method relies on.
    #[test]
    fn zeros_and_poles_lie_above_53_degrees() {
        let mut random = Pcg64Mcg::seed_from_u64(1);
        for _ in 0..1000 {
            let symbol = random_symbol(&mut random);
            let inner = 1e-3 * symbol.smallest_scale().max(1e-20);
            let turns = winding(|q| symbol.at(q), 53.0 * PI / 180.0, inner, 12.0);
            assert!(turns.abs() < 1e-6, "{turns} turns: {symbol:?}");
        }
    }

    /// What the imaginary axis relies on: where no zero is promised, there is none.
    #[test]
    fn a_zero_free_disc_has_no_zeros() {
        let mut random = Pcg64Mcg::seed_from_u64(2);
        let mut free = 0;
        for _ in 0..1000 {
            let symbol = random_symbol(&mut random);
            let radius = symbol.zero_free_radius();
            if radius > 1e-6 {
                free += 1;
                let numerator = |q: Complex64| {
                    let [n, d] = symbol.compliance.fraction(q);
                    n * symbol.film + d * symbol.sphere
                };
                let turns = winding(numerator, FRAC_PI_2, 1e-3 * radius, radius);
                assert!(
                    turns.abs() < 1e-6,
                    "{turns} turns within {radius}: {symbol:?}"
                );
            }
        }
        println!("{free} symbols of 1000 have discs without a zero");
        // Measured: 904.
        assert!(free > 500);
    }
}
