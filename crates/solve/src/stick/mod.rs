//! Contacts with full friction.

pub(crate) mod bodies;
pub(crate) mod compliances;
mod coulomb;
pub(crate) mod field;
pub(crate) mod growth;
mod integration;
mod products;
