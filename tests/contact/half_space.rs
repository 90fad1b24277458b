//! The half-space without a film against JKR in closed form.

use std::f64::consts::PI;

use acceptance::{Contacts, Refused as _, half_space_of, larger, on_half_space, relative, solid};
use contact::{Contact, Control, State};
use interp::Probe;

use crate::jkr::Jkr;

/// Largest relative error of everything.
const EXACT: f64 = 1e-12;

/// Draws 300 random spheres on random half-spaces. Some spheres or half-spaces are rigid. A contact
/// a thousand times wider than that of least penetration is smaller than the sphere.
fn systems(seed: u64) -> impl Iterator<Item = (Contact, Jkr)> {
    let mut contacts = Contacts::new(seed);
    (0..300).map(move |i| {
        let mut moduli = [
            contacts.log_uniform(1e3, 1e13),
            contacts.log_uniform(1e3, 1e13),
        ];
        if i % 10 < 2 {
            moduli[i % 10] = f64::INFINITY;
        }
        let (sphere, solid) = (moduli[0], solid(moduli[1], contacts.poisson_ratio()));
        let system = half_space_of(
            Probe::Paraboloid {
                radius: contacts.log_uniform(1e-9, 1.0),
            },
            sphere,
            solid,
        );
        let e = 1.0 / (1.0 / sphere + (1.0 - solid.poisson().powi(2)) / solid.young());
        let r = system.probe.radius().expect("a paraboloid");
        let least_penetration = contacts.log_uniform(1e-7, 9e-4) * r;
        let w = 8.0 * e * least_penetration.powi(3) / (PI * r * r);
        let jkr = Jkr { r, e, w };
        (Contact::half_space(&system).expect("physical"), jkr)
    })
}

#[test]
fn states_stiffnesses_and_energy_release_rates_are_those_of_jkr() {
    let (mut contacts, mut worst) = (Contacts::new(71), 0.0);
    for (contact, jkr) in systems(70) {
        let unit = jkr.least_penetration();
        for _ in 0..10 {
            let a = unit * contacts.log_uniform(1e-3, 1e3);
            let (load, penetration) = contact.load_and_penetration(a, jkr.w).expect("any radius");
            assert_eq!(contact.load(a, jkr.w).expect("any radius"), load);
            for (found, [hertz, punch]) in [load, penetration].into_iter().zip(jkr.terms(a)) {
                worst = larger(worst, (found - (hertz - punch)).abs() / hertz.max(punch));
            }
            let (hertz, _) = contact.load_and_penetration(a, 0.0).expect("no adhesion");
            worst = larger(worst, relative(hertz, jkr.terms(a)[0][0]));
            let stiffness = contact.stiffness(a).expect("any radius");
            worst = larger(worst, relative(stiffness, 2.0 * jkr.e * a));
            // With z = (a_p/a)^(3/2) and the radius a_p of pull-off under a load. Where the
            // penetration is least it is infinite, and rounding of z changes it by its square.
            let z = 3.0 * (unit / a).powf(1.5);
            let expected = (3.0 - 3.0 * z) / (3.0 - z);
            let moving = contact.moving_stiffness(a, jkr.w).expect("any radius") / stiffness;
            worst = larger(worst, (moving - expected).abs() / expected.powi(2).max(1.0));
            let without = contact.moving_stiffness(a, 0.0).expect("any radius");
            assert_eq!(without, stiffness);
            let found = contact.radius_and_energy_release_rate(load, penetration);
            let (radius, g) = found.expect("any radius");
            let [_, [hertz, punch]] = jkr.terms(a);
            let part = (punch / hertz).min(1.0);
            worst = larger(worst, relative(radius, a) * part);
            worst = larger(worst, relative(g, jkr.w) * part * part);
            let k = contact.stress_intensity(a, jkr.w).expect("any radius");
            let mechanics = contact.mechanics();
            let edge = mechanics.edge_singularity(a, jkr.w).expect("any radius");
            let released = mechanics.energy_release_rate(a, edge);
            worst = larger(worst, relative(released, jkr.w));
            // Irwin's relation between two solids, and Maugis' K_I = F1/(2 a sqrt(pi a)) of the
            // flat-punch load F1 that adhesion takes away.
            worst = larger(worst, relative(k * k / (2.0 * jkr.e), jkr.w));
            let of_load = jkr.terms(a)[0][1] / (2.0 * a * (PI * a).sqrt());
            worst = larger(worst, relative(k, of_load));
        }
    }
    println!("JKR: forward {worst:.1e}");
    // Measured: 1.0e-14.
    assert!(worst <= EXACT);
}

#[test]
fn radii_at_a_load_are_the_two_of_jkr_with_their_stability() {
    let (mut contacts, mut worst) = (Contacts::new(74), 0.0);
    for (contact, jkr) in systems(73) {
        let equilibria = contact.equilibria(jkr.w, Control::Load).expect("physical");
        let unit = PI * jkr.w * jkr.r;
        for load in [
            contacts.uniform(-1.49, -0.01) * unit,
            contacts.log_uniform(1e-3, 1e6) * unit,
        ] {
            let found = equilibria.at(load).expect("all radii are in range");
            let [stable, unstable] = jkr.radii(load);
            let unloaded = equilibria.unloading(load).expect("in contact");
            worst = larger(worst, relative(unloaded.contact_radius, stable));
            if load < 0.0 {
                let stability = found.iter().map(|equilibrium| equilibrium.stable);
                assert!(stability.eq([false, true]), "{found:?}");
                worst = larger(worst, relative(found[0].state.contact_radius, unstable));
                worst = larger(worst, relative(found[1].state.contact_radius, stable));
            } else {
                assert!(found.len() == 1 && found[0].stable, "{found:?}");
                let loaded = equilibria.loading(load).expect("in contact");
                worst = larger(worst, relative(loaded.contact_radius, stable));
            }
            let off = |state: &State| {
                (state.load - load).abs()
                    / jkr.terms(state.contact_radius)[0]
                        .into_iter()
                        .fold(0.0, larger)
            };
            worst = found
                .iter()
                .map(|equilibrium| off(&equilibrium.state))
                .fold(worst, larger);
        }
        let zero_load = contact.zero_load(jkr.w).expect("in contact").contact_radius;
        let expected = (9.0 * PI * jkr.w * jkr.r * jkr.r / (2.0 * jkr.e)).cbrt();
        worst = larger(worst, relative(zero_load, expected));
        let apart = equilibria.at(-1.51 * unit);
        assert_eq!(apart.expect("none is out of range"), []);
    }
    println!("JKR: radii at a load {worst:.1e}");
    // Measured: 8.2e-15.
    assert!(worst <= EXACT);
}

#[test]
fn radii_at_a_penetration_are_those_of_jkr_with_their_stability() {
    let (mut contacts, mut worst) = (Contacts::new(76), 0.0);
    for (contact, jkr) in systems(75) {
        let equilibria = contact
            .equilibria(jkr.w, Control::Displacement)
            .expect("physical");
        let unit = jkr.least_penetration();
        // The penetration is 0 at 4^{2/3} = 2.52 times the radius where it is least.
        for (ratio, count, stable) in [
            (0.3, 2, false),
            (0.8, 2, false),
            (1.2, 2, true),
            (2.4, 2, true),
            (2.6, 1, true),
            (1e3, 1, true),
        ] {
            let a = ratio * contacts.uniform(0.98, 1.02) * unit;
            let found = equilibria
                .at(jkr.penetration(a))
                .expect("all radii are in range");
            assert_eq!(found.len(), count, "{ratio}: {found:?}");
            let same = &found[usize::from(stable && count == 2)];
            assert_eq!(same.stable, stable);
            worst = larger(worst, relative(same.state.contact_radius, a));
        }
    }
    println!("JKR: radii at a penetration {worst:.1e}");
    // Measured: 6.2e-15.
    assert!(worst <= EXACT);
}

#[test]
fn pull_off_under_load_displacement_and_springs_is_that_of_jkr() {
    let (mut contacts, mut worst) = (Contacts::new(78), 0.0);
    for (contact, jkr) in systems(77) {
        let unit = PI * jkr.w * jkr.r;
        let least = jkr.least_penetration();
        let mut check = |control, radius: f64, load: Option<f64>| {
            let state = contact
                .pull_off(jkr.w, control)
                .expect("all radii are in range");
            worst = larger(worst, relative(state.contact_radius, radius));
            worst = load.map_or(worst, |load| {
                larger(worst, relative(state.load, load * unit))
            });
        };
        check(Control::Load, 9_f64.cbrt() * least, Some(-1.5));
        check(Control::Displacement, least, Some(-5.0 / 6.0));
        // With s = a/least, d(delta + F/k)/da = 0 is s^{3/2} - 1 + 2 E* a/k (s^{3/2} - 3) = 0.
        let s = contacts.uniform(1.0001, 2.08);
        let power = s.powf(1.5);
        let stiffness = 2.0 * jkr.e * s * least * (3.0 - power) / (power - 1.0);
        check(Control::Spring { stiffness }, s * least, None);
        for (stiffness, load) in [(1e-12, -1.5), (1e12, -5.0 / 6.0)] {
            let spring = Control::Spring {
                stiffness: stiffness * 2.0 * jkr.e * least,
            };
            let found = contact.pull_off(jkr.w, spring).expect("in range").load / unit;
            assert!(
                (found - load).abs() <= 1e-9,
                "{found} pi w R with a spring of {stiffness:e} times the contact's stiffness"
            );
        }
    }
    println!("JKR: pull-off {worst:.1e}");
    // Measured: 3.8e-15.
    assert!(worst <= EXACT);
}

/// JKR under every control; Kendall's flat punch; a cone, of which Maugis and Barquins' load, J. Phys. Lett. 42, L95
/// (1981), has the minimum `-54 w^2 tan^3(half angle)/(pi E*)`.
#[test]
fn the_work_of_adhesion_of_a_pull_off_load_is_that_of_closed_forms() {
    let mut worst = 0.0;
    for (contact, jkr) in systems(79) {
        for (control, times) in [(Control::Load, 1.5), (Control::Displacement, 5.0 / 6.0)] {
            let load = -times * PI * jkr.w * jkr.r;
            let found = contact.work_of_adhesion_at_pull_off(load, control);
            worst = larger(worst, relative(found.expect("in range"), jkr.w));
        }
        for load in [0.0, 1e-9, f64::NAN, f64::NEG_INFINITY] {
            let refused = contact.work_of_adhesion_at_pull_off(load, Control::Load);
            refused.refused("pull-off load; < 0 and finite");
        }
    }
    let mut contacts = Contacts::new(80);
    for _ in 0..100 {
        let (w, half_angle) = (contacts.log_uniform(1e-6, 1.0), contacts.uniform(0.3, 1.4));
        let (radius, solid) = (
            contacts.log_uniform(1e-7, 1e-3),
            solid(contacts.log_uniform(1e3, 1e9), 0.4),
        );
        let e = solid.reduced();
        let punch = -(8.0 * PI * w * e * radius.powi(3)).sqrt();
        let cone = -54.0 * w * w * half_angle.tan().powi(3) / (PI * e);
        for (probe, load) in [
            (Probe::FlatPunch { radius }, punch),
            (Probe::Cone { half_angle }, cone),
        ] {
            let contact = on_half_space(probe, solid);
            let found = contact.work_of_adhesion_at_pull_off(load, Control::Load);
            worst = larger(worst, relative(found.expect("in range"), w));
            let apart = contact.pull_off(w, Control::Load).expect("in range");
            worst = larger(worst, relative(apart.load, load));
        }
    }
    // Moduli and energies in other units.
    for unit in [1e-18, 1e18] {
        let (w, solid) = (1e-3 * unit, solid(1e6 * unit, 0.4));
        let contact = on_half_space(Probe::Cone { half_angle: 1.2 }, solid);
        let load = -54.0 * w * w * 1.2_f64.tan().powi(3) / (PI * solid.reduced());
        let found = contact.work_of_adhesion_at_pull_off(load, Control::Load);
        worst = larger(worst, relative(found.expect("in range"), w));
    }
    println!("work of adhesion of a pull-off load: {worst:.1e}");
    assert!(worst <= EXACT, "{worst:e}");
}

#[test]
fn without_adhesion_it_is_hertz() {
    let mut worst = 0.0;
    for (contact, jkr) in systems(79) {
        let a = 7.0 * jkr.least_penetration();
        let [[load, _], [penetration, _]] = jkr.terms(a);
        for (control, imposed) in [(Control::Load, load), (Control::Displacement, penetration)] {
            let equilibria = contact.equilibria(0.0, control).expect("physical");
            let found = equilibria.at(imposed).expect("in range");
            assert!(found.len() == 1 && found[0].stable, "{found:?}");
            worst = larger(worst, relative(found[0].state.contact_radius, a));
            assert_eq!(equilibria.pull_off().expect("the origin"), State::ORIGIN);
            let at_rest = equilibria.at(0.0).expect("the origin");
            assert_eq!(at_rest[0].state, State::ORIGIN);
            assert_eq!(equilibria.at(-imposed).expect("nothing"), []);
            let curve = equilibria.force_displacement(imposed, 10);
            let curve = curve.expect("physical");
            let [loading, unloading] = [&curve.loading, &curve.unloading].map(Vec::len);
            assert_eq!([loading, unloading, curve.jumps.len()], [1, 1, 0]);
            let backwards: Vec<State> = curve.unloading[0].iter().rev().copied().collect();
            for (up, down) in curve.loading[0].iter().zip(backwards) {
                assert!(
                    up.load >= 0.0 && (up.load - down.load).abs() <= EXACT * load,
                    "{up:?} and {down:?}"
                );
            }
        }
        assert_eq!(contact.zero_load(0.0).expect("the origin"), State::ORIGIN);
    }
    println!("Hertz: radii {worst:.1e}");
    // Measured: 3.4e-15.
    assert!(worst <= EXACT);
}
