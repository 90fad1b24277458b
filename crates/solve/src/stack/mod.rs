//! Stacks of layers on an elastic or rigid base.
//!
//! Layers are counted from the base up: layer 1 is on the base, and the last one is what the sphere
//! touches. Each layer is bonded to what lies below it, slides on it, or is joined to it by springs:
//! its [`Interface`]. `a/t` of a stack is the contact radius over the sum of all thicknesses.
//!
//! ```
//! # fn main() -> Result<(), solve::Error> {
//! use interp::Elastic;
//! use contact::Contact;
//! use solve::stack::{Interface, Layer, Stack};
//!
//! let primer = Layer::bonded(Elastic::new(0.5e6, 0.5)?, 2.5e-6);
//! let elastomer = Layer::bonded(Elastic::new(3.5e6, 0.5)?, 7.5e-6);
//! let stack = Stack::new(Elastic::new(2e11, 0.25)?, [primer, elastomer])?;
//!
//! // Sphere of reduced modulus 2 MPa; a/t of 6.5; relative tolerance 1e-8.
//! let solution = solve::solve_stack(6.5, &stack, 2e6, 1e-8)?;
//! assert!(solution.error <= 1e-8);
//!
//! // The curve from a/t of 0.1 to 10, and a contact of a sphere of 1 mm: 65 um, 0.04 J/m^2.
//! let curve = solve::stack_curve(&stack, 2e6, [0.1, 10.0], 1e-8)?;
//! let contact = Contact::new(&stack.system(1e-3, 2e6), curve)?;
//! println!("{:.3e} N", contact.load(65e-6, 0.04)?);
//!
//! // The elastomer alone, on a lubricant: it slides on the base.
//! let sliding = Layer { interface: Interface::Sliding, ..elastomer };
//! let film = Stack::new(Elastic::new(2e11, 0.25)?, [sliding])?;
//! let softer = solve::solve_stack(6.5, &film, 2e6, 1e-8)?;
//! assert!(softer.quantities.eeq < solution.quantities.eeq);
//! # Ok(()) }
//! ```
//!
//! # What changes, and what does not
//!
//! The layers enter through the surface compliance `X(kt)` alone (the page `layered.rs` of the source
//! derives it). With `X` relative to the top layer, Barthel's equations hold as they
//! stand, and so do the definitions of the four quantities. `E1*` is the reduced modulus of the top
//! layer and `E0*` that of the base:
//!
//! ```text
//! es = 1/(1 + E2*/E1*)    crack tip, and a/t -> 0          einf = 1/(1 + E2*/E0*)    a/t -> inf
//! ```
//!
//! Under a rigid sphere the unit of the quantities is `E1*` of the top layer.
//!
//! # What a contact answers
//!
//! [`contact::Contact`] answers for a stack all that it answers for a film: loads, equilibria,
//! pull-off, energy release rates, crack-tip laws, JKR fits. `film_bias` is relative to the bare
//! base. Under another probe than a paraboloid or a flat punch the curve must begin at a small part of the thickness of
//! the *top layer*, a hundredth or less. Three answers differ. A curve of a stack has no expansions beyond its ends and no
//! derivatives with respect to the material: both are errors. The compressibility of `validity` is
//! that of all layers ([`Stack::compressibility`]), and NaN where an interface is not bonded.
//! `cohesive_zone` and `pull_off_error` demand that the cohesive zone be short beside the *top
//! layer*, whose modulus it is computed with.
//!
//! # Reach
//!
//! Stacks are solved by Galerkin's method, whose cost grows with the contact radius over the
//! thickness of the *top* layer, `a/h`. It goes up to [`MOST_A_OVER_TOP`]. The method that serves
//! thinner films needs to know where the zeros and poles of the compliance lie. For one film they
//! are at least 53 degrees away from the real axis; for stacks, where they were found at 27
//! degrees, no bound is known, and a larger `a/h` is refused. A stack that is in fact a single film
//! (all layers of one material, or the lower ones of that of the base, bonded to each other) is
//! solved as a film, without this limit.
//!
//! Measured (`tests/truth/stacks.rs`, 15 contacts up to `a/h` of 160, values by another program):
//! the errors of the quantities are at most 8e-15 at the tolerance 1e-12 and 3.4e-11 at 1e-8. With
//! interfaces that slide or have springs (33 contacts up to `a/h` of 200) they are at most 2.9e-14
//! and 2.6e-11, and 300 random contacts agree with another method of solution within the stated errors
//! (`tests/truth/interfaces.rs`).
//!
//! `cargo bench -p coated-contact-tabulate --bench stacks` prints times, here at the tolerance 1e-8 and on one
//! core. Three layers take 8 to 19 microseconds up to `a/h` of 10, which is 1.5 to 1.9 times the
//! time of one film, and 60 microseconds at `a/h` of 30, where one film takes 13 by the other
//! method. A curve of 200 layers up to `a/h` of 200 takes 9 ms: the compliance of many layers is
//! sampled once. A curve of one film that slides takes 1 ms from `a/t` of 0.01 to 10, and 8 ms from
//! 0.1 to 100. In the sweep of a table, a further sphere takes a seventh of the time of the first
//! one at `a/h` of 9, because the spheres share matrices.

mod interface;
mod layers;

pub use interface::Interface;
pub use layers::{LARGEST_CONTRAST, Layer, MOST_A_OVER_TOP, SOFTEST_SPRINGS, Stack};
