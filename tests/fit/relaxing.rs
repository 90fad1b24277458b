//! Fits of bodies that relax: the truth within the intervals, and the limits of the model.

use acceptance::{Refused, assert_names, modified_power_law, prony, rigid_sphere, solid};
use contact::Relaxation;
use fit::{
    Bodies, Direction, Error, Experiment, Free, Kind, Parameter, Point, Relaxing, WarningKind,
    simulate,
};
use interp::{Probe, Table};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

use crate::recovery::{SETS, assert_recovers};

use Parameter::{Baseline, ContactPoint, FilmModulus, Law};
use contact::LawParameter::{Exponent, RelaxedFraction, Time, Weight};

use crate::imagined::{assert_silent, fit_all, fit_with, free_of, measurement, off, text};

/// What a curve tells of a gel that relaxes by a power law, and by a standard linear solid.
pub const POWER_LAW: [Parameter; 3] = [FilmModulus, Law(Exponent), ContactPoint];
const SOLID: [Parameter; 4] = [
    FilmModulus,
    Law(RelaxedFraction),
    Law(Time(0)),
    ContactPoint,
];

/// A rigid probe on a gel of some thickness (m) on glass.
fn gel(thickness: f64) -> Bodies {
    Bodies::coated(&rigid_sphere(
        2e-5,
        [2e3, 0.5],
        thickness,
        [f64::INFINITY, 0.25],
    ))
}

/// An approach from before the contact in 1 s, a hold, and a retract, with 60 points.
pub fn planned(kind: Kind, thickness: f64, law: &Relaxation, hold: f64) -> Experiment {
    const POINTS: u32 = 60;
    let times = (0..POINTS).map(|i| (2.0 + hold) * f64::from(i) / f64::from(POINTS - 1));
    let times: Vec<f64> = times.collect();
    let depth = |t: f64| match t {
        _ if t < 1.0 => 6e-7 * (1.2 * t - 0.2),
        _ if t < 1.0 + hold => 6e-7,
        _ => 6e-7 * (1.0 - 1.2 * (t - 1.0 - hold)),
    };
    let sense = if kind == Kind::ForceHeight { -1.0 } else { 1.0 };
    let direction = |t: f64| match t {
        _ if t <= 1.0 + hold => Direction::Approach,
        _ => Direction::Retract,
    };
    let point = |(line, &t): (u64, &f64)| Point {
        line,
        abscissa: 3e-7 + sense * depth(t),
        ordinate: 0.0,
        direction: Some(direction(t)),
    };
    let measurement = measurement(kind, (1..).zip(&times).map(point).collect());
    let mut planned = Experiment::new(measurement, gel(thickness));
    planned.times = times;
    planned.contact_point = 3e-7;
    planned.stiffness = Some(0.02);
    planned.relaxing = Some(Relaxing::new(law.clone()));
    planned
}

/// Returns the data with noise of a hundredth of the largest load.
pub fn noisy(plan: &Experiment, seed: u64) -> Experiment {
    with_noise(plan, 0.01, seed)
}

/// Returns the data with noise of a part of the largest load.
pub fn with_noise(plan: &Experiment, part: f64, seed: u64) -> Experiment {
    let exact = simulate(Table::embedded(), plan, 0.0, 0).expect("in the table");
    let loads = exact.measurement.points.iter().map(|point| point.ordinate);
    let noise = part * loads.fold(0.0, f64::max);
    let mut made = simulate(Table::embedded(), plan, noise, seed).expect("in the table");
    made.noise = Some(noise);
    made
}

/// Returns the data with noise; nothing that is free is told.
pub fn measured(plan: &Experiment, seed: u64) -> Experiment {
    let mut made = noisy(plan, seed);
    made.contact_point = 0.0;
    if let Some(relaxing) = &mut made.relaxing
        && relaxing.parameters().contains(&Law(Exponent))
    {
        relaxing.law = relaxing.law.with(Exponent, 0.33);
    }
    made
}

fn recover(
    name: &str,
    plans: &[Experiment],
    free: &[Parameter],
    seed: u64,
    expected: &[WarningKind],
) {
    let free = free_of(free);
    let fit_of = |set: u64| {
        let plans = plans.iter().zip(0..);
        let data = plans.map(|(plan, i)| measured(plan, 10 * set + i));
        let data: Vec<Experiment> = data.collect();
        fit_all(&data, &free).expect("sound data")
    };
    let seeds = SETS * seed..SETS * (seed + 1);
    assert_recovers(name, &plans[0], seeds, fit_of, expected);
}

pub fn power() -> Relaxation {
    let (exponent, time) = (0.2, 1.0);
    Relaxation::PowerLaw { exponent, time }
}

fn linear_solid() -> Relaxation {
    prony(0.3, vec![[0.7, 0.3]])
}

#[test]
fn power_laws_are_recovered() {
    let plan = planned(Kind::LoadPenetration, 1e-5, &power(), 0.0);
    recover("power law", &[plan], &POWER_LAW, 101, &[]);
    let plan = planned(Kind::ForceHeight, 1e-5, &power(), 0.0);
    let with_level = [&POWER_LAW[..], &[Baseline]].concat();
    recover("power law, heights", &[plan], &with_level, 102, &[]);
    let plans = [8e-6, 3e-5].map(|t| planned(Kind::LoadPenetration, t, &power(), 0.0));
    // Two films determine the modulus more closely than friction on the thinner one lets be known.
    let expected = [WarningKind::Friction];
    recover("power law, two films", &plans, &POWER_LAW, 103, &expected);
}

/// Such noise hides where the contact begins, from which an elastic contact would start. Under a cone few points are in
/// contact beyond it, and the elastic contact may be of any modulus.
#[test]
fn noise_of_a_tenth_of_the_largest_load_hinders_no_fit() {
    let plan = |thickness, law: &Relaxation| planned(Kind::LoadPenetration, thickness, law, 1.0);
    let mut cone = plan(1e-6, &linear_solid());
    cone.bodies.probe = Probe::Cone { half_angle: 1.05 };
    for (name, plan, free, noise) in [
        ("power law", plan(1e-5, &power()), &POWER_LAW[..], 0.12),
        ("solid", plan(1e-5, &linear_solid()), &SOLID[..], 0.12),
        ("cone", cone, &SOLID[..], 0.1),
    ] {
        let sets = if name == "cone" { 16 } else { SETS / 4 };
        let square = |seed: u64| {
            let mut made = with_noise(&plan, noise, seed);
            made.contact_point = 0.0;
            let fit = fit_all(&[made], &free_of(free)).expect("a start");
            let modulus = fit.estimate(FilmModulus).expect("free");
            ((modulus.value - 2e3) / modulus.standard_error).powi(2)
        };
        let mean = (0..sets).map(square).sum::<f64>() / sets as f64;
        assert!(
            name == "cone" || (0.3..3.0).contains(&mean),
            "{name}: {mean}"
        );
    }
}

/// A modulus that the data do not determine may leave the bodies that do not relax too much of the deformation: the
/// reason are the data, not these bodies.
#[test]
fn data_that_do_not_determine_the_law_are_the_reason_and_not_the_bodies() {
    let mut plan = planned(Kind::LoadPenetration, 1e-6, &linear_solid(), 0.0);
    plan.bodies.base = solid(1e7, 0.45);
    let refused = |seed: u64| {
        let mut made = with_noise(&plan, 0.2, seed);
        made.contact_point = 0.0;
        fit_all(&[made], &free_of(&SOLID)).err()
    };
    let refused: Vec<Error> = (0..20).filter_map(refused).collect();
    println!("{}", refused.len());
    assert!(!refused.is_empty());
    for error in refused {
        assert_names(
            &error.to_string(),
            "do not determine film-modulus; do not relax carry too much; Fix a number of the relaxation function",
        );
    }
}

#[test]
fn a_relaxation_time_that_may_be_unseen_is_doubted() {
    let law = prony(0.3, vec![[0.7, 0.15]]);
    let made = with_noise(&planned(Kind::LoadPenetration, 1e-5, &law, 1.0), 0.1, 1);
    let fit = fit_all(&[made], &free_of(&SOLID)).expect("sound data");
    let time = fit.estimate(Law(Time(0))).expect("free").value;
    assert!((0.11..3.0).contains(&time), "{time}");
    assert_names(
        &text(&fit, WarningKind::RelaxationTime),
        "may be outside; hold longer",
    );
}

#[test]
fn solids_are_recovered() {
    let plan = planned(Kind::LoadPenetration, 1e-5, &linear_solid(), 1.0);
    recover("standard linear solid", &[plan], &SOLID, 104, &[]);
    let plan = planned(Kind::ForceHeight, 1e-5, &linear_solid(), 1.0);
    recover("standard linear solid, heights", &[plan], &SOLID, 105, &[]);
    let modified = modified_power_law(0.0, 0.5, 0.1);
    let free = [FilmModulus, Law(Exponent), Law(Time(0)), ContactPoint];
    let plan = planned(Kind::LoadPenetration, 1e-5, &modified, 1.0);
    // Its time is below two intervals in some sets, and in two of 200 chi^2 is not quite a parabola.
    let expected = [WarningKind::RelaxationTime, WarningKind::NonlinearError];
    recover("modified power law", &[plan], &free, 106, &expected);
}

/// Whichever of two times is given, the other one is found.
#[test]
fn one_of_two_relaxation_times_is_found_beside_the_other() {
    for (short, long) in [(0.04, 0.55), (0.06, 0.6), (0.1, 1.0)] {
        let law = prony(0.3, vec![[0.4, short], [0.3, long]]);
        let plan = planned(Kind::LoadPenetration, 1e-5, &law, 0.5);
        for found in [0, 1] {
            let free = [
                FilmModulus,
                Law(RelaxedFraction),
                Law(Time(found)),
                Law(Weight(1)),
                ContactPoint,
            ];
            let time = [short, long][found];
            for seed in 0..8 {
                let mut data = noisy(&plan, seed);
                data.contact_point = 0.0;
                let fit = fit_all(&[data], &free_of(&free)).expect("sound");
                let away = off(&fit, Law(Time(found)), time);
                assert!(fit.converged && away.abs() < 4.0, "{found} {seed}: {fit:?}");
                assert_silent(&fit, WarningKind::PoorFit);
            }
        }
    }
}

#[test]
fn a_baseline_far_from_zero_is_found_and_contact_is_not_taken_for_it() {
    let free = [FilmModulus, Law(Exponent), ContactPoint, Baseline];
    for kind in [Kind::LoadPenetration, Kind::ForceHeight] {
        let plan = planned(kind, 1e-5, &power(), 0.0);
        let exact = simulate(Table::embedded(), &plan, 0.0, 0).expect("in the table");
        let loads = exact.measurement.points.iter().map(|point| point.ordinate);
        let most = loads.fold(0.0, f64::max);
        for part in [-0.2, 0.2, 1.0] {
            let mut data = measured(&plan, 1);
            for point in &mut data.measurement.points {
                point.ordinate += part * most;
            }
            let found = fit_all(std::slice::from_ref(&data), &free_of(&free)).expect("sound");
            let level = off(&found, Baseline, part * most);
            let modulus = off(&found, FilmModulus, plan.bodies.film().young());
            assert!(
                level.abs() < 4.0 && modulus.abs() < 4.0,
                "{kind:?} {part}: {level} {modulus}"
            );
            // Five points are before the contact.
            for first in [4, 5, 6, 8, 20] {
                let mut begins = data.clone();
                begins.measurement.points.drain(..first);
                begins.times.drain(..first);
                let refused = fit_all(&[begins], &free_of(&free));
                refused.refused("points; contact; before the contact");
            }
        }
    }
}

/// A constant that is free does not matter, whatever the noise.
#[test]
fn a_baseline_is_found_below_large_noise() {
    let free = [FilmModulus, Law(Exponent), ContactPoint, Baseline];
    let plan = planned(Kind::ForceHeight, 1e-5, &power(), 0.3);
    for seed in 0..6 {
        let of_level = |level: f64| {
            let mut data = with_noise(&plan, 0.1, seed);
            data.contact_point = 0.0;
            let most = 10.0 * data.noise.expect("a plan has one");
            for point in &mut data.measurement.points {
                point.ordinate += level * most;
            }
            let found = fit_all(&[data], &free_of(&free));
            found.map(|found| off(&found, FilmModulus, 2e3)).ok()
        };
        for level in [-3.0, 10.0] {
            let [none, some] = [of_level(0.0), of_level(level)];
            let are_alike = match (none, some) {
                (Some(none), Some(some)) => (none - some).abs() < 0.1,
                (none, some) => none.is_none() && some.is_none(),
            };
            assert!(are_alike, "{seed} {level}: {none:?} {some:?}");
        }
    }
}

#[test]
fn bodies_that_do_not_relax_are_doubted_or_refused() {
    let with_base = |young: f64, all_bodies: bool| {
        let mut data = measured(&planned(Kind::LoadPenetration, 1e-5, &power(), 0.0), 1);
        data.bodies.base = solid(young, 0.45);
        if let Some(relaxing) = &mut data.relaxing {
            relaxing.all_bodies = all_bodies;
        }
        data
    };
    let found = |data: &Experiment| fit_all(std::slice::from_ref(data), &free_of(&POWER_LAW));
    let glass = found(&with_base(7e10, false)).expect("nothing to see");
    assert!(!glass.warns_of(WarningKind::UnlikeBodies));
    let stiff = found(&with_base(1e6, false)).expect("a doubt");
    let relaxation = stiff.experiments[0].relaxation.expect("it relaxes");
    let bound = relaxation.unlike_bodies;
    assert!(1e-4 < bound && bound < 2e-2, "{bound}");
    let soft = found(&with_base(2e4, false)).expect_err("too different");
    assert!(matches!(soft, Error::Contact(_)), "{soft}");
    assert_names(&soft.to_string(), "relax");
    assert!(found(&with_base(2e4, true)).is_ok());
}

/// A spring that stops suddenly relaxes in much less than a step where the law nearly flows. The level of the readings, in
/// largest loads, does not matter.
#[test]
fn steps_that_are_seen_beside_the_noise_are_told() {
    let time = 1e-3;
    let warns = |exponent: f64, noise: f64, level: f64| {
        let law = Relaxation::PowerLaw { exponent, time };
        let plan = planned(Kind::ForceHeight, 5e-6, &law, 1.0);
        let mut data = measured(&plan, 3);
        data.baseline = level * 100.0 * data.noise.expect("a noise");
        for point in &mut data.measurement.points {
            point.ordinate += data.baseline;
        }
        data.noise = Some(noise * data.noise.expect("a noise"));
        let fit = fit_all(&[data], &[Free::new(FilmModulus)]).expect("a fit");
        fit.warns_of(WarningKind::Steps)
    };
    for level in [0.0, 1e3] {
        assert!(warns(0.9, 0.1, level));
        assert!(!warns(0.2, 1.0, level));
    }
}

#[test]
fn a_loop_in_time_asks_for_a_relaxation() {
    let mut data = measured(&planned(Kind::LoadPenetration, 1e-5, &power(), 0.0), 1);
    data.relaxing = None;
    let free = [FilmModulus, ContactPoint].map(Free::new);
    let found = |data: &Experiment| {
        let found = fit_with(data, &free, |options| options.allow_left_out = true);
        text(&found.expect("a fit"), WarningKind::Hysteresis)
    };
    assert_names(&found(&data), &["times", "relaxation function"]);
    data.times.clear();
    let without = found(&data);
    assert!(!without.contains("relaxation function"), "{without}");
}

/// Seconds for milliseconds, and metres for millimetres: the same fit.
#[test]
fn units() {
    let free = POWER_LAW.map(Free::new);
    let data = measured(&planned(Kind::LoadPenetration, 1e-5, &power(), 0.0), 1);
    let mut other = data.clone();
    other.times.iter_mut().for_each(|time| *time *= 1e3);
    let (exponent, time) = (0.3, 1e3);
    other.relaxing = Some(Relaxing::new(Relaxation::PowerLaw { exponent, time }));
    let [one, other] = [data, other].map(|data| {
        let found = fit_all(&[data], &free);
        found.expect("sound data").estimates
    });
    for (one, other) in one.iter().zip(&other) {
        let difference = (one.value - other.value).abs() / one.standard_error;
        assert!(difference < 1e-2, "{}: {difference:.1e}", one.parameter);
    }
}

/// Noise of the heights, everywhere or in one phase, neither turns the contact around nor changes what is found.
#[test]
fn heights_with_noise() {
    let free = POWER_LAW.map(Free::new);
    let heights = planned(Kind::ForceHeight, 1e-5, &power(), 0.5);
    // The hold is as long as approach and retract: a part of it that falls would turn the contact around.
    let penetrations = planned(Kind::LoadPenetration, 1e-5, &power(), 1.0);
    let phases = [
        (&heights, 0),
        (&heights, 1),
        (&heights, 2),
        (&penetrations, 0),
    ];
    let noises = [(1, 3e-10), (2, 1e-9), (3, 2e-9), (4, 2e-9)];
    let cases = phases.map(|phase| noises.map(|noise| (phase, noise)));
    for ((plan, phase), (seed, noise)) in cases.into_iter().flatten() {
        let retract = plan.times[plan.times.len() - 1] - 1.0;
        let is_noisy = |t: f64| [true, (1.0..retract).contains(&t), t > retract][phase];
        let mut data = measured(plan, seed);
        let mut random = Pcg64Mcg::seed_from_u64(seed);
        for (point, &time) in data.measurement.points.iter_mut().zip(&data.times) {
            if is_noisy(time) {
                point.abscissa += 3.0_f64.sqrt() * noise * random.random_range(-1.0..1.0);
            }
        }
        let found = fit_all(&[data], &free).expect("a fit");
        for (one, truth) in found.estimates.iter().zip([2e3, 0.2, 3e-7]) {
            let off = (one.value - truth) / one.standard_error;
            assert!(off.abs() < 4.0, "{one:?}, phase {phase}, {noise:e}");
        }
        assert!(!found.warns_of(WarningKind::NotMonotone));
    }
}

/// Noise of the penetrations in time is taken off, and the change is told.
#[test]
fn a_penetration_that_goes_back_and_forth() {
    let free = POWER_LAW.map(Free::new);
    let mut data = measured(&planned(Kind::LoadPenetration, 1e-5, &power(), 0.0), 1);
    data.measurement.points[20].abscissa += 6e-8;
    let found = fit_all(&[data], &free).expect("a fit");
    let relaxation = found.experiments[0].relaxation.expect("it relaxes");
    let changed = relaxation.made_monotone;
    // Neighbours share the change.
    assert!((1e-8..6e-8).contains(&changed), "{changed:e}");
    assert!(found.warns_of(WarningKind::NotMonotone));
}
