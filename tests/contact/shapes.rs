//! Other shapes of the probe than the paraboloid.

use std::f64::consts::PI;

use acceptance::{Contacts, Data, larger};
use contact::Error;
use contact::{Branch, Contact, Control, Derivatives, Input, Neglected, State};
use interp::{Elastic, HalfSpace, Probe, Profile, System, Table};
use solve::solve_power_laws;

/// Work of adhesion, J/m^2.
const W: f64 = 0.04;
const HALF_ANGLE: f64 = 1.2;

fn solid(young: f64, poisson: f64) -> Elastic {
    Elastic::new(young, poisson).expect("physical")
}

/// A rigid probe on a film on a substrate.
fn system(probe: Probe, film: Elastic, film_thickness: f64, substrate: Elastic) -> System {
    System {
        probe,
        sphere_modulus: f64::INFINITY,
        film,
        film_thickness,
        substrate,
    }
}

fn contact(probe: Probe, film: Elastic, film_thickness: f64, substrate: Elastic) -> Contact {
    let system = system(probe, film, film_thickness, substrate);
    Contact::in_table(Table::embedded(), &system).expect("in the table")
}

fn half_space(probe: Probe, solid: Elastic) -> Contact {
    let system = HalfSpace {
        probe,
        sphere_modulus: f64::INFINITY,
        solid,
    };
    Contact::half_space(&system).expect("physical")
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
fn shapes() -> Vec<Probe> {
    vec![
        Probe::Paraboloid { radius: 4e-5 },
        Probe::Sphere { radius: 4e-5 },
        Probe::PowerLaw {
            coefficient: 1e13,
            exponent: 4.0,
        },
        Probe::PowerLaw {
            coefficient: 1e6,
            exponent: 2.5,
        },
        Probe::Cone {
            half_angle: HALF_ANGLE,
        },
        Probe::RoundedCone {
            radius: 1e-5,
            half_angle: HALF_ANGLE,
        },
        Probe::FlatEndedCone {
            radius: 3e-6,
            half_angle: HALF_ANGLE,
        },
        Probe::Profile(profile()),
    ]
}

/// Power laws on films, by independent programs.
#[test]
fn power_laws_are_those_of_the_reference_to_the_accuracy_of_the_table() {
    let table = Table::embedded();
    let data = Data::read("shapes");
    let kappa = |n: f64| match n as u32 {
        1 => 0.5 * PI,
        3 => 0.75 * PI,
        4 => 8.0 / 3.0,
        _ => 3.2,
    };
    let (t, unit) = (1e-6, 1e6);
    let mut worst: f64 = 0.0;
    for case in data.cases() {
        let [x, e1, n] = ["a_over_t", "e1_over_e2", "n"].map(|name| case.get(name));
        let film = solid(e1 * unit, case.get("nu1"));
        let substrate = solid(case.get("e0_over_e2") * unit, case.get("nu0"));
        let coefficient = if n == 1.0 { 0.1 } else { 1e3 };
        let probe = if n == 1.0 {
            Probe::Cone {
                half_angle: 10_f64.atan(),
            }
        } else {
            Probe::PowerLaw {
                coefficient,
                exponent: n,
            }
        };
        let system = System {
            sphere_modulus: unit,
            ..system(probe, film, t, substrate)
        };
        let contact = Contact::in_table(table, &system).expect("in the table");
        let a = x * t;
        let (load, penetration) = contact.load_and_penetration(a, 0.0).expect("in range");
        let scale = coefficient * kappa(n) * a.powf(n);
        let misses = [
            load / (0.5 * scale * a * unit) / case.get("pi_n") - 1.0,
            penetration / scale / case.get("delta_n") - 1.0,
        ];
        for miss in misses {
            worst = larger(worst, miss.abs());
            assert!(
                miss.abs() < table.description().tolerance,
                "r^{n} at {x} with {e1}: {misses:?}"
            );
        }
    }
    println!("worst: {worst:.1e}");
    assert!(data.cases().count() > 30);
}

/// Returns the factor `kappa_n` of `b = kappa_n c s^n`, `n int_0^1 u^(n-1)/sqrt(1 - u^2) du`. With `u
/// = sin(v)` the midpoint rule is exact to rounding for an exponent that is not small; smaller ones
/// follow from `kappa_n = kappa_(n+2) (n + 1)/(n + 2)`.
fn kappa(n: f64) -> f64 {
    const COUNT: u32 = 1000;
    let upper = n + 8.0;
    let step = 0.5 * PI / f64::from(COUNT);
    let sum: f64 = (0..COUNT)
        .map(|i| (step * (f64::from(i) + 0.5)).sin().powf(upper - 1.0))
        .sum();
    let down: f64 = (0..4)
        .map(|i| n + 2.0 * f64::from(i))
        .map(|n| (n + 1.0) / (n + 2.0))
        .product();
    down * upper * sum * step
}

/// Returns the largest relative error of load and penetration without adhesion of a power law,
/// against a direct solve to `tolerance`; `None` where the solve does not reach it, as at large
/// exponents and radii.
fn error_of_power_law(
    contact: &Contact,
    n: f64,
    coefficient: f64,
    (x, tolerance): (f64, f64),
) -> Option<f64> {
    let system = contact.system().expect("a film");
    let a = x * system.film_thickness;
    let material = system.material().expect("physical");
    let (_, truth) = match solve_power_laws(x, &material, &[n], tolerance) {
        Err(solve::Error::NotConverged { .. }) => return None,
        truth => truth.expect("in the domain"),
    };
    let (load, penetration) = contact.load_and_penetration(a, 0.0).expect("in range");
    let scale = coefficient * kappa(n) * a.powf(n);
    let loads = load / (0.5 * scale * a * system.sphere_modulus) / truth[0].pi - 1.0;
    let penetrations = penetration / scale / truth[0].delta - 1.0;
    Some(larger(loads.abs(), penetrations.abs()))
}

/// Every exponent that is accepted, on films from a million times softer to a million times stiffer
/// than their substrate, by the table and by a direct curve, against direct solves.
#[test]
fn power_laws_of_every_exponent_are_those_of_direct_solves() {
    const CURVE: f64 = 1e-8;
    let table = Table::embedded();
    let mut contacts = Contacts::new(41);
    let (t, unit) = (1e-6, 1e6);
    let (mut worst, mut unsolved) = ([0.0; 2], 0);
    for case in 0..60 {
        let n = match case % 4 {
            0 => 1.0,
            1 => contacts.uniform(1.0, 2.0),
            2 => contacts.uniform(2.0, 20.0),
            _ => [10.0, 12.0, 14.0, 16.0, 18.0, 20.0][case / 4 % 6],
        };
        let (young, ratio) = (
            unit * contacts.log_uniform(1e-3, 1e3),
            contacts.log_uniform(1e-6, 1e6),
        );
        let (film, substrate) = (
            solid(young, contacts.uniform(0.0, 0.5)),
            solid(ratio * young, contacts.uniform(0.0, 0.5)),
        );
        let coefficient = 1e3;
        let probe = Probe::PowerLaw {
            coefficient,
            exponent: n,
        };
        let system = System {
            sphere_modulus: unit,
            ..system(probe, film, t, substrate)
        };
        let x = contacts.log_uniform(1e-3, 7e2);
        let of_table = Contact::in_table(table, &system).expect("in the table");
        let place = (x, 0.1 * table.description().tolerance);
        let Some(error) = error_of_power_law(&of_table, n, coefficient, place) else {
            unsolved += 1;
            continue;
        };
        worst[0] = larger(worst[0], error);
        assert!(
            error < table.description().tolerance,
            "r^{n} at {x}: {error:e}, {system:?}"
        );
        if case % 6 == 1 {
            let material = system.material().expect("physical");
            let Ok(curve) = solve::curve(&material, [1e-3, 1e3], CURVE) else {
                continue;
            };
            let direct = Contact::new(&system, curve).expect("its material");
            let place = (x, 0.1 * CURVE);
            let Some(error) = error_of_power_law(&direct, n, coefficient, place) else {
                continue;
            };
            worst[1] = larger(worst[1], error);
            assert!(error < CURVE, "r^{n} at {x}: {error:e}, {system:?}");
        }
    }
    println!(
        "by the table {:.1e}, directly {:.1e}; {unsolved} not solved",
        worst[0], worst[1]
    );
    assert!(unsolved < 6, "{unsolved}");
    // A large exponent on a stiff film.
    let (n, coefficient) = (20.0, 1e90);
    let probe = Probe::PowerLaw {
        coefficient,
        exponent: n,
    };
    let system = System {
        sphere_modulus: 1e20,
        ..system(probe, solid(7.33e7, 0.248), t, solid(4.086e5, 0.323))
    };
    let curve = solve::curve(&system.material().expect("physical"), [1e-2, 1e2], CURVE);
    let direct = Contact::new(&system, curve.expect("converges")).expect("its material");
    for x in [18.0, 19.0] {
        let error = error_of_power_law(&direct, n, coefficient, (x, 0.1 * CURVE));
        assert!(error.expect("solved") < CURVE, "{error:?}");
    }
}

/// The sphere is a sum of even powers, `b = sum_k s^2k/((2k - 1) R^(2k - 1))`, by direct solves.
#[test]
fn the_sphere_is_the_sum_of_its_powers_up_to_the_largest_contact() {
    let table = Table::embedded();
    let mut contacts = Contacts::new(43);
    let exponents: [f64; 10] = std::array::from_fn(|k| 2.0 * (k + 1) as f64);
    let (r, unit) = (1e-5, 1e6);
    let mut worst: f64 = 0.0;
    for _ in 0..30 {
        let young = unit * contacts.log_uniform(1e-3, 1e3);
        let film = solid(young, contacts.uniform(0.0, 0.5));
        let substrate = solid(contacts.log_uniform(1e-4, 1e6) * young, 0.3);
        let (alpha, t) = (
            contacts.uniform(0.3, 0.55),
            r * contacts.log_uniform(1e-2, 1e2),
        );
        let system = System {
            sphere_modulus: unit,
            ..system(Probe::Sphere { radius: r }, film, t, substrate)
        };
        let contact = Contact::in_table(table, &system).expect("in the table");
        let a = alpha * r;
        let (load, penetration) = contact.load_and_penetration(a, 0.0).expect("in range");
        let material = system.material().expect("physical");
        let (_, powers) =
            solve_power_laws(a / t, &material, &exponents, 1e-10).expect("in the domain");
        let (mut sums, mut rest) = ([0.0; 2], alpha.atanh());
        for (k, power) in powers.iter().enumerate() {
            let odd = 2 * k as i32 + 1;
            // What is left of the series counts as the last power.
            let last = k + 1 == powers.len();
            let term = if last {
                rest
            } else {
                alpha.powi(odd) / f64::from(odd)
            };
            rest -= term;
            sums[0] += term * power.pi;
            sums[1] += term * power.delta;
        }
        let misses = [
            load / (0.5 * unit * a * a * sums[0]) - 1.0,
            penetration / (a * sums[1]) - 1.0,
        ];
        for miss in misses {
            worst = larger(worst, miss.abs());
            assert!(miss.abs() < 1e-6, "{alpha}: {misses:?}, {system:?}");
        }
        // Farther out nothing is computed.
        assert!(matches!(
            contact.load_and_penetration(0.56 * r, 0.0),
            Err(Error::Table(interp::Error::BeyondProbe { limit, .. })) if (limit / (0.55 * r) - 1.0).abs() < 1e-12
        ));
    }
    println!("worst: {worst:.1e}");
}

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
    const POINTS: usize = 1500;
    // A flat end far below the nodes.
    let blunt = Probe::FlatEndedCone {
        radius: 2e-8,
        half_angle: 68.75_f64.to_radians(),
    };
    let system = system(blunt.clone(), solid(2e4, 0.5), 1e-3, solid(7e10, 0.25));
    let material = system.material().expect("physical");
    // The smallest contact of this curve is not that of the end.
    let curve = solve::curve(&material, [1e-3, 1.0], 1e-8).expect("solved");
    let wide = Contact::new(&system, curve).expect("its own curve");
    let outside = wide.pull_off(1e-4, Control::Load);
    assert!(
        matches!(outside, Err(Error::OutsideRadii { from, .. }) if from == 1e-6),
        "{outside:?}"
    );
    let blunt = contact(blunt, solid(2e4, 0.5), 1e-3, solid(7e10, 0.25));
    let apart = blunt.pull_off(1e-4, Control::Load).expect("in range");
    assert!((apart.load / -1.100e-10 - 1.0).abs() < 1e-3, "{apart:?}");
    assert!(
        (apart.contact_radius / 1.419e-7 - 1.0).abs() < 1e-3,
        "{apart:?}"
    );

    let mut contacts = Contacts::new(47);
    let (t, mut count) = (1e-6, 0);
    for case in 0..160 {
        let film = solid(contacts.log_uniform(1e3, 1e11), contacts.uniform(0.0, 0.5));
        let substrate = solid(film.young() * contacts.log_uniform(1e-5, 1e6), 0.3);
        let size = t * contacts.log_uniform(1e-5, 1e2);
        let half_angle = contacts.uniform(0.1, 1.5);
        let probe = match case % 8 {
            0 => Probe::Sphere {
                radius: 10.0 * size,
            },
            1 => Probe::PowerLaw {
                coefficient: 0.1 * size.powf(-1.5),
                exponent: 2.5,
            },
            2 => Probe::Cone { half_angle },
            3 => Probe::RoundedCone {
                radius: size,
                half_angle,
            },
            4 | 5 => Probe::FlatEndedCone {
                radius: size,
                half_angle,
            },
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
        let even = |from: f64, to: f64| {
            (0..=POINTS).map(move |i| from * (to / from).powf(i as f64 / POINTS as f64))
        };
        let mut radii: Vec<f64> = even(from, to)
            .chain(even(
                0.1 * apart.contact_radius,
                10.0 * apart.contact_radius,
            ))
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
    }
    assert!(count > 100, "{count}");
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
        let bare = half_space(probe(), material);
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

/// Maugis and Barquins, J. Phys. Lett. 42, L95 (1981): `-54 w^2/(pi E* cot^3)`.
#[test]
fn pull_off_of_the_cone_is_that_of_the_closed_form() {
    let material = solid(1e6, 0.3);
    let bare = half_space(
        Probe::Cone {
            half_angle: HALF_ANGLE,
        },
        material,
    );
    let found = bare.pull_off(W, Control::Load).expect("in range").load;
    let expected = -54.0 * W * W * HALF_ANGLE.tan().powi(3) / (PI * material.reduced());
    assert!((found / expected - 1.0).abs() < 1e-12, "{found}");
}

/// On a film of the material of the substrate every shape is that on a half-space.
#[test]
fn on_a_homogeneous_body_shapes_are_those_of_the_closed_forms() {
    let material = solid(1e6, 0.3);
    for probe in shapes() {
        let bare = half_space(probe.clone(), material);
        for t in [1e-8, 1e-6, 1e-4, 1e-1] {
            let coated = contact(probe.clone(), material, t, material);
            for a in [1e-9, 1e-7, 2.9e-6, 3.1e-6, 1e-5, 2.8e-5] {
                let [least, most] = coated.contact_radius_range();
                if a < least
                    || a > most
                    || (a > 0.5 * 4e-5 && matches!(probe, Probe::Sphere { .. }))
                {
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

#[test]
fn the_load_follows_the_penetration_by_the_stiffness() {
    let films = [
        (solid(1e5, 0.5), solid(1e9, 0.3)),
        (solid(1e8, 0.2), solid(1e6, 0.4)),
    ];
    for (film, substrate) in films {
        for probe in shapes() {
            let contact = contact(probe.clone(), film, 2e-6, substrate);
            for a in [1e-7, 1e-6, 3.2e-6, 8e-6, 2e-5, 2.8e-5] {
                let [least, most] = contact.contact_radius_range();
                if a < least || a > 0.999 * most {
                    continue;
                }
                let at = |a: f64| contact.load_and_penetration(a, 0.0).expect("in range");
                let step = 1e-4;
                let (more, less) = (at(a * (1.0 + step)), at(a * (1.0 - step)));
                let stiffness = (more.0 - less.0) / (more.1 - less.1);
                let miss = stiffness / contact.stiffness(a).expect("in range") - 1.0;
                assert!(miss.abs() < 1e-5, "{probe:?} at {a}: {miss:e}");
            }
        }
    }
}

/// Two ways to one contact: integrals along the curve, and the field of the flat punch.
#[test]
fn the_two_methods_agree() {
    let (film, substrate) = (solid(1e5, 0.5), solid(1e9, 0.3));
    let pairs = [
        (
            Probe::Paraboloid { radius: 1e-4 },
            Probe::RoundedCone {
                radius: 1e-4,
                half_angle: 1.2,
            },
        ),
        (
            Probe::PowerLaw {
                coefficient: 1e12,
                exponent: 4.0,
            },
            Probe::PowerLaw {
                coefficient: 1e12,
                exponent: 4.0 * (1.0 + 1e-15),
            },
        ),
    ];
    for (one, other) in pairs {
        for t in [1e-7, 3e-6, 1e-4] {
            let [one, other] =
                [&one, &other].map(|probe| contact(probe.clone(), film, t, substrate));
            for a in [1e-8, 1e-6, 1e-5, 3e-5] {
                let [one, other] =
                    [&one, &other].map(|contact| contact.load_and_penetration(a, 0.0));
                let (one, other) = (one.expect("in range"), other.expect("in range"));
                let misses = [one.0 / other.0 - 1.0, one.1 / other.1 - 1.0];
                assert!(misses.iter().all(|miss| miss.abs() < 3e-7), "{misses:?}");
            }
        }
    }
}

/// Every derivative of one shape is a difference of contacts.
#[test]
fn derivatives_are_differences() {
    const STEP: f64 = 1e-3;
    let table = Table::embedded();
    let shape = |probe: &Probe, factor: f64| match *probe {
        Probe::Sphere { radius } => Probe::Sphere {
            radius: radius * factor,
        },
        Probe::RoundedCone { radius, half_angle } => Probe::RoundedCone {
            radius: radius * factor,
            half_angle,
        },
        Probe::FlatEndedCone { radius, half_angle } => Probe::FlatEndedCone {
            radius: radius * factor,
            half_angle,
        },
        _ => probe.clone(),
    };
    for probe in shapes() {
        let own = System {
            sphere_modulus: 2e6,
            ..system(probe.clone(), solid(3.5e6, 0.4), 1e-5, solid(2e8, 0.25))
        };
        let contact = Contact::in_table_with_gradient(table, &own).expect("in the table");
        let a = 1.2e-5;
        let gradient = contact.gradient(a, W).expect("in range");
        let with = |input: Input, factor: f64| {
            let mut other = own.clone();
            let scaled = |body: Elastic| solid(factor * body.young(), body.poisson());
            match input {
                Input::SphereRadius => other.probe = shape(&probe, factor),
                Input::SphereModulus => other.sphere_modulus *= factor,
                Input::FilmThickness => other.film_thickness *= factor,
                Input::FilmModulus => other.film = scaled(own.film),
                Input::SubstrateModulus => other.substrate = scaled(own.substrate),
                Input::FilmPoisson => {
                    other.film = solid(own.film.young(), factor * own.film.poisson());
                }
                _ => {}
            }
            let a = if input == Input::ContactRadius {
                a * factor
            } else {
                a
            };
            let contact = Contact::in_table(table, &other).expect("in the table");
            contact.load_and_penetration(a, W).expect("in range")
        };
        let units = [
            (Input::ContactRadius, a),
            (Input::SphereRadius, probe.radius().unwrap_or(0.0)),
            (Input::SphereModulus, own.sphere_modulus),
            (Input::FilmThickness, own.film_thickness),
            (Input::FilmModulus, own.film.young()),
            (Input::FilmPoisson, own.film.poisson()),
            (Input::SubstrateModulus, own.substrate.young()),
        ];
        let (load, penetration) = contact.load_and_penetration(a, 0.0).expect("in range");
        for (input, unit) in units {
            if input == Input::SphereRadius && (unit == 0.0 || probe.name() == "paraboloid") {
                assert_eq!(gradient.by(input).is_err(), unit == 0.0);
                continue;
            }
            let found = gradient.by(input).expect("known");
            let (more, less) = (with(input, 1.0 + STEP), with(input, 1.0 - STEP));
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
        let own = system(probe, film, 2e-6, substrate);
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

#[test]
fn a_flat_punch_has_one_contact_radius() {
    let (radius, film) = (5e-6, solid(1e6, 0.5));
    let punch = || Probe::FlatPunch { radius };
    let coated = contact(punch(), film, 3e-6, solid(1e9, 0.3));
    let bare = half_space(punch(), film);
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
        }
        assert!(matches!(
            contact.load(0.9 * radius, W),
            Err(Error::Table(interp::Error::BeyondProbe { .. }))
        ));
        for result in [
            contact.line(W, radius).map(drop),
            contact.radius_and_energy_release_rate(0.0, 0.0).map(drop),
            contact.jkr_fit(W, [radius, radius], 2).map(drop),
            contact.adhesion_range(W, 1e-9).map(drop),
        ] {
            assert!(
                matches!(result, Err(Error::Table(interp::Error::OtherProbe { .. }))),
                "{result:?}"
            );
        }
    }
    // On the half-space the stiffness is 2 E* a, and its derivatives are known in closed form.
    let equilibria = bare
        .equilibria(W, Control::Displacement)
        .expect("one radius");
    let (mut states, zero) = (
        [State::ORIGIN; 2],
        Derivatives {
            load: 0.0,
            penetration: 0.0,
        },
    );
    let mut derivatives = [zero; 6];
    equilibria
        .branch_with_gradient(
            &[1e-8, 2e-8],
            Branch::Unloading,
            &[Input::SubstrateModulus, Input::SphereRadius],
            &mut states,
            &mut derivatives,
        )
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
    let cone = Probe::FlatEndedCone {
        radius,
        half_angle: 0.9,
    };
    let w = 1e-4;
    for (cone, punch) in [
        (
            contact(cone.clone(), film, 3e-6, substrate),
            contact(Probe::FlatPunch { radius }, film, 3e-6, substrate),
        ),
        (
            half_space(cone, film),
            half_space(Probe::FlatPunch { radius }, film),
        ),
    ] {
        let [cone_off, punch_off] =
            [&cone, &punch].map(|contact| contact.pull_off(w, Control::Displacement));
        let (cone_off, punch_off) = (cone_off.expect("in range"), punch_off.expect("in range"));
        assert!((cone_off.contact_radius / radius - 1.0).abs() < 1e-12);
        assert!(
            (cone_off.load / punch_off.load - 1.0).abs() < 1e-9,
            "{cone_off:?}, not {punch_off:?}"
        );
        let equilibria = cone.equilibria(w, Control::Displacement).expect("in range");
        let curve = equilibria.force_displacement(1e-6, 20).expect("in range");
        assert_eq!(curve.unloading.len(), 1);
        assert!(matches!(
            equilibria.unloading(2.0 * cone_off.penetration),
            Err(Error::NoContact { .. })
        ));
    }
}

/// All shapes answer the questions that the paraboloid answers.
#[test]
fn every_shape_has_curves_branches_and_energies() {
    let (film, substrate) = (solid(1e6, 0.4), solid(1e9, 0.3));
    for probe in shapes() {
        for contact in [
            contact(probe.clone(), film, 2e-6, substrate),
            half_space(probe.clone(), film),
        ] {
            let w = 1e-5;
            for control in [Control::Load, Control::Displacement] {
                let equilibria = contact.equilibria(w, control).expect("in range");
                let at = contact.load_and_penetration(1.5e-5, w).expect("in range");
                let most = if control == Control::Load { at.0 } else { at.1 };
                let curve = equilibria.force_displacement(most, 30).expect("in range");
                let last = curve.loading.last().and_then(|branch| branch.last());
                let last = last.expect("a state");
                assert!(
                    (last.contact_radius / 1.5e-5 - 1.0).abs() < 1e-6,
                    "{probe:?}"
                );
                let mut states = [State::ORIGIN; 3];
                equilibria
                    .branch(
                        &[most, 0.9 * most, 0.8 * most],
                        Branch::Unloading,
                        &mut states,
                    )
                    .expect("in range");
                for state in states {
                    let a = state.contact_radius;
                    let at_load = contact.energy_release_rate_at_load(a, state.load);
                    let at_penetration =
                        contact.energy_release_rate_at_penetration(a, state.penetration);
                    for found in [at_load, at_penetration] {
                        let found = found.expect("in range");
                        assert!((found / w - 1.0).abs() < 1e-6, "{probe:?}: {found}");
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
        let own = system(probe.clone(), film, 1e-6, film);
        assert!(
            Contact::in_table(Table::embedded(), &own).is_err(),
            "{probe:?}"
        );
        let bare = HalfSpace {
            probe: probe.clone(),
            sphere_modulus: 1e6,
            solid: film,
        };
        assert!(Contact::half_space(&bare).is_err(), "{probe:?}");
    };
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        refused(Probe::Paraboloid { radius: bad });
        refused(Probe::Sphere { radius: bad });
        refused(Probe::Cone { half_angle: bad });
        refused(Probe::FlatPunch { radius: bad });
        refused(Probe::FlatEndedCone {
            radius: bad,
            half_angle: 1.0,
        });
        refused(Probe::FlatEndedCone {
            radius: 1e-6,
            half_angle: bad,
        });
        refused(Probe::RoundedCone {
            radius: bad,
            half_angle: 1.0,
        });
        refused(Probe::PowerLaw {
            coefficient: bad,
            exponent: 2.0,
        });
        refused(Probe::PowerLaw {
            coefficient: 1.0,
            exponent: bad,
        });
    }
    refused(Probe::Cone { half_angle: 1.6 });
    refused(Probe::PowerLaw {
        coefficient: 1.0,
        exponent: 0.9,
    });
    // Extreme sizes give finite numbers or errors.
    for probe in [
        Probe::Cone { half_angle: 1e-300 },
        Probe::RoundedCone {
            radius: 1e-300,
            half_angle: 1.0,
        },
        Probe::FlatEndedCone {
            radius: 1e30,
            half_angle: 1.0,
        },
        Probe::Sphere { radius: 1e-300 },
        Probe::Sphere { radius: 1e300 },
        Probe::PowerLaw {
            coefficient: 1e300,
            exponent: 20.0,
        },
        Probe::PowerLaw {
            coefficient: 1e-300,
            exponent: 19.5,
        },
    ] {
        let own = system(probe.clone(), film, 1e-6, solid(1e9, 0.3));
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
    let elastic = System {
        sphere_modulus: 1e6,
        ..system(sphere(), solid(1e6, 0.5), 1e-3, solid(1e9, 0.3))
    };
    let elastic = Contact::in_table(Table::embedded(), &elastic).expect("in the table");
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
    assert!(matches!(
        Probe::of_numbers("profile", &[1.0, 0.0]),
        Some(Err(_))
    ));
}
