//! The embedded table answers every system of a catalogue of the laboratory: load and penetration
//! from independent direct solves, in `tests/data/systems.csv`.

use acceptance::{Data, solid, system_of};
use contact::Contact;
use interp::{Probe, Table};

/// Errors are relative to the sums of the sizes of the two terms of eq. 9, which may cancel. The
/// table's tolerance is 1e-6.
#[test]
fn every_system_of_the_catalogue_is_answered() {
    const TOLERANCE: f64 = 1e-6;
    let systems = Data::read("systems");
    let mut worst = [0.0_f64; 2];
    for case in systems.cases() {
        let elastic = |body: &str| {
            let [modulus, poisson] = ["modulus", "poisson_ratio"]
                .map(|property| case.get(&format!("{body}_{property}")));
            solid(modulus, poisson)
        };
        let system = system_of(
            Probe::Paraboloid {
                radius: case.get("sphere_radius"),
            },
            case.get("sphere_modulus"),
            elastic("film"),
            case.get("film_thickness"),
            elastic("substrate"),
        );
        let (a, w) = (case.get("contact_radius"), case.get("work_of_adhesion"));
        let (load, penetration) = Contact::in_table(Table::embedded(), &system)
            .and_then(|contact| contact.load_and_penetration(a, w))
            .unwrap_or_else(|error| panic!("{system:?} at {a}: {error}"));
        let error = |found: f64, name: &str| {
            (found - case.get(name)).abs() / case.get(&format!("{name}_scale"))
        };
        let errors = [error(load, "load"), error(penetration, "penetration")];
        assert!(
            errors.iter().all(|error| *error <= TOLERANCE),
            "{system:?} at {a}: {errors:?}"
        );
        worst = [worst[0].max(errors[0]), worst[1].max(errors[1])];
    }
    println!("largest errors of load and penetration: {worst:?}");
}
