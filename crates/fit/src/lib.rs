//! Moduli and work of adhesion from measured contacts of a sphere on a coated substrate.

#![forbid(unsafe_code)]

mod measurement;

pub use measurement::{Direction, Kind, Measurement, Point};
