//! `tabulate curve`, `simulate` and `fit` of contact stiffness, and files of nanoindenters.

mod published;

use acceptance::{
    Workdir, assert_close, assert_names, assert_near, estimate, larger, looked_up, number,
    paper_system, solid, system_of, workdir,
};
use interp::{Probe, System};
use serde_json::Value;

/// A diamond pyramid on an oxide on silicon.
const OXIDE: &str = "--sphere-modulus 1146.6GPa --film-thickness 500nm --film-modulus 72GPa \
     --film-poisson-ratio 0.17 --substrate-modulus 170GPa --substrate-poisson-ratio 0.28 \
     --beta 1.034";

fn with(first: &str, more: &str) -> String {
    format!("{first} {OXIDE} {more}")
}

fn found(workdir: &Workdir, args: &str, parameter: &str) -> [f64; 2] {
    estimate(&workdir.json(format!("{args} --json")), parameter)
}

#[test]
fn curves_have_both_stiffnesses() {
    let workdir = workdir!();
    let film = "--specimen paper --film-thickness 30um";
    let range = "--from 40um --to 130um --points 10";
    let system = paper_system(3e-5);
    let contact = looked_up(&system);
    for table in ["", "embedded"] {
        let data = workdir.csv(format!("curve {table} {film} {range}"));
        let mut worst: f64 = 0.0;
        for row in data.cases() {
            let a = row.get("contact_radius");
            let pinned = contact.stiffness(a).expect("in range");
            let moving = contact.moving_stiffness(a, 0.04).expect("in range");
            worst = larger(worst, (row.get("contact_stiffness") / pinned - 1.0).abs());
            worst = larger(worst, (row.get("moving_stiffness") - moving).abs() / pinned);
        }
        assert!(worst < 3e-5, "{worst:e}");
    }
    // A punch has no second.
    let punch = "--probe flat-punch --sphere-radius 20um";
    let rows = workdir.csv(format!("curve {film} {punch}"));
    let system = System {
        probe: Probe::FlatPunch { radius: 2e-5 },
        ..system
    };
    let punch = looked_up(&system);
    let expected = punch.stiffness(2e-5).expect("its radius");
    assert_close(rows.first().get("contact_stiffness"), expected, 1e-5);
    assert!(rows.first().get("moving_stiffness").is_nan());
}

/// What `simulate` makes, `fit` finds. Stiffnesses at radii are simulated below, with phases.
#[test]
fn simulated_stiffnesses_are_found_again() {
    let workdir = workdir!();
    for (kind, ends, more, parameters) in [
        (
            "stiffness-load",
            "--from 0.1mN --to 20mN",
            "--hardness 10GPa --frame-compliance 0.4nm/mN",
            &["film_modulus", "hardness", "frame_compliance"][..],
        ),
        (
            "stiffness-depth",
            "--from 40nm --to 220nm",
            "--hardness 10GPa --tip-rounding 6nm --thinning 0.333",
            &["film_modulus"],
        ),
    ] {
        let plan = format!("simulate --kind {kind} {ends} {more}");
        workdir.succeed(with(&plan, "--noise 1% -o made.csv"));
        let free = parameters.join(",").replace('_', "-");
        let more = format!("{more} --kind {kind} --free {free}");
        let args = with("fit made.csv", &more);
        for parameter in parameters {
            let truth = match *parameter {
                "hardness" => 10e9,
                "frame_compliance" => 4e-7,
                _ => 72e9,
            };
            let [value, error] = found(&workdir, &args, parameter);
            assert_near(value, truth, 3.5 * error);
            assert!(error < 0.3 * truth, "{kind}: {value} {error}");
        }
        // A frame that is found to a fifth of its compliance is determined.
        let said = workdir.succeed(&args);
        assert!(!said.contains("not determined"), "{said}");
    }
}

/// Files as nanoindenters write them: units in a row below the headings, segments in the first
/// column, missing values; a preamble, and storage and loss.
#[test]
fn files_of_nanoindenters_are_read() {
    let workdir = workdir!();
    let system = system_of(
        Probe::Paraboloid { radius: 0.1 },
        1.1466e12,
        solid(7.2e10, 0.17),
        5e-7,
        solid(1.7e11, 0.28),
    );
    let contact = looked_up(&system);
    let mut rows = Vec::new();
    for i in 1..=20 {
        let a = 5e-8 * f64::from(i);
        let stiffness = 1.034 * contact.stiffness(a).expect("in range");
        let load = std::f64::consts::PI * 1e10 * a * a;
        let contact_depth = a / (24.56 / std::f64::consts::PI).sqrt();
        let h = contact_depth + 0.75 * load / stiffness;
        let area = std::f64::consts::PI * a * a;
        rows.push([h * 1e9, load * 1e3, stiffness, area * 1e18]);
    }
    let mut csm =
        "Segment\tDisplacement Into Surface\tLoad On Sample\tHarmonic Contact Stiffness\n\
                   \tnm\tmN\tN/m\n\
                   Surface Approach Segment\t-3\t0.0001\t1.797e308\n\t-1\t0.0002\t1.1e308\n"
            .to_owned();
    let mut hysitron = "Version 9\nSample: oxide\n\nIndent Disp. (nm)\tIndent Act. Load (uN)\tStorage Stiff. (uN/nm)\t\
         Loss Stiff. (uN/nm)\tContact Depth (nm)\tContact Area (nm^2)\n"
        .to_owned();
    for (i, [h, load, stiffness, area]) in rows.iter().enumerate() {
        let segment = if i == 0 { "Load Segment" } else { "" };
        csm += &format!("{segment}\t{h}\t{load}\t{stiffness}\n");
        let [load, stiffness] = [load * 1e3, stiffness * 1e-3];
        let loss = 0.1 * stiffness;
        hysitron += &format!("{h}\t{load}\t{stiffness}\t{loss}\t{h}\t{area}\n");
    }
    csm += "\t1.1e308\t1.1e308\t1.1e308\nHold Segment\t400\t30\t2e5\n\
            Unload From Peak Segment\t300\t1\t2e5\n";
    workdir.write("csm.txt", csm);
    workdir.write("hysitron.txt", hysitron);
    let depth = "--kind stiffness-depth";
    let args = with("fit csm.txt", depth);
    let [value, _] = found(&workdir, &args, "film_modulus");
    assert_close(value, 7.2e10, 1e-4);
    let words = "20 points; 1 rows without values; 3 rows of a pause; 1 rows of another segment";
    assert_names(&workdir.succeed(&args), words);
    // The area as a column, and storage and loss.
    let args = with("fit hysitron.txt", "--kind stiffness-radius");
    let object = workdir.json(format!("{args} --json"));
    let tangent = number(&object, "loss/tangent");
    // The film is 0.5 to 0.9 of the compliance.
    assert!(tangent > 0.1 && tangent < 0.3, "{tangent}");
    let words = "loss tangent; storage modulus; loss modulus";
    assert_names(&workdir.succeed(&args), words);
}

#[test]
fn wrong_first_calls_are_answered() {
    let workdir = workdir!();
    workdir.write_files(
        r"
        depth.csv | penetration,load,contact_stiffness\n1e-7,1e-3,4e4\n2e-7,4e-3,8e4\n3e-7,9e-3,1.2e5\n
        radius.csv | contact_radius,contact_stiffness\n1e-7,4e4\n2e-7,8e4\n3e-7,1e5\n
        turned.csv | depth [m],load [N],contact stiffness [N/m]\n-1e-7,1e-3,4e4\n-2e-7,4e-3,8e4\n-3e-7,9e-3,1.2e5\n
        ",
    );
    let depth = with("fit depth.csv", "--kind stiffness-depth");
    let turned = with("fit turned.csv", "--kind stiffness-depth");
    let radius = with("fit radius.csv", "");
    let plan = with("simulate --from 50nm --to 200nm --noise 1%", "");
    workdir.refuses(format!(
        "
        1 | fit depth.csv --kind stiffness-depth | --sphere-modulus; --film-thickness
        1 | {depth} --noise 10 | --noise; per cent; 1%
        1 | fit depth.csv --kind load-penetration {OXIDE} | --beta
        1 | {radius} --epsilon 1 | --epsilon; stiffness-depth
        1 | {depth} --known beta=1.1+-0.02 | --beta 1.034 and --known beta=1.1 are two values; leave one of them out
        1 | fit depth.csv --kind load-penetration --known beta=1+-0.02 --half-space --sphere-radius 1um --sphere-modulus inf --film-modulus 1GPa --film-poisson-ratio 0.2 --work-of-adhesion 0 --free film-modulus | beta; bodies that have it
        1 | {radius} --thinning 0.3 | --thinning
        1 | {radius} --kind stiffness-depth | penetration; load
        2 | {depth} --tip-rounding 6GPa | --tip-rounding; a length
        2 | {depth} --frame-compliance 2nm | --frame-compliance; a compliance
        1 | {depth} --area 0 | --area; positive
        2 | {depth} --contact-depth hertz | oliver-pharr; loubet
        2 | {depth} --between 60nm | --between; 60nm..250nm
        2 | {depth} --between 250nm..60nm | --between; below
        1 | {depth} --between 1um..2um | no point is left; from 1e-6 to 2e-6 m; the points are from
        2 | {depth} --reference-modulus 170GPa | --reference
        1 | {depth} --reference radius.csv | radius.csv; penetration
        1 | {depth} --reference depth.csv --reference-modulus 170GPa | --free film-modulus,tip-rounding
        1 | {depth} --reference depth.csv --free film-modulus,tip-rounding --own tip-rounding | --free film-modulus,tip-rounding
        1 | {turned} | penetration; --column \"penetration=-
        1 | {plan} --kind stiffness-depth | --hardness; 10GPa
        1 | {plan} --kind stiffness-radius --work-of-adhesion 0 --expect --free work-of-adhesion | work-of-adhesion cannot be found; elastic load
        1 | {plan} --kind stiffness-load | --from; a force
        1 | simulate --kind load-radius --from 50um --to 90um --noise 1% | per cent
        "
    ));
}

/// Data with phases: the fit finds the modulus and the loss tangent that they were made with, at
/// depths with the compliance of a frame, too; and tells a/t.
#[test]
fn simulated_phases_give_their_loss_tangent_back() {
    let workdir = workdir!();
    let bodies = |modulus: &str| {
        format!(
            "--specimen paper --sphere-modulus 1100GPa --film-modulus {modulus} \
             --film-poisson-ratio 0.2 --film-thickness 500nm --substrate-modulus 170GPa"
        )
    };
    let of_depth = "--hardness 9GPa --frame-compliance 1e-7";
    for (kind, ends, known, used) in [
        ("stiffness-radius", ["50nm", "400nm"], "", ""),
        ("stiffness-load", ["0.1mN", "5mN"], of_depth, of_depth),
        (
            "stiffness-depth",
            ["60nm", "250nm"],
            of_depth,
            "--frame-compliance 1e-7",
        ),
    ] {
        let ends = format!("--from {} --to {}", ends[0], ends[1]);
        let plan = format!("simulate --kind {kind} --noise 0.5% --seed 1");
        let lossy = "--loss-tangent 0.6 -o lossy.csv";
        workdir.succeed(format!("{plan} {ends} {} {known} {lossy}", bodies("70GPa")));
        let args = format!("fit lossy.csv --kind {kind} --json");
        let json = workdir.json(format!("{args} {} {used}", bodies("50GPa")));
        let near = |found: &Value, key: &str, truth: f64| {
            let [value, error] = [key, "stderr"].map(|key| number(found, key));
            assert_near(value, truth, 4.0 * error);
            assert!(error < 0.02 * truth, "{kind}: {found}");
        };
        near(&json["parameters"]["film_modulus"], "value", 70e9);
        near(&json["loss"], "tangent", 0.6);
        if kind == "stiffness-radius" {
            assert_near(number(&json, "a_over_t/0"), 0.1, 1e-9);
            assert_near(number(&json, "a_over_t/1"), 0.8, 1e-9);
        }
    }
    let plan = format!("simulate --from 50nm --to 400nm {}", bodies("70GPa"));
    workdir.refuses(format!(
        "
        1 | {plan} --kind stiffness-radius --noise 1% --loss-tangent 1.2 | loss tangent; from 0 to 1
        1 | {plan} --kind stiffness-radius --noise 1% --loss-tangent nan | loss tangent; from 0 to 1
        1 | {plan} --kind load-radius --noise 1uN --loss-tangent 0.5 | --loss-tangent; contact stiffness
        "
    ));
}

/// A film, and a film of the material of its substrate, so thick that it is a bare reference.
#[test]
fn a_reference_has_the_poisson_ratio_of_the_substrate() {
    let workdir = workdir!();
    let depth = "--kind stiffness-depth";
    let plan = "simulate --from 40nm --to 220nm --noise 0.01% --hardness 10GPa --tip-rounding 6nm";
    workdir.succeed(with(plan, &format!("{depth} -o film.csv")));
    let bare = with(plan, depth)
        .replace("72GPa", "170GPa")
        .replace("0.17", "0.28")
        .replace("500nm", "1mm");
    workdir.succeed(format!("{bare} --seed 2 -o bare.csv"));
    let found = |more: &str| {
        let free = "--free film-modulus,tip-rounding --json";
        let fit = with("fit film.csv --reference bare.csv", depth);
        workdir.found(format!("{fit} {free} {more}"))
    };
    let given = "--reference-modulus 170GPa --reference-poisson-ratio 0.28";
    assert_eq!(found(""), found(given));
    assert_ne!(found(""), found("--reference-poisson-ratio 0.4"));
    // What is known of the substrate is not known of a reference of another material.
    let other = "--reference-modulus 150GPa";
    let estimate =
        |more: &str, what: &str| number(&found(more), &format!("parameters/film_modulus/{what}"));
    let [plain, known, both] = [
        other.to_owned(),
        format!("{other} --known substrate-modulus=170GPa+-5GPa"),
        format!("{other} --known substrate-modulus=+-3% --known reference-modulus=+-4GPa"),
    ];
    for more in [&known, &both] {
        assert_eq!(estimate(more, "value"), estimate(&plain, "value"));
        assert!(estimate(more, "stderr") > 1.5 * estimate(&plain, "stderr"));
    }
    let rows = found(&plain)["fixed_values"].to_string();
    assert_names(&rows, "\"reference_modulus\"; 150000000000");
    let fit = with("fit film.csv", depth) + " --free film-modulus,tip-rounding";
    workdir.refuses(format!(
        "
        1 | {fit} --known reference-modulus=72GPa+-1GPa | reference-modulus; check its name
        1 | {fit} --reference bare.csv --known reference-modulus=+-3% | left out; substrate
        1 | {fit} --reference bare.csv {other} --known reference-modulus=72GPa+-1GPa | two values
        "
    ));
}
