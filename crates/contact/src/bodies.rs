//! The bodies in contact, with the curve of their material.

use interp::{Curve, HalfSpace, Material, System};

/// The bodies in contact.
#[derive(Clone, Debug)]
pub(crate) enum Bodies {
    /// A probe on a homogeneous half-space.
    HalfSpace(HalfSpace),
    /// A probe on a coated substrate, with the curve of its material.
    Coated {
        system: System,
        /// The material of the system.
        material: Material,
        curve: Curve,
    },
}
