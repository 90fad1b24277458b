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
//! * [`Curve::through`] and [`Contact::new`] make them without a table, from quantities solved elsewhere.
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
//! No numerics happen here, no value is clamped and none is extrapolated: outside the table or curve, but for rounding (1e-12), there is an
//! [`Error`] with the axis, the value and the range.

#![forbid(unsafe_code)]

mod beyond;
mod certificate;
mod contact;
mod curve;
#[cfg(feature = "embedded")]
mod embedded;
mod error;
#[cfg(feature = "hdf5")]
mod h5;
mod lookup;
mod low_rank;
mod material;
mod pack;
mod pieces;
mod quantity;
mod rows;
pub mod schema;
mod sensitivity;
pub mod spline;
mod table;
mod train;

pub use certificate::{Certificate, Details};
pub use contact::{Contact, Elastic, JkrPoint, Mechanics, System};
pub use curve::Curve;
pub use error::Error;
pub use low_rank::LowRank;
pub use material::{Material, Normalisation};
pub use pack::is_packed;
pub use quantity::{Quantities, Quantity};
pub use sensitivity::Gradient;
pub use table::{Description, Table};
