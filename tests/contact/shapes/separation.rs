//! Equilibria under probes of any shape, and where they separate.

use std::f64::consts::PI;

use acceptance::{
    Contacts, assert_matches, flat_ended_cone, geometric, on_half_space, power_law, rigid_probe,
    rounded_cone, solid,
};
use contact::{Branch, Contact, Control, Derivatives, Error, Input, State};
use interp::{Probe, Profile};

use super::{W, contact};

/// Draws a convex profile, smooth or rough.
fn random_profile(contacts: &mut Contacts, size: f64) -> Probe {
    let count = contacts.uniform(4.0, 40.0) as usize;
    let (rough, geometric) = (contacts.uniform(0.0, 1.0), contacts.uniform(0.0, 1.0) < 0.5);
    let (mut point, mut slope) = ([0.0, 0.0], 0.0);
    let mut points = vec![point];
    for k in 0..count {
        let growth = if geometric {
            0.1 * 1.3_f64.powi(k as i32)
        } else {
            1.0
        };
        let step = growth * size * contacts.uniform(0.3, 1.3);
        if contacts.uniform(0.0, 1.0) > rough {
            slope += 0.3 / count as f64 * contacts.uniform(0.0, 1.0).powi(3);
        }
        slope += if k + 1 == count { 0.01 } else { 0.0 };
        point = [point[0] + step, point[1] + slope * step];
        points.push(point);
    }
    Probe::Profile(Profile::new(&points).expect("convex"))
}

/// No contact radius has a smaller imposed value than the pull-off, and as many stable equilibria
/// are found at an imposed value as a fine scan of the contact radii passes.
#[test]
fn equilibria_of_any_probe_are_those_of_a_fine_scan() {
    const POINTS: u32 = 1500;
    // A flat end far below the nodes.
    let blunt = flat_ended_cone(2e-8, 68.75_f64.to_radians());
    let system = rigid_probe(blunt.clone(), solid(2e4, 0.5), 1e-3, solid(7e10, 0.25));
    let material = system.material().expect("physical");
    // The smallest contact of this curve is not that of the end.
    let curve = solve::curve(&material, [1e-3, 1.0], 1e-8).expect("solved");
    let wide = Contact::new(&system, curve).expect("its own curve");
    let outside = wide.pull_off(1e-4, Control::Load);
    assert_matches!(outside, Err(Error::OutsideRadii { from, .. }) if from == 1e-6);
    let blunt = contact(blunt, solid(2e4, 0.5), 1e-3, solid(7e10, 0.25));
    let apart = blunt.pull_off(1e-4, Control::Load).expect("in range");
    assert!((apart.load / -1.100e-10 - 1.0).abs() < 1e-3, "{apart:?}");
    assert!(
        (apart.contact_radius / 1.419e-7 - 1.0).abs() < 1e-3,
        "{apart:?}"
    );

    let mut contacts = Contacts::new(47);
    let (t, mut count, mut counted) = (1e-6, 0, 0);
    for case in 0..160 {
        let film = solid(contacts.log_uniform(1e3, 1e11), contacts.uniform(0.0, 0.5));
        let substrate = solid(film.young() * contacts.log_uniform(1e-5, 1e6), 0.3);
        let size = t * contacts.log_uniform(1e-5, 1e2);
        let half_angle = contacts.uniform(0.1, 1.5);
        let probe = match case % 8 {
            0 => Probe::Sphere {
                radius: 10.0 * size,
            },
            1 => power_law(0.1 * size.powf(-1.5), 2.5),
            2 => Probe::Cone { half_angle },
            3 => rounded_cone(size, half_angle),
            4 | 5 => flat_ended_cone(size, half_angle),
            _ => random_profile(&mut contacts, size),
        };
        let contact = contact(probe.clone(), film, t, substrate);
        let w = 0.3 * film.reduced() * size * contacts.log_uniform(1e-5, 10.0);
        let control = match case % 3 {
            0 => Control::Load,
            1 => Control::Displacement,
            _ => Control::Spring {
                stiffness: film.reduced() * size * contacts.log_uniform(1e-2, 1e2),
            },
        };
        let part = contacts.uniform(0.01, 0.99);
        let Ok(equilibria) = contact.equilibria(w, control) else {
            continue;
        };
        // A pull-off out of range is an error.
        let Ok(apart) = equilibria.pull_off() else {
            continue;
        };
        count += 1;
        let least = control.imposed(apart.load, apart.penetration);
        let [from, to] = contact.contact_radius_range();
        let from = from.max(1e-4 * apart.contact_radius);
        let to = to * (1.0 - 1e-12);
        let near = [0.1, 10.0].map(|factor| factor * apart.contact_radius);
        let mut radii: Vec<f64> = geometric([from, to], POINTS)
            .chain(geometric(near, POINTS))
            .map(|a| a.clamp(from, to))
            .collect();
        radii.sort_by(f64::total_cmp);
        let values: Vec<f64> = radii
            .iter()
            .map(|&a| contact.load_and_penetration(a, w).expect("in range"))
            .map(|(load, penetration)| control.imposed(load, penetration))
            .collect();
        let scanned = values.iter().copied().fold(f64::INFINITY, f64::min);
        assert!(
            scanned > least - 1e-6 * least.abs(),
            "{probe:?} on {film:?} on {substrate:?}, {w}, {control:?}: {least}, not {scanned}"
        );
        let value = least + part * least.abs().min(values[values.len() - 1] - least);
        let rises = values
            .windows(2)
            .filter(|pair| pair[0] < value && pair[1] >= value);
        let Ok(found) = equilibria.at(value) else {
            continue;
        };
        let found = found
            .iter()
            .filter(|found| found.stable && found.state.contact_radius > from);
        assert_eq!(
            found.count(),
            rises.count(),
            "{probe:?} on {film:?} on {substrate:?}, {w}, {control:?} at {value}"
        );
        counted += 1;
    }
    assert!(count > 100 && counted > 100, "{count}, {counted}");
}

/// Maugis, Langmuir 11, 679 (1995): JKR with the exact sphere.
#[test]
fn pull_off_of_the_sphere_is_that_of_maugis() {
    let cases = [
        (1e-4, -1.49701, 0.11186),
        (1e-3, -1.48623, 0.23808),
        (1e-2, -1.43849, 0.48546),
        (1e-1, -1.25735, 0.83510),
    ];
    let (r, material) = (1e-3, solid(1e6, 0.3));
    for (reduced, pull_off, at_rest) in cases {
        let w = reduced * material.reduced() * r;
        let probe = || Probe::Sphere { radius: r };
        let bare = on_half_space(probe(), material);
        // A film of the material of the substrate takes the other way, through the table.
        let coated = contact(probe(), material, 3e-4, material);
        for contact in [&bare, &coated] {
            match contact.pull_off(w, Control::Load) {
                Ok(found) => {
                    let found = found.load / (PI * w * r);
                    assert!((found - pull_off).abs() < 6e-6, "{found}, not {pull_off}");
                }
                // On a film contacts end at 0.55 R.
                Err(Error::OutsideRadii { to, .. }) => assert!(at_rest > 0.8 && to < 0.55 * r),
                Err(other) => panic!("{other}"),
            }
            match contact.zero_load(w) {
                Ok(found) => {
                    let found = found.contact_radius / r;
                    assert!((found - at_rest).abs() < 6e-6, "{found}, not {at_rest}");
                }
                Err(Error::OutsideRadii { .. }) => assert!(at_rest > 0.8),
                Err(other) => panic!("{other}"),
            }
        }
    }
}

#[test]
fn a_flat_punch_has_one_contact_radius() {
    let (radius, film) = (5e-6, solid(1e6, 0.5));
    let punch = || Probe::FlatPunch { radius };
    let coated = contact(punch(), film, 3e-6, solid(1e9, 0.3));
    let bare = on_half_space(punch(), film);
    for contact in [&coated, &bare] {
        let q = contact.quantities(radius).expect("its radius");
        let modulus = contact.mechanics().sphere_film_modulus();
        let expected = -q.eeq / q.gamma * (8.0 * PI * W * modulus * radius.powi(3)).sqrt();
        for control in [
            Control::Load,
            Control::Displacement,
            Control::Spring { stiffness: 1.0 },
        ] {
            let found = contact.pull_off(W, control).expect("one radius");
            assert!((found.load / expected - 1.0).abs() < 1e-12, "{found:?}");
            assert!((found.contact_radius / radius - 1.0).abs() < 1e-12);
            let stiffness = contact.stiffness(radius).expect("its radius");
            assert!((found.load / (stiffness * found.penetration) - 1.0).abs() < 1e-12);
            let equilibria = contact.equilibria(W, control).expect("one radius");
            let curve = equilibria.force_displacement(1e-7, 5).expect("in range");
            let states = curve.loading[0].iter().chain(&curve.unloading[0]);
            for state in states {
                let expected = stiffness * state.penetration;
                assert!(
                    (state.load - expected).abs()
                        < 1e-12 * stiffness * 1e-7 + 1e-9 * expected.abs()
                );
            }
            assert_eq!(curve.jumps.len(), 2);
            let [imposed, last] = [1e-7, control.imposed(found.load, found.penetration)];
            for (i, state) in (0_u32..).zip(&curve.unloading[0]) {
                let expected = imposed + (last - imposed) * 0.25 * f64::from(i);
                let own = control.imposed(state.load, state.penetration);
                assert!(
                    (own - expected).abs() <= 1e-12 * (imposed + last.abs()),
                    "{control:?}: {own}"
                );
            }
        }
        assert_matches!(
            contact.load(0.9 * radius, W),
            Err(Error::Table(interp::Error::BeyondProbe { .. }))
        );
        for result in [
            contact.line(W, radius).map(drop),
            contact.radius_and_energy_release_rate(0.0, 0.0).map(drop),
            contact.jkr_fit(W, [radius, radius], 2).map(drop),
            contact.zone_size(W, 1e-9).map(drop),
        ] {
            assert_matches!(result, Err(Error::Table(interp::Error::OtherProbe { .. })));
        }
    }
    // On the half-space the stiffness is 2 E* a, and its derivatives are known in closed form.
    let equilibria = bare.equilibria(W, Control::Displacement);
    let equilibria = equilibria.expect("one radius");
    let mut states = [State::ORIGIN; 2];
    let mut derivatives = [Derivatives::ZERO; 6];
    let (values, inputs) = ([1e-8, 2e-8], [Input::SubstrateModulus, Input::SphereRadius]);
    let unloading = Branch::Unloading;
    equilibria
        .branch_with_gradient(&values, unloading, &inputs, &mut states, &mut derivatives)
        .expect("in range");
    let stiffness = 2.0 * film.reduced() * radius;
    assert!((derivatives[0].load / stiffness - 1.0).abs() < 1e-12);
    assert!((derivatives[1].load / (stiffness * 1e-8 / film.young()) - 1.0).abs() < 1e-12);
    assert!((derivatives[5].load / (stiffness * 2e-8 / radius) - 1.0).abs() < 1e-12);
}

/// A flat-ended cone separates at the radius of its end like a punch, if it is stable down to it.
#[test]
fn a_flat_end_separates_like_a_punch() {
    let (radius, film, substrate) = (5e-6, solid(1e6, 0.5), solid(1e9, 0.3));
    let cone = flat_ended_cone(radius, 0.9);
    let w = 1e-4;
    for (cone, punch) in [
        (
            contact(cone.clone(), film, 3e-6, substrate),
            contact(Probe::FlatPunch { radius }, film, 3e-6, substrate),
        ),
        (
            on_half_space(cone, film),
            on_half_space(Probe::FlatPunch { radius }, film),
        ),
    ] {
        let [cone_off, punch_off] =
            [&cone, &punch].map(|contact| contact.pull_off(w, Control::Displacement));
        let (cone_off, punch_off) = (cone_off.expect("in range"), punch_off.expect("in range"));
        assert!((cone_off.contact_radius / radius - 1.0).abs() < 1e-12);
        let found = cone.radius_and_energy_release_rate(cone_off.load, cone_off.penetration);
        let (found, released) = found.expect("the rim, to rounding");
        assert!((found / radius - 1.0).abs() < 1e-12 && (released / w - 1.0).abs() < 1e-12);
        assert!(
            (cone_off.load / punch_off.load - 1.0).abs() < 1e-9,
            "{cone_off:?}, not {punch_off:?}"
        );
        let equilibria = cone.equilibria(w, Control::Displacement).expect("in range");
        let curve = equilibria.force_displacement(1e-6, 20).expect("in range");
        assert_eq!(curve.unloading.len(), 1);
        assert_matches!(
            equilibria.unloading(2.0 * cone_off.penetration),
            Err(Error::NoContact { .. })
        );
    }
}
