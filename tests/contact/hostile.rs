//! Contacts asked with hostile arguments.

use acceptance::{paper_system, solid};
use contact::Error;
use contact::{Contact, Control};
use interp::{HalfSpace, Probe, Quantity, System, Table};

use crate::contact::{bare, coated, half_space};

#[test]
fn every_function_answers_any_number_with_a_finite_result_or_an_error() {
    let hostile = [
        f64::NAN,
        f64::INFINITY,
        f64::NEG_INFINITY,
        0.0,
        -0.0,
        -1.0,
        -1e-4,
        -1e-9,
        -f64::MAX,
        5e-324,
        f64::MIN_POSITIVE,
        1e-150,
        1e-30,
        1e-9,
        5e-5,
        0.04,
        1.0,
        1e30,
        1e150,
        f64::MAX,
    ];
    let pairs = || hostile.into_iter().flat_map(|a| hostile.map(|b| (a, b)));
    let held = |values: &[f64], what: &str| {
        assert!(
            values.iter().all(|value| value.is_finite()),
            "{what}: {values:?}"
        )
    };
    let absurd = |r, e| {
        Contact::half_space(&HalfSpace {
            probe: Probe::Paraboloid { radius: r },
            sphere_modulus: e,
            ..bare()
        })
    };
    let mut systems = vec![coated(1e-5), half_space()];
    for (r, e) in pairs() {
        systems.extend(absurd(r, e));
        let system = System {
            probe: Probe::Paraboloid { radius: r },
            ..paper_system(e)
        };
        systems.extend(Contact::in_table(Table::embedded(), &system));
    }
    println!("{} systems", systems.len());
    let mut answered = 0;
    for contact in &systems {
        for a in hostile {
            answered += usize::from(contact.stiffness(a).is_ok_and(f64::is_finite));
            contact
                .quantities(a)
                .into_iter()
                .for_each(|q| held(&q.to_array(), "quantities"));
            contact.validity(a).into_iter().for_each(|v| {
                held(
                    &[
                        v.a_over_r,
                        v.film.map_or(0.0, |f| f.a_over_t * f.compressibility),
                    ],
                    "validity",
                )
            });
        }
    }
    // All pairs on the sound two, some on the absurd ones.
    for (i, contact) in systems.iter().enumerate() {
        for (j, (a, b)) in pairs().enumerate() {
            if i >= 2 && (7 * i + j) % 41 != 0 {
                continue;
            }
            contact
                .load(a, b)
                .into_iter()
                .for_each(|f| held(&[f], "load"));
            contact
                .load_and_penetration(a, b)
                .into_iter()
                .for_each(|(f, d)| held(&[f, d], "load and penetration"));
            contact
                .stress_intensity(a, b)
                .into_iter()
                .for_each(|k| held(&[k], "stress intensity"));
            contact
                .energy_release_rate_at_load(a, b)
                .into_iter()
                .for_each(|g| held(&[g], "G from a and F"));
            contact
                .energy_release_rate_at_penetration(a, b)
                .into_iter()
                .for_each(|g| held(&[g], "G from a and delta"));
            contact
                .radius_and_energy_release_rate(a, b)
                .into_iter()
                .for_each(|(a, g)| held(&[a, g], "from F and delta"));
            contact
                .zone_size(a, b)
                .into_iter()
                .for_each(|range| held(&[range.tabor, range.cohesive_zone], "range"));
            contact
                .zero_load(a)
                .into_iter()
                .for_each(|s| held(&[s.contact_radius, s.load, s.penetration], "zero load"));
            contact
                .jkr_fit(0.04, [a, b], 5)
                .into_iter()
                .for_each(|fit| held(&[fit.modulus, fit.intercept], "fit"));
            contact
                .jkr_fit(a, [1e-5, b], 5)
                .into_iter()
                .for_each(|fit| held(&[fit.modulus, fit.intercept], "fit"));
            let _ = contact.film_bias(a, [1e-5, b], 3);
            for control in [
                Control::Load,
                Control::Displacement,
                Control::Spring { stiffness: a },
                Control::Spring { stiffness: 1.0 },
            ] {
                let Ok(equilibria) = contact.equilibria(b, control) else {
                    continue;
                };
                let states = [
                    equilibria.pull_off(),
                    equilibria.loading(a),
                    equilibria.unloading(a),
                ]
                .into_iter()
                .flatten();
                let branches = equilibria
                    .force_displacement(a, 3)
                    .into_iter()
                    .flat_map(|curve| [curve.loading, curve.unloading].concat());
                let found = equilibria
                    .at(a)
                    .into_iter()
                    .flatten()
                    .map(|equilibrium| equilibrium.state);
                for state in states.chain(branches.flatten()).chain(found) {
                    held(
                        &[state.contact_radius, state.load, state.penetration],
                        "state",
                    );
                    answered += 1;
                }
            }
        }
    }
    println!("{answered} answers");
    assert!(answered > 1000);
}

#[test]
fn numbers_out_of_bounds_are_named() {
    let contact = half_space();
    let assert_names = |result: Result<(), Error>, name: &str, value: f64| match result {
        Err(error @ Error::Table(interp::Error::Unphysical { allowed, .. })) => {
            acceptance::assert_names(&error.to_string(), &[name, &format!("{value:?}"), allowed])
        }
        other => panic!("{name} = {value}: {other:?}"),
    };
    for a in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert_names(contact.load(a, 0.04).map(drop), "contact radius", a);
        assert_names(
            contact.load_and_penetration(a, 0.04).map(drop),
            "contact radius",
            a,
        );
        assert_names(contact.validity(a).map(drop), "contact radius", a);
        assert_names(contact.stiffness(a).map(drop), "contact radius", a);
    }
    // A load that overflows.
    let planet = Contact::half_space(&HalfSpace {
        probe: Probe::Paraboloid { radius: 1e300 },
        ..bare()
    });
    let planet = planet.expect("physical");
    assert_names(planet.load(1e200, 0.04).map(drop), "contact radius", 1e200);
    let both = planet.load_and_penetration(1e200, 0.04).map(drop);
    assert_names(both, "contact radius", 1e200);
    for w in [-1.0, f64::NAN, f64::INFINITY] {
        assert_names(
            contact.equilibria(w, Control::Load).map(drop),
            "work of adhesion",
            w,
        );
        assert_names(
            contact.film_bias(w, [1e-5, 1e-4], 5).map(drop),
            "work of adhesion",
            w,
        );
        assert_names(contact.zone_size(w, 1e-9).map(drop), "work of adhesion", w);
        assert_names(contact.zone_size(0.04, w).map(drop), "interaction range", w);
        let equilibria = contact
            .equilibria(0.04, Control::Displacement)
            .expect("physical");
        if !w.is_finite() {
            assert_names(equilibria.at(w).map(drop), "penetration", w);
            assert_names(
                contact.radius_and_energy_release_rate(w, 0.0).map(drop),
                "load",
                w,
            );
            assert_names(
                contact.radius_and_energy_release_rate(0.0, w).map(drop),
                "penetration",
                w,
            );
        }
    }
    for stiffness in [0.0, -1.0, 1e-101, 1e101, f64::NAN, f64::INFINITY] {
        assert_names(
            contact
                .equilibria(0.04, Control::Spring { stiffness })
                .map(drop),
            "stiffness of the spring",
            stiffness,
        );
    }
    let system = bare();
    for value in [0.0, -1.0, f64::NAN] {
        assert_names(
            Contact::half_space(&HalfSpace {
                probe: Probe::Paraboloid { radius: value },
                ..system.clone()
            })
            .map(drop),
            "sphere_radius",
            value,
        );
        assert_names(
            Contact::half_space(&HalfSpace {
                sphere_modulus: value,
                ..system.clone()
            })
            .map(drop),
            "sphere_modulus",
            value,
        );
    }
    let rigid = HalfSpace {
        sphere_modulus: f64::INFINITY,
        solid: solid(f64::INFINITY, 0.3),
        ..system.clone()
    };
    assert_names(
        Contact::half_space(&rigid).map(drop),
        "sphere_modulus",
        f64::INFINITY,
    );
    assert!(contact.curve().is_none() && contact.system().is_none());
    assert_eq!(
        contact.contact_radius_range(),
        [
            0.0,
            (1.0 - 1e-12) * system.probe.radius().expect("a paraboloid")
        ]
    );
    assert_eq!(
        contact
            .quantities(1e-5)
            .expect("any radius")
            .get(Quantity::Delta0),
        1.0
    );
}
