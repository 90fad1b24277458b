//! Contacts asked with hostile arguments.

use std::fmt::Debug;

use acceptance::{assert_names, paper_system, solid};
use contact::{Contact, Control, Error};
use interp::{Elastic, HalfSpace, Mechanics, Probe, Quantity, Table};

use crate::contact::{bare, coated, half_space};

/// Asserts that a number is refused as unphysical, by name, value and allowed range.
#[track_caller]
fn named<T: Debug>(result: Result<T, impl Into<Error>>, expected: &str, given: f64) {
    match result.map_err(Into::into) {
        Err(
            error @ Error::Table(interp::Error::Unphysical {
                name,
                value,
                allowed,
            }),
        ) => {
            assert_eq!((name, value.to_bits()), (expected, given.to_bits()));
            let value = format!("{value:?}");
            assert_names(&error.to_string(), &[name, &value, allowed])
        }
        other => panic!("{expected} = {given}: {other:?}"),
    }
}

#[test]
fn an_unphysical_solid_or_system_is_named() {
    const NOT_POSITIVE: [f64; 4] = [0.0, -1.0, f64::NAN, f64::NEG_INFINITY];
    for young in NOT_POSITIVE {
        named(Elastic::new(young, 0.3), "Young's modulus", young);
    }
    for poisson in [-1.0, 0.5000000000000001, f64::INFINITY, f64::NAN] {
        named(Elastic::new(1e6, poisson), "Poisson ratio", poisson);
    }
    let changed = |name: &str, value: f64| {
        let mut system = paper_system(1e-6);
        match name {
            "sphere_radius" => system.probe = Probe::Paraboloid { radius: value },
            "film_thickness" => system.film_thickness = value,
            "sphere_modulus" => system.sphere_modulus = value,
            _ => system.film = solid(value, 0.3),
        }
        named(system.material(), name, value);
        named(Mechanics::new(&system), name, value);
        named(Contact::in_table(Table::embedded(), &system), name, value);
    };
    for name in ["sphere_radius", "film_thickness", "sphere_modulus"] {
        for value in NOT_POSITIVE {
            changed(name, value);
        }
    }
    for name in ["sphere_radius", "film_thickness", "film modulus"] {
        changed(name, f64::INFINITY);
    }
}

#[test]
fn numbers_out_of_bounds_are_named() {
    for contact in [half_space(), coated(1e-6)] {
        for a in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            named(contact.load(a, 0.04), "contact radius", a);
            named(contact.load_and_penetration(a, 0.04), "contact radius", a);
            named(contact.validity(a), "contact radius", a);
            named(contact.stiffness(a), "contact radius", a);
        }
        assert!(contact.load(1e-6, 0.0).expect("no adhesion") > 0.0);
        for w in [-1e-300, -1.0, f64::NEG_INFINITY, f64::INFINITY, f64::NAN] {
            named(contact.load(1e-6, w), "work of adhesion", w);
            named(contact.load_and_penetration(1e-6, w), "work of adhesion", w);
        }
    }
    let contact = half_space();
    // A load that overflows.
    let planet = Contact::half_space(&HalfSpace {
        probe: Probe::Paraboloid { radius: 1e300 },
        ..bare()
    });
    let planet = planet.expect("physical");
    named(planet.load(1e200, 0.04), "contact radius", 1e200);
    let both = planet.load_and_penetration(1e200, 0.04);
    named(both, "contact radius", 1e200);
    for w in [-1.0, f64::NAN, f64::INFINITY] {
        let equilibria = contact.equilibria(w, Control::Load);
        named(equilibria, "work of adhesion", w);
        let bias = contact.film_bias(w, [1e-5, 1e-4], 5);
        named(bias, "work of adhesion", w);
        named(contact.zone_size(w, 1e-9), "work of adhesion", w);
        named(contact.zone_size(0.04, w), "interaction range", w);
        let equilibria = contact.equilibria(0.04, Control::Displacement);
        let equilibria = equilibria.expect("physical");
        if !w.is_finite() {
            let of = |load, depth| contact.radius_and_energy_release_rate(load, depth);
            named(equilibria.at(w), "penetration", w);
            named(of(w, 0.0), "load", w);
            named(of(0.0, w), "penetration", w);
        }
    }
    for stiffness in [0.0, -1.0, 1e-101, 1e101, f64::NAN, f64::INFINITY] {
        let on_spring = contact.equilibria(0.04, Control::Spring { stiffness });
        named(on_spring, "stiffness of the spring", stiffness);
    }
    let system = bare();
    for value in [0.0, -1.0, f64::NAN] {
        let mut sphere = system.clone();
        sphere.probe = Probe::Paraboloid { radius: value };
        named(Contact::half_space(&sphere), "sphere_radius", value);
        let mut soft = system.clone();
        soft.sphere_modulus = value;
        named(Contact::half_space(&soft), "sphere_modulus", value);
    }
    let rigid = HalfSpace {
        sphere_modulus: f64::INFINITY,
        solid: solid(f64::INFINITY, 0.3),
        ..system.clone()
    };
    let rigid = Contact::half_space(&rigid);
    named(rigid, "sphere_modulus", f64::INFINITY);
    assert!(contact.curve().is_none() && contact.system().is_none());
    let most = (1.0 - 1e-12) * system.probe.radius().expect("a paraboloid");
    assert_eq!(contact.contact_radius_range(), [0.0, most]);
    let quantities = contact.quantities(1e-5).expect("any radius");
    assert_eq!(quantities.get(Quantity::Delta0), 1.0);
}
