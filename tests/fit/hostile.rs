//! Data and settings that cannot be used are refused by name; no data make a fit panic.

use std::slice;

use acceptance::{Contacts, Refused};
use fit::{Bodies, Direction, Error, Experiment, Fit, Free, Kind, Loss, Options, Parameter, Point};
use fit::{Scope, simulate};
use interp::Table;

use crate::imagined::{Course, Imagined, fit_all, fit_with, gel, lens, measurement};

/// Fits the lens on a film of 10 um to points that are changed first.
fn with(edit: impl Fn(&mut Vec<Point>)) -> Result<Fit, Error> {
    let lens = lens();
    let mut experiment = lens.measured(&lens.exact(), 1);
    edit(&mut experiment.measurement.points);
    fit_all(&[experiment], &lens.free)
}

#[test]
fn points_that_cannot_be_are_named_by_their_line() {
    with(Vec::clear).refused("0 usable points");
    with(|points| points.truncate(1)).refused("imagined.csv; every point");
    with(|points| points.truncate(2)).refused("2 usable points; 2 parameters");
    with(|points| points[5].ordinate = f64::NAN).refused("imagined.csv; line 7; load; NaN; finite");
    with(|points| points[6].abscissa = f64::INFINITY).refused("line 8; contact radius; inf");
    with(|points| points[0].abscissa = -1e-6)
        .refused("line 2; contact radius; -1e-6; 0 (no contact) or positive");
    with(|points| points.iter_mut().for_each(|point| point.ordinate = 1e-4))
        .refused("imagined.csv; load is 0.0001 at every point");
    with(|points| points.iter_mut().for_each(|point| point.abscissa = 5e-5))
        .refused("contact radius is 5e-5 at every point");
    with(|points| points.iter_mut().for_each(|point| point.ordinate *= -1.0))
        .refused("no positive modulus; units and signs; stiffness of a cantilever");
}

#[test]
fn the_order_of_points_does_not_matter_and_duplicates_count_twice() {
    let sorted = with(|_| ()).expect("sound");
    let shuffled = with(|points| points.sort_by_key(|point| point.line * 37 % 101)).expect("sound");
    let doubled = with(|points| points.extend(points.clone())).expect("sound");
    for (i, one) in sorted.estimates.iter().enumerate() {
        let (other, twice) = (shuffled.estimates[i], doubled.estimates[i]);
        assert!((one.value - other.value).abs() < 1e-3 * one.standard_error);
        assert!((one.value - twice.value).abs() < 1e-2 * one.standard_error);
        let ratio = one.standard_error / twice.standard_error;
        assert!((ratio / 2_f64.sqrt() - 1.0).abs() < 1e-3, "{ratio}");
    }
}

#[test]
fn settings_that_cannot_be_used_are_named() {
    let lens = lens();
    let measured = lens.measured(&lens.exact(), 1);
    let one = slice::from_ref(&measured);
    fit_all(&[], &lens.free).refused("no experiment");
    fit_all(one, &[]).refused("no free parameter");
    let sphere = Free::new(Parameter::SphereModulus);
    fit_all(one, &[sphere, sphere]).refused("sphere-modulus is free twice");
    let refused = |free: Free, words: &str| fit_all(one, &[free]).refused(words);
    let contact_point = Free::new(Parameter::ContactPoint);
    refused(
        contact_point,
        "contact-point; imagined.csv; neither penetration nor height",
    );
    refused(Free::new(Parameter::Stiffness), "stiffness; no height");
    refused(Free::new(Parameter::Baseline), "baseline; not measured");
    refused(
        sphere.starting_from(-1.0),
        "start of sphere-modulus; -1.0; positive",
    );
    refused(sphere.within(1e6, f64::NAN), "bound of sphere-modulus; NaN");
    refused(sphere.within(2e6, 1e6), "upper bound; 1000000.0; 2000000.0");
    let beside = sphere.within(1e6, 2e6).starting_from(3e6);
    refused(
        beside,
        "start of sphere-modulus; 3000000.0; between the bounds",
    );
    refused(sphere.with_prior(2e6, 0.0), "prior width; 0.0; positive");
    let ratio = Free::new(Parameter::FilmPoissonRatio).within(0.0, 0.6);
    refused(ratio, "bound of film-poisson-ratio; 0.6; 0.5");
    let with = |change: fn(&mut Options)| fit_with(&measured, &lens.free, change);
    for threshold in [0.0, f64::NAN, f64::INFINITY] {
        for loss in [Loss::Huber { threshold }, Loss::SoftL1 { threshold }] {
            fit_with(&measured, &lens.free, |options| options.loss = loss)
                .refused("threshold; positive and finite");
        }
    }
    with(|options| options.profile_level = Some(1.0)).refused("profile-likelihood; 1.0");
    with(|options| options.interaction_range = -3e-10).refused("interaction range; -3e-10");
    let changed = |free: &[Free], change: &dyn Fn(&mut Experiment)| {
        let mut changed = measured.clone();
        change(&mut changed);
        fit_all(&[changed], free)
    };
    for noise in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        changed(&lens.free, &|one| one.noise = Some(noise)).refused(&format!("noise; {noise:?}"));
    }
    changed(&[sphere], &|one| one.work_of_adhesion = f64::NAN).refused("work-of-adhesion; NaN");
    let rigid = |one: &mut Experiment| {
        one.set(Parameter::SphereModulus, f64::INFINITY)
            .expect("a rigid sphere");
    };
    changed(&[sphere], &rigid).refused("sphere-modulus; rigid");
    // Two thicknesses cannot be one, but may each be found.
    let mut thick = measured.clone();
    thick.set(Parameter::FilmThickness, 30e-6).expect("a film");
    let thickness = Free::new(Parameter::FilmThickness);
    let both = [measured.clone(), thick];
    fit_all(&both, &[sphere, thickness]).refused("film-thickness; one value is fitted");
    let work = Free::new(Parameter::WorkOfAdhesion);
    let own = [sphere, work, thickness.with_scope(Scope::Own)];
    fit_all(&both, &own).expect("each film has its thickness");
    // A cantilever without a stiffness.
    let probe = Imagined::probe(Course::Approach, 0.0, &[Parameter::FilmModulus]);
    let mut limp = probe.measured(&probe.exact(), 1);
    limp.stiffness = None;
    fit_all(&[limp], &probe.free).refused("stiffness of imagined.csv; cantilever");
    let level = [Parameter::LoadOffset, Parameter::Baseline].map(Free::new);
    let probe = probe.measured(&probe.exact(), 1);
    fit_all(&[probe], &level).refused("load-offset; baseline; one number");
}

#[test]
fn parameters_are_known_by_name() {
    for parameter in Parameter::ALL {
        let read = parameter.name().parse::<Parameter>();
        assert_eq!(read.expect("its name"), parameter);
    }
    let error = "nu1".parse::<Parameter>();
    error.refused("nu1; film-modulus; baseline-slope; stiffness");
}

#[test]
fn data_without_sense_give_an_error_or_a_result() {
    let kinds = [
        Kind::LoadRadius,
        Kind::PenetrationRadius,
        Kind::LoadPenetration,
        Kind::ForceHeight,
    ];
    let directions = [None, Some(Direction::Approach), Some(Direction::Retract)];
    let free = [
        Parameter::FilmModulus,
        Parameter::WorkOfAdhesion,
        Parameter::ContactPoint,
    ];
    let (mut fitted, mut refused) = (0, 0);
    for seed in 0..400 {
        let mut random = Contacts::new(seed);
        let mut pick = |count: usize| random.uniform(0.0, count as f64) as usize;
        let kind = kinds[pick(4)];
        let count = pick(60);
        let (abscissa_unit, ordinate_unit) = (pick(12), pick(16));
        let mut points = Vec::new();
        for i in 0..count {
            let mut number = |unit: usize| match random.uniform(0.0, 600.0) as usize {
                0 => 0.0,
                1 => f64::MAX,
                2 => f64::NAN,
                _ => random.uniform(0.0, 1.0) * 10_f64.powi(-(unit as i32)),
            };
            let (abscissa, ordinate) = (number(abscissa_unit), number(ordinate_unit));
            let abscissa = match kind {
                Kind::LoadRadius | Kind::PenetrationRadius => abscissa.abs(),
                _ => abscissa,
            };
            points.push(Point {
                line: i as u64,
                abscissa,
                ordinate: if ordinate == f64::MAX { 1e9 } else { ordinate },
                direction: directions[i % 3],
            });
        }
        let mut experiment = Experiment::new(measurement(kind, points), Bodies::coated(&gel()));
        experiment.stiffness = Some(0.2);
        experiment.noise = (seed % 3 == 0).then_some(1e-9);
        let free: Vec<Free> = free
            .iter()
            .copied()
            .filter(|parameter| kind != Kind::LoadRadius || *parameter != free[2])
            .map(Free::new)
            .collect();
        let loss = [Loss::Squares, Loss::HUBER, Loss::SOFT_L1][seed as usize % 3];
        match fit_with(&experiment, &free, |options| options.loss = loss) {
            // Random numbers are no contact: there is always a doubt.
            Ok(found) => {
                fitted += 1;
                assert!(!found.warnings.is_empty(), "seed {seed}: {found:?}");
            }
            Err(error) => {
                refused += 1;
                assert!(!error.to_string().is_empty());
            }
        }
    }
    assert!(fitted > 0 && refused > 0, "{fitted} {refused}");
}

#[test]
fn predictions_and_simulations_refuse_what_is_not_finite() {
    let lens = lens();
    let sound = lens.measured(&lens.exact(), 1);
    let refused = |experiment: &Experiment, words: &str| {
        let table = Table::embedded();
        experiment.predictions(table, None, &[]).refused(words);
        simulate(table, experiment, 0.0, 1).refused(words);
    };
    for value in [f64::NAN, f64::INFINITY, -1e101] {
        let mut offset = sound.clone();
        offset.load_offset = value;
        refused(&offset, "load-offset of imagined.csv; finite");
        let mut far = sound.clone();
        far.measurement.points[3].abscissa = value;
        refused(&far, "imagined.csv, line 5; contact radius");
    }
}
