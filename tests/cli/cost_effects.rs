//! `tabulate cost effects`: the errors of the load without an effect, against loads in SI units,
//! closed forms and limits; and its rows, against `generate`.

use std::f64::consts::PI;

use acceptance::{
    Contacts, Workdir, assert_names, layer, material, solid, with_interfaces, workdir,
};
use contact::Contact;
use cost::clock::{Times, Timing};
use cost::effects::{A_OVER_R, EXPONENT, Effect, Row, STRENGTHS, TABOR, errors, markdown};
use cost::to_csv;
use interp::{Elastic, HalfSpace, Material, Probe};
use solve::stack::Interface;
use solve::{solve, solve_stack};
use tabulate::measure::read_csv;
use tabulate::table::{Observer, Scene};

/// Radius of the sphere (m), and its modulus (Pa).
const RADIUS: f64 = 1e-3;
const MODULUS: f64 = 2e6;

fn rows(workdir: &Workdir, file: &str) -> Vec<Row> {
    read_csv(&workdir.path(file)).expect("the command has written it")
}

/// Adhesionless load and load (N) by eq. 9, for a sphere of this modulus.
fn loads(a: f64, a_over_t: f64, material: &Material, modulus: f64, w: f64) -> [f64; 2] {
    let q = solve(a_over_t, material, 1e-10)
        .expect("moderate contrasts converge")
        .quantities;
    let pressed = a.powi(3) * modulus * q.pi0 / (2.0 * RADIUS);
    let adhesion = (8.0 * PI * w * material.sphere_film_modulus() * modulus * a.powi(3)).sqrt()
        * q.eeq
        / q.gamma;
    [pressed, pressed - adhesion]
}

/// A rigid sphere or substrate is one that is a million times stiffer. The bare substrate is JKR's.
#[test]
fn errors_are_those_of_the_loads_of_other_systems() {
    const RIGID: f64 = 1e6;
    let mut contacts = Contacts::new(61);
    for _ in 0..200 {
        let a_over_t = contacts.log_uniform(1e-2, 1e2);
        let (e1, e0) = (
            contacts.log_uniform(0.1, 10.0),
            contacts.log_uniform(1.0, 30.0),
        );
        let (nu1, strength) = (
            contacts.uniform(0.0, 0.49),
            contacts.log_uniform(STRENGTHS[0], STRENGTHS[1]),
        );
        let scene = material([e1, nu1, e0, 0.25]);
        let a = 6e-5;
        let [pressed, stuck] = loads(a, a_over_t, &scene, MODULUS, 1.0);
        let w = (strength * pressed / (pressed - stuck)).powi(2);
        let [_, load] = loads(a, a_over_t, &scene, MODULUS, w);
        assert!(((pressed - load) / pressed / strength - 1.0).abs() < 1e-12);

        let solid = Elastic::new(e0 * MODULUS, 0.25).expect("physical");
        let bare = HalfSpace {
            probe: Probe::Paraboloid { radius: RADIUS },
            sphere_modulus: MODULUS,
            solid,
        };
        let others = [
            Contact::half_space(&bare)
                .and_then(|contact| contact.load(a, w))
                .expect("a contact"),
            loads(
                a,
                a_over_t,
                &material([e1 / RIGID, nu1, e0 / RIGID, 0.25]),
                RIGID * MODULUS,
                w,
            )[1],
            loads(
                a,
                a_over_t,
                &material([e1, nu1, RIGID * e0, 0.25]),
                MODULUS,
                w,
            )[1],
            loads(a, a_over_t, &material([e1, 0.5, e0, 0.25]), MODULUS, w)[1],
            pressed,
            load,
        ];
        let effects = &Effect::ALL[..others.len()];
        let found =
            errors(effects, a_over_t, &scene, strength).expect("moderate contrasts converge");
        for ((&effect, found), other) in effects.iter().zip(found).zip(others) {
            let expected = ((other - load) / pressed).abs();
            // A substrate of thirty times the sphere's modulus is rigid to 1e-6 only.
            let allowed = 5e-5 * (other / pressed).abs().max(1.0);
            assert!(
                (found - expected).abs() <= allowed,
                "{effect:?} at {a_over_t}, {scene:?}: {found:e}, not {expected:e}"
            );
        }
    }
}

/// Loads under a rigid sphere are in units of the film's modulus.
#[test]
fn errors_under_a_rigid_sphere_are_the_limit_of_those_under_a_stiff_one() {
    let effects = [
        Effect::Film,
        Effect::SubstrateCompliance,
        Effect::FilmCompressibility,
        Effect::Adhesion,
    ];
    for (a_over_t, nu1, e0_over_e1) in [(0.1, 0.3, 3.0), (1.0, 0.1, 20.0), (10.0, 0.45, 30.0)] {
        let stiff = material([1e-6, nu1, 1e-6 * e0_over_e1, 0.25]);
        let rigid = material([0.0, nu1, e0_over_e1, 0.25]);
        let [stiff, rigid] = [stiff, rigid]
            .map(|material| errors(&effects, a_over_t, &material, 0.5).expect("solved"));
        for (effect, (stiff, rigid)) in effects.iter().zip(stiff.into_iter().zip(rigid)) {
            assert!(
                (stiff - rigid).abs() <= 5e-5 * (1.0 + rigid),
                "{effect:?} at {a_over_t}: {stiff:e}, {rigid:e}"
            );
        }
    }
}

#[test]
fn the_error_of_a_bonded_film_is_that_of_the_loads_of_both() {
    let (bonded, strength) = (material([1.75, 0.5, 1e5, 0.25]), 0.5);
    for a_over_t in [0.1, 1.0, 10.0] {
        let sliding = with_interfaces(
            solid(1e5, 0.25),
            &[(layer(1.75, 0.5, 1.0), Interface::Sliding)],
        );
        let slid = solve_stack(a_over_t, &sliding, 1.0, 1e-9).expect("within reach");
        let stuck = solve(a_over_t, &bonded, 1e-9).expect("within reach");
        let [slid, stuck] = [slid, stuck].map(|solution| solution.quantities);
        let pressed = stuck.pi0 / slid.pi0 - 1.0;
        let adhesion = stuck.eeq / stuck.gamma / (slid.eeq / slid.gamma) - 1.0;
        let expected = (pressed - strength * adhesion).abs();
        let found = errors(&[Effect::Interface], a_over_t, &bonded, strength).expect("solved")[0];
        assert!(
            (found - expected).abs() <= 1e-4 * expected,
            "{found} {expected}"
        );
    }
}

#[test]
fn a_film_like_its_substrate_can_be_left_out() {
    let film = |e1, nu1, a_over_t| {
        errors(
            &[Effect::Film],
            a_over_t,
            &material([e1, nu1, 2.0, 0.25]),
            1.0,
        )
        .expect("solved")[0]
    };
    for a_over_t in [1e-3, 0.1, 1.0, 10.0, 1e3] {
        assert!(film(2.0, 0.25, a_over_t) <= 1e-15);
        for difference in [1e-2, 1e-4, 1e-6] {
            let error = film(
                2.0 * (1.0 + difference),
                0.25 * (1.0 + difference),
                a_over_t,
            );
            assert!(
                error <= difference,
                "{difference:e} at {a_over_t}: {error:e}"
            );
        }
    }
}

/// Returns the load of a paraboloid on a half-space that relaxes by a power law, at a time of a cycle that turns at 1, over
/// the elastic load at the turn: `b t^(b - alpha) B(t1/t; b, 1 - alpha)` with `b` = 3/2 (Ting 1966).
fn relaxing_load(time: f64) -> f64 {
    const STEPS: u32 = 20_000;
    let (b, c) = (1.5, 1.0 - EXPONENT);
    let touched = if time <= 1.0 {
        time
    } else {
        (time - 2.0_f64.powf(1.0 / c) * (time - 1.0)).max(0.0)
    };
    // The integral of u^(b-1) (1-u)^(c-1) over v = (1-u)^c, by the midpoint rule.
    let from = (1.0 - touched / time).powf(c);
    let step = (1.0 - from) / f64::from(STEPS);
    let values = (0..STEPS).map(|i| {
        let v = from + (f64::from(i) + 0.5) * step;
        (1.0 - v.powf(1.0 / c)).powf(b - 1.0)
    });
    b * time.powf(b - EXPONENT) * values.sum::<f64>() * step / c
}

/// On a thick film alone, the loads are JKR's on a half-space of film, and every error is a closed
/// form.
#[test]
fn a_thick_film_is_a_half_space() {
    for strength in STRENGTHS {
        let thick = material([0.5, 0.3, 40.0, 0.25]);
        let [film, sphere, substrate, compressibility] = [
            thick.sphere_substrate_modulus(),
            thick.film_modulus(),
            thick.sphere_film_modulus(),
            material([0.5, 0.5, 40.0, 0.25]).sphere_film_modulus(),
        ]
        .map(|modulus| {
            let ratio = modulus / thick.sphere_film_modulus();
            (ratio - 1.0 - strength * (ratio.sqrt() - 1.0)).abs()
        });
        // Sneddon's load of the sphere, `E* [(a^2 + R^2) artanh(a/R) - a R]`, beside Hertz's.
        let ratio = A_OVER_R;
        let exact = (1.0 + ratio * ratio) * ratio.atanh() - ratio;
        let shape = 1.0 - 4.0 / 3.0 * ratio.powi(3) / exact;
        // The zone is (pi/4) (w R^2/Es*)^(1/3)/mu^2, and JKR pulls off at a^3 = 9 pi w R^2/(8 Es*).
        let range = PI / 24.0 * (8.0 / (9.0 * PI)).cbrt() / (TABOR * TABOR);
        // A punch that sticks to a half-space is stiffer by artanh(beta)/beta, with Dundurs' beta of
        // the film and an incompressible sphere.
        let beta = thick.sphere_film_modulus() / thick.film_modulus() * (2.0 / 7.0);
        let friction = 1.0 - beta / beta.atanh();
        let turn = relaxing_load(1.0);
        let relaxation = (0..=100)
            .map(|i| {
                let time = f64::from(i) / 50.0;
                let elastic = (1.0 - (time - 1.0).abs()).powf(1.5);
                if time == 0.0 {
                    0.0
                } else {
                    (relaxing_load(time) / turn - elastic).abs()
                }
            })
            .fold(0.0, f64::max);
        let expected = [
            film,
            sphere,
            substrate,
            compressibility,
            strength,
            0.0,
            shape,
            range,
            0.0,
            friction,
            relaxation,
        ];
        let found = errors(&Effect::ALL, 1e-6, &thick, strength).expect("solved");
        for ((effect, found), expected) in Effect::ALL.iter().zip(found).zip(expected) {
            assert!(
                (found - expected).abs() <= 1e-5,
                "{effect:?}, {strength}: {found:e}, not {expected:e}"
            );
        }
    }
}

#[test]
fn a_stiff_substrate_is_as_good_as_rigid() {
    for a_over_t in [0.1, 1.0, 30.0] {
        let error = |e0| {
            errors(
                &[Effect::SubstrateCompliance],
                a_over_t,
                &material([1.75, 0.4, e0, 0.25]),
                0.5,
            )
            .expect("solved")[0]
        };
        let errors = [1e2, 1e4, 1e6].map(error);
        assert!(
            errors
                .windows(2)
                .all(|pair| (50.0..200.0).contains(&(pair[0] / pair[1]))),
            "{a_over_t}: {errors:?}"
        );
    }
}

/// Ignores the progress of a generation.
struct Silent;

impl Observer for Silent {
    fn begin(&self, _: &'static str, _: usize, _: usize) {}
    fn advance(&self, _: usize) {}
    fn note(&self, _: &str) {}
}

const SCENE: &str = "\
title = 'A small box'
a_over_t = { from = 0.1, to = 10 }
e1_over_e2 = { from = 0.3, to = 3 }
nu1 = { from = 0.3, to = 0.5 }
e0_over_e2 = 10
";

#[test]
fn rows_say_what_generate_says_of_the_scene_without_an_effect() {
    let workdir = workdir!();
    workdir.write("scene.toml", SCENE);
    let scene = Scene::parse(SCENE, Some(1e-3)).expect("the scene is sound");
    let rows =
        tabulate::measure::effects(&scene, 2000, Timing::Brief, &Silent).expect("within reach");
    let effects: Vec<_> = rows.iter().map(|row| row.without).collect();
    assert_eq!(
        effects,
        [vec![None], Effect::ALL.map(Some).to_vec()].concat()
    );

    let whole = &rows[0];
    let without = [
        (
            "rigid sphere",
            SCENE.replace("{ from = 0.3, to = 3 }", "0").replace(
                "10\n",
                "{ from = 3.3333333333333335, to = 33.333333333333336 }\n",
            ),
            &rows[2],
        ),
        (
            "rigid substrate",
            SCENE.replace("e0_over_e2 = 10", "e0_over_e2 = inf"),
            &rows[3],
        ),
        (
            "incompressible",
            SCENE.replace("{ from = 0.3, to = 0.5 }", "0.5"),
            &rows[4],
        ),
        (
            "no adhesion",
            format!("{SCENE}quantities = ['pi0', 'delta0']\n"),
            &rows[5],
        ),
        (
            "no penetration",
            format!("{SCENE}quantities = ['pi0', 'eeq', 'gamma']\n"),
            &rows[6],
        ),
    ];
    for (name, scene, row) in without {
        workdir.write("without.toml", scene);
        let said = workdir.succeed(&["generate", "without.toml", "--tolerance", "1e-3"]);
        assert_names(&said, &[&format!("{} points in", row.solves)]);
        assert_eq!(
            row.axes,
            [3, 3, 3, 2, 3, 3][rows
                .iter()
                .position(|other| other == row)
                .expect("one of them")
                - 1],
            "{name}"
        );
    }
    for row in &rows {
        assert_eq!(
            row.saved_solves,
            whole.solves.cast_signed() - row.solves.cast_signed()
        );
        assert_eq!(
            row.saved_bytes,
            whole.bytes.cast_signed() - row.bytes.cast_signed()
        );
        // None where it is not above the noise.
        let difference = whole.seconds - row.seconds;
        assert!(row.saved_seconds.is_none_or(|saved| saved == difference));
        assert!(row.median_error <= row.worst_error);
    }
    // The shape costs no table, but time with each new material.
    let shape = &rows[7];
    assert_eq!((shape.saved_solves, shape.saved_bytes), (0, 0));
    assert!(shape.time_ratio.is_some_and(|ratio| ratio > 0.0));
    assert!(rows[..7].iter().all(|row| row.time_ratio.is_none()));
    // So does the finite range, with each pull-off.
    let range = &rows[8];
    // So does the interface: a film that slides is solved.
    let interface = &rows[9];
    assert_eq!((interface.saved_solves, interface.saved_bytes), (0, 0));
    assert!(interface.time_ratio.is_some_and(|ratio| ratio > 1.0));
    assert!(
        (0.01..1.0).contains(&interface.median_error) && interface.worst_error < 20.0,
        "{interface:?}"
    );
    assert_eq!((range.saved_solves, range.saved_bytes), (0, 0));
    assert!(range.time_ratio.is_some_and(|ratio| ratio > 0.0));
    assert!(
        (1e-3..1e-2).contains(&range.median_error) && range.worst_error < 2e-2,
        "{range:?}"
    );
    assert!(
        (0.01..0.05).contains(&shape.median_error) && shape.worst_error < 0.05,
        "{shape:?}"
    );
    // A history takes longer than an elastic curve, and needs no table.
    let relaxation = &rows[11];
    assert_eq!((relaxation.saved_solves, relaxation.saved_bytes), (0, 0));
    assert!(relaxation.time_ratio.is_some_and(|ratio| ratio > 0.0));
    let [film, adhesion, penetration] = [&rows[1], &rows[5], &rows[6]];
    assert_eq!(
        (film.axes, film.solves, film.seconds, film.bytes),
        (0, 0, 0.0, 0)
    );
    // The error without adhesion is its strength.
    let [weak, strong] = STRENGTHS;
    assert!(
        (adhesion.median_error / (weak * strong).sqrt()).ln().abs() < 0.2,
        "{adhesion:?}"
    );
    assert!(
        adhesion.worst_error <= strong && adhesion.worst_error > 0.98 * strong,
        "{adhesion:?}"
    );
    assert_eq!(
        (penetration.median_error, penetration.worst_error),
        (0.0, 0.0)
    );

    workdir.write("other.csv", "tolerance\n1\n");
    let message = workdir.fail(
        1,
        &["plot", "effects", "--data", "other.csv", "-o", "other.svg"],
    );
    assert_names(
        &message,
        &["cannot read other.csv", "line: 2", "missing field"],
    );
}

/// Times are given, and not measured: a difference counts if it is larger than the ranges of both.
#[test]
fn a_time_that_is_not_above_the_noise_is_not_a_cost() {
    let times = |seconds: [f64; 3]| Times::from_iter(seconds);
    let whole = times([3.0, 2.5, 2.75]);
    assert_eq!((whole.fastest(), whole.noise()), (2.5, 0.5));
    assert_eq!(whole.longer_than(&times([1.0, 1.25, 1.5])), Some(1.5));
    assert_eq!(whole.longer_than(&times([2.25, 2.0, 2.25])), None);
    assert_eq!(times([2.25, 2.0, 2.25]).longer_than(&whole), None);
    assert_eq!(times([1.0, 1.25, 1.5]).longer_than(&whole), Some(-1.5));
    assert_eq!(whole.longer_than(&Times::from_iter([0.5])), None);

    let row = |without, seconds, saved_seconds| Row {
        without,
        tolerance: 1e-4,
        axes: 4,
        solves: 1000,
        threads: 2,
        seconds,
        bytes: 1000,
        saved_solves: 0,
        saved_seconds,
        saved_bytes: 0,
        median_error: 0.1,
        worst_error: 0.2,
        time_ratio: None,
    };
    let rows = [
        row(None, 2.5, Some(0.0)),
        row(Some(Effect::Adhesion), 1.0, Some(1.5)),
        row(Some(Effect::Penetration), 3.6, None),
        row(Some(Effect::SphereCompliance), 3.6, Some(-1.1)),
    ];
    let workdir = workdir!();
    let file = workdir.write("rows.csv", to_csv(&rows));
    assert_eq!(read_csv::<Row>(&file).expect("its own"), rows);
    let printed = workdir.succeed(&["cost", "effects", "--data", "rows.csv"]);
    assert_eq!(printed, markdown(&rows));
    let cells = [
        "| adhesion | w = 0 | 0 | 0 | 1.5 s |",
        "| penetration | no delta0 | 0 | 0 | not measurable (1.1 s is within the noise) |",
        "| sphere compliance | e1_over_e2 = 0 | 0 | 0 | no time (1.1 s more without it) |",
    ];
    assert_names(&printed, &cells);
    workdir.succeed(&["plot", "effects", "--data", "rows.csv", "-o", "rows.svg"]);
    let drawn = String::from_utf8(workdir.read("rows.svg")).expect("UTF-8");
    assert!(drawn.starts_with("<svg"));
}

#[test]
fn effects_that_a_scene_does_not_have_are_named() {
    let workdir = workdir!();
    let like = "title = 'x'\na_over_t = { from = 0.1, to = 10 }\ne1_over_e2 = 2\nnu1 = 0.25\ne0_over_e2 = 2\nnu0 = 0.25\nquantities = ['pi0']\n";
    workdir.write("like.toml", like);
    let printed = workdir.succeed(&[
        "cost",
        "effects",
        "like.toml",
        "--points",
        "500",
        "-o",
        "like.csv",
    ]);
    assert_names(
        &printed,
        &[
            "Not in this scene: adhesion, penetration, shape, finite range, relaxation.",
            "| film | JKR on the bare substrate | 1 |",
        ],
    );
    let film = &rows(&workdir, "like.csv")[1];
    assert_eq!(film.without, Some(Effect::Film));
    assert!(film.worst_error <= 1e-15, "{film:?}");

    workdir.write(
        "rigid.toml",
        "title = 'x'\na_over_t = 1\ne1_over_e2 = 0\nnu1 = 0.5\ne0_over_e2 = inf\n",
    );
    let printed = workdir.succeed(&["cost", "effects", "rigid.toml", "--points", "500"]);
    assert_names(
        &printed,
        &[
            "Not in this scene: film, sphere compliance, substrate compliance, film compressibility.",
        ],
    );

    workdir.write("stiffness.toml", "title = 'x'\na_over_t = 1\ne1_over_e2 = 1\nnu1 = 0.5\ne0_over_e2 = inf\nquantities = ['eeq']\n");
    assert_names(
        &workdir.fail(1, &["cost", "effects", "stiffness.toml"]),
        &["pi0"],
    );
    for tolerance in ["1e-11", "0.5", "NaN"] {
        assert_names(
            &workdir.fail(
                1,
                &["cost", "effects", "rigid.toml", "--tolerance", tolerance],
            ),
            &["tolerance = ", "1e-10 to 1e-1"],
        );
    }
}
