//! Dundurs-equivalent materials.

use acceptance::{
    Contacts, assert_matches, assert_names, larger, material, relative_error, solved,
};
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

/// Draws `count` random materials, one of seven under a rigid sphere, and their equivalents on a substrate of another
/// Poisson ratio.
fn equivalents(seed: u64, count: usize) -> impl Iterator<Item = (Contacts, Material, Material)> {
    let mut contacts = Contacts::new(seed);
    (0..)
        .filter_map(move |i| {
            let drawn = contacts.material([1e-2, 1e4], [1e-2, 1e6]);
            let e1 = if i % 7 == 0 { 0.0 } else { drawn.e1_over_e2() };
            let material = material([e1, drawn.nu1(), drawn.e0_over_e2(), drawn.nu0()]);
            let nu0 = contacts.poisson_ratio();
            let equivalent = material.with_substrate_poisson_ratio(nu0).ok()?;
            Some((contacts.clone(), material, equivalent))
        })
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
    println!("{worst:.1e} {furthest:.2}");
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
        let changes = [
            change(found.e1_over_e2(), given.e1_over_e2()),
            change(found.e0_over_e2(), given.e0_over_e2()),
        ];
        assert!(
            changes.iter().all(|&change| change < 1e-14),
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
        assert_matches!(
            Material::of_reduced_moduli(film, 0.3, substrate, 0.3),
            Err(Error::Unphysical { .. })
        );
    }
}

/// Returns the relative difference, 0 of equal numbers, which may be 0 or infinite.
fn change(found: f64, given: f64) -> f64 {
    if found == given {
        0.0
    } else {
        (found / given - 1.0).abs()
    }
}

#[test]
fn an_equivalent_has_the_same_moduli_and_the_round_trip_gives_the_material_back() {
    let mut worst = 0.0;
    for (_, material, equivalent) in equivalents(31, 1000) {
        let again = |of: &Material| {
            let again = of.with_substrate_poisson_ratio(material.nu0());
            again.expect("the way back exists")
        };
        assert_eq!(again(&material), material);
        assert_eq!(equivalent.normalisation(), material.normalisation());
        let back = again(&equivalent);
        assert_eq!(back.nu0(), material.nu0());
        worst = [
            (back.nu1() - material.nu1()).abs(),
            change(back.e1_over_e2(), material.e1_over_e2()),
            change(back.e0_over_e2(), material.e0_over_e2()),
            change(equivalent.film_modulus(), material.film_modulus()),
            change(equivalent.substrate_modulus(), material.substrate_modulus()),
        ]
        .into_iter()
        .fold(worst, larger);
    }
    println!("round trip: largest change {worst:.1e}");
    assert!(worst <= ROUND_TRIP);
}

#[test]
fn an_unreachable_equivalent_is_an_error_that_names_nu1() {
    // An incompressible film on an incompressible substrate instead of a compressible one: k1 < 0.
    // A film much stiffer than its substrate, the other way: k1 > 3/2.
    for (given, nu0) in [
        (material([1.0, 0.5, 1.0, 0.25]), 0.5),
        (material([1.0, 0.3, 1e-3, 0.5]), 0.0),
    ] {
        let error = given
            .with_substrate_poisson_ratio(nu0)
            .expect_err("out of reach");
        let Error::Unphysical {
            name: "nu1", value, ..
        } = error
        else {
            panic!("{error}")
        };
        assert!(
            !(value > -1.0 && value <= 0.5),
            "nu1 = {value} would have been fine"
        );
        assert_names(
            &error.to_string(),
            &["nu1", &value.to_string(), "(-1, 0.5]"],
        );
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
        assert_matches!(
            incompressible.with_substrate_poisson_ratio(nu0),
            Err(Error::Unphysical { name: "nu0", .. })
        );
    }
}
