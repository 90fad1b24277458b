//! Measures the time of fits: `cargo bench -p coated-contact-fit`. Only ratios within one run are meaningful.

use std::env;
use std::hint::black_box;
use std::slice;
use std::thread;
use std::time::{Duration, Instant};

use contact::{LawParameter, Relaxation};
use criterion::{Criterion, criterion_group, criterion_main};
use fit::{
    Bodies, Direction, Experiment, Free, Kind, Measurement, Numbering, Options, Parameter, Point,
    Relaxing, fit, simulate,
};
use interp::{Elastic, Probe, System, Table};

/// The number of points of a curve.
const POINTS: u32 = 300;
/// The number of curves that are fitted together.
const TOGETHER: usize = 40;
/// The number of curves of a map.
const CURVES: u64 = 10_000;
/// The number of points of an approach and a retract in time, and of such curves of a map.
const POINTS_IN_TIME: u32 = 400;
const CURVES_IN_TIME: u64 = 1_000;

/// Makes data of `POINTS` points between two abscissae.
fn measured(experiment: Experiment, kind: Kind, [from, to]: [f64; 2], noise: f64) -> Experiment {
    let point = |i: u32| Point {
        line: u64::from(i) + 1,
        abscissa: from + (to - from) * f64::from(i) / f64::from(POINTS - 1),
        ordinate: 0.0,
        direction: Some(Direction::Retract),
    };
    let planned = Experiment {
        measurement: Measurement {
            name: "curve".into(),
            kind,
            numbering: Numbering::Lines,
            points: (0..POINTS).map(point).collect(),
        },
        noise: Some(noise),
        ..experiment
    };
    simulate(Table::embedded(), &planned, noise, 1).expect("in the table")
}

fn nothing() -> Measurement {
    Measurement {
        name: String::new(),
        kind: Kind::LoadRadius,
        numbering: Numbering::Lines,
        points: Vec::new(),
    }
}

/// The paper's lens on a film of 10 um: loads at contact radii.
fn lens() -> (Experiment, Vec<Free>) {
    let solid = |young, poisson| Elastic::new(young, poisson).expect("physical");
    let system = System {
        probe: Probe::Paraboloid { radius: 1e-3 },
        sphere_modulus: 2e6,
        film: solid(3.5e6, 0.5),
        film_thickness: 1e-5,
        substrate: solid(2e11, 0.25),
    };
    let mut experiment = Experiment::new(nothing(), Bodies::coated(&system));
    experiment.work_of_adhesion = 0.04;
    let free = [
        Parameter::SphereModulus,
        Parameter::WorkOfAdhesion,
        Parameter::LoadOffset,
    ];
    let experiment = measured(experiment, Kind::LoadRadius, [131e-6, 42e-6], 5e-6);
    (experiment, free.map(Free::new).to_vec())
}

/// A rigid probe on a gel: force against height, with the jump off and a baseline.
fn probe() -> (Experiment, Vec<Free>) {
    let solid = |young, poisson| Elastic::new(young, poisson).expect("physical");
    let system = System {
        probe: Probe::Paraboloid { radius: 20e-6 },
        sphere_modulus: f64::INFINITY,
        film: solid(2e4, 0.45),
        film_thickness: 1e-5,
        substrate: solid(7e10, 0.2),
    };
    let mut experiment = Experiment::new(nothing(), Bodies::coated(&system));
    experiment.work_of_adhesion = 1e-4;
    experiment.stiffness = Some(0.2);
    let free = [
        Parameter::FilmModulus,
        Parameter::WorkOfAdhesion,
        Parameter::ContactPoint,
    ];
    let experiment = measured(experiment, Kind::ForceHeight, [-1e-6, 1e-6], 1.5e-10);
    (experiment, free.map(Free::new).to_vec())
}

/// A rigid probe on a gel that relaxes by a power law: loads in time at penetrations that grow from
/// before the contact, and fall.
fn gel() -> (Experiment, Vec<Free>) {
    let solid = |young, poisson| Elastic::new(young, poisson).expect("physical");
    let system = System {
        probe: Probe::Paraboloid { radius: 2e-5 },
        sphere_modulus: f64::INFINITY,
        film: solid(2e3, 0.5),
        film_thickness: 1e-5,
        substrate: solid(f64::INFINITY, 0.25),
    };
    let mut plan = Experiment::new(nothing(), Bodies::coated(&system));
    let times = (0..POINTS_IN_TIME).map(|i| 2.0 * f64::from(i) / f64::from(POINTS_IN_TIME - 1));
    plan.times = times.collect();
    let point = |(line, &t): (u64, &f64)| Point {
        line,
        abscissa: 6e-7 * (1.0 - 1.2 * (t - 1.0).abs()),
        ordinate: 0.0,
        direction: Some(if t <= 1.0 {
            Direction::Approach
        } else {
            Direction::Retract
        }),
    };
    plan.measurement = Measurement {
        name: "gel".into(),
        kind: Kind::LoadPenetration,
        numbering: Numbering::Lines,
        points: (1..).zip(&plan.times).map(point).collect(),
    };
    let law = |exponent| {
        Some(Relaxing::new(Relaxation::PowerLaw {
            exponent,
            time: 1.0,
        }))
    };
    plan.relaxing = law(0.2);
    let noise = 1e-11;
    plan.noise = Some(noise);
    let made = simulate(Table::embedded(), &plan, noise, 1).expect("in the table");
    let experiment = Experiment {
        relaxing: law(0.33),
        ..made
    };
    let free = [
        Parameter::FilmModulus,
        Parameter::Law(LawParameter::Exponent),
        Parameter::ContactPoint,
    ];
    (experiment, free.map(Free::new).to_vec())
}

/// Fits a map of curves on all cores, as the Python package does, and returns the time.
fn map((experiment, free): &(Experiment, Vec<Free>), curves: u64) -> Duration {
    let options = Options {
        without_film: false,
        ..Options::default()
    };
    let threads = thread::available_parallelism().map_or(1, usize::from) as u64;
    let start = Instant::now();
    thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(|| {
                for _ in 0..curves / threads {
                    together(slice::from_ref(experiment), free, &options);
                }
            });
        }
    });
    start.elapsed()
}

fn together(experiments: &[Experiment], free: &[Free], options: &Options) {
    let found = fit(Table::embedded(), black_box(experiments), free, options);
    assert!(found.expect("sound data").converged);
}

fn fits(criterion: &mut Criterion) {
    let points = |count: u32, kind: &str| format!("{count} points, 3 parameters, {kind}");
    let cases = [
        (points(POINTS, "loads at radii"), CURVES, lens()),
        (points(POINTS, "forces at heights"), CURVES, probe()),
        (
            points(POINTS_IN_TIME, "loads in time on a gel that relaxes"),
            CURVES_IN_TIME,
            gel(),
        ),
    ];
    for (name, _, case) in &cases {
        criterion.bench_function(name, |b| {
            b.iter(|| together(slice::from_ref(&case.0), &case.1, &Options::default()))
        });
    }
    let (lens, free) = lens();
    let many = vec![lens; TOGETHER];
    let name = format!("{TOGETHER} times {POINTS} points together, each with an offset of its own");
    criterion.bench_function(&name, |b| {
        b.iter(|| together(&many, &free, &Options::default()))
    });
    // As of the single fits, only those that are asked for.
    let filter = env::args()
        .skip(1)
        .find(|argument| !argument.starts_with('-'));
    let is_asked_for = |name: &str| filter.as_deref().is_none_or(|part| name.contains(part));
    for (name, curves, case) in cases.iter().filter(|(name, ..)| is_asked_for(name)) {
        let time = map(case, *curves).as_secs_f64();
        println!("{curves} curves on all cores, {name}: {time:.1} s");
    }
}

criterion_group!(benches, fits);
criterion_main!(benches);
