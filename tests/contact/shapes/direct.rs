//! Power laws and spheres on films: the reference, and direct solves.

use std::f64::consts::PI;

use acceptance::{Contacts, Data, assert_matches, larger, power_law, solid, system_of};
use contact::{Contact, Error};
use interp::{Probe, Table};
use solve::solve_power_laws;

/// Power laws on films, by independent programs.
#[test]
fn power_laws_are_those_of_the_reference_to_the_accuracy_of_the_table() {
    let table = Table::embedded();
    let data = Data::read("shapes");
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
            power_law(coefficient, n)
        };
        let system = system_of(probe, unit, film, t, substrate);
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
        let probe = power_law(coefficient, n);
        let system = system_of(probe, unit, film, t, substrate);
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
    println!("{:.1e} {:.1e} {unsolved}", worst[0], worst[1]);
    assert!(unsolved < 6, "{unsolved}");
    // A large exponent on a stiff film.
    let (n, coefficient) = (20.0, 1e90);
    let probe = power_law(coefficient, n);
    let system = system_of(probe, 1e20, solid(7.33e7, 0.248), t, solid(4.086e5, 0.323));
    let curve = solve::curve(&system.material().expect("physical"), [1e-2, 1e2], CURVE);
    let direct = Contact::new(&system, curve.expect("converges")).expect("its material");
    for x in [18.0, 19.0] {
        let error = error_of_power_law(&direct, n, coefficient, (x, 0.1 * CURVE));
        assert!(error.expect("solved") < CURVE, "{error:?}");
    }
}

/// Returns the largest relative error of load and penetration of a sphere without adhesion at `alpha` radii of
/// it. The sphere is a sum of even powers, `b = sum_k s^2k/((2k - 1) R^(2k - 1))`, each by a direct solve. `None`
/// where these do not converge.
fn error_of_sphere(contact: &Contact, alpha: f64) -> Option<f64> {
    let system = contact.system().expect("a film");
    let a = alpha * system.probe.radius().expect("a sphere");
    let material = system.material().expect("physical");
    let exponents: [f64; 10] = std::array::from_fn(|k| 2.0 * (k + 1) as f64);
    let powers = solve_power_laws(a / system.film_thickness, &material, &exponents, 1e-10);
    let (_, powers) = powers.ok()?;
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
    let unit = if system.sphere_modulus.is_finite() {
        system.sphere_modulus
    } else {
        system.film.reduced()
    };
    let (load, penetration) = contact.load_and_penetration(a, 0.0).expect("in range");
    let loads = load / (0.5 * unit * a * a * sums[0]) - 1.0;
    Some(larger(
        loads.abs(),
        (penetration / (a * sums[1]) - 1.0).abs(),
    ))
}

/// Elastic spheres on films of any kind up to the largest contact, and spheres of any size on confined films,
/// rigid ones among them, where `Gamma` grows by several powers of ten along the curve.
#[test]
fn the_sphere_is_the_sum_of_its_powers() {
    let table = Table::embedded();
    let mut contacts = Contacts::new(43);
    let (r, unit) = (1e-5, 1e6);
    let (mut worst, mut unsolved) = ([0.0; 2], 0);
    for case in 0..120 {
        let confined = case % 4 != 0;
        let young = unit * contacts.log_uniform(1e-3, 1e3);
        let (alpha, x, nu1, ratio, sphere_modulus);
        if confined {
            alpha = contacts.log_uniform(1e-3, 0.5);
            x = contacts.log_uniform(3.0, 300.0);
            nu1 = if case % 4 == 1 {
                contacts.uniform(0.48, 0.5)
            } else {
                0.5
            };
            ratio = contacts.log_uniform(1e2, 1e6);
            sphere_modulus = if case % 4 == 2 {
                1e3 * young
            } else {
                f64::INFINITY
            };
        } else {
            alpha = contacts.uniform(0.3, 0.55);
            x = alpha / contacts.log_uniform(1e-2, 1e2);
            nu1 = contacts.uniform(0.0, 0.5);
            ratio = contacts.log_uniform(1e-4, 1e6);
            sphere_modulus = unit;
        }
        let system = system_of(
            Probe::Sphere { radius: r },
            sphere_modulus,
            solid(young, nu1),
            alpha * r / x,
            solid(ratio * young, 0.3),
        );
        let of_table = Contact::in_table(table, &system).expect("in the table");
        let material = system.material().expect("physical");
        let curve = solve::curve(&material, [1e-3, 1e3], 1e-8).expect("converges");
        let direct = Contact::new(&system, curve).expect("its material");
        let bounds = [1e-6, 1e-7];
        for ((worst, bound), contact) in worst.iter_mut().zip(bounds).zip([&of_table, &direct]) {
            let Some(error) = error_of_sphere(contact, alpha) else {
                unsolved += 1;
                continue;
            };
            *worst = larger(*worst, error);
            assert!(error < bound, "{alpha} at {x}: {error:e}, {system:?}");
        }
        // Farther out nothing is computed.
        let beyond = of_table.load_and_penetration(0.56 * r, 0.0);
        assert_matches!(
            beyond,
            Err(Error::Table(interp::Error::BeyondProbe { limit, .. }))
                if (limit / (0.55 * r) - 1.0).abs() < 1e-12
        );
    }
    println!("{:.1e} {:.1e} {unsolved}", worst[0], worst[1]);
    assert!(unsolved < 20, "{unsolved}");
}
