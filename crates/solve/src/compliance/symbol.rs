//! The symbol of the contact's integral equation: the compliances of sphere and coated substrate
//! together, over their value at short waves.
//!
//! ```text
//! S(q) = sphere + film X(q),      sphere = es/E2* = A/(1 + A),      film = es/E1* = 1/(1 + A),      A = E1*/E2*
//! ```
//!
//! `S(inf) = 1` and `S(0) = es/einf`. The shares of sphere and film depend on `A` alone and neither
//! overflow nor cancel for any `A` from 0 (a rigid sphere) to infinity. All quantities but `Delta0`
//! are proportional to `es`, which multiplies them last. Like `X`, `S` is a function of `|q|` on
//! the real line and is continued from the right into `Re q >= 0`.

use std::sync::OnceLock;

use fearless_simd::prelude::*;
use fearless_simd::{Level, dispatch};
use interp::Material;
use num_complex::Complex64;

use crate::compliance::surface::{SurfaceCompliance, filled};
use crate::compliance::zero::{Zero, nearest_zero, zero_free_radius};
use crate::compliance::{Compliance, SWITCH, WaveNumber};

/// `S(q)`, with `S(inf) = 1`, of one contact: of a film on its substrate, or of any other
/// [`SurfaceCompliance`] `C`.
#[derive(Clone, Debug)]
pub struct Symbol<C = Compliance> {
    compliance: C,
    /// The share of the sphere in the compliance at short waves.
    sphere: f64,
    /// The share of the film, `1 - sphere`.
    film: f64,
    /// The compound modulus `es`.
    modulus: f64,
    /// The [`Symbol::zero_free_radius`], found at its first use.
    zero_free_radius: OnceLock<f64>,
    /// The [`Symbol::nearest_zero`], found at its first use.
    nearest_zero: OnceLock<Option<Zero>>,
}

impl<C: SurfaceCompliance> Symbol<C> {
    /// Returns the symbol of `material`, the compliance of whose film and substrate is known. Of a
    /// stack of layers, `material` holds the top layer and the base.
    pub fn with_compliance(compliance: C, material: &Material) -> Self {
        let ratio = material.sphere_compliance() * material.film_modulus();
        Self {
            compliance,
            sphere: 1.0 / (1.0 + 1.0 / ratio),
            film: 1.0 / (1.0 + ratio),
            modulus: material.sphere_film_modulus(),
            zero_free_radius: OnceLock::new(),
            nearest_zero: OnceLock::new(),
        }
    }

    /// Returns the compliance of film and substrate, without the sphere.
    pub fn compliance(&self) -> &C {
        &self.compliance
    }

    /// Returns the share of the film in the compliance at short waves, `es/E1*`.
    pub fn film(&self) -> f64 {
        self.film
    }

    /// Returns `S(q)` for a real `q >= 0`, to a few rounding units of `max(S, 1)`.
    pub fn value(&self, q: f64) -> f64 {
        1.0 + self.film * self.compliance.sample(q).excess
    }

    /// Returns a bound of `|S - 1|`: 0 where film and substrate are one material in the sense of
    /// Dundurs, and tiny under a sphere that is much softer than both.
    pub fn contrast(&self) -> f64 {
        self.film * self.compliance.largest_excess()
    }

    /// Returns the compound modulus `es`.
    pub fn modulus(&self) -> f64 {
        self.modulus
    }
}

impl Symbol {
    /// Returns the symbol of `material`.
    pub fn new(material: &Material) -> Self {
        Self::with_compliance(Compliance::new(material), material)
    }

    /// Returns the symbol of this film and substrate under a softer sphere, which adds `share` of
    /// `S(inf)` to every compliance.
    pub fn softened(&self, share: f64) -> Self {
        let whole = 1.0 + share;
        Self {
            sphere: (self.sphere + share) / whole,
            film: self.film / whole,
            modulus: self.modulus / whole,
            compliance: self.compliance,
            zero_free_radius: OnceLock::new(),
            nearest_zero: OnceLock::new(),
        }
    }

    /// Returns `S(q)` for `Re q >= 0`, to 14 digits wherever it is not close to a zero.
    pub fn at<T: WaveNumber>(&self, q: T) -> T {
        self.compliance.x(q) * self.film + self.sphere
    }

    /// Returns `S` at all these `q >= 0`, as [`Symbol::at`].
    pub fn at_all(&self, q: &[f64]) -> Vec<f64> {
        let mut values = Vec::with_capacity(q.len());
        dispatch!(Level::new(), simd => self.extend(simd, q, &mut values));
        values
    }

    #[inline(always)]
    fn extend<S: Simd>(&self, simd: S, q: &[f64], values: &mut Vec<f64>) {
        for group in q.chunks(S::f64s::LEN) {
            let x = self.compliance.x_of_group(simd, filled(simd, group));
            let s = x * self.film + self.sphere;
            values.extend_from_slice(&s.as_slice()[..group.len()]);
        }
    }

    /// Returns the imaginary parts of `1/S` on the right side of the imaginary axis, at `i p` for all
    /// these `p > 0`.
    pub fn inverses_on_axis(&self, p: &[f64]) -> Vec<f64> {
        let mut values = Vec::with_capacity(p.len());
        dispatch!(Level::new(), simd => self.extend_inverses(simd, p, &mut values));
        values
    }

    #[inline(always)]
    fn extend_inverses<S: Simd>(&self, simd: S, p: &[f64], values: &mut Vec<f64>) {
        for group in p.chunks(S::f64s::LEN) {
            if group.iter().any(|&p| p > SWITCH) {
                let inverse = |&p: &f64| 1.0 / self.at(Complex64::new(0.0, p));
                values.extend(group.iter().map(|p| inverse(p).im));
                continue;
            }
            // `1/S = D/(sphere D + film N)`, whose imaginary part has no term with the sphere: such
            // terms would cancel.
            let [n, d] = self.compliance.fraction_on_axis(filled(simd, group));
            let [re, im] = [0, 1].map(|part| d[part] * self.sphere + n[part] * self.film);
            let cross = (d[1] * n[0] - d[0] * n[1]) * self.film;
            let inverse = cross / (re * re + im * im);
            values.extend_from_slice(&inverse.as_slice()[..group.len()]);
        }
    }

    /// Returns a wave number, at most 1, below which `S` hardly varies. Needs `S(0) > 0`.
    pub fn smallest_scale(&self) -> f64 {
        self.compliance
            .smallest_scale_of_sum(self.sphere, self.film)
    }

    /// Returns a radius, at most 1, such that `S` has no zero but 0 in the quarter disc within it;
    /// 0 if the radius would be tiny.
    pub fn zero_free_radius(&self) -> f64 {
        let find = || zero_free_radius(&self.compliance, self.sphere, self.film);
        *self.zero_free_radius.get_or_init(find)
    }

    /// Returns the only zero of `S` in the first quadrant within [`REACH`](crate::compliance::zero::REACH), if it is
    /// found.
    pub fn nearest_zero(&self) -> Option<Zero> {
        let free = self.zero_free_radius();
        let find = || nearest_zero(&self.compliance, self.sphere, self.film, free);
        *self.nearest_zero.get_or_init(find)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::estimate::larger;

    /// Symbols of films and spheres of all stiffnesses.
    fn symbols() -> impl Iterator<Item = Symbol> {
        let moduli = [0.0, 1e-6, 1.0, 1e6];
        let films = moduli
            .into_iter()
            .flat_map(|e1| [0.0, 0.3, 0.5].map(|nu1| (e1, nu1)));
        films.flat_map(|(e1, nu1)| {
            [1e-6, 1.0, 1e6, f64::INFINITY].map(|e0| {
                let material = Material::new(e1, nu1, e0, 0.25).expect("physical");
                Symbol::new(&material)
            })
        })
    }

    /// Wave numbers on both sides of the switch of the two forms, in groups that are not full.
    fn wave_numbers() -> Vec<f64> {
        (0..=60).map(|i| 24.0 * 1.4_f64.powi(-i)).collect()
    }

    #[test]
    fn values_at_several_wave_numbers_are_those_at_each() {
        let q = wave_numbers();
        let mut worst = 0.0;
        for symbol in symbols() {
            for (&q, value) in q.iter().zip(symbol.at_all(&q)) {
                worst = larger(worst, (value / symbol.at(q) - 1.0).abs());
            }
        }
        println!("S at several wave numbers: {worst:.1e}");
        // Measured: 0.
        assert!(worst < 1e-15);
    }

    #[test]
    fn inverses_on_the_axis_are_those_of_the_complex_symbol() {
        let p = wave_numbers();
        let mut worst = 0.0;
        for symbol in symbols() {
            for (&p, value) in p.iter().zip(symbol.inverses_on_axis(&p)) {
                let inverse = 1.0 / symbol.at(Complex64::new(0.0, p));
                worst = larger(worst, (value - inverse.im).abs() / inverse.norm());
            }
        }
        println!("1/S on the axis: {worst:.1e}");
        // Measured: 6.2e-16.
        assert!(worst < 2e-15);
    }
}
