//! `tabulate fit --relaxation` and `tabulate simulate --relaxation`.

use acceptance::{
    Data, Workdir, assert_close, assert_estimate, assert_names, estimate, number, workdir,
};
use serde_json::Value;

const GEL: &str = "--sphere-radius 10um --sphere-modulus inf --film-thickness 8um --film-poisson-ratio 0.5 \
     --substrate-modulus inf";

const POWER: &str = "--relaxation power-law --relaxation-exponent 0.2";

/// Writes penetrations and loads of a gel in time.
fn simulate(workdir: &Workdir, law: &str, name: &str) -> String {
    let plan = format!(
        "simulate --kind load-penetration --film-modulus 2kPa --from -50nm --to 400nm \
         --points 50 --sample-interval 20ms --hold 0.4 --noise 20pN --seed 3 -o {name}"
    );
    workdir.succeed(format!("{plan} {GEL} {law}"));
    workdir.text(name)
}

fn fit(workdir: &Workdir, more: &str) -> Value {
    workdir.json(format!("fit data.csv --json {GEL} {more}"))
}

#[test]
fn what_is_simulated_is_found() {
    let workdir = workdir!();
    let text = simulate(&workdir, POWER, "data.csv");
    let data = Data::parse("data", &text);
    assert_eq!(data.cases().count(), 120);
    let found = fit(&workdir, "--relaxation power-law");
    for (name, truth) in [("film_modulus", 2e3), ("relaxation_exponent", 0.2)] {
        assert_estimate(&found, name, truth, 0.05 * truth);
    }
    let relaxation = &found["relaxation"];
    assert_eq!(relaxation["law"], "power-law");
    assert_eq!(relaxation["moduli"].as_array().expect("a list").len(), 3);
    assert_eq!(relaxation["made_monotone"], 0.0);
    let steps = number(relaxation, "steps_error");
    assert!(0.0 < steps && steps < 1e-4, "{steps}");
    assert!(fit(&workdir, "--relaxation sls")["parameters"]["relaxed_fraction"].is_object());
    // Another law leaves a loop, which is none of adhesion.
    simulate(&workdir, &POWER.replace("0.2", "0.5"), "data.csv");
    let run = workdir.run(format!("fit data.csv {GEL} --relaxation sls"));
    let said = format!("{}{}", run.stdout, run.stderr);
    assert_names(&said, "energy than the fitted relaxation function");
    assert!(!said.contains("work-of-adhesion-receding"), "{said}");
}

/// A history before, in and after contact is read with the words of its phases.
#[test]
fn a_history_is_data() {
    let workdir = workdir!();
    let program = "--program 'penetration 0:-100nm 1:300nm 1.5:300nm 2.5:-100nm' --points 101";
    workdir.succeed(format!(
        "history --film-modulus 2kPa {GEL} {POWER} {program} -o data.csv"
    ));
    let found = fit(
        &workdir,
        "--kind load-penetration --relaxation power-law --value contact-point=0 --value baseline=0",
    );
    for (name, truth) in [("film_modulus", 2e3), ("relaxation_exponent", 0.2)] {
        assert_estimate(&found, name, truth, 1e-4 * truth);
    }
}

#[test]
fn the_interval_between_points_stands_for_times() {
    let workdir = workdir!();
    let text = simulate(&workdir, POWER, "data.csv");
    let with_times = fit(&workdir, "--relaxation power-law");
    let without = text.lines().map(|line| {
        let cells = line.split_once(',').filter(|_| !line.starts_with('#'));
        format!("{}\n", cells.map_or(line, |(_, rest)| rest))
    });
    workdir.write("data.csv", without.collect::<String>());
    let by_interval = "--relaxation power-law --sample-interval 20ms";
    let fits = [with_times, fit(&workdir, by_interval)];
    let [one, other] = fits.map(|found| estimate(&found, "film_modulus")[0]);
    assert_close(one, other, 1e-6);
    // Times that start again in the retract.
    let restarted = text.lines().map(|line| match line.split_once(',') {
        Some((time, rest)) => match time.parse::<f64>() {
            Ok(time) if time > 1.4 => format!("{},{rest}\n", time - 1.4),
            _ => format!("{line}\n"),
        },
        None => format!("{line}\n"),
    });
    workdir.write("segments.csv", restarted.collect::<String>());
    workdir.refuses(format!(
        "1 | fit segments.csv {GEL} --relaxation power-law | times must rise; start again; --sample-interval"
    ));
    let found = workdir.json(format!("fit segments.csv --json {GEL} {by_interval}"));
    assert_close(estimate(&found, "film_modulus")[0], one, 1e-6);
    // A known number of the law is given with its error alone.
    let known = format!(
        "{by_interval} --free film-modulus,contact-point --known relaxation-exponent=0.2+-0.01"
    );
    let names = fit(&workdir, &known)["fixed_values"].to_string();
    assert_names(&names, "relaxation_exponent");
    let swapped = text.replacen("penetration,load", "load,penetration", 1);
    assert_ne!(swapped, text);
    workdir.write("swapped.csv", swapped);
    for (name, head) in [("minutes.csv", "Zeit [min]"), ("bare.csv", "Time")] {
        workdir.write(name, text.replacen("time,", &format!("{head},"), 1));
    }
    let data = format!("fit data.csv {GEL}");
    let law = "--relaxation power-law";
    workdir.refuses(format!(
        "
        1 | {data} {law} | no times; no column is in a unit of time; --sample-interval
        1 | fit minutes.csv {GEL} {law} | type --column \"time=Zeit [min]\", or type --sample-interval
        1 | fit bare.csv {GEL} {law} | --column \"time=Time [UNIT]\", with the unit of the numbers in place of UNIT
        1 | fit swapped.csv {GEL} {law} | swapped.csv; begin in contact; columns
        1 | fit none.csv {GEL} {law} | none.csv; No such file
        1 | {data} {by_interval} --between 0nm..100nm | --between; a piece out of the course; leave it out
        2 | {data} --relaxation power | power-law; prony:M; sls
        2 | {data} --relaxation prony:0 | prony:0; prony:2
        1 | {data} {law} --relaxed-fraction 0.3 | --relaxed-fraction; relaxation-exponent
        2 | {data} --relaxation-exponent 0.3 | --relaxation
        1 | {data} {law} --relaxation-exponent 1.2 | relaxation exponent = 1.2; below 1
        1 | {data} --relaxation sls --relaxed-fraction 1.3 | relaxed fraction = 1.3; from 0 to 1
        1 | {data} --sample-interval 10ms --relaxation prony:2 --relaxed-fraction 0.9 --value relaxation-weight.2=0.82 | sum of the relaxed fraction and all weights but the first = 1.72; below 1; the first one fills
        1 | {data} {by_interval} --free film-modulus | relaxation-exponent; --value relaxation-exponent=
        1 | {data} {by_interval} --work-of-adhesion 1uJ/m^2 | work of adhesion; crack tip
        2 | {data} {law} --sample-interval 20nm | 20nm; a time is wanted
        1 | {data} --work-of-adhesion 0 --free film-modulus,relaxation-exponent | relaxation-exponent; relaxation function
        "
    ));
}

/// Noise of a tenth of the largest load: without a start of its own the half-space that remains without the film was off by
/// +1e13 %. Other noise gives some 70 %.
#[test]
fn the_film_matters_by_a_sensible_amount_in_noisy_data() {
    let workdir = workdir!();
    workdir.succeed(format!(
        "simulate {GEL} {POWER} --kind load-penetration --film-modulus 2kPa --from=-0.2um --to 0.6um --points 100 \
         --hold 0.5s --sample-interval 10ms --noise 1600pN --seed 12 -o noisy.csv"
    ));
    let report = workdir.succeed(format!("fit noisy.csv {GEL} --relaxation power-law"));
    let off = report.split_once("film-modulus is off by +");
    let per_cent = off.and_then(|(_, off)| off.split_once(' ')?.0.parse().ok());
    let is_sensible = per_cent.is_some_and(|off: f64| (40.0..110.0).contains(&off));
    assert!(is_sensible, "{report}");
}

#[test]
fn a_loop_in_time_names_the_flag() {
    let workdir = workdir!();
    simulate(&workdir, POWER, "data.csv");
    let elastic = "--work-of-adhesion 0 --free film-modulus,contact-point";
    let run = workdir.run(format!("fit data.csv {GEL} {elastic}"));
    assert_names(&run.stdout, "loop; times; --relaxation power-law");
}

#[test]
fn a_hold_without_a_retract_names_the_flag() {
    let workdir = workdir!();
    workdir.succeed(format!(
        "simulate --kind load-penetration --film-modulus 2kPa --from -50nm --to 400nm --points 50 --sample-interval 20ms \
         --hold 1 --segments approach --noise 20pN {GEL} {POWER} -o hold.csv"
    ));
    let elastic = "--work-of-adhesion 0 --free film-modulus,contact-point";
    let report = workdir.run(format!("fit hold.csv {GEL} {elastic}")).stdout;
    let words = "penetration was held; load fell; with the times; --relaxation power-law";
    assert_names(&report, words);
    assert!(!report.contains("work-of-adhesion-receding"), "{report}");
}

#[test]
fn a_simulation_without_the_numbers_of_the_law_asks_for_them() {
    let workdir = workdir!();
    let plan = "simulate --kind load-penetration --film-modulus 2kPa --from -50nm --to 400nm --noise \
         0 --relaxation sls";
    let numbers = "--relaxed-fraction 0.3 --relaxation-time 0.2s";
    workdir.refuses(format!(
        "
        1 | {plan} {GEL} | relaxed-fraction; relaxation-time
        1 | {plan} {GEL} {numbers} | no times; --sample-interval
        "
    ));
}

#[test]
fn a_hold_has_as_many_points_as_intervals() {
    let workdir = workdir!();
    let plan = "simulate --kind load-penetration --film-modulus 2kPa --from -50nm --to 400nm --noise 0 \
         --points 10 --sample-interval 0.1";
    // 0.3/0.1 and 0.7/0.1 are rounded to less than 3 and to less than 7.
    for (hold, points) in [("0.3", 23), ("0.7", 27), ("0.5", 25)] {
        let data = workdir.csv(format!("{plan} {GEL} {POWER} --hold {hold}"));
        assert_eq!(data.cases().count(), points, "{hold}");
    }
    let wrong = ["-0.1", "nan", "0.25", "1e9", "inf"];
    let refused = wrong.map(|hold| {
        format!("1 | {plan} {GEL} {POWER} --hold {hold} | --hold; from 0 to 1000000 whole; 0.1 s")
    });
    workdir.refuses(refused.join("\n"));
}

#[test]
fn the_modulus_of_a_power_law_is_that_at_the_reference_time() {
    let workdir = workdir!();
    simulate(&workdir, POWER, "data.csv");
    let found = |more: &str| {
        let found = fit(&workdir, &format!("--relaxation power-law {more}"));
        ["film_modulus", "relaxation_exponent"].map(|name| estimate(&found, name)[0])
    };
    let ([one, exponent], [tenth, _]) = (found(""), found("--reference-time 0.1s"));
    // (t/1 s)^-n at 0.1 s.
    assert_close(tenth, one * 10_f64.powf(exponent), 1e-4);
}
