//! Contacts asked with hostile arguments.

use acceptance::solid;
use contact::Error;
use contact::{Contact, Control};
use interp::{HalfSpace, Probe, Quantity};

use crate::contact::{bare, half_space};

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
