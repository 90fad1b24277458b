//! Surface tension, which the model leaves out: the tension from which on it would matter.

use std::f64::consts::{LN_2, PI};

use acceptance::{Data, rigid_probe, solid};
use contact::Contact;
use interp::{Elastic, HalfSpace, Probe, Table};

const RADIUS: f64 = 1.0;
const TENSION: f64 = 0.01;

/// The part by which a surface tension raises the load of a contact of radius `a` at its penetration, to the first order.
fn raised(contact: &Contact, a: f64, tension: f64) -> f64 {
    0.1 * tension / contact.validity(a).expect("physical").surface_tension
}

fn half_space(probe: Probe, sphere_modulus: f64, solid: Elastic) -> Contact {
    let system = HalfSpace {
        probe,
        sphere_modulus,
        solid,
    };
    Contact::half_space(&system).expect("sound")
}

/// Of Hertz's pressure `p` on bodies with the reduced moduli `E*`, and of that under a cone, the energy of a tension `T` is
/// `2 T int p^2 dA/E*^2` for each body.
#[test]
fn a_half_space_is_stiffened_as_its_pressure_tells() {
    let (a, solid) = (1e-3, solid(0.75, 0.5));
    let sphere = Probe::Paraboloid { radius: RADIUS };
    for (modulus, shared) in [(f64::INFINITY, 1.0), (1.0, 0.5), (3.0, 0.625)] {
        let contact = half_space(sphere.clone(), modulus, solid);
        let es = 1.0 / (1.0 + 1.0 / modulus);
        let expected = 6.0 / PI * TENSION / (es * a) * shared;
        let part = raised(&contact, a, TENSION) / expected;
        assert!((part - 1.0).abs() < 1e-12, "{modulus}: {part}");
    }
    let cone = Probe::Cone { half_angle: 1.5 };
    let expected = 8.0 * LN_2 / PI * TENSION / a;
    let part = raised(&half_space(cone, f64::INFINITY, solid), a, TENSION) / expected;
    assert!((1.0..1.2).contains(&part), "{part}");
}

/// The stiffness of a flat punch on a half-space is `2 E* a` without tension, and between two tensions follows a power of them.
#[test]
fn a_flat_punch_is_stiffened_at_its_edge() {
    let stiffnesses = Data::read("surface_tension").column("stiffness");
    let parts = [0, 1].map(|i| stiffnesses[i] / 2.0 - 1.0);
    let power = (parts[1] / parts[0]).ln() / 5_f64.ln();
    let expected = 0.01 * (0.1 / parts[0]).powf(power.recip());
    for (modulus, shared) in [(f64::INFINITY, 1.0), (1.0, 0.5)] {
        let punch = Probe::FlatPunch { radius: 1e-3 };
        let contact = half_space(punch, modulus, solid(0.75, 0.5));
        let es = 1.0 / (1.0 + 1.0 / modulus);
        let found = contact.validity(1e-3).expect("physical").surface_tension;
        let part = found / (expected * es * 1e-3 / shared);
        assert!((part - 1.0).abs() < 0.05, "{modulus}: {part}");
    }
}

/// Loads at the penetrations of a rigid paraboloid with a small tension.
#[test]
fn another_program_finds_the_load_with_surface_tension() {
    let (gel, modulus) = (solid(0.75, 0.5), f64::INFINITY);
    let paraboloid = Probe::Paraboloid { radius: RADIUS };
    let data = Data::read("surface_tension");
    let small = data.cases().filter(|case| case.get("s") == TENSION);
    for (case, error) in small.zip([0.01, 0.16, 0.06]) {
        let [a_over_t, load, penetration] =
            ["a_over_t", "load", "penetration"].map(|name| case.get(name));
        let a = 1e-3;
        let contact = if a_over_t == 0.0 {
            half_space(paraboloid.clone(), modulus, gel)
        } else {
            let system = rigid_probe(paraboloid.clone(), gel, a / a_over_t, solid(modulus, 0.3));
            Contact::in_table(Table::embedded(), &system).expect("in the table")
        };
        let wanted = penetration * a * a / RADIUS;
        let [radius, without] = without_tension(&contact, wanted, a);
        let part = load * a.powi(3) / RADIUS / without - 1.0;
        let expected = raised(&contact, radius, TENSION * a);
        assert!(
            (expected / part - 1.0).abs() < error,
            "{a_over_t}: {expected} {part}"
        );
    }
}

/// Returns the contact radius at a penetration, which is a little more than that of the radius `a`, and the load.
fn without_tension(contact: &Contact, penetration: f64, a: f64) -> [f64; 2] {
    let state = |a| contact.load_and_penetration(a, 0.0).expect("in the table");
    let [mut low, mut high] = [a, 1.1 * a];
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if state(middle).1 < penetration {
            low = middle;
        } else {
            high = middle;
        }
    }
    [low, state(low).0]
}
