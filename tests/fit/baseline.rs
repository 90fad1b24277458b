//! Where the contact ends in force curves: baselines at any level and of any length, spikes on them, and waves
//! below their noise.

use std::f64::consts::PI;

use acceptance::{Contacts, half_space_of, solid};
use fit::{Bodies, Branch, Direction, Experiment, Fit, Kind, Parameter, Point, WarningKind};
use interp::Probe;

use crate::imagined::{
    Course, FORCE_CURVE, Imagined, assert_silent, assert_warned, assert_warns, fit_with, fitted,
    free_of, measurement, measurement_of, off as off_by,
};

/// The parameters of a force curve without adhesion.
const HERTZ: [Parameter; 3] = [
    Parameter::FilmModulus,
    Parameter::ContactPoint,
    Parameter::Baseline,
];

/// The reduced modulus of the gel, Pa, and the work of adhesion of closed forms, J/m^2.
const REDUCED: f64 = 2e4 / 0.75;
const WORK: f64 = 1e-3;

/// A force curve of a gel without adhesion.
fn hertz(points: [usize; 2]) -> Imagined {
    let mut hertz = Imagined::probe(Course::Cycle, 0.0, &HERTZ);
    hertz.points = points;
    hertz
}

/// Adds to the readings of all points.
fn changed(experiment: &Experiment, by: impl Fn(usize, f64) -> f64) -> Experiment {
    let mut experiment = experiment.clone();
    for (i, point) in experiment.measurement.points.iter_mut().enumerate() {
        point.ordinate += by(i, point.abscissa);
    }
    experiment
}

/// Returns how far the modulus of the film is from 20 kPa, in standard errors.
fn off(found: &Fit) -> f64 {
    off_by(found, Parameter::FilmModulus, 2e4)
}

/// Also where all points are well in contact.
#[test]
fn a_force_that_is_added_to_all_changes_the_baseline_alone() {
    for (apart, least_radius) in [(300, 1e-7), (0, 2e-6)] {
        let mut hertz = hertz([300, apart]);
        hertz.radii[0] = least_radius;
        let measured = hertz.measured(&hertz.exact(), 3);
        let here = fitted(&measured, &hertz.free);
        for level in [-1e-6, -3e-9, 1e-9, 1e-8, 1e-7] {
            let found = fitted(&changed(&measured, |_, _| level), &hertz.free);
            let moved = off(&found) - off(&here);
            assert!(moved.abs() < 0.01, "{apart}, {level}: {found:?}");
            let [here, there] =
                [&here, &found].map(|fit| fit.estimate(Parameter::Baseline).expect("free"));
            let error = there.value - level - here.value;
            let is_small = error.abs() < 0.01 * here.standard_error;
            assert!(is_small, "{apart}, {level}: {error}");
        }
    }
}

/// Gels without adhesion, whose work of adhesion is free and ends at 0. How far beyond rounding it ends, which a level of the
/// readings changes, does not matter for the errors of the others: they are those beside a work that is fixed at 0, but for
/// points where the contact begins, which are left out.
#[test]
fn errors_beside_a_work_of_adhesion_that_ended_at_zero_are_those_without_adhesion() {
    let hertz = hertz([150, 60]);
    let exact = hertz.exact();
    let error = |fit: &Fit| {
        fit.estimate(Parameter::FilmModulus)
            .map(|one| one.standard_error)
    };
    let error = |fit: &Fit| error(fit).expect("free");
    let mut ended = 0;
    for seed in 0..12 {
        let measured = hertz.measured(&exact, seed);
        let with_adhesion = |level: f64| {
            let data = changed(&measured, |_, _| level);
            let found = fit_with(&data, &free_of(&FORCE_CURVE), |options| {
                options.fixed_values = true;
            });
            found.ok().filter(|one| one.warns_of(WarningKind::AtBound))
        };
        let found = [-1e-6, 0.0, 3e-7].map(with_adhesion);
        let without = error(&fitted(&measured, &hertz.free));
        let mut found = found.iter().flatten();
        let first = found.clone().next().map(error);
        ended += found.clone().count();
        for one in found.clone() {
            assert_silent(one, WarningKind::SeveralMinima);
            // Calibrations leave it at 0, too.
            assert_silent(one, WarningKind::Calibration);
            assert!(!one.fixed_values.is_empty());
            for row in &one.fixed_values {
                let rounding = 1e-9 * one.estimates[1].standard_error;
                assert!(row.changes[1].abs() <= rounding, "{row:?}");
            }
        }
        let is_right = |error: f64| {
            let is_first = first.is_some_and(|first| (error / first - 1.0).abs() < 1e-3);
            is_first && (error / without - 1.0).abs() < 0.1
        };
        let are_right = found.all(|one| is_right(error(one)));
        assert!(are_right, "{seed}: {first:?} {without}");
    }
    assert!(ended > 9, "{ended}");
}

/// A baseline that is tilted, with a slope that is free, is told from an adhesive contact.
#[test]
fn a_slope_that_is_free_does_not_hide_where_an_adhesive_contact_ends() {
    let free = [&FORCE_CURVE[..], &[Parameter::BaselineSlope]].concat();
    let probe = Imagined::probe(Course::Cycle, 1e-4, &free);
    let exact = probe.exact();
    for slope in [-5e-3, -2e-3, -5e-4, 5e-4, 2e-3, 5e-3] {
        for seed in 0..4 {
            let measured = changed(&probe.measured(&exact, seed), |_, height| slope * height);
            let found = fitted(&measured, &probe.free);
            let off_by_slope = off_by(&found, Parameter::BaselineSlope, slope);
            let is_near = off(&found).abs() < 4.0 && off_by_slope.abs() < 4.0;
            assert!(found.converged && is_near, "{slope}, {seed}: {found:?}");
            assert_silent(&found, WarningKind::PoorFit);
        }
    }
}

#[test]
fn a_ramp_may_begin_far_from_the_surface() {
    for (times, apart) in [(3.0, 500), (15.0, 100), (50.0, 2000)] {
        let hertz = hertz([40, apart]);
        let mut exact = hertz.exact();
        let touch = hertz.truth.contact_point;
        let heights = exact.points.iter_mut().map(|point| &mut point.abscissa);
        for height in heights.filter(|height| **height > touch) {
            *height = touch + times * (*height - touch);
        }
        for level in [0.0, 5e-9] {
            let measured = changed(&hertz.measured(&exact, 5), |_, _| level);
            let found = fitted(&measured, &hertz.free);
            let is_near = found.converged && off(&found).abs() < 4.0;
            assert!(is_near, "{times}, {level}: {found:?}");
        }
    }
}

/// A pull-off is where the force stays down before it and up after it.
#[test]
fn a_spike_on_the_baseline_is_no_pull_off() {
    let probe = Imagined::probe(Course::Cycle, 1e-4, &FORCE_CURVE);
    let exact = probe.exact();
    let baseline = |i: &usize| exact.points[*i].abscissa > 2e-6;
    let far: Vec<usize> = (0..exact.points.len()).filter(baseline).collect();
    let measured = probe.measured(&exact, 2);
    for (place, height) in [
        (0.1, -3e-9),
        (0.3, 2e-8),
        (0.6, -2e-8),
        (0.8, -3e-9),
        (0.95, 3e-9),
    ] {
        let spike = far[(place * far.len() as f64) as usize];
        for width in [1, 2] {
            let is_hit = |i: usize| (spike..spike + width).contains(&i);
            let with = changed(&measured, |i, _| if is_hit(i) { height } else { 0.0 });
            let found = fitted(&with, &probe.free);
            let off = off(&found);
            assert!(off.abs() < 4.0, "{place}, {height}, {width}: {off}");
            assert_warned(&found, WarningKind::Outliers);
        }
    }
}

/// Light that the sample reflects makes such a wave.
#[test]
fn a_wave_below_the_noise_is_told_of() {
    let hertz = hertz([300, 300]);
    let exact = hertz.exact();
    let mut told = 0;
    for seed in 0..8_u32 {
        let measured = hertz.measured(&exact, seed.into());
        let plain = fitted(&measured, &hertz.free);
        assert_silent(&plain, WarningKind::StructuredResiduals);
        let wave = |height: f64| (height / 1.5e-7 + f64::from(seed)).sin();
        let waved = changed(&measured, |_, height| 0.5 * hertz.noise * wave(height));
        told += u32::from(fitted(&waved, &hertz.free).warns_of(WarningKind::StructuredResiduals));
    }
    assert!(told > 6, "{told} of 8");
}

/// The load of a flat punch is straight: with a slope that is free, too, it is a contact to its end.
#[test]
fn a_contact_that_is_straight_to_its_end_is_no_baseline() {
    let mut random = Contacts::new(1);
    let probe = Probe::FlatPunch { radius: 1e-5 };
    let mut load = |depth: f64| 2.0 * 1e-5 * 1e6 * depth + 1e-9 * random.normal();
    let points = (1..=100).map(|i| {
        let depth = 1e-8 * f64::from(i);
        [depth, load(depth)]
    });
    let points: Vec<[f64; 2]> = points.collect();
    let bodies = Bodies::half_space(half_space_of(probe, f64::INFINITY, solid(7.5e5, 0.5)));
    let mut experiment = Experiment::new(measurement_of(Kind::LoadPenetration, points), bodies);
    experiment.work_of_adhesion = 1.0;
    let branches = experiment.branches(&[Parameter::FilmModulus, Parameter::BaselineSlope]);
    assert_eq!(branches.expect("sound"), [Branch::Advancing; 100]);
}

/// A cycle of penetrations and loads, exact: what the approach and the retract go through.
type Ways = [Vec<[f64; 2]>; 2];

/// A cycle under a punch of 5 um that comes off, by the closed form of JKR. Its approach has no jump.
fn under_a_punch(points_before: i32) -> (Probe, Ways) {
    let probe = Probe::FlatPunch { radius: 5e-6 };
    let step = |i: i32| 5e-9 * f64::from(i);
    let contact = |depth: f64| [depth, 2.0 * 5e-6 * REDUCED * depth];
    let approach = (-points_before..400).map(|i| contact(step(i).max(0.0)));
    let approach = approach
        .zip(-points_before..)
        .map(|([_, load], i)| [step(i), load]);
    // It comes off at -1.084 um.
    let retract = (-400..400).rev().map(step);
    let retract = retract.map(|x| if x < -1.084e-6 { [x, 0.0] } else { contact(x) });
    (probe, [approach.collect(), retract.collect()])
}

/// A cycle under a cone, which jumps into contact at first touch, by the closed form of JKR. Its retract ends in contact.
fn under_a_cone(points_before: i32, work: f64) -> (Probe, Ways) {
    let half_angle = 70_f64.to_radians();
    let contact = |a: f64| {
        let depth = PI / 2.0 * a / half_angle.tan();
        let [opened, pulled] = [
            2.0 * PI * a * work / REDUCED,
            8.0 * PI * a.powi(3) * REDUCED * work,
        ];
        [depth - opened.sqrt(), REDUCED * depth * a - pulled.sqrt()]
    };
    let radii =
        |from: f64, to: f64| (0..400).map(move |i| from + (to - from) * f64::from(i) / 399.0);
    let before = (1..=points_before)
        .rev()
        .map(|i| [-5e-9 * f64::from(i), 0.0]);
    // The penetration is 0 at the first radius.
    let first = 2.0 * PI * work / REDUCED * (half_angle.tan() * 2.0 / PI).powi(2);
    let approach = before.chain(radii(first, 6e-6).map(contact));
    let retract = radii(6e-6, 4e-6).map(contact);
    (
        Probe::Cone { half_angle },
        [approach.collect(), retract.collect()],
    )
}

/// Fits a cycle with noise. The load on a punch does not tell the work of adhesion.
fn fitted_cycle((probe, ways): &(Probe, Ways), noise: f64, seed: u64) -> Fit {
    let free = match probe {
        Probe::FlatPunch { .. } => &HERTZ[..],
        _ => &FORCE_CURVE,
    };
    let mut random = Contacts::new(seed);
    let ways = ways.iter().zip(Direction::ALL);
    let states = ways.flat_map(|(way, direction)| way.iter().map(move |state| (state, direction)));
    let points = (1..)
        .zip(states)
        .map(|(line, ([x, load], direction))| Point {
            line,
            abscissa: x + 1e-7,
            ordinate: load + 3e-9 + noise * random.normal(),
            direction: Some(direction),
        });
    let measured = measurement(Kind::LoadPenetration, points.collect());
    let bodies = half_space_of(probe.clone(), f64::INFINITY, solid(2e4, 0.5));
    let mut experiment = Experiment::new(measured, Bodies::half_space(bodies));
    experiment.work_of_adhesion = WORK;
    experiment.noise = Some(noise);
    fitted(&experiment, &free_of(free))
}

/// A contact that begins without a jump, or with one that the noise hides or that lies within the end which is looked at
/// first, may have few points before it.
#[test]
fn a_short_baseline_before_an_approach_is_found() {
    for (name, cycle, noise) in [
        ("corner", under_a_punch(35), 1e-9),
        ("jump", under_a_cone(35, WORK), 2e-10),
        ("hidden jump", under_a_cone(60, WORK), 1.3e-9),
    ] {
        for seed in 10..14 {
            let found = fitted_cycle(&cycle, noise, seed);
            let off = [off(&found), off_by(&found, Parameter::ContactPoint, 1e-7)];
            let is_near = off.iter().all(|off| off.abs() < 4.0);
            assert!(is_near, "{name}, {seed}: {off:?}, {:?}", found.warnings);
            assert_silent(&found, WarningKind::PoorFit);
        }
    }
}

/// Of 40 such cycles this one leads to no adhesion at first, from where the logarithm of its work does not come back.
#[test]
fn a_work_of_adhesion_that_ended_at_zero_is_sought_again() {
    let found = fitted_cycle(&under_a_cone(120, 1e-4), 4e-10, 23);
    let off = off_by(&found, Parameter::WorkOfAdhesion, 1e-4);
    assert!(off.abs() < 3.0, "{:?}", found.estimates);
    assert_silent(&found, WarningKind::AtBound);
}

/// Where a retract ends at its largest tension, its end is as flat as a baseline. A baseline that goes on tells it.
#[test]
fn the_largest_tension_at_the_end_of_a_retract_is_doubted() {
    let mut probe = Imagined::probe(Course::Retract, 2e-3, &FORCE_CURVE);
    probe.truth.stiffness = Some(20.0);
    probe.truth.baseline = 0.0;
    probe.noise = 1.5e-8;
    probe.radii = [5e-6, 12e-6];
    let fitted = |baseline: usize, seed: u64, free: &[Parameter]| {
        let probe = Imagined {
            points: [60, baseline],
            ..probe.clone()
        };
        fitted(&probe.measured(&probe.exact(), seed), &free_of(free))
    };
    for seed in [1, 3, 4, 5] {
        let found = fitted(0, seed, &FORCE_CURVE);
        let words = "baseline; -1.; may be the largest tension; keep the baseline fixed at 0";
        assert_warns(&found, WarningKind::ZeroNotSeen, words);
        // It is 1.9e-7 N. Of the work of adhesion less than a fifth is found.
        let work = found.estimate(Parameter::WorkOfAdhesion).expect("free");
        assert!(work.value < 4e-4, "{work:?}");
        let found = fitted(0, seed, &FORCE_CURVE[..3]);
        let words = "no point is off contact; 1 % of the largest load; free baseline";
        assert_warns(&found, WarningKind::ZeroNotSeen, words);
        assert!(off_by(&found, Parameter::WorkOfAdhesion, 2e-3).abs() < 4.0);
        for free in [&FORCE_CURVE[..], &FORCE_CURVE[..3]] {
            assert_silent(&fitted(60, seed, free), WarningKind::ZeroNotSeen);
        }
    }
}
