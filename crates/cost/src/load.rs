//! The two terms of the load of eq. 9 at a contact radius.

use interp::{Material, Quantities};

/// The terms, each up to a factor that is equal for all contacts that are compared.
#[derive(Clone, Copy, Debug)]
pub struct Load {
    /// `U Pi0`, with the modulus `U` that normalises the quantities: the load without adhesion.
    pub press: f64,
    /// `(U es)^{1/2} Eeq/Gamma`: the adhesive part of the load.
    pub pull: f64,
}

impl Load {
    /// Returns the load of the quantities of a contact, whose modulus `U` is `unit`.
    pub fn new(q: &Quantities, material: &Material, unit: f64) -> Self {
        Self {
            press: unit * q.pi0,
            pull: (unit * material.sphere_film_modulus()).sqrt() * q.eeq / q.gamma,
        }
    }

    /// Returns the load by JKR on a half-space, whose modulus is also that at the crack tip.
    pub fn of_half_space(modulus: f64) -> Self {
        Self {
            press: Quantities::homogeneous(modulus).pi0,
            pull: modulus.sqrt(),
        }
    }
}
