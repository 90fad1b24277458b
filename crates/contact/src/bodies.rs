//! The bodies in contact, with the curve of their material.

use interp::{Curve, HalfSpace, System};

/// The bodies in contact.
#[derive(Clone, Debug)]
pub(crate) enum Bodies {
    /// A probe on a homogeneous half-space.
    HalfSpace(HalfSpace),
    /// A probe on a coated substrate, with the curve of its material.
    Coated {
        system: System,
        /// Whether the curve has derivatives with respect to the material of the system itself.
        differentiated: bool,
        curve: Curve,
    },
}

impl Bodies {
    /// Returns whether these are the `own` bodies with a rigid probe and a rigid base.
    pub(crate) fn are_rigid_beside(&self, own: &Self) -> bool {
        match (self, own) {
            (Self::HalfSpace(rigid), Self::HalfSpace(own)) => {
                *rigid
                    == HalfSpace {
                        sphere_modulus: f64::INFINITY,
                        ..own.clone()
                    }
            }
            (Self::Coated { system: rigid, .. }, Self::Coated { system: own, .. }) => {
                let same_film = System {
                    sphere_modulus: f64::INFINITY,
                    substrate: rigid.substrate,
                    ..own.clone()
                };
                rigid.substrate.young() == f64::INFINITY && *rigid == same_film
            }
            _ => false,
        }
    }
}
