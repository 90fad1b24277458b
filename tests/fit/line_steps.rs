//! Adhesion that depends on the speed of the contact line, under a load that changes in steps: after each the line moves
//! fast, then ever more slowly. The truth is a half-space of JKR, by its closed forms.

use std::f64::consts::PI;

use acceptance::{Refused, half_space_of, solid};
use fit::{Bodies, Direction, Experiment, Kind, Parameter, Point};
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
                    points.push(Point {
                        line: points.len() as u64 + 1,
                        abscissa: a,
                        ordinate: load,
                        direction: Some(direction),
                    });
                    times.push(HELD * (step as f64 + (image as f64 + 0.5) / images as f64));
                }
                let middle = a + 0.5 * dt * rate(a, load);
                a += dt * rate(middle, load);
            }
        }
    }
    let bodies = half_space_of(
        Probe::Paraboloid { radius: LENS },
        f64::INFINITY,
        solid(2e6, 0.5),
    );
    let measured = measurement(Kind::LoadRadius, points);
    Experiment {
        times,
        abscissa_noise: NOISE[0],
        noise: Some(NOISE[1]),
        ..Experiment::new(measured, Bodies::half_space(bodies))
    }
}

/// Read across the steps, speeds make the doubling speed too small by 4.4 standard errors on average with 8 images, and by
/// 2.1 with 15.
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
    let found = fitted(&paused, &free_of(&LAW));
    let points = found.experiments[0].points.iter();
    assert_eq!(
        points.filter(|point| point.line_speed.is_none()).count(),
        12
    );
}

#[test]
fn too_few_images_of_each_step_are_refused() {
    let measured = with_noise(seen(5), NOISE, 1);
    let refused = fit_with(&measured, &free_of(&LAW), |_| ());
    refused.refused("0 usable points; 95 more; at sudden steps; 15 of each step");
}
