//! Adhesion that depends on the speed of the contact line: contacts that move in time by the law are the truth.

use acceptance::{Contacts, Refused, rigid_sphere, solid};
use contact::{Contact, Control, RateDependent, TimedState};
use fit::report::line_plot;
use fit::{
    Bodies, Direction, Experiment, Fit, Free, Kind, LineSpeed, Loss, Parameter, Point, Solver,
    WarningKind, forecast, simulate,
};
use interp::{System, Table};
use rayon::prelude::*;

use crate::imagined::{
    doubts, fit_all, fit_with, fitted, free_of, half_space, measurement, measurement_at,
};
use crate::recovery::SETS;
use Parameter::{
    ContactPoint, DoublingSpeed, FilmModulus, SpeedExponent, WorkOfAdhesion, WorkOfAdhesionReceding,
};

pub const LAW: [Parameter; 4] = [FilmModulus, WorkOfAdhesion, DoublingSpeed, SpeedExponent];
/// The work of adhesion at rest (J/m^2), the speed (m/s) at which it doubles, and the exponent.
pub const LINE: [f64; 3] = [0.05, 1e-6, 0.5];

/// The most of 200 sound fits that may have a doubt, as by a slow line whose speed has an unusually large error.
const MOST_DOUBTED: usize = 6;

/// A glass lens on a film of rubber as thick as the contact is wide.
fn rubber() -> System {
    rigid_sphere(2e-3, [2e6, 0.5], 1.5e-4, [7e10, 0.22])
}

pub fn contact() -> Contact {
    Contact::in_table(Table::embedded(), &rubber()).expect("in the table")
}

/// The states of a lens that is pressed on rubber and lifted, with the load in time as the motor imposes it.
pub fn moved([w, v0, n]: [f64; 3]) -> [Vec<TimedState>; 2] {
    let contact = contact();
    let law = RateDependent::new(w, v0, n).expect("physical");
    let mut line = contact.line(law, 6e-5).expect("in the table");
    let start = line.state().expect("in contact").load;
    let mut ramp = |load: f64, duration: f64| {
        let states = line.ramp(Control::Load, load, duration, 1e-8);
        states.expect("it moves")
    };
    let approach = ramp(8e-3, 200.0);
    let retract = ramp(start - 8e-3, 300.0);
    [approach, retract]
}

/// What a camera and a load cell read of the course at equal times, `counts` on each way.
pub fn read(course: &[Vec<TimedState>; 2], counts: [usize; 2]) -> Experiment {
    let (mut points, mut times) = (Vec::new(), Vec::new());
    let mut begin = 0.0;
    for ((states, count), direction) in course.iter().zip(counts).zip(Direction::ALL) {
        let last = states.last().expect("a state").time;
        for i in 0..count {
            // Not the last one of the retract, where the contact has ended.
            let time = last * (i as f64 + 0.5) / count as f64;
            let after = states.partition_point(|state| state.time < time);
            let [before, after] = [&states[after - 1], &states[after]];
            let part = (time - before.time) / (after.time - before.time);
            let between = |of: fn(&TimedState) -> f64| of(before) + part * (of(after) - of(before));
            points.push(Point {
                line: points.len() as u64 + 1,
                abscissa: between(|one| one.state.contact_radius),
                ordinate: between(|one| one.state.load),
                direction: Some(direction),
            });
            times.push(begin + time);
        }
        begin += last;
    }
    let bodies = Bodies::coated(&rubber());
    Experiment {
        work_of_adhesion: LINE[0],
        times,
        ..Experiment::new(measurement(Kind::LoadRadius, points), bodies)
    }
}

pub fn with_noise(
    mut experiment: Experiment,
    [of_radius, of_load]: [f64; 2],
    seed: u64,
) -> Experiment {
    let mut random = Contacts::new(seed);
    for point in &mut experiment.measurement.points {
        point.abscissa += of_radius * random.normal();
        point.ordinate += of_load * random.normal();
    }
    experiment
}

fn with_law(mut experiment: Experiment, [w, v0, n]: [f64; 3]) -> Experiment {
    experiment.work_of_adhesion = w;
    experiment.doubling_speed = Some(v0);
    experiment.speed_exponent = Some(n);
    experiment
}

/// Asserts that a fit of exact data finds the values of an experiment.
fn assert_finds(found: &Fit, truth: &Experiment) {
    for parameter in LAW {
        let value = found.estimate(parameter).expect("free").value;
        let expected = truth.get(parameter).expect("a value");
        let off = value / expected - 1.0;
        assert!(off.abs() < 2e-3, "{parameter} of {expected:e}: {off:e}");
    }
}

#[test]
fn the_law_of_a_line_that_moves_is_found_from_radii_and_loads() {
    for law in [LINE, [0.03, 1e-7, 0.3], [0.1, 1e-5, 0.8]] {
        let exact = read(&moved(law), [60, 120]);
        let found = fitted(&exact, &free_of(&LAW));
        assert_finds(&found, &with_law(exact, law));
    }
}

#[test]
fn the_points_of_a_plot_over_speed_are_those_of_the_law() {
    let exact = read(&moved(LINE), [60, 120]);
    let found = fitted(&exact, &free_of(&LAW));
    let plot = line_plot(&found, &exact, 0).expect("a law");
    assert_eq!(plot.points.len(), 180 - 12);
    let off = |[speed, energy]: [f64; 2]| {
        let of_law = plot.law.energy_release_rate(speed).expect("finite");
        (energy / of_law - 1.0).abs()
    };
    let mut off: Vec<f64> = plot.points.iter().map(|&point| off(point)).collect();
    off.sort_by(f64::total_cmp);
    // Where the line nearly rests, and where its speed changes fastest, the error of the speed is largest.
    assert!(
        off[off.len() * 9 / 10] < 0.01 && off[off.len() - 1] < 0.2,
        "{off:?}"
    );
    let constant = fitted(&exact, &free_of(&LAW[..2]));
    line_plot(&constant, &exact, 0).refused("does not depend on the speed");
}

/// The values scatter by 0.7 to 1.2 of their standard errors, and by 0.6 to 1 of them where no noise is stated. Most errors are somewhat too large: what is added because the
/// speeds of neighbours are read from the same radii counts for the modulus, too, which the loads tell as well.
#[test]
fn the_truth_of_noisy_lines_is_within_the_intervals() {
    let few = ([2e-7, 2e-6], [30, 60]);
    let many = ([4e-7, 2e-6], [100, 300]);
    let slow = [0.03, 1e-7, 0.3];
    for (name, (noise, counts), law, loss, is_stated) in [
        ("few", few, LINE, Loss::Squares, true),
        ("many", many, LINE, Loss::Squares, true),
        ("slow", few, slow, Loss::Squares, true),
        // Single points scatter by less than their weights say, which hold for means over neighbours: a loss that took
        // this scatter as it is would tell errors too small by a factor of 1.7.
        ("robust", many, LINE, Loss::HUBER, true),
        ("no noise stated", many, LINE, Loss::Squares, false),
    ] {
        let exact = read(&moved(law), counts);
        let fit_of = |seed| -> Fit {
            let mut measured = with_noise(exact.clone(), noise, seed);
            if is_stated {
                measured.abscissa_noise = noise[0];
                measured.noise = Some(noise[1]);
            }
            fit_with(&measured, &free_of(&LAW), |options| options.loss = loss).expect("sound")
        };
        let fits: Vec<Fit> = (0..SETS).into_par_iter().map(fit_of).collect();
        let truth = with_law(exact.clone(), law);
        for (i, parameter) in LAW.into_iter().enumerate() {
            let value = truth.get(parameter).expect("a value");
            let squares = fits.iter().map(|fit| {
                let estimate = &fit.estimates[i];
                ((estimate.value - value) / estimate.standard_error).powi(2)
            });
            let deviations = (squares.sum::<f64>() / SETS as f64).sqrt();
            println!("{name}: {parameter}, {deviations:.2} standard errors");
            let least = if is_stated { 0.65 } else { 0.5 };
            assert!(
                (least..1.2).contains(&deviations),
                "{name}, {parameter}: {deviations}"
            );
        }
        assert!(fits.iter().all(|found| found.converged));
        let expected = [
            WarningKind::NonlinearError,
            WarningKind::Friction,
            WarningKind::AssumesBonding,
        ];
        let doubted = fits
            .iter()
            .filter(|found| !doubts(found, &expected).is_empty());
        let doubted = doubted.count();
        assert!(doubted <= MOST_DOUBTED, "{name}: {doubted} with doubts");
    }
}

/// With all points at the speeds that were read, the errors of the speeds would weaken how adhesion depends on them, and from
/// one way modulus and work of adhesion would be wrong by up to 13 standard errors.
#[test]
fn one_way_alone_tells_the_law_without_a_bias() {
    let exact = read(&moved(LINE), [120, 180]);
    let truth = with_law(exact.clone(), LINE);
    for direction in Direction::ALL {
        let fit_of = |seed| -> Fit {
            let mut measured = with_noise(exact.clone(), [2e-8, 2e-7], seed);
            measured.abscissa_noise = 2e-8;
            measured.noise = Some(2e-7);
            let own = |i: &usize| exact.measurement.points[*i].direction == Some(direction);
            let own: Vec<usize> = (0..exact.measurement.points.len()).filter(own).collect();
            measured.times = own.iter().map(|&i| exact.times[i]).collect();
            let points = own.iter().map(|&i| measured.measurement.points[i]);
            measured.measurement.points = points.collect();
            fitted(&measured, &free_of(&LAW))
        };
        let fits: Vec<Fit> = (0..SETS).into_par_iter().map(fit_of).collect();
        for (i, parameter) in LAW.into_iter().enumerate() {
            let value = truth.get(parameter).expect("a value");
            let deviation = |fit: &Fit| {
                let estimate = &fit.estimates[i];
                (estimate.value / value).ln() / (estimate.standard_error / estimate.value)
            };
            let mean = fits.iter().map(deviation).sum::<f64>() / SETS as f64;
            println!(
                "{}: {parameter}, {mean:+.2} standard errors",
                direction.name()
            );
            assert!(mean.abs() < 0.6, "{parameter}: {mean}");
        }
    }
}

#[test]
fn radii_of_a_camera_that_come_in_pixels_tell_the_law() {
    let mut measured = with_noise(read(&moved(LINE), [300, 600]), [0.0, 2e-6], 1);
    for point in &mut measured.measurement.points {
        point.abscissa = 1e-6 * (1e6 * point.abscissa).round();
    }
    let found = fitted(&measured, &free_of(&LAW));
    for (parameter, truth) in LAW.into_iter().zip([2e6, LINE[0], LINE[1], LINE[2]]) {
        let estimate = found.estimate(parameter).expect("free");
        let [low, high] = estimate.interval(3.0);
        assert!((low..=high).contains(&truth), "{estimate:?}");
    }
}

#[test]
fn points_without_a_direction_have_the_speeds_of_both_ways() {
    let exact = read(&moved(LINE), [60, 120]);
    let mut without = exact.clone();
    for point in &mut without.measurement.points {
        point.direction = None;
    }
    let [one, other] = [exact, without].map(|one| fitted(&one, &free_of(&LAW)));
    for (one, other) in one.estimates.iter().zip(&other.estimates) {
        let off = other.value / one.value - 1.0;
        assert!(off.abs() < 1e-3, "{}: {off:e}", one.parameter);
    }
}

/// Points without a contact between two loops have no speed, and none of the second loop is read across them.
#[test]
fn a_line_that_vanishes_has_no_speed_until_it_is_there_again() {
    let one = read(&moved(LINE), [60, 120]);
    let mut two = one.clone();
    let end = one.times[179];
    for i in 0..5 {
        two.times.push(end + 1.0 + f64::from(i));
        two.measurement.points.push(Point {
            abscissa: 0.0,
            ordinate: 0.0,
            ..one.measurement.points[179]
        });
    }
    let again = one.times.iter().map(|time| end + 10.0 + time);
    two.times.extend(again);
    two.measurement.points.extend(&one.measurement.points);
    for point in &mut two.measurement.points {
        point.direction = None;
    }
    let found = fitted(&two, &free_of(&LAW));
    assert_finds(&found, &with_law(one, LINE));
    let has_speed: Vec<bool> = (found.experiments[0].points.iter())
        .map(|point| point.line_speed.is_some())
        .collect();
    let ends = [0..3, 177..188, 362..365];
    for (i, has_speed) in has_speed.into_iter().enumerate() {
        assert_eq!(has_speed, !ends.iter().any(|end| end.contains(&i)), "{i}");
    }
}

#[test]
fn speeds_that_are_given_are_taken() {
    let exact = with_law(read(&moved(LINE), [30, 60]), LINE);
    let contact = contact();
    let law = RateDependent::new(LINE[0], LINE[1], LINE[2]).expect("physical");
    let mut given = exact.clone();
    given.times.clear();
    given.line_speeds = vec![
        LineSpeed {
            speed: 3e-6,
            ..LineSpeed::default()
        };
        90
    ];
    let predictions = given
        .predictions(Table::embedded(), None, &[])
        .expect("sound");
    let energy = law.energy_release_rate(3e-6).expect("finite");
    for (point, load) in exact.measurement.points.iter().zip(predictions.ordinates) {
        let expected = contact.load(point.abscissa, energy).expect("in the table");
        assert_eq!(load, expected);
    }
}

#[test]
fn derivatives_with_a_law_are_differences() {
    let mut experiment = with_law(read(&moved(LINE), [30, 60]), LINE);
    for kind in [Kind::LoadRadius, Kind::PenetrationRadius] {
        experiment.measurement.kind = kind;
        experiment.work_of_adhesion_receding = Some(0.06);
        let branches = experiment.branches(&[]).expect("sound");
        let parameters = [&LAW[..], &[WorkOfAdhesionReceding]].concat();
        let at = |experiment: &Experiment, by: &[Parameter]| {
            experiment
                .predictions(Table::embedded(), Some(&branches), by)
                .expect("sound")
        };
        let here = at(&experiment, &parameters);
        for (column, &parameter) in parameters.iter().enumerate() {
            let value = experiment.get(parameter).expect("a value");
            let [before, after] = [-1e-5, 1e-5].map(|part| {
                let mut moved = experiment.clone();
                moved
                    .set(parameter, value * (1.0 + part))
                    .expect("physical");
                at(&moved, &[]).ordinates
            });
            let own = |i: usize| here.derivatives[i * parameters.len() + column];
            let differences: Vec<f64> = (0..before.len())
                .map(|i| (after[i] - before[i]) / (2e-5 * value))
                .collect();
            let size = differences
                .iter()
                .fold(0.0, |most: f64, one| most.max(one.abs()));
            assert!(size > 0.0, "{parameter}");
            for (i, difference) in differences.iter().enumerate() {
                let is_in_contact = !difference.is_nan();
                let off = (own(i) - difference).abs() / size;
                assert!(!is_in_contact || off < 1e-6, "{parameter}, {i}: {off:e}");
            }
        }
    }
}

/// One way at one speed tells the product of the work of adhesion and its factor only; both ways tell the law.
#[test]
fn a_forecast_tells_what_one_speed_does_not() {
    let mut experiment = with_law(
        Experiment::new(
            measurement_at(
                Kind::LoadRadius,
                (0..20).map(|i| 6e-5 + 4e-6 * f64::from(i)),
            ),
            half_space(2e-3, f64::INFINITY, solid(2e6, 0.5)),
        ),
        LINE,
    );
    experiment.times = (0..20).map(f64::from).collect();
    experiment.noise = Some(2e-6);
    let free = free_of(&LAW[..3]);
    let one = forecast(Table::embedded(), &[experiment.clone()], &free).expect("sound");
    assert_eq!(one.undetermined.len(), 1);
    let back = experiment.measurement.points.clone();
    experiment.measurement.points.extend(back.into_iter().rev());
    experiment.times = (0..40).map(f64::from).collect();
    let both = forecast(Table::embedded(), &[experiment.clone()], &free).expect("sound");
    assert!(both.undetermined.is_empty());
    let made = simulate(Table::embedded(), &experiment, 2e-6, 1).expect("sound");
    let found = fitted(&made, &free);
    for (found, expected) in found.estimates.iter().zip(&both.estimates) {
        let errors = found.standard_error / expected.standard_error;
        assert!(
            (0.9..1.1).contains(&errors),
            "{}: {errors}",
            found.parameter
        );
        let off = (found.value - expected.value) / expected.standard_error;
        assert!(off.abs() < 4.0, "{}: {off}", found.parameter);
    }
}

#[test]
fn what_a_law_needs_is_named() {
    let exact = read(&moved(LINE), [10, 20]);
    let refused = |change: fn(&mut Experiment), free: &[Parameter], words: &str| {
        let mut experiment = exact.clone();
        change(&mut experiment);
        fit_all(&[experiment], &free_of(free)).refused(words);
    };
    refused(
        |one| one.times.clear(),
        &LAW,
        "no times; speed of the contact line; give each point its time",
    );
    refused(|one| one.times[4] = 0.0, &LAW, "line 5; times must rise");
    refused(
        |one| one.times[29] = f64::INFINITY,
        &LAW,
        "line 30; time = inf; finite",
    );
    refused(
        |one| one.times[0] = f64::NEG_INFINITY,
        &LAW,
        "line 1; time = -inf; finite",
    );
    refused(
        |one| one.times.truncate(3),
        &LAW,
        "the number of times; 3; 30",
    );
    refused(
        |_| (),
        &LAW[..3],
        "speed-exponent; not given; each given or free",
    );
    refused(
        |one| {
            one.doubling_speed = Some(-1e-6);
            one.speed_exponent = Some(0.5);
        },
        &LAW[..2],
        "doubling-speed; -1e-6; positive",
    );
    refused(
        |one| one.measurement.kind = Kind::LoadPenetration,
        &[
            FilmModulus,
            WorkOfAdhesion,
            ContactPoint,
            DoublingSpeed,
            SpeedExponent,
        ],
        "doubling-speed cannot be found; contact radii in time",
    );
    refused(
        |one| {
            one.bodies.solver = Solver::Stick {
                sphere_poisson_ratio: 0.5,
                advancing: 1.0,
            };
        },
        &LAW,
        "full friction; without friction",
    );
    let speeds = |speed: f64, deviation: f64| {
        let one = LineSpeed {
            speed,
            deviation,
            ..LineSpeed::default()
        };
        vec![one; 30]
    };
    for (line_speeds, words) in [
        (
            speeds(f64::NAN, 0.0),
            "speed of the contact line; NaN; finite",
        ),
        (speeds(1e-6, -1.0), "-1.0; standard deviation"),
        (
            speeds(1e-6, 0.0)[..7].to_vec(),
            "the number of speeds; 7; 30",
        ),
    ] {
        let experiment = Experiment {
            line_speeds,
            ..exact.clone()
        };
        fit_all(&[experiment], &free_of(&LAW)).refused(words);
    }
    let law = [FilmModulus, DoublingSpeed, SpeedExponent];
    refused(
        |one| one.work_of_adhesion = 0.0,
        &law,
        "doubling-speed; work of adhesion is 0; free it",
    );
    let few = fit_all(&[read(&moved(LINE), [3, 6])], &LAW.map(Free::new));
    few.refused("usable points; 9 more lie at the ends; at least some 30 of each way");
    let mut plan = with_law(read(&moved(LINE), [3, 6]), LINE);
    plan.noise = Some(2e-6);
    forecast(Table::embedded(), &[plan], &free_of(&LAW)).refused("9 more lie at the ends");
}
