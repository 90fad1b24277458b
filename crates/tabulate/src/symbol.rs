//! The symbol of the contact's integral equation: `S(q) = 1 + X(q)/e1`, the compliances of sphere and coated substrate together.
//!
//! In units where `S(inf) = 1/es` is 1, `S(0) = es/einf`. Like `X`, it is a function of `|q|` on the real line and is continued from the
//! right into `Re q >= 0`. Its zeros and poles there were found to lie more than 53 degrees off the real axis, for all materials.

use interp::Material;

use crate::compliance::{Compliance, WaveNumber};

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
        Self { compliance: Compliance::new(material), sphere: material.sphere_compliance(), film: 1.0 / material.film_modulus() }
    }

    /// Film and substrate are one and the same material, in the sense of Dundurs.
    pub fn is_constant(&self) -> bool {
        self.compliance.is_homogeneous()
    }

    /// The symbol of the same film and substrate under a softer sphere, which adds `share` of `S(inf)` to every compliance.
    pub fn softened(self, share: f64) -> Self {
        Self { sphere: self.sphere + share / self.modulus(), ..self }
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
        [std::array::from_fn(|i| self.sphere * d[i] + self.film * n[i]), d]
    }

    /// A wave number below which `S` hardly varies: there numerator and denominator keep close to their values at 0. Needs `S(0) > 0`.
    pub fn smallest_scale(&self) -> f64 {
        let scale = |[value, rest @ ..]: [f64; 4]| {
            let reach = |(power, coefficient): (usize, f64)| (value / coefficient.abs()).powf(1.0 / (power + 1) as f64);
            rest.into_iter().enumerate().map(reach).fold(1.0, f64::min)
        };
        let [numerator, denominator] = self.leading().map(scale);
        numerator.min(denominator)
    }

    /// Whether it is certain that `S` has no zero in the quarter disc `|q| <= radius`.
    ///
    /// The numerator is `c + d q` plus powers with positive coefficients, which are largest on the real axis, whereas `|c + d q|` is at
    /// least what is compared with them (Rouche).
    pub fn is_zero_free(&self, radius: f64) -> bool {
        if radius > 1.0 {
            return false;
        }
        let [n, d] = self.compliance.fraction(radius);
        let [[value, slope, ..], _] = self.leading();
        let rest = self.sphere * d + self.film * n - value - slope * radius;
        let linear = if slope >= 0.0 { value.hypot(slope * radius) } else { value + slope * radius };
        linear > rest
    }
}
