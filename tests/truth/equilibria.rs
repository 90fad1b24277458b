//! Equilibria where the number of them changes.

use std::f64::consts::PI;

use acceptance::{Refused, looked_up, on_half_space, rigid_sphere, solid};
use contact::{CohesiveZone, Contact, Control};
use interp::Probe;

fn sphere() -> Contact {
    on_half_space(Probe::Paraboloid { radius: 1e-4 }, solid(1e6, 0.0))
}

#[test]
fn a_stable_contact_that_is_short_beside_the_zone_is_refused_and_not_left_out() {
    let (contact, w) = (sphere(), 0.05);
    let at_rest = contact.zero_load(w).expect("a contact").contact_radius;
    for (part, is_short) in [(0.2, true), (0.3, false)] {
        let zone = part * at_rest;
        let stress = (0.25 * PI * 1e6 * w / zone).sqrt();
        let attraction = contact
            .cohesive_zone(w, CohesiveZone { stress })
            .expect("short");
        let found = attraction.equilibria(Control::Load, 0.0);
        if is_short {
            let found = found.expect("a contact");
            assert_eq!(
                found.iter().filter(|one| one.stable).count(),
                1,
                "{found:?}"
            );
        } else {
            found.refused("contact radius; direct solve");
        }
    }
}

#[test]
fn at_a_turning_point_both_equilibria_are_one() {
    let film = looked_up(&rigid_sphere(1e-4, [1e6, 0.45], 1e-5, [1e9, 0.3]));
    for contact in [sphere(), film] {
        for control in [
            Control::Load,
            Control::Displacement,
            Control::Spring { stiffness: 10.0 },
        ] {
            let equilibria = contact.equilibria(0.05, control).expect("in range");
            let last = equilibria.pull_off().expect("in range");
            let imposed = control.imposed(last.load, last.penetration);
            let found = equilibria.at(imposed).expect("in range");
            let near = found
                .iter()
                .filter(|one| (one.state.contact_radius / last.contact_radius - 1.0).abs() < 1e-6);
            assert_eq!(near.count(), 1, "{control:?}: {found:?}");
        }
    }
}
