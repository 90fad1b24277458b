//! Intervals of the profile likelihood are nested, contain the estimate, and say why they are open.

use acceptance::{assert_names, paper_system, solid};
use fit::{Bodies, Estimate, Experiment, Fit, Free, Kind, Loss, Parameter, WarningKind};
use interp::System;
use rayon::prelude::*;

use crate::drawn::Drawn;
use crate::imagined::{
    Course, FORCE_CURVE, Imagined, LENS, assert_silent, fit_with, of_file, profiled, text,
};

const LEVELS: [f64; 4] = [0.5, 0.68, 0.95, 0.99];

/// Fits an experiment with intervals of each level.
fn fits(experiment: &Experiment, free: &[Free], loss: Loss) -> Option<Vec<Fit>> {
    let of_level = |level: f64| {
        let found = fit_with(experiment, free, |options| {
            options.loss = loss;
            options.profile_level = Some(level);
        });
        found.ok()
    };
    LEVELS.into_iter().map(of_level).collect()
}

/// Asserts that the intervals contain the estimates, that those of one minimum are nested, and that
/// a missing end has a reason. Returns the number of estimates with four intervals of one minimum.
fn assert_sound(name: &str, fits: &[Fit]) -> usize {
    let mut compared = 0;
    for i in 0..fits[0].estimates.len() {
        let all: Vec<Estimate> = fits.iter().map(|fit| fit.estimates[i]).collect();
        for (fit, estimate) in fits.iter().zip(&all) {
            let Some([low, high]) = estimate.profile else {
                assert!(!fit.converged, "{name}: {estimate:?}");
                continue;
            };
            let is_open = [low, high].iter().any(|end| !end.is_finite())
                || (estimate.parameter.is_positive() && low == 0.0);
            let words = format!("interval of {} ", estimate.parameter);
            let at_zero = format!("{} = ", estimate.parameter);
            let mut at_bound = fit
                .warnings
                .iter()
                .filter(|one| one.kind == WarningKind::AtBound);
            let is_named = text(fit, WarningKind::OpenInterval).contains(&words)
                || at_bound
                    .any(|one| one.text.starts_with(&at_zero) && one.text.contains("ended at 0"));
            assert_eq!(is_open, is_named, "{name}: {estimate:?}");
            for (end, is_outside) in [(low, low > estimate.value), (high, high < estimate.value)] {
                assert!(end.is_nan() || !is_outside, "{name}: {estimate:?}");
            }
        }
        let is_one = all.windows(2).all(|pair| pair[0].value == pair[1].value);
        let ends: Option<Vec<[f64; 2]>> = all.iter().map(|estimate| estimate.profile).collect();
        let Some(ends) = ends.filter(|_| is_one) else {
            continue;
        };
        compared += 1;
        for pair in ends.windows(2) {
            let ([low, high], [lower, higher]) = (pair[0], pair[1]);
            assert!(!(lower > low || higher < high), "{name}: {all:?}");
        }
    }
    compared
}

/// The data of the example of the program, with the specimen of its comment.
fn lens() -> Experiment {
    let system = System {
        substrate: solid(1.6e11, 0.27),
        ..paper_system(3e-5)
    };
    let mut experiment = of_file("data/lens.csv", Bodies::coated(&system));
    experiment.work_of_adhesion = 0.04;
    // The noise is 2e-6 N: this one is far too large, so that only small parts of it matter.
    experiment.noise = Some(1e-4);
    experiment
}

#[test]
fn four_values_of_a_lens_with_a_robust_loss_have_nested_intervals() {
    let all = [
        Parameter::SphereModulus,
        Parameter::FilmModulus,
        Parameter::FilmThickness,
        Parameter::WorkOfAdhesion,
        Parameter::LoadOffset,
    ];
    let mut compared = 0;
    for fixed in all {
        let free = all.iter().filter(|one| **one != fixed);
        let free: Vec<Free> = free.copied().map(Free::new).collect();
        let fits = fits(&lens(), &free, Loss::HUBER).expect("sound data");
        compared += assert_sound(&format!("lens without {fixed}"), &fits);
    }
    assert!(compared >= 12, "{compared}");
}

#[test]
fn intervals_of_random_fits_are_nested() {
    let one = |seed: u64| {
        let mut drawn = Drawn::new(seed);
        let loss = [Loss::Squares, Loss::HUBER, Loss::SOFT_L1][seed as usize % 3];
        if seed.is_multiple_of(4) {
            drawn.experiment.noise = drawn.experiment.noise.map(|noise| 50.0 * noise);
        }
        let fits = fits(&drawn.experiment, &drawn.free, loss);
        fits.map_or(0, |fits| assert_sound(&format!("seed {seed}"), &fits))
    };
    let compared: usize = (0..60).into_par_iter().map(one).sum();
    assert!(compared > 90, "{compared}");
}

#[test]
fn an_open_interval_gives_the_reason() {
    let free = [
        Parameter::FilmModulus,
        Parameter::FilmThickness,
        Parameter::WorkOfAdhesion,
        Parameter::LoadOffset,
    ]
    .map(Free::new);
    let fits = fits(&lens(), &free, Loss::HUBER).expect("sound data");
    let text = text(&fits[3], WarningKind::OpenInterval);
    // Of modulus and thickness the data determine a combination only: the open interval may be that of
    // either.
    let unit = if text.contains("film-modulus") {
        " Pa,"
    } else {
        " m,"
    };
    let words = ["interval of film-", "has no ", " end: ", unit];
    assert_names(&text, &words);
    assert_names(&text, "give it a prior");
}

#[test]
fn intervals_of_few_points_hold_the_truth_as_often_as_their_level_says() {
    for (points, noise_is_known) in [(4, false), (4, true), (6, false)] {
        let mut lens = Imagined::lens(Kind::LoadRadius, 30e-6, 2e-6, &LENS);
        lens.points = [points, 0];
        lens.noise_is_known = noise_is_known;
        let exact = lens.exact();
        let holds = |seed: u64| {
            let found = profiled(&lens.measured(&exact, seed), &lens.free);
            found.estimates.iter().all(|estimate| {
                let truth = lens.truth.get(estimate.parameter).expect("a value");
                let [low, high] = estimate.profile.expect("it was asked for");
                truth >= low && truth <= high
            })
        };
        let many = 300_u64;
        let seeds = (0..many).into_par_iter();
        let held = seeds.filter(|&seed| holds(seed)).count();
        // Both at once: between 0.95^2 of independent ones and 0.95. Three standard deviations of a
        // count are 4 %.
        let part = held as f64 / many as f64;
        assert!((0.86..=0.99).contains(&part), "{points} points: {part}");
    }
}

/// Without adhesion the data still tell how large it is at most.
#[test]
fn a_work_of_adhesion_that_vanishes_has_an_upper_end() {
    let probe = Imagined::probe(Course::Approach, 0.0, &FORCE_CURVE);
    let exact = probe.exact();
    let (mut told, mut ended) = (0, 0);
    for seed in 0..20 {
        let found = profiled(&probe.measured(&exact, seed), &probe.free);
        let work = found.estimate(Parameter::WorkOfAdhesion).expect("free");
        let [_, most] = work.profile.expect("asked for");
        // 1.5 pi w R is 0.1 nN, the noise of a point, at 1 uJ/m^2.
        assert!(most.is_nan() || most < 1e-4, "seed {seed}: {work:?}");
        told += u32::from(most.is_finite());
        // A work of adhesion that the data do not tell is none that no bodies have, and one that ended at 0 has no range.
        assert_silent(&found, WarningKind::Implausible);
        if found.warns_of(WarningKind::AtBound) {
            assert_silent(&found, WarningKind::LongRange);
            ended += 1;
        }
    }
    assert!(told >= 18 && ended > 0, "{told} and {ended} of 20");
}
