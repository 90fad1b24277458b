//! A table: its tolerance, nodes, solves, time, bytes and certified error, and the number of
//! evaluations after which it has cost less than direct solves.
//!
//! [`Evaluation`] times solves and lookups, `summary` prints the rows. The certified error of a table is the largest relative error
//! at sampled points.

mod evaluation;
mod rows;
mod summary;

pub use self::evaluation::{Evaluation, POINTS, SEED};
pub use self::rows::{Row, TOLERANCES, break_even};
pub use self::summary::markdown;
