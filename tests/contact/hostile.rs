//! Contacts asked with hostile arguments.

use std::fmt::Debug;

use acceptance::{assert_names, solid};
use contact::Error;
use contact::{Contact, Control};
use interp::{HalfSpace, Probe, Quantity};

use crate::contact::{bare, half_space};

/// Asserts that a number is refused as unphysical, by name, value and allowed range.
#[track_caller]
fn named<T: Debug>(result: Result<T, Error>, name: &str, value: f64) {
    match result {
        Err(error @ Error::Table(interp::Error::Unphysical { allowed, .. })) => {
            let value = format!("{value:?}");
            assert_names(&error.to_string(), &[name, &value, allowed])
        }
        other => panic!("{name} = {value}: {other:?}"),
    }
}

#[test]
fn numbers_out_of_bounds_are_named() {
    let contact = half_space();
    for a in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        named(contact.load(a, 0.04), "contact radius", a);
        named(contact.load_and_penetration(a, 0.04), "contact radius", a);
        named(contact.validity(a), "contact radius", a);
        named(contact.stiffness(a), "contact radius", a);
    }
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
