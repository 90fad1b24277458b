//! Materials, systems and contacts that many tests use.

use contact::Contact;
use interp::{Elastic, HalfSpace, Material, Probe, Quantities, System, Table};

use crate::solid;

/// Returns the material `[e1_over_e2, nu1, e0_over_e2, nu0]`.
pub fn material([e1_over_e2, nu1, e0_over_e2, nu0]: [f64; 4]) -> Material {
    Material::new(e1_over_e2, nu1, e0_over_e2, nu0).expect("the tests' materials are physical")
}

/// Returns the system of Barthel's Tables 1 and 2 with a film of thickness `film_thickness` (m).
pub fn paper_system(film_thickness: f64) -> System {
    System {
        probe: Probe::Paraboloid { radius: 1e-3 },
        sphere_modulus: 2e6,
        film: solid(3.5e6, 0.5),
        film_thickness,
        substrate: solid(2e11, 0.25),
    }
}

/// Returns a `probe` of a reduced modulus on a `film` of thickness `film_thickness` (m) on a `substrate`.
pub const fn system_of(
    probe: Probe,
    sphere_modulus: f64,
    film: Elastic,
    film_thickness: f64,
    substrate: Elastic,
) -> System {
    System {
        probe,
        sphere_modulus,
        film,
        film_thickness,
        substrate,
    }
}

/// Returns a rigid `probe` on a `film` of thickness `film_thickness` (m) on a `substrate`.
pub const fn rigid_probe(
    probe: Probe,
    film: Elastic,
    film_thickness: f64,
    substrate: Elastic,
) -> System {
    system_of(probe, f64::INFINITY, film, film_thickness, substrate)
}

/// Returns a rigid sphere, as a paraboloid, on a film of a thickness (m) on a substrate, both given by Young's modulus (Pa) and
/// Poisson ratio.
pub fn rigid_sphere(
    radius: f64,
    film: [f64; 2],
    film_thickness: f64,
    substrate: [f64; 2],
) -> System {
    let [film, substrate] = [film, substrate].map(|[young, poisson]| solid(young, poisson));
    rigid_probe(
        Probe::Paraboloid { radius },
        film,
        film_thickness,
        substrate,
    )
}

/// Returns a `probe` of a reduced modulus on a half-space.
pub const fn half_space_of(probe: Probe, sphere_modulus: f64, solid: Elastic) -> HalfSpace {
    HalfSpace {
        probe,
        sphere_modulus,
        solid,
    }
}

/// Returns the contact of a rigid `probe` with a half-space.
#[track_caller]
pub fn on_half_space(probe: Probe, solid: Elastic) -> Contact {
    let system = half_space_of(probe, f64::INFINITY, solid);
    Contact::half_space(&system).unwrap_or_else(|e| panic!("{e}"))
}

/// Solves a contact at `x = a/t` to a `tolerance`.
#[track_caller]
pub fn solved(x: f64, material: &Material, tolerance: f64) -> Quantities {
    let solution = solve::solve(x, material, tolerance);
    solution.unwrap_or_else(|e| panic!("{e}")).quantities
}

/// Looks up the contact of a system in the embedded table.
pub fn looked_up(system: &System) -> Contact {
    Contact::in_table(Table::embedded(), system).unwrap_or_else(|e| panic!("{e}"))
}

/// Solves the contact of a system for `a/t` in a `range`, to a `tolerance`.
pub fn solved_contact(system: &System, range: [f64; 2], tolerance: f64) -> Contact {
    let material = system.material().unwrap_or_else(|e| panic!("{e}"));
    let curve = solve::curve(&material, range, tolerance).unwrap_or_else(|e| panic!("{e}"));
    Contact::new(system, curve).unwrap_or_else(|e| panic!("{e}"))
}
