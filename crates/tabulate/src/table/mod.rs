//! From a scene to the file of its certified table.
//!
//! A `scene` says what the table covers, `plan` places the nodes, `sweep` solves them (into the
//! `journal`, from which an interrupted run goes on), `certify` compares the table with direct
//! solves, and `archive` writes the HDF5 file by the C calls in `bindings`. `generate` runs all of
//! these; `compress` makes the low-rank form of a finished table.

pub mod archive;
mod bindings;
mod certify;
mod compress;
mod generate;
mod journal;
pub mod plan;
pub mod scene;
mod sweep;

pub(crate) use certify::Axis as SampledAxis;
pub use certify::{Sample, certificate, certify, default_points, measure, points_for, sample};
pub use compress::{compress, low_rank};
pub use generate::{Generated, Observer, Options, generate};
pub use plan::Plan;
pub use scene::{Extent, Scene};
pub use sweep::{Sweep, Values, solve_tolerance, sweep};
