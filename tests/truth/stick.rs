//! Contacts with full friction: independent values, and the contact without friction through the
//! same code. `stick_errors` scans the stated errors, `stick_limits` has exact identities and limits,
//! `stick_layers` stacks, and `stick_effects` what follows for a sphere.

use acceptance::{Case, Data, larger, material, relative};
use solve::solve_power_laws;
use solve::stick::Sticking;

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

/// Measured: 1.8e-11 at the tolerance 1e-10, `Gamma_t` relative to `Gamma_eff`.
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

/// With the coupling of pressure and shear taken out, the same code gives the contact without
/// friction. Measured: 6.7e-16 and 1.2e-14.
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
