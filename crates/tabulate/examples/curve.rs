//! The README's program, with a curve from direct solves in place of a table.
use interp::{Contact, Elastic, System};

fn main() -> Result<(), tabulate::Error> {
    let (film, substrate) = (Elastic::new(3.5e6, 0.5)?, Elastic::new(2e11, 0.25)?);
    let system = System {
        sphere_radius: 1e-3,
        sphere_modulus: 2e6,
        film,
        film_thickness: 1e-6,
        substrate,
    };
    let curve = tabulate::curve(&system.material()?, [1e-3, 1e3], 1e-8)?; // a/t from, to; relative tolerance
    println!(
        "{:.3e} N",
        Contact::new(&system, curve)?.load(65e-6, 0.040)?
    );
    Ok(())
}
