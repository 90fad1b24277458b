//! A table: its tolerance, nodes, solves, time, bytes and certified error, and the number of
//! evaluations after which it has cost less than direct solves.
//!
//! `limits` ends the series of tables, `made` generates one, `evaluation` times solves and lookups,
//! `summary` prints the rows. The certified error of a table is the largest relative error at
//! sampled points.

mod evaluation;
mod limits;
mod made;
mod summary;

use std::time::Instant;

use serde::{Deserialize, Serialize};

use self::evaluation::Evaluation;
pub use self::limits::{Limits, TOLERANCES};
use self::limits::{is_limit, points};
pub(crate) use self::made::Made;
pub use self::summary::markdown;
use super::Measured;
use super::clock::Timing;
use crate::Error;
use crate::cost::rows::{COUNT, ERROR, Measurement, TIME, TOLERANCE};
use crate::table::{Observer, Scene};

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

impl Measurement for Row {
    const RANGES: &'static [(&'static str, [f64; 2])] = &[
        ("tolerance", TOLERANCE),
        ("solves", COUNT),
        ("threads", [1.0, 1e6]),
        ("seconds", TIME),
        ("dense_bytes", COUNT),
        ("dense_error", ERROR),
        ("pack_seconds", TIME),
        ("packed_bytes", COUNT),
        ("packed_error", ERROR),
        ("solve_seconds", TIME),
        ("curve_seconds", TIME),
        ("point_seconds", TIME),
        ("break_even_alone", [0.0, f64::INFINITY]),
        ("break_even_along", [0.0, f64::INFINITY]),
    ];
}

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

/// Makes the tables of a scene to the [`TOLERANCES`], from the loosest on, within `limits`. The
/// scene's own tolerance is ignored.
///
/// The time of the next table is predicted from its planned nodes, the points of its two
/// certificates, and the time per point of the last table. A table that is still being solved when
/// the budget ends is given up. The first tolerance without a table, and the reason, is in
/// [`Measured::left_out`].
///
/// # Errors
/// Those of [`generate`](crate::table::generate()) and of packing if not even the first table can
/// be made; [`Error::Write`] for temporary files that cannot be written.
pub fn measure(
    scene: &Scene,
    limits: &Limits<'_>,
    timing: Timing,
    observer: &dyn Observer,
) -> Result<Measured<Row>, Error> {
    let mut rows: Vec<Row> = Vec::new();
    let mut seconds_per_point = None;
    for tolerance in limits.tolerances() {
        let scene = Scene {
            tolerance,
            ..scene.clone()
        };
        let began = (limits.clock)();
        let made = seconds_per_point
            .map_or(Ok(()), |seconds| limits.check(&scene, seconds))
            .and_then(|()| row(&scene, limits, timing, observer));
        match made {
            Ok(row) => {
                let took = (limits.clock)().saturating_sub(began).as_secs_f64();
                seconds_per_point = Some(took / points(&scene, row.nodes().iter().product()));
                rows.push(row);
            }
            Err(error) if !rows.is_empty() && is_limit(&error) => {
                return Ok(Measured {
                    rows,
                    left_out: vec![format!(
                        "There is no table to {tolerance:e}: {}.",
                        reason(&error, limits)
                    )],
                });
            }
            Err(Error::Budget { spent }) => {
                return Err(Error::Budget {
                    spent: format!("{spent}{}", of_budget(limits)),
                });
            }
            Err(error) => return Err(error),
        }
    }
    Ok(rows.into())
}

/// An error in words, with the budget if it is about that.
fn reason(error: &Error, limits: &Limits<'_>) -> String {
    match error {
        Error::Budget { .. } => format!("{error}{}", of_budget(limits)),
        _ => error.to_string(),
    }
}

fn of_budget(limits: &Limits<'_>) -> String {
    limits.budget.map_or_else(String::new, |budget| {
        format!(
            " (--budget is {:?} s; give a larger one)",
            budget.as_secs_f64()
        )
    })
}

/// Makes, packs and times the table of a scene to its tolerance.
fn row(
    scene: &Scene,
    limits: &Limits<'_>,
    timing: Timing,
    observer: &dyn Observer,
) -> Result<Row, Error> {
    let made = Made::new(scene, limits.left(), observer).map_err(|error| match error {
        Error::Budget { .. } => Error::Budget {
            spent: format!("before the table to {:e} is finished", scene.tolerance),
        },
        error => error,
    })?;
    let began = Instant::now();
    let packed = made.packed(scene.tolerance, observer)?;
    let packed_bytes = packed.to_packed()?.len() as u64;
    let pack_seconds = began.elapsed().as_secs_f64();
    let evaluation = Evaluation::measure(scene, &packed, timing)?;
    let [
        a_over_t_nodes,
        e1_over_e2_nodes,
        nu1_nodes,
        e0_over_e2_nodes,
    ] = made.table.shape().map(|nodes| nodes as u64);
    let ranks = packed.ranks().unwrap_or_default();
    // The largest of all tiles.
    let [rank_1, rank_2, rank_3] = [0, 1, 2].map(|bond| {
        ranks
            .iter()
            .map(|ranks| ranks[bond] as u64)
            .max()
            .unwrap_or(0)
    });
    let mut row = Row {
        tolerance: scene.tolerance,
        a_over_t_nodes,
        e1_over_e2_nodes,
        nu1_nodes,
        e0_over_e2_nodes,
        solves: made.solves,
        threads: rayon::current_num_threads() as u64,
        seconds: made.seconds,
        dense_bytes: made.bytes,
        dense_error: made.table.description().certificate.max_error,
        pack_seconds,
        packed_bytes,
        packed_error: packed.description().certificate.max_error,
        rank_1,
        rank_2,
        rank_3,
        solve_seconds: evaluation.solve,
        curve_seconds: evaluation.curve,
        point_seconds: evaluation.point,
        break_even_alone: f64::NAN,
        break_even_along: f64::NAN,
    };
    let making = row.making();
    row.break_even_alone = break_even(
        making,
        evaluation.solve,
        evaluation.curve + evaluation.point,
    );
    row.break_even_along = break_even(making, evaluation.solve, evaluation.point);
    Ok(row)
}
