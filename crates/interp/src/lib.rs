//! Barthel's four functions from a precomputed table, and eq. 9 force curves from them.
//!
//! A sphere (body 2) touches a film (1) bonded to a substrate (0) and adheres to it. Barthel's
//! model, *Adhesive contact of a compliant sphere to an elastic coated substrate: the thin film
//! limit*, needs four dimensionless functions of (`a/t`, `E1/E2*`, `nu1`, `E0/E2*`), the
//! [`Quantities`]. The crate `tabulate` computes them once for a table. This crate interpolates the
//! table and evaluates eqs. 2 to 9 of the model. All units are SI. Loads are positive in
//! compression; penetrations are positive when the sphere is below the undeformed surface.
//!
//! ```
//! # #[cfg(feature = "embedded")]
//! # fn main() -> Result<(), interp::Error> {
//! use interp::{Elastic, ForceCurve, Probe, System, Table};
//!
//! // A sphere of 1 mm and E2* = 2 MPa, an incompressible film of 10 um, a stiff substrate.
//! let system = System {
//!     probe: Probe::Paraboloid { radius: 1e-3 },
//!     sphere_modulus: 2e6,
//!     film: Elastic::new(3.5e6, 0.5)?, // Young's modulus (Pa), Poisson ratio
//!     film_thickness: 1e-5,
//!     substrate: Elastic::new(2e11, 0.25)?,
//! };
//!
//! // The material is looked up once. Everything after this is arithmetic.
//! let curve = ForceCurve::in_table(Table::embedded(), &system)?;
//! let w = 0.040; // work of adhesion, J/m^2
//! for a in [40e-6, 65e-6, 90e-6] {
//!     let (load, penetration) = curve.load_and_penetration(a, w)?;
//!     println!("{a:e} m: {load:e} N, {penetration:e} m");
//! }
//! # Ok(()) }
//! # #[cfg(not(feature = "embedded"))]
//! # fn main() {}
//! ```
//!
//! # Tables, curves and force curves
//!
//! * `Table::embedded` (feature `embedded`) is the table that comes with the crate. [`Table::read`]
//!   (packed) and `Table::open` (HDF5, feature `hdf5`) load another one.
//! * [`Table::curve`] makes the [`Curve`] of one [`Material`]: the quantities as functions of
//!   `a/t`. The Poisson ratios may differ from the table's: Dundurs' equivalence is exact.
//!   [`Table::curve_with_gradient`] adds the derivatives with respect to every parameter,
//!   [`Table::curve_with_derivatives`] some of them: [`Curve::gradient`].
//! * [`Curve::through`] uses quantities solved elsewhere in place of a table, and
//!   [`Curve::spline`] converts a curve to a spline of the crate `splines`, for other programs.
//! * [`ForceCurve`] is eq. 9 for one [`System`] in SI units. [`Mechanics`] is its arithmetic.
//!
//! The crate `contact` answers what else is asked of a contact: probes of other shapes, equilibria,
//! pull-off, derivatives, moving contact lines.
//!
//! # Outside the table
//!
//! No value is clamped. A material outside the table's box (by more than rounding, 1e-12) is an
//! [`Error`] with the axis, the value and the range. Beyond the `a/t` of the nodes the first terms
//! of the expansions about the exact limits, thick and thin film, are used where their estimated
//! error ([`Curve::error`]) is within the table's tolerance; elsewhere there is an error. Below the
//! nodes (thick films) the expansions have derivatives, above them there are none. Any f64 gives
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

pub mod check;
mod curve;
mod error;
mod force_curve;
mod material;
mod mechanics;
mod table;

/// Values that are made at their first use, also in the child of a fork.
pub use low_rank::once;

pub use curve::{BelowNodes, Curve, QuantityGradient, StackShape};
pub use error::Error;
pub use force_curve::ForceCurve;
pub use material::{
    Elastic, HalfSpace, Material, MaterialParameter, Normalisation, Parameter, Probe, Profile,
    Quantities, Quantity, SubstratePoissonRatio, System,
};
pub use mechanics::{LoadAndPenetration, Mechanics};
pub use table::{Certificate, Description, Table, Tile, is_packed, schema};
