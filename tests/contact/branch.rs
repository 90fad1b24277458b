//! States at many imposed values, and their derivatives at a fixed imposed value.

use std::f64::consts::PI;

use acceptance::{Contacts, assert_names, looked_up, paper_system, solid};
use contact::Error;
use contact::{Branch, Contact, Control, Derivatives, Input, State};
use interp::{HalfSpace, Probe, System, Table};

const SPRING: Control = Control::Spring { stiffness: 40.0 };

/// Returns systems of soft and rigid spheres on films from thin to thick.
fn systems() -> Vec<System> {
    let rigid = System {
        sphere_modulus: f64::INFINITY,
        film: solid(2e4, 0.45),
        ..paper_system(1e-4)
    };
    vec![
        paper_system(1e-6),
        paper_system(1e-5),
        paper_system(3e-4),
        rigid,
        System {
            film: solid(1e9, 0.3),
            ..paper_system(2e-5)
        },
    ]
}

#[test]
fn a_branch_holds_the_states_found_one_by_one() {
    for system in systems() {
        let contact = looked_up(&system);
        for (control, w) in [
            (Control::Load, 0.04),
            (Control::Displacement, 0.04),
            (SPRING, 0.04),
            (Control::Displacement, 0.0),
        ] {
            let equilibria = contact.equilibria(w, control).expect("a table to 0");
            let end = equilibria.pull_off().expect("in range");
            let (load, penetration) = contact.load_and_penetration(6e-4, w).expect("inside");
            let most = control.imposed(load, penetration);
            let least = control.imposed(end.load, end.penetration);
            for branch in [Branch::Loading, Branch::Unloading] {
                let from = if branch == Branch::Loading {
                    0.0
                } else {
                    least
                };
                let mut random = Contacts::new(1);
                let even = (1..=300).map(|i| from + (most - from) * f64::from(i) / 300.0);
                let descending: Vec<f64> = even.clone().rev().collect();
                let in_no_order: Vec<f64> = (0..300).map(|_| random.uniform(from, most)).collect();
                for values in [even.collect(), descending, in_no_order] {
                    let mut states = vec![State::ORIGIN; values.len()];
                    let found = equilibria.branch(&values, branch, &mut states);
                    found.expect("in range");
                    for (&value, state) in values.iter().zip(&states) {
                        let expected = match branch {
                            Branch::Loading => equilibria.loading(value),
                            Branch::Unloading => equilibria.unloading(value),
                        }
                        .expect("in range");
                        let off = state.contact_radius / expected.contact_radius - 1.0;
                        assert!(off.abs() < 1e-11, "{control:?} {value}: {off:e}");
                        let reached = control.imposed(state.load, state.penetration);
                        let size = value.abs().max(1e-3 * most);
                        let off = (reached - value).abs();
                        assert!(off < 1e-12 * size, "{reached} for {value}");
                    }
                }
            }
        }
    }
}

#[test]
fn derivatives_on_a_half_space_are_those_of_jkr() {
    let (radius, modulus, w) = (1e-3, 2e6, 0.04);
    let system = HalfSpace {
        probe: Probe::Paraboloid { radius },
        sphere_modulus: modulus,
        solid: solid(f64::INFINITY, 0.25),
    };
    let contact = Contact::half_space(&system).expect("physical");
    let equilibria = contact.equilibria(w, Control::Displacement).expect("JKR");
    let values: Vec<f64> = (0..50).map(|i| -1e-6 + 2e-7 * f64::from(i)).collect();
    let inputs = [Input::SphereModulus, Input::WorkOfAdhesion];
    let mut states = vec![State::ORIGIN; values.len()];
    let mut derivatives = vec![Derivatives::ZERO; 3 * values.len()];
    let unloading = Branch::Unloading;
    equilibria
        .branch_with_gradient(&values, unloading, &inputs, &mut states, &mut derivatives)
        .expect("JKR");
    for (state, rows) in states.iter().zip(derivatives.chunks(3)) {
        // Johnson, Kendall and Roberts (1971): F and delta as functions of a.
        let a = state.contact_radius;
        let (root_w, root_e) = (w.sqrt(), modulus.sqrt());
        let attraction = (8.0 * PI * a.powi(3)).sqrt();
        let load_by_a = 4.0 * modulus * a * a / radius - 1.5 * attraction * root_w * root_e / a;
        let depth = (2.0 * PI * a).sqrt();
        let depth_by_a = 2.0 * a / radius - 0.5 * depth * root_w / root_e / a;
        let stiffness = load_by_a / depth_by_a;
        let by_modulus = 4.0 * a.powi(3) / (3.0 * radius) - 0.5 * attraction * root_w / root_e;
        let depth_by_modulus = 0.5 * depth * root_w / (root_e * modulus);
        let by_work = -0.5 * attraction * root_e / root_w;
        let depth_by_work = -0.5 * depth / (root_e * root_w);
        // Each derivative is a difference of two terms, which is 0 for the modulus at delta = 0.
        let expected = [
            [stiffness, 0.0],
            [by_modulus, stiffness * depth_by_modulus],
            [by_work, stiffness * depth_by_work],
        ];
        for (found, [one, other]) in rows.iter().zip(expected) {
            let off = (found.load - (one - other)).abs();
            assert!(off < 1e-9 * (one.abs() + other.abs()), "{a}: {off:e}");
        }
        assert!((rows[0].penetration - 1.0).abs() < 1e-12);
        let sizes = [depth_by_modulus, depth_by_work];
        for (by, size) in rows[1..].iter().zip(sizes) {
            assert!(by.penetration.abs() < 1e-9 * size.abs(), "delta is imposed");
        }
    }
}

/// Derivatives by differences of contacts by direct solves, without the table.
#[test]
fn derivatives_on_a_film_are_those_of_direct_solves() {
    let solved = |system: &System| {
        let material = system.material().expect("physical");
        let range = [1e-5 / system.film_thickness, 2e-4 / system.film_thickness];
        let curve = solve::curve(&material, range, 1e-10).expect("within reach");
        Contact::new(system, curve).expect("its own curve")
    };
    let w = 0.04;
    for system in [paper_system(1e-5), paper_system(3e-4)] {
        let contact =
            Contact::in_table_with_gradient(Table::embedded(), &system).expect("in the table");
        let inputs = [
            Input::SphereModulus,
            Input::FilmModulus,
            Input::FilmThickness,
        ];
        for control in [Control::Load, Control::Displacement, SPRING] {
            let equilibria = contact.equilibria(w, control).expect("a table to 0");
            let values: Vec<f64> = [6e-5, 9e-5, 1.3e-4]
                .iter()
                .map(|&a| {
                    let (load, penetration) = contact.load_and_penetration(a, w).expect("inside");
                    control.imposed(load, penetration)
                })
                .collect();
            let mut states = vec![State::ORIGIN; 3];
            let mut derivatives = vec![Derivatives::ZERO; 12];
            let unloading = Branch::Unloading;
            equilibria
                .branch_with_gradient(&values, unloading, &inputs, &mut states, &mut derivatives)
                .expect("in range");
            for (k, input) in inputs.into_iter().enumerate() {
                let changed = |factor: f64| {
                    let mut system = system.clone();
                    let film = system.film;
                    match input {
                        Input::SphereModulus => system.sphere_modulus *= factor,
                        Input::FilmThickness => system.film_thickness *= factor,
                        _ => {
                            system.film = solid(factor * film.young(), film.poisson());
                        }
                    }
                    solved(&system)
                };
                let size = match input {
                    Input::SphereModulus => system.sphere_modulus,
                    Input::FilmThickness => system.film_thickness,
                    _ => system.film.young(),
                };
                let step = 1e-3;
                let [more, less] = [1.0 + step, 1.0 - step].map(changed);
                for (i, &value) in values.iter().enumerate() {
                    let at = |contact: &Contact| {
                        let equilibria = contact.equilibria(w, control).expect("in range");
                        equilibria.unloading(value).expect("in range")
                    };
                    let (up, down) = (at(&more), at(&less));
                    let found = derivatives[4 * i + 1 + k];
                    let scale = [
                        states[i].load.abs() + 1e-4,
                        states[i].penetration.abs() + 1e-7,
                    ];
                    for ((up, down), (found, scale)) in
                        [(up.load, down.load), (up.penetration, down.penetration)]
                            .into_iter()
                            .zip([found.load, found.penetration].into_iter().zip(scale))
                    {
                        let expected = (up - down) / (2.0 * step);
                        let off = (found * size - expected).abs() / scale;
                        assert!(off < 2e-5, "{control:?} {input:?}: {off:e}");
                    }
                }
            }
        }
    }
}

#[test]
fn values_without_a_contact_and_wrong_lengths_are_refused() {
    let system = paper_system(1e-5);
    let contact = Contact::in_table_with_gradient(Table::embedded(), &system);
    let contact = contact.expect("in the table");
    let equilibria = contact.equilibria(0.04, Control::Displacement);
    let equilibria = equilibria.expect("in range");
    let mut states = [State::ORIGIN; 2];
    let error = equilibria.branch(&[1e-6, -1e-5], Branch::Unloading, &mut states);
    assert!(matches!(error, Err(Error::NoContact { .. })), "{error:?}");
    assert!(states[0].contact_radius > 0.0, "the first one is written");
    let error = equilibria.branch(&[-1e-7], Branch::Loading, &mut states[1..]);
    assert!(matches!(error, Err(Error::NoContact { .. })), "{error:?}");
    let error = equilibria.branch(&[1e-6], Branch::Loading, &mut states);
    assert_names(&error.expect_err("a length").to_string(), &["2", "1"]);
    let mut derivatives = [Derivatives::ZERO; 3];
    let (values, inputs, loading) = ([1e-6, 2e-6], [Input::FilmModulus], Branch::Loading);
    let error = equilibria
        .branch_with_gradient(&values, loading, &inputs, &mut states, &mut derivatives)
        .expect_err("a length");
    assert_names(&error.to_string(), "number of derivatives; 3");
    for value in [f64::NAN, f64::INFINITY] {
        let refused = equilibria.branch(&[value], Branch::Unloading, &mut states[1..]);
        assert!(refused.is_err());
    }
}
