//! Contacts with full friction: independent values, exact identities, limits, and the contact
//! without friction through the same code. `stick_effects` has what follows for a sphere.

use std::f64::consts::PI;

use acceptance::{Case, Data, larger, material};
use interp::Elastic;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use solve::stack::{Interface, Layer, Stack};
use solve::stick::Sticking;
use solve::{solve_power_laws, solve_stack};

/// Returns the film and the sphere of a row.
fn sticking(case: &Case<'_>) -> Sticking {
    let [e1, nu1, ratio, nu0] =
        ["e1_over_e2", "nu1", "e0_over_e1", "nu0"].map(|name| case.get(name));
    let e0 = if e1 == 0.0 { ratio } else { ratio * e1 };
    Sticking::on_film(&material([e1, nu1, e0, nu0]), case.get("nu2")).expect("physical")
}

/// Returns the number in a column; `None` where it is empty.
fn given(case: &Case<'_>, column: &str) -> Option<f64> {
    (!case.text(column).is_empty()).then(|| case.get(column))
}

/// An incompressible film on a rigid base under a rigid sphere.
pub fn confined() -> Sticking {
    Sticking::on_film(&material([0.0, 0.5, f64::INFINITY, 0.0]), 0.5).expect("physical")
}

fn relative(a: f64, b: f64) -> f64 {
    (a / b - 1.0).abs()
}

/// Measured: 2.1e-11 at the tolerance 1e-10, `Gamma_t` relative to `Gamma_eff`.
#[test]
fn punches_agree_and_the_stated_error_bounds_the_true_one() {
    let (mut worst, mut rows) = (0.0, 0);
    for case in Data::read("stick").cases() {
        let (x, sticking) = (case.get("a_over_t"), sticking(&case));
        let punch = sticking
            .punch(x, 1e-10)
            .unwrap_or_else(|e| panic!("{x}: {e}"));
        let mut error = relative(punch.eeq_s, case.get("eeq_s"));
        let gamma = case.get("gamma_eff");
        error = larger(error, relative(punch.gamma_eff, gamma));
        assert_eq!(punch.edge.is_some(), given(&case, "gamma_s").is_some());
        if let Some([normal, shear]) = punch.edge {
            error = larger(error, relative(normal, case.get("gamma_s")));
            error = larger(error, (shear - case.get("gamma_t")).abs() / gamma);
        }
        assert!(error <= punch.error, "{x}: {error:e} > {:e}", punch.error);
        worst = larger(worst, error);
        rows += 1;
    }
    println!("largest error of {rows} punches: {worst:.1e}");
    assert!(rows >= 45 && worst <= 1e-10, "{rows}, {worst:e}");
}

/// Sphere, cone and fourth power, and the part that the work of adhesion drives. Measured: 1.1e-9
/// at the tolerance 1e-8.
#[test]
fn tips_agree_and_the_stated_error_bounds_the_true_one() {
    let (mut worst, mut numbers) = (0.0, 0);
    for case in Data::read("stick").cases() {
        let (x, sticking) = (case.get("a_over_t"), sticking(&case));
        if given(&case, "gamma_g").is_none() {
            continue;
        }
        for (exponent, columns) in [
            (2.0, ["delta_s", "pi_s"]),
            (1.0, ["delta1_s", "pi1_s"]),
            (4.0, ["delta4_s", "pi4_s"]),
        ] {
            if given(&case, columns[0]).is_none() {
                continue;
            }
            let (tip, stated) = sticking
                .tip(x, exponent, 1e-8)
                .unwrap_or_else(|e| panic!("{x}: {e}"));
            let pairs = [
                (tip.delta_s, columns[0]),
                (tip.pi_s, columns[1]),
                (tip.gamma_g, "gamma_g"),
                (tip.eeq_g, "eeq_g"),
                (tip.eeq_s, "eeq_s"),
            ];
            for (value, column) in pairs {
                let error = relative(value, case.get(column));
                assert!(error <= stated, "{column} at {x}: {error:e} > {stated:e}");
                worst = larger(worst, error);
                numbers += 1;
            }
        }
    }
    println!("largest error of {numbers} numbers: {worst:.1e}");
    assert!(numbers >= 300 && worst <= 1e-8, "{numbers}, {worst:e}");
}

/// Draws a system of any contrast, sphere included; every other one without coupling at the edge.
fn random_system(random: &mut Pcg64Mcg, wide: bool) -> Sticking {
    let contrast: f64 = if wide { 1e12 } else { 1e3 };
    let mut draw = || random.random_range(-contrast.ln()..contrast.ln()).exp();
    let (mut e1, ratio) = (draw(), draw());
    let mut e0 = e1 * ratio;
    match random.random_range(0..4) {
        0 => (e1, e0) = (0.0, ratio),
        1 => e0 = f64::INFINITY,
        _ => {}
    }
    let incompressible = random.random_bool(0.5);
    let mut poisson = || random.random_range(-0.9..0.5);
    let (nu0, nu1, nu2) = (poisson(), poisson(), poisson());
    let (nu1, nu2) = if incompressible {
        (0.5, 0.5)
    } else {
        (nu1, nu2)
    };
    Sticking::on_film(&material([e1, nu1, e0, nu0]), nu2).expect("physical")
}

/// Punches against punches of more modes on finer panels, of contrasts up to 1e12. A tolerance that
/// is not reached is refused: with twelve decades between film and base most digits are lost.
/// Measured: at most 0.44 of the stated error, 13 of 600 refused.
#[test]
fn stated_errors_of_punches_are_honest() {
    let mut random = Pcg64Mcg::seed_from_u64(7);
    let (mut worst, mut refused, count) = (0.0, 0, 600);
    for i in 0..count {
        let sticking = random_system(&mut random, i % 3 == 0);
        let x = random.random_range(1e-4_f64.ln()..50_f64.ln()).exp();
        let tolerance = [1e-4, 1e-6, 1e-8, 1e-9][i % 4];
        let solved = (
            sticking.punch(x, tolerance),
            sticking.punch(x, 1e-3 * tolerance),
        );
        let (Ok(punch), Ok(finer)) = solved else {
            refused += 1;
            continue;
        };
        let mut error = relative(punch.eeq_s, finer.eeq_s);
        error = larger(error, relative(punch.gamma_eff, finer.gamma_eff));
        if let (Some(edge), Some(finer_edge)) = (punch.edge, finer.edge) {
            for (a, b) in edge.into_iter().zip(finer_edge) {
                error = larger(error, (a - b).abs() / finer.gamma_eff);
            }
        }
        let stated = punch.error + finer.error;
        assert!(error <= stated, "{x}: {error:e} > {stated:e}");
        worst = larger(worst, error / stated);
    }
    println!("at most {worst:.2} of the stated error; {refused} of {count} refused");
    assert!(refused <= count / 5, "{refused}");
}

/// The same for the growing contact of spheres and cones, of contrasts up to 1000. Measured: at most
/// 0.85 of the stated error.
#[test]
fn stated_errors_of_growing_contacts_are_honest() {
    let mut random = Pcg64Mcg::seed_from_u64(8);
    let (mut worst, mut solved) = (0.0, 0);
    for i in 0..80 {
        let sticking = random_system(&mut random, false);
        if sticking.beta() != 0.0 {
            continue;
        }
        let x = random.random_range(1e-3_f64.ln()..5_f64.ln()).exp();
        let (exponent, tolerance) = ([1.0, 2.0, 3.5][i % 3], [1e-4, 1e-6, 1e-8][i / 3 % 3]);
        let (tip, stated) = sticking.tip(x, exponent, tolerance).expect("converges");
        let (finer, finer_error) = sticking
            .tip(x, exponent, 1e-2 * tolerance)
            .expect("converges");
        let pairs = [
            (tip.delta_s, finer.delta_s),
            (tip.pi_s, finer.pi_s),
            (tip.gamma_g, finer.gamma_g),
            (tip.eeq_g, finer.eeq_g),
        ];
        for (value, finer) in pairs {
            let (error, stated) = (relative(value, finer), stated + finer_error);
            assert!(error <= stated, "{x}: {error:e} > {stated:e}");
            worst = larger(worst, error / stated);
        }
        solved += 1;
    }
    println!("at most {worst:.2} of the stated error in {solved} contacts");
    assert!(solved >= 30, "{solved}");
}

/// `Gamma_eff^2 = es d(x Eeq_s)/dx`, by differences of ten points, for every Poisson ratio; where
/// `beta = 0`, `Gamma_eff` is also what the equation gives at the edge. Measured: 1.5e-13 and
/// 2.4e-15.
#[test]
fn the_energy_release_rate_is_that_of_the_compliance() {
    /// Central differences of ten points.
    const WEIGHTS: [f64; 5] = [
        5.0 / 6.0,
        -5.0 / 21.0,
        5.0 / 84.0,
        -5.0 / 504.0,
        1.0 / 1260.0,
    ];
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
            let step = 0.03 * x;
            let slope: f64 = (1..)
                .zip(WEIGHTS)
                .map(|(i, weight)| {
                    let h = f64::from(i) * step;
                    weight * (compliance(x + h) - compliance(x - h)) / step
                })
                .sum();
            let punch = sticking.punch(x, 1e-12).expect("converges");
            worst[0] = larger(worst[0], relative(punch.gamma_eff.powi(2), es * slope));
            if let Some([normal, shear]) = punch.edge {
                let edge = normal.hypot(shear);
                worst[1] = larger(worst[1], relative(edge, punch.gamma_eff));
            }
        }
    }
    println!(
        "by differences {:.1e}, at the edge {:.1e}",
        worst[0], worst[1]
    );
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
            let step = 0.02 * x;
            // Central differences of eight points.
            let slope = |value: &dyn Fn(f64) -> f64| -> f64 {
                [4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0]
                    .into_iter()
                    .zip(1..)
                    .map(|(weight, i)| {
                        let h = f64::from(i) * step;
                        weight * (value(x + h) - value(x - h)) / step
                    })
                    .sum()
            };
            let at = grown.at(x);
            let left = 3.0 * at.pi_s + x * slope(&|x| grown.at(x).pi_s);
            let right = 4.0 * at.eeq_s * (2.0 * at.delta_s + x * slope(&|x| grown.at(x).delta_s));
            worst[0] = larger(worst[0], relative(left, right));
            let u = |x: f64| x.sqrt() / grown.at(x).gamma_g;
            let left = slope(&|x| x * grown.at(x).eeq_g * u(x));
            let right = x * at.eeq_s * slope(&u) + at.gamma_s / es * x.sqrt();
            worst[1] = larger(worst[1], relative(left, right));
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

/// Lubrication: `Eeq_s = (3 pi/16) x^3 (1 + 1.67/x)`, `Gamma_eff^2 = (3 pi/4) x^3` and
/// `Delta_s = 1/4` of thin incompressible films on rigid bases.
#[test]
fn thin_incompressible_films_approach_lubrication() {
    let film = confined();
    for (x, allowed) in [(30.0_f64, 4e-3), (100.0, 5e-4)] {
        let punch = film.punch(x, 1e-7).expect("converges");
        let exact = 3.0 * PI / 16.0 * x.powi(3) * (1.0 + 1.67 / x);
        let error = relative(punch.eeq_s, exact);
        println!("{x}: {error:.1e}");
        assert!(error < allowed, "{error:e}");
        let [normal, shear] = punch.edge.expect("beta is 0");
        assert!((shear / normal - 0.983).abs() < 0.15, "{}", shear / normal);
    }
    let deltas = [15.0, 30.0].map(|x| film.tip(x, 2.0, 1e-6).expect("converges").0.delta_s - 0.25);
    assert!(deltas[1] > 0.0 && deltas[1] < 0.6 * deltas[0], "{deltas:?}");
}

/// With the coupling of pressure and shear taken out, the same code gives the contact without
/// friction. Measured: 4.9e-15 and 1.1e-14.
#[test]
fn without_friction_the_numbers_are_those_of_the_frictionless_solver() {
    let (mut of_punches, mut of_tips) = (0.0, 0.0);
    for [e1, nu1, e0, nu0] in [
        [1.75, 0.5, 1e5, 0.25],
        [0.0, 0.3, f64::INFINITY, 0.25],
        [0.0, 0.5, 20.0, 0.25],
        [2.0, 0.2, 0.5, 0.4],
    ] {
        let of = material([e1, nu1, e0, nu0]);
        let film = Sticking::on_film(&of, 0.3)
            .expect("physical")
            .without_friction();
        for x in [0.1, 1.0, 3.0] {
            let punch = film.punch(x, 1e-12).expect("converges");
            let (known, laws) = solve_power_laws(x, &of, &[4.0], 1e-12).expect("converges");
            let known = known.quantities;
            of_punches = larger(of_punches, relative(punch.eeq_s, known.eeq));
            of_punches = larger(of_punches, relative(punch.gamma_eff, known.gamma));
            let (sphere, _) = film.tip(x, 2.0, 1e-11).expect("converges");
            let (fourth, _) = film.tip(x, 4.0, 1e-11).expect("converges");
            for (value, known) in [
                (sphere.pi_s, known.pi0),
                (sphere.delta_s, known.delta0),
                (sphere.gamma_g, known.gamma),
                (sphere.eeq_g, known.eeq),
                (fourth.pi_s, laws[0].pi),
                (fourth.delta_s, laws[0].delta),
            ] {
                of_tips = larger(of_tips, relative(value, known));
            }
        }
    }
    println!("punches {of_punches:.1e}, tips {of_tips:.1e}");
    assert!(of_punches <= 1e-13, "{of_punches:e}");
    assert!(of_tips <= 1e-13, "{of_tips:e}");
}

/// A film cut into layers, and the shift of Dundurs: with all `b_i/E_i*` shifted by one constant,
/// that of the sphere included, nothing changes.
#[test]
fn layers_of_one_material_are_one_film_and_dundurs_shift_changes_nothing() {
    let solid = |young: f64, nu: f64| Elastic::new(young, nu).expect("physical");
    let (base, film) = (solid(20.0, 0.3), solid(2.0, 0.5));
    let layer = |solid: Elastic, thickness: f64| Layer {
        solid,
        thickness,
        interface: Interface::Bonded,
    };
    let layers = [0.2, 0.5, 0.3].map(|thickness| layer(film, thickness));
    let two = [layer(base, 0.4), layer(film, 0.6)];
    let of_film = Sticking::on_film(&material([2.0, 0.5, 20.0, 0.3]), 0.5).expect("physical");
    let stack = |layers: &[Layer]| {
        let stack = Stack::new(base, layers).expect("within limits");
        Sticking::on_stack(&stack, 1.0, 0.5).expect("physical")
    };
    let [cut, above] = [stack(&layers), stack(&two)];
    for x in [0.3, 2.0] {
        let expected = of_film.tip(x, 2.0, 1e-9).expect("converges").0;
        // The layer of the base's material is part of it.
        for (found, x) in [(&cut, x), (&above, 0.6 * x)] {
            let found = found.tip(x, 2.0, 1e-9).expect("converges").0;
            for (a, b) in [
                (found.eeq_s, expected.eeq_s),
                (found.pi_s, expected.pi_s),
                (found.gamma_g, expected.gamma_g),
            ] {
                assert!(relative(a, b) <= 1e-12, "{a}, not {b}");
            }
        }
    }
    // E* = E/(1 - nu^2) is kept; b/E* is shifted.
    let shifted = |e: f64, nu: f64, shift: f64| {
        let reduced = e / (1.0 - nu * nu);
        let b = (1.0 - 2.0 * nu) / (2.0 * (1.0 - nu)) + shift * reduced;
        let nu = (1.0 - 2.0 * b) / (2.0 * (1.0 - b));
        (reduced * (1.0 - nu * nu), nu)
    };
    let [plain, moved] = [0.0, 0.05].map(|shift| {
        let ((e1, nu1), (e0, nu0)) = (shifted(2.0, 0.4, shift), shifted(3.0, 0.35, shift));
        // The sphere has E2* = 1 as unit: E2 = 1 - nu2^2.
        let (_, nu2) = shifted(1.0 - 0.2 * 0.2, 0.2, shift);
        let film = Sticking::on_film(&material([e1, nu1, e0, nu0]), nu2).expect("physical");
        film.punch(2.0, 1e-11).expect("converges")
    });
    assert!(
        relative(plain.eeq_s, moved.eeq_s) <= 1e-12,
        "{plain:?}, {moved:?}"
    );
    assert!(relative(plain.gamma_eff, moved.gamma_eff) <= 1e-12);
}

/// A film on springs: without friction on top it is that of the other solver, with stick it is
/// stiffer; springs that are stiff enough bond it.
#[test]
fn films_on_springs_may_stick_on_top() {
    let solid = |young: f64, nu: f64| Elastic::new(young, nu).expect("physical");
    let stack = |interface: Interface| {
        let film = Layer {
            solid: solid(2.0, 0.5),
            thickness: 1.0,
            interface,
        };
        Stack::new(solid(40.0, 0.3), [film]).expect("within limits")
    };
    let on =
        |interface: Interface| Sticking::on_stack(&stack(interface), 1.0, 0.5).expect("physical");
    let bonded = Sticking::on_film(&material([2.0, 0.5, 40.0, 0.3]), 0.5).expect("physical");
    let stiff = Interface::Springs {
        tangential: 1e8,
        normal: f64::INFINITY,
    };
    let soft = Interface::Springs {
        tangential: 1.0,
        normal: 50.0,
    };
    for x in [0.5, 3.0] {
        let punch = on(soft).punch(x, 1e-10).expect("converges");
        let slides = on(soft).without_friction();
        let slides = slides.punch(x, 1e-10).expect("converges");
        let known = solve_stack(x, &stack(soft), 1.0, 1e-11).expect("converges");
        assert!(relative(slides.eeq_s, known.quantities.eeq) <= 1e-10);
        assert!(punch.eeq_s > slides.eeq_s, "{x}");
        let sprung = on(stiff).tip(x, 2.0, 1e-8).expect("converges").0;
        let glued = bonded.tip(x, 2.0, 1e-8).expect("converges").0;
        assert!(relative(sprung.eeq_s, glued.eeq_s) <= 1e-6);
        assert!(relative(sprung.pi_s, glued.pi_s) <= 1e-6);
    }
}

/// A film that slides on its base is the limit of weaker and weaker springs, which other panels
/// resolve. Measured: 1.1e-7 at a tangential stiffness of 1e-9 `E1*/t`.
#[test]
fn films_that_slide_below_may_stick_on_top() {
    let solid = |young: f64, nu: f64| Elastic::new(young, nu).expect("physical");
    let mut worst = 0.0;
    for (nu, base) in [(0.5, f64::INFINITY), (0.3, f64::INFINITY), (0.5, 40.0)] {
        let on = |interface: Interface| {
            let film = Layer {
                solid: solid(0.75, nu),
                thickness: 1.0,
                interface,
            };
            let stack = Stack::new(solid(base, 0.2), [film]).expect("within limits");
            Sticking::on_stack(&stack, f64::INFINITY, 0.5).expect("physical")
        };
        let weak = on(Interface::Springs {
            tangential: 1e-9,
            normal: f64::INFINITY,
        });
        let slides = on(Interface::Sliding);
        for x in [0.1, 1.0, 5.0, 20.0] {
            let [found, known] =
                [&slides, &weak].map(|one| one.punch(x, 1e-10).expect("converges"));
            worst = larger(worst, relative(found.eeq_s, known.eeq_s));
            worst = larger(worst, relative(found.gamma_eff, known.gamma_eff));
            let without = slides.clone().without_friction();
            assert!(found.eeq_s > without.punch(x, 1e-10).expect("converges").eeq_s);
            if nu == 0.5 && x < 10.0 {
                let [found, known] =
                    [&slides, &weak].map(|one| one.tip(x, 2.0, 1e-9).expect("converges").0);
                for (a, b) in [(found.pi_s, known.pi_s), (found.gamma_g, known.gamma_g)] {
                    worst = larger(worst, relative(a, b));
                }
            }
        }
    }
    println!("sliding and weak springs: {worst:.1e}");
    assert!(worst <= 1e-6, "{worst:e}");
}
