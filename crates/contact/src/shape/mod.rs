//! The contact without adhesion, the only part of the model that knows the shape of the probe.
//!
//! A shape gives the load `F0(a)` and the penetration `delta0(a)` of a contact of radius `a`
//! without adhesion; `F0' = S delta0'`. `transform` holds its transform `b(s)`, which is all that
//! is needed on a half-space.
//!
//! On a film, `even_powers` of the radius and the sphere follow from the curve of the material by
//! integrals. For all other shapes `field` computes the stress of the flat punch at all smaller radii
//! from the `Gamma` of a `medium`, and `solved` integrates the shape over it; `polynomial` serves both.

mod even_powers;
mod field;
mod legendre;
mod medium;
mod modes;
mod moments;
mod polynomial;
mod shape;
mod solved;
pub(super) mod transform;

pub(super) use self::shape::Shape;
