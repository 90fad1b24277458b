//! `tabulate curve`

use acceptance::{
    Data, assert_cases, assert_close, assert_names, looked_up, number, paper_system, value, workdir,
};
use contact::{Contact, Control, JkrPoint, Validity};
use interp::{Mechanics, Probe, System, Table};
use solve::cohesive::Cohesive;
use tabulate::large_contact::LARGE_CONTACT;

use crate::{paper_table, solved};

/// Returns load and penetration by a solve to the default tolerance of a curve.
fn solved_state(system: &System, a: f64, w: f64) -> (f64, f64) {
    let mechanics = Mechanics::new(system).expect("physical");
    let material = system.material().expect("physical");
    let edge = mechanics.edge_singularity(a, w).expect("physical");
    let quantities = solved(a / system.film_thickness, &material, 1e-8).quantities;
    mechanics.load_and_penetration(a, edge, &quantities)
}

#[test]
fn curve_is_the_papers_by_default_and_the_same_from_the_table() {
    let workdir = workdir!();
    let table_path = paper_table();
    let [direct, looked_up] = ["", &table_path].map(|table| workdir.csv(format!("curve {table}")));
    let columns = "contact_radius load penetration jkr_abscissa jkr_ordinate contact_stiffness moving_stiffness";
    assert_eq!(direct.columns().join(" "), columns);
    assert_eq!(direct.columns(), looked_up.columns());
    assert_eq!(direct.cases().count(), 150);

    let (system, w) = (paper_system(1e-6), 0.04);
    let table = Table::read(&table_path).expect("a sound table");
    let contact = Contact::in_table(&table, &system).expect("the table is the paper's");
    for (i, (direct, looked_up)) in direct.cases().zip(looked_up.cases()).enumerate() {
        let a = direct.get("contact_radius");
        assert_eq!(a, looked_up.get("contact_radius"));
        assert!((a / (1e-6 * (i + 1) as f64) - 1.0).abs() <= 1e-12, "{a}");
        let expected = solved_state(&system, a, w);
        assert_eq!((direct.get("load"), direct.get("penetration")), expected);
        let from_table = contact.load_and_penetration(a, w).expect("inside");
        assert_eq!(looked_up.get("load"), from_table.0);
        assert_eq!(looked_up.get("penetration"), from_table.1);
        for (case, load) in [(&direct, expected.0), (&looked_up, from_table.0)] {
            let jkr = JkrPoint::new(a, load, 1e-3);
            assert_eq!(case.get("jkr_abscissa"), jkr.abscissa);
            assert_eq!(case.get("jkr_ordinate"), jkr.ordinate);
        }
    }
}

#[test]
fn a_radius_that_is_not_below_the_spheres_is_an_error_before_any_work() {
    let workdir = workdir!();
    for to in ["1", "1e-3", "1e308"] {
        for table in ["", "embedded"] {
            let message = workdir.fail(1, format!("curve --to {to} {table}"));
            let value = format!("{:?} m", to.parse::<f64>().expect("a number"));
            assert_names(&message, &[&value, "below", "R = 0.001 m", "unit"]);
            assert_eq!(message.lines().count(), 1, "{message}");
        }
    }
}

#[test]
fn a_radius_that_is_not_small_beside_the_spheres_is_warned_of_once() {
    let workdir = workdir!();
    let limit = Validity::WARNING_A_OVER_R * 1e-3;
    for (to, warned) in [
        (limit, None),
        (limit.next_up(), Some("0.300 R")),
        (0.999e-3, Some("0.999 R")),
    ] {
        let paper = "curve embedded --specimen paper";
        let run = workdir.answer(format!("{paper} --to {to}"));
        let times = run.stderr.matches(LARGE_CONTACT).count();
        assert_eq!(times, usize::from(warned.is_some()), "{run:?}");
        if let Some(part) = warned {
            assert_names(&run.stderr, &[LARGE_CONTACT, part, "--probe sphere"]);
        }
        assert_eq!(Data::parse("curve", &run.stdout).cases().count(), 150);
    }
}

/// Between rigid bodies the compression is the whole penetration.
#[test]
fn a_film_that_is_compressed_too_much_is_told_of() {
    let workdir = workdir!();
    let bodies = "--specimen paper --film-thickness 300nm --film-modulus 5kPa --film-poisson-ratio 0.3 \
                  --sphere-radius 2.5um --sphere-modulus inf --substrate-modulus inf";
    for options in [
        "--work-of-adhesion 0J/m^2",
        "--work-of-adhesion 1uJ/m^2",
        "embedded --work-of-adhesion 1uJ/m^2",
    ] {
        let call = format!("curve {options} {bodies} --from 0.1um --points 2");
        for (to, told) in [("0.34um", false), ("0.7um", true)] {
            let run = workdir.answer(format!("{call} --to {to}"));
            assert_eq!(run.stderr.contains("compress"), told, "{run:?}");
        }
        let without = workdir.run(format!("{call} --to 0.7um").replace("1uJ", "0J"));
        let rows = Data::parse("curve", &without.stdout);
        let percent = 1e2 * rows.last().get("penetration") / 3e-7;
        let run = workdir.run(format!("{call} --to 0.7um"));
        assert_names(&run.stderr, &[&format!("the film by {percent:.0} %")]);
    }
}

#[test]
fn a_steep_probe_is_told_of() {
    let workdir = workdir!();
    let cone = "curve embedded --specimen paper --probe cone --points 2 --to 1e-7 --half-angle";
    let [blunt, steep] = ["50", "20"].map(|half_angle| {
        let run = workdir.answer(format!("{cone} {half_angle}"));
        run.stderr
    });
    assert!(!blunt.contains("slope"), "{blunt}");
    assert_names(&steep, "the slope is 2.75; from the axis");
}

/// The radii that are not given begin at a flat end, and end where an attraction of a long range is solved.
#[test]
fn default_radii_are_answered() {
    let workdir = workdir!();
    workdir.write("flat.csv", "r [um],z [um]\n0,0\n1,0\n2,0\n3,1\n4,3\n5,6\n");
    workdir.write("edge.csv", "r [um],z [um]\n0,0\n0.98,0\n0.99,0\n1,0.02\n");
    for (flags, from) in [
        (
            "--probe flat-ended-cone --half-angle 80 --sphere-radius 3um",
            3e-6,
        ),
        ("--probe profile --profile flat.csv", 1.5e-6),
        ("--probe profile --profile edge.csv", 9.85e-7),
        ("--interaction-range 1um", 6.8e-7),
        // Where solves begin, above a hundredth of the largest.
        (
            "--sphere-radius 10nm --film-thickness 100um --sphere-modulus inf",
            1e-10,
        ),
        ("--interaction-range 5um", 8e-8),
    ] {
        let run = workdir.answer(format!("curve --specimen paper --points 3 {flags}"));
        let rows = Data::parse("curve", &run.stdout);
        assert_close(rows.first().get("contact_radius"), from, 1e-2);
    }
}

#[test]
fn curve_and_pull_off_take_the_range_of_the_attraction() {
    let workdir = workdir!();
    let sphere = "--sphere-radius 1e-4";
    let system = System {
        probe: Probe::Paraboloid { radius: 1e-4 },
        ..paper_system(1e-6)
    };
    let cohesive = Cohesive::new(&system, None, 0.04, 2e-7).expect("physical");
    let ranged = format!("{sphere} --interaction-range 2e-7");
    let radii = "--from 4e-6 --to 8e-6 --points 3";
    let rows = workdir.csv(format!("curve {ranged} {radii}"));
    assert_eq!(rows.columns()[5], "outer_radius");
    for case in rows.cases() {
        let state = cohesive.state(case.get("contact_radius"));
        let state = state.expect("a contact");
        assert_eq!(case.get("load"), state.load);
        assert_eq!(case.get("penetration"), state.penetration);
        assert_eq!(case.get("outer_radius"), state.outer_radius);
    }

    let spring = Control::Spring { stiffness: 40.0 };
    let controls = [
        ("", Control::Load),
        ("--control displacement", Control::Displacement),
        ("--control spring --stiffness 40", spring),
    ];
    let table = looked_up(&system);
    for (flags, control) in controls {
        let state = cohesive.pull_off(control).expect("a pull-off");
        let object = workdir.json(format!("pull-off {ranged} {flags} --json"));
        for (name, value) in [
            ("load", state.load),
            ("contact_radius", state.contact_radius),
            ("outer_radius", state.outer_radius),
            ("penetration", state.penetration),
        ] {
            // The reader of JSON may miss the last bit.
            assert_close(number(&object, name), value, 1e-15);
        }
        let jkr = table.pull_off(0.04, control).expect("a pull-off");
        let text = workdir.succeed(format!("pull-off embedded {sphere} {flags}"));
        assert_names(&text, &format!("load           = {:?}\n", jkr.load));
        // Without a table the system is solved.
        let text = workdir.succeed(format!("pull-off {sphere} {flags}"));
        assert_close(value(&text, "load"), jkr.load, 1e-5);
    }
    workdir.refuses(
        "
        1 | curve --interaction-range nan | interaction range; NaN
        ",
    );
    workdir.fail(2, "pull-off --control spring");
    workdir.fail(2, "pull-off embedded --interaction-range 1e-9");
}

/// The rows of a cone on a half-space are those of Sneddon, and flags that do not belong together
/// are errors that name the flag.
#[test]
fn the_shape_of_the_probe_is_chosen() {
    let dir = workdir!();
    let homogeneous = "curve --film-modulus=1e6 --film-poisson-ratio=0.25 --substrate-modulus=1e6 \
         --substrate-poisson-ratio=0.25 --sphere-modulus=inf --work-of-adhesion=0 --from=1e-6 \
         --to=4e-6 --points=4";
    let modulus = 1e6 / (1.0 - 0.0625);
    let slope = 70_f64.to_radians().tan().recip();
    for (half_angle, table) in [
        ("70", ""),
        ("70deg", "embedded"),
        ("1.2217304763960306rad", ""),
    ] {
        let cone = format!("--probe=cone --half-angle={half_angle}");
        for row in dir.csv(format!("{homogeneous} {cone} {table}")).cases() {
            let a = row.get("contact_radius");
            let penetration = 0.5 * std::f64::consts::PI * slope * a;
            assert_close(row.get("load"), modulus * a * penetration, 3e-7);
            assert_close(row.get("penetration"), penetration, 3e-7);
        }
    }
    dir.write("tip.csv", "r [um],z [nm]\n0,0\n1,100\n2,150\n");
    dir.refuses(format!(
        "
        1 | {homogeneous} --probe=cone | --half-angle
        1 | {homogeneous} --half-angle=70 | --half-angle; paraboloid
        1 | {homogeneous} --probe=cone --half-angle=90 | 90; degrees
        1 | {homogeneous} --probe=power-law --exponent=3 | --coefficient
        1 | {homogeneous} --probe=profile --profile tip.csv | line 4; convex
        "
    ));
}

/// Without a range the contacts of a small sphere end where the model does.
#[test]
fn the_usual_radii_fit_the_sphere() {
    let workdir = workdir!();
    let radii = |arguments: &str| {
        let data = workdir.csv(format!("curve --points=3 {arguments}"));
        let radii = data.column("contact_radius");
        [radii[0], radii[2]]
    };
    assert_eq!(radii("--specimen=paper"), [1e-6, 1.5e-4]);
    let [from, to] = radii("--specimen=paper --sphere-radius=10um");
    assert_close(to, 3e-6, 1e-14);
    assert_close(from, 2e-8, 1e-14);
    let given = "--specimen=paper --sphere-radius=10um --to=2um";
    assert_eq!(radii(given), [1e-6, 2e-6]);
    // A film that slides is solved up to a thousand times its thickness.
    let [_, to] = radii("--specimen=paper --film-thickness=0.1um --interface=sliding");
    assert_close(to, 1e-4, 1e-14);
}

/// Notes on films so much stiffer than their substrate that they bend as plates.
#[test]
fn a_stiff_film_that_bends_is_told_of() {
    let workdir = workdir!();
    let bodies = "--sphere-modulus inf --film-thickness 1um --film-modulus 1GPa --film-poisson-ratio .3 \
                  --substrate-poisson-ratio .3 --points 2 --work-of-adhesion";
    let cases = "
        0 --probe cone --half-angle 89 --substrate-modulus 1MPa --from 0.1um --to 1um | without adhesion may be no disc; 5.5
        1uJ/m^2 --probe cone --half-angle 89 --substrate-modulus 1MPa --from 0.1um --to 1um | presses on may be no disc; 5.5
        10mJ/m^2 --probe cone --half-angle 89.5 --substrate-modulus 1MPa --from 0.1um --to 1um | none
        0 --probe cone --half-angle 89 --substrate-modulus 20MPa --from 0.1um --to 1um | none
        0 --probe flat-punch --sphere-radius 2um --substrate-modulus 10MPa | 2.00e-6 m; may be no disc
        1uJ/m^2 --probe flat-punch --sphere-radius 2um --substrate-modulus 10MPa | none
        0 --sphere-radius 10um --substrate-modulus 1MPa --from 1um --to 2.9um | of its thickness; stretched
        ";
    assert_cases(cases, |[more, _]| {
        let notes = workdir.answer(format!("curve {bodies} {more}")).stderr;
        let told = notes.contains("no disc") || notes.contains("stretched");
        if told { notes } else { "none".into() }
    });
}
