//! Loops between loading and unloading that the model cannot make, and what remains afterwards.

use std::f64::consts::PI;

use acceptance::{Contacts, on_half_space, prony, solid};
use contact::Control;
use fit::{Direction, Experiment, Fit, Kind, Measurement, Parameter, Point, WarningKind};
use interp::Probe;

use crate::imagined::{
    Course, FORCE_CURVE, Imagined, LENS, assert_no_doubts, assert_silent, assert_warned,
    assert_warns, fit_with, free_of, half_space, lens, measurement, number_after, off, text,
};

const RADIUS: f64 = 10e-6;
/// What a cycle without adhesion tells.
const HERTZ: [Parameter; 3] = [
    Parameter::FilmModulus,
    Parameter::ContactPoint,
    Parameter::LoadOffset,
];

fn fitted(experiment: &Experiment, free: &[Parameter]) -> Fit {
    fit_with(experiment, &free_of(free), |_| ()).expect("sound")
}

/// Returns the energy that the warning of a loop states, J.
fn energy(found: &Fit) -> f64 {
    let text = text(found, WarningKind::Hysteresis);
    let before = text.split(" J").next().expect("a part");
    let word = before.rsplit(' ').next().expect("a word");
    word.parse()
        .unwrap_or_else(|_| panic!("{word:?} in {text}"))
}

/// Makes loads at penetrations of both ways, on a soft half-space under a rigid sphere, with noise.
fn pressed(
    loading: impl Fn(f64) -> f64,
    unloading: impl Fn(f64) -> f64,
    [deepest, noise]: [f64; 2],
    seed: u64,
) -> Experiment {
    const COUNT: usize = 100;
    let mut random = Contacts::new(seed);
    let mut points = Vec::new();
    for direction in Direction::ALL {
        for i in 0..COUNT {
            // A tenth of the way is before contact.
            let part = i as f64 / (COUNT - 1) as f64;
            let part = if direction == Direction::Approach {
                part
            } else {
                1.0 - part
            };
            let abscissa = deepest * (1.1 * part - 0.1);
            let load = match direction {
                Direction::Approach => loading(abscissa),
                Direction::Retract => unloading(abscissa),
            };
            points.push(Point {
                line: points.len() as u64 + 2,
                abscissa,
                ordinate: load + noise * random.normal(),
                direction: Some(direction),
            });
        }
    }
    let measured: Measurement = measurement(Kind::LoadPenetration, points);
    Experiment::new(measured, half_space(RADIUS, f64::INFINITY, solid(1e4, 0.5)))
}

/// Hertz's load on a half-space of a reduced modulus.
fn hertz(modulus: f64, penetration: f64) -> f64 {
    4.0 / 3.0 * modulus * RADIUS.sqrt() * penetration.max(0.0).powf(1.5)
}

/// The area under a curve from a fine grid.
fn area(curve: impl Fn(f64) -> f64, [from, to]: [f64; 2]) -> f64 {
    let count = 20_000;
    let step = (to - from) / f64::from(count);
    let middles = (0..count).map(|i| from + step * (f64::from(i) + 0.5));
    middles.map(curve).sum::<f64>() * step
}

#[test]
fn the_loop_of_a_lens_is_the_difference_of_its_works_of_adhesion_over_the_area() {
    for kind in [Kind::LoadRadius, Kind::LoadPenetration] {
        let mut lens = Imagined::lens(kind, 10e-6, 2e-6, &LENS);
        lens.course = Course::Cycle;
        lens.radii[0] = 60e-6;
        lens.points[0] = 80;
        lens.truth.work_of_adhesion = 0.03;
        lens.truth.work_of_adhesion_receding = Some(0.06);
        let mut experiment = lens.measured(&lens.exact(), 1);
        experiment.work_of_adhesion_receding = None;
        let found = fitted(&experiment, &LENS);
        let words =
            "imagined.csv; work of loading; half of the largest load; work-of-adhesion-receding";
        assert_warns(&found, WarningKind::Hysteresis, words);
        if kind == Kind::LoadRadius {
            // From the smallest radius of the retract on.
            let expected = 0.03 * PI * (131e-6_f64.powi(2) - 60e-6_f64.powi(2));
            let off = energy(&found) / expected - 1.0;
            assert!(off.abs() < 0.03, "{off}");
        }
        // Two works of adhesion make this loop: there is nothing left to name.
        let both = [LENS[0], LENS[1], Parameter::WorkOfAdhesionReceding];
        let found = fitted(&experiment, &both);
        assert_silent(&found, WarningKind::Hysteresis);
        // One way has no loop.
        let points = &mut experiment.measurement.points;
        points.retain(|point| point.direction == Some(Direction::Retract));
        assert_silent(&fitted(&experiment, &LENS), WarningKind::Hysteresis);
    }
}

#[test]
fn an_elastic_cycle_has_no_loop_to_be_named_though_its_ends_jump() {
    // The jumps of a soft spring, and those of an adhesive contact at imposed penetrations, lose
    // energy, which the model loses, too.
    for seed in 0..40 {
        let mut probe = Imagined::probe(Course::Cycle, 1e-4, &FORCE_CURVE);
        probe.noise_is_known = seed % 2 == 0;
        let found = probe.fit(seed);
        assert_silent(&found, WarningKind::Hysteresis);
        assert_silent(&found, WarningKind::Plasticity);
    }
}

/// A hold at the end of an approach, during which the load falls, the height changes, or both stay.
#[test]
fn a_film_that_relaxes_in_a_hold_is_named() {
    let hertz = [
        Parameter::FilmModulus,
        Parameter::ContactPoint,
        Parameter::Baseline,
    ];
    let probe = Imagined::probe(Course::Approach, 0.0, &hertz);
    let exact = probe.exact();
    for seed in 0..10 {
        let fell = "height was held; load fell; the film relaxes; needs its time";
        let crept =
            "load was held; height changed; change in contact; the film creeps; needs its time";
        for (fall, creep, words) in [
            (0.0, 0.0, None),
            (0.1, 0.0, Some(fell)),
            (0.0, 2e-7, Some(crept)),
        ] {
            let mut held = probe.measured(&exact, seed);
            let mut random = Contacts::new(seed + 100);
            let closest = held.measurement.points.iter().copied();
            let closest = closest.min_by(|one, other| one.abscissa.total_cmp(&other.abscissa));
            let closest = closest.expect("points");
            for i in 0..60 {
                let part = 1.0 - (-f64::from(i) / 20.0).exp();
                held.measurement.points.push(Point {
                    line: 1000 + u64::try_from(i).expect("small"),
                    abscissa: closest.abscissa - creep * part,
                    ordinate: closest.ordinate * (1.0 - fall * part)
                        + probe.noise * random.normal(),
                    ..closest
                });
            }
            let found = fitted(&held, &hertz);
            match words {
                Some(words) => assert_warns(&found, WarningKind::Relaxes, words),
                None => assert_silent(&found, WarningKind::Relaxes),
            }
        }
    }
}

/// A standard linear solid under a rigid sphere that comes and goes with one speed.
#[test]
fn the_loop_of_a_viscous_sample_is_named_with_its_energy() {
    let deepest = 1e-6;
    // A reduced modulus of 20 kPa at first, of 8 kPa at last. Half the way in is one relaxation time.
    let contact = on_half_space(Probe::Paraboloid { radius: RADIUS }, solid(1.5e4, 0.5));
    let law = prony(0.4, vec![[0.6, 0.5]]);
    let times: Vec<f64> = (0..=80).map(|i| f64::from(i) / 40.0).collect();
    let program = [(0.0, 0.0), (1.0, deepest), (2.0, 0.0)];
    let history = contact.history(&law).expect("a law");
    let course = history.at(Control::Displacement, &program, &times, Some(1e-6));
    let states = course.expect("a course").states;
    let up: Vec<f64> = states.iter().map(|at| at.state.load).collect();
    let down: Vec<f64> = up.iter().rev().copied().collect();
    let on = |values: &[f64], x: f64| {
        let place = (40.0 * x / deepest).clamp(0.0, 40.0);
        let i = (place as usize).min(39);
        values[i] + (place - i as f64) * (values[i + 1] - values[i])
    };
    let experiment = pressed(|x| on(&up, x), |x| on(&down, x), [deepest, 2e-10], 1);
    let found = fitted(&experiment, &[Parameter::FilmModulus]);
    let words = "viscous; fit one direction alone";
    assert_warns(&found, WarningKind::Hysteresis, words);
    let range = [0.05 * deepest, deepest];
    let expected = area(|x| on(&up, x), range) - area(|x| on(&down, x), range);
    let off = energy(&found) / expected - 1.0;
    assert!(off.abs() < 0.03, "{off}");
    // Without the directions, the order in time tells them.
    let mut unnamed = experiment.clone();
    let points = &mut unnamed.measurement.points;
    points.iter_mut().for_each(|point| point.direction = None);
    let found = fitted(&unnamed, &[Parameter::FilmModulus]);
    let words = "give the points their directions";
    assert_warns(&found, WarningKind::Hysteresis, words);
    // Directions that are swapped.
    let mut swapped = experiment;
    for point in &mut swapped.measurement.points {
        point.direction = match point.direction {
            Some(Direction::Approach) => Some(Direction::Retract),
            _ => Some(Direction::Approach),
        };
    }
    let found = fitted(&swapped, &[Parameter::FilmModulus]);
    assert_warns(&found, WarningKind::Hysteresis, "check the directions");
}

/// Oliver and Pharr's unloading (J. Mater. Res. 7, 1564, 1992) from a depth that remains.
#[test]
fn a_depth_that_remains_is_named_and_the_upper_unloading_gives_the_modulus() {
    let (deepest, remains, modulus): (f64, f64, f64) = (1e-7, 6e-8, 8e10);
    let most = hertz(modulus, deepest - remains);
    let loading = |x: f64| most * (x.max(0.0) / deepest).powf(1.5);
    let unloading = |x: f64| hertz(modulus, x - remains);
    for seed in 0..10 {
        let mut experiment = pressed(loading, unloading, [deepest, 1e-3 * most], seed);
        experiment.bodies = half_space(RADIUS, f64::INFINITY, solid(1e10, 0.3));
        let found = fitted(&experiment, &[Parameter::FilmModulus]);
        let words = "plastically; upper part of the unloading; contact point";
        assert_warns(&found, WarningKind::Plasticity, words);
        let depth = number_after(&text(&found, WarningKind::Plasticity), "a depth of ");
        assert!((depth - remains).abs() < 0.05 * deepest, "{depth}");
        assert_warned(&found, WarningKind::Hysteresis);
        // What the warning tells to do.
        let points = &mut experiment.measurement.points;
        points.retain(|point| {
            point.direction == Some(Direction::Retract) && point.ordinate > 0.5 * most
        });
        let found = fitted(
            &experiment,
            &[Parameter::FilmModulus, Parameter::ContactPoint],
        );
        let estimate = found.estimate(Parameter::FilmModulus).expect("free");
        let truth = modulus * (1.0 - 0.3 * 0.3);
        let off = (estimate.value - truth) / estimate.standard_error;
        let is_near = off.abs() < 4.0 && estimate.standard_error < 0.1 * truth;
        assert!(is_near, "{estimate:?}");
    }
    // An elastic cycle leaves nothing.
    for seed in 0..20 {
        let elastic = |x: f64| hertz(1e4, x);
        let experiment = pressed(elastic, elastic, [5e-7, 1e-3 * elastic(5e-7)], seed);
        let found = fitted(&experiment, &[Parameter::FilmModulus]);
        assert_no_doubts(&found, &[]);
    }
}

/// A position that drifts during the cycle leaves a depth, too, of a sample that is elastic.
#[test]
fn a_position_that_drifts_is_named_beside_a_loop_and_a_depth() {
    let deepest = 2e-7;
    let most = hertz(1e10, deepest);
    let drift = 0.1 * deepest;
    // By the time that has passed of each way.
    let loading = |x: f64| hertz(1e10, x - 0.5 * drift * x / deepest);
    let unloading = |x: f64| hertz(1e10, x - drift * (1.0 - 0.5 * x / deepest));
    let mut experiment = pressed(loading, unloading, [deepest, 1e-3 * most], 1);
    experiment.bodies = half_space(RADIUS, f64::INFINITY, solid(1e10, 0.3));
    let found = fitted(&experiment, &HERTZ);
    assert_warns(&found, WarningKind::Hysteresis, "a position that drifts");
    assert_warns(
        &found,
        WarningKind::Plasticity,
        "A position that drifts; take the drift off",
    );
    // Neighbours are so alike that they tell a least factor only.
    assert_warns(&found, WarningKind::PoorFit, "a factor of more than 14.1");
}

/// Drag of a liquid lifts the approach and lowers the retract, by more than the load off contact.
#[test]
fn drag_is_named_and_leaves_no_depth() {
    let modulus = 1e4 / 0.75;
    let most = hertz(modulus, 5e-7);
    for drag in [0.02, 0.2] {
        let [loading, unloading] =
            [1.0, -1.0].map(|sign| move |x: f64| hertz(modulus, x) + sign * drag * most);
        let experiment = pressed(loading, unloading, [5e-7, 1e-3 * most], 1);
        let found = fitted(&experiment, &HERTZ);
        let said = text(&found, WarningKind::Hysteresis);
        let apart = number_after(&said, "the baselines of the two ways are ");
        assert!((apart / (2.0 * drag * most) - 1.0).abs() < 0.05, "{said}");
        assert_silent(&found, WarningKind::Plasticity);
    }
}

/// A line that stays while the load falls, before it recedes, is no equilibrium of the retract.
#[test]
fn a_line_that_stays_on_retract_is_named() {
    let mut lens = lens();
    lens.truth.work_of_adhesion = 0.09;
    let retract = lens.measured(&lens.exact(), 0);
    assert_silent(&lens.fit_of(&retract), WarningKind::PinnedLine);
    // Of radii that differ by 7 %, some are alike.
    let mut narrow = lens.clone();
    narrow.radii[0] = 122e-6;
    let narrow = narrow.fit_of(&narrow.measured(&narrow.exact(), 0));
    assert_silent(&narrow, WarningKind::PinnedLine);
    let points = &retract.measurement.points;
    let largest = *points.last().expect("there are points");
    let range = largest.ordinate - points[0].ordinate;
    let mut stays = retract.clone();
    for i in 1..=8 {
        stays.measurement.points.push(Point {
            line: largest.line + i,
            ordinate: largest.ordinate + 0.06 * range * i as f64,
            ..largest
        });
    }
    let found = lens.fit_of(&stays);
    assert_warns(&found, WarningKind::PinnedLine, "lines 40 to 49");
    let modulus = off(&found, Parameter::SphereModulus, 2e6);
    assert!(modulus > 3.0, "it misleads: {modulus}");
}

/// Adhesion that is larger on retract makes a loop, and the contact lasts to beyond the contact point: no depth remains.
#[test]
fn a_loop_of_adhesion_leaves_no_depth() {
    let mut probe = Imagined::probe(Course::Cycle, 5e-5, &FORCE_CURVE);
    probe.truth.work_of_adhesion_receding = Some(5e-4);
    let mut measured = probe.measured(&probe.exact(), 1);
    measured.work_of_adhesion_receding = None;
    let found = fitted(&measured, &FORCE_CURVE);
    assert_warned(&found, WarningKind::Hysteresis);
    assert_silent(&found, WarningKind::Plasticity);
}

/// No line recedes by itself: the energy of retract is at least that of approach.
#[test]
fn a_receding_work_below_that_of_approach_is_named() {
    let directed = |work: f64, direction| {
        let mut lens = lens();
        lens.truth.work_of_adhesion = work;
        let mut experiment = lens.measured(&lens.exact(), 0);
        for point in &mut experiment.measurement.points {
            point.direction = Some(direction);
        }
        experiment
    };
    let found = |[advancing, receding]: [f64; 2]| {
        let mut both = directed(advancing, Direction::Approach);
        let retract = directed(receding, Direction::Retract).measurement;
        both.measurement.points.extend(retract.points);
        both.work_of_adhesion_receding = Some(receding);
        let works = [Parameter::WorkOfAdhesion, Parameter::WorkOfAdhesionReceding];
        fitted(&both, &[Parameter::SphereModulus, works[0], works[1]])
    };
    assert_silent(&found([0.04, 0.05]), WarningKind::MixedBranches);
    let words = "work-of-adhesion-receding is below work-of-adhesion";
    assert_warns(&found([0.05, 0.04]), WarningKind::MixedBranches, words);
}

/// Beside a model that gains energy on unloading, because the zero of the load drifts, a loop is no hysteresis.
#[test]
fn a_loop_beside_a_model_that_gains_energy_is_of_a_drift() {
    let mut lens = lens();
    lens.noise = 2e-6;
    let mut both = lens.measured(&lens.exact(), 0);
    let points = both.measurement.points.clone();
    let mut unloading = points.clone();
    unloading.reverse();
    let drift = 1e-4 / (2.0 * points.len() as f64);
    let ways = [
        (Direction::Approach, points),
        (Direction::Retract, unloading),
    ];
    let points = ways.into_iter().flat_map(|(way, points)| {
        points.into_iter().map(move |point| Point {
            direction: Some(way),
            ..point
        })
    });
    both.measurement.points = points.collect();
    for (i, point) in (0_u32..).zip(&mut both.measurement.points) {
        point.line = u64::from(i) + 2;
        point.ordinate += drift * f64::from(i);
    }
    both.noise = Some(lens.noise);
    both.abscissa_noise = 3e-7;
    both.work_of_adhesion_receding = Some(lens.truth.work_of_adhesion);
    let works = [Parameter::WorkOfAdhesion, Parameter::WorkOfAdhesionReceding];
    let found = fitted(
        &both,
        &[
            Parameter::SphereModulus,
            works[0],
            works[1],
            Parameter::LoadOffset,
        ],
    );
    assert_warns(&found, WarningKind::MixedBranches, "drifts");
    let said = text(&found, WarningKind::Hysteresis);
    assert!(!said.contains("viscous"), "{said}");
    assert_warns(&found, WarningKind::Hysteresis, "gains energy");
}
