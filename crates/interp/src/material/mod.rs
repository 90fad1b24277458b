//! What touches what: sphere, film and substrate in SI units, and the dimensionless material that
//! they make.
//!
//! [`System`] (SI) becomes a [`Material`] (four ratios); the [`Parameter`]s are these ratios with
//! `a/t`, the [`Quantity`] the functions of them that the model needs. `equivalence` moves a
//! material to a substrate with another Poisson ratio. Everything else in this crate depends on
//! this folder, and it depends on nothing but the errors.

pub(crate) mod equivalence;
mod material;
mod parameter;
mod quantity;
pub(crate) mod system;

pub(crate) use material::{ROUNDING, one_minus_square, poisson_ratio};

pub use material::{Material, Normalisation};
pub use parameter::Parameter;
pub use quantity::{Quantities, Quantity};
pub use system::{Elastic, HalfSpace, System};
