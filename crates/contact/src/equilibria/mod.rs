//! The states of a contact under a load, a penetration or a spring.
//!
//! `equilibria` finds the equilibria of one value, between the `turning_points` of the curve and among contact `radii`,
//! `branch` those of many values. `force_displacement` is the curve with its jumps, `moving_stiffness` its slope.

mod branch;
mod equilibria;
mod force_displacement;
mod moving_stiffness;
mod radii;
mod turning_points;

pub use self::branch::Branch;
pub use self::equilibria::{Control, Equilibria, Equilibrium};
pub use self::force_displacement::{ForceDisplacement, Jump};
