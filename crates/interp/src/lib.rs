//! Adhesive contact of a sphere on a coated substrate, from a precomputed table.
//!
//! A sphere (body 2) touches a film (1) bonded to a substrate (0) and sticks to it. Barthel's
//! model, *Adhesive contact of a compliant sphere to an elastic coated substrate: the thin film
//! limit*, needs four dimensionless functions of (`a/t`, `E1/E2`, `nu1`, `E0/E2`), the
//! [`Quantities`]. They are tabulated once, by the crate `tabulate`; this crate interpolates them
//! and does the arithmetic of eqs. 2 to 9. All units are SI, loads are positive in compression,
//! penetrations positive when the sphere is in.
//!
//! # From a system to its pull-off
//!
//! ```
//! # #[cfg(feature = "embedded")]
//! # fn main() -> Result<(), interp::Error> {
//! use interp::{Control, Elastic, System, Table};
//!
//! // What touches what: a sphere of 1 mm and E2* = 2 MPa, an incompressible film of 10 um, a substrate that hardly yields.
//! let film = Elastic::new(3.5e6, 0.5)?; // Young's modulus (Pa), Poisson ratio
//! let substrate = Elastic::new(2e11, 0.25)?;
//! let system = System { sphere_radius: 1e-3, sphere_modulus: 2e6, film, film_thickness: 1e-5, substrate };
//!
//! // Its material is looked up once; all that follows is arithmetic.
//! let contact = Table::embedded().contact(&system)?;
//! let w = 0.040; // work of adhesion, J/m^2
//! for a in [40e-6, 65e-6, 90e-6] {
//!     let (load, penetration) = contact.load_and_penetration(a, w)?;
//!     println!("{a:e} m: {load:e} N, {penetration:e} m");
//! }
//!
//! // It separates under a larger pull than without the film, where it would be 1.5 pi w R.
//! let pull_off = contact.pull_off(w, Control::Load)?;
//! assert!((pull_off.load / (std::f64::consts::PI * w * system.sphere_radius) + 1.5401).abs() < 1e-4);
//! # Ok(()) }
//! # #[cfg(not(feature = "embedded"))]
//! # fn main() {}
//! ```
//!
//! # Where the quantities come from
//!
//! * `Table::embedded` (feature `embedded`) is the table that comes with the crate; [`Table::read`]
//!   (packed) and `Table::open` (HDF5, feature `hdf5`) load another.
//! * [`Table::curve`] makes the [`Curve`] of one [`Material`]: the quantities as functions of
//!   `a/t`. [`Table::contact`] makes the [`Contact`] of one [`System`]. Another Poisson ratio of
//!   the substrate than the table's is exact, by Dundurs' equivalence.
//! * [`Table::curve_with_gradient`] and [`Table::contact_with_gradient`] make them with derivatives
//!   with respect to all that they depend on: [`Curve::gradient`], [`Contact::gradient`].
//! * [`Curve::through`] and [`Contact::new`] need no table, but quantities solved elsewhere;
//!   [`Contact::half_space`] is JKR, without a film.
//!
//! # What a contact answers
//!
//! * [`Contact::load`], [`Contact::load_and_penetration`], [`Contact::stiffness`],
//!   [`Contact::stress_intensity`] at a contact radius.
//! * [`Contact::equilibria`]: the contacts at a load, a penetration or the position of a spring
//!   ([`Control`]) with their stability, and whole force-displacement curves with their jumps
//!   ([`Equilibria::force_displacement`]); [`Contact::pull_off`] and [`Contact::zero_load`] of
//!   them.
//! * [`Contact::energy_release_rate_at_load`], [`Contact::energy_release_rate_at_penetration`] and
//!   [`Contact::radius_and_energy_release_rate`] from any two measured values, without a work of
//!   adhesion.
//! * [`Contact::film_bias`]: whether the film matters to a fit of JKR. [`Contact::validity`] and
//!   [`Contact::adhesion_range`]: whether the model holds.
//! * [`Contact::line`] moves the contact line by a [`CrackTip`] law, of which eq. 8 is the
//!   simplest: different energies for an advancing and a receding line ([`Hysteresis`]), or
//!   energies that depend on its speed ([`RateDependent`]); slowly ([`ContactLine::impose`]), or in
//!   time (`ContactLine::ramp`, feature `dynamics`).
//!
//! # Outside the table
//!
//! No value is clamped. A material outside the table's box is an [`Error`] with the axis, the value
//! and the range (but for rounding, 1e-12). Beyond its `a/t` there are the first terms of the
//! expansions about the exact limits, thick and thin film, where their estimated error
//! ([`Curve::error`]) is within the table's tolerance, and an error elsewhere. On thick films they
//! have derivatives, too, and states are sought down to a radius of 0; above the nodes there are
//! neither. Any f64 gives finite numbers or an error, never a panic.
//!
//! # Features
//!
//! | feature | adds |
//! |---|---|
//! | `embedded` (default) | `Table::embedded`, 0.45 MB in the program |
//! | `hdf5` | `Table::open`, without a C library |
//! | `dynamics` | `ContactLine::ramp`: contact lines that move at a finite speed |
//!
//! Rust 1.89 or newer. The crate needs `std`, for files and for what a table makes when it is first
//! used.

#![forbid(unsafe_code)]

mod contact;
mod curve;
mod error;
mod material;
mod table;

#[cfg(feature = "dynamics")]
pub use contact::TimedState;
pub use contact::{AdhesionRange, FilmValidity, Validity};
pub use contact::{Contact, ContactGradient, Derivatives, Input, State};
pub use contact::{ContactLine, CrackTip, Hysteresis, RateDependent};
pub use contact::{Control, Equilibria, Equilibrium, ForceDisplacement, Jump};
pub use contact::{FilmBias, JkrFit, JkrPoint, Mechanics};
pub use curve::{Curve, QuantityGradient, bspline};
pub use error::Error;
pub use material::{
    Elastic, HalfSpace, Material, Normalisation, Parameter, Quantities, Quantity, System,
};
pub use table::{Certificate, Description, LowRank, Table, is_packed, schema};
