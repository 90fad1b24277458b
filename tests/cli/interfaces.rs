//! Films that slide or are joined by springs: `--interface` and `--interface-stiffness` of one film,
//! and the key `interface` of a stack file.

use acceptance::{
    Data, Workdir, assert_cases, assert_close, assert_estimate, assert_names, estimate, json,
    kinds, layer, number, relative_error, solid, springs, with_interfaces, workdir,
};
use contact::{Contact, Control};
use interp::Quantities;
use serde_json::Value;
use solve::stack::{Interface, Stack};
use solve::{solve_stack, stack_curve};

/// A film of 10 um on silicon, under the paper's sphere.
const FILM: &str = "--specimen paper --film-thickness 10um";

/// The film as a stack of one layer.
fn film(interface: Interface) -> Stack {
    with_interfaces(solid(2e11, 0.25), &[(layer(3.5e6, 0.5, 1e-5), interface)])
}

fn quantities(object: &Value) -> Quantities {
    Quantities::from_array(["pi0", "eeq", "gamma", "delta0"].map(|name| number(object, name)))
}

/// The rows of one film of the reference values: stiffnesses are in units of `E2*/t`.
#[test]
fn solve_takes_the_interface_of_one_film() {
    let workdir = workdir!();
    let mut solved = 0;
    for case in Data::read("interfaces_contacts").cases() {
        let [young, nu, _] = case.text("layers").split(':').collect::<Vec<_>>()[..] else {
            // Several layers.
            continue;
        };
        let base = case.text("base").replace("rigid", "inf:0.25");
        let (e0, nu0) = base.split_once(':').expect("two numbers");
        let interface = match case.text("interfaces") {
            "sliding" => "--interface=sliding".to_owned(),
            text => format!("--interface-stiffness={}", text.replace(':', ",")),
        };
        let object = workdir.json(format!(
            "solve --json --a-over-t={} --e1-over-e2={young} --nu1={nu} --e0-over-e2={e0} \
             --nu0={nu0} {interface}",
            case.text("a_over_t")
        ));
        assert!(relative_error(&quantities(&object), &case.quantities()) <= 1e-10);
        let stiffness = &object["interface_stiffness"][0];
        assert!(stiffness.is_number() || stiffness == "inf", "{object}");
        solved += 1;
    }
    assert!(solved >= 20);
}

/// Under a rigid sphere the unit is `E1/t`; the points of a file have one interface.
#[test]
fn solve_takes_rigid_spheres_and_files_of_points() {
    let workdir = workdir!();
    let rigid = "solve --e1-over-e2=0 --nu1=0.3 --e0-over-e2=inf --a-over-t=2";
    let of = |flags: &str| workdir.json(format!("{rigid} {flags} --json"));
    let stack = with_interfaces(
        solid(f64::INFINITY, 0.25),
        &[(layer(1.0, 0.3, 1.0), springs(0.5, 3.0))],
    );
    let truth = solve_stack(2.0, &stack, f64::INFINITY, 1e-11).expect("within reach");
    let found = of("--interface-stiffness=0.5,3");
    assert!(relative_error(&quantities(&found), &truth.quantities) <= 1e-10);
    assert_eq!(found["normalised_by"], "E1*");
    // What is bonded is the film as ever, and 0 is what slides.
    let plain = quantities(&of(""));
    assert_eq!(quantities(&of("--interface=bonded")), plain);
    assert_eq!(quantities(&of("--interface-stiffness=inf")), plain);
    let sliding = quantities(&of("--interface=sliding"));
    assert_eq!(quantities(&of("--interface-stiffness=0")), sliding);
    assert!(sliding.eeq < 0.9 * plain.eeq);

    workdir.write_points("2,0,0.3,inf\n");
    let rows = workdir.csv("solve --points=points.csv --interface=sliding");
    assert!(relative_error(&rows.first().quantities(), &sliding) <= 1e-14);
}

#[test]
fn curve_and_pull_off_are_those_of_a_stack_of_one_layer() {
    let workdir = workdir!();
    for (flags, interface) in [
        ("--interface sliding", Interface::Sliding),
        (
            "--interface-stiffness 2e11Pa/m",
            springs(2e11, f64::INFINITY),
        ),
        ("--interface-stiffness 200GPa/m,3e12", springs(2e11, 3e12)),
    ] {
        let stack = film(interface);
        let ends = "--from=1e-5 --to=1e-4 --points=5";
        let rows = workdir.csv(format!("curve {FILM} {ends} {flags}"));
        let curve = stack_curve(&stack, 2e6, [1.0, 10.0], 1e-8).expect("within reach");
        let contact = Contact::new(&stack.system(1e-3, 2e6), curve).expect("its curve");
        assert_eq!(rows.cases().count(), 5);
        for row in rows.cases() {
            let state = contact.load_and_penetration(row.get("contact_radius"), 0.04);
            let (load, penetration) = state.expect("in range");
            assert_close(row.get("load"), load, 1e-7);
            assert_close(row.get("penetration"), penetration, 1e-7);
        }
        let found = workdir.json(format!("pull-off --json {FILM} {flags}"));
        let wide = stack_curve(&stack, 2e6, [1e-3, 50.0], 1e-9).expect("within reach");
        let contact = Contact::new(&stack.system(1e-3, 2e6), wide).expect("its curve");
        let expected = contact.pull_off(0.04, Control::Load).expect("it parts");
        assert_close(number(&found, "load"), expected.load, 1e-7);
    }
    // Bonded, and springs without end, are the film as ever.
    let ends = "--from=1e-5 --to=1e-4 --points=5";
    let plain = workdir.succeed(format!("curve {FILM} {ends}"));
    for flags in ["--interface bonded", "--interface-stiffness inf"] {
        let found = workdir.succeed(format!("curve {FILM} {ends} {flags}"));
        assert_eq!(found, plain);
    }
}

/// A contact with an attraction of finite range, whose pull-off comes to that without range.
#[test]
fn an_attraction_of_finite_range_feels_the_interface() {
    let workdir = workdir!();
    let load = |flags: &str| {
        let found = workdir.json(format!("pull-off --json {FILM} {flags}"));
        number(&found, "load")
    };
    let short = load("--interface=sliding --interaction-range=10nm");
    assert_close(short, load("--interface=sliding"), 1e-3);
    let bonded = load("--interaction-range=10nm");
    assert!((short / bonded - 1.0).abs() > 4e-3, "{short} {bonded}");
}

/// Data of a film on springs, and the fits that assume springs, sliding and bonding.
#[test]
fn a_fit_finds_the_stiffness_of_an_interface() {
    let workdir = workdir!();
    let known = "--kind=load-radius --from=5um --to=60um --points=30";
    let made = "--interface-stiffness=3e11 --noise=0.05uN -o film.csv";
    workdir.succeed(format!("simulate {FILM} {known} {made}"));
    let fit = |flags: &str| {
        let run = workdir.run(format!("fit film.csv --json {FILM} {flags}"));
        json(&run.stdout)
    };
    let free = "--free=film.interface-stiffness,work-of-adhesion";
    let found = fit(&format!("--interface-stiffness=1e12 {free}"));
    let stiffness = "film.interface_stiffness";
    assert_eq!(found["parameters"][stiffness]["unit"], "Pa/m");
    assert_estimate(&found, stiffness, 3e11, 0.2 * 3e11);
    // Without a start, the layer's own stiffness is one.
    let again = fit(&format!("--interface=sliding {free}"));
    let [value, other] = [&found, &again].map(|fit| estimate(fit, stiffness)[0]);
    assert_close(other, value, 1e-3);
    // A fit that assumes bonding says what sliding would change.
    let bonded = fit("--free=film-modulus,work-of-adhesion");
    assert!(kinds(&bonded).contains(&"assumes-bonding"), "{bonded}");
    assert!(!kinds(&found).contains(&"assumes-bonding"), "{found}");
}

/// The data of the page about fits, by the command in their head.
#[test]
fn the_data_of_the_example_are_made_as_they_say() {
    let path = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../crates/fit/data/sliding.csv"
    );
    let text = std::fs::read_to_string(path).expect("it is there");
    let command = text.lines().nth(1).expect("a command");
    let made = workdir!().succeed(command.trim_start_matches("# tabulate "));
    let [found, made] = [&text, &made].map(|text| Data::parse("sliding", text));
    assert_eq!(found.cases().count(), 40);
    for (found, made) in found.cases().zip(made.cases()) {
        for column in ["contact_radius", "load"] {
            assert!((found.get(column) - made.get(column)).abs() <= 1e-14);
        }
    }
}

#[test]
fn wrong_first_calls_say_what_to_do() {
    let workdir = workdir!();
    workdir.write("stack.toml", STACK);
    workdir.refuses(format!(
        "
        2 | curve {FILM} --interface slipping | slipping; bonded; sliding
        2 | curve {FILM} --interface 2e11 | 2e11; bonded; sliding
        2 | curve {FILM} --interface-stiffness sliding | sliding; is not a number
        2 | curve {FILM} --interface-stiffness 2GPa | 2GPa; is a modulus; a stiffness per area; Pa/m
        2 | curve {FILM} --interface-stiffness 1,2,3 | more than two; KT,KN
        1 | solve --a-over-t 1 --e1-over-e2 0 --nu1 0.5 --e0-over-e2 inf --interface-stiffness 1,1e-13 | the film; 1e-13 E1/t
        1 | curve {FILM} --interface-stiffness -1 | the film; tangential; -1.0 Pa/m; 0
        2 | curve {FILM} --interface sliding --interface-stiffness 1 | --interface; --interface-stiffness
        2 | curve embedded {FILM} --interface sliding | --interface; [TABLE]
        2 | curve --specimen paper --stack stack.toml --interface sliding | --interface; --stack
        2 | curve {FILM} --interface sliding --film-thickness 0.1um | --film-thickness
        1 | curve --specimen paper --film-thickness 0.1um --interface sliding --to 150um | 0.00015 m; 1000 times; --to; 9.999999999999999e-5
        1 | solve --a-over-t 1500 --e1-over-e2 1.75 --nu1 0.5 --e0-over-e2 inf --interface sliding | 1500; one layer; 1000
        "
    ));
}

const STACK: &str = "base = { young_modulus = 2e11, poisson_ratio = 0.25 }\n\
    [[layers]]\nname = \"primer\"\nyoung_modulus = 5e5\npoisson_ratio = 0.5\nthickness = 2.5e-6\n\
    interface = { tangential_stiffness = 2e11, normal_stiffness = inf }\n\
    [[layers]]\nyoung_modulus = 3.5e6\npoisson_ratio = 0.5\nthickness = 7.5e-6\n\
    interface = \"sliding\"\n";

fn solve_file(workdir: &Workdir, text: &str) -> Result<Value, String> {
    workdir.write("stack.toml", text);
    let flags = "solve --stack=stack.toml --sphere-modulus=2e6 --a-over-t=3 --json";
    let run = workdir.run(flags);
    match run.status {
        0 => Ok(json(&run.stdout)),
        _ => Err(run.stderr),
    }
}

#[test]
fn a_stack_file_has_the_interfaces_of_its_layers() {
    let workdir = workdir!();
    let found = solve_file(&workdir, STACK).expect("sound");
    let stack = with_interfaces(
        solid(2e11, 0.25),
        &[
            (layer(5e5, 0.5, 2.5e-6), springs(2e11, f64::INFINITY)),
            (layer(3.5e6, 0.5, 7.5e-6), Interface::Sliding),
        ],
    );
    let truth = solve_stack(3.0, &stack, 2e6, 1e-10).expect("within reach");
    assert!(relative_error(&quantities(&found), &truth.quantities) <= 1e-14);
    let cases = r#"
        "sliding" | "slide" | layer 2 of 2; "slide" is none; "sliding"
        "sliding" | 5 | layer 2 of 2; interface = 5; "sliding"
        = 2e11, normal | = -1, normal | primer; tangential; -1.0 Pa/m
        = 2e11, normal | = "200 GPa/m", normal | primer; tangential_stiffness = "200 GPa/m"; Pa/m, such as 2e11
        tangential_stiffness = 2e11, | | primer; tangential_stiffness is missing; 0; inf
        normal_stiffness | normal | primer; unknown key "normal"; normal_stiffness
        thickness = 2.5e-6 | thickness = 2.5 um | SI units; without quotes
        thickness = 2.5e-6 | thickness = "2.5e-6" | SI units; without quotes
        "#;
    assert_cases(cases, |[from, to, _]| {
        solve_file(&workdir, &STACK.replacen(from, to, 1)).expect_err("refused")
    });
}

/// The largest contact of layers may be above 1000 times the thickness by rounding: by default, and as messages advise.
#[test]
fn layers_are_solved_up_to_their_reach() {
    let workdir = workdir!();
    let curve = "curve --specimen paper --interface sliding --points 2 --film-thickness";
    workdir.succeed(format!("{curve} 1e-8"));
    let wide = format!("{curve} 1um --sphere-radius 1cm --to");
    assert_names(
        &workdir.fail(1, format!("{wide} 1.1mm")),
        "of 0.001 or less",
    );
    workdir.succeed(format!("{wide} 0.001"));
    workdir.write("stack.toml", STACK);
    let solve = "solve --stack stack.toml --sphere-modulus 2e6 --a-over-t";
    workdir.succeed(format!("{solve} 750"));
    let refused = workdir.fail(1, format!("{solve} 750.001"));
    assert_names(&refused, "a_over_t = 750.001; at most 1000 times");
}

/// What springs open is no strain of the film above them.
#[test]
fn springs_that_open_do_not_strain_the_film() {
    let workdir = workdir!();
    let note = |flags: &str| {
        let run = workdir.answer(format!("curve --specimen paper --points=2 {flags}"));
        run.stderr.contains("would compress the film")
    };
    let rigid = "--sphere-modulus=inf --film-poisson-ratio=0.3";
    for (stiffness, is_strained) in [
        ("1e9", [false, false]),
        ("1e11", [false; 2]),
        ("2e12", [false, true]),
        ("1e16", [false, true]),
    ] {
        for (flags, is_strained) in ["", rigid].into_iter().zip(is_strained) {
            let springs = format!("{flags} --interface-stiffness=1e16,{stiffness}");
            assert_eq!(note(&springs), is_strained, "{springs}");
        }
    }
}
