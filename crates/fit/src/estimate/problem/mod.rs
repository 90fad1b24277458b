//! The least-squares problem.
//!
//! `slot` lists the values to be found and their coordinates, `assigned` is an experiment with the branches of its points,
//! `few` the points that count at first, `problem` the residuals and derivatives with their `loss`, which `blocks`
//! decomposes where the experiments are many, and `minimise` the method, which ends in the `basin` of a minimum that is known.
//! `uncertainty` gives the errors at a minimum, and `no_adhesion` tells where adhesion does not show.

pub(super) mod assigned;
pub(super) mod basin;
pub(super) mod blocks;
pub(super) mod few;
pub(super) mod loss;
pub(super) mod minimise;
pub(super) mod no_adhesion;
mod problem;
pub(super) mod slot;
pub(super) mod uncertainty;

pub(super) use self::problem::*;
