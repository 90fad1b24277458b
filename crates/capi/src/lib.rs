//! The C interface: load, penetration, stiffness, pull-off and derivatives of a probe on a film on a
//! substrate.
//!
//! `system` has the structures that C fills or reads, `guard` turns errors and panics into a status and
//! a text, `contact` has the functions. All units are SI; loads are positive in compression. Every
//! function returns 0, or a status of [`CcStatus`]; [`cc_error`](guard::cc_error) then tells why, and
//! nothing is written to the results. Objects may be used by several threads at once, and are freed
//! once. A pointer of C is an optional reference here; arrays and texts alone need `unsafe`.

mod contact;
mod guard;
mod system;

pub use contact::{
    CcContact, CcTable, cc_contact_free, cc_contact_new, cc_gradient, cc_load, cc_penetration,
    cc_pull_off, cc_stiffness, cc_table_free, cc_table_read,
};
pub use guard::{CcStatus, cc_error};
pub use system::{CcProbe, CcState, CcSystem};
