//! Everything that one asks of the adhesive contact of a probe on a coated substrate.
//!
//! A [`Contact`] joins a [`System`](interp::System) with the curve of its material, from a table of
//! the crate `interp` or from a direct solve. Everything after that is arithmetic. The README lists
//! what a contact answers, with an example.
//!
//! All units are SI. Any f64 gives finite numbers or an error, never a panic.
//!
//! # The files
//!
//! `shape` knows the shape of the probe, which only the contact without adhesion depends on.
//! `equilibria` and `force_displacement` find the states under a load, a penetration or a spring,
//! `branch` those at many values, `radii` the contact radii among which they search.
//! `energy_release` starts from measured values, `work_of_adhesion` from a measured pull-off,
//! `moving_stiffness` is the slope of the force
//! curve, `gradient` differentiates, `jkr_fit` fits a straight line, `validity` compares a contact with the limits of the model, and `magnitude` its numbers with what contacts have. `crack_tip`,
//! `contact_line` and `dynamics` move the contact line by other laws than eq. 8, the latter by the
//! steps of `implicit_step`. `cohesive_zone` corrects for a short cohesive zone by the
//! `line_energy` of such a law. `history` holds bodies that relax. `root` finds zeros for all of them.

#![forbid(unsafe_code)]

#[macro_use]
mod named;

mod bodies;
mod branch;
mod cohesive_zone;
mod contact;
mod contact_line;
mod crack_tip;
mod dynamics;
mod energy_release;
mod equilibria;
mod error;
mod force_displacement;
mod gradient;
mod history;
mod implicit_step;
mod jkr_fit;
mod line_energy;
mod made;
pub mod magnitude;
mod moving_stiffness;
mod radii;
mod root;
mod shape;
mod turning_points;
mod validity;
mod work_of_adhesion;

pub use branch::Branch;
pub use cohesive_zone::{CohesiveEquilibrium, CohesiveState, CohesiveZone, ShortZone};
pub use contact::{Contact, State};
pub use contact_line::ContactLine;
pub use crack_tip::{CrackTip, Hysteresis, RateDependent};
pub use dynamics::TimedState;
pub use equilibria::{Control, Equilibria, Equilibrium};
pub use error::Error;
pub use force_displacement::{ForceDisplacement, Jump};
pub use gradient::{ContactGradient, Derivatives, Input};
pub use history::{
    Course, History, HistoryError, HistoryInputs, LawParameter, MeasuredHistory, Phase, Relaxation,
    TimedContact,
};
pub use jkr_fit::{FilmBias, JkrFit, JkrPoint};
pub use root::root;
pub use validity::{FilmValidity, Neglected, Validity, ZoneSize};
pub use work_of_adhesion::work_of_adhesion_at_pull_off;
