//! The warning of wide contacts.

/// What the page and the command line say of a contact radius above
/// [`Validity::WARNING_A_OVER_R`](contact::Validity::WARNING_A_OVER_R) times that of the sphere.
pub const LARGE_CONTACT: &str =
    "The model assumes a contact radius that is small compared with R, and this one is not.";
