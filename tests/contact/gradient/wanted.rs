//! Contacts that are made with some of the derivatives.

use acceptance::{larger, paper_system};
use contact::{Contact, Derivatives, Error, Input};
use interp::{System, Table};

use super::value;

/// The inputs that change the material.
const ELASTIC: [Input; 5] = [
    Input::SphereModulus,
    Input::FilmModulus,
    Input::FilmPoisson,
    Input::SubstrateModulus,
    Input::SubstratePoisson,
];
const RADIUS: f64 = 6.5e-5;
const WORK: f64 = 0.04;

/// Returns the derivatives with respect to one input.
fn by(contact: &Contact, input: Input) -> Result<Derivatives, Error> {
    let mut found = [Derivatives::ZERO];
    contact.derivatives(RADIUS, WORK, &[input], &mut found)?;
    Ok(found[0])
}

/// The paper's contact, and that of a rigid sphere.
fn systems() -> [System; 2] {
    let paper = paper_system(1e-6);
    let rigid = System {
        sphere_modulus: f64::INFINITY,
        ..paper.clone()
    };
    [paper, rigid]
}

/// The slopes with respect to the Poisson ratio of an incompressible film are improved for derivatives
/// with respect to that ratio alone. Those of the spline hardly change the other derivatives.
#[test]
fn derivatives_that_are_asked_for_are_those_of_a_contact_with_all() {
    let table = Table::embedded();
    let mut worst = 0.0;
    for system in systems() {
        let all = Contact::in_table_with_gradient(table, &system).expect("inside");
        let (load, penetration) = all.load_and_penetration(RADIUS, 0.0).expect("inside");
        for input in Input::ALL {
            let one = Contact::in_table_with_derivatives(table, &system, &[input]);
            let one = one.expect("inside");
            // The size of a change that matters.
            let size = match input {
                Input::ContactRadius => RADIUS,
                Input::WorkOfAdhesion => WORK,
                Input::FilmPoisson | Input::SubstratePoisson => 0.5,
                _ => value(&system, input).min(1e12),
            };
            let (found, expected) = (by(&one, input), by(&all, input));
            let (found, expected) = (found.expect("known"), expected.expect("known"));
            let misses = [
                (found.load - expected.load) / load,
                (found.penetration - expected.penetration) / penetration,
            ];
            for miss in misses {
                worst = larger(worst, (size * miss).abs());
            }
        }
    }
    worst /= table.description().tolerance;
    println!("{worst:.1e} tolerances");
    // Measured: 0.019.
    assert!(worst < 0.05, "{worst:e}");
}

#[test]
fn derivatives_that_are_not_asked_for_are_unknown() {
    let table = Table::embedded();
    // Which others follow from the derivatives that an input needs, first for a compliant sphere.
    let follow = |input: Input, rigid: bool| match (input, rigid) {
        (Input::SphereModulus, false) => vec![Input::FilmModulus, Input::SubstrateModulus],
        (Input::FilmModulus, true) => vec![Input::SubstrateModulus],
        (Input::SubstrateModulus, true) => vec![Input::FilmModulus],
        _ => Vec::new(),
    };
    for (system, rigid) in systems().into_iter().zip([false, true]) {
        for input in ELASTIC {
            let contact = Contact::in_table_with_derivatives(table, &system, &[input]);
            let contact = contact.expect("inside");
            let follow = follow(input, rigid);
            for other in ELASTIC.into_iter().filter(|&other| other != input) {
                // The modulus of a rigid sphere does not matter.
                let is_known = follow.contains(&other) || rigid && other == Input::SphereModulus;
                match by(&contact, other) {
                    Ok(_) => assert!(is_known, "{input:?}: {other:?}"),
                    Err(error) => {
                        let name = other.name();
                        let expected = Error::from(interp::Error::FixedParameter(name));
                        assert_eq!(error.to_string(), expected.to_string());
                        assert!(!is_known, "{input:?}: {other:?}");
                    }
                }
            }
        }
    }
}
