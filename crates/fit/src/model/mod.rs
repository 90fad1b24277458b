//! What is measured, what is known, and what the contact model predicts for it.
//!
//! `measurement` holds the points, `parameter` the numbers that can be fitted, `experiment` the points
//! with all that is known about them, `errors` their standard deviations. `free` is what is to be found
//! and how, `fixed` what is taken as given, `scale` the calibration of what is read. `assign` reads the `branch` of each point from the data,
//! and finds loading and unloading; `split` tells where contact and baseline meet, on a baseline whose
//! slope `tilt` reads. `predict` compares the points with the contact of `interp`, through `predictor`, `readings`
//! and, under adhesion hysteresis, `turn`; `line_speed` is adhesion that depends on the speed of the contact line; `bodies` are what touches, `layer` is one of their layers, `solver` makes contacts on layers,
//! `interrupt` stops them, and `differences` makes the derivatives on it. `relaxing` predicts the
//! points in time where the bodies relax, and `program` takes the noise off what is imposed on them by
//! `straight_lines`. `indentation` is contact stiffness as a measurement. `simulate` makes synthetic
//! points, `prediction` evaluates the model for other methods of fitting.

mod assign;
mod bodies;
mod branch;
mod corner;
mod differences;
mod errors;
mod experiment;
mod fixed;
mod free;
mod indentation;
mod interrupt;
mod layer;
mod line_speed;
mod measurement;
mod parameter;
mod predict;
mod predicted;
mod prediction;
mod predictor;
mod program;
mod readings;
mod relaxing;
mod scale;
mod simulate;
mod solver;
mod split;
mod straight_lines;
mod tilt;
mod turn;

pub(crate) use assign::{Assignment, noise_of};
pub use bodies::Bodies;
pub use branch::Branch;
pub(crate) use differences::{ContactOf, contacts_of};
pub(crate) use errors::AbscissaError;
pub use errors::PointErrors;
pub use experiment::Experiment;
pub use fixed::Fixed;
pub(crate) use free::has_no_start;
pub use free::{Free, Known, Loss, Options, Prior, Scope};
pub use indentation::{AreaFunction, ContactDepth, Indentation, LossAngle, MOST_COEFFICIENTS};
pub use interrupt::Interrupt;
pub use layer::{LayerName, NamedLayer};
pub use line_speed::LineSpeed;
pub use measurement::{Direction, Kind, Measurement, Numbering, Point};
pub use parameter::{LayerQuantity, Parameter};
pub(crate) use predicted::{Predicted, ends_of_radii};
pub use prediction::Prediction;
pub(crate) use program::Program;
pub use relaxing::Relaxing;
pub use scale::Scale;
pub use simulate::simulate;
pub use solver::{Reach, Solver};
