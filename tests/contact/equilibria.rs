//! Equilibria of coated contacts: pull-off, stability, jumps.

use std::f64::consts::PI;

use acceptance::{
    Contacts, assert_close, assert_matches, assert_near, geometric, larger, looked_up,
    paper_system, relative, rigid_probe, solid, solved_contact,
};
use contact::{Contact, Control, Error, ForceDisplacement, State, work_of_adhesion_at_pull_off};
use interp::{Curve, Probe, System};

pub const CONTROLS: [Control; 3] = [
    Control::Load,
    Control::Displacement,
    Control::Spring { stiffness: 3.0 },
];

/// Returns the imposed value of a control in a state: load, penetration, or position of the spring.
pub fn imposed(control: Control, state: &State) -> f64 {
    control.imposed(state.load, state.penetration)
}

/// Draws `count` random coated contacts of the embedded table, each with a work of adhesion whose
/// pull-off is well inside the table.
fn coated(seed: u64, count: usize) -> impl Iterator<Item = (Contact, f64)> {
    let mut contacts = Contacts::new(seed);
    let contact = move || {
        let modulus = 2e6;
        let film = solid(
            modulus * contacts.log_uniform(1e-3, 1e3),
            contacts.uniform(0.0, 0.5),
        );
        let substrate = solid(modulus * contacts.log_uniform(1.0, 1e6), 0.25);
        let contact = looked_up(&System {
            film,
            substrate,
            ..paper_system(1e-6)
        });
        let w = with_pull_off_near(&contact, 1e-6 * contacts.log_uniform(1e-2, 1e2));
        (contact, w)
    };
    std::iter::repeat_with(contact).take(count)
}

/// Draws `count` random stiff films on soft substrates under a rigid sphere. Film or substrate may
/// govern the pull-off.
fn stiff_films(seed: u64, count: usize) -> impl Iterator<Item = (Contact, f64)> {
    let mut contacts = Contacts::new(seed);
    let contact = move || {
        let film = solid(1e9, contacts.uniform(0.0, 0.5));
        let substrate = solid(
            1e9 * contacts.log_uniform(1e-5, 1e-2),
            contacts.uniform(0.0, 0.5),
        );
        let system = System {
            sphere_modulus: f64::INFINITY,
            film,
            substrate,
            ..paper_system(1e-6)
        };
        let contact = solved_contact(&system, [1e-3, 1e3], 1e-6);
        let w = with_pull_off_near(&contact, 1e-6 * contacts.log_uniform(3e-2, 3.0));
        (contact, w)
    };
    std::iter::repeat_with(contact).take(count)
}

/// Returns the work of adhesion at which a half-space of film would be pulled off at `radius`,
/// under load control.
fn with_pull_off_near(contact: &Contact, radius: f64) -> f64 {
    let mechanics = contact.mechanics();
    8.0 * mechanics.sphere_film_modulus() * radius.powi(3)
        / (9.0 * PI * mechanics.sphere_radius().powi(2))
}

/// The pull-off force of a rigid sphere from a film on a rigid base. Two independent scripts agree
/// on the digits.
#[test]
fn pull_off_of_a_rigid_sphere_from_a_film_on_a_rigid_base() {
    /// Half of the last digit. Measured: 4.5e-5.
    const PRINTED: f64 = 0.5e-4;
    let expected = [
        (0.5, [1.5349, 1.9341, 2.3415, 2.6593]),
        (0.0, [1.5175, 1.7559, 1.9289, 1.9781]),
    ];
    for (nu1, expected) in expected {
        let (r, t) = (1e-3, 1e-6);
        let film = solid(1e6, nu1);
        let substrate = solid(f64::INFINITY, 0.25);
        let system = rigid_probe(Probe::Paraboloid { radius: r }, film, t, substrate);
        let contact = solved_contact(&system, [1e-2, 1e2], 1e-8);
        for (group, expected) in [1e-2, 1.0, 1e2, 1e4].into_iter().zip(expected) {
            let w = group * film.reduced() * t.powi(3) / (r * r);
            let found = contact.pull_off(w, Control::Load).expect("in range").load / (-PI * w * r);
            assert_near(found, expected, PRINTED);
        }
    }
}

/// Counts the equilibria by brute force on a grid that is seven times as fine.
#[test]
fn no_equilibrium_is_missed() {
    let mut contacts = Contacts::new(92);
    let mut most = 0;
    for (contact, w) in coated(91, 100).chain(stiff_films(94, 40)) {
        for control in CONTROLS {
            let equilibria = contact.equilibria(w, control).expect("physical");
            // Below 1e-15 m there are only values closer to 0 than those asked for.
            let [least, to] = contact.contact_radius_range();
            let state = |contact_radius: f64| {
                let at = contact.load_and_penetration(contact_radius, w);
                let (load, penetration) = at.expect("in range");
                State {
                    contact_radius,
                    load,
                    penetration,
                }
            };
            let radii = geometric([least.max(1e-15), to], 4000);
            let states: Vec<State> = radii.map(state).collect();
            let values: Vec<f64> = states.iter().map(|state| imposed(control, state)).collect();
            let least = values.iter().copied().fold(f64::INFINITY, f64::min);
            let pull_off = equilibria.pull_off().expect("in range");
            let found = imposed(control, &pull_off);
            assert!((least * 1.001..=least).contains(&found), "{found}, {least}");
            for _ in 0..5 {
                let value = least * contacts.uniform(-1.0, 0.999);
                let expected: Vec<usize> = (0..4000)
                    .filter(|&i| (values[i] < value) != (values[i + 1] < value))
                    .collect();
                let found = equilibria.at(value).expect("in range");
                let case = format!("at {value} of {least} under {control:?}");
                assert_eq!(found.len(), expected.len(), "{case}");
                most = most.max(found.len());
                for (equilibrium, i) in found.iter().zip(expected) {
                    let state = &equilibrium.state;
                    let [from, to] = [i, i + 1].map(|i| states[i].contact_radius);
                    assert!((from..=to).contains(&state.contact_radius));
                    let miss = (imposed(control, state) - value).abs();
                    assert!(miss <= 1e-12 * (least.abs() + value.abs()));
                    // Stable where the imposed value grows.
                    assert_eq!(equilibrium.stable, values[i] < value);
                }
                // The largest radius is what unloading reaches; loading begins at 0.
                let last = found[found.len() - 1].state;
                assert_eq!(equilibria.unloading(value).expect("in contact"), last);
                if value >= 0.0 {
                    let first = found.iter().find(|equilibrium| equilibrium.stable);
                    let first = first.expect("in contact").state;
                    assert_eq!(equilibria.loading(value).expect("in contact"), first);
                }
            }
        }
    }
    println!("{most} equilibria at most");
    // Measured: 4, so films with two stable contacts are among them.
    assert!(most >= 4);
}

/// Follows the curve step by step: the imposed value grows, then falls; it is equal before and
/// after a jump; every state is a stable equilibrium.
#[test]
fn force_displacement_curves_hold_together() {
    let mut jumps = [0; 2];
    for (contact, w) in coated(93, 100).chain(stiff_films(97, 40)) {
        for control in CONTROLS {
            let equilibria = contact.equilibria(w, control).expect("physical");
            let pull_off = equilibria.pull_off().expect("in range");
            // As far beyond 0 as pull-off is below, five times.
            let most = -5.0 * imposed(control, &pull_off);
            let curve = match equilibria.force_displacement(most, 30) {
                Err(Error::OutsideRadii { .. }) => continue,
                curve => curve.expect("physical"),
            };
            let size = most;
            let same = |one: f64, other: f64| {
                let miss = (one - other).abs();
                assert!(miss <= 1e-11 * size, "{one} and {other} of {size}")
            };
            let value = |state: &State| imposed(control, state);
            for (branches, sign) in [(&curve.loading, 1.0), (&curve.unloading, -1.0)] {
                let states: Vec<&State> = branches.iter().flatten().collect();
                assert_eq!(states.len(), 30 * branches.len());
                for pair in states.windows(2) {
                    let rise = sign * (value(pair[1]) - value(pair[0]));
                    let growth = sign * (pair[1].contact_radius - pair[0].contact_radius);
                    assert!(rise >= -1e-11 * size && growth >= 0.0, "{pair:?}");
                }
                for state in states {
                    let found = contact.load_and_penetration(state.contact_radius, w);
                    let expected = (state.load, state.penetration);
                    assert_eq!(found.expect("in range"), expected);
                }
            }
            let [loading, unloading] = [&curve.loading, &curve.unloading];
            assert_eq!(curve.jumps.len(), loading.len() + unloading.len());
            assert_eq!(curve.jumps[0].from, State::ORIGIN);
            for jump in &curve.jumps {
                let to = jump.to.unwrap_or(jump.from);
                same(value(&jump.from), value(&to));
            }
            // Jumps lead from branch to branch.
            for (i, branch) in loading.iter().enumerate() {
                assert_eq!(curve.jumps[i].to, Some(branch[0]));
                assert!(i == 0 || curve.jumps[i].from == loading[i - 1][29]);
            }
            for (i, branch) in unloading.iter().enumerate() {
                let jump = curve.jumps[loading.len() + i];
                assert_eq!(jump.from, branch[29]);
                assert!(i + 1 == unloading.len() || jump.to == Some(unloading[i + 1][0]));
            }
            same(value(&loading[loading.len() - 1][29]), most);
            same(value(&unloading[0][0]), most);
            let last = unloading[unloading.len() - 1][29];
            assert!(relative(last.contact_radius, pull_off.contact_radius) <= 1e-12);
            // What is imposed stays through the last jump.
            let apart = curve.jumps[curve.jumps.len() - 1].to;
            let expected = match control {
                Control::Load => None,
                Control::Displacement => Some(last.penetration),
                Control::Spring { .. } => Some(value(&last)),
            };
            let parted = apart.map(|to| (to.contact_radius, to.load));
            assert_eq!(parted, expected.map(|_| (0.0, 0.0)));
            if let (Some(to), Some(expected)) = (apart, expected) {
                assert!(relative(to.penetration, expected) <= 1e-12);
            }
            jumps[0] += loading.len() - 1;
            jumps[1] += unloading.len() - 1;
        }
    }
    println!("jumps between stable contacts on loading and unloading: {jumps:?}");
    // Measured: 0 and 6. On loading, under compression, none of these films gives way.
    assert!(jumps[1] > 0);
}

/// At the pull-off load no contact radius has a smaller energy release rate than the work of adhesion.
#[test]
fn the_work_of_adhesion_of_a_pull_off_load_is_its_least_energy_release_rate() {
    let (mut worst, mut count) = (0.0, 0);
    for (contact, w) in coated(17, 60).chain(stiff_films(18, 60)) {
        let load = contact.pull_off(w, Control::Load).expect("in range").load;
        let found = contact
            .work_of_adhesion_at_pull_off(load, Control::Load)
            .expect("in range");
        let [from, to] = contact.contact_radius_range();
        let rates = geometric([from.max(1e-6 * to), to * (1.0 - 1e-9)], 20_000)
            .filter_map(|a| contact.energy_release_rate_at_load(a, load).ok());
        let least = rates.fold(f64::INFINITY, f64::min);
        worst = larger(worst, relative(found, least));
        count += 1;
    }
    println!("least energy release rates of {count} contacts: {worst:.1e}");
    assert!(count == 120 && worst <= 1e-5, "{worst:e}");
}

/// On a spring, a thin film of a soft gel separates at a contact radius of 46 nm or of 2.3 um, by the work of adhesion.
#[test]
fn a_load_within_a_jump_of_the_pull_off_load_is_refused() {
    let probe = Probe::Paraboloid { radius: 1e-5 };
    let system = rigid_probe(probe, solid(1e4, 0.5), 1e-7, solid(7e10, 0.22));
    let contact = looked_up(&system);
    let control = Control::Spring { stiffness: 10.0 };
    let found = |load| contact.work_of_adhesion_at_pull_off(load, control);
    let Err(Error::NoWorkOfAdhesion {
        work_of_adhesion,
        above,
        below,
        ..
    }) = found(-1e-6)
    else {
        panic!("{:?}", found(-1e-6));
    };
    for (w, beside) in [(0.999, above), (1.001, below)] {
        let state = contact.pull_off(w * work_of_adhesion, control);
        let load = state.expect("in range").load;
        assert_close(load, beside, 0.01);
        let of_load = found(load).expect("a load of a pull-off");
        assert_close(of_load, w * work_of_adhesion, 1e-6);
    }
    assert!(below < -1e-6 && -1e-6 < above);
    let saturates = |_| Ok::<_, Error>(-1e-9);
    let refused = work_of_adhesion_at_pull_off(-2e-9, None, saturates);
    assert_matches!(refused, Err(Error::NoWorkOfAdhesion { .. }));
}

/// The work of adhesion with which a search begins may have no answer where the one wanted has: that of a blunt cone.
#[test]
fn a_search_goes_on_from_a_work_of_adhesion_with_an_answer() {
    let no_answer = || Error::Sticks {
        question: "the pull-off",
        reason: "it is a test",
    };
    let pull_off = |w: f64| (w < 1.0).then(|| -1e-7 * w * w).ok_or_else(no_answer);
    let found = work_of_adhesion_at_pull_off(-9e-9, Some(1e-11), pull_off);
    assert!(relative(found.expect("an answer"), 0.3) < 1e-9);
}

/// Invented quantities with `F0 ~ x^3 (1/(1 + x^6) + c)`, which rises to a maximum, falls to a
/// minimum and rises again.
#[test]
fn a_load_that_falls_between_two_rises_is_jumped_over_both_ways() {
    let system = paper_system(1e-6);
    let material = system.material().expect("physical");
    let node = |i: u32| {
        let x = 10_f64.powf(-2.0 + f64::from(i) / 1000.0);
        let mut quantities = material.thick_film_limit();
        quantities.pi0 = 1.0 / (1.0 + x.powi(6)) + 1e-4;
        (x, quantities)
    };
    let nodes: Vec<_> = (0..=4000).map(node).collect();
    let curve = Curve::through(&nodes, material).expect("sound samples");
    let contact = Contact::new(&system, curve).expect("its own curve");
    let equilibria = contact.equilibria(0.0, Control::Load).expect("physical");
    // With z = x^3, F = z/(1 + z^2) + c z in units of E* t^3/(2R) is stationary where c z^4 + (2c -
    // 1) z^2 + 1 + c = 0.
    let (unit, c): (f64, f64) = (2e6 * 1e-18 / 2e-3, 1e-4);
    let root = ((1.0 - 2.0 * c).powi(2) - 4.0 * c * (1.0 + c)).sqrt();
    let [top, bottom] = [-1.0, 1.0].map(|sign| ((1.0 - 2.0 * c + sign * root) / (2.0 * c)).sqrt());
    let load = |z: f64| z / (1.0 + z * z) + c * z;
    // At the other end of a jump: c z^3 - F z^2 + (1 + c) z - F = c (z - z0)^2 (z - 2 h) with z0^2
    // h = F/(2c).
    let landing = |z: f64| load(z) / (c * z * z);
    let mut worst = 0.0;
    let curve = equilibria.force_displacement(10.0 * load(top) * unit, 50);
    let curve = curve.expect("in range");
    let [loading, unloading] = [&curve.loading, &curve.unloading].map(Vec::len);
    assert_eq!([loading, unloading, curve.jumps.len()], [2; 3]);
    for (jump, z) in curve.jumps.iter().zip([top, bottom]) {
        let to = jump.to.expect("another contact");
        for (state, z) in [(&jump.from, z), (&to, landing(z))] {
            worst = larger(worst, relative(state.contact_radius, 1e-6 * z.cbrt()));
            worst = larger(worst, relative(state.load, unit * load(z)));
        }
    }
    println!("jumps between two branches: {worst:.1e}");
    // Measured: 1.2e-13.
    assert!(worst <= 1e-9);
    // Between the two, three equilibria, and which of the stable ones is there depends on the way.
    let between = 0.5 * (load(top) + load(bottom)) * unit;
    let found = equilibria.at(between).expect("in range");
    let stability = found.iter().map(|equilibrium| equilibrium.stable);
    assert!(stability.eq([true, false, true]), "{found:?}");
    let [up, down] = [equilibria.loading(between), equilibria.unloading(between)];
    assert_eq!(up.expect("in contact"), found[0].state);
    assert_eq!(down.expect("in contact"), found[2].state);
}

/// Compares contacts below the nodes of the table with direct solves.
#[test]
fn on_thick_films_states_are_those_of_direct_solves() {
    let (w, mut worst, mut worst_radius) = (0.04, 0.0, 0.0);
    for t in [5e-2, 0.2, 1.0, 10.0] {
        let system = paper_system(t);
        let contact = looked_up(&system);
        let direct = solved_contact(&system, [1e-6, 1.0], 1e-9);
        assert_eq!(contact.contact_radius_range()[0], 0.0);
        for control in CONTROLS {
            let [found, truth] =
                [&contact, &direct].map(|contact| contact.pull_off(w, control).expect("in range"));
            let error = relative(found.contact_radius, truth.contact_radius);
            worst_radius = larger(worst_radius, error);
            let error = relative(imposed(control, &found), imposed(control, &truth));
            worst = larger(worst, error);
            // The states of every branch.
            let [found, truth] = [&contact, &direct].map(|contact| {
                let equilibria = contact.equilibria(w, control).expect("physical");
                equilibria.force_displacement(1e-6, 20).expect("in range")
            });
            let states = |curve: &ForceDisplacement| {
                [curve.loading.concat(), curve.unloading.concat()].concat()
            };
            let (found, truth) = (states(&found), states(&truth));
            assert_eq!(found.len(), truth.len());
            for (found, truth) in found.iter().zip(&truth) {
                worst = larger(worst, relative(found.contact_radius, truth.contact_radius));
            }
        }
    }
    println!("thick films: {worst:.1e}, radii at pull-off {worst_radius:.1e}");
    // Measured: 1.7e-10, 9.4e-11.
    assert!(worst <= 1e-8 && worst_radius <= 1e-8);
}

/// At the pull-off the stable and the unstable equilibrium are one, which is called unstable.
#[test]
fn an_equilibrium_at_a_turning_point_is_listed_once() {
    for (contact, w) in coated(7, 20) {
        for control in CONTROLS {
            let equilibria = contact.equilibria(w, control).expect("in range");
            let end = equilibria.pull_off().expect("in range");
            let found = equilibria.at(imposed(control, &end)).expect("in range");
            let near = found
                .iter()
                .filter(|one| relative(one.state.contact_radius, end.contact_radius) < 1e-3);
            let stable: Vec<bool> = near.map(|one| one.stable).collect();
            assert_eq!(stable, [false], "{control:?}");
        }
    }
}
