//! Dundurs-equivalent materials, and Gao's exact first-order solution.

use std::f64::consts::PI;

use acceptance::{Contacts, assert_names, larger, material, relative_error, solved};
use interp::{Error, Material, SubstratePoissonRatio};

/// Largest relative difference of equivalent materials' quantities. Measured: 6.2e-15; 2.0e-15
/// under a rigid sphere.
const EQUAL: f64 = 5e-14;
/// Largest relative difference of the quantities of paired equivalents.
const PAIRED: f64 = 2e-12;
/// The tolerance of the solves. Equivalent materials share the errors of truncation and quadrature.
const TOLERANCE: f64 = 1e-10;
/// Largest change of `nu1`, and largest relative change of a modulus, by a round trip, and of a reduced
/// modulus by one way. Measured: 6.7e-16.
const ROUND_TRIP: f64 = 1e-14;
/// Largest error of the derivative that Gao gives. Measured: 1.3e-12.
const GAO: f64 = 2e-11;

/// Draws `count` random materials and their equivalents on a substrate of another Poisson ratio.
fn equivalents(seed: u64, count: usize) -> impl Iterator<Item = (Contacts, Material, Material)> {
    let mut contacts = Contacts::new(seed);
    std::iter::repeat_with(move || {
        let material = contacts.material([1e-2, 1e4], [1e-2, 1e6]);
        let nu0 = contacts.poisson_ratio();
        let equivalent = material.with_substrate_poisson_ratio(nu0).ok()?;
        Some((contacts.clone(), material, equivalent))
    })
    .flatten()
    .take(count)
}

#[test]
fn equivalent_materials_have_equal_quantities() {
    let mut worst = 0.0;
    let mut furthest: f64 = 0.0;
    for (mut contacts, material, equivalent) in equivalents(30, 100) {
        let x = contacts.log_uniform(1e-3, 100.0);
        let solved = |material| solved(x, material, TOLERANCE);
        worst = larger(
            worst,
            relative_error(&solved(&equivalent), &solved(&material)),
        );
        furthest = furthest.max((equivalent.nu1() - material.nu1()).abs());
    }
    println!(
        "equivalent materials: largest difference {worst:.1e}, largest change of nu1 {furthest:.2}"
    );
    assert!(worst <= EQUAL);
    assert!(
        furthest > 0.2,
        "the films must differ for the comparison to mean anything"
    );
}

/// Any film on any substrate with Poisson ratios from 0 to 1/2 has an equivalent among the paired
/// ones, whose ratio of the substrate follows from that of the film.
#[test]
fn every_material_has_an_equivalent_with_paired_poisson_ratios() {
    let mut contacts = Contacts::new(33);
    let (mut worst, mut furthest) = (0.0, 0.0_f64);
    for i in 0..200 {
        let [nu1, nu0] = [(); 2].map(|()| match contacts.uniform(0.0, 1.0) {
            share if share < 0.2 => 0.5,
            share if share < 0.4 => 0.0,
            _ => contacts.uniform(0.0, 0.5),
        });
        let given = contacts.material([1e-4, 1e4], [1e-4, 1e4]);
        let e1 = if i % 7 == 0 { 0.0 } else { given.e1_over_e2() };
        let given = material([e1, nu1, given.e0_over_e2(), nu0]);
        let equivalent = given
            .with_paired_poisson_ratios()
            .expect("ratios from 0 to 1/2");
        let paired = SubstratePoissonRatio::Paired.under(equivalent.nu1());
        assert!((equivalent.nu0() - paired).abs() < 1e-15, "{equivalent:?}");
        let x = contacts.log_uniform(1e-3, 100.0);
        let solved = |material| solved(x, material, TOLERANCE);
        worst = larger(worst, relative_error(&solved(&equivalent), &solved(&given)));
        furthest = furthest.max((equivalent.nu1() - given.nu1()).abs());
    }
    println!("paired equivalents: largest difference {worst:.1e}, change of nu1 {furthest:.2}");
    assert!(worst <= PAIRED && furthest > 0.2);
}

/// A negative Poisson ratio may leave the family.
#[test]
fn an_auxetic_film_may_have_no_pair() {
    let error = material([1.0, -0.5, 10.0, 0.25])
        .with_paired_poisson_ratios()
        .expect_err("b is negative");
    assert_names(&error.to_string(), "b = -0.; negative Poisson ratio");
}

#[test]
fn reduced_moduli_make_the_material_that_they_describe() {
    let mut contacts = Contacts::new(34);
    for _ in 0..1000 {
        let given = contacts.material([1e-8, 1e8], [1e-8, 1e8]);
        let (film, substrate) = (given.film_modulus(), given.substrate_modulus());
        let found = Material::of_reduced_moduli(
            film * (1.0 + 1.0 / substrate),
            given.nu1(),
            substrate,
            given.nu0(),
        )
        .expect("physical");
        let close = |found: f64, given: f64| found == given || (found / given - 1.0).abs() < 1e-14;
        assert!(
            close(found.e1_over_e2(), given.e1_over_e2())
                && close(found.e0_over_e2(), given.e0_over_e2()),
            "{found:?}, not {given:?}"
        );
    }
    // The limits: a rigid sphere, a rigid substrate, and both.
    let limit = |film, substrate| {
        let material = Material::of_reduced_moduli(film, 0.5, substrate, 0.25).expect("a limit");
        [material.e1_over_e2(), material.e0_over_e2()]
    };
    assert_eq!(limit(0.5, 0.0), [0.0, 2.0 * (15.0 / 16.0) / 0.75]);
    assert_eq!(limit(0.5, f64::INFINITY), [0.375, f64::INFINITY]);
    assert_eq!(limit(0.0, 1.0), [0.0, f64::INFINITY]);
    for (film, substrate) in [
        (-1.0, 1.0),
        (f64::INFINITY, 1.0),
        (1.0, -1.0),
        (f64::NAN, 1.0),
    ] {
        assert!(matches!(
            Material::of_reduced_moduli(film, 0.3, substrate, 0.3),
            Err(Error::Unphysical { .. })
        ));
    }
}

#[test]
fn an_equivalent_has_the_same_moduli_and_the_round_trip_gives_the_material_back() {
    let mut worst = 0.0;
    // At nu1 = 0.5 exactly, rounding may carry the way back past 0.5.
    for (_, material, equivalent) in
        equivalents(31, 1000).filter(|(_, material, _)| material.nu1() < 0.5)
    {
        let back = equivalent
            .with_substrate_poisson_ratio(material.nu0())
            .expect("the way back exists");
        assert_eq!(back.nu0(), material.nu0());
        let mut differences = vec![
            back.nu1() - material.nu1(),
            back.e1_over_e2() / material.e1_over_e2() - 1.0,
            equivalent.film_modulus() / material.film_modulus() - 1.0,
        ];
        if material.e0_over_e2() == f64::INFINITY {
            assert_eq!(back.e0_over_e2(), f64::INFINITY);
        } else {
            differences.push(back.e0_over_e2() / material.e0_over_e2() - 1.0);
            let modulus = material.substrate_modulus();
            differences.push(equivalent.substrate_modulus() / modulus - 1.0);
        }
        worst = differences.iter().map(|d| d.abs()).fold(worst, larger);
    }
    println!("round trip: largest change {worst:.1e}");
    assert!(worst <= ROUND_TRIP);
}

#[test]
fn an_equivalent_keeps_the_reduced_moduli_and_the_normalisation() {
    for e1_over_e2 in [0.0, 3.0] {
        let given = material([e1_over_e2, 0.4, 20.0, 0.1]);
        let equivalent = given.with_substrate_poisson_ratio(0.35).expect("reachable");
        assert!(equivalent != given);
        assert_eq!(equivalent.normalisation(), given.normalisation());
        assert!(
            (equivalent.film_modulus() / given.film_modulus() - 1.0).abs() <= 4.0 * f64::EPSILON
        );
        assert!(
            (equivalent.substrate_modulus() / given.substrate_modulus() - 1.0).abs()
                <= 4.0 * f64::EPSILON
        );
        assert_eq!(
            given.with_substrate_poisson_ratio(0.1).expect("its own"),
            given
        );
    }
}

#[test]
fn a_rigid_sphere_has_equivalents_too() {
    let given = material([0.0, 0.4, 0.7, 0.1]);
    let equivalent = given.with_substrate_poisson_ratio(0.0).expect("reachable");
    let mut worst = 0.0;
    for x in [0.01, 0.5, 3.0, 40.0] {
        let solved = |material| solved(x, material, TOLERANCE);
        worst = larger(worst, relative_error(&solved(&equivalent), &solved(&given)));
    }
    println!("rigid sphere: largest difference {worst:.1e}");
    assert!(worst <= EQUAL);
}

#[test]
fn an_unreachable_equivalent_is_an_error_that_names_nu1() {
    // An incompressible film on an incompressible substrate instead of a compressible one: k1 < 0.
    // A film much stiffer than its substrate, the other way: k1 > 3/2.
    for (given, nu0) in [
        (material([1.0, 0.5, 1.0, 0.25]), 0.5),
        (material([1.0, 0.3, 1e-3, 0.5]), 0.0),
    ] {
        match given.with_substrate_poisson_ratio(nu0) {
            Err(
                error @ Error::Unphysical {
                    name: "nu1", value, ..
                },
            ) => {
                assert!(
                    !(value > -1.0 && value <= 0.5),
                    "nu1 = {value} would have been fine"
                );
                let message = error.to_string();
                assert!(
                    message.contains("nu1")
                        && message.contains(&value.to_string())
                        && message.contains("(-1, 0.5]"),
                    "{message}"
                );
            }
            other => panic!("{other:?}"),
        }
    }
    // Just within reach on either side.
    let k = |nu: f64| (1.0 - 2.0 * nu) / (1.0 - nu);
    let incompressible = material([1.0, 0.5, 1.0, 0.25]);
    let nu1 = incompressible
        .with_substrate_poisson_ratio(0.2)
        .expect("k1 = r (k(0.2) - k(0.25)) > 0")
        .nu1();
    let r = incompressible.film_modulus() / incompressible.substrate_modulus();
    assert!((k(nu1) - r * (k(0.2) - k(0.25))).abs() <= 1e-15, "{nu1}");
    for nu0 in [f64::NAN, f64::INFINITY, -1.0, 0.5000000000000001] {
        assert!(matches!(
            incompressible.with_substrate_poisson_ratio(nu0),
            Err(Error::Unphysical { name: "nu0", .. })
        ));
    }
}

/// Returns `phi(y)` of Gao, Chiu and Lee (1992) at `y = t/a`. To first order in the mismatch and at
/// equal Poisson ratios, a rigid punch on a coated substrate has
/// `S/(2 a E1*) = 1 + (1 - phi(t/a)) (E0/E1 - 1)`.
fn gao(y: f64, nu: f64) -> f64 {
    let logarithm = (1.0 - 2.0 * nu) * y * (1.0 / (y * y)).ln_1p();
    2.0 / PI * y.atan() + (logarithm - y / (1.0 + y * y)) / (2.0 * PI * (1.0 - nu))
}

#[test]
fn the_stiffness_is_gaos_to_first_order_in_the_modulus_mismatch() {
    const STEP: f64 = 0.01;
    let mut worst = 0.0;
    for nu in [-0.4, 0.0, 0.25, 0.3, 0.49, 0.5] {
        for x in [0.01, 0.1, 0.5, 1.0, 3.0, 10.0, 100.0] {
            let stiffness = |steps: f64| {
                let material = material([0.0, nu, 1.0 + steps * STEP, nu]);
                solved(x, &material, 1e-12).eeq
            };
            let difference = |n: f64| (stiffness(n) - stiffness(-n)) / (2.0 * STEP);
            // Sixth order.
            let slope = 1.5 * difference(1.0) - 0.3 * difference(2.0) + difference(3.0) / 30.0;
            worst = larger(worst, (slope - (1.0 - gao(1.0 / x, nu))).abs());
        }
    }
    println!("Gao's derivative: largest error {worst:.1e}");
    assert!(worst <= GAO);
}
