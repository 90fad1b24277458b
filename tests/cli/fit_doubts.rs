//! Doubts and errors of `tabulate fit`: what it says, and what to type next.

use acceptance::{assert_names, json, kinds, number, workdir};
use serde_json::Value;

/// Loads at penetrations of a rigid sphere of 10 um on a hard half-space, of which 60 nm remain.
fn plastic() -> String {
    let hertz = |modulus: f64, x: f64| 4.0 / 3.0 * modulus * 1e-5_f64.sqrt() * x.max(0.0).powf(1.5);
    let most = hertz(8e10, 4e-8);
    let mut text = String::from("penetration,load,segment\n");
    for i in 0..60 {
        let x = 1e-7 * f64::from(i) / 59.0;
        text += &format!("{x:e},{:e},approach\n", most * (x / 1e-7).powf(1.5));
    }
    for i in (0..60).rev() {
        let x = 1e-7 * f64::from(i) / 59.0;
        text += &format!("{x:e},{:e},retract\n", hertz(8e10, x - 6e-8));
    }
    text
}

const HALF_SPACE: &str = "fit data.csv --half-space --sphere-radius 1e-5 --sphere-modulus inf --film-modulus 1e10 \
     --film-poisson-ratio 0.3 --work-of-adhesion 0.04";

#[test]
fn a_depth_that_remains_is_named_with_the_flags_that_help() {
    let workdir = workdir!();
    workdir.write("data.csv", plastic());
    let of_film = format!("{HALF_SPACE} --free film-modulus");
    let report = workdir.run(&of_film).stdout;
    let words =
        "plastically; m remains; hysteresis; --only retract; --free film-modulus,contact-point";
    assert_names(&report, words);
    let found = json(&workdir.run(format!("{of_film} --json")).stdout);
    let kinds = kinds(&found);
    for kind in ["hysteresis", "plasticity"] {
        assert!(kinds.contains(&kind), "{kinds:?}");
    }
}

/// Makes a JKR test of the paper's lens on a film of 30 um.
fn lens(workdir: &acceptance::Workdir) {
    workdir.succeed(
        "simulate --kind load-radius --from 4.2e-5 --to 1.3e-4 --noise 2e-6 --film-thickness \
         3e-5 --specimen paper -o data.csv",
    );
}

/// Data without adhesion tell an upper limit: it is asked for in one more step, and no number of another meaning is
/// shown.
#[test]
fn a_work_of_adhesion_that_ended_at_zero_is_0_with_an_upper_limit() {
    let workdir = workdir!();
    workdir.simulate(
        "--specimen paper --kind load-radius --from 40um --to 130um --noise 20uN --seed 6 --work-of-adhesion 0 \
         -o bare.csv",
    );
    let fit = "fit bare.csv --specimen paper --free sphere-modulus,work-of-adhesion";
    let report = workdir.run(fit).stdout;
    let words = "work-of-adhesion          0 J/m^2, without an error; stays 0; ended at 0; interval from the profile";
    assert_names(&report, words);
    assert!(!report.contains("not determined"), "{report}");
    let report = workdir.run(format!("{fit} --intervals 0.95")).stdout;
    let line = report.lines().find(|line| line.contains("0 (0 to"));
    let most = line.and_then(|line| line.split_once("0 (0 to ")?.1.split_once(" uJ/m^2)"));
    let most: f64 = most.expect("a limit").0.parse().expect("a number");
    // The noise of a load, 20 uN, is that of sqrt(6 pi w K a^3) with K = 2.7 MPa at a = 40 um and w = 0.1 uJ/m^2; the
    // modulus is free, too.
    assert!((1.0..30.0).contains(&most), "{most}");
    assert!(!report.contains("has no lower end"), "{report}");
}

#[test]
fn an_error_of_a_known_thickness_widens_the_errors() {
    let workdir = workdir!();
    lens(&workdir);
    let run = |more: &str| {
        let fit = "fit data.csv --json --film-thickness 3e-5 --specimen paper --noise 2e-6";
        workdir.json(format!("{fit} {more}"))
    };
    let known = "--known film-thickness=3e-5+-3e-6";
    let (plain, widened) = (run(""), run(known));
    let error = |found: &Value| number(found, "parameters/sphere_modulus/stderr");
    assert!(error(&widened) > 2.0 * error(&plain));
    let all = format!(
        "fit data.csv --film-thickness 3e-5 --specimen paper {known} --known load-offset=0+-2uN"
    );
    let words = "what the fixed values do; sphere-radius; +1 %; 0.5 -> 0.49; hold those of film-thickness +- 3 um; those of \
                 load-offset +- 2 uN";
    assert_names(&workdir.succeed(&all), words);
    let known = "fit data.csv --film-thickness 3e-5 --specimen paper --known";
    workdir.refuses(format!(
        "
        2 | {known} film-thickness=3e-5 | film-thickness=2e-6+-1e-7
        2 | {known} thickness=3e-5+-1e-6 | thickness; sphere-radius
        1 | {known} sphere-modulus=2e6+-1e4 | sphere-modulus; not free; prior
        1 | {known} stiffness=1+-0 | stiffness; positive
        1 | {known} film-modulus=3MPa+-1kPa --value film-modulus=3MPa | film-modulus; twice; film-modulus=+-3%
        1 | {known} film-thickness=+-3e-2 | known film-thickness; 0.03; at most its value
        1 | {known} film-thickness=+-300% | known film-thickness; at most its value
        1 | {known} height=+-1% | known height; not given; a quantity that is read
        1 | {known} layer-1.modulus=+-1% | known layer-1.modulus; not given; a value that the measurement has
        1 | {known} load=+-2 | known load; at most 1; 0.02 is 2 %
        1 | {known} load=1.02+-1% | load of data.csv = 1.02; left out: it is 1
        1 | {known} contact-radius-zero=+-1% | contact-radius-zero in m
        1 | {known} contact-radius-zero=1um+-1um | left out: it is 0; take it off the readings
        1 | {known} position-drift=+-1nm/s | known position-drift; not given; penetrations or heights that have times
        1 | {known} contact-radius-zero=+-1mm | known contact-radius-zero; 0.001; at most the largest contact radius
        2 | {known} load=+-1uN | is a force; a number without a unit
        2 | {known} half-angle=+-2 | \"2\"; is an angle without a unit; 2deg
        2 | {known} half-angle=+-2mm | is a length; an angle is wanted
        1 | {known} half-angle=+-2deg | known half-angle; not given; check its name and the bodies
        1 | {known} half-angle=71deg+-2deg --probe cone --half-angle 70 | --half-angle 70deg; half-angle=71deg; two values of one quantity
        2 | {known} force=+-1% | no value of a fit; contact-radius, penetration, height, load
        1 | fit data.csv --sphere-modulus 2MPa --free work-of-adhesion --known film-thickness=+-3% | --film-thickness is missing
        1 | fit data.csv --film-thickness 3e-5 --specimen paper --free work-of-adhesion,work-of-adhesion-receding | work-of-adhesion-receding; directions; --segments split
        "
    ));
}

/// Forces are the deflection times the stiffness where the head of the file names it. Of other forces nobody knows, and the
/// report says what the row of the stiffness leaves out.
#[test]
fn the_error_of_a_stiffness_is_that_of_the_forces_made_with_it() {
    let workdir = workdir!();
    let gel = "--specimen paper --sphere-radius 10um --sphere-modulus inf --film-thickness 20um";
    let made = workdir.simulate(format!(
        "{gel} --film-modulus 5kPa --work-of-adhesion 50uJ/m^2 --stiffness 0.1 --kind force-height --from 1um \
         --to -200nm --points 120 --noise 50pN"
    ));
    workdir.write("bare.csv", &made);
    workdir.write("head.csv", format!("# springConstant: 0.1\n{made}"));
    let free = "--free film-modulus,work-of-adhesion,contact-point,baseline";
    let fit = |file: &str| format!("fit {file} {gel} {free} --stiffness 0.1");
    let words =
        "stiffness leaves the loads as they were read; the rows of load and stiffness add up";
    assert_names(&workdir.succeed(fit("bare.csv")), words);
    // Separations hold the deflection.
    let rows = made.lines().filter(|line| !line.starts_with('#')).skip(1);
    let rows = rows.map(|row| {
        let mut cells = row.splitn(3, ',');
        let mut next = || cells.next().expect("three cells");
        let [height, load, segment] = [next(), next(), next()];
        let number = |cell: &str| cell.parse::<f64>().expect("a number");
        format!(
            "{:e},{load},{segment}\n",
            number(height) + number(load) / 0.1
        )
    });
    let rows: String = rows.collect();
    workdir.write(
        "apart.csv",
        format!("separation [m],force [N],segment\n{rows}"),
    );
    // The head may have another unit, and its rounding: 43e-3 as a number is not 43 times 1e-3.
    let made = made.replace("--stiffness 0.1", "");
    workdir.write("milli.csv", format!("# springConstant: 43 mN/m\n{made}"));
    let milli = fit("milli.csv").replace("--stiffness 0.1", "--stiffness 0.043");
    let reports = [fit("head.csv"), fit("apart.csv"), milli].map(|command| workdir.run(&*command));
    for report in reports.map(|answer| answer.stdout) {
        assert!(report.contains("what the fixed values do"), "{report}");
        assert!(!report.contains("add up"), "{report}");
    }
    for (file, range) in [
        ("bare.csv", 0.0..0.05),
        ("head.csv", 0.1..0.11),
        ("apart.csv", 0.1..0.11),
    ] {
        let found = workdir.json(format!("{} --known stiffness=+-10% --json", fit(file)));
        for name in ["film_modulus", "work_of_adhesion"] {
            let of = |what| number(&found, &format!("parameters/{name}/{what}"));
            let part = of("stderr") / of("value");
            assert!(range.contains(&part), "{file}, {name}: {part}");
        }
    }
    let free = "--free film-modulus,contact-point,baseline,stiffness";
    workdir.refuses(format!(
        "1 | fit head.csv {gel} {free} --work-of-adhesion 50uJ/m^2 | stiffness; the deflection times it; the head of the file; fix it"
    ));
}

/// One factor is off for the films of all files.
#[test]
fn values_of_several_files_err_in_proportion() {
    let workdir = workdir!();
    lens(&workdir);
    let fit = "fit data.csv data.csv --specimen paper --allow left-out --value film-thickness=30um,40um --known";
    let report = workdir.succeed(format!("{fit} film-thickness=+-5%"));
    assert_names(&report, "hold those of film-thickness +- 5 %: ");
    let zeros = "load-offset=+-1uN --value load-offset=0,1e-6 --known film-poisson-ratio=+-0.02";
    let report = workdir.succeed(format!("{fit} {zeros} --value film-poisson-ratio=0.4,0.45"));
    let words = "hold those of load-offset +- 1 uN: ; hold those of film-poisson-ratio +- 0.02: ";
    assert_names(&report, words);
    workdir.refuses(format!(
        "
        1 | {fit} film-thickness=+-1um | different values; film-thickness=+-3%
        1 | {fit} load-offset=+-3% --value load-offset=1e-6,2e-6 | load-offset; per cent; in N
        1 | {fit} film-poisson-ratio=+-3% | film-poisson-ratio; per cent; such as +-0.02
        "
    ));
}

/// A zero that is 0 in one file has a row where it is not in another.
#[test]
fn the_report_states_the_fixed_values_of_all_files() {
    let workdir = workdir!();
    lens(&workdir);
    let fit = "fit data.csv data.csv --specimen paper --free film-modulus";
    for (offsets, row) in [
        ("0,1e-4", "0, 100 uN"),
        ("1e-4,0", "100 uN, 0"),
        ("1e-4", "100 uN"),
    ] {
        let values = format!("--value film-thickness=30um,40um --value load-offset={offsets}");
        let run = workdir.run(format!("{fit} {values} --allow left-out"));
        let rows: Vec<&str> = run.stdout.lines().collect();
        let of = |name: &str| {
            let row = rows.iter().find_map(|row| row.trim().strip_prefix(name));
            row.unwrap_or_else(|| panic!("{name}: {run:?}")).trim()
        };
        let found = [of("film-thickness"), of("load-offset")];
        assert_eq!(found, ["30 um, 40 um", row]);
    }
}

#[test]
fn errors_of_radii_come_from_a_flag_or_a_column() {
    let workdir = workdir!();
    lens(&workdir);
    let text = workdir.text("data.csv");
    let with_column: String = text
        .lines()
        .map(|line| match line {
            comment if comment.starts_with('#') => format!("{comment}\n"),
            "contact_radius,load" => format!("{line},radius_error [um]\n"),
            row => format!("{row},0.3\n"),
        })
        .collect();
    workdir.write("column.csv", with_column);
    let run = |more: &str| {
        let fit = "fit --film-thickness 3e-5 --specimen paper --noise 2e-6";
        workdir.succeed(format!("{fit} {more}"))
    };
    let by_flag = run("data.csv --radius-noise 3e-7");
    let by_column = run("column.csv");
    assert_names(&by_flag, "of the abscissa 300 nm");
    let words = "of the abscissa 300 nm; contact_radius_error from \"radius_error [um]\"";
    assert_names(&by_column, words);
    let found = |text: &str| {
        let found = text.split("\nfound\n").nth(1).expect("found");
        found.replace("column.csv", "data.csv")
    };
    assert_eq!(found(&by_flag), found(&by_column));
    // The flag stands for the column, and has another name for penetrations and heights.
    let exact = run("column.csv --abscissa-noise 0");
    assert_eq!(found(&exact), found(&run("data.csv")));
    let fit = "fit data.csv --film-thickness 3e-5 --specimen paper";
    workdir.refuses(format!(
        "1 | {fit} --radius-noise -1 | contact radius; -1; >= 0"
    ));
}

#[test]
fn a_saturated_detector_and_a_hidden_noise_say_what_to_do() {
    let workdir = workdir!();
    lens(&workdir);
    let fit = "--film-thickness 3e-5 --specimen paper";
    let report = workdir.succeed(format!("fit data.csv {fit} --radius-noise 3e-7"));
    let words = "the noise of the load is estimated; the noise of the ordinates: --noise SIZE";
    assert_names(&report, words);
    let text = workdir.text("data.csv");
    let clipped: String = text
        .lines()
        .map(|line| match line.split_once(',') {
            Some((radius, load)) if load.parse().is_ok_and(|load: f64| load > 1.5e-3) => {
                format!("{radius},1.5e-3\n")
            }
            _ => format!("{line}\n"),
        })
        .collect();
    workdir.write("clipped.csv", clipped);
    let report = workdir.succeed(format!("fit clipped.csv {fit}"));
    let words = "exactly the largest load; leave these points out; let their lines begin with #";
    assert_names(&report, words);
}

fn scene(tolerance: f64, nodes: [&str; 2]) -> String {
    let [a_over_t, e1] = nodes;
    format!(
        "title = \"coarse\"\ntolerance = {tolerance:?}\na_over_t = {{ from = 0.1, to = 10{a_over_t} }}\n\
         e1_over_e2 = {{ from = 1, to = 3{e1} }}\nnu1 = 0.5\ne0_over_e2 = inf\n"
    )
}

/// The error of a table is no noise: what it does to the values does not show in their standard errors.
#[test]
fn a_table_less_accurate_than_the_data_is_doubted() {
    let workdir = workdir!();
    let bodies = "--specimen paper --film-thickness 30um --substrate-modulus inf --noise 500nN";
    workdir.succeed(format!(
        "simulate {bodies} --kind load-radius --from 40um --to 130um --seed 1 -o data.csv"
    ));
    workdir.write("coarse.toml", scene(1e-2, ["", ""]));
    workdir.run("generate coarse.toml -o coarse.h5");
    let fit = |table: &str| workdir.json(format!("fit data.csv {bodies} --table {table} --json"));
    let of_kind = |found: &Value| kinds(found).contains(&"table-error");
    let (coarse, exact) = (fit("coarse.h5"), fit("embedded"));
    assert!(of_kind(&coarse) && !of_kind(&exact), "{coarse}");
    let wrong = |found: &Value| {
        let value = |name: &str| number(found, &format!("parameters/work_of_adhesion/{name}"));
        (value("value") - 0.04).abs() / value("stderr")
    };
    assert!(wrong(&coarse) > 4.0 && wrong(&exact) < 3.0);
}

/// A table that was written although it misses its tolerance says so wherever it is used.
#[test]
fn a_table_that_misses_its_tolerance_is_told_of() {
    let workdir = workdir!();
    workdir.write("missed.toml", scene(1e-9, [", nodes = 6", ", nodes = 3"]));
    assert_eq!(workdir.run("generate missed.toml -o missed.h5").status, 1);
    let bodies = "--specimen paper --film-thickness 30um --substrate-modulus inf";
    let run = workdir.run(format!("curve missed.h5 {bodies} --to 100um"));
    let words = "missed.h5 misses its tolerance of 1.0e-9; embedded";
    assert_names(&run.stderr, words);
}

/// Frames of a video without a radius have the radius 0; a file of which the headings are exchanged has loads for radii.
#[test]
fn radii_that_were_lost_or_exchanged_are_named() {
    let workdir = workdir!();
    let bodies = "--half-space --sphere-radius 2mm --film-modulus 70GPa --film-poisson-ratio 0.25";
    workdir.simulate(format!(
        "{bodies} --sphere-modulus 3MPa --work-of-adhesion 40mJ/m^2 --kind load-radius --from 70um --to 300um --points 60 \
         --noise 3uN -o whole.csv"
    ));
    let text = String::from_utf8(workdir.read("whole.csv")).expect("text");
    let rows: Vec<(&str, &str)> = text
        .lines()
        .filter(|line| !line.starts_with('#'))
        .filter_map(|line| line.split_once(','))
        .collect();
    let lost = |(i, &(radius, load)): (usize, &(&str, &str))| match i {
        20 | 30 | 40 => format!("0,{load}\n"),
        _ => format!("{radius},{load}\n"),
    };
    workdir.write(
        "lost.csv",
        rows.iter().enumerate().map(lost).collect::<String>(),
    );
    let in_units = |text: &str, size: f64| text.parse::<f64>().expect("a number") / size;
    let exchanged = |&(radius, load): &(&str, &str)| {
        format!("{},{}\n", in_units(load, 1e-3), in_units(radius, 1e-6))
    };
    let headings = "contact radius (um),load (mN)\n".to_owned();
    let pressed = rows[1..].iter().filter(|row| !row.1.starts_with('-'));
    workdir.write(
        "exchanged.csv",
        headings.clone() + &pressed.map(exchanged).collect::<String>(),
    );
    workdir.write(
        "tension.csv",
        headings + &rows[1..].iter().map(exchanged).collect::<String>(),
    );
    let report = workdir
        .run(format!("fit lost.csv {bodies} --noise 3uN"))
        .stdout;
    assert_names(
        &report,
        "radius is 0 in 3 of 60 rows; in lines 21, 31, 41: leave out the rows",
    );
    assert!(!report.contains("load-offset is not fitted"), "{report}");
    workdir.refuses(format!(
        "
        1 | fit exchanged.csv {bodies} | the load grows as the power 0.; columns exchanged
        1 | fit tension.csv {bodies} | exchange the headings
        "
    ));
}

/// Below 0.1 a chi^2 is a power of ten: two that are small are not both 0.
#[test]
fn a_small_chi_squared_has_digits() {
    let workdir = workdir!();
    lens(&workdir);
    let fit =
        "fit data.csv --specimen paper --film-thickness 3e-5 --free work-of-adhesion --noise 1mN";
    let report = workdir.run(fit).stdout;
    assert_names(
        &report,
        "chi^2 is 5.; e-2 without the film, and 1.; e-4 with it",
    );
}
