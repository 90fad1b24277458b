//! The symbol of the contact's integral equation: `S(q) = 1 + X(q)/e1`, the compliances of sphere
//! and coated substrate together.
//!
//! In units where `S(inf) = 1/es` is 1, `S(0) = es/einf`. Like `X`, `S` is a function of `|q|` on
//! the real line and is continued from the right into `Re q >= 0`.

use interp::Material;

use crate::solve::compliance::{Compliance, WaveNumber};

/// `S(q)/S(inf)` of one contact.
#[derive(Clone, Copy, Debug)]
pub struct Symbol {
    compliance: Compliance,
    /// The compliance of the sphere.
    sphere: f64,
    /// The compliance of the film, `1/e1`.
    film: f64,
}

impl Symbol {
    /// Returns the symbol of `material`.
    pub fn new(material: &Material) -> Self {
        Self {
            compliance: Compliance::new(material),
            sphere: material.sphere_compliance(),
            film: 1.0 / material.film_modulus(),
        }
    }

    /// Returns whether film and substrate are one material in the sense of Dundurs: then the symbol
    /// is 1 everywhere.
    pub fn is_constant(&self) -> bool {
        self.compliance.is_constant()
    }

    /// Returns the symbol of this film and substrate under a softer sphere, which adds `share` of
    /// `S(inf)` to every compliance.
    pub fn softened(self, share: f64) -> Self {
        Self {
            sphere: self.sphere + share / self.modulus(),
            ..self
        }
    }

    /// Returns the compound modulus `es` that scales the symbol to `S(inf) = 1`.
    pub fn modulus(&self) -> f64 {
        1.0 / (self.sphere + self.film)
    }

    /// Returns `S(q)/S(inf)` for `Re q >= 0`, to 14 digits wherever it is not close to a zero.
    pub fn at<T: WaveNumber>(&self, q: T) -> T {
        (self.compliance.x(q) * self.film + self.sphere) * self.modulus()
    }

    /// Returns a wave number, at most 1, below which `S` hardly varies. Needs `S(0) > 0`.
    pub fn smallest_scale(&self) -> f64 {
        self.compliance
            .smallest_scale_of_sum(self.sphere, self.film)
    }

    /// Returns a radius, at most 1, such that `S` has no zero but 0 in the quarter disc within it;
    /// 0 if the radius would be tiny.
    pub fn zero_free_radius(&self) -> f64 {
        self.compliance.zero_free_radius(self.sphere, self.film)
    }
}
