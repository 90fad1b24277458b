//! The contact in SI units: loads, penetrations, equilibria and their derivatives, from the curve
//! of a material.
//!
//! [`Contact`] joins a system with its curve, and `mechanics` is the arithmetic of eqs. 2 to 9. On
//! them build the states under a load, a penetration or a spring (`equilibria`,
//! `force_displacement`), the energy release rate of measured values (`energy_release`),
//! derivatives (`gradient`), fits of JKR (`jkr_fit`), the limits of the model (`validity`), and
//! contact lines that move by a law of their own (`crack_tip`, `contact_line`, `dynamics`). `root`
//! finds zeros for all of them.

pub(crate) mod contact;
mod contact_line;
mod crack_tip;
#[cfg(feature = "dynamics")]
mod dynamics;
mod energy_release;
mod equilibria;
mod force_displacement;
mod gradient;
mod jkr_fit;
mod mechanics;
mod root;
mod validity;

pub use contact::{Contact, State};
pub use contact_line::ContactLine;
pub use crack_tip::{CrackTip, Hysteresis, RateDependent};
#[cfg(feature = "dynamics")]
pub use dynamics::TimedState;
pub use equilibria::{Control, Equilibria, Equilibrium};
pub use force_displacement::{ForceDisplacement, Jump};
pub use gradient::{ContactGradient, Derivatives, Input};
pub use jkr_fit::{FilmBias, JkrFit};
pub use mechanics::{JkrPoint, Mechanics};
pub use validity::{AdhesionRange, FilmValidity, Validity};
