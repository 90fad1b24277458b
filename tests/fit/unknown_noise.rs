//! Doubts where nobody gives the noise: it is estimated, and the same tests run.

use acceptance::assert_names;
use fit::{Experiment, Fit, Free, Kind, Parameter, WarningKind};

use crate::imagined::{Course, Imagined, LENS, fit_with, text};

fn fitted(experiment: &Experiment, free: &[Free]) -> Fit {
    // A zero of the instrument that is wrong puts points beyond the end of their branch.
    fit_with(experiment, free, |options| options.allow_left_out = true).expect("sound")
}

/// Fits with and without the noise.
fn both(experiment: &Experiment, free: &[Free], noise: f64) -> [Fit; 2] {
    [Some(noise), None].map(|noise| {
        let mut experiment = experiment.clone();
        experiment.noise = noise;
        fitted(&experiment, free)
    })
}

#[test]
fn an_offset_that_is_not_fitted_is_missed_with_and_without_the_noise() {
    let mut missed = Vec::new();
    let mut compare = |case: String, [with, without]: &[Fit; 2]| {
        let [with, without] = [with, without].map(|fit| fit.warns_of(WarningKind::OffsetWanted));
        println!("{case}: {with}, {without}");
        if with && !without {
            missed.push(case);
        }
    };
    for points in [10, 20, 40] {
        let mut lens = Imagined::lens(Kind::LoadRadius, 10e-6, 5e-6, &LENS);
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
    let exact = probe.exact();
    for (parameter, change) in [
        (Parameter::ContactPoint, 5e-8),
        (Parameter::Baseline, 4e-10),
        (Parameter::BaselineSlope, 2e-3),
    ] {
        for seed in 0..10 {
            let mut experiment = probe.measured(&exact, seed);
            let truth = experiment.get(parameter).expect("a value");
            experiment
                .set(parameter, truth + change)
                .expect("any value");
            let fits = both(&experiment, &probe.free, probe.noise);
            if seed == 1 {
                let said = text(&fits[0], WarningKind::OffsetWanted);
                assert_names(&said, &format!("{parameter}; free it"));
            }
            compare(format!("{parameter}, seed {seed}"), &fits);
        }
    }
    assert!(missed.is_empty(), "{missed:?}");
}

#[test]
fn a_model_that_does_not_describe_the_data_is_doubted_without_the_noise_too() {
    let lens = Imagined::lens(Kind::LoadRadius, 100e-6, 5e-6, &LENS);
    let exact = lens.exact();
    for seed in 0..20 {
        let mut experiment = lens.measured(&exact, seed);
        experiment
            .set(Parameter::FilmThickness, 10e-6)
            .expect("physical");
        for found in both(&experiment, &lens.free, lens.noise) {
            assert!(found.warns_of(WarningKind::PoorFit), "{:?}", found.warnings);
        }
        // The true film is described.
        for found in both(&lens.measured(&exact, seed), &lens.free, lens.noise) {
            assert!(
                !found.warns_of(WarningKind::PoorFit),
                "{:?}",
                found.warnings
            );
        }
    }
}

/// The 95 % quantiles of Student's distribution are published: 12.706 with 1 degree of freedom, 3.182
/// with 3.
#[test]
fn a_report_says_what_standard_errors_of_few_points_mean() {
    for (points, said) in [
        (
            3,
            "1 degree of freedom, so few that 95 % of the true values lie within 12.7 standard",
        ),
        (
            5,
            "3 degrees of freedom, so few that 95 % of the true values lie within 3.2 standard",
        ),
        (40, "38 degrees of freedom\n"),
    ] {
        let mut lens = Imagined::lens(Kind::LoadRadius, 30e-6, 2e-6, &LENS);
        lens.points = [points, 0];
        let mut experiment = lens.measured(&lens.exact(), 1);
        experiment.noise = None;
        let here = fitted(&experiment, &lens.free);
        let report = fit::report::report(&here, std::slice::from_ref(&lens.truth), &[], &[]);
        assert!(report.contains(said), "{report}");
    }
}
