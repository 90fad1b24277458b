//! `tabulate cost effects`: its rows, and what it refuses.

use acceptance::{assert_names, workdir};
use cost::clock::{Times, Timing};
use cost::effects::{Effect, Row, STRENGTHS, markdown};
use cost::to_csv;
use tabulate::measure::read_csv;
use tabulate::table::Scene;

use crate::cost_table::Work;

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
    let rows = tabulate::measure::effects(&scene, 2000, Timing::Brief, &Work::default())
        .expect("within reach");
    let effects: Vec<_> = rows.iter().map(|row| row.without).collect();
    assert_eq!(effects[0], None);
    assert_eq!(effects[1..], Effect::ALL.map(Some));

    let whole = &rows[0];
    let of_film = "{ from = 3.3333333333333335, to = 33.333333333333336 }\n";
    let rigid_sphere = SCENE
        .replace("{ from = 0.3, to = 3 }", "0")
        .replace("10\n", of_film);
    // Without the compliance of the sphere or the substrate, the compressibility, the adhesion or the
    // penetration.
    let without = [
        (rigid_sphere, 3),
        (SCENE.replace("e0_over_e2 = 10", "e0_over_e2 = inf"), 3),
        (SCENE.replace("{ from = 0.3, to = 0.5 }", "0.5"), 2),
        (format!("{SCENE}quantities = ['pi0', 'delta0']\n"), 3),
        (format!("{SCENE}quantities = ['pi0', 'eeq', 'gamma']\n"), 3),
    ];
    for ((scene, axes), row) in without.into_iter().zip(&rows[2..]) {
        workdir.write("without.toml", scene);
        let said = workdir.succeed("generate without.toml --tolerance 1e-3");
        assert_names(&said, &format!("{} points in", row.solves));
        assert_eq!(row.axes, axes, "{row:?}");
    }
    for row in &rows {
        let difference = |of: fn(&Row) -> u64| of(whole).cast_signed() - of(row).cast_signed();
        assert_eq!(row.saved_solves, difference(|row| row.solves));
        assert_eq!(row.saved_bytes, difference(|row| row.bytes));
        // None where it is not above the noise.
        let difference = whole.seconds - row.seconds;
        assert!(row.saved_seconds.is_none_or(|saved| saved == difference));
        assert!(row.median_error <= row.worst_error);
    }
    // The shape costs no table, but time with each new material; the finite range with each pull-off;
    // the interface because a film that slides is solved; a relaxation because a history takes longer
    // than an elastic curve.
    for (i, median, worst, ratio) in [
        (7, 0.01..0.05, 0.05, 0.0),
        (8, 1e-3..1e-2, 2e-2, 0.0),
        (9, 0.01..1.0, 20.0, 1.0),
        (11, 0.0..f64::INFINITY, f64::INFINITY, 0.0),
    ] {
        let row = &rows[i];
        assert_eq!((row.saved_solves, row.saved_bytes), (0, 0), "{row:?}");
        assert!(row.time_ratio.is_some_and(|found| found > ratio), "{row:?}");
        assert!(median.contains(&row.median_error), "{row:?}");
        assert!(row.worst_error < worst, "{row:?}");
    }
    assert!(rows[..7].iter().all(|row| row.time_ratio.is_none()));
    let [film, adhesion, penetration] = [&rows[1], &rows[5], &rows[6]];
    assert_eq!([film.axes, film.solves, film.bytes], [0; 3]);
    assert_eq!(film.seconds, 0.0);
    // The error without adhesion is its strength.
    let [weak, strong] = STRENGTHS;
    let middle = adhesion.median_error / (weak * strong).sqrt();
    assert!(middle.ln().abs() < 0.2, "{adhesion:?}");
    let worst = adhesion.worst_error / strong;
    assert!(worst <= 1.0 && worst > 0.98, "{adhesion:?}");
    assert_eq!(
        [penetration.median_error, penetration.worst_error],
        [0.0; 2]
    );

    workdir.write("other.csv", "tolerance\n1\n");
    let words = "cannot read other.csv; line 2; there is no column";
    workdir.refuses(format!(
        "1 | plot effects --data other.csv -o other.svg | {words}"
    ));
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
    let printed = workdir.succeed("cost effects --data rows.csv");
    assert_eq!(printed, markdown(&rows));
    let cells = [
        "| adhesion | w = 0 | 0 | 0 | 1.5 s |",
        "| penetration | no delta0 | 0 | 0 | not measurable (1.1 s is within the noise) |",
        "| sphere compliance | e1_over_e2 = 0 | 0 | 0 | no time (1.1 s more without it) |",
    ];
    assert_names(&printed, &cells);
    workdir.succeed("plot effects --data rows.csv -o rows.svg");
    assert!(workdir.read("rows.svg").starts_with(b"<svg"));
}

#[test]
fn effects_that_a_scene_does_not_have_are_named() {
    let workdir = workdir!();
    let like = "title = 'x'\na_over_t = { from = 0.1, to = 10 }\ne1_over_e2 = 2\nnu1 = 0.25\ne0_over_e2 = 2\nnu0 = 0.25\nquantities = ['pi0']\n";
    workdir.write("like.toml", like);
    let printed = workdir.succeed("cost effects like.toml --points 60 -o like.csv");
    let words = "Not in this scene: adhesion, penetration, shape, finite range, relaxation.; | film | JKR on the bare substrate | 1 |";
    assert_names(&printed, words);
    let film = &read_csv::<Row>(&workdir.path("like.csv")).expect("its own")[1];
    assert_eq!(film.without, Some(Effect::Film));
    assert!(film.worst_error <= 1e-15, "{film:?}");

    let rigid = "title = 'x'\na_over_t = 1\ne1_over_e2 = 0\nnu1 = 0.5\ne0_over_e2 = inf\n";
    workdir.write("rigid.toml", rigid);
    let printed = workdir.succeed("cost effects rigid.toml --points 60");
    let words =
        "Not in this scene: film, sphere compliance, substrate compliance, film compressibility.";
    assert_names(&printed, words);

    let soft = rigid.replace("e1_over_e2 = 0", "e1_over_e2 = 1");
    workdir.write("stiffness.toml", format!("{soft}quantities = ['eeq']\n"));
    workdir.refuses(
        "
        1 | cost effects stiffness.toml | pi0
        1 | cost effects rigid.toml --tolerance 1e-11 | tolerance =; 1e-10 to 1e-1
        1 | cost effects rigid.toml --tolerance 0.5 | tolerance =; 1e-10 to 1e-1
        1 | cost effects rigid.toml --tolerance NaN | tolerance =; 1e-10 to 1e-1
        ",
    );
}

/// Effects are told by Young's moduli: scenes with other axes would get rows that mean something else.
#[test]
fn scenes_with_other_axes_are_refused() {
    let workdir = workdir!();
    let reduced = "title = 'x'\na_over_t = { from = 0.1, to = 10 }\ne1s_over_einfs = { from = 0.1, to = 10 }\nnu1 = 0.3\n\
         e0s_over_e2s = { from = 0.1, to = 10 }\nnu0 = 'paired'\n";
    let stack = "title = 'x'\na_over_t = { from = 0.1, to = 10 }\ne1_over_e2 = { from = 0.3, to = 3 }\n[stack]\n\
         base = { young_modulus = inf }\n[[stack.layers]]\nyoung_modulus = 5e5\npoisson_ratio = 0.5\nthickness = 2e-6\n";
    for scene in [reduced, stack] {
        workdir.write("scene.toml", scene);
        let words = "e1_over_e2 and e0_over_e2; without [stack]";
        let call = "cost effects scene.toml --points 10 --tolerance 1e-2";
        workdir.refuses(format!("1 | {call} | {words}"));
    }
}
