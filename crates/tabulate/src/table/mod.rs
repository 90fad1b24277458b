//! From a scene to the file of its certified table.
//!
//! A `scene` states the box of parameters (`extent`; `scene_text` has its keys,
//! `stack_scene` those of a stack of layers). `plan` places the nodes of each axis by a rule of
//! `placement`, with as few nodes as the splines on `lines` through the box need. `sweep` solves
//! the nodes, into the `journal`, from which an interrupted run goes on. `certify` measures the
//! certificate: the largest error at sampled points. `file` writes the file, packed or by
//! `archive` as HDF5. `generate` runs all of these within a `budget`; `build` names the program
//! whose pieces a journal holds. `compress` makes the low-rank form of a finished table. `of_stack`
//! reads the stack of layers that a table is of.

#[cfg(feature = "hdf5")]
mod archive;
mod budget;
mod build;
mod certify;
#[cfg(feature = "compress")]
mod compress;
pub(crate) mod extent;
mod file;
mod generate;
mod journal;
mod lines;
mod of_stack;
mod placement;
mod plan;
pub(crate) mod scene;
mod scene_text;
mod stack_scene;
mod sweep;

pub use budget::{Budget, Clock};
pub use build::name as build_name;
#[cfg(feature = "figures")]
pub(crate) use certify::Axis as SampledAxis;
pub use certify::{
    Sample, certificate, certify, default_points, errors_by_quantity, measure, points_for, sample,
};
#[cfg(feature = "compress")]
pub use compress::{compress, low_rank};
pub use extent::Extent;
pub use file::{WRITES_HDF5, write};
pub use generate::{
    Generated, Keep, Observer, Options, Solver, generate, generate_with, here, journal_of,
};
pub use of_stack::stack_of;
pub use plan::Plan;
pub use scene::{Scene, random_points};
pub use scene_text::DEFAULT_NU0;
pub use sweep::{Sweep, Values, solve_tolerance, sweep};
