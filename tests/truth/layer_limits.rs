//! Layers, attraction before a contact and stick at their limits.

use std::f64::consts::PI;

use acceptance::{Refused, rigid_probe, solid};
use contact::Control;
use interp::{Elastic, Probe};
use solve::cohesive::Cohesive;
use solve::stack::{Interface, Layer, Stack};
use solve::stick::Sticking;

#[test]
fn the_softest_springs_are_those_beside_the_stiffest_layer() {
    let of = |normal: f64| {
        let stiff = Layer::bonded(solid(1e9, 0.3), 1e-6);
        let interface = Interface::Springs {
            tangential: 0.0,
            normal,
        };
        let soft = Layer {
            interface,
            ..Layer::bonded(solid(1e3, 0.3), 1e-6)
        };
        Stack::new(solid(1e9, 0.3), [stiff, soft])
    };
    // 1e-12 of 1e9 Pa over 2 um.
    assert!(of(501.0).is_ok());
    of(499.0).refused("normal stiffness; at least 5.0; e2; stiffest layer");
}

#[test]
fn the_lowest_state_before_a_contact_is_between_the_radii_of_the_search() {
    let (radius, modulus, range) = (1e-6, 1e6, 1e-9);
    // tau/es is such that the penetration c^2/2R - (2/pi) tau c/es - z0 is lowest at a part of the radius at which the
    // contact begins: c^2/2R + (1 - 2/pi) tau c/es = z0.
    let mut before = 0;
    for part in [0.3, 0.6, 0.75, 0.85, 0.9, 0.95] {
        let slope = 0.5 * PI * part;
        let closed = (radius * range / (0.5 + (1.0 - 2.0 / PI) * slope)).sqrt();
        let softness = slope * closed / radius;
        // tau = 2 sigma0, w = sigma0 z0.
        let work = 0.5 * softness * modulus * range;
        let solid = Elastic::new(modulus, 0.0).expect("physical");
        let system = rigid_probe(Probe::Paraboloid { radius }, solid, 1e-6, solid);
        let cohesive = Cohesive::new(&system, None, work, range).expect("physical");
        let found = cohesive
            .pull_off(Control::Displacement)
            .expect("a pull-off");
        if found.contact_radius > 0.0 {
            continue;
        }
        before += 1;
        let c = part * closed;
        let expected = -0.5 * c * c / radius - range;
        let error = found.penetration / expected - 1.0;
        assert!(error.abs() < 1e-9, "{part}: {error:e}");
    }
    assert!(before >= 4, "{before}");
}

#[test]
fn the_last_punch_of_a_growing_contact_is_that_punch() {
    // Dundurs' beta of a rigid sphere and an incompressible film is 0.
    let stack = Stack::new(solid(1e9, 0.3), [Layer::bonded(solid(1e6, 0.5), 1e-6)]);
    for sphere_modulus in [f64::INFINITY, 2e6] {
        let sticking = Sticking::on_stack(stack.as_ref().expect("physical"), sphere_modulus, 0.5)
            .expect("physical");
        for x in [0.5, 2.0, 5.0] {
            let punch = sticking.punch(x, 1e-8).expect("converges");
            let [gamma_s, gamma_t] = punch.edge.expect("no coupling");
            let (tip, _) = sticking.tip(x, 2.0, 1e-7).expect("converges");
            for (own, expected) in [
                (tip.eeq_s, punch.eeq_s),
                (tip.gamma_s, gamma_s),
                (tip.gamma_t, gamma_t),
            ] {
                assert!(
                    (own / expected - 1.0).abs() < 1e-5,
                    "{x}: {tip:?}, {punch:?}"
                );
            }
        }
    }
}
