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
