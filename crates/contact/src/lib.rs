//! Everything that one asks of the adhesive contact of a probe on a coated substrate.
//!
//! A [`Contact`] joins a [`System`](interp::System) with the curve of its material, from a table of
//! the crate `interp` or from a direct solve. Everything after that is arithmetic. All units are SI.
//!
//! ```
//! # fn main() -> Result<(), contact::Error> {
//! use contact::{Contact, Control};
//! use interp::{Elastic, Probe, System, Table};
//!
//! // A sphere of 1 mm and E2* = 2 MPa, an incompressible film of 10 um, a stiff substrate.
//! let system = System {
//!     probe: Probe::Paraboloid { radius: 1e-3 },
//!     sphere_modulus: 2e6,
//!     film: Elastic::new(3.5e6, 0.5)?, // Young's modulus (Pa), Poisson ratio
//!     film_thickness: 1e-5,
//!     substrate: Elastic::new(2e11, 0.25)?,
//! };
//! let contact = Contact::in_table(Table::embedded(), &system)?;
//! let w = 0.040; // work of adhesion, J/m^2
//!
//! // The pull-off load is larger than that without a film, 1.5 pi w R.
//! let pull_off = contact.pull_off(w, Control::Load)?;
//! let unit = std::f64::consts::PI * w * 1e-3;
//! assert!((pull_off.load / unit + 1.5401).abs() < 1e-4);
//! # Ok(()) }
//! ```
//!
//! # Results of a contact
//!
//! * At a contact radius: [`Contact::load`], [`Contact::load_and_penetration`],
//!   [`Contact::stiffness`] of a contact line that stays, [`Contact::moving_stiffness`] of one that
//!   moves, [`Contact::stress_intensity`].
//! * At a load, a penetration or a position of a spring ([`Control`]): [`Contact::equilibria`]
//!   finds the contacts and their stability, whole force-displacement curves with their jumps
//!   ([`Equilibria::force_displacement`]), [`Contact::pull_off`] and [`Contact::zero_load`].
//!   [`Equilibria::branch`] finds the states at many values, [`Equilibria::branch_with_gradient`]
//!   with derivatives at fixed imposed values.
//! * From any two measured values, without a work of adhesion:
//!   [`Contact::energy_release_rate_at_load`], [`Contact::energy_release_rate_at_penetration`] and
//!   [`Contact::radius_and_energy_release_rate`].
//! * [`Contact::gradient`] has the derivatives with respect to every parameter, of a contact made by
//!   [`Contact::in_table_with_gradient`]. [`Contact::in_table_with_derivatives`] takes less time for
//!   some of them.
//! * [`Contact::film_bias`] tells whether the film matters to a fit of JKR; [`Contact::validity`]
//!   and [`Contact::zone_size`] tell whether the assumptions of the model hold.
//! * [`Contact::line`] moves the contact line by a [`CrackTip`] law, of which eq. 8 is the
//!   simplest. Advancing and receding lines may have different energies ([`Hysteresis`]), or
//!   energies that depend on the speed ([`RateDependent`]). The line moves slowly
//!   ([`ContactLine::impose`]) or in time ([`ContactLine::ramp`]).
//! * [`Contact::history`] follows a penetration, a load or a spring in time where the bodies relax
//!   ([`Relaxation`]).
//! * [`Contact::cohesive_zone`] corrects for an attraction that acts over a short distance.
//! * [`Contact::half_space`] is JKR: no film, no table.
//!
//! Above the nodes in `a/t` of a table there are no derivatives, and equilibria are not sought. Any
//! f64 gives finite numbers or an error, never a panic.
//!
//! # The files
//!
//! `shape` knows the shape of the probe, which only the contact without adhesion depends on.
//! `equilibria` and `force_displacement` find the states under a load, a penetration or a spring,
//! `branch` those at many values, `radii` the contact radii among which they search.
//! `energy_release` starts from measured values, `moving_stiffness` is the slope of the force
//! curve, `gradient` differentiates, `jkr_fit` fits a straight line, `validity` compares a contact with the limits of the model, and `magnitude` its numbers with what contacts have. `crack_tip`,
//! `contact_line` and `dynamics` move the contact line by other laws than eq. 8, the latter by the
//! steps of `implicit_step`. `cohesive_zone` corrects for a short cohesive zone by the
//! `line_energy` of such a law. `history` holds bodies that relax. `root` finds zeros for all of them.

#![forbid(unsafe_code)]

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
pub mod magnitude;
mod moving_stiffness;
mod radii;
mod root;
mod shape;
mod turning_points;
mod validity;

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
