//! One contact, solved: from a material and `a/t` to the four quantities with an estimate of their
//! error.
//!
//! `compliance` is the film on its substrate, `symbol` adds the sphere. `solve` chooses the method:
//! `galerkin` (with `bessel` and `quadrature`) for thick films, `wiener_hopf` (with `contour` and
//! `krylov`) for thin ones; all return what `estimate` defines. `batch` solves many materials at
//! one `a/t`, `adaptive_curve` one material at all `a/t`.

mod adaptive_curve;
pub(crate) mod batch;
mod bessel;
mod compliance;
mod contour;
mod estimate;
mod galerkin;
mod krylov;
mod quadrature;
mod solve;
mod symbol;
mod wiener_hopf;

pub use adaptive_curve::{CURVE_TOLERANCE, curve};
pub use compliance::{Compliance, Sample};
pub(crate) use quadrature::{GaussLegendre, Panels};
pub use solve::{A_OVER_T, E0_OVER_E2, E1_OVER_E2, Method, Solution, TOLERANCE, solve};
