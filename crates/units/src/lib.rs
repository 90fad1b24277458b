#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod quantity;
mod unit;

pub use quantity::{Quantity, QuantityError};
pub use unit::{Dimension, Unit, prefix};
