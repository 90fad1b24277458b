//! The README's program.
use interp::{Elastic, System, Table};

fn main() -> Result<(), interp::Error> {
    let table = Table::embedded(); // a/t and E1/E2* from 1e-3 to 1e3, nu1 from 0 to 0.5, E0/E2* from 1 to 1e6
    let (film, substrate) = (Elastic::new(3.5e6, 0.5)?, Elastic::new(2e11, 0.25)?); // Young's modulus (Pa), Poisson ratio
    let system = System {
        sphere_radius: 1e-3,
        sphere_modulus: 2e6,
        film,
        film_thickness: 1e-6,
        substrate,
    };
    println!("{:.3e} N", table.contact(&system)?.load(65e-6, 0.040)?); // contact radius (m), work of adhesion (J/m^2)
    Ok(())
}
