//! Adhesion that depends on the speed of the contact line, in `tabulate fit` and `tabulate simulate`.

use std::fs;
use std::path::Path;

use acceptance::{Data, Workdir, assert_estimate, assert_names, assert_near, workdir};

use crate::fit_plots::{COLOURS, markers};

const RUBBER: &str = "--sphere-radius 2mm --sphere-modulus inf --film-thickness 150um --film-poisson-ratio 0.5 \
     --substrate-modulus 70GPa --substrate-poisson-ratio 0.22 --film-modulus 2MPa";
/// The law by which its adhesion depends on the speed.
const OF_LINE: &str = "--value doubling-speed=1um/s --value speed-exponent=0.5";
const LAW: &str = "--free film-modulus,work-of-adhesion,doubling-speed,speed-exponent";

/// Writes the lens on rubber, each line changed.
fn rubber(workdir: &Workdir, file: &str, change: impl Fn(&str) -> String) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../crates/fit/examples/rubber.csv");
    let text = fs::read_to_string(path).expect("the file");
    let lines = text.lines().map(|line| change(line) + "\n");
    workdir.write(file, lines.collect::<String>());
}

#[test]
fn a_loop_in_time_asks_for_the_law_and_the_law_is_found_with_its_speeds() {
    let workdir = workdir!();
    rubber(&workdir, "rubber.csv", str::to_owned);
    let noise = "--radius-noise 0.2um --noise 2uN";
    let without = workdir.answer(format!(
        "fit rubber.csv {RUBBER} {noise} --free film-modulus,work-of-adhesion"
    ));
    assert_names(&without.stdout, "--free ...,doubling-speed,speed-exponent");
    // The page of experiments says what two works of adhesion give.
    let works = "--free film-modulus,work-of-adhesion,work-of-adhesion-receding";
    let two = workdir.json(format!("fit rubber.csv {RUBBER} {noise} {works} --json"));
    let modulus = two["parameters"]["film_modulus"]["value"].as_f64();
    assert_near(modulus.expect("a number") / 2e6, 1.2, 0.01);
    // Where the law is free already, and does not describe the data, it is no next step.
    let bounds = "--bounds doubling-speed=1mm/s..1m/s";
    let slow = workdir.answer(format!("fit rubber.csv {RUBBER} {noise} {LAW} {bounds}"));
    assert_names(&slow.stdout, "does not describe the data");
    assert!(
        !slow.stdout.contains("--free ...,doubling-speed"),
        "{}",
        slow.stdout
    );
    let found = workdir.json(format!(
        "fit rubber.csv {RUBBER} {noise} {LAW} --json --csv points.csv --plot speed.svg --plot-kind speed"
    ));
    for (name, truth) in [
        ("film_modulus", 2e6),
        ("work_of_adhesion", 0.05),
        ("doubling_speed", 1e-6),
        ("speed_exponent", 0.5),
    ] {
        assert_estimate(&found, name, truth, 0.05 * truth);
    }
    let points = Data::parse("points.csv", &workdir.text("points.csv"));
    let speeds: Vec<f64> = points
        .cases()
        .filter_map(|case| case.text("line_speed").parse().ok())
        .collect();
    assert_eq!(speeds.len(), 120 - 12);
    let sizes = speeds.iter().map(|speed| speed.abs());
    let ends = [
        sizes.clone().fold(f64::INFINITY, f64::min),
        sizes.fold(0.0, f64::max),
    ];
    for (own, shown) in ends
        .iter()
        .zip(found["line_speed"].as_array().expect("a pair"))
    {
        assert_near(*own, shown.as_f64().expect("a number"), 1e-20);
    }
    // The energies are those of the law, to the noise.
    for case in points
        .cases()
        .filter(|case| !case.text("line_speed").is_empty())
    {
        let [speed, energy] = ["line_speed", "energy_release_rate"].map(|name| case.get(name));
        let factor = 1.0 + (speed.abs() / 1e-6).sqrt();
        let of_law = if speed > 0.0 {
            0.05 * factor
        } else {
            0.05 / factor
        };
        assert!((energy / of_law - 1.0).abs() < 0.15, "{speed:e}: {energy}");
    }
    // The contact grows and shrinks.
    let advancing = speeds.iter().filter(|speed| **speed < 0.0).count();
    assert!(advancing > 30 && speeds[speeds.len() - 1] > 0.0);
    let svg = workdir.text("speed.svg");
    let drawn = COLOURS.map(|colour| markers(&svg, colour).len());
    assert_eq!(drawn, [advancing, speeds.len() - advancing]);
}

/// A camera sees radii in pixels, which stay equal where the line creeps.
#[test]
fn points_of_the_speed_0_are_told_and_not_drawn() {
    let workdir = workdir!();
    rubber(&workdir, "rubber.csv", str::to_owned);
    let text = workdir.text("rubber.csv");
    let approach = text.lines().filter(|line| !line.ends_with("retract"));
    let dwell = (0..60).map(|i| format!("{},1.662e-4,7.8921e-3,approach", 203 + i));
    let lines: Vec<String> = approach.map(str::to_owned).chain(dwell).collect();
    workdir.write("dwell.csv", lines.join("\n"));
    let fit = format!("--free film-modulus,work-of-adhesion {OF_LINE}");
    let found = workdir.answer(format!(
        "fit dwell.csv {RUBBER} {fit} --radius-noise 0.2um --noise 2uN --csv points.csv --plot speed.svg --plot-kind speed"
    ));
    assert_names(&found.stdout, "speeds of the contact line from 0 m/s to");
    let points = Data::parse("points.csv", &workdir.text("points.csv"));
    let speeds = points
        .cases()
        .filter_map(|case| case.text("line_speed").parse().ok());
    let speeds: Vec<f64> = speeds.collect();
    let moving = speeds.iter().filter(|speed| **speed != 0.0).count();
    assert!(speeds.len() > moving + 10, "{speeds:?}");
    let svg = workdir.text("speed.svg");
    let drawn: usize = COLOURS
        .iter()
        .map(|colour| markers(&svg, colour).len())
        .sum();
    assert_eq!(drawn, moving);
}

/// Simulates a cycle on rubber as `cycle.csv`.
fn simulate_cycle(workdir: &Workdir, points: &str) {
    workdir.simulate(format!(
        "--kind load-radius {RUBBER} --work-of-adhesion 0.05 {OF_LINE} --from 60um --to 150um --segments cycle {points} \
         --sample-interval 1s --noise 2uN --seed 1 -o cycle.csv"
    ));
}

#[test]
fn of_many_points_a_picture_draws_some() {
    let workdir = workdir!();
    simulate_cycle(&workdir, "--points 4000");
    workdir.answer(format!(
        "fit cycle.csv {RUBBER} --free work-of-adhesion {OF_LINE} --noise 2uN --plot speed.svg --plot-kind speed"
    ));
    let svg = workdir.text("speed.svg");
    for colour in COLOURS {
        let drawn = markers(&svg, colour).len();
        assert!((1000..1600).contains(&drawn), "{drawn}");
    }
}

#[test]
fn a_line_of_one_speed_is_simulated_and_found() {
    let workdir = workdir!();
    simulate_cycle(&workdir, "");
    let free =
        "--free work-of-adhesion,doubling-speed --value speed-exponent=0.5 --noise 2uN --json";
    let found = workdir.json(format!("fit cycle.csv {RUBBER} {free}"));
    for (name, truth) in [("work_of_adhesion", 0.05), ("doubling_speed", 1e-6)] {
        assert_estimate(&found, name, truth, 0.02 * truth);
    }
}

#[test]
fn numbers_without_a_unit_are_shown_with_their_digits() {
    let workdir = workdir!();
    rubber(&workdir, "rubber.csv", str::to_owned);
    let fit = format!("fit rubber.csv {RUBBER} {LAW} --radius-noise 0.2um --noise 2uN");
    let of_known = workdir.answer(format!("{fit} --known film-thickness=+-1%"));
    assert_names(&of_known.stdout, "e-4 of speed-exponent");
    let of_interval = workdir.answer(format!("{fit} --intervals 0.95"));
    assert!(!of_interval.stdout.contains(" )"), "{}", of_interval.stdout);
}

#[test]
fn cycles_in_one_file_are_one_course_in_time() {
    let workdir = workdir!();
    rubber(&workdir, "rubber.csv", str::to_owned);
    let text = workdir.text("rubber.csv");
    let (heading, rows): (Vec<&str>, Vec<&str>) =
        text.lines().partition(|line| line.starts_with(['#', 't']));
    let cycle = |begin: f64| {
        let later = move |row: &str| {
            let cells: Vec<&str> = row.split(',').collect();
            let time: f64 = cells[0].parse().expect("a time");
            format!("{},{},{}", time + begin, cells[1], cells[2])
        };
        rows.iter().map(|row| later(row)).collect::<Vec<_>>()
    };
    let heading = heading.join("\n").replace(",segment", "");
    let all = [cycle(0.0), cycle(600.0), cycle(1200.0)].concat();
    workdir.write("cycles.csv", format!("{heading}\n{}\n", all.join("\n")));
    let fit = |free: &str| {
        workdir.json(format!(
            "fit cycles.csv {RUBBER} --radius-noise 0.2um --noise 2uN {free} --json"
        ))["warnings"]
            .to_string()
    };
    let several = "several-curves";
    let two = "--free film-modulus,work-of-adhesion";
    assert!(fit(two).contains(several));
    assert!(!fit(LAW).contains(several));
    let given = format!("{two} {OF_LINE}");
    assert!(!fit(&given).contains(several));
}

#[test]
fn wrong_first_calls_say_what_to_do() {
    let workdir = workdir!();
    rubber(&workdir, "rubber.csv", str::to_owned);
    let cells = |line: &str, of: fn(Vec<&str>) -> Vec<&str>| {
        let cells: Vec<&str> = line.split(',').collect();
        if cells.len() == 4 {
            of(cells).join(",")
        } else {
            line.to_owned()
        }
    };
    rubber(&workdir, "untimed.csv", |line| {
        cells(line, |cells| cells[1..].to_vec())
    });
    rubber(&workdir, "stopwatch.csv", |line| {
        line.replace("time,", "stopwatch (s),")
    });
    rubber(&workdir, "again.csv", |line| {
        cells(line, |mut cells| {
            if cells[0] == "201.492" {
                cells[0] = "2.483";
            }
            cells
        })
    });
    rubber(&workdir, "depths.csv", |line| {
        line.replace("contact_radius", "penetration")
    });
    workdir.refuses(format!(
        "1 | fit untimed.csv {RUBBER} {LAW} | no times; no column is in a unit of time; --sample-interval S
         1 | fit stopwatch.csv {RUBBER} {LAW} | no times; --column \"time=stopwatch (s)
         1 | fit again.csv {RUBBER} {LAW} | line 44; times must rise; --sample-interval
         1 | fit depths.csv {RUBBER} {LAW} | doubling-speed cannot be found; contact radii in time
         1 | fit rubber.csv {RUBBER} --free film-modulus,work-of-adhesion,doubling-speed | speed-exponent; not given; each given or free
         2 | fit rubber.csv {RUBBER} --value doubling-speed=1um --value speed-exponent=0.5 | is a length, and a speed is wanted; 2um/s
         1 | fit rubber.csv {RUBBER} --value doubling-speed=0 --value speed-exponent=0.5 | doubling-speed; positive
         1 | fit rubber.csv {RUBBER} {LAW} --friction stick | full friction; without friction only
         1 | simulate --kind load-radius {RUBBER} --work-of-adhesion 0.05 --from 60um --to 150um --noise 2uN --segments cycle --sample-interval 1s --expect {LAW} | doubling-speed; not given; at the planned value
         1 | simulate --kind load-radius {RUBBER} {OF_LINE} --from 60um --to 150um --noise 2uN | no times; --sample-interval S",
    ));
}
