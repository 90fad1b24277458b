//! The warning of wide contacts.

/// What the page and the command line say of a contact radius above
/// [`Validity::WARNING_A_OVER_R`](contact::Validity::WARNING_A_OVER_R) times that of the sphere.
pub const LARGE_CONTACT: &str =
    "The model takes the sphere for a paraboloid, which holds up to contact radii of 0.3 R.";
