//! What is measured, what is known, and what the contact model predicts for it.
//!
//! `measurement` holds the points, `parameter` the numbers that can be fitted, `experiment` the
//! points with all that is known about them, `free` what is to be found and how. `assign` reads the
//! `branch` of each point from the data. `predict` compares the points with the contact of
//! `interp`, through `readings` and, under adhesion hysteresis, `turn`; `layered` is a stack of
//! layers, for which another crate computes contacts (`interruptible` lets them be stopped), and
//! `differences` the derivatives on it.
//! `simulate` makes synthetic points, `prediction` evaluates the model for other methods of
//! fitting.

mod assign;
mod branch;
mod differences;
mod experiment;
mod free;
mod interruptible;
mod layered;
mod measurement;
mod parameter;
mod predict;
mod prediction;
mod readings;
mod simulate;
mod turn;

pub(crate) use assign::{Assignment, Freedom};
pub use branch::Branch;
pub use experiment::{Bodies, Experiment};
pub use free::{Free, Loss, Options, Prior, Scope};
pub use interruptible::Interruptible;
pub use layered::{Cause, Layer, LayerName, Layered, LayeredSolver, Reach};
pub use measurement::{Direction, Kind, Measurement, Point};
pub use parameter::Parameter;
pub(crate) use predict::Predicted;
pub use prediction::Prediction;
pub use simulate::simulate;
