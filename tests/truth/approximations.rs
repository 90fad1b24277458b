//! The closed forms in use, against direct solves: limits, exact first-order terms, and published
//! numbers.

use std::f64::consts::PI;

use acceptance::{Refused, larger, material, simpson, slopes, solved};
use cost::approximations::{
    bulk_jkr, dimitriadis, dimitriadis_incompressible, film_jkr, gao, garcia, hay_crawford,
    springs_in_series,
};
use interp::{Material, Quantities};
use solve::{Compliance, SurfaceCompliance};

const MATERIALS: [[f64; 4]; 5] = [
    [1.75, 0.5, 1e5, 0.25],
    [0.1, 0.3, 10.0, 0.3],
    [10.0, 0.0, 1.0, 0.5],
    [1.0, 0.45, 3.0, 0.2],
    [0.0, 0.3, 2.0, 0.2],
];

#[test]
fn jkr_of_sphere_and_film_is_the_limit_of_thick_films_and_bulk_jkr_that_of_thin_ones() {
    let (mut thick, mut thin) = (0.0, 0.0);
    for material in MATERIALS.map(material) {
        let off = |x: f64, modulus: f64| {
            let [found, jkr] = [
                solved(x, &material, 1e-10),
                Quantities::homogeneous(modulus),
            ];
            larger(
                (found.pi0 / jkr.pi0 - 1.0).abs(),
                (found.eeq / jkr.eeq - 1.0).abs(),
            )
        };
        thick = larger(thick, off(1e-6, film_jkr(&material)));
        thin = larger(thin, off(1e6, bulk_jkr(&material)));
        // The weights of Gao and of Hay and Crawford have both limits, that of thick films only if
        // the substrate is not so stiff that a ten-thousandth of its modulus matters.
        for form in [gao, hay_crawford, springs_in_series]
            .into_iter()
            .filter(|_| material.film_over_substrate() > 1e-2)
        {
            let at = |x| form(x, &material).expect("in the domain");
            thick = larger(thick, (at(1e-6) / film_jkr(&material) - 1.0).abs());
            thin = larger(thin, (at(1e6) / bulk_jkr(&material) - 1.0).abs());
        }
    }
    println!("from the limits: thick {thick:.1e}, thin {thin:.1e}");
    // Measured 9.8e-7 and 4.4e-5.
    assert!(thick <= 5e-6 && thin <= 2e-4);
}

#[test]
fn gaos_weights_are_exact_to_first_order_in_either_difference_under_any_sphere() {
    let mut worst = 0.0;
    for (e, nu) in [
        (0.0, 0.3),
        (0.0, 0.45),
        (0.0, 0.0),
        (0.0, -0.4),
        (0.7, 0.3),
        (20.0, 0.1),
    ] {
        for x in [0.01, 0.3, 1.0, 3.0, 100.0] {
            // The substrate has another shear modulus than the film, or another Poisson ratio and
            // the shear modulus of the film.
            let stiffer =
                |s: f64| material([e, nu, (1.0 + s) * if e == 0.0 { 1.0 } else { e }, nu]);
            let other = |s: f64| {
                let base = (1.0 + nu + s) / (1.0 + nu) * if e == 0.0 { 1.0 } else { e };
                material([e, nu, base, nu + s])
            };
            let [stiffer, other]: [&dyn Fn(f64) -> Material; 2] = [&stiffer, &other];
            for changed in [stiffer, other] {
                let [exact, weighted] = slopes(0.01, |s| {
                    let changed = changed(s);
                    [
                        solved(x, &changed, 1e-12).eeq,
                        gao(x, &changed).expect("in the domain"),
                    ]
                });
                worst = larger(worst, (exact - weighted).abs());
            }
        }
    }
    println!("Gao to first order: {worst:.1e}");
    // Measured 9.0e-10.
    assert!(worst <= 5e-9);
}

#[test]
fn a_film_of_the_substrates_material_leaves_gao_exact_and_hay_and_crawford_nearly() {
    let (mut off, mut fitted) = (0.0, 0.0);
    for [e, nu] in [[0.0, 0.3], [1.0, 0.5], [100.0, 0.2]] {
        let material = material([e, nu, if e == 0.0 { 1.0 } else { e }, nu]);
        for i in 0..=60 {
            let x = 10_f64.powf(-3.0 + 0.1 * f64::from(i));
            off = larger(
                off,
                (gao(x, &material).expect("in the domain") / film_jkr(&material) - 1.0).abs(),
            );
            fitted = larger(
                fitted,
                hay_crawford(x, &material).expect("in the domain") / film_jkr(&material) - 1.0,
            );
        }
    }
    // On a rigid substrate a film has no effect by Gao's weights.
    let rigid = material([1.75, 0.5, f64::INFINITY, 0.25]);
    assert_eq!(gao(1.0, &rigid).expect("in the domain"), bulk_jkr(&rigid));
    println!("homogeneous: Gao {off:.1e}, Hay and Crawford {fitted:.4}");
    assert!(off <= 1e-14);
    // `I0 (1 - I0) 0.0626` is largest at 1/2.
    assert!((0.0150..0.0157).contains(&fitted));
}

/// Returns the coefficients of `chi` to `chi^4` of a polynomial of degree 4 that is 1 at 0.
fn coefficients(polynomial: impl Fn(f64) -> f64) -> [f64; 4] {
    let [a, b, c, d] = [1.0, 2.0, 3.0, 4.0].map(|chi| (polynomial(chi) - 1.0) / chi);
    let (first, second, third) = (b - a, c - 2.0 * b + a, d - 3.0 * c + 3.0 * b - a);
    // Newton's form on 1, 2, 3, 4.
    [
        a - first + second - third,
        first - 1.5 * second + 11.0 / 6.0 * third,
        0.5 * second - third,
        third / 6.0,
    ]
}

/// Returns `int_0^inf (X(q) - 1) q^power dq` of a layer bonded to a rigid base, by Simpson's rule.
fn moment(nu: f64, power: i32) -> f64 {
    let compliance = Compliance::new(&material([0.0, nu, f64::INFINITY, 0.25]));
    let integrand = |q: f64| compliance.sample(q).excess * q.powi(power);
    simpson(integrand, 0.0, 20.0, 4000)
}

/// Returns the coefficients of the exact series to the fourth power. The kernel is `k0 + k2 y^2` to
/// that order. The penetration is solved for `a`.
fn exact_series(nu: f64) -> [f64; 4] {
    let (k0, k2) = (moment(nu, 0) / PI, -0.5 * moment(nu, 2) / PI);
    let cube = k0 * k0 * k0;
    [
        -2.0 * k0,
        14.0 / 3.0 * k0 * k0,
        -16.0 / 135.0 * (100.0 * cube + 9.0 * k2),
        2.0 / 45.0 * k0 * (715.0 * cube + 144.0 * k2),
    ]
}

/// Returns `sqrt(R delta)/t`, and the load over Hertz's at that penetration, of a layer on a rigid
/// base at `a/t = x`.
fn solved_layer(x: f64, nu: f64) -> [f64; 2] {
    let q = solved(x, &material([0.0, nu, f64::INFINITY, 0.25]), 1e-13);
    [x * q.delta0.sqrt(), 0.375 * q.pi0 / q.delta0.powf(1.5)]
}

#[test]
fn the_exact_series_is_that_of_direct_solves() {
    let mut worst = 0.0;
    for nu in [0.0, 0.3, 0.5] {
        let [c1, c2, c3, c4] = exact_series(nu);
        println!("nu = {nu}: {c1:.3} {c2:.3} {c3:.3} {c4:.3}");
        for x in [0.01, 0.02, 0.04_f64] {
            let [chi, load] = solved_layer(x, nu);
            let missing = load - (1.0 + chi * (c1 + chi * (c2 + chi * (c3 + chi * c4))));
            worst = larger(worst, (missing / x.powi(5)).abs());
        }
    }
    println!("missing: {worst:.2} x^5");
    // Measured 0.44. The rest is of the fifth power: at `x = 0.01`, an error of 0.01 in the fourth
    // coefficient would be visible.
    assert!(worst <= 1.0);
}

#[test]
fn the_series_for_layers_have_the_published_numbers() {
    let published = [[1.133, 1.283, 0.769, 0.0975], [1.133, 1.497, 1.469, 0.755]];
    for (form, published) in [dimitriadis_incompressible, garcia]
        .into_iter()
        .zip(published)
    {
        for (found, published) in coefficients(|chi| form(chi).expect("in the domain"))
            .into_iter()
            .zip(published)
        {
            assert!((found - published).abs() <= 1e-12);
        }
    }
    // The general formula has the numbers printed for an incompressible layer, except the sign of
    // the last.
    let general = coefficients(|chi| dimitriadis(chi, 0.5).expect("in the domain"));
    for (found, printed) in general.into_iter().zip([1.133, 1.283, 0.769, -0.0975]) {
        assert!((found - printed).abs() <= 6e-4, "{general:?}");
    }
}

#[test]
fn hertz_is_exact_at_first_and_the_next_term_as_far_as_it_was_fitted() {
    for nu in [0.0, 0.1, 0.2, 0.25, 0.3, 0.4, 0.45, 0.5] {
        assert_eq!(dimitriadis(0.0, nu).expect("in the domain"), 1.0);
        // The first-order term of direct solves, extrapolated to chi = 0.
        let slope = |x: f64| {
            let [chi, load] = solved_layer(x, nu);
            [chi, (load - 1.0) / chi]
        };
        let [[near, at_near], [far, at_far]] = [slope(1e-4), slope(2e-4)];
        let exact = at_near - near * (at_far - at_near) / (far - near);
        assert!((exact / exact_series(nu)[0] - 1.0).abs() <= 1e-6, "{exact}");
        let [found, ..] = coefficients(|chi| dimitriadis(chi, nu).expect("in the domain"));
        let off = found / exact - 1.0;
        println!("{nu} {exact:.5} {:.2}", 100.0 * off);
        assert!((0.0..if nu >= 0.3 { 0.007 } else { 0.07 }).contains(&off));
    }
    let exact = exact_series(0.5);
    for (form, allowed) in [
        (
            dimitriadis_incompressible as fn(f64) -> _,
            [0.006, 0.14, 0.48, 0.91],
        ),
        (garcia, [0.006, 0.011, 0.001, 0.25]),
    ] {
        assert_eq!(form(0.0).expect("in the domain"), 1.0);
        let off: [f64; 4] = std::array::from_fn(|i| {
            coefficients(|chi| form(chi).expect("in the domain"))[i] / exact[i] - 1.0
        });
        println!("terms off by {off:.3?}");
        assert!(
            off.iter()
                .zip(allowed)
                .all(|(off, allowed)| off.abs() <= allowed)
        );
    }
    // Garcia's second coefficient is the exact function of the first, 7/6 of its square. In the
    // series of Dimitriadis the factor is 1, as for a flat punch.
    let second = |form: fn(f64) -> Result<f64, solve::Error>| {
        let [c1, c2, ..] = coefficients(|chi| form(chi).expect("in the domain"));
        c2 / (c1 * c1)
    };
    assert!(
        (second(garcia) - 7.0 / 6.0).abs() <= 1e-3
            && (second(dimitriadis_incompressible) - 1.0).abs() <= 1e-3
    );
}

#[test]
fn values_outside_the_domains_are_errors_that_name_them() {
    let material = material(MATERIALS[0]);
    for x in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        for form in [gao, hay_crawford] {
            form(x, &material).refused(&format!("a_over_t; {x:?}"));
        }
    }
    for chi in [-0.1, f64::NAN, f64::INFINITY] {
        for form in [dimitriadis_incompressible, garcia, |chi| {
            dimitriadis(chi, 0.3)
        }] {
            form(chi).refused(&format!("chi; {chi:?}"));
        }
    }
    for nu in [-0.1, 0.6, f64::NAN] {
        dimitriadis(0.1, nu).refused(&format!("nu1; {nu:?}; 0.5"));
    }
}
