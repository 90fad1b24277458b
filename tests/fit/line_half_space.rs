//! Adhesion that depends on the speed of the contact line: under a load that changes in steps, after each of which the line
//! moves fast, then ever more slowly; and on the retract only. The truth is a half-space of JKR, by its closed forms.

use std::f64::consts::PI;

use acceptance::{Refused, half_space_of, solid};
use fit::{Bodies, Direction, Experiment, Fit, Kind, Parameter, Point};
use interp::Probe;

use crate::imagined::{fit_with, fitted, free_of, measurement, off};
use crate::line_speed::{LAW, LINE, moved, read, with_noise};

/// The reduced modulus (Pa) and the radius of the lens (m).
const REDUCED: f64 = 2e6 / 0.75;
const LENS: f64 = 2e-3;
/// The standard deviations of a radius (m) and of a load (N).
const NOISE: [f64; 2] = [2e-7, 2e-6];
/// How long a load is held, s.
const HELD: f64 = 20.0;

/// Returns the rate of the contact radius `a` under a load, m/s: the energy release rate over the work of adhesion tells
/// the speed of a line that recedes, and its inverse that of one that advances.
fn rate(a: f64, load: f64) -> f64 {
    let [w, v0, n] = LINE;
    let pressed = 4.0 * REDUCED * a.powi(3) / (3.0 * LENS);
    let ratio = (pressed - load).powi(2) / (8.0 * PI * REDUCED * a.powi(3) * w);
    let speed = v0 * (ratio.max(ratio.recip()) - 1.0).powf(1.0 / n);
    if ratio > 1.0 { -speed } else { speed }
}

/// Adds what one image sees.
fn add(points: &mut Vec<Point>, [abscissa, ordinate]: [f64; 2], direction: Direction) {
    points.push(Point {
        line: points.len() as u64 + 1,
        abscissa,
        ordinate,
        direction: Some(direction),
    });
}

/// Makes an experiment on the half-space, of which the noise is known.
fn experiment(points: Vec<Point>, times: Vec<f64>) -> Experiment {
    let lens = Probe::Paraboloid { radius: LENS };
    let bodies = half_space_of(lens, f64::INFINITY, solid(2e6, 0.5));
    let measured = measurement(Kind::LoadRadius, points);
    Experiment {
        times,
        abscissa_noise: NOISE[0],
        noise: Some(NOISE[1]),
        ..Experiment::new(measured, Bodies::half_space(bodies))
    }
}

/// What a camera of so many `images` for each step of the load sees: ten steps of 1 mN up, and nine down.
fn seen(images: usize) -> Experiment {
    const SUBSTEPS: usize = 2000;
    let up = (1..=10).map(|i| (1e-3 * f64::from(i), Direction::Approach));
    let down = (1..10).map(|i| (1e-3 * f64::from(i), Direction::Retract));
    let (mut points, mut times) = (Vec::new(), Vec::new());
    // The contact of JKR without a load.
    let mut a = (6.0 * PI * LINE[0] * LENS * LENS * 0.75 / REDUCED).cbrt();
    let dt = HELD / (images * SUBSTEPS) as f64;
    for (step, (load, direction)) in up.chain(down.rev()).enumerate() {
        for image in 0..images {
            for substep in 0..SUBSTEPS {
                if substep == SUBSTEPS / 2 {
                    add(&mut points, [a, load], direction);
                    times.push(HELD * (step as f64 + (image as f64 + 0.5) / images as f64));
                }
                let middle = a + 0.5 * dt * rate(a, load);
                a += dt * rate(middle, load);
            }
        }
    }
    experiment(points, times)
}

/// Read across the steps, speeds make the doubling speed too small by 4.4 standard errors on average with 8 images, and by
/// 2.1 with 15. Now they do by 0.5 and 1.0.
#[test]
fn speeds_are_not_read_across_steps_of_the_load() {
    const SETS: u64 = 16;
    for images in [8, 15] {
        let exact = seen(images);
        let off = |seed| {
            let found = fitted(&with_noise(exact.clone(), NOISE, seed), &free_of(&LAW));
            off(&found, Parameter::DoublingSpeed, LINE[1])
        };
        let mean = (0..SETS).map(off).sum::<f64>() / SETS as f64;
        assert!(mean.abs() < 1.4, "{images}: {mean}");
    }
}

/// Returns how many points have no speed of the line: three at each end of two ways are 12.
fn without_speed(found: &Fit) -> usize {
    let points = found.experiments[0].points.iter();
    points.filter(|point| point.line_speed.is_none()).count()
}

/// Where the camera pauses, the load of a steady ramp changes by more between two images than between others.
#[test]
fn a_pause_of_the_camera_is_no_step_of_the_load() {
    let mut paused = read(&moved(LINE), [60, 120]);
    let is_kept = |i: usize| !(20..35).contains(&i);
    let points = paused.measurement.points.into_iter().enumerate();
    let points = points.filter(|(i, _)| is_kept(*i));
    paused.measurement.points = points.map(|(_, point)| point).collect();
    let times = paused.times.into_iter().enumerate();
    paused.times = times
        .filter(|(i, _)| is_kept(*i))
        .map(|(_, time)| time)
        .collect();
    assert_eq!(without_speed(&fitted(&paused, &free_of(&LAW))), 12);
}

/// Loads of a ramp that are rounded to steps of five images change no speed.
#[test]
fn rounded_loads_are_no_steps() {
    let mut rounded = read(&moved(LINE), [100, 160]);
    for point in &mut rounded.measurement.points {
        point.ordinate = 4e-4 * (point.ordinate / 4e-4).round();
    }
    assert_eq!(without_speed(&fitted(&rounded, &free_of(&LAW))), 12);
}

#[test]
fn too_few_images_of_each_step_are_refused() {
    let measured = with_noise(seen(5), NOISE, 1);
    let refused = fit_with(&measured, &free_of(&LAW), |_| ());
    refused.refused("0 usable points; 95 more; at sudden steps; 15 of each step");
}

/// The approach at rest's work of adhesion and a retract by the law, which ends at the pull-off.
fn dependent_on_retract() -> Experiment {
    const IMAGES: usize = 130;
    const WAY: f64 = 60.0;
    const MOST: f64 = 0.032;
    const SUBSTEPS: usize = 1000;
    let pull = 3.0 * PI * LINE[0] * LENS;
    let at_rest = |load: f64| {
        let root = (2.0 * pull * load + pull * pull).sqrt();
        (0.75 * LENS / REDUCED * (load + pull + root)).cbrt()
    };
    let (mut points, mut times) = (Vec::new(), Vec::new());
    for image in 0..IMAGES {
        let part = (image as f64 + 0.5) / IMAGES as f64;
        let load = MOST * part;
        add(&mut points, [at_rest(load), load], Direction::Approach);
        times.push(WAY * part);
    }
    let (mut a, mut step) = (at_rest(MOST), 0);
    let dt = WAY / (IMAGES * SUBSTEPS) as f64;
    while a > 9e-5 {
        let time = dt * f64::from(step);
        let load = MOST * (1.0 - time / WAY);
        if step as usize % SUBSTEPS == SUBSTEPS / 2 {
            add(&mut points, [a, load], Direction::Retract);
            times.push(WAY + time);
        }
        let middle = a + 0.5 * dt * rate(a, load);
        a += dt * rate(middle, load);
        step += 1;
    }
    experiment(points, times)
}

/// A line that advances at rest's work of adhesion is described as well by twice this work and a doubling speed that is nine
/// times as large. Works of adhesion for ranges of the speed tell it in 6 of these 12 sets, and the retract alone in 3 more.
#[test]
fn a_law_that_holds_for_the_retract_only_is_doubted() {
    const LARGE: [f64; 2] = [2.8e-7, 8e-5];
    let exact = dependent_on_retract();
    let is_doubted = |seed: &u64| {
        let mut measured = with_noise(exact.clone(), LARGE, *seed);
        (measured.abscissa_noise, measured.noise) = (LARGE[0], Some(LARGE[1]));
        let found = fitted(&measured, &free_of(&LAW));
        let words = "adhesion does not follow this law of the speed of the contact line";
        found.warnings.iter().any(|one| one.text.contains(words))
    };
    let doubted = (0..12).filter(is_doubted).count();
    assert!(doubted >= 8, "{doubted} of 12");
}
