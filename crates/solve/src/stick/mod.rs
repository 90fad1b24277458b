//! Contacts with full friction.

pub(crate) mod bodies;
pub(crate) mod compliances;
mod coulomb;
pub(crate) mod field;
pub(crate) mod growth;
mod integration;
mod products;
mod sticking;

pub use growth::Grown;
pub use sticking::{
    GrownContact, MOST_OF_PUNCH, MOST_OF_TIP, PUNCH_TOLERANCE, StickPunch, Sticking, TIP_EXPONENTS,
    TIP_TOLERANCE,
};
