//! An attraction of finite range: a constant traction `sigma0` wherever the gap is below `z0`, in an
//! annulus around the contact.
//!
//! JKR lets the attraction act at a distance of 0. Here the work of adhesion is `w = sigma0 z0`
//! (Dugdale's law; Maugis, J. Colloid Interface Sci. 150, 243, 1992, solved the half-space). The
//! contact has the radius `a`, the traction acts in `a < r < c`, the gap is `z0` at `r = c`, and no
//! stress is singular. Everything else is as in the solver: the same kernel, any film and any stack of
//! layers. Long ranges give DMT's `-2 pi w R` as the pull-off load on every film, short ones JKR.
//!
//! `attraction` takes the bodies. `fixed_radius` solves one contact radius with any annulus
//! (`annulus`), linear in the curvature of the sphere and in the traction; `states` finds the outer
//! radius at which the gap is `z0`. `checks` refuses what would not be a contact, `before_contact` is
//! the attraction across a gap. `pull_off` looks for the minima of the imposed value (`search`) where
//! those of JKR (`jkr`) are, among contacts that have just begun, and before the contact.
//!
//! ```
//! # fn main() -> Result<(), solve::Error> {
//! use interp::{Elastic, Probe, System};
//! use contact::Control;
//! use solve::cohesive::Cohesive;
//!
//! let system = System {
//!     probe: Probe::Paraboloid { radius: 1e-5 },
//!     sphere_modulus: 7.5e10,
//!     film: Elastic::new(1e6, 0.5)?,
//!     film_thickness: 1e-6,
//!     substrate: Elastic::new(2e11, 0.25)?,
//! };
//! // 0.05 J/m^2, acting over 10 nm.
//! let cohesive = Cohesive::new(&system, None, 0.05, 10e-9)?;
//! let pull_off = cohesive.pull_off(Control::Load)?;
//! println!("{:.3e} N at a = {:.3e} m", pull_off.load, pull_off.contact_radius);
//! # Ok(()) }
//! ```
//!
//! # Accuracy
//!
//! Measured (`tests/truth/cohesive.rs`): load, penetration and outer radius of 24 contacts and 17
//! pull-offs within 4.4e-14 of values by two other programs, Maugis' closed form on a half-space
//! within 1.9e-14, and the energy balance `dU/d(delta) = F` within 2e-10.

mod annulus;
mod attraction;
mod before_contact;
mod checks;
mod fixed_radius;
mod jkr;
mod pull_off;
mod search;
mod states;
mod waves;

pub use attraction::{Cohesive, REACH, SMALLEST};
pub use contact::CohesiveState;
