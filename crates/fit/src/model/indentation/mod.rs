//! Contact stiffness as a measurement: what tells the contact radius, and what is known of the
//! indenter.
//!
//! `area` is the area function of the indenter, `radius` finds the contact radii of points,
//! `sample` the stiffness there, also where the film is thinned, `predict` joins them with the
//! numbers that a fit compares, `harmonic` is the phase between stiffness and oscillation,
//! `accept` refuses wrong points and settings, `guess` finds values to start from, and `simulate` makes points.

mod accept;
mod area;
mod guess;
mod harmonic;
mod indentation;
mod predict;
mod radius;
mod sample;
mod simulate;

pub use self::indentation::{ContactDepth, Indentation};
pub use area::{AreaFunction, MOST_COEFFICIENTS};
pub use harmonic::LossAngle;
