//! Doubts about the noise: given too large, hidden by errors of the abscissae, or not independent; and
//! priors that the data contradict.

use acceptance::{Contacts, assert_names};
use fit::{Experiment, Free, Loss, Parameter, Scope, Warning, WarningKind};

use crate::imagined::{
    Imagined, LENS, assert_silent, assert_warns, fit_all, fit_with, fitted, lens, number_after,
    text,
};

#[test]
fn a_noise_that_is_given_too_large_is_doubted() {
    let lens = lens();
    for (_, mut experiment) in lens.data(0..20) {
        experiment.noise = Some(10.0 * lens.noise);
        let found = fitted(&experiment, &lens.free);
        let words = "imagined.csv; noise that is given for the load; scatter less; reduced chi^2; leave it out";
        assert_warns(&found, WarningKind::LargeNoise, words);
        let said = text(&found, WarningKind::LargeNoise);
        let factor = number_after(&said, "by a factor of some ");
        assert!((7.0..14.0).contains(&factor), "{said}");
    }
}

/// Of two files the one whose noise is too large is named, and what is said is what was given.
#[test]
fn errors_that_are_given_too_large_are_named_with_their_file() {
    let lens = lens();
    let exact = lens.exact();
    let sound = lens.measured(&exact, 1);
    for (noise, abscissa_noise, words) in [
        (Some(5e-5), 0.0, "noise that is given for the load is"),
        (
            Some(5e-5),
            3e-7,
            "noise or the errors of the contact radius; leave the noise of the load out",
        ),
        (
            None,
            5e-6,
            "errors that are given for the contact radius are; or none",
        ),
    ] {
        let mut other = lens.measured(&exact, 2);
        other.measurement.name = "other.csv".into();
        other.noise = noise;
        other.abscissa_noise = abscissa_noise;
        let found = fit_all(&[sound.clone(), other], &lens.free).expect("sound");
        let said = text(&found, WarningKind::LargeNoise);
        assert_names(&said, &format!("other.csv; {words}"));
        assert!(!said.contains("imagined.csv"), "{said}");
        assert!(noise.is_some() || !said.contains("leave"), "{said}");
    }
}

/// Few points tell the noise with errors of the radii that do not matter as well as without.
#[test]
fn a_noise_of_few_points_does_not_depend_on_errors_that_do_not_matter() {
    let mut lens = lens();
    for points in [3, 4, 5, 7, 9, 12] {
        lens.points[0] = points;
        let exact = lens.exact();
        for (seed, loss) in (0..20).flat_map(|seed| [(seed, Loss::Squares), (seed, Loss::HUBER)]) {
            let mut experiment = lens.measured(&exact, seed);
            experiment.noise = None;
            let fits = [0.0, 1e-9].map(|abscissa_noise| {
                experiment.abscissa_noise = abscissa_noise;
                fit_with(&experiment, &lens.free, |options| options.loss = loss).expect("sound")
            });
            let told = fits.each_ref().map(|found| {
                let of_noise = |one: &&Warning| one.kind == WarningKind::NoiseNotSeen;
                found.warnings.iter().filter(of_noise).collect::<Vec<_>>()
            });
            assert_eq!(told[0], told[1], "{points} points");
            let [exact, inexact] = fits.each_ref().map(|found| found.experiments[0].noise);
            if loss == Loss::Squares {
                let change = inexact / exact - 1.0;
                assert!(change.abs() < 0.02, "{points} points, {seed}: {change}");
            }
        }
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
    let truth = lens.truth.work_of_adhesion;
    let [mut within, mut told, mut doubted] = [0; 3];
    for (_, mut experiment) in lens.data(0..400) {
        experiment.noise = None;
        experiment.abscissa_noise = 3e-7;
        let found = fitted(&experiment, &lens.free);
        assert!(found.experiments[0].noise > 0.1 * lens.noise, "{found:?}");
        let said = text(&found, WarningKind::NoiseNotSeen);
        assert_names(
            &said,
            "noise of the load; contact radius; degree; of freedom; Give the noise",
        );
        doubted += usize::from(found.warns_of(WarningKind::LargeNoise));
        let work = found.estimate(Parameter::WorkOfAdhesion).expect("free");
        let holds = |z: f64| {
            let [low, high] = work.interval(z);
            usize::from((low..=high).contains(&truth))
        };
        within += holds(1.96);
        told += holds(number_after(&said, "true values lie within "));
    }
    // Errors that are 1.2 times too small would make it 338 of the 400.
    assert!(within >= 340, "{within}");
    assert!(told >= 380 && doubted >= 350, "{told}, {doubted}");
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
            // One cause is said once.
            let kinds = [WarningKind::StructuredResiduals, WarningKind::PoorFit];
            let [alike, poor] = kinds.map(|kind| text(&found, kind));
            let are_both = !alike.is_empty() && !poor.is_empty();
            assert!(noise.is_some() || !are_both, "{poor}; {alike}");
            let is_poor = alike.is_empty() && noise.is_none();
            let said = if is_poor { poor } else { alike };
            if !said.is_empty() {
                assert_names(&said, "neighbouring; not independent; factor");
                let factor = number_after(&said, "too small by a factor of some ");
                assert!((1.1..3.5).contains(&factor), "{said}");
                *count += 1;
            }
        }
    }
    assert!(doubted.iter().all(|&count| count >= 48), "{doubted:?}");
}

#[test]
fn a_prior_that_the_data_contradict_is_named_with_its_distance() {
    let mut lens = lens();
    for noise in [Some(lens.noise), None] {
        for (_, mut experiment) in lens.data(0..20) {
            experiment.noise = noise;
            lens.free[0] = Free::new(LENS[0]).with_prior(3e6, 1e4);
            let found = fitted(&experiment, &lens.free);
            let words = "prior of sphere-modulus, 3.0000e6 +- 1.0e4 Pa; apart";
            assert_warns(&found, WarningKind::Prior, words);
            lens.free[0] = Free::new(LENS[0]).with_prior(2.02e6, 1e4);
            let found = fitted(&experiment, &lens.free);
            assert_silent(&found, WarningKind::Prior);
        }
    }
}

/// A number without a unit has none, and a value of one file is named with it.
#[test]
fn a_prior_is_named_with_its_unit_and_its_file() {
    let [ratio, work] = [Parameter::FilmPoissonRatio, Parameter::WorkOfAdhesion];
    let lens = lens();
    let exact = lens.exact();
    let first = lens.measured(&exact, 1);
    let mut second = lens.measured(&exact, 2);
    second.measurement.name = "second.csv".into();
    let prior = Free::new(work).with_prior(0.08, 1e-3);
    let free = [lens.free[0], prior.with_scope(Scope::Own)];
    let found = fit_all(&[first.clone(), second], &free).expect("sound");
    let words = "prior of work-of-adhesion of second.csv, 8.0000e-2 +- 1.0e-3 J/m^2, and; lies between them";
    assert_warns(&found, WarningKind::Prior, words);
    let free = [lens.free[1], Free::new(ratio).with_prior(0.1, 1e-3)];
    let words = "prior of film-poisson-ratio, 1.0000e-1 +- 1.0e-3, and; lies between";
    assert_warns(&fitted(&first, &free), WarningKind::Prior, words);
}

/// Of ten experiments in one fit, one that chance makes alike once in a thousand times is no reason.
#[test]
fn many_experiments_are_not_doubted_more_often_than_one() {
    const TEN: u64 = 10;
    let own = LENS.map(|parameter| Free::new(parameter).with_scope(Scope::Own));
    let lens = lens();
    let exact = lens.exact();
    let [mut sound, mut doubted] = [0; 2];
    for seed in 0..60 {
        let mut odd = lens.measured(&exact, seed);
        odd.measurement = exact.clone();
        let mut random = Contacts::new(seed);
        let mut error = random.normal();
        for point in &mut odd.measurement.points {
            error = 0.5 * error + 0.75_f64.sqrt() * random.normal();
            point.ordinate += lens.noise * error;
        }
        let alone = text(&fitted(&odd, &lens.free), WarningKind::StructuredResiduals);
        if alone.is_empty() {
            continue;
        }
        let deviations = number_after(&alone, "alike, by ");
        let mut ten: Vec<Experiment> = (1..TEN)
            .map(|i| lens.measured(&exact, 1000 + TEN * seed + i))
            .collect();
        ten.push(odd);
        let found = fit_all(&ten, &own).expect("sound");
        let warns = found.warns_of(WarningKind::StructuredResiduals);
        if deviations < 3.65 {
            assert!(!warns, "{alone}; {:?}", found.warnings);
            sound += 1;
        } else if deviations > 3.75 {
            assert!(warns, "{alone}");
            doubted += 1;
        }
    }
    assert!(sound >= 3 && doubted >= 3, "{sound}, {doubted}");
}
