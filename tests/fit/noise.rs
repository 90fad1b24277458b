//! Doubts about the noise: given too large, hidden by errors of the abscissae, or not independent; and
//! priors that the data contradict.

use acceptance::{Contacts, assert_names};
use fit::{Experiment, Fit, Free, Kind, Parameter, WarningKind};

use crate::imagined::{Imagined, fit_with, text};

const LENS: [Parameter; 2] = [Parameter::SphereModulus, Parameter::WorkOfAdhesion];

/// The lens of the paper on a film of 10 um; the noise of its loads is 5 uN.
fn lens() -> Imagined {
    Imagined::lens(Kind::LoadRadius, 10e-6, 5e-6, &LENS)
}

fn fitted(experiment: &Experiment, free: &[Free]) -> Fit {
    fit_with(experiment, free, |_| ()).expect("sound")
}

#[test]
fn a_noise_that_is_given_too_large_is_doubted() {
    let lens = lens();
    let exact = lens.exact();
    for seed in 0..20 {
        let mut experiment = lens.measured(&exact, seed);
        experiment.noise = Some(10.0 * lens.noise);
        let said = text(&fitted(&experiment, &lens.free), WarningKind::LargeNoise);
        assert_names(&said, "scatter less; reduced chi^2; times too large");
        let times = said
            .split("some ")
            .nth(1)
            .and_then(|rest| rest.split(' ').next());
        let times: f64 = times
            .and_then(|times| times.parse().ok())
            .expect("a number");
        assert!((7.0..14.0).contains(&times), "{said}");
    }
}

/// The radii are exact, and 0.3 um of error are given: what they leave of the noise of the loads is told by
/// the few points near the smallest load.
#[test]
fn a_noise_that_errors_of_the_abscissae_hide_is_doubted_and_no_point_draws_the_fit_to_itself() {
    let lens = Imagined {
        noise: 2e-6,
        noise_is_known: false,
        ..lens()
    };
    let exact = lens.exact();
    let truth = |parameter| lens.truth.get(parameter).expect("a value");
    let [mut within, mut doubted] = [0; 2];
    for seed in 0..100 {
        let mut experiment = lens.measured(&exact, seed);
        experiment.noise = None;
        experiment.abscissa_noise = 3e-7;
        let found = fitted(&experiment, &lens.free);
        assert!(found.experiments[0].noise > 0.1 * lens.noise, "{found:?}");
        assert_names(
            &text(&found, WarningKind::NoiseNotSeen),
            "noise of the load; contact radius; degrees of freedom; give the noise",
        );
        doubted += usize::from(found.warns_of(WarningKind::LargeNoise));
        let work = found.estimate(Parameter::WorkOfAdhesion).expect("free");
        let [low, high] = work.interval(1.96);
        within += usize::from((low..=high).contains(&truth(Parameter::WorkOfAdhesion)));
    }
    println!("{within} of 100 within 1.96 standard errors, {doubted} with a noise given too large");
    assert!(within >= 80 && doubted >= 50, "{within}, {doubted}");
}

/// Noise whose neighbours have a correlation of 0.6.
#[test]
fn noise_that_is_not_independent_is_doubted_with_any_noise() {
    let mut lens = lens();
    lens.points[0] = 100;
    let exact = lens.exact();
    let mut doubted = [0; 2];
    for seed in 0..50 {
        let mut experiment = lens.measured(&exact, seed);
        experiment.measurement = exact.clone();
        let mut random = Contacts::new(seed);
        let mut error = random.normal();
        for point in &mut experiment.measurement.points {
            error = 0.6 * error + 0.8 * random.normal();
            point.ordinate += lens.noise * error;
        }
        for (count, noise) in doubted.iter_mut().zip([None, Some(lens.noise)]) {
            experiment.noise = noise;
            let found = fitted(&experiment, &lens.free);
            let said = text(&found, WarningKind::StructuredResiduals);
            if !said.is_empty() {
                assert_names(
                    &said,
                    "neighbouring residuals are alike; not independent; factor",
                );
                *count += 1;
            }
        }
    }
    assert!(
        doubted.iter().all(|&count| count >= 48),
        "{doubted:?} of 50"
    );
}

#[test]
fn a_prior_that_the_data_contradict_is_named_with_its_distance() {
    let mut lens = lens();
    let exact = lens.exact();
    for noise in [Some(lens.noise), None] {
        for seed in 0..20 {
            let mut experiment = lens.measured(&exact, seed);
            experiment.noise = noise;
            lens.free[0] = Free::new(LENS[0]).with_prior(3e6, 1e4);
            let said = text(&fitted(&experiment, &lens.free), WarningKind::Prior);
            assert_names(
                &said,
                "prior of sphere-modulus, 3.0000e6 +- 1.0e4 Pa; apart",
            );
            lens.free[0] = Free::new(LENS[0]).with_prior(2.02e6, 1e4);
            let found = fitted(&experiment, &lens.free);
            assert!(!found.warns_of(WarningKind::Prior), "{:?}", found.warnings);
        }
    }
}
