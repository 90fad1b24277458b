//! Adhesive contact of a sphere on a coated substrate, from a precomputed table.
#![forbid(unsafe_code)]

mod error;
mod material;
mod quantity;

pub use error::Error;
pub use material::{Material, Normalisation};
pub use quantity::{Quantities, Quantity};
