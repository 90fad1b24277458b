//! Stacks of layers: `tabulate solve --stack` and `tabulate curve --stack`.

use acceptance::{Data, Workdir, assert_names, layer, solid, stack, workdir};
use interp::Contact;
use tabulate::stack::Stack;
use tabulate::{solve_stack, stack_curve};

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
        let arguments = [
            "solve",
            "--stack",
            "stack.toml",
            "--sphere-modulus",
            sphere,
            "--a-over-t",
            "3",
        ];
        let modulus = sphere.parse().expect("a number");
        let solution = solve_stack(3.0, &stack, modulus, 1e-10).expect("within reach");
        let json = workdir.succeed(&[&arguments[..], &["--json"]].concat());
        let object: serde_json::Value = serde_json::from_str(&json).expect("JSON");
        let values = solution.quantities.to_array();
        for (name, value) in ["pi0", "eeq", "gamma", "delta0"].into_iter().zip(values) {
            // The reader of JSON rounds the last digit.
            let printed = object[name].as_f64().expect("a number");
            assert!((printed / value - 1.0).abs() <= 1e-15, "{name}: {printed}");
        }
        assert_eq!(object["normalised_by"], unit);
        assert_eq!(object["layers"], 2);
        assert_eq!(object["method"], "Galerkin");
        let text = workdir.succeed(&arguments);
        assert_names(&text, &[&format!("normalised_by = {unit}")]);
    }
}

#[test]
fn curve_prints_the_contact_of_the_stack() {
    let workdir = workdir!();
    let stack = written(&workdir);
    let text = workdir.succeed(&[
        "curve",
        "--stack",
        "stack.toml",
        "--from",
        "1e-5",
        "--to",
        "1e-4",
        "--points",
        "7",
    ]);
    let t = stack.thickness();
    let curve = stack_curve(&stack, 2e6, [1e-5 / t, 1e-4 / t], 1e-8).expect("within reach");
    let contact = Contact::new(&stack.system(1e-3, 2e6), curve).expect("its curve");
    let rows = Data::parse("curve", &text);
    assert_eq!(rows.cases().count(), 7);
    for row in rows.cases() {
        let expected = contact
            .load_and_penetration(row.get("contact_radius"), 0.04)
            .expect("in range");
        assert_eq!((row.get("load"), row.get("penetration")), expected);
    }
}

#[test]
fn mistakes_are_named_with_file_layer_value_and_range() {
    let workdir = workdir!();
    let solve = |from: &str, to: &str, x: &str| {
        workdir.write("bad.toml", TEXT.replacen(from, to, 1));
        workdir.fail(
            1,
            &[
                "solve",
                "--stack",
                "bad.toml",
                "--sphere-modulus",
                "2e6",
                "--a-over-t",
                x,
            ],
        )
    };
    let message = solve("thickness = 2.5e-6", "thickness = 0", "1");
    assert_names(
        &message,
        &["bad.toml", "primer", "1 of 2", "0.0 m", "> 0 and finite"],
    );
    let message = solve("5e5", "inf", "1");
    assert_names(
        &message,
        &["primer", "inf", "must be finite", "give it as the base"],
    );
    let message = solve("3.5e6", "1e16", "1");
    assert_names(&message, &["layer 2 of 2", "1e16", "at most 1e9 times"]);
    let message = solve("poisson_ratio = 0.5", "poisson_ratio = 0.51", "1");
    assert_names(&message, &["primer", "0.51", "(-1, 0.5]"]);
    let message = solve("5e5", "4e5", "900");
    assert_names(
        &message,
        &["900.0", "2 different layers", "1000", "up to 749.9"],
    );
    let message = solve("thickness", "height", "1");
    assert_names(&message, &["bad.toml", "height"]);
}

#[test]
fn what_describes_one_film_does_not_go_with_a_stack() {
    let workdir = workdir!();
    written(&workdir);
    for arguments in [
        &["solve", "--stack", "stack.toml", "--a-over-t", "1"][..],
        &[
            "solve",
            "--stack",
            "stack.toml",
            "--sphere-modulus",
            "2e6",
            "--a-over-t",
            "1",
            "--nu1",
            "0.5",
        ],
        &["solve", "--sphere-modulus", "2e6", "--a-over-t", "1"],
        &["curve", "--stack", "stack.toml", "--film-thickness", "1e-6"],
        &["curve", "embedded", "--stack", "stack.toml"],
    ] {
        workdir.fail(2, arguments);
    }
}
