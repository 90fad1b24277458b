//! Prints the load of one contact from direct solves, without a table.
//!
//! Run it by `cargo run --release -p coated-contact-solve --example curve`.

use contact::Contact;
use interp::{Elastic, Probe, System};

fn main() -> Result<(), solve::Error> {
    let system = System {
        probe: Probe::Paraboloid { radius: 1e-3 }, // m
        sphere_modulus: 2e6,                       // reduced modulus E2*, Pa
        film: Elastic::new(3.5e6, 0.5)?,           // Young's modulus (Pa), Poisson ratio
        film_thickness: 1e-6,                      // m
        substrate: Elastic::new(2e11, 0.25)?,      // Young's modulus (Pa), Poisson ratio
    };
    // The curve of the material for a/t from 1e-3 to 1e3, with a relative tolerance of 1e-8.
    let curve = solve::curve(&system.material()?, [1e-3, 1e3], 1e-8)?;
    // Contact radius (m), work of adhesion (J/m^2).
    let load = Contact::new(&system, curve)?.load(65e-6, 0.040)?;
    println!("{load:.3e} N");
    Ok(())
}
