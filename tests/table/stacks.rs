//! Tables of one stack of layers: their lookups are those of direct solves of the stack, in every
//! form of the file, and lookups of films are refused.

use acceptance::{
    Refused, Workdir, assert_cases, assert_matches, assert_names, estimate, forged, larger, layer,
    material, relative_error, solid, stack, table, with_interfaces, workdir,
};
use interp::{Description, Error, Parameter, Quantity, Table};
use solve::stack::{Interface, Stack};
use solve::{solve_stack, stack_curve};
use tabulate::table::{Scene, certify, stack_of};

const AXES: &str = "\
title = 'Layers'
tolerance = 1e-6
a_over_t = { from = 0.03, to = 30 }
e1_over_e2 = { from = 1e-2, to = 1e2 }
";
const STACK: &str = "\
[stack]
base = { young_modulus = 2e11, poisson_ratio = 0.25 }
[[stack.layers]]
name = 'primer'
young_modulus = 5e5
poisson_ratio = 0.5
thickness = 2.5e-6
[[stack.layers]]
young_modulus = 3.5e6
poisson_ratio = 0.49
thickness = 7.5e-6
";

fn scene() -> String {
    format!("{AXES}{STACK}")
}

/// The text of [`STACK`] as a file of a stack.
fn stack_file() -> String {
    STACK.replace("[stack]\n", "").replace("[[stack.", "[[")
}

/// The stack of [`STACK`], apart from its text.
fn layers() -> Stack {
    stack(
        solid(2e11, 0.25),
        &[layer(5e5, 0.5, 2.5e-6), layer(3.5e6, 0.49, 7.5e-6)],
    )
}

/// Returns places from 0 to 1 that are nodes of no axis.
fn places(count: u32) -> impl Iterator<Item = [f64; 2]> {
    (0..count).map(|i| [0.618_034, 0.754_878].map(|step| (f64::from(i) + 0.5) * step % 1.0))
}

/// Returns the stack that a table is of.
fn of(table: &Table) -> Stack {
    let named = stack_of(table).expect("a sound scene");
    named.expect("a table of a stack").stack
}

/// Returns the largest relative error of `count` lookups in a table of a stack, against direct solves to 1e-11.
fn largest_error(table: &Table, stack: &Stack, count: u32) -> f64 {
    let found = of(table);
    assert_eq!(&found, stack);
    let top = stack.layers().last().expect("a layer").solid.young();
    let mut worst = 0.0;
    for [x, sphere] in places(count) {
        let a_over_t = 0.03 * 1000_f64.powf(x);
        let sphere_modulus = match table.unit() {
            "E1*" => f64::INFINITY,
            _ => top / (1e-2 * 1e4_f64.powf(sphere)),
        };
        let curve = found.curve_in(table, sphere_modulus).expect("inside");
        let truth = solve_stack(a_over_t, stack, sphere_modulus, 1e-11).expect("in reach");
        let found = curve.quantities(a_over_t).expect("inside");
        worst = larger(worst, relative_error(&found, &truth.quantities));
    }
    println!("{}: {worst:.1e}", table.description().title);
    worst
}

#[test]
fn lookups_between_the_nodes_are_direct_solves() {
    let dense = table(&scene());
    assert_eq!(dense.parameters(), Parameter::STACK);
    let certified = dense.description().certificate.max_error;
    let error = largest_error(&dense, &layers(), 200);
    assert!(certified <= 1e-6 && error <= 1e-6);
    let packed = Table::from_packed(&dense.to_packed().expect("small")).expect("sound");
    assert_eq!(largest_error(&packed, &layers(), 200), error);
}

/// A contact of the table is that of the curve of the stack, and knows the same of its layers.
#[test]
fn a_contact_is_that_of_the_curve_of_the_stack() {
    let (dense, stack) = (table(&scene()), layers());
    let found = of(&dense);
    for sphere_modulus in [1e5, 2e6, 1e8] {
        let looked_up = found.curve_in(&dense, sphere_modulus).expect("inside");
        let system = found.system(1e-3, sphere_modulus);
        let contact = contact::Contact::new(&system, looked_up).expect("its curve");
        let curve = stack_curve(&stack, sphere_modulus, [0.03, 30.0], 1e-9).expect("in reach");
        let system = stack.system(1e-3, sphere_modulus);
        let solved = contact::Contact::new(&system, curve).expect("its curve");
        for radius in [5e-6, 2e-5, 1e-4] {
            let [found, solved] = [&contact, &solved]
                .map(|contact| contact.load_and_penetration(radius, 0.0).expect("inside"));
            assert!((found.0 / solved.0 - 1.0).abs() <= 1e-6);
            assert!((found.1 / solved.1 - 1.0).abs() <= 1e-6);
        }
        let [found, solved] =
            [&contact, &solved].map(|contact| contact.curve().and_then(interp::Curve::stack));
        assert_eq!(found, solved);
        assert!(found.is_some());
    }
}

/// A single layer is the film; one that slides is no film, and its table holds the interface. A rigid sphere and a rigid
/// base, which needs no Poisson ratio, are limits.
#[test]
fn films_and_limits_are_looked_up_as_they_are_solved() {
    let film = |interface: &str| {
        format!(
            "{AXES}[stack]\nbase = {{ young_modulus = 1e8, poisson_ratio = 0.3 }}\n[[stack.layers]]\n\
             young_modulus = 2e6\npoisson_ratio = 0.4\nthickness = 1e-6\ninterface = '{interface}'\n"
        )
    };
    let of = |interface| with_interfaces(solid(1e8, 0.3), &[(layer(2e6, 0.4, 1e-6), interface)]);
    let rigid = scene()
        .replace("{ from = 1e-2, to = 1e2 }", "0")
        .replace("2e11, poisson_ratio = 0.25", "inf");
    let parts = [layer(5e5, 0.5, 2.5e-6), layer(3.5e6, 0.49, 7.5e-6)];
    for (scene, stack, unit) in [
        (film("bonded"), of(Interface::Bonded), "E2*"),
        (film("sliding"), of(Interface::Sliding), "E2*"),
        (rigid, stack(solid(f64::INFINITY, 0.0), &parts), "E1*"),
    ] {
        let dense = table(&scene);
        assert_eq!(dense.unit(), unit);
        let packed = Table::from_packed(&dense.to_packed().expect("small")).expect("sound");
        for table in [&dense, &packed] {
            assert!(largest_error(table, &stack, 50) <= 1e-6, "{scene}");
        }
        let other = dense.stack_curve(1.0, stack.shape());
        let is_refused = matches!(other, Err(Error::Normalisation { .. }));
        assert_eq!(is_refused, unit == "E1*");
    }
}

#[test]
fn what_a_table_of_a_stack_does_not_answer_is_an_error() {
    let dense = table(&scene());
    let film = material([1.75, 0.49, 1e5, 0.25]);
    assert!(matches!(dense.curve(&film), Err(Error::OfStack)));
    assert_matches!(dense.curve_with_gradient(&film), Err(Error::OfStack));
    let found = of(&dense);
    let curve = found.curve_in(&dense, 2e6).expect("inside");
    // There is an estimate of the error between the nodes, and no expansion beyond them.
    assert_eq!(
        curve.error(1.0).expect("inside"),
        dense.description().certificate.max_error
    );
    for beyond in [0.0299, 30.1] {
        curve.quantities(beyond).refused("a_over_t; 0.03 to 30.0");
        assert!(curve.error(beyond).is_err());
    }
    assert!(matches!(curve.gradient(1.0), Err(Error::NoGradient)));
    for sphere_modulus in [3.4e4, 3.6e8, f64::INFINITY] {
        assert!(found.curve_in(&dense, sphere_modulus).is_err());
    }
    let shape = found.shape();
    for e1_over_e2 in [f64::NAN, -1.0, f64::INFINITY] {
        let curve = dense.stack_curve(e1_over_e2, shape);
        assert_matches!(curve, Err(Error::Unphysical { .. }));
    }
    let of_films = Table::embedded().stack_curve(1.0, shape);
    assert_matches!(of_films, Err(Error::NotOfStack));
    assert_eq!(stack_of(Table::embedded()).expect("sound"), None);
    // One quantity does not give the others: the expansion that they begin with is a film's.
    let gamma = table(&format!("quantities = ['gamma']\n{}", scene()));
    let curve = gamma.stack_curve(1.0, shape).expect("inside");
    assert!(curve.quantity(Quantity::Gamma, 1.0).is_ok());
    let eeq = curve.quantity(Quantity::Eeq, 1.0);
    assert_matches!(eeq, Err(Error::MissingQuantity("eeq")));
}

/// A forged file whose scene is that of another stack would look up another `t` and shape.
#[test]
fn a_scene_that_is_not_that_of_the_axes_is_refused() {
    let dense = table(&scene());
    for (from, to, part) in [
        ("poisson_ratio = 0.49", "poisson_ratio = 0.48", "0.48"),
        ("young_modulus = 3.5e6", "young_modulus = 3e6", "e0_over_e1"),
        (STACK, "nu1 = 0.5\ne0_over_e2 = 1", "no [stack]"),
        ("title", "name", "name"),
    ] {
        let change = |sound: &mut Description| sound.scene = sound.scene.replace(from, to);
        let forged = forged(&dense, |_, _, value| value, change).expect("sound axes");
        let message = stack_of(&forged).expect_err("refused").to_string();
        assert_names(&message, &["malformed", part]);
    }
}

/// A stack has one top layer and one base, and a rigid sphere its own table.
#[test]
fn axes_of_several_stacks_are_refused() {
    let dense = table(&scene());
    for (parameter, nodes, part) in [
        (Parameter::Nu1, vec![0.3, 0.4], "it must have 1"),
        (Parameter::E0OverE1, vec![1.0, 2.0], "one number"),
        (Parameter::E0OverE1, vec![-1.0], "one number"),
        (Parameter::E0OverE1, vec![], "empty"),
        (Parameter::E1OverE2, vec![0.0, 1.0], "0 as the only node"),
    ] {
        let mut axes = dense.axes();
        axes[parameter.dimension()].1 = nodes;
        let count = axes.iter().map(|(_, nodes)| nodes.len()).product();
        let values = [Some(vec![1.0; count]), None, None, None];
        let refused = Table::new(dense.description().clone(), axes, values);
        refused.refused(&["malformed", parameter.name(), part]);
    }
}

/// The certificate compares with solves of the layers in the scene: it finds wrong values, and a
/// scene whose lower layers are not those of the values.
#[test]
fn the_certificate_finds_wrong_values_and_other_layers() {
    let dense = table(&scene());
    let certified = |factor: f64, primer: &str| {
        let change = |sound: &mut Description| sound.scene = sound.scene.replace("5e5", primer);
        let forged = forged(&dense, |_, _, value| factor * value, change).expect("sound axes");
        certify(&forged, 200, 3, &|_| {})
            .expect("in reach")
            .max_error
    };
    assert!(certified(1.0, "5e5") <= 1e-6);
    assert!((certified(1.001, "5e5") - 1e-3).abs() <= 2e-6);
    // A primer that is 2 % stiffer changes wide contacts by about that.
    let found = certified(1.0, "5.1e5");
    println!("another primer: {found:.1e}");
    assert!(found > 5e-3 && found < 5e-2);
}

#[test]
fn a_mistake_in_a_scene_is_named() {
    let scene = scene();
    // The text that is changed, the new one, and words of the error.
    let changes = r#"
        title = | nu1 = 0.5\ntitle = | nu1; leave it out
        title = | nu0 = 0.5\ntitle = | nu0; leave it out
        title = | e0_over_e2 = 1\ntitle = | e0_over_e2; leave it out
        e1_over_e2 = | e1s_over_einfs = | e1s_over_einfs; leave it out
        e1_over_e2 = { from = 1e-2, to = 1e2 } |  | e1_over_e2 is missing; sphere
        to = 30 | to = 800 | 800; up to 749.9
        thickness = 2.5e-6 | thickness = 0 | stack: layer "primer", 1 of 2; > 0 and finite
        thickness = 2.5e-6 | height = 1 | height; thickness
        [[stack.layers]] | [[layers]] | layers:; [[stack.layers]]
        "#;
    assert_cases(changes, |[from, to, _]| {
        assert!(scene.contains(from), "{from}");
        let changed = scene.replace(from, &to.replace("\\n", "\n"));
        Scene::parse(&changed, None).expect_err(to)
    });
    let empty = format!("{AXES}[stack]\nbase = {{ young_modulus = inf }}\n");
    Scene::parse(&empty, None).refused("stack: there is no; [[layers]]");
    let film = format!("{AXES}e0_over_e2 = 1\n");
    Scene::parse(&film, None).refused("nu1 is missing; (-1, 0.5]");
}

fn generated() -> Workdir {
    let workdir = workdir!();
    workdir.write("scene.toml", scene());
    workdir.succeed("generate scene.toml --certificate-points 1000");
    workdir
}

/// The thicknesses are in the scene alone, whose bytes HDF5 does not check.
#[test]
fn a_scene_with_another_thickness_is_damage() {
    let workdir = generated();
    let mut bytes = workdir.read("scene.h5");
    let thickness = b"thickness = 2.5e-6";
    let place = bytes
        .windows(thickness.len())
        .position(|found| found == thickness);
    bytes[place.expect("as text") + 12] = b'3';
    let file = workdir.write("other.h5", bytes);
    let error = Table::open(file).expect_err("damaged").without_file();
    assert!(matches!(error, Error::Checksum { .. }), "{error}");
}

/// Under a rigid sphere the modulus of the top layer is the unit of that of the base.
#[test]
fn points_under_a_rigid_sphere_are_direct_solves() {
    let workdir = workdir!();
    let scene = scene().replace("e1_over_e2 = { from = 1e-2, to = 1e2 }", "e1_over_e2 = 0.0");
    workdir.write("scene.toml", scene);
    workdir.succeed("generate scene.toml --certificate-points 100");
    workdir.write("points.csv", "a_over_t,e1_over_e2\n3,0\n");
    let found = workdir.csv("query scene.h5 --points points.csv");
    let truth = solve_stack(3.0, &layers(), f64::INFINITY, 1e-11).expect("in reach");
    let error = relative_error(&found.first().quantities(), &truth.quantities);
    assert!(error <= 1e-6, "{error:e}");
}

/// Every command either works with a table of a stack or says what to do.
#[test]
fn the_commands_take_it_or_refuse_it() {
    let workdir = generated();
    let info = workdir.succeed("info scene.h5");
    assert_names(
        &info,
        "a_over_t; e1_over_e2; nu1             0.49; e0_over_e1; layer           7.5e-6 m, E = 3500000.0 Pa; primer: 2.5e-6 m; bonded below",
    );
    workdir.succeed("check scene.h5 --points 1000");

    workdir.succeed("pack scene.h5 -o dense.bin");
    workdir.succeed("pack scene.h5 -o small.bin --tolerance 1e-5");
    workdir.succeed("unpack small.bin -o again.h5");
    for (name, most) in [
        ("scene.h5", 1e-6),
        ("dense.bin", 1e-6),
        ("small.bin", 1e-5),
        ("again.h5", 1e-5),
    ] {
        assert!(
            largest_error(&workdir.table(name), &layers(), 200) <= most,
            "{name}"
        );
    }

    workdir.write("points.csv", "a_over_t,e1_over_e2\n3,1.75\n");
    let answer = workdir.csv("query scene.h5 --points points.csv");
    let truth = solve_stack(3.0, &layers(), 2e6, 1e-11).expect("in reach");
    let found = answer.first().quantities();
    assert!(
        relative_error(&found, &truth.quantities) <= 1e-6,
        "{found:?}"
    );

    workdir.write(
        "films.csv",
        "a_over_t,e1_over_e2,nu1,e0_over_e2\n3,1.75,0.5,1\n",
    );
    let plan = "--value primer.modulus=1e6 --kind load-radius --from 5e-5 --to 1e-4 --noise 0";
    workdir.refuses(format!(
        "
        1 | query scene.h5 --points films.csv | for a table of one stack of layers are a_over_t, e1_over_e2
        1 | query scene.h5 --points points.csv --gradient | leave out --gradient
        1 | curve scene.h5 | `pull-off` or `fit` as --stack
        1 | curve --stack scene.h5 --tolerance 1e-6 | leave out --tolerance
        1 | simulate --stack scene.h5 {plan} | do without the table: name a stack file
        1 | report scene.h5 -o page.html | one stack of layers
        1 | cost lookup scene.h5 | this table has other axes
        1 | cost table scene.toml | give a scene without [stack]
        "
    ));
}

/// The flag `--stack` with a table prints what it prints with the file of the same stack.
#[test]
fn a_table_takes_the_place_of_a_stack_file() {
    let workdir = generated();
    workdir.succeed("pack scene.h5 -o scene.bin");
    workdir.write("stack.toml", stack_file());
    let commands = [
        "curve --from 5e-5 --to 2e-4 --points 9",
        "pull-off --json",
        "pull-off --json --interaction-range 1e-9",
        "simulate --kind load-radius --from 8e-5 --to 1e-4 --noise 0",
    ];
    for command in commands {
        let of = |file: &str| numbers(&workdir.succeed(format!("{command} --stack {file}")));
        let truth = of("stack.toml");
        assert!(truth.len() >= 4, "{command:?}");
        for file in ["scene.h5", "scene.bin"] {
            let found = of(file);
            assert_eq!(found.len(), truth.len());
            for (found, truth) in found.iter().zip(&truth) {
                // The table is certified to 1e-6. The place of a pull-off has some times the error
                // of the quantities, and so has a load, which is a difference of larger terms.
                let error = (found / truth - 1.0).abs();
                assert!(error <= 1e-5, "{command:?}: {found}, {truth}");
            }
        }
    }
}

/// A fit whose layers are known finds the same values with a table as with direct solves.
#[test]
fn a_fit_with_a_table_is_that_with_the_stack_file() {
    let workdir = generated();
    workdir.write("stack.toml", stack_file());
    let flags = "simulate --kind load-radius --from 4e-5 --to 1.3e-4 --noise 5e-6 --seed 3 \
                 --stack stack.toml -o data.csv";
    workdir.succeed(flags);
    let fit = |file: &str| {
        let free = "sphere-modulus,work-of-adhesion";
        let flags = format!("fit data.csv --json --specimen paper --free {free} --stack {file}");
        let object = workdir.json(&flags);
        ["sphere_modulus", "work_of_adhesion"].map(|name| estimate(&object, name))
    };
    let solved = fit("stack.toml");
    for (found, [truth, stderr]) in fit("scene.h5").into_iter().zip(solved) {
        let errors = [(found[0] - truth) / stderr, found[1] / stderr - 1.0];
        assert!(errors.iter().all(|error| error.abs() <= 1e-4), "{errors:?}");
    }
    let fit = "fit data.csv --stack scene.h5 --free primer.modulus --specimen paper";
    let message = workdir.fail(1, fit);
    assert_names(
        &message,
        "primer.modulus cannot be found; name a stack file",
    );
    // The next step after an error of the table.
    let beyond = "fit data.csv --stack scene.h5 --free work-of-adhesion --specimen paper --sphere-modulus 1kPa";
    assert_names(
        &workdir.fail(1, beyond),
        "e1_over_e2; `tabulate generate` makes tables",
    );
}

/// Returns the numbers in a text without its comments, in their order.
fn numbers(text: &str) -> Vec<f64> {
    text.lines()
        .filter(|line| !line.starts_with('#'))
        .flat_map(|line| line.split(|c: char| !(c.is_ascii_digit() || "+-.e".contains(c))))
        .filter_map(|word| word.parse().ok())
        .collect()
}
