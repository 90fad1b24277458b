//! Contacts with full friction: what touches the sphere never slides.
//!
//! The model without friction lets the surfaces slide freely; this is the other end of all laws of
//! friction. `compliances` has the three surface compliances of a film or a stack of layers,
//! `bodies` adds the sphere, and `transforms` has those of the functions in which the fields are expanded,
//! made of the wave functions of `coulomb`; `lattice` makes the matrix of their products. `field` solves one flat punch, for every Poisson ratio. A sphere needs
//! the punches of all smaller radii: `growth` is the Volterra equation along them, with the
//! quadrature of `integration`, where Dundurs' beta of sphere and film is 0. `sticking` solves both
//! to a tolerance, and `curve` makes the curves that a `contact::Contact` takes.
//!
//! ```
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! use contact::{Contact, Control};
//! use interp::{Elastic, Probe, System};
//! use solve::stick::{StickCurves, Sticking};
//!
//! // A gel of 10 um on glass under a rigid sphere of 100 um.
//! let system = System {
//!     probe: Probe::Paraboloid { radius: 1e-4 },
//!     sphere_modulus: f64::INFINITY,
//!     film: Elastic::new(1e4, 0.5)?,
//!     film_thickness: 1e-5,
//!     substrate: Elastic::new(f64::INFINITY, 0.0)?,
//! };
//! let sticking = Sticking::on_film(&system.material()?, 0.5)?;
//!
//! // A wide contact is stiffer by some 37 % than one that slides.
//! println!("{:.3}", sticking.stiffening(2.0, 1e-6)?);
//!
//! // Pull-off with one work of adhesion.
//! let curves = StickCurves::new(&sticking, [1e-3, 20.0], 1e-8)?;
//! let contact = Contact::new(&system, curves.receding(1.0)?)?;
//! println!("{:.3e} N", contact.pull_off(1e-3, Control::Load)?.load);
//! # Ok(()) }
//! ```
//!
//! Partial slip, between no friction and full friction, is not modelled, nor what slip dissipates.

mod bodies;
mod compliances;
mod coulomb;
mod curve;
mod field;
mod growth;
pub(crate) mod integration;
mod lattice;
mod sticking;
mod transforms;

pub use curve::StickCurves;
pub use growth::Grown;
pub use sticking::{
    GrownContact, MOST_OF_PUNCH, MOST_OF_TIP, PUNCH_TOLERANCE, StickPunch, Sticking, TIP_EXPONENTS,
    TIP_TOLERANCE,
};
