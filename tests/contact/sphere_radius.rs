//! A contact is smaller than the sphere: larger radii are refused, and searches end there.

use std::f64::consts::PI;

use acceptance::{larger, paper_system};
use contact::{Contact, Control, Error, State};
use interp::Table;

use crate::contact::half_space;
use crate::equilibria::CONTROLS;
use crate::outside::thin_films;

/// The radius of the sphere, m.
const R: f64 = 1e-3;

fn coated() -> Contact {
    // The nodes reach 10 R.
    let contact = Contact::in_table_with_gradient(Table::embedded(), &paper_system(1e-5));
    contact.expect("in the table")
}

#[test]
fn every_function_refuses_a_radius_that_is_not_below_the_spheres() {
    let refuses = |result: Result<(), Error>, a: f64| match result {
        Err(
            error @ Error::Table(interp::Error::BeyondSphere {
                contact_radius,
                sphere_radius,
            }),
        ) => {
            assert_eq!((contact_radius, sphere_radius), (a, R));
            acceptance::assert_names(
                &error.to_string(),
                &[&format!("{a:?} m"), "below", "R = 0.001 m", "order"],
            );
        }
        other => panic!("{a}: {other:?}"),
    };
    for contact in [coated(), half_space()] {
        for a in [R, R.next_up(), 0.04, 1.0, f64::MAX] {
            let w = 6e-5;
            refuses(contact.load(a, w).map(drop), a);
            refuses(contact.load(a, 0.0).map(drop), a);
            refuses(contact.load_and_penetration(a, w).map(drop), a);
            refuses(contact.stiffness(a).map(drop), a);
            refuses(contact.stress_intensity(a, w).map(drop), a);
            refuses(contact.quantities(a).map(drop), a);
            refuses(contact.gradient(a, w).map(drop), a);
            refuses(contact.validity(a).map(drop), a);
            refuses(contact.energy_release_rate_at_load(a, 1e-6).map(drop), a);
            let at_penetration = contact.energy_release_rate_at_penetration(a, 1e-6);
            refuses(at_penetration.map(drop), a);
            refuses(contact.jkr_fit(w, [1e-5, a], 2).map(drop), a);
            refuses(contact.film_bias(w, [1e-5, a], 2).map(drop), a);
            refuses(contact.line(w, a).map(drop), a);
            let edge = contact.mechanics().edge_singularity(a, w);
            refuses(edge.map(drop).map_err(Error::from), a);
        }
        let below = R.next_down();
        assert!(contact.load(below, 0.04).expect("below R").is_finite());
        assert!(contact.validity(below).expect("below R").a_over_r <= 1.0);
    }
}

#[test]
fn searches_find_every_radius_up_to_the_spheres_and_say_where_they_end() {
    /// Largest relative error of a radius. Measured: 1.0e-15.
    const EXACT: f64 = 1e-12;
    let mut worst = 0.0;
    let contact = half_space();
    let e = contact.mechanics().sphere_film_modulus();
    let [_, most] = contact.contact_radius_range();
    assert!(most < R && most > (1.0 - 1e-11) * R);
    let ends_at_sphere = |result: Result<State, Error>| match result {
        Err(error @ Error::OutsideRadii { .. }) => {
            let text = error.to_string();
            assert!(text.contains("contact of this probe"), "{text}");
            assert!(!text.contains("make a table"), "{text}");
            assert!(!text.contains("1e-60"), "{text}");
        }
        other => panic!("{other:?}"),
    };
    for part in [0.1, 0.9, 0.999_999, 1.000_001, 1.1, 30.0] {
        let a = part * R;
        // JKR separates at this radius, and rests at zero load at 4^{1/3} times a radius.
        let pull_off = [
            (Control::Load, 8.0 * e * a.powi(3) / (9.0 * PI * R * R)),
            (Control::Displacement, 8.0 * e * a.powi(3) / (PI * R * R)),
        ];
        let rest = 2.0 * e * a.powi(3) / (9.0 * PI * R * R);
        let mut results: Vec<Result<State, Error>> = pull_off
            .map(|(control, w)| contact.pull_off(w, control))
            .into();
        results.push(contact.zero_load(rest));
        // Hertz.
        let load = 4.0 * e * a.powi(3) / (3.0 * R);
        let hertz = contact.equilibria(0.0, Control::Load).expect("physical");
        results.extend([hertz.unloading(load), hertz.loading(load)]);
        results.push(hertz.at(load).map(|found| found[0].state));
        let last = |branches: Vec<Vec<State>>| *branches[0].last().expect("a state");
        let curve = hertz.force_displacement(load, 3);
        results.push(curve.map(|curve| last(curve.loading)));
        let state = |(contact_radius, _)| State {
            contact_radius,
            ..State::ORIGIN
        };
        let measured = contact.radius_and_energy_release_rate(0.9 * load, a * a / R);
        results.push(measured.map(state));
        let by_energy = results.len() - 1;
        for (i, result) in results.into_iter().enumerate() {
            if part > 1.0 {
                ends_at_sphere(result);
            } else if i == by_energy {
                // Its radius is larger than the adhesionless one, and may not be below the
                // sphere's.
                match result {
                    Ok(state) => assert!(state.contact_radius > a && state.contact_radius < R),
                    outside => ends_at_sphere(outside),
                }
            } else {
                let found = result.expect("in range").contact_radius;
                worst = larger(worst, (found / a - 1.0).abs());
            }
        }
    }
    println!("up to the sphere's radius: {worst:.1e}");
    assert!(worst <= EXACT);
}

#[test]
fn the_range_on_a_film_ends_at_the_sphere_or_at_the_last_node() {
    let at_most = |film_thickness| {
        let contact = Contact::in_table(Table::embedded(), &paper_system(film_thickness));
        contact.expect("in the table").contact_radius_range()[1]
    };
    assert!((at_most(1e-7) / 1e-4 - 1.0).abs() < 1e-15);
    assert_eq!(at_most(1e-5), (1.0 - 1e-12) * R);

    let contact = coated();
    for control in CONTROLS {
        let equilibria = contact.equilibria(0.04, control).expect("physical");
        let widest = contact.load_and_penetration((1.0 - 1e-9) * R, 0.04);
        let (load, penetration) = widest.expect("below the sphere's radius");
        let imposed = control.imposed(load, penetration);
        let found = equilibria.unloading(imposed).expect("in range");
        assert!((found.contact_radius / R - 1.0).abs() <= 2e-9, "{found:?}");
        let beyond = equilibria.unloading(1.01 * imposed);
        let at_sphere = matches!(
            beyond,
            Err(Error::OutsideRadii {
                at_end_of_probe: true,
                ..
            })
        );
        assert!(at_sphere, "{beyond:?}");
    }
}

#[test]
fn a_curve_without_a_radius_below_the_spheres_has_no_contacts() {
    let contact = Contact::in_table(&thin_films(), &paper_system(1e-2));
    let contact = contact.expect("in the table");
    let [from, to] = contact.contact_radius_range();
    assert!(from > to);
    let beyond = |result: Result<(), Error>| {
        let refused = matches!(result, Err(Error::Table(interp::Error::BeyondSphere { sphere_radius, .. })) if sphere_radius == R);
        assert!(refused, "{result:?}");
    };
    for control in CONTROLS {
        beyond(contact.equilibria(0.04, control).map(drop));
        beyond(contact.pull_off(0.04, control).map(drop));
    }
    beyond(contact.zero_load(0.04).map(drop));
    beyond(contact.radius_and_energy_release_rate(0.0, 1e-6).map(drop));
}
