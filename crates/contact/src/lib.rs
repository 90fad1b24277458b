//! Everything that one asks of the adhesive contact of a probe on a coated substrate.
//!
//! A [`Contact`] joins a [`System`](interp::System) with the curve of its material, from a table of
//! the crate `interp` or from a direct solve. Everything after that is arithmetic. The README lists
//! what a contact answers, with an example.
//!
//! All units are SI. Functions that return a `Result` give finite numbers or an error for any f64, and none panics for one.
//!
//! # The files
//!
//! `shape` knows the shape of the probe, which only the contact without adhesion depends on.
//! `equilibria` finds the states under a load, a penetration or a spring, and `measured` starts from measured values.
//! `gradient` differentiates, `validity` and `zone_size` compare a contact with the limits of the model, and `magnitude` its
//! numbers with what contacts have. `line` moves the contact line by other laws than eq. 8. `cohesive_zone` corrects for a short cohesive
//! zone by the `line_energy` of such a law. `history` holds bodies that relax. `root` finds zeros for all of them.

#![forbid(unsafe_code)]

#[macro_use]
mod named;

mod bodies;
mod cohesive_zone;
mod contact;
mod equilibria;
mod error;
mod gradient;
mod history;
mod line;
mod line_energy;
mod made;
pub mod magnitude;
mod measured;
mod root;
mod shape;
mod validity;
mod zone_size;

pub use cohesive_zone::{CohesiveState, CohesiveZone, ShortZone};
pub use contact::{Contact, State};
pub use equilibria::{Branch, Control, Equilibria, Equilibrium, ForceDisplacement, Jump};
pub use error::Error;
pub use gradient::{ContactGradient, Derivatives, Input};
pub use history::{
    Course, History, HistoryInputs, LawParameter, MeasuredHistory, Phase, Relaxation, TimedContact,
};
pub use line::{ContactLine, CrackTip, Hysteresis, RateDependent, TimedState};
pub use measured::{FilmBias, JkrFit, JkrPoint, work_of_adhesion_at_pull_off};
pub use root::root;
pub use validity::{FilmValidity, Neglected, Validity};
pub use zone_size::ZoneSize;
