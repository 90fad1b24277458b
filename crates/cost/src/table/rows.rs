//! The rows that are measured of tables.

use serde::{Deserialize, Serialize};

use crate::Measurement;

/// The tolerances of the rows, from the loosest on.
pub const TOLERANCES: [f64; 7] = [1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8];

/// One table of a scene, and direct solves beside it. Times of single evaluations are means over
/// random points of the scene, on one thread.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// Relative tolerance of the table, of its packed form and of the direct solves.
    pub tolerance: f64,
    /// Nodes of `a_over_t`.
    pub a_over_t_nodes: u64,
    /// Nodes of `e1_over_e2`.
    pub e1_over_e2_nodes: u64,
    /// Nodes of `nu1`.
    pub nu1_nodes: u64,
    /// Nodes of `e0_over_e2`.
    pub e0_over_e2_nodes: u64,
    /// Contacts solved for the nodes, including those of tables that were refined afterwards.
    pub solves: u64,
    /// Number of threads that made and packed the table.
    pub threads: u64,
    /// Time to make the HDF5 file, including planning and certificate (s).
    pub seconds: f64,
    /// Size of the HDF5 file.
    pub dense_bytes: u64,
    /// Certified error of the HDF5 file.
    pub dense_error: f64,
    /// Time to pack the table, including its certificate (s).
    pub pack_seconds: f64,
    /// Size of the low-rank form.
    pub packed_bytes: u64,
    /// Certified error of the low-rank form.
    pub packed_error: f64,
    /// First rank of the low-rank form.
    pub rank_1: u64,
    /// Second rank of the low-rank form.
    pub rank_2: u64,
    /// Third rank of the low-rank form.
    pub rank_3: u64,
    /// Time of a direct solve to the tolerance (s).
    pub solve_seconds: f64,
    /// Time to look up the curve of a material in the packed table (s).
    pub curve_seconds: f64,
    /// Time to look up a point on such a curve (s).
    pub point_seconds: f64,
    /// [`break_even`] if each evaluation is of a new material.
    pub break_even_alone: f64,
    /// [`break_even`] if each evaluation is a further point of a material whose curve has been
    /// looked up.
    pub break_even_along: f64,
}

impl Measurement for Row {}

impl Row {
    /// Returns the number of nodes on each axis.
    pub const fn nodes(&self) -> [u64; 4] {
        [
            self.a_over_t_nodes,
            self.e1_over_e2_nodes,
            self.nu1_nodes,
            self.e0_over_e2_nodes,
        ]
    }

    /// Returns the largest possible processor time of making and packing (s): that of threads that
    /// are never idle.
    pub const fn making(&self) -> f64 {
        self.threads as f64 * (self.seconds + self.pack_seconds)
    }
}

/// Returns the number of evaluations after which a table has cost the processor time of direct
/// solves: `making / (solve - lookup)`, all in seconds. Infinite if a solve is not slower than a
/// lookup.
pub fn break_even(making: f64, solve: f64, lookup: f64) -> f64 {
    if solve > lookup {
        making / (solve - lookup)
    } else {
        f64::INFINITY
    }
}
