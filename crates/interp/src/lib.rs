//! Adhesive contact of a sphere on a coated substrate, from a precomputed table.
//!
//! A sphere (body 2) touches a film (1) bonded to a substrate (0) and sticks to it. Barthel's model, *Adhesive contact of a
//! compliant sphere to an elastic coated substrate: the thin film limit*, needs four dimensionless functions of (`a/t`, `E1/E2`, `nu1`,
//! `E0/E2`), the [`Quantities`]. They are tabulated once, by the crate `tabulate`; this crate interpolates them and does the
//! arithmetic of eqs. 2, 8 and 9:
//!
//! * `Table::embedded` (feature `embedded`, on by default) is the table that comes with the crate; [`Table::read`] (packed) and `Table::open`
//!   (HDF5, feature `hdf5`) load another;
//! * [`Table::curve`] makes the [`Curve`] of one [`Material`]: the quantities as functions of `a/t`;
//! * [`Table::contact`] makes the [`Contact`] of one [`System`] in SI units: load and penetration from contact radius and work of
//!   adhesion;
//! * [`Curve::through`] and [`Contact::new`] make them without a table, from quantities solved elsewhere; [`Contact::half_space`] is JKR, without a
//!   film;
//! * [`Contact::equilibria`] has the contacts at a load, a penetration or the position of a spring with their stability, pull-off
//!   ([`Contact::pull_off`]), and whole force-displacement curves with their jumps;
//! * [`Contact::gradient`] has the derivatives of load and penetration with respect to every [`Input`], [`Curve::gradient`] those of the quantities;
//! * [`Contact::radius_and_energy_release_rate`] and its like need no work of adhesion, but measured values;
//! * [`Contact::film_bias`] says whether the film matters, [`Contact::validity`] and [`Contact::adhesion_range`] whether the model holds;
//! * [`Contact::line`] moves the contact line by a [`CrackTip`] law, of which eq. 8 is the simplest: different energies for an
//!   advancing and a receding line ([`Hysteresis`]), or energies that depend on its speed ([`RateDependent`]); slowly
//!   ([`ContactLine::impose`]), or in time (`ContactLine::ramp`, feature `dynamics`).
//!
//! ```
//! # #[cfg(feature = "embedded")]
//! # fn main() -> Result<(), interp::Error> {
//! use interp::{Elastic, System, Table};
//!
//! let table = Table::embedded();
//! let film = Elastic::new(3.5e6, 0.5)?; // Young's modulus (Pa), Poisson ratio
//! let substrate = Elastic::new(2e11, 0.25)?;
//! let system = System { sphere_radius: 1e-3, sphere_modulus: 2e6, film, film_thickness: 1e-6, substrate };
//! let contact = table.contact(&system)?;
//! for a in [40e-6, 65e-6, 90e-6] {
//!     let (load, penetration) = contact.load_and_penetration(a, 0.040)?; // work of adhesion, J/m^2
//!     println!("{a:e} m: {load:e} N, {penetration:e} m");
//! }
//! # Ok(()) }
//! # #[cfg(not(feature = "embedded"))]
//! # fn main() {}
//! ```
//!
//! No contact problem is solved here, and no value is clamped: outside the table or curve, but for rounding (1e-12), there is an [`Error`] with
//! the axis, the value and the range. Only a table's `a/t` has a continuation: load, penetration and quantities beyond it are the expansions about
//! the exact limits, where their estimated error is within the table's tolerance. What is searched for (equilibria, pull-off), the motion of a
//! contact line and derivatives with respect to the material end with the table.

#![forbid(unsafe_code)]

mod beyond;
mod certificate;
mod contact;
mod contact_line;
mod crack_tip;
mod curve;
#[cfg(feature = "dynamics")]
mod dynamics;
#[cfg(feature = "embedded")]
mod embedded;
mod energy_release;
mod equilibrium;
mod error;
mod force_displacement;
mod gradient;
#[cfg(feature = "hdf5")]
mod h5;
mod jkr_fit;
mod lookup;
mod low_rank;
mod material;
mod mechanics;
mod pack;
mod pieces;
mod quantity;
mod root;
mod rows;
pub mod schema;
mod sensitivity;
pub mod spline;
mod system;
mod table;
mod train;
mod validity;

pub use certificate::{Certificate, Details};
pub use contact::{Contact, State};
pub use contact_line::ContactLine;
pub use crack_tip::{CrackTip, Hysteresis, RateDependent};
pub use curve::Curve;
#[cfg(feature = "dynamics")]
pub use dynamics::Moment;
pub use equilibrium::{Control, Equilibria, Equilibrium};
pub use error::Error;
pub use force_displacement::{ForceDisplacement, Jump};
pub use gradient::{ContactGradient, Derivatives, Input};
pub use jkr_fit::{FilmBias, JkrFit};
pub use low_rank::LowRank;
pub use material::{Material, Normalisation};
pub use mechanics::{JkrPoint, Mechanics};
pub use pack::is_packed;
pub use quantity::{Quantities, Quantity};
pub use sensitivity::QuantityGradient;
pub use system::{Elastic, HalfSpace, System};
pub use table::{Description, Table};
pub use validity::{AdhesionRange, FilmValidity, Validity};
