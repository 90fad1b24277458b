//! Derivatives of load and penetration with respect to all their inputs.
//!
//! `terms` holds the terms of load and penetration and their derivatives, `elastic` those with respect
//! to the elastic constants.

mod elastic;
mod gradient;
mod terms;

pub use self::gradient::{ContactGradient, Derivatives, Input};
pub(crate) use elastic::parameters_of;
