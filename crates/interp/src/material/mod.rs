//! The bodies in contact, in SI units, and the dimensionless material that they make.
//!
//! A [`System`] of [`Probe`], film and substrate (SI units) becomes a [`Material`] of four ratios. The
//! [`Parameter`]s are three of these ratios and `a/t`. A [`Quantity`] is a function of the
//! parameters that the model needs. `equivalence` moves a material to a substrate with another
//! Poisson ratio. This folder depends only on the errors; every other folder depends on it.

pub(crate) mod equivalence;
mod material;
mod material_parameter;
mod parameter;
mod probe;
mod profile;
mod quantity;
pub(crate) mod system;

pub(crate) use material::{ROUNDING, one_minus_square, poisson_ratio};

pub use equivalence::SubstratePoissonRatio;
pub use material::{Material, Normalisation};
pub use material_parameter::MaterialParameter;
pub use parameter::Parameter;
pub use probe::Probe;
pub use profile::Profile;
pub use quantity::{Quantities, Quantity};
pub use system::{Elastic, HalfSpace, System};
