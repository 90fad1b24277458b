//! Doubts where nobody gives the noise: it is estimated, and the same tests run.

use fit::{Experiment, Fit, Free, Kind, Parameter, WarningKind};

use crate::imagined::{
    Course, FORCE_CURVE, Imagined, LENS, assert_silent, assert_warned, assert_warns, fit_all,
    fitted_of_few, lens, off,
};

/// Fits with and without the noise. A zero of the instrument that is wrong puts points beyond the end of
/// their branch.
fn both(experiment: &Experiment, free: &[Free], noise: f64) -> [Fit; 2] {
    [Some(noise), None].map(|noise| {
        let mut experiment = experiment.clone();
        experiment.noise = noise;
        fitted_of_few(&experiment, free)
    })
}

#[test]
fn an_offset_that_is_not_fitted_is_missed_with_and_without_the_noise() {
    let mut missed = Vec::new();
    let mut compare = |case: String, [with, without]: &[Fit; 2]| {
        let [with, without] = [with, without].map(|fit| fit.warns_of(WarningKind::OffsetWanted));
        if with && !without {
            missed.push(case);
        }
    };
    for points in [10, 20, 40] {
        let mut lens = lens();
        lens.points[0] = points;
        lens.truth.load_offset = 8e-5;
        for seed in 0..20 {
            let mut experiment = lens.measured(&lens.exact(), seed);
            experiment.load_offset = 0.0;
            let fits = both(&experiment, &lens.free, lens.noise);
            compare(format!("{points} points, seed {seed}"), &fits);
        }
    }
    let probe = Imagined::probe(Course::Retract, 1e-4, &[Parameter::FilmModulus]);
    for (parameter, change) in [
        (Parameter::ContactPoint, 5e-8),
        (Parameter::Baseline, 4e-10),
        (Parameter::BaselineSlope, 2e-3),
    ] {
        for (seed, mut experiment) in probe.data(0..10) {
            let truth = experiment.get(parameter).expect("a value");
            let wrong = truth + change;
            experiment.set(parameter, wrong).expect("any value");
            let fits = both(&experiment, &probe.free, probe.noise);
            if seed == 1 {
                let words = format!("{parameter}; free it");
                assert_warns(&fits[0], WarningKind::OffsetWanted, &words);
            }
            compare(format!("{parameter}, seed {seed}"), &fits);
        }
    }
    assert!(missed.is_empty(), "{missed:?}");
}

#[test]
fn a_model_that_does_not_describe_the_data_is_doubted_without_the_noise_too() {
    let lens = Imagined::lens(Kind::LoadRadius, 100e-6, 5e-6, &LENS);
    for (_, mut experiment) in lens.data(0..20) {
        // The true film is described.
        for found in both(&experiment, &lens.free, lens.noise) {
            assert_silent(&found, WarningKind::PoorFit);
        }
        let thickness = Parameter::FilmThickness;
        experiment.set(thickness, 10e-6).expect("physical");
        for found in both(&experiment, &lens.free, lens.noise) {
            assert_warned(&found, WarningKind::PoorFit);
        }
    }
}

/// The 95 % quantiles of Student's distribution are published: 12.706 with 1 degree of freedom, 3.182
/// with 3.
#[test]
fn what_standard_errors_of_few_points_mean_is_told() {
    for (points, said) in [
        (3, "1 degree of freedom; within 12.7 standard errors"),
        (5, "3 degrees of freedom; within 3.2 standard errors"),
    ] {
        let mut lens = Imagined::lens(Kind::LoadRadius, 30e-6, 2e-6, &LENS);
        lens.points = [points, 0];
        let [with, without] = both(&lens.measured(&lens.exact(), 1), &lens.free, lens.noise);
        assert!(!with.warns_of(WarningKind::NoiseNotSeen));
        assert_warns(&without, WarningKind::NoiseNotSeen, said);
    }
    assert_silent(&lens().fit(1), WarningKind::NoiseNotSeen);
}

/// Few points of a curve: their second differences are those of the curve, and not of the noise. All of the
/// contact counts.
#[test]
fn few_points_of_a_retract_are_not_taken_for_noise() {
    let mut probe = Imagined::probe(Course::Retract, 1e-4, &FORCE_CURVE[..3]);
    probe.points = [10, 5];
    probe.noise = 5e-11;
    for seed in 0..10 {
        let mut experiment = probe.measured(&probe.exact(), seed);
        experiment.noise = None;
        let found = fitted_of_few(&experiment, &probe.free);
        let modulus = found.estimate(Parameter::FilmModulus).expect("free");
        let off = (modulus.value / 2e4 - 1.0).abs();
        let error = modulus.standard_error / modulus.value;
        assert!(off < 0.02 && error < 0.02, "seed {seed}: {modulus:?}");
        let counting = found.experiments[0].points.iter();
        let counting = counting.filter(|point| point.fit.is_some()).count();
        assert!(counting >= 12, "seed {seed}: {counting} of 15");
    }
}

/// Files of few points with parameters in common: the noise is that of all, so that the truth is as near as
/// the standard errors say.
#[test]
fn short_files_have_their_noise_together() {
    let lens = |thickness: f64| {
        let mut lens = Imagined::lens(Kind::LoadRadius, thickness, 2e-6, &LENS);
        (lens.points[0], lens.noise_is_known) = (6, false);
        lens
    };
    let lenses = [3e-6, 6e-6, 14e-6, 30e-6].map(lens);
    let exact = lenses.each_ref().map(Imagined::exact);
    let mut squares = 0.0;
    const SETS: u64 = 100;
    for set in 0..SETS {
        let measured = (4 * set..).zip(lenses.iter().zip(&exact));
        let measured = measured.map(|(seed, (lens, exact))| lens.measured(exact, seed));
        let experiments: Vec<Experiment> = measured.collect();
        let found = fit_all(&experiments, &lenses[0].free).expect("sound");
        squares += off(&found, Parameter::SphereModulus, 2e6).powi(2);
    }
    let spread = (squares / SETS as f64).sqrt();
    // Student's t of 22 degrees of freedom has 1.05; the noise of each file alone gave 1.65.
    assert!(spread < 1.3, "{spread}");
}

/// Loads with a relative noise: one noise for all points is wrong, and a robust loss makes it worse.
#[test]
fn a_noise_that_grows_with_the_load_is_named() {
    let mut lens = Imagined::lens(Kind::LoadRadius, 30e-6, 0.0, &LENS);
    lens.points[0] = 100;
    for (seed, mut experiment) in lens.data(0..10) {
        let mut random = acceptance::Contacts::new(seed);
        experiment.noise = None;
        for point in &mut experiment.measurement.points {
            point.ordinate *= 1.0 + 0.02 * random.normal();
        }
        let found = fitted_of_few(&experiment, &lens.free);
        let words = "larger half of the loads; grows with the load; standard deviation";
        assert_warns(&found, WarningKind::UnequalNoise, words);
        for warning in &found.warnings {
            assert!(!warning.text.contains("robust"), "{warning:?}");
        }
    }
}
