//! Other shapes of the probe than the paraboloid.

mod direct;
mod separation;

use acceptance::{
    Refused, assert_matches, flat_ended_cone, half_space_of, looked_up, on_half_space, power_law,
    relative, rigid_probe, rounded_cone, solid, system_of,
};
use contact::{Branch, Contact, Control, Input, Neglected, State};
use interp::{Elastic, Probe, Profile, Table};

use crate::gradient::{value, with};

/// Work of adhesion, J/m^2.
const W: f64 = 0.04;

const HALF_ANGLE: f64 = 1.2;

fn contact(probe: Probe, film: Elastic, film_thickness: f64, substrate: Elastic) -> Contact {
    looked_up(&rigid_probe(probe, film, film_thickness, substrate))
}

/// The probe of a name and numbers, whatever these are.
fn of_numbers(name: &str, numbers: &[f64]) -> Probe {
    let made = Probe::of_numbers(name, numbers).expect("a name");
    made.expect("no profile")
}

/// A measured profile of an asphere.
fn profile() -> Profile {
    let points = (0..30).map(|i| 1e-6 * f64::from(i));
    let points: Vec<[f64; 2]> = points
        .map(|r| [r, r * r / 2e-5 + r.powi(4) * 1e12])
        .collect();
    Profile::new(&points).expect("convex")
}

/// Every shape with a contact of more than one radius, of some 10 um.
pub fn shapes() -> Vec<Probe> {
    vec![
        Probe::Paraboloid { radius: 4e-5 },
        Probe::Sphere { radius: 4e-5 },
        power_law(1e13, 4.0),
        power_law(1e6, 2.5),
        Probe::Cone {
            half_angle: HALF_ANGLE,
        },
        rounded_cone(1e-5, HALF_ANGLE),
        flat_ended_cone(3e-6, HALF_ANGLE),
        Probe::Profile(profile()),
    ]
}

/// On a film of the material of the substrate every shape is that on a half-space.
#[test]
fn on_a_homogeneous_body_shapes_are_those_of_the_closed_forms() {
    let material = solid(1e6, 0.3);
    for probe in shapes() {
        let bare = on_half_space(probe.clone(), material);
        for t in [1e-8, 1e-6, 1e-4, 1e-1] {
            let coated = contact(probe.clone(), material, t, material);
            for a in [1e-9, 1e-7, 2.9e-6, 3.1e-6, 1e-5, 2.8e-5] {
                let [least, most] = coated.contact_radius_range();
                let too_wide = a > 0.5 * 4e-5 && matches!(probe, Probe::Sphere { .. });
                if a < least || a > most || too_wide {
                    continue;
                }
                let [found, expected] = [&coated, &bare]
                    .map(|contact| contact.load_and_penetration(a, 0.0).expect("in range"));
                for (found, expected) in [(found.0, expected.0), (found.1, expected.1)] {
                    let miss = found / expected - 1.0;
                    assert!(miss.abs() < 3e-7, "{probe:?}, {t}, {a}: {miss:e}");
                }
            }
        }
    }
}

/// Every derivative of one shape is a difference of contacts.
#[test]
fn derivatives_are_differences() {
    const STEP: f64 = 1e-3;
    let table = Table::embedded();
    let stiff_below = (solid(3.5e6, 0.4), solid(2e8, 0.25));
    let soft_below = (solid(2e7, 0.4), solid(1e6, 0.25));
    let pairs = |probe: Probe| [stiff_below, soft_below].map(|bodies| (probe.clone(), bodies));
    for (probe, (film, substrate)) in shapes().into_iter().flat_map(pairs) {
        let own = system_of(probe.clone(), 2e6, film, 1e-5, substrate);
        let contact = Contact::in_table_with_gradient(table, &own).expect("in the table");
        let a = 1.2e-5;
        let gradient = contact.gradient(a, W).expect("in range");
        let at = |input: Input, value: f64| {
            let a = if input == Input::ContactRadius {
                value
            } else {
                a
            };
            let other = Contact::in_table(table, &with(&own, input, value)).expect("in the table");
            other.load_and_penetration(a, W).expect("in range")
        };
        let (load, penetration) = contact.load_and_penetration(a, 0.0).expect("in range");
        for input in [
            Input::ContactRadius,
            Input::SphereRadius,
            Input::SphereModulus,
            Input::FilmThickness,
            Input::FilmModulus,
            Input::FilmPoisson,
            Input::SubstrateModulus,
        ] {
            let unit = if input == Input::ContactRadius {
                a
            } else {
                value(&own, input)
            };
            if input == Input::SphereRadius && (unit == 0.0 || probe.name() == "paraboloid") {
                assert_eq!(gradient.by(input).is_err(), unit == 0.0);
                continue;
            }
            let found = gradient.by(input).expect("known");
            let [more, less] = [1.0 + STEP, 1.0 - STEP].map(|factor| at(input, factor * unit));
            let misses = [
                (found.load * unit - (more.0 - less.0) / (2.0 * STEP)) / load,
                (found.penetration * unit - (more.1 - less.1) / (2.0 * STEP)) / penetration,
            ];
            // The contacts that are compared are exact to the tolerance of the table.
            assert!(
                misses.iter().all(|miss| miss.abs() < 3e-5),
                "{probe:?} by {input:?}: {misses:?}"
            );
        }
    }
}

#[test]
fn slopes_at_a_bend_are_those_beside_it() {
    let (radius, half_angle) = (1e-5, HALF_ANGLE);
    for (film, substrate) in [
        (solid(1e5, 0.5), solid(1e9, 0.3)),
        (solid(1e8, 0.2), solid(1e6, 0.4)),
    ] {
        let probe = Probe::RoundedCone { radius, half_angle };
        let own = rigid_probe(probe, film, 2e-6, substrate);
        let contact = Contact::in_table_with_gradient(Table::embedded(), &own);
        let contact = contact.expect("in the table");
        let slope = |a: f64| {
            let gradient = contact.gradient(a, 0.0).expect("in range");
            gradient.by(Input::ContactRadius).expect("known")
        };
        let bend = radius / half_angle.tan();
        let (at, beside) = (slope(bend), slope(bend * (1.0 - 1e-7)));
        assert!((at.penetration / beside.penetration - 1.0).abs() < 1e-4);
        assert!((at.load / beside.load - 1.0).abs() < 1e-4);
    }
}

/// All shapes answer the questions that the paraboloid answers.
#[test]
fn every_shape_has_curves_branches_and_energies() {
    let (film, substrate) = (solid(1e6, 0.4), solid(1e9, 0.3));
    for probe in shapes() {
        let coated = contact(probe.clone(), film, 2e-6, substrate);
        for contact in [coated, on_half_space(probe.clone(), film)] {
            let w = 1e-5;
            for control in [Control::Load, Control::Displacement] {
                let equilibria = contact.equilibria(w, control).expect("in range");
                let at = contact.load_and_penetration(1.5e-5, w).expect("in range");
                let most = if control == Control::Load { at.0 } else { at.1 };
                let curve = equilibria.force_displacement(most, 30).expect("in range");
                let last = curve.loading.last().and_then(|branch| branch.last());
                let last = last.expect("a state");
                assert!(relative(last.contact_radius, 1.5e-5) < 1e-6, "{probe:?}");
                let mut states = [State::ORIGIN; 3];
                let values = [1.0, 0.9, 0.8].map(|part| part * most);
                let found = equilibria.branch(&values, Branch::Unloading, &mut states);
                found.expect("in range");
                for state in states {
                    let a = state.contact_radius;
                    let at_load = contact.energy_release_rate_at_load(a, state.load);
                    let at_penetration =
                        contact.energy_release_rate_at_penetration(a, state.penetration);
                    for found in [at_load, at_penetration] {
                        let found = found.expect("in range");
                        assert!(relative(found, w) < 1e-6, "{probe:?}: {found}");
                    }
                    let (radius, _) = contact
                        .radius_and_energy_release_rate(state.load, state.penetration)
                        .expect("in range");
                    assert!((radius / a - 1.0).abs() < 1e-6, "{probe:?}: {radius}");
                }
            }
        }
    }
}

#[test]
fn impossible_shapes_are_errors() {
    let film = solid(1e6, 0.4);
    let refused = |probe: Probe| {
        let own = rigid_probe(probe.clone(), film, 1e-6, film);
        let coated = Contact::in_table(Table::embedded(), &own);
        assert!(coated.is_err(), "{probe:?}");
        let bare = half_space_of(probe.clone(), 1e6, film);
        assert!(Contact::half_space(&bare).is_err(), "{probe:?}");
    };
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        for (name, numbers) in [
            ("paraboloid", &[bad][..]),
            ("sphere", &[bad]),
            ("cone", &[bad]),
            ("flat punch", &[bad]),
            ("flat-ended cone", &[bad, 1.0]),
            ("flat-ended cone", &[1e-6, bad]),
            ("rounded cone", &[bad, 1.0]),
            ("power law", &[bad, 2.0]),
            ("power law", &[1.0, bad]),
        ] {
            refused(of_numbers(name, numbers));
        }
    }
    refused(of_numbers("cone", &[1.6]));
    refused(of_numbers("power law", &[1.0, 0.9]));
    // Extreme sizes give finite numbers or errors.
    for (name, numbers) in [
        ("cone", &[1e-300][..]),
        ("rounded cone", &[1e-300, 1.0]),
        ("flat-ended cone", &[1e30, 1.0]),
        ("sphere", &[1e-300]),
        ("sphere", &[1e300]),
        ("power law", &[1e300, 20.0]),
        ("power law", &[1e-300, 19.5]),
    ] {
        let probe = of_numbers(name, numbers);
        let own = rigid_probe(probe.clone(), film, 1e-6, solid(1e9, 0.3));
        let Ok(contact) = Contact::in_table(Table::embedded(), &own) else {
            continue;
        };
        for a in [1e-320, 1e-300, 1e-9, 1e-6, 1e-3, 1e30, f64::NAN] {
            if let Ok((load, penetration)) = contact.load_and_penetration(a, W) {
                assert!(
                    load.is_finite() && penetration.is_finite(),
                    "{probe:?}, {a}"
                );
            }
            let _ = contact.validity(a);
        }
        let _ = contact.pull_off(W, Control::Load);
    }
}

#[test]
fn neglected_effects_that_are_larger_than_the_shape_are_named() {
    let sphere = || Probe::Sphere { radius: 1e-4 };
    let compressible = contact(sphere(), solid(1e6, 0.3), 1e-3, solid(1e9, 0.3));
    let neglected = |contact: &Contact, a: f64| contact.validity(a).expect("in range").neglected();
    assert_eq!(neglected(&compressible, 3e-5), [Neglected::Sideways]);
    let incompressible = contact(sphere(), solid(1e6, 0.5), 1e-3, solid(1e9, 0.3));
    assert_eq!(neglected(&incompressible, 3e-5), []);
    let thin = contact(sphere(), solid(1e6, 0.5), 1e-6, solid(1e9, 0.3));
    assert_eq!(neglected(&thin, 3e-5), [Neglected::Strain]);
    let elastic = system_of(sphere(), 1e6, solid(1e6, 0.5), 1e-3, solid(1e9, 0.3));
    let elastic = looked_up(&elastic);
    assert_eq!(neglected(&elastic, 3e-5), [Neglected::ElasticProbe]);
    assert_eq!(neglected(&elastic, 5e-6), []);
    // At equal penetration the load of the exact sphere is smaller by about delta/(10 R).
    let paraboloid = contact(
        Probe::Paraboloid { radius: 1e-4 },
        solid(1e6, 0.5),
        1e-3,
        solid(1e9, 0.3),
    );
    let load = |contact: &Contact| {
        let equilibria = contact
            .equilibria(0.0, Control::Displacement)
            .expect("in range");
        equilibria.unloading(4e-6).expect("in range").load
    };
    let part = 1.0 - load(&incompressible) / load(&paraboloid);
    let at = incompressible.validity(2e-5).expect("in range");
    assert!((part / at.shape - 1.0).abs() < 0.1, "{part}, {at:?}");
}

/// The effect of the shape on films on a rigid base under a rigid sphere of ten contact radii, beside values of another
/// program, by Galerkin's method for the moments of the stress under a flat punch.
#[test]
fn the_effect_of_the_shape_is_known_on_thin_films() {
    for (nu1, a_over_t, expected) in [
        // Of a half-space, beyond the nodes: delta0/(10 R).
        (0.5, 1e-4, 1e-3),
        (0.5, 0.01, 1.01e-3),
        (0.5, 1.0, 2.20e-3),
        (0.5, 10.0, 2.80e-3),
        (0.5, 20.0, 2.73e-3),
        (0.49, 5.0, 2.36e-3),
        (0.3, 10.0, 1.72e-3),
    ] {
        let (a, radius) = (1e-6, 1e-5);
        let of = |probe| {
            let film = solid(1e6, nu1);
            let base = solid(f64::INFINITY, 0.3);
            looked_up(&rigid_probe(probe, film, a / a_over_t, base))
        };
        let found = of(Probe::Paraboloid { radius })
            .validity(a)
            .expect("in range");
        let error = found.shape / expected - 1.0;
        // The values have three digits.
        assert!(error.abs() < 5e-3, "{nu1}, {a_over_t}: {}", found.shape);
        let of_sphere = of(Probe::Sphere { radius }).validity(a).expect("in range");
        assert!(
            (of_sphere.shape / found.shape - 1.0).abs() < 1e-2,
            "{of_sphere:?}"
        );
    }
}

/// The surface of a stiff solid does not move sideways under a soft lens.
#[test]
fn a_soft_lens_on_glass_has_no_displacement_sideways() {
    let glass = solid(70e9, 0.2);
    for probe in [
        Probe::Paraboloid { radius: 1e-3 },
        Probe::Cone { half_angle: 1.52 },
    ] {
        let lens = half_space_of(probe, 2e6, glass);
        let at = Contact::half_space(&lens).expect("possible").validity(5e-5);
        let at = at.expect("in range");
        assert!(at.sideways < 1e-6, "{at:?}");
        assert_eq!(at.neglected(), []);
    }
}

#[test]
fn every_shape_is_made_of_its_name_and_numbers() {
    let profile = [0.0, 0.0, 1e-6, 1e-7, 2e-6, 4e-7];
    let shapes: [(&str, &[f64]); 8] = [
        ("paraboloid", &[1e-6]),
        ("sphere", &[1e-6]),
        ("power law", &[1e6, 3.0]),
        ("cone", &[1.2]),
        ("rounded cone", &[1e-6, 1.2]),
        ("flat punch", &[1e-6]),
        ("flat-ended cone", &[1e-6, 1.2]),
        ("profile", &profile),
    ];
    for (name, numbers) in shapes {
        let made = Probe::of_numbers(name, numbers).expect("a name");
        assert_eq!(made.expect("possible numbers").name(), name);
        assert!(Probe::of_numbers(name, &[1.0; 3]).is_none(), "{name}");
    }
    assert!(Probe::of_numbers("pyramid", &[1e-6]).is_none());
    // A profile says itself what is wrong with it.
    assert_matches!(Probe::of_numbers("profile", &[1.0, 0.0]), Some(Err(_)));
}

/// A flat end that is wide beside the film leaves few contact radii, and is no punch.
#[test]
fn a_wide_flat_end_names_its_largest_contact() {
    let probe = flat_ended_cone(5e-6, HALF_ANGLE);
    let wide = contact(probe, solid(1e6, 0.3), 1e-8, solid(1e9, 0.3));
    assert!(wide.load(6e-6, 0.0).is_ok());
    let beyond = wide.load(1e-5, 0.0);
    beyond.refused("below the largest one for which the shape is known or computed");
    // A flat end that is wider than all of them.
    let probe = flat_ended_cone(8e-6, HALF_ANGLE);
    let wide = rigid_probe(probe, solid(1e6, 0.3), 1e-8, solid(1e9, 0.3));
    Contact::in_table(Table::embedded(), &wide).refused("a_over_t; 800");
}
