//! Exact identities and limits of contacts with full friction.

use std::f64::consts::PI;

use acceptance::{larger, material, relative, slopes};
use solve::stick::Sticking;

use crate::stick::confined;

/// `Gamma_eff^2 = es d(x Eeq_s)/dx`, by differences, for every Poisson ratio; where
/// `beta = 0`, `Gamma_eff` is also what the equation gives at the edge. Measured: 1.5e-13 and
/// 2.4e-15.
#[test]
fn the_energy_release_rate_is_that_of_the_compliance() {
    let mut worst = [0.0; 2];
    for (e1, nu1, e0, nu2) in [
        (0.0, 0.5, f64::INFINITY, 0.5),
        (0.0, 0.3, f64::INFINITY, 0.5),
        (0.0, 0.45, 20.0, 0.5),
        (2.0, 0.3, 40.0, 0.1),
        (0.5, 0.5, 0.02, 0.5),
    ] {
        let of = material([e1, nu1, e0, 0.25]);
        let sticking = Sticking::on_film(&of, nu2).expect("physical");
        let es = of.sphere_film_modulus();
        for x in [0.3, 3.0] {
            let compliance = |x: f64| x * sticking.punch(x, 1e-12).expect("converges").eeq_s;
            let [slope] = slopes(0.03 * x, |change| [compliance(x + change)]);
            let punch = sticking.punch(x, 1e-12).expect("converges");
            worst[0] = larger(worst[0], relative(punch.gamma_eff.powi(2), es * slope));
            if let Some([normal, shear]) = punch.edge {
                let edge = normal.hypot(shear);
                worst[1] = larger(worst[1], relative(edge, punch.gamma_eff));
            }
        }
    }
    println!("{:.1e} {:.1e}", worst[0], worst[1]);
    assert!(worst[0] <= 1e-10 && worst[1] <= 1e-11, "{worst:?}");
}

/// `3 Pi_s + x Pi_s' = 4 Eeq_s (2 Delta_s + x Delta_s')` (`dF = S_s d delta`), and
/// `(x Eeq_g U)' = x Eeq_s U' + (Gamma_s/es) x^{1/2}` with `U = x^{1/2}/Gamma_g`, by differences.
/// Measured: 8.4e-13 and 8.3e-13.
#[test]
fn growing_contacts_obey_their_identities() {
    let mut worst = [0.0; 2];
    for (e1, e0) in [(0.0, f64::INFINITY), (0.0, 10.0), (0.75, f64::INFINITY)] {
        let of = material([e1, 0.5, e0, 0.25]);
        let sticking = Sticking::on_film(&of, 0.5).expect("physical");
        let es = of.sphere_film_modulus();
        let grown = sticking.grown(4.0, 2.0, 1e-10).expect("converges");
        for x in [0.3_f64, 1.0, 3.0] {
            let grown = |x: f64| grown.at(x).expect("inside");
            let at = grown(x);
            let u = |x: f64| x.sqrt() / grown(x).gamma_g;
            let [pi_rate, delta_rate, energy_rate, u_rate] = slopes(0.02 * x, |change| {
                let x = x + change;
                let at = grown(x);
                [at.pi_s, at.delta_s, x * at.eeq_g * u(x), u(x)]
            });
            let left = 3.0 * at.pi_s + x * pi_rate;
            let right = 4.0 * at.eeq_s * (2.0 * at.delta_s + x * delta_rate);
            worst[0] = larger(worst[0], relative(left, right));
            let right = x * at.eeq_s * u_rate + at.gamma_s / es * x.sqrt();
            worst[1] = larger(worst[1], relative(energy_rate, right));
        }
    }
    println!("load {:.1e}, work of adhesion {:.1e}", worst[0], worst[1]);
    assert!(worst[0] <= 1e-10 && worst[1] <= 1e-10, "{worst:?}");
}

/// `artanh(beta)/beta`.
fn factor(beta: f64) -> f64 {
    if beta == 0.0 {
        1.0
    } else {
        beta.atanh() / beta
    }
}

/// Mossakovskii's half-space, `(1 - nu) ln(3 - 4 nu)/(1 - 2 nu)` under a rigid punch, of which a
/// thick film reminds, and the film that is like its base.
#[test]
fn half_spaces_are_the_limit_of_thick_films() {
    for nu in [-0.9_f64, -0.3, 0.0, 0.2, 0.3, 0.45, 0.49] {
        let of = material([0.0, nu, 1.0, nu]);
        let exact = (1.0 - nu) * (3.0 - 4.0 * nu).ln() / (1.0 - 2.0 * nu);
        let sticking = Sticking::on_film(&of, 0.5).expect("physical");
        for x in [1e-3, 1.0, 40.0] {
            let punch = sticking.punch(x, 1e-12).expect("converges");
            assert!(
                relative(punch.eeq_s, exact) <= 1e-13,
                "{nu}: {}",
                punch.eeq_s
            );
            assert!(relative(punch.gamma_eff, exact.sqrt()) <= 1e-13, "{nu}");
        }
    }
    for (e1, nu1, e0, nu2) in [
        (0.0, 0.3, f64::INFINITY, 0.5),
        (2.0, 0.2, 0.1, 0.4),
        (0.3, 0.5, 30.0, 0.5),
    ] {
        let of = material([e1, nu1, e0, 0.25]);
        let sticking = Sticking::on_film(&of, nu2).expect("physical");
        let exact = of.sphere_film_modulus() * factor(sticking.beta());
        let punch = sticking.punch(1e-6, 1e-12).expect("converges");
        assert!(relative(punch.eeq_s, exact) <= 1e-5, "{}", punch.eeq_s);
    }
    // One material: no effect of friction at any radius, as beta is 0.
    let nu = 0.3_f64;
    let of = material([1.0 - nu * nu, nu, 1.0 - nu * nu, nu]);
    let sticking = Sticking::on_film(&of, nu).expect("physical");
    assert_eq!(sticking.beta(), 0.0);
    let (tip, _) = sticking.tip(2.0, 2.0, 1e-8).expect("converges");
    let es = of.sphere_film_modulus();
    for (value, exact) in [
        (tip.eeq_s, es),
        (tip.gamma_g, es),
        (tip.eeq_g, es),
        (tip.delta_s, 1.0),
        (tip.pi_s, 8.0 / 3.0 * es),
    ] {
        assert!(relative(value, exact) <= 1e-12, "{value}, not {exact}");
    }
}

/// `Eeq_s -> einf artanh(beta0)/beta0`, which is approached like `ln x/x`.
#[test]
fn wide_contacts_approach_the_base() {
    for (nu1, nu0) in [(0.5, 0.3), (0.3, 0.1)] {
        let of = material([0.0, nu1, 3.0, nu0]);
        let sticking = Sticking::on_film(&of, 0.5).expect("physical");
        let beta0 = (1.0 - 2.0 * nu0) / (2.0 * (1.0 - nu0));
        let limit = of.sphere_substrate_modulus() * factor(beta0);
        let distance = |x: f64| sticking.punch(x, 1e-7).expect("converges").eeq_s / limit - 1.0;
        let [near, far] = [30.0, 200.0].map(distance);
        println!("{nu1}, {nu0}: {near:.1e} at 30, {far:.1e} at 200");
        assert!(far.abs() < 0.02 && far.abs() < 0.4 * near.abs());
    }
}

/// Lubrication: `Eeq_s = (3 pi/16) x^3 (1 + 1.67/x)`, `Gamma_eff^2 = (3 pi/4) x^3`,
/// `Gamma_t/Gamma_s = 0.983`, `Delta_s = 1/4` and `F = pi mu a^6/(8 R t^3)`, that is
/// `Pi_s = (pi/16) x^3`, of thin incompressible films on rigid bases.
#[test]
fn thin_incompressible_films_approach_lubrication() {
    let film = confined();
    for (x, allowed) in [(30.0_f64, 4e-3), (100.0, 5e-4), (300.0, 1e-4)] {
        let punch = film.punch(x, 1e-7).expect("converges");
        let cube = x.powi(3);
        let exact = 3.0 * PI / 16.0 * cube * (1.0 + 1.67 / x);
        let error = relative(punch.eeq_s, exact);
        // `Gamma_eff^2 = d(x Eeq_s)/dx` has the next term, too.
        let exact = 3.0 * PI / 4.0 * cube * (1.0 + 0.75 * 1.67 / x);
        let of_edge = relative(punch.gamma_eff.powi(2), exact);
        let [normal, shear] = punch.edge.expect("beta is 0");
        let ratio = shear / normal;
        assert!(
            error < allowed && of_edge < allowed,
            "{error:e}, {of_edge:e}"
        );
        assert!((ratio - 0.983).abs() < 1.6 / x, "{ratio}");
    }
    let [near, far] = [15.0_f64, 30.0].map(|x| {
        let (tip, _) = film.tip(x, 2.0, 1e-6).expect("converges");
        [tip.delta_s - 0.25, 16.0 * tip.pi_s / (PI * x.powi(3)) - 1.0]
    });
    println!("sphere at 15: {near:.4?}, at 30: {far:.4?}");
    for (near, far) in near.into_iter().zip(far) {
        assert!(far > 0.0 && far < 0.6 * near, "{near} {far}");
    }
}

/// Where `beta` is 0, friction changes a narrow contact by a part of the order `x^4`.
#[test]
fn narrow_contacts_do_not_feel_friction() {
    for (e1, e0) in [(0.0, f64::INFINITY), (0.0, 10.0), (2.0, 0.1)] {
        let film = Sticking::on_film(&material([e1, 0.5, e0, 0.25]), 0.5).expect("physical");
        let effect = |x: f64| film.stiffening(x, 1e-13).expect("converges") - 1.0;
        let order = (effect(0.04) / effect(0.02)).log2();
        assert!((order - 4.0).abs() < 0.1, "{order}");
    }
}
