//! Prints the load of a sphere of 1 mm on a film of 1 um at one contact radius, from the embedded
//! table: `cargo run --release -p coated-contact-interp --example force`.
use interp::{Elastic, ForceCurve, Probe, System, Table};

fn main() -> Result<(), interp::Error> {
    let system = System {
        probe: Probe::Paraboloid { radius: 1e-3 }, // all in SI units
        sphere_modulus: 2e6,                       // the reduced modulus E2*
        film: Elastic::new(3.5e6, 0.5)?,           // Young's modulus, Poisson ratio
        film_thickness: 1e-6,
        substrate: Elastic::new(2e11, 0.25)?,
    };
    let curve = ForceCurve::in_table(Table::embedded(), &system)?;
    println!("{:.3e} N", curve.load(65e-6, 0.040)?); // contact radius, work of adhesion
    Ok(())
}
