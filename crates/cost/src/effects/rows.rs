//! The rows that are measured of effects.

use serde::{Deserialize, Serialize};
use solve::Error;

use super::effect::Effect;
use super::{cohesive_zone, friction, interface, relaxation, shape};
use crate::Measurement;
use crate::clock::Timing;

/// The table of a scene without one effect, the cost that this saves, and the error of the load.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// The effect that is left out; none in the first row.
    pub without: Option<Effect>,
    /// Relative tolerance of the tables.
    pub tolerance: f64,
    /// Number of axes of the table without the effect.
    pub axes: u64,
    /// Contacts solved for its nodes.
    pub solves: u64,
    /// Number of threads that made the table.
    pub threads: u64,
    /// Time to make the HDF5 file, including planning and certificate (s): the fastest of several
    /// runs.
    pub seconds: f64,
    /// Size of the HDF5 file.
    pub bytes: u64,
    /// Solves of the whole scene less `solves`.
    pub saved_solves: i64,
    /// Time of the whole scene less `seconds`; none if the difference is not above the noise of the
    /// two times.
    pub saved_seconds: Option<f64>,
    /// Size of the whole scene's file less `bytes`.
    pub saved_bytes: i64,
    /// Median over the scene of the error of the load, see [`errors`](super::errors).
    pub median_error: f64,
    /// Largest error of the load over the scene.
    pub worst_error: f64,
    /// Time of what the effect slows down, with it over without it: to make the contact of a new
    /// material for the shape and the interface, to find a pull-off for the finite range, to solve a
    /// curve for friction, to follow 1001 points for relaxation. None for the effects that make the table larger instead.
    #[serde(default)]
    pub time_ratio: Option<f64>,
}

impl Measurement for Row {
    /// A half-space takes no time, for it has no table.
    const SHORTEST: f64 = 0.0;
}

impl Effect {
    /// Returns the time of what the effect slows down, with it over without it, see [`Row::time_ratio`]; none for the effects that make
    /// the table larger instead.
    ///
    /// # Errors
    /// Those of the solve and of the contact.
    pub fn time_ratio(self, timing: Timing) -> Result<Option<f64>, Error> {
        let ratio = match self {
            Self::Shape => shape::time_ratio,
            Self::FiniteRange => cohesive_zone::time_ratio,
            Self::Interface => interface::time_ratio,
            Self::Friction => friction::time_ratio,
            Self::Relaxation => relaxation::time_ratio,
            _ => return Ok(None),
        };
        ratio(timing).map(Some)
    }
}
