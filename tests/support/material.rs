//! Materials and systems that many tests use.

use interp::{Elastic, Material, Probe, System};

/// Returns the material `[e1_over_e2, nu1, e0_over_e2, nu0]`.
///
/// # Panics
/// If it is not physical.
pub fn material([e1_over_e2, nu1, e0_over_e2, nu0]: [f64; 4]) -> Material {
    Material::new(e1_over_e2, nu1, e0_over_e2, nu0).expect("the tests' materials are physical")
}

/// Returns the system of Barthel's Tables 1 and 2 with a film of thickness `film_thickness` (m).
pub fn paper_system(film_thickness: f64) -> System {
    let solid = |young, poisson| Elastic::new(young, poisson).expect("physical");
    System {
        probe: Probe::Paraboloid { radius: 1e-3 },
        sphere_modulus: 2e6,
        film: solid(3.5e6, 0.5),
        film_thickness,
        substrate: solid(2e11, 0.25),
    }
}
