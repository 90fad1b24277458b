//! Adhesive contact of a sphere on a coated substrate, from a precomputed table.
//!
//! A sphere (body 2) touches a film (1) bonded to a substrate (0) and adheres to it. Barthel's
//! model, *Adhesive contact of a compliant sphere to an elastic coated substrate: the thin film
//! limit*, needs four dimensionless functions of (`a/t`, `E1/E2*`, `nu1`, `E0/E2*`), the
//! [`Quantities`]. The crate `tabulate` computes them once for a table. This crate interpolates the
//! table and evaluates eqs. 2 to 9 of the model. All units are SI. Loads are positive in
//! compression; penetrations are positive when the sphere is below the undeformed surface.
//!
//! # From a system to its pull-off
//!
//! ```
//! # #[cfg(feature = "embedded")]
//! # fn main() -> Result<(), interp::Error> {
//! use interp::{Control, Elastic, System, Table, Probe};
//!
//! // A sphere of 1 mm and E2* = 2 MPa, an incompressible film of 10 um, a stiff substrate.
//! let film = Elastic::new(3.5e6, 0.5)?; // Young's modulus (Pa), Poisson ratio
//! let substrate = Elastic::new(2e11, 0.25)?;
//! let system = System {
//!     probe: Probe::Paraboloid { radius: 1e-3 },
//!     sphere_modulus: 2e6,
//!     film,
//!     film_thickness: 1e-5,
//!     substrate,
//! };
//!
//! // The material is looked up once. Everything after this is arithmetic.
//! let contact = Table::embedded().contact(&system)?;
//! let w = 0.040; // work of adhesion, J/m^2
//! for a in [40e-6, 65e-6, 90e-6] {
//!     let (load, penetration) = contact.load_and_penetration(a, w)?;
//!     println!("{a:e} m: {load:e} N, {penetration:e} m");
//! }
//!
//! // The pull-off load is larger than that without a film, 1.5 pi w R.
//! let pull_off = contact.pull_off(w, Control::Load)?;
//! let unit = std::f64::consts::PI * w * 1e-3;
//! assert!((pull_off.load / unit + 1.5401).abs() < 1e-4);
//! # Ok(()) }
//! # #[cfg(not(feature = "embedded"))]
//! # fn main() {}
//! ```
//!
//! # Tables, curves and contacts
//!
//! * `Table::embedded` (feature `embedded`) is the table that comes with the crate. [`Table::read`]
//!   (packed) and `Table::open` (HDF5, feature `hdf5`) load another one.
//! * [`Table::curve`] makes the [`Curve`] of one [`Material`]: the quantities as functions of
//!   `a/t`. [`Table::contact`] makes the [`Contact`] of one [`System`]. The Poisson ratios may
//!   differ from the table's: Dundurs' equivalence is exact.
//! * [`Table::curve_with_gradient`] and [`Table::contact_with_gradient`] add the derivatives with
//!   respect to every parameter: [`Curve::gradient`], [`Contact::gradient`].
//! * [`Curve::through`] and [`Contact::new`] use quantities solved elsewhere in place of a table.
//!   [`Contact::half_space`] is JKR: no film, no table.
//! * [`Curve::spline`] converts a curve to a spline of the crate `splines`, for other programs.
//!
//! # Results of a contact
//!
//! * At a contact radius: [`Contact::load`], [`Contact::load_and_penetration`],
//!   [`Contact::stiffness`], [`Contact::stress_intensity`].
//! * At a load, a penetration or a position of a spring ([`Control`]): [`Contact::equilibria`]
//!   finds the contacts and their stability, whole force-displacement curves with their jumps
//!   ([`Equilibria::force_displacement`]), [`Contact::pull_off`] and [`Contact::zero_load`].
//!   [`Equilibria::branch`] finds the states at many values, [`Equilibria::branch_with_gradient`]
//!   with derivatives at fixed imposed values.
//! * From any two measured values, without a work of adhesion:
//!   [`Contact::energy_release_rate_at_load`], [`Contact::energy_release_rate_at_penetration`] and
//!   [`Contact::radius_and_energy_release_rate`].
//! * [`Contact::film_bias`] tells whether the film matters to a fit of JKR; [`Contact::validity`]
//!   and [`Contact::adhesion_range`] tell whether the assumptions of the model hold.
//! * [`Contact::line`] moves the contact line by a [`CrackTip`] law, of which eq. 8 is the
//!   simplest. Advancing and receding lines may have different energies ([`Hysteresis`]), or
//!   energies that depend on the speed ([`RateDependent`]). The line moves slowly
//!   ([`ContactLine::impose`]) or in time ([`ContactLine::ramp`]).
//! * [`Contact::finite_range`] corrects for an attraction that acts over a short distance.
//!
//! # Outside the table
//!
//! No value is clamped. A material outside the table's box (by more than rounding, 1e-12) is an
//! [`Error`] with the axis, the value and the range. Beyond the `a/t` of the nodes the first terms
//! of the expansions about the exact limits, thick and thin film, are used where their estimated
//! error ([`Curve::error`]) is within the table's tolerance; elsewhere there is an error. Below the
//! nodes (thick films) the expansions have derivatives, and equilibria are sought down to a radius
//! of 0. Above the nodes there are no derivatives, and equilibria are not sought. Any f64 gives
//! finite numbers or an error, never a panic.
//!
//! # Features
//!
//! | feature | adds |
//! |---|---|
//! | `embedded` (default) | `Table::embedded`, 0.4 MB in the program |
//! | `hdf5` | `Table::open`, without a C library |
//!
//! Rust 1.89 or newer. The crate needs `std`, for files and for the parts of a table that are made
//! at the first use.

#![forbid(unsafe_code)]

mod contact;
mod curve;
mod error;
mod material;
pub mod once;
mod table;

pub use contact::TimedState;
#[doc(hidden)]
pub use contact::root;
pub use contact::{AdhesionRange, FilmValidity, Neglected, Validity};
pub use contact::{Branch, Control, Equilibria, Equilibrium, ForceDisplacement, Jump};
pub use contact::{CohesiveEquilibrium, CohesiveState, FiniteRange, ShortRange};
pub use contact::{Contact, ContactGradient, Derivatives, Input, State};
pub use contact::{ContactLine, CrackTip, Hysteresis, RateDependent};
pub use contact::{Course, History, HistoryError, Phase, Relaxation, TimedContact};
pub use contact::{FilmBias, JkrFit, JkrPoint, Mechanics};
pub use curve::{Curve, OddPowerCurve, QuantityGradient, StackShape, bspline};
pub use error::Error;
pub use material::{
    Elastic, HalfSpace, Material, Normalisation, Parameter, Probe, Profile, Quantities, Quantity,
    SubstratePoissonRatio, System,
};
pub use table::{Certificate, Description, LowRank, Table, Tile, chebyshev, is_packed, schema};
