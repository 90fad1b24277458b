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
    /// Returns whether these are the `own` bodies with a rigid probe and a rigid base. Of the layers of
    /// a stack, which relax all by one law, only the top one is known here: they are none.
    pub(crate) fn are_rigid_beside(&self, own: &Self) -> bool {
        match (self, own) {
            (Self::HalfSpace(rigid), Self::HalfSpace(own)) => {
                *rigid
                    == HalfSpace {
                        sphere_modulus: f64::INFINITY,
                        ..own.clone()
                    }
            }
            (
                Self::Coated {
                    system: rigid,
                    curve,
                    ..
                },
                Self::Coated { system: own, .. },
            ) => {
                let same_film = System {
                    sphere_modulus: f64::INFINITY,
                    substrate: rigid.substrate,
                    ..own.clone()
                };
                let is_stack = curve.stack().is_some();
                !is_stack && rigid.substrate.young() == f64::INFINITY && *rigid == same_film
            }
            _ => false,
        }
    }
}
