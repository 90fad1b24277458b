//! `tabulate simulate`

use acceptance::{Data, assert_names, kinds, shipped, workdir};

/// The lens of the documentation: radii and loads, on a film of 10 um.
const LENS: &str = "simulate --kind load-radius --film-thickness 1e-5 --from 4.2e-5 --to 1.3e-4";

/// Contact stiffness on the same film.
const STIFFNESS: &str = "simulate --specimen paper --kind stiffness-radius --to 1e-4 --noise 1%";

#[test]
fn a_cycle_goes_there_and_back() {
    let workdir = workdir!();
    let cycle = "--kind force-height --sphere-radius 1e-5 --sphere-modulus inf \
         --film-modulus 5e3 --film-thickness 2e-5 --work-of-adhesion 1e-4 --stiffness 0.1 \
         --from 1e-6 --to -1e-6 --points 5 --noise 0 --value baseline=1e-9";
    let text = workdir.simulate(cycle);
    let version = env!("CARGO_PKG_VERSION");
    let head = format!(
        "# Synthetic, not measured, by tabulate {version}. SI units.\n# tabulate simulate --kind "
    );
    assert!(text.starts_with(&head), "{text}");
    let data = Data::parse("cycle", &text);
    assert_eq!(data.columns().join(","), "height,load,segment");
    let column = |name| -> Vec<&str> { data.cases().map(|row| row.text(name)).collect() };
    let heights = "1e-6 5e-7 0.0 -5e-7 -1e-6 -1e-6 -5e-7 0.0 5e-7 1e-6";
    assert_eq!(column("height").join(" "), heights);
    assert_eq!(column("segment")[4..6], ["approach", "retract"]);
    // The baseline.
    assert_eq!([0, 9].map(|i| column("load")[i]), ["1e-9"; 2]);
    for (ways, points) in [("approach", 5), ("retract", 5), ("none", 5), ("cycle", 10)] {
        let text = workdir.simulate(format!("{cycle} --segments {ways}"));
        assert_eq!(text.lines().count(), 3 + points, "{ways}");
        assert_eq!(text.contains("segment\n"), ways != "none");
    }
}

/// A plan whose contacts leave the assumptions of the model is told so, with and without --expect.
#[test]
fn a_plan_outside_the_model_is_warned_of() {
    let workdir = workdir!();
    let wide = "simulate --kind load-radius --specimen paper --film-thickness 100um --film-modulus 200kPa --from 40um --to 400um --noise 5uN";
    let words = "a/R reaches 0.40, above 0.3; the film is compressed by up to ";
    assert_names(&workdir.answer(wide).stderr, words);
    assert_names(&workdir.succeed(format!("{wide} --expect")), words);
    let object = workdir.json(format!("{wide} --expect --json"));
    let expected = [
        "calibration",
        "calibration",
        "large-contact",
        "large-strain",
    ];
    assert_eq!(kinds(&object), expected);
    let narrow = format!("{LENS} --specimen paper --noise 5uN");
    assert_eq!(workdir.run(&*narrow).stderr, "");
    let object = workdir.json(format!("{narrow} --expect --json"));
    for empty in ["warnings", "undetermined"] {
        assert_eq!(object[empty].as_array().map(Vec::len), Some(0));
    }
}

/// Wide contacts tell neither modulus nor thickness of a film: no combination of them.
#[test]
fn what_a_plan_does_not_determine_is_named_once() {
    let workdir = workdir!();
    let plan = "simulate --specimen paper --kind load-radius --from 100um --to 130um --noise 5uN --points 20 \
                --free film-modulus,film-thickness,work-of-adhesion --expect";
    let both = "film-modulus and film-thickness";
    let text = workdir.succeed(plan);
    assert_eq!(text.matches(both).count(), 1, "{text}");
    let object = workdir.json(format!("{plan} --json"));
    assert_eq!(object["undetermined"], serde_json::json!([both]));
}

/// The first lines of a measurement hold the command.
#[test]
fn a_name_that_is_no_text_is_written_all_the_same() {
    let workdir = workdir!();
    let run = workdir.script(&format!(
        "\"$0\" {LENS} --noise 0 -o \"$(printf 'a\\377\\nb.csv')\" && cat *.csv"
    ));
    assert_eq!(run.status, 0, "{run:?}");
    let mut lines = run.stdout.lines().skip_while(|line| line.starts_with('#'));
    assert_eq!(lines.next(), Some("contact_radius,load"));
    // A shell reads the command back.
    let run = workdir.script(&format!(
        "\"$0\" {LENS} --noise 0 -o \"d b'c.csv\" && sed -n 's/^# tabulate //p' \"d b'c.csv\""
    ));
    assert!(run.stdout.ends_with("-o 'd b'\\''c.csv'\n"), "{run:?}");
}

#[test]
fn what_cannot_be_simulated_is_an_error() {
    let workdir = workdir!();
    workdir.refuses(format!(
        "
        2 | {LENS} | --noise
        1 | {LENS} --noise -1 | noise; -1
        1 | {LENS} --noise nan | noise; NaN
        1 | {LENS} --noise 1e-6 --radius-noise -1nm | contact radius; >= 0
        1 | {LENS} --noise 1e-6 --radius-noise 1nN | --abscissa-noise; a force, and a length is wanted
        1 | {LENS} --noise 1e-6 --radius-noise 1mm | noise of the contact radius; 0.001; negative
        1 | {LENS} --noise 1e-6 --free film-modulus | --expect
        2 | {LENS} --noise 1e-6 --json | --expect
        2 | {LENS} --noise 1e-6 --value offset=1 | offset; load-offset
        1 | {LENS} --noise 1e-6 --value load-offset=1,2 | load-offset; 2 values for 1 files
        1 | {STIFFNESS} --from 1e-5 --segments cycle | --segments approach
        1 | {STIFFNESS} --from 0 | contact radius; 0.0; above 0
        1 | {LENS} --noise 1e-6 --expect --table {} --free film-poisson-ratio | derivatives; range of each
        ",
        shipped("paper.h5").display()
    ));
    let same = LENS.replace("--to 1.3e-4", "--to 4.2e-5");
    workdir.refuses(format!("1 | {same} --noise 0 | --from; --to; different"));
}
