//! Stacks of layers: `--stack` of `tabulate solve`, `curve`, `fit` and `simulate`.

use acceptance::{
    Workdir, assert_close, assert_estimate, assert_names, layer, number, solid, stack, value,
    workdir,
};
use contact::Contact;
use interp::{Probe, System};
use solve::stack::Stack;
use solve::{solve_stack, stack_curve};

const TEXT: &str = "base = { young_modulus = 2e11, poisson_ratio = 0.25 }\n\
    [[layers]]\nname = \"primer\"\nyoung_modulus = 5e5\npoisson_ratio = 0.5\nthickness = 2.5e-6\n\
    [[layers]]\nyoung_modulus = 3.5e6\npoisson_ratio = 0.5\nthickness = 7.5e-6\n";

fn written(workdir: &Workdir) -> Stack {
    workdir.write("stack.toml", TEXT);
    stack(
        solid(2e11, 0.25),
        &[layer(5e5, 0.5, 2.5e-6), layer(3.5e6, 0.5, 7.5e-6)],
    )
}

#[test]
fn solve_prints_the_solution_of_the_library() {
    let workdir = workdir!();
    let stack = written(&workdir);
    for (sphere, unit) in [("2e6", "E2*"), ("inf", "E1*")] {
        let arguments = format!("solve --stack stack.toml --sphere-modulus {sphere} --a-over-t 3");
        let modulus = sphere.parse().expect("a number");
        let solution = solve_stack(3.0, &stack, modulus, 1e-10).expect("within reach");
        let object = workdir.json(format!("{arguments} --json"));
        let values = solution.quantities.to_array();
        for (name, value) in ["pi0", "eeq", "gamma", "delta0"].into_iter().zip(values) {
            // The reader of JSON rounds the last digit.
            let printed = number(&object, name);
            assert!((printed / value - 1.0).abs() <= 1e-15, "{name}: {printed}");
        }
        assert_eq!(object["normalised_by"], unit);
        assert_eq!(object["layers"], 2);
        assert_eq!(object["method"], "Galerkin");
        let text = workdir.succeed(&arguments);
        assert_names(&text, &format!("normalised_by = {unit}"));
    }
}

/// On layers that are all like their base, the pull-off of a rigid flat punch is that of Kendall (1971):
/// `F^2 = 8 pi E* w a^3`, and the stiffness `2 E* a`.
#[test]
fn a_flat_punch_on_layers_like_their_base_is_that_on_a_half_space() {
    let workdir = workdir!();
    let alike = TEXT.replace("3.5e6", "2e11").replace("5e5", "2e11");
    workdir.write("alike.toml", alike.replace("0.5", "0.25"));
    let bodies = "--stack alike.toml --probe flat-punch --sphere-radius 20um --sphere-modulus inf \
                  --work-of-adhesion 0.04";
    let (modulus, a) = (2e11 / (1.0 - 0.0625), 2e-5_f64);
    let load = -(8.0 * std::f64::consts::PI * modulus * 0.04 * a.powi(3)).sqrt();
    let rows = workdir.csv(format!("curve {bodies}"));
    for (name, expected) in [
        ("contact_radius", a),
        ("load", load),
        ("penetration", load / (2.0 * modulus * a)),
        ("contact_stiffness", 2.0 * modulus * a),
    ] {
        assert_close(rows.first().get(name), expected, 1e-8);
    }
    let pull_off = workdir.json(format!("pull-off {bodies} --json"));
    assert_eq!(number(&pull_off, "contact_radius"), a);
    assert_close(number(&pull_off, "load"), load, 1e-8);
}

/// The file and the first mistake of each kind; `tabulate::stack` tests the others.
#[test]
fn mistakes_are_named_with_file_layer_value_and_range() {
    let workdir = workdir!();
    let none = TEXT.replacen("thickness = 2.5e-6", "thickness = 0", 1);
    workdir.write("none.toml", none);
    workdir.write("two.toml", TEXT.replacen("5e5", "4e5", 1));
    workdir.refuses(
        "
        1 | solve --stack none.toml --sphere-modulus 2e6 --a-over-t 1 | none.toml; primer; 1 of 2; 0.0 m; > 0 and finite
        1 | solve --stack two.toml --sphere-modulus 2e6 --a-over-t 900 | 900.0; 2 different layers; 1000; up to 749.9
        ",
    );
}

#[test]
fn what_describes_one_film_does_not_go_with_a_stack() {
    let workdir = workdir!();
    written(&workdir);
    workdir.refuses(
        "
        2 | solve --stack stack.toml --a-over-t 1 | --sphere-modulus
        2 | solve --stack stack.toml --sphere-modulus 2e6 --a-over-t 1 --nu1 0.5 | --nu1
        2 | solve --sphere-modulus 2e6 --a-over-t 1 | --e1-over-e2
        2 | curve --stack stack.toml --film-thickness 1e-6 | --film-thickness
        2 | curve embedded --stack stack.toml | --stack
        1 | curve --stack stack.toml --probe flat-punch --interaction-range 5nm | flat punch; paraboloid
        2 | fit data.csv --stack stack.toml --film-modulus 1e6 | --film-modulus
        2 | fit data.csv --stack stack.toml --half-space | --half-space
        2 | fit data.csv --stack stack.toml --table embedded | --table
        2 | fit data.csv --stack stack.toml --free primer.poisson | primer.poisson
        ",
    );
    let sphere = "--sphere-radius 100um --sphere-modulus inf --work-of-adhesion 0";
    let run = workdir.answer(format!(
        "curve --stack stack.toml {sphere} --from 1e-5 --to 2e-5 --points 2"
    ));
    assert_names(&run.stderr, "would compress the layers by");
}

/// A lens on the stack, and the data that it gives.
const LENS: &str = "simulate --kind load-radius --stack stack.toml --from 2e-5 --to 1e-4 --noise";

fn simulated(workdir: &Workdir, noise: &str, more: &str) -> String {
    workdir.succeed(format!("{LENS} {noise} --seed 1 {more}"))
}

#[test]
fn fit_finds_the_parameters_of_layers_by_their_names() {
    let workdir = workdir!();
    written(&workdir);
    workdir.write("data.csv", simulated(&workdir, "2e-7", ""));
    for (name, truth, unit) in [
        ("primer.modulus", 5e5, "Pa"),
        ("primer.thickness", 2.5e-6, "m"),
    ] {
        let free = format!("{name},work-of-adhesion");
        let start = format!("{name}={}", 2.0 * truth);
        let arguments = "fit data.csv --stack stack.toml --specimen paper --noise 2e-7";
        let more = format!("--free {free} --value {start} --json");
        let fit = workdir.json(format!("{arguments} {more}"));
        assert_eq!(fit["converged"], true);
        assert_eq!(fit["parameters"][name]["unit"], unit);
        for (key, truth) in [(name, truth), ("work_of_adhesion", 0.04)] {
            assert_estimate(&fit, key, truth, 0.1 * truth);
        }
    }
}

/// A cone on the stack: its curve is that of the library, and a fit finds both layers.
#[test]
fn a_cone_on_layers_is_solved_and_fitted() {
    let workdir = workdir!();
    let stack = written(&workdir);
    let young = "young_modulus = 3.5e6";
    let named = TEXT.replace(young, &format!("name = \"coat\"\n{young}"));
    workdir.write("stack.toml", named);
    let bodies = "--stack stack.toml --sphere-modulus inf --probe cone --half-angle 70";
    let curve = format!("curve {bodies} --work-of-adhesion 0 --from 0.2um --to 1um --points 3");
    let curve = workdir.csv(curve);
    let system = System {
        probe: Probe::Cone {
            half_angle: 70_f64.to_radians(),
        },
        ..stack.system(1.0, f64::INFINITY)
    };
    let solved = stack_curve(&stack, f64::INFINITY, [1e-4, 4.0], 1e-10).expect("within reach");
    let contact = Contact::new(&system, solved).expect("its own curve");
    for row in curve.cases() {
        let a = row.get("contact_radius");
        let (load, penetration) = contact.load_and_penetration(a, 0.0).expect("in range");
        assert_close(row.get("load"), load, 1e-7);
        assert_close(row.get("penetration"), penetration, 1e-7);
    }
    // Contacts of the widest radius that is solved, and beyond it.
    let wide = format!("curve {bodies} --work-of-adhesion 0 --points 2 --to");
    workdir.answer(format!("{wide} 5mm"));
    let refused = workdir.fail(1, format!("{wide} 5.1mm"));
    assert_names(&refused, "0.0051 m; 667 times; --to; 0.005 or less");

    let bodies = format!("{bodies} --work-of-adhesion 0");
    let data = "--kind load-penetration --from 0 --to 3um --points 60 --noise 20nN --seed 1";
    workdir.write("data.csv", workdir.simulate(format!("{bodies} {data}")));
    let free = "--free primer.modulus,coat.modulus --noise 20nN --json";
    let fit = workdir.json(format!(
        "fit data.csv --kind load-penetration {bodies} {free}"
    ));
    for (name, truth) in [("primer.modulus", 5e5), ("coat.modulus", 3.5e6)] {
        assert_estimate(&fit, name, truth, 0.02 * truth);
    }
}

/// A stiff skin on a soft layer on a rigid base: beside all layers its bending would be small.
#[test]
fn a_skin_that_is_pressed_down_by_more_than_its_thickness_is_told_of() {
    let workdir = workdir!();
    let skin = "base = { young_modulus = inf }\n\
        [[layers]]\nyoung_modulus = 1e4\npoisson_ratio = 0.45\nthickness = 1e-5\n\
        [[layers]]\nyoung_modulus = 1e9\npoisson_ratio = 0.3\nthickness = 1e-7\n";
    workdir.write("stack.toml", skin);
    let bodies =
        "--stack stack.toml --sphere-radius 50um --sphere-modulus inf --work-of-adhesion 0";
    let curve =
        |to: &str| workdir.answer(format!("curve {bodies} --from 10nm --points 2 --to {to}"));
    assert_names(
        &curve("10um").stderr,
        "press the film or top layer; down by 2.77 of its thickness",
    );
    assert!(!curve("50nm").stderr.contains("down by"));
}

#[test]
fn the_report_lists_the_layers() {
    let workdir = workdir!();
    written(&workdir);
    workdir.write("data.csv", simulated(&workdir, "1e-6", "--points 15"));
    let arguments = "fit data.csv --stack stack.toml";
    let report = workdir.succeed(format!("{arguments} --specimen paper"));
    for line in [
        "  substrate-modulus         200 GPa, Young's modulus\n",
        "  primer.modulus            500 kPa, Young's modulus\n",
        "  primer.thickness          2.5 um\n",
        "  layer-2.modulus           3.5 MPa, Young's modulus\n",
        "  layer-2.thickness         7.5 um\n",
        "\n  sphere-modulus  ",
        "\nthe layers matter: sphere-modulus is off by -",
    ] {
        assert_names(&report, &[line]);
    }
    let expected = simulated(&workdir, "1e-6", "--expect --free primer.modulus");
    assert_names(&expected, "  primer.modulus            500");
}

#[test]
fn a_mistake_about_layers_is_named_with_the_names_there_are() {
    let workdir = workdir!();
    written(&workdir);
    workdir.write("data.csv", simulated(&workdir, "1e-6", "--points 15"));
    workdir.write("bad.toml", TEXT.replace("\"primer\"", "\"a, b\""));
    let fit = "fit data.csv --stack stack.toml --specimen paper";
    // Under a rigid sphere the modulus of the top layer would be found, but it has no name.
    workdir.refuses(format!(
        "
        1 | {fit} --free oxide.modulus | oxide.modulus; no such layer; primer.modulus; primer.thickness
        1 | {fit} --bounds primer.modulus=1e5..1e6 | primer.modulus; not free
        1 | {fit} --sphere-modulus inf | film-modulus; primer.modulus
        1 | fit data.csv --stack bad.toml | --stack; a, b; comma; another name
        "
    ));
}

/// Pull-offs on stacks whose reach is rounded, and on layers that are one film: by an integral equation of another
/// program, and on layers of the base's material by JKR, `-1.5 pi w R`.
#[test]
fn pull_offs_on_stacks_are_found_up_to_the_reach() {
    let workdir = workdir!();
    let stack = |base: &str, layer: &str, count: usize| {
        let layers = format!("[[layers]]\n{layer}\n").repeat(count);
        format!("base = {base}\n{layers}")
    };
    let silicon = "{ young_modulus = 2e11, poisson_ratio = 0.25 }";
    let rubber = "young_modulus = 3.5e6\npoisson_ratio = 0.5";
    let primer = "[[layers]]\nyoung_modulus = 5e5\npoisson_ratio = 0.5\nthickness = 2.5e-6";
    let primed = format!("base = {silicon}\n{primer}\n[[layers]]\n{rubber}\nthickness = 1e-7\n");
    let parts = stack(silicon, &format!("{rubber}\nthickness = 1e-8"), 100);
    let same = "{ young_modulus = 3.5e6, poisson_ratio = 0.5 }";
    let same = stack(same, &format!("{rubber}\nthickness = 1e-8"), 3);
    let jkr = -1.5 * std::f64::consts::PI * 0.04 * 1e-3;
    for (text, expected) in [(primed, -1.94032e-4), (parts, -1.88967e-4), (same, jkr)] {
        workdir.write("stack.toml", text);
        let printed = workdir.succeed("pull-off --specimen paper --stack stack.toml");
        assert_close(value(&printed, "load"), expected, 1e-5);
    }
    // A top layer of a millionth of all layers is as if it were not there.
    let thick = primer.replace("2.5e-6", "1e-3");
    workdir.write(
        "stack.toml",
        format!("base = {silicon}\n{thick}\n[[layers]]\n{rubber}\nthickness = 1e-9\n"),
    );
    let sphere = "--sphere-radius 10um --sphere-modulus inf --work-of-adhesion 0.1mJ/m^2";
    let printed = workdir.succeed(format!("pull-off {sphere} --stack stack.toml"));
    assert_close(value(&printed, "load"), 1e-4 * jkr / 4.0, 1e-2);
}

/// A stack file has no units: moduli that no solid has are named.
#[test]
fn moduli_without_their_unit_are_named() {
    let workdir = workdir!();
    let layer = "[[layers]]\nyoung_modulus = 72\npoisson_ratio = 0.17\nthickness = 5e-7\n";
    let base = "base = { young_modulus = 170, poisson_ratio = 0.28 }";
    workdir.write("gpa.toml", format!("{base}\n{layer}"));
    for command in [
        "curve --stack gpa.toml --sphere-radius 10um --sphere-modulus 1147GPa --to 1um --points 2",
        "solve --stack gpa.toml --sphere-modulus 1147GPa --a-over-t 1",
    ] {
        let run = workdir.answer(command);
        assert_names(&run.stderr, "gpa.toml; 72.0 Pa; 72e6; 72e9");
    }
}
