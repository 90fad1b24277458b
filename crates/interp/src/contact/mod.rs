//! The contact in SI units: loads, penetrations, equilibria and their derivatives.
//!
//! [`Contact`] joins a system with the curve of its material, and [`Mechanics`] is the arithmetic
//! of eqs. 2 to 9. `shape` knows the shape of the probe, which only the contact without adhesion
//! depends on. `equilibria` and `force_displacement` find the states under a load, a penetration or
//! a spring, `branch` those at many values, `radii` the contact radii among which they search.
//! `energy_release` starts from measured values, `gradient` differentiates, `jkr_fit` fits a
//! straight line, `validity` compares a contact with the limits of the model. `crack_tip`,
//! `contact_line` and `dynamics` move the contact line by other laws than eq. 8, the latter by the
//! steps of `implicit_step`. `finite_range` corrects for an attraction of short range by the
//! `line_energy` of such a law. `checks` accepts numbers, `root` finds zeros for all of them.

mod branch;
mod checks;
mod contact;
mod contact_line;
mod crack_tip;
mod dynamics;
mod energy_release;
mod equilibria;
mod finite_range;
mod force_displacement;
mod gradient;
mod history;
mod implicit_step;
mod jkr_fit;
mod line_energy;
mod mechanics;
mod radii;
mod root;
mod shape;
mod validity;

pub use branch::Branch;
pub use contact::{Contact, State};
pub use contact_line::ContactLine;
pub use crack_tip::{CrackTip, Hysteresis, RateDependent};
pub use dynamics::TimedState;
pub use equilibria::{Control, Equilibria, Equilibrium};
pub use finite_range::{CohesiveEquilibrium, CohesiveState, FiniteRange, ShortRange};
pub use force_displacement::{ForceDisplacement, Jump};
pub use gradient::{ContactGradient, Derivatives, Input};
pub use history::{Course, History, HistoryError, Phase, Relaxation, TimedContact};
pub use jkr_fit::{FilmBias, JkrFit};
pub use mechanics::{JkrPoint, Mechanics};
pub use root::root;
pub use validity::{AdhesionRange, FilmValidity, Neglected, Validity};
