//! Where the method starts.
//!
//! `jkr` reads a homogeneous contact from the data, `relaxing_start` one of bodies that relax, `indentation` a contact
//! stiffness; `starts` is an experiment that takes what they find, and `start` leads from the slots to the problem.

pub(super) mod indentation;
pub(super) mod jkr;
pub(super) mod relaxing_start;
mod start;
pub(super) mod starts;

pub use self::start::starts_from_data;
pub(super) use self::start::{Variation, problem};
