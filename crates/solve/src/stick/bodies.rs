//! What sphere and surface are made of, and how they couple pressure and shear.

use std::f64::consts::PI;

use interp::Material;

use crate::compliance::layered::LayeredCompliance;
use crate::stick::coulomb::c0;

/// Values of `|beta|` up to this one are taken for 0.
pub const NO_COUPLING: f64 = 1e-12;

/// The sphere and the surface that it touches.
#[derive(Clone, Debug)]
pub struct Bodies {
    /// Film and substrate, or a stack of layers.
    pub surface: LayeredCompliance,
    /// The share of the film in the compliance of short waves, `es/E1*`.
    pub film: f64,
    /// The share of the sphere, `es/E2*`.
    pub sphere: f64,
    /// The compound modulus `es`.
    pub modulus: f64,
    /// Dundurs' `beta = es (b1/e1 - b2)` of sphere and top layer; exactly 0 up to [`NO_COUPLING`].
    pub beta: f64,
    /// `eps`, of `tanh(pi eps) = beta`.
    pub eps: f64,
    /// Whether shear tractions act; without them the contact is frictionless.
    pub sticks: bool,
}

impl Bodies {
    /// Joins a `surface` with the sphere of `material`, of Poisson ratio `nu2`. Of a stack,
    /// `material` holds the top layer and the base.
    pub fn new(surface: LayeredCompliance, material: &Material, nu2: f64) -> Self {
        let ratio = material.sphere_compliance() * material.film_modulus();
        let (sphere, film) = (1.0 / (1.0 + 1.0 / ratio), 1.0 / (1.0 + ratio));
        let beta = film * coupling(material.nu1()) - sphere * coupling(nu2);
        let beta = if beta.abs() <= NO_COUPLING { 0.0 } else { beta };
        Self {
            surface,
            film,
            sphere,
            modulus: material.sphere_film_modulus(),
            beta,
            eps: beta.atanh() / PI,
            sticks: true,
        }
    }

    /// Returns the same bodies without friction.
    pub fn without_friction(self) -> Self {
        Self {
            beta: 0.0,
            eps: 0.0,
            sticks: false,
            ..self
        }
    }

    /// Returns `cosh(pi eps)`.
    pub fn cosh(&self) -> f64 {
        (PI * self.eps).cosh()
    }

    /// Returns `(pi eps/sinh(pi eps))^{1/2}`.
    pub fn c0(&self) -> f64 {
        c0(self.eps)
    }
}

/// Returns `b = (1 - 2 nu)/(2 (1 - nu))`.
fn coupling(nu: f64) -> f64 {
    (1.0 - 2.0 * nu) / (2.0 * (1.0 - nu))
}
