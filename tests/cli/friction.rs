//! Full friction on the command line: the numbers of `solve`, the histories of `curve` and
//! `pull-off`, fits with both ends of friction, and what is refused.

use acceptance::{
    Data, assert_close, assert_estimate, assert_names, assert_near, json, number, value, workdir,
};

/// A rigid sphere on an incompressible film on a rigid base.
const CONFINED: &str = "--e1-over-e2 0 --nu1 0.5 --e0-over-e2 inf";

/// Values by another program.
#[test]
fn solve_prints_the_numbers_of_stick() {
    let workdir = workdir!();
    let text = workdir.succeed(format!("solve --a-over-t 1 {CONFINED} --friction stick"));
    for (name, expected) in [
        ("eeq", 3.618_735_848_959_764),
        ("eeq_s", 3.929_038_326_620_685),
        ("gamma_s", 2.901_639_280_012_123),
        ("gamma_t", 0.853_450_270_007_150_2),
        ("gamma_eff", 3.024_547_548_755_772),
        ("delta_s", 0.552_037_734_017_965_9),
        ("pi_s", 3.865_885_592_600_632),
        ("gamma_g", 2.807_011_460_489_805),
        ("eeq_g", 3.710_946_460_318_432),
    ] {
        assert_close(value(&text, name), expected, 1e-10);
    }
    assert!(value(&text, "error_s") <= 1e-9, "{text}");

    // A compressible film: the punch alone, and a note that says why.
    let run = workdir.run(
        "solve --a-over-t 1 --e1-over-e2 0 --nu1 0.3 --e0-over-e2 inf --friction stick --json",
    );
    let object = json(&run.stdout);
    assert_close(number(&object, "eeq_s"), 2.508_531_756_798_989, 1e-10);
    for name in ["gamma_s", "gamma_t", "delta_s", "pi_s", "gamma_g", "eeq_g"] {
        assert!(object[name].is_null(), "{name}: {object}");
    }
    assert_names(&run.stderr, "beta = 0.2857; artanh(beta)/beta = 1.0286");

    // The Poisson ratio of the sphere, and points of a file with empty cells.
    let of_sphere = |nu2: &str| {
        let run = workdir.run(format!(
            "solve --a-over-t 0.5 --e1-over-e2 2 --nu1 0.3 --e0-over-e2 inf --friction stick \
             --nu2 {nu2}"
        ));
        value(&run.stdout, "eeq_s")
    };
    assert_close(of_sphere("0.4"), 0.781_982_900_326_427_8, 1e-10);
    assert!((of_sphere("0.4") - of_sphere("0.5")).abs() > 1e-6);
    workdir.write_points("1,0,0.5,inf\n1,0,0.3,inf\n");
    let text = workdir.succeed("solve --points points.csv --friction stick");
    let lines: Vec<&str> = text.lines().collect();
    let columns = "eeq_s,gamma_s,gamma_t,gamma_eff,delta_s,pi_s,gamma_g,eeq_g,error_s";
    assert!(lines[0].ends_with(columns), "{text}");
    assert_eq!(lines[2].matches(",,").count(), 3, "{text}");
    // Errors above 1e-10 are taken up to 1e-6, unless a tolerance is given.
    let soft = "solve --a-over-t 200 --nu1 0 --e0-over-e2 1e-15 --friction stick --e1-over-e2";
    let error = value(&workdir.run(format!("{soft} 1e6")).stdout, "error_s");
    assert!((2e-10..1e-6).contains(&error), "{error}");
    workdir.refuses(format!(
        "1 | {soft} 1e7 | 1.0e-10; not reached
         1 | {soft} 1e6 --tolerance 1e-10 | 1.0e-10; not reached"
    ));
    // Without the flag nothing is added.
    let text = workdir.succeed(format!("solve --a-over-t 1 {CONFINED}"));
    assert!(!text.contains("eeq_s"), "{text}");
}

/// A gel of 1 mm on glass under a rigid sphere of 1 m, with `w R^2/(E1* t^3) = 1` and 10.
const GEL: &str = "--specimen paper --sphere-modulus inf --film-modulus 7.5e5 --film-thickness 1e-4 \
     --sphere-radius 1e-2 --substrate-modulus inf --allow magnitudes";

/// Pull-off loads over `pi w R` by another program: one work of adhesion, and pressed on without
/// attraction.
#[test]
fn pull_offs_of_the_histories_are_those_of_another_program() {
    let workdir = workdir!();
    for (work, of_one, of_pressed) in [("0.01", -1.8946, -1.8464), ("0.1", -1.8938, -2.0597)] {
        let unit = std::f64::consts::PI * work.parse::<f64>().expect("a number") * 1e-2;
        let load = |history: &str| {
            let arguments = format!("pull-off --friction stick {GEL} {history}");
            value(&workdir.succeed(&arguments), "load") / unit
        };
        assert_near(load(&format!("--work-of-adhesion {work}")), of_one, 1e-4);
        let pressed = format!("--work-of-adhesion 0 --work-of-adhesion-receding {work}");
        assert_near(load(&pressed), of_pressed, 1e-4);
    }
}

#[test]
fn a_force_curve_has_the_loads_of_stick() {
    let workdir = workdir!();
    let load = |friction: &str| {
        let run = workdir.answer(format!(
            "curve --friction {friction} --work-of-adhesion 0 {GEL} --from 1e-4 --to 2e-4 --points 2"
        ));
        Data::parse("curve", &run.stdout).last().get("load")
    };
    // F = a^3 E1* Pi/(2R), Pi_s = 8.34472784 and Pi0 = 6.92832246 at a/t = 2.
    let expected = 8.344_727_841_540_863 / 6.928_322_464_6;
    assert_near(load("stick") / load("none"), expected, 1e-6);
}

/// The stiffness of flat punches, with friction over without, by another program: 1.086 at
/// `a/t = 1` and 1.366 at 2. Contacts that are narrow beside the film, or stick, have no note.
#[test]
fn a_contact_without_friction_tells_the_size_of_friction() {
    let workdir = workdir!();
    let notes = |command: &str| {
        let on_silicon = GEL.replace("--substrate-modulus inf ", "");
        workdir.answer(format!("{command} {on_silicon}")).stderr
    };
    let curve = |to: &str, friction: &str| {
        let radii = format!("curve --from 1e-5 --to {to} --points 2");
        notes(&format!("{radii} --friction {friction}"))
    };
    assert_names(&curve("1e-4", "none"), "full friction; by 9 %");
    assert_names(&curve("2e-4", "none"), "full friction; by 37 %");
    assert_eq!(curve("3e-5", "none"), "");
    assert_eq!(curve("2e-4", "stick"), "");
    let pull_off = "pull-off --work-of-adhesion 0.1";
    assert_names(&notes(pull_off), &["full friction", "flat punch"]);
    assert_eq!(notes(&format!("{pull_off} --friction stick")), "");
}

#[test]
fn what_is_not_solved_is_refused_with_the_reason() {
    let workdir = workdir!();
    let stick = "--friction stick --specimen paper";
    const SIMULATE: &str = "simulate --kind load-radius --from 5um --to 9um --noise 2uN";
    let data = "contact_radius,load\n5e-6,1e-7\n6e-6,2e-7\n7e-6,3e-7\n8e-6,4e-7\n";
    workdir.write("data.csv", data);
    for command in ["curve", "pull-off", SIMULATE, "fit data.csv"] {
        workdir.refuses(format!(
            "
            1 | {command} {stick} --film-poisson-ratio 0.49 | Dundurs' beta; nu1 = 0.49; artanh(beta)/beta
            1 | {command} {stick} --work-of-adhesion-receding 10mJ/m^2 | --work-of-adhesion-receding; less than; exchange the two
            "
        ));
    }
    for command in [SIMULATE, "fit data.csv"] {
        workdir.refuses(format!(
            "1 | {command} {stick} --film-thickness 0.2um | 30 times; 6.0000e-6 m; leave out wider contacts"
        ));
    }
    for command in ["curve", "pull-off"] {
        workdir.refuses(format!(
            "
            1 | {command} {stick} --interaction-range 1nm | without a range; --interaction-range
            1 | {command} {stick} --probe sphere --film-thickness 1mm | --probe paraboloid; eeq_s
            1 | {command} --specimen paper --work-of-adhesion-receding 0.1 | --work-of-adhesion-receding goes with --friction stick
            "
        ));
    }
    workdir.refuses(format!(
        "
        2 | solve --a-over-t 1 --friction some | some; none; stick
        1 | solve --a-over-t 1 --nu2 0.6 {CONFINED} --friction stick | nu2; 0.6
        1 | curve --specimen paper --film-thickness 1um --friction stick --to 31um | 3.1e-5 m; 30 times; --to 2.9999999999999997e-5 or less
        1 | pull-off --specimen paper --film-thickness 0.3um --friction stick | 9.000e-6 m; without --friction stick
        "
    ));
    // Without --to a curve ends where contacts that stick are solved.
    let curve =
        workdir.csv("curve --specimen paper --film-thickness 1um --friction stick --points 2");
    let last = curve.last().get("contact_radius");
    assert!(
        [3e-5, 2.999_999_999_999_999_7e-5].contains(&last),
        "{last:e}"
    );
}

/// A thin gel, simulated with stick, is read with both ends of friction: the modulus is found with
/// stick, and without it is too high by what the warning says.
#[test]
fn a_fit_without_friction_is_warned_and_one_with_stick_finds_the_modulus() {
    let workdir = workdir!();
    let bodies = "--specimen paper --sphere-radius 10um --sphere-modulus inf --film-thickness 2um \
         --film-modulus 5kPa --substrate-modulus inf --work-of-adhesion 0";
    workdir.simulate(format!(
        "--kind load-radius --friction stick --from 1um --to 5um --points 30 \
             --noise 20pN -o gel.csv {bodies}"
    ));
    let fit = |friction: &str| {
        let fit = format!("fit gel.csv --json --free film-modulus --friction {friction}");
        let object = json(&workdir.run(format!("{fit} {bodies}")).stdout);
        let warnings = object["warnings"].as_array().expect("a list");
        let warning = warnings.iter().find(|one| one["kind"] == "friction");
        let text = warning.expect("a warning of friction")["text"].to_string();
        (number(&object, "parameters/film_modulus/value"), text)
    };
    let (with, text) = fit("stick");
    assert_close(with, 5e3, 0.01);
    assert_names(&text, "(stick); (no friction)");
    let (without, _) = fit("none");
    assert!(without > 1.1 * with, "{without}, {with}");
}

/// Contacts at depths are fitted as far as they are solved, to 30 times the thickness of the film.
#[test]
fn depths_of_wide_contacts_that_stick_are_fitted() {
    let workdir = workdir!();
    let bodies = "--specimen paper --sphere-radius 100um --sphere-modulus inf --film-thickness 0.5um \
         --film-modulus 20kPa --substrate-modulus inf --work-of-adhesion 0 --friction stick";
    // sqrt(2 R delta) = 5.5 um is 11 times the thickness, as on any thin film that keeps its volume.
    workdir.simulate(format!(
        "--kind load-penetration --segments approach --from -0.02um --to 0.12um --points 20 --noise 1nN \
             -o wide.csv {bodies}"
    ));
    let run = workdir.run(format!(
        "fit wide.csv --json --free film-modulus,contact-point {bodies}"
    ));
    assert_estimate(&json(&run.stdout), "film_modulus", 2e4, 0.01 * 2e4);
}

/// A contact that was pressed on without attraction and recedes: the fit finds what the data were made
/// with, and points of approach are refused.
#[test]
fn fits_of_the_retract_take_a_work_of_adhesion_of_its_own() {
    let workdir = workdir!();
    let works = "--work-of-adhesion 0 --work-of-adhesion-receding";
    let run = |command: &str, receding: &str, more: &str| {
        let stick = "--friction stick";
        workdir.run(format!("{command} {GEL} {stick} {works} {receding} {more}"))
    };
    let plan = "simulate --kind load-radius --from 1e-4 --to 3e-4 --noise 1uN";
    let made = run(plan, "0.01", "--segments retract -o retract.csv");
    assert_eq!(made.status, 0, "{}", made.stderr);
    let free = "--free work-of-adhesion,film-modulus --json";
    let fitted = run("fit retract.csv", "0.02", free);
    assert_eq!(fitted.status, 0, "{}", fitted.stderr);
    let object = json(&fitted.stdout);
    for (name, truth) in [("work_of_adhesion", 0.01), ("film_modulus", 7.5e5)] {
        assert_estimate(&object, name, truth, 0.01 * truth);
    }
    let read = run(
        "fit retract.csv",
        "0.02",
        "--free work-of-adhesion,film-modulus",
    );
    let names = [
        "friction",
        "stick; work-of-adhesion is that of the receding line",
        "0 times it that of the advancing line",
    ];
    assert_names(&read.stdout, &names);
    let both = run(
        "fit retract.csv",
        "0.02",
        "--free film-modulus,work-of-adhesion-receding",
    );
    assert_eq!(both.status, 1, "{}", both.stderr);
    let names = [
        "--free work-of-adhesion-receding",
        "free work-of-adhesion,",
        "--only retract",
    ];
    assert_names(&both.stderr, &names);
    // One work of adhesion describes these data with another modulus.
    let approach = run(plan, "0.01", "--segments approach");
    assert_ne!(approach.status, 0);
    assert_names(&approach.stderr, &["points of approach", "--only retract"]);
}

/// The Poisson ratio of the sphere has one meaning a command, under one name with an alias: without
/// friction nothing uses it but a fit of the sphere's modulus.
#[test]
fn the_poisson_ratio_of_the_sphere_has_one_meaning() {
    let workdir = workdir!();
    let bodies = "--specimen paper --film-thickness 30um";
    // Sphere and film of one material stick without coupling, so the ratio decides what is solved.
    let of_ratio = |command: &str, flag: &str, ratio: &str, more: &str| {
        let stick = format!("--friction stick {flag} {ratio}");
        workdir.run(format!("{command} {stick} {bodies} {more}"))
    };
    let range = "--from 10um --to 40um --points 3";
    const SIMULATE: &str = "simulate --kind load-radius --from 20um --to 60um --noise 2uN";
    for (command, more) in [("curve", range), ("pull-off", "")] {
        let named = of_ratio(command, "--sphere-poisson-ratio", "0.5", more);
        assert_eq!(named.status, 0, "{named:?}");
        assert_eq!(named.stdout, of_ratio(command, "--nu2", "0.5", more).stdout);
        let stick = format!("{command} --friction stick {bodies} {more} --sphere-poisson-ratio");
        workdir.refuses(format!(
            "
            1 | {stick} 0.3 | nu2 = 0.3; artanh(beta)/beta
            2 | {stick} 0.6 | 0.6; above -1 and up to 0.5
            "
        ));
    }
    let ratio = "--sphere-poisson-ratio 0.4";
    let words = "no effect; --friction stick";
    for command in ["curve", "pull-off", SIMULATE] {
        let call = format!("{command} {bodies} {ratio}");
        workdir.refuses(format!("1 | {call} | --sphere-poisson-ratio; {words}"));
    }
    let film = "solve --a-over-t 1 --nu2 0.4";
    workdir.refuses(format!("1 | {film} {CONFINED} | --nu2; {words}"));

    // A fit takes one ratio, for friction and for Young's modulus of the sphere.
    workdir.succeed(format!("{SIMULATE} --friction stick -o lens.csv {bodies}"));
    let free = "--free sphere-modulus,work-of-adhesion";
    let fit = format!("fit lens.csv {bodies} {free}");
    let stick = "--friction stick --nu2 0.5 --json";
    let json = workdir.json(format!("{fit} {stick}"));
    assert!(json["sphere_young_modulus"]["value"].is_f64(), "{json}");
    let twice = "--nu2 0.5 --sphere-poisson-ratio 0.4";
    let words = "--sphere-poisson-ratio; multiple times";
    workdir.refuses(format!("2 | {fit} {twice} | {words}"));
}
