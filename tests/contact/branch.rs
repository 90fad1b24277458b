//! States at many imposed values, and their derivatives at a fixed imposed value.

use acceptance::{Contacts, Refused, looked_up, paper_system, solid, solved_contact};
use contact::{Branch, Contact, Control, Derivatives, Error, Input, State};
use interp::{Probe, System, Table};

use crate::gradient::{value, with};

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
                let is_loading = branch == Branch::Loading;
                let from = if is_loading { 0.0 } else { least };
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

/// Derivatives by differences of contacts by direct solves, without the table.
#[test]
fn derivatives_on_a_film_are_those_of_direct_solves() {
    const STEP: f64 = 1e-3;
    const W: f64 = 0.04;
    let inputs = [
        Input::SphereModulus,
        Input::FilmModulus,
        Input::FilmThickness,
        Input::WorkOfAdhesion,
    ];
    for system in [paper_system(1e-5), paper_system(3e-4)] {
        let contact =
            Contact::in_table_with_gradient(Table::embedded(), &system).expect("in the table");
        // Returns the contact and the work of adhesion with an input that is changed by a factor.
        let changed = |input: Input, factor: f64| {
            let system = with(&system, input, factor * value(&system, input));
            let range = [1e-5, 2e-4].map(|a| a / system.film_thickness);
            let of_work = input == Input::WorkOfAdhesion;
            let w = if of_work { factor * W } else { W };
            (solved_contact(&system, range, 1e-10), w)
        };
        let near =
            inputs.map(|input| [1.0 + STEP, 1.0 - STEP].map(|factor| changed(input, factor)));
        for control in [Control::Load, Control::Displacement, SPRING] {
            let equilibria = contact.equilibria(W, control).expect("a table to 0");
            let values = [6e-5, 9e-5, 1.3e-4].map(|a| {
                let (load, penetration) = contact.load_and_penetration(a, W).expect("inside");
                control.imposed(load, penetration)
            });
            let mut states = [State::ORIGIN; 3];
            let mut derivatives = [Derivatives::ZERO; 15];
            let unloading = Branch::Unloading;
            equilibria
                .branch_with_gradient(&values, unloading, &inputs, &mut states, &mut derivatives)
                .expect("in range");
            for (i, (&imposed, state)) in values.iter().zip(&states).enumerate() {
                let found = &derivatives[5 * i..][..5];
                // What is imposed is the first of the inputs.
                let by_itself = control.imposed(found[0].load, found[0].penetration);
                assert!((by_itself - 1.0).abs() < 1e-12, "{control:?}: {by_itself}");
                for ((input, near), by) in inputs.iter().zip(&near).zip(&found[1..]) {
                    let size = match *input {
                        Input::WorkOfAdhesion => W,
                        input => value(&system, input),
                    };
                    let [up, down] = near.each_ref().map(|(contact, w)| {
                        let equilibria = contact.equilibria(*w, control).expect("in range");
                        equilibria.unloading(imposed).expect("in range")
                    });
                    let off = |found: f64, difference: f64, scale: f64| {
                        let off = (found * size - difference / (2.0 * STEP)).abs() / scale;
                        assert!(off < 2e-5, "{control:?} {input:?}: {off:e}");
                    };
                    off(by.load, up.load - down.load, state.load.abs() + 1e-4);
                    let difference = up.penetration - down.penetration;
                    off(by.penetration, difference, state.penetration.abs() + 1e-7);
                }
            }
        }
    }
}

/// Under a flat punch the load at a penetration is the stiffness times it.
#[test]
fn derivatives_under_a_flat_punch_are_those_of_its_stiffness() {
    const STEP: f64 = 1e-3;
    const DEPTH: f64 = 1e-6;
    let inputs = [
        Input::SphereModulus,
        Input::FilmModulus,
        Input::FilmThickness,
        Input::SphereRadius,
    ];
    let system = System {
        probe: Probe::FlatPunch { radius: 2e-5 },
        ..paper_system(1e-5)
    };
    let contact =
        Contact::in_table_with_gradient(Table::embedded(), &system).expect("in the table");
    let equilibria = contact
        .equilibria(0.04, Control::Displacement)
        .expect("a punch");
    let (mut states, mut derivatives) = ([State::ORIGIN], [Derivatives::ZERO; 5]);
    equilibria
        .branch_with_gradient(
            &[DEPTH],
            Branch::Unloading,
            &inputs,
            &mut states,
            &mut derivatives,
        )
        .expect("in range");
    for (input, by) in inputs.into_iter().zip(&derivatives[1..]) {
        let size = value(&system, input);
        let [up, down] = [1.0 + STEP, 1.0 - STEP].map(|factor| {
            let system = with(&system, input, factor * size);
            let radius = system.probe.radius().expect("a punch");
            let at = radius / system.film_thickness;
            let contact = solved_contact(&system, [0.9 * at, 1.1 * at], 1e-10);
            DEPTH * contact.stiffness(radius).expect("in range")
        });
        let off = (by.load * size - (up - down) / (2.0 * STEP)) / states[0].load;
        assert!(
            off.abs() < 2e-5 && by.penetration == 0.0,
            "{input:?}: {off:e}"
        );
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
    let found = equilibria.branch(&[1e-6], Branch::Loading, &mut states);
    found.refused(&["2", "1"]);
    let mut derivatives = [Derivatives::ZERO; 3];
    let (values, inputs, loading) = ([1e-6, 2e-6], [Input::FilmModulus], Branch::Loading);
    equilibria
        .branch_with_gradient(&values, loading, &inputs, &mut states, &mut derivatives)
        .refused("number of derivatives; 3");
    for value in [f64::NAN, f64::INFINITY] {
        let refused = equilibria.branch(&[value], Branch::Unloading, &mut states[1..]);
        assert!(refused.is_err());
    }
}
