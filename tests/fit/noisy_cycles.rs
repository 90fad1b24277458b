//! Cycles of approach and retract whose noise hides where contacts begin and end.

use acceptance::{Contacts, rigid_probe, solid};
use fit::{Bodies, Direction, Experiment, Kind, Parameter, WarningKind, simulate};
use interp::{Elastic, Probe, System, Table};

use crate::imagined::{
    FORCE_CURVE, assert_warned, assert_warns, fit_with, free_of, measurement_at, off,
};

/// A rigid sphere on a film on a stiff substrate.
fn system(radius: f64, film: Elastic, thickness: f64) -> System {
    let probe = Probe::Paraboloid { radius };
    rigid_probe(probe, film, thickness, solid(2e11, 0.25))
}

/// Plans a cycle of as many points on each way, from the first height to the second and back.
fn cycle(system: System, [from, to]: [f64; 2], count: u32, noise: f64) -> Experiment {
    let height = |i: u32| from + (to - from) * f64::from(i) / f64::from(count - 1);
    let heights = (0..count).chain((0..count).rev()).map(height);
    let mut measurement = measurement_at(Kind::ForceHeight, heights);
    for (i, point) in (0..).zip(&mut measurement.points) {
        point.direction = Some(if i < count {
            Direction::Approach
        } else {
            Direction::Retract
        });
    }
    Experiment {
        noise: Some(noise),
        ..Experiment::new(measurement, Bodies::coated(&system))
    }
}

/// Plans a cycle of a small sphere on a film of 1 MPa and 1 um, with a work of adhesion of 5 mJ/m^2.
fn on_a_thin_film(noise: f64) -> Experiment {
    let system = system(3e-6, solid(1e6, 0.5), 1e-6);
    Experiment {
        work_of_adhesion: 5e-3,
        stiffness: Some(0.5),
        ..cycle(system, [300e-9, -100e-9], 150, noise)
    }
}

/// Returns how many standard errors a work of adhesion is off that is found from data of a plan.
fn off_by(plan: &Experiment, seed: u64) -> f64 {
    let noise = plan.noise.expect("planned");
    let measured = Experiment {
        contact_point: 0.0,
        baseline: 0.0,
        ..simulate(Table::embedded(), plan, noise, seed).expect("in the table")
    };
    let found = fit_with(&measured, &free_of(&FORCE_CURVE), |options| {
        options.allow_left_out = true;
    });
    off(
        &found.expect("a fit"),
        Parameter::WorkOfAdhesion,
        plan.work_of_adhesion,
    )
}

/// Without the points beyond the end of its branch a fit may end ever earlier, at ever smaller works of adhesion, with
/// errors that are too small.
#[test]
fn points_beyond_the_end_of_a_fit_hold_it() {
    let plan = |count, noise| Experiment {
        work_of_adhesion: 8e-5,
        stiffness: Some(0.02),
        contact_point: 1e-7,
        baseline: 1e-9,
        ..cycle(
            system(1e-5, solid(2e4, 0.5), 5e-6),
            [0.6e-6, -0.3e-6],
            count,
            noise,
        )
    };
    let seen = off_by(&plan(100, 1.5e-10), 31_001);
    assert!(seen.abs() < 2.0, "{seen}");
    let noisy = plan(40, 3e-10);
    let low = (0..60)
        .map(|seed| off_by(&noisy, seed))
        .filter(|off| *off < -3.0);
    let low = low.count();
    println!("{low} of 60 works of adhesion are too small by more than three standard errors");
    assert!(low <= 3, "{low}");
}

/// A contact that detaches slowly has points in contact where the model has none. They are left out, or they would move
/// all values by many standard errors, the more points of baseline there are.
#[test]
fn points_of_a_slow_detachment_do_not_hold_a_fit() {
    let plan = on_a_thin_film(4e-10);
    let made = |noise, seed| {
        let made = simulate(Table::embedded(), &plan, noise, seed);
        made.expect("in the table").measurement
    };
    let exact = made(1e-16, 0).points.into_iter().enumerate();
    let (last, least) = exact
        .map(|(i, point)| (i, point.ordinate))
        .min_by(|(_, one), (_, other)| one.total_cmp(other))
        .expect("points");
    for seed in 0..12 {
        let mut measurement = made(4e-10, seed);
        for (point, part) in measurement.points[last + 1..]
            .iter_mut()
            .zip([0.9, 0.7, 0.5])
        {
            point.ordinate = part * least;
        }
        let measured = Experiment {
            measurement,
            ..plan.clone()
        };
        let found = fit_with(&measured, &free_of(&FORCE_CURVE), |_| ()).expect("a fit");
        for (parameter, truth) in [
            (Parameter::FilmModulus, 1e6),
            (Parameter::WorkOfAdhesion, 5e-3),
        ] {
            let off = off(&found, parameter, truth);
            assert!(off.abs() < 4.0, "{seed}: {parameter} is off by {off}");
        }
    }
}

/// A retract of many points beside an approach of few, under noise: the approach alone may tell no modulus.
#[test]
fn a_start_is_found_where_the_approach_is_short() {
    let plan = on_a_thin_film(4e-9);
    let squares = (0..20).map(|seed| off_by(&plan, seed).powi(2)).sum::<f64>() / 20.0;
    println!("mean square of errors in standard errors {squares:.2}");
    assert!(squares < 4.0, "{squares}");
}

/// The noise of the cycles on a soft film, N.
const NOISE: f64 = 3e-11;

/// Plans a cycle on a film of 20 kPa and 5 um with a long baseline.
fn on_a_soft_film() -> Experiment {
    Experiment {
        work_of_adhesion: 8e-5,
        stiffness: Some(0.02),
        ..cycle(
            system(1e-5, solid(2e4, 0.5), 5e-6),
            [0.6e-6, -0.5e-6],
            400,
            NOISE,
        )
    }
}

/// A filter makes the noise of neighbours alike, and their differences show little of it: the scatter of the readings
/// without contact tells which of them are in contact.
#[test]
fn filtered_noise_does_not_hide_the_baseline() {
    const WIDTH: f64 = 2.0;
    const REACH: usize = 8;
    let weights: Vec<f64> = (0..=2 * REACH)
        .map(|i| (i as f64 - REACH as f64) / WIDTH)
        .map(|x| (-0.5 * x * x).exp())
        .collect();
    let norm = weights
        .iter()
        .map(|weight| weight * weight)
        .sum::<f64>()
        .sqrt();
    let plan = on_a_soft_film();
    for seed in 0..6 {
        let exact = simulate(Table::embedded(), &plan, 1e-20, seed).expect("in the table");
        let mut numbers = Contacts::new(seed);
        let white: Vec<f64> = (0..exact.measurement.points.len() + 2 * REACH)
            .map(|_| numbers.normal())
            .collect();
        let mut measured = Experiment {
            noise: None,
            ..exact
        };
        let around = white.windows(weights.len());
        for (point, around) in measured.measurement.points.iter_mut().zip(around) {
            let sum: f64 = around
                .iter()
                .zip(&weights)
                .map(|(x, weight)| x * weight)
                .sum();
            point.ordinate += NOISE * sum / norm;
        }
        let found = fit_with(&measured, &free_of(&FORCE_CURVE), |_| {}).expect("a fit");
        for (parameter, truth, allowed) in [
            (Parameter::FilmModulus, 2e4, 0.05),
            (Parameter::WorkOfAdhesion, 8e-5, 0.05),
        ] {
            let value = found.estimate(parameter).expect("free").value;
            assert!(
                (value / truth - 1.0).abs() < allowed,
                "{parameter:?}: {value}"
            );
        }
        assert_warned(&found, WarningKind::PoorFit);
    }
}

/// The drag of a liquid has another sign on each way. A second work of adhesion would take it for hysteresis.
#[test]
fn baselines_of_two_ways_that_differ_are_told() {
    let plan = on_a_soft_film();
    let mut data = simulate(Table::embedded(), &plan, NOISE, 1).expect("in the table");
    for point in &mut data.measurement.points {
        let is_retract = point.direction == Some(Direction::Retract);
        point.ordinate += if is_retract { -1e-10 } else { 1e-10 };
    }
    let hysteresis = [&FORCE_CURVE[..], &[Parameter::WorkOfAdhesionReceding]].concat();
    for (free, kind, words) in [
        (
            &FORCE_CURVE[..],
            WarningKind::MixedBranches,
            "their baselines are; e-10 N apart; fit one direction alone",
        ),
        (
            &hysteresis[..],
            WarningKind::Hysteresis,
            "the baselines of the two ways are; drag; fit one direction alone",
        ),
    ] {
        let found = fit_with(&data, &free_of(free), |_| {}).expect("a fit");
        assert_warns(&found, kind, words);
    }
}
