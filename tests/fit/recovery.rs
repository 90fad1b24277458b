//! The truth is within the intervals as often as they say.

use std::ops::Range;

use acceptance::{assert_names, rigid_sphere, solid};
use fit::{Bodies, Experiment, Fit, Free, Kind, Loss, Parameter, WarningKind};
use rayon::prelude::*;

use crate::imagined::{
    Course, FORCE_CURVE, Imagined, LENS, OF_SOFT_FILMS, doubts, fit_all, half_space, lens, of_file,
};
use Parameter::{
    Baseline, BaselineSlope, ContactPoint, FilmModulus, LoadOffset, SphereModulus, WorkOfAdhesion,
    WorkOfAdhesionReceding,
};

pub const SETS: u64 = 200;
/// The numbers of 50 and of 200 that a binomial distribution with 0.6827 and 0.95 exceeds on either
/// side once in 20,000 times. The tests make some 100 such comparisons.
const BETWEEN: [(usize, [[usize; 2]; 2]); 2] =
    [(50, [[20, 46], [40, 50]]), (200, [[110, 161], [176, 199]])];
/// The most of 200 fits with a doubt of which chance makes one in a thousand: more come once in 17,000
/// times.
const MOST_ALIKE: usize = 3;
/// The most of them whose zero is hinted at: by chance two are once in 200 such tests.
const MOST_HINTED: usize = 1;

/// Asserts that the intervals of 68 % and 95 % of each estimate hold the truth as often as they
/// should, that all fits converge, and that none has another warning than those expected.
pub fn assert_coverage(
    name: &str,
    fits: &[Fit],
    truth: impl Fn(Parameter, Option<usize>) -> f64,
    expected: &[WarningKind],
) {
    let sets = fits.len();
    let known = BETWEEN.into_iter().find(|(known, _)| *known == sets);
    let (_, between) = known.expect("50 or 200 data sets");
    assert!(fits.iter().all(|fit| fit.converged), "{name}");
    for (i, estimate) in fits[0].estimates.iter().enumerate() {
        let parameter = estimate.parameter;
        let truth = truth(parameter, estimate.experiment);
        let covered = [1.0, 1.96].map(|z| {
            let holds = |fit: &&Fit| {
                let [low, high] = fit.estimates[i].interval(z);
                (low..=high).contains(&truth)
            };
            fits.iter().filter(holds).count()
        });
        println!(
            "{name}: {parameter} {:.1e}, covered {covered:?} of {sets}",
            estimate.standard_error / truth.abs()
        );
        for (covered, [least, most]) in covered.into_iter().zip(between) {
            let is_usual = (least..=most).contains(&covered);
            assert!(is_usual, "{name}, {parameter}: {covered} of {sets}");
        }
    }
    // Neighbouring residuals are alike by chance in one fit in a thousand, a zero is hinted at in one in two thousand, and
    // residuals look like errors of radii in one in some 400.
    let by_chance = [
        (WarningKind::StructuredResiduals, MOST_ALIKE),
        (WarningKind::OffsetHinted, MOST_HINTED),
        (WarningKind::RadiusNoise, MOST_ALIKE),
    ];
    for (kind, most) in by_chance {
        let count = fits.iter().filter(|fit| fit.warns_of(kind)).count();
        let is_usual = expected.contains(&kind) || count <= most;
        assert!(is_usual, "{name}: {count} {kind:?}");
    }
    let known = [
        WarningKind::StructuredResiduals,
        WarningKind::OffsetHinted,
        WarningKind::RadiusNoise,
    ];
    let expected = [expected, &known, &OF_SOFT_FILMS].concat();
    let unexpected: Vec<_> = fits.iter().flat_map(|fit| doubts(fit, &expected)).collect();
    // Each of some ten tests for doubts in a fit has a chance of 7e-6 of a false alarm.
    assert!(unexpected.is_empty(), "{name}: {unexpected:?}");
}

/// Fits the data sets of `seeds`, and asserts that their intervals hold the values of `truth`, as
/// [`assert_coverage`] says.
pub fn assert_recovers(
    name: &str,
    truth: &Experiment,
    seeds: Range<u64>,
    fit_of: impl Fn(u64) -> Fit + Sync + Send,
    expected: &[WarningKind],
) {
    let fits: Vec<Fit> = seeds.into_par_iter().map(fit_of).collect();
    let truth = |parameter: Parameter, _| truth.get(parameter).expect("a value");
    assert_coverage(name, &fits, truth, expected);
}

/// Fits the data sets with the seeds from `200 seed` on.
fn recover(name: &str, imagined: &Imagined, seed: u64, expected: &[WarningKind]) {
    let exact = imagined.exact();
    let fit_of = |seed| imagined.fit_of(&imagined.measured(&exact, seed));
    let seeds = SETS * seed..SETS * (seed + 1);
    assert_recovers(name, &imagined.truth, seeds, fit_of, expected);
}

/// What contacts of a paraboloid as wide as a film is thick are told: they would be other ones under a sphere.
const OF_WIDE_CONTACTS: [WarningKind; 2] = [WarningKind::LargeStrain, WarningKind::LargeContact];

#[test]
fn a_lens_on_a_film() {
    let kind = Kind::LoadRadius;
    let thin = lens();
    recover("lens", &thin, 1, &[]);
    let estimated = Imagined {
        noise_is_known: false,
        ..thin.clone()
    };
    recover("lens, noise not known", &estimated, 2, &[]);
    let mut offset = thin;
    offset.free.push(Free::new(LoadOffset));
    offset.truth.load_offset = 2e-5;
    recover("lens, load offset", &offset, 3, &[]);
    // The nodes of the table end at a/t of 1000.
    let thinnest = Imagined::lens(kind, 50e-9, 5e-6, &LENS);
    recover("lens, a/t of 840 to 2620", &thinnest, 41, &[]);
    let free = [SphereModulus, WorkOfAdhesion, FilmModulus];
    let thick = Imagined::lens(kind, 100e-6, 5e-7, &free);
    recover("lens, film modulus", &thick, 4, &OF_WIDE_CONTACTS);
}

#[test]
fn a_lens_with_adhesion_hysteresis() {
    let free = [SphereModulus, WorkOfAdhesion, WorkOfAdhesionReceding];
    let mut lens = Imagined::lens(Kind::LoadRadius, 10e-6, 5e-6, &free);
    lens.course = Course::Cycle;
    lens.radii[0] = 60e-6;
    lens.truth.work_of_adhesion = 0.03;
    lens.truth.work_of_adhesion_receding = Some(0.06);
    recover("lens, hysteresis", &lens, 5, &[]);
}

#[test]
fn penetrations_at_contact_radii() {
    let free = [WorkOfAdhesion, FilmModulus, ContactPoint];
    let mut lens = Imagined::lens(Kind::PenetrationRadius, 100e-6, 5e-9, &free);
    lens.truth.contact_point = -3e-7;
    lens.points[0] = 60;
    recover("penetration, radius", &lens, 6, &OF_WIDE_CONTACTS);
}

#[test]
fn a_lens_at_penetrations() {
    let free = [SphereModulus, WorkOfAdhesion, ContactPoint];
    let mut lens = Imagined::lens(Kind::LoadPenetration, 10e-6, 3e-6, &free);
    lens.truth.contact_point = 2e-7;
    recover("load, penetration", &lens, 7, &[WarningKind::ZeroNotSeen]);
    lens.course = Course::Retract;
    lens.radii[0] = 10e-6;
    lens.points = [80, 40];
    lens.truth.load_offset = -1e-5;
    lens.free.push(Free::new(LoadOffset));
    recover("load, penetration, retract to pull-off", &lens, 8, &[]);
}

#[test]
fn a_probe_on_a_gel() {
    let strain = [WarningKind::LargeStrain];
    let probe = Imagined::probe(Course::Retract, 1e-4, &FORCE_CURVE);
    recover("probe, retract", &probe, 9, &strain);
    let mut thickness = probe;
    thickness.free.push(Free::new(Parameter::FilmThickness));
    thickness.radii[1] = 7e-6;
    let warnings = [
        WarningKind::LargeStrain,
        WarningKind::LargeContact,
        WarningKind::Friction,
    ];
    recover("probe, film thickness", &thickness, 10, &warnings);
    let free = [FilmModulus, ContactPoint, Baseline];
    let hertz = Imagined::probe(Course::Approach, 0.0, &free);
    recover("probe, approach without adhesion", &hertz, 11, &strain);
}

#[test]
fn a_probe_with_adhesion_hysteresis() {
    let free = [
        FilmModulus,
        WorkOfAdhesion,
        WorkOfAdhesionReceding,
        ContactPoint,
        Baseline,
        BaselineSlope,
    ];
    let mut probe = Imagined::probe(Course::Cycle, 5e-5, &free);
    probe.truth.work_of_adhesion_receding = Some(1.5e-4);
    probe.truth.baseline_slope = 2e-4;
    recover("probe, cycle", &probe, 12, &[WarningKind::LargeStrain]);
}

#[test]
fn a_probe_on_a_half_space() {
    let mut probe = Imagined::probe(Course::Retract, 1e-4, &FORCE_CURVE);
    probe.truth.bodies = half_space(20e-6, f64::INFINITY, solid(2e4, 0.5));
    recover("probe, half-space", &probe, 13, &[]);
}

#[test]
fn a_hard_probe_on_a_hard_coating() {
    let free = [FilmModulus, ContactPoint];
    let mut probe = Imagined::lens(Kind::LoadPenetration, 2e-6, 1e-4, &free);
    probe.truth.bodies = Bodies::coated(&rigid_sphere(100e-6, [4e11, 0.2], 2e-6, [2e11, 0.3]));
    probe.truth.work_of_adhesion = 0.0;
    probe.truth.contact_point = 1e-8;
    probe.radii = [0.2e-6, 4e-6];
    probe.points = [100, 0];
    recover("hard coating", &probe, 14, &[WarningKind::Friction]);
}

#[test]
fn five_percent_of_outliers() {
    let outliers = [WarningKind::Outliers, WarningKind::LargeStrain];
    let mut lens = lens();
    lens.points[0] = 120;
    lens.outliers = true;
    lens.loss = Loss::HUBER;
    recover("lens, outliers, Huber", &lens, 15, &outliers);
    lens.noise_is_known = false;
    recover("lens, outliers, noise not known", &lens, 16, &outliers);
    let mut probe = Imagined::probe(Course::Retract, 1e-4, &FORCE_CURVE);
    probe.outliers = true;
    probe.loss = Loss::SOFT_L1;
    recover("probe, outliers, soft L1", &probe, 17, &outliers);
}

#[test]
fn films_of_three_thicknesses_share_their_modulus() {
    let free = [SphereModulus, FilmModulus, WorkOfAdhesion, LoadOffset];
    let lenses = [(20e-6, 1e-5), (60e-6, -2e-5), (150e-6, 3e-5)].map(|(thickness, offset)| {
        let mut lens = Imagined::lens(Kind::LoadRadius, thickness, 2e-6, &free);
        lens.truth.load_offset = offset;
        lens
    });
    let exact = lenses.each_ref().map(Imagined::exact);
    let fit_of = |seed: u64| {
        let measured = lenses.iter().zip(&exact).zip(0..);
        let experiments: Vec<Experiment> = measured
            .map(|((lens, exact), i)| lens.measured(exact, 3 * seed + i))
            .collect();
        fit_all(&experiments, &lenses[0].free).expect("sound data")
    };
    let fits: Vec<Fit> = (SETS * 18..SETS * 19).into_par_iter().map(fit_of).collect();
    let truth = |parameter, experiment: Option<usize>| {
        let lens = &lenses[experiment.unwrap_or(0)];
        lens.truth.get(parameter).expect("a value")
    };
    // Three are shared, three are own.
    assert_eq!(fits[0].estimates.len(), 6);
    assert_coverage("three films", &fits, truth, &[WarningKind::LargeStrain]);
}

/// The data of the example `lens` are the loads of direct solves with noise.
#[test]
fn the_data_of_the_example_are_made_as_they_say() {
    let lens = Imagined::lens(Kind::LoadRadius, 10e-6, 5e-6, &[]);
    let made = lens.measured(&lens.exact(), 10).measurement.points;
    let read = of_file("examples/synthetic-10um.csv", lens.truth.bodies);
    let read = read.measurement.points;
    assert_eq!(read.len(), made.len());
    for (read, made) in read.iter().zip(made) {
        let errors = [
            (read.abscissa / made.abscissa - 1.0) / 1e-6,
            (read.ordinate - made.ordinate) / 1e-9,
        ];
        let are_close = errors.iter().all(|error| error.abs() < 1.0);
        assert!(are_close, "{read:?}, not {made:?}");
    }
}

#[test]
fn wrong_starts_lead_to_the_truth_or_are_doubted() {
    let lens = [SphereModulus, WorkOfAdhesion, FilmModulus];
    let experiments = [
        Imagined::lens(Kind::LoadRadius, 100e-6, 5e-7, &lens),
        Imagined::probe(Course::Retract, 1e-4, &FORCE_CURVE[..3]),
    ];
    let (mut recovered, mut refused) = (0, 0);
    for mut imagined in experiments {
        for factor in [1e-4, 1e-2, 0.1, 10.0, 1e2, 1e4] {
            let truth = imagined.truth.get(FilmModulus).expect("a film");
            for free in &mut imagined.free {
                if free.parameter == FilmModulus {
                    *free = Free::new(FilmModulus).starting_from(factor * truth);
                }
            }
            let experiment = imagined.measured(&imagined.exact(), 3);
            let found = match fit_all(&[experiment], &imagined.free) {
                Ok(found) => found,
                Err(error) => {
                    assert_names(&error.to_string(), "where the fit starts; another start");
                    refused += 1;
                    continue;
                }
            };
            let estimate = found.estimate(FilmModulus).expect("free");
            let off = (estimate.value - truth).abs() / estimate.standard_error;
            let kinds = [WarningKind::PoorFit, WarningKind::NotConverged];
            let is_doubted = kinds.iter().any(|kind| found.warns_of(*kind));
            let is_recovered = found.converged && off < 4.5;
            assert!(is_recovered || is_doubted, "{factor:e}: {found:?}");
            recovered += usize::from(is_recovered);
        }
    }
    // Of 12.
    let counts = [recovered, refused];
    assert!(recovered >= 8 && refused <= 2, "{counts:?}");
}
