//! Errors of the abscissae: the effective variance, and whether the intervals hold the truth.

use std::f64::consts::PI;

use acceptance::{Contacts, Refused, rigid_sphere, solid};
use fit::data::{Format, read_from};
use fit::{Bodies, Error, Experiment, Fit, Free, Kind, Loss, Parameter, PointErrors, WarningKind};
use interp::Table;

use crate::imagined::{
    Course, Imagined, LENS, assert_no_doubts, assert_silent, assert_warned, assert_warns, fit_all,
    fit_with, half_space, lens, number_after, off, text,
};
use crate::recovery::{SETS, assert_recovers};

/// 0.3 um, which in these loads is more than their own noise.
const RADIUS_NOISE: f64 = 3e-7;

/// Returns an experiment whose abscissae are off by normal numbers times `noise(i)`.
fn blurred(mut experiment: Experiment, noise: impl Fn(usize) -> f64, seed: u64) -> Experiment {
    let mut random = Contacts::new(seed ^ 0x5eed);
    for (i, point) in experiment.measurement.points.iter_mut().enumerate() {
        point.abscissa += noise(i) * random.normal();
    }
    experiment
}

fn fitted(experiment: Experiment, imagined: &Imagined, loss: Loss) -> Fit {
    fit_with(&experiment, &imagined.free, |options| options.loss = loss).expect("sound")
}

/// Asserts that the intervals of fits hold the truth as often as they say.
fn recover(
    name: &str,
    imagined: &Imagined,
    seeds: u64,
    expected: &[WarningKind],
    make: impl Fn(Experiment, u64) -> Experiment + Sync,
) {
    let exact = imagined.exact();
    let one = |seed: u64| {
        let experiment = make(imagined.measured(&exact, seed), seed);
        fitted(experiment, imagined, imagined.loss)
    };
    let range = SETS * seeds..SETS * (seeds + 1);
    assert_recovers(name, &imagined.truth, range, one, expected);
}

/// A film between rigid bodies, whose loads rise with a high power of the radius.
fn film_between_rigid_bodies() -> Imagined {
    let free = [Parameter::FilmModulus, Parameter::WorkOfAdhesion];
    let mut film = Imagined {
        radii: [140e-6, 300e-6],
        points: [20, 0],
        ..Imagined::lens(Kind::LoadRadius, 60e-6, 1e-5, &free)
    };
    film.truth.work_of_adhesion = 0.05;
    film.truth.bodies = Bodies::coated(&rigid_sphere(5e-3, [8e5, 0.49], 60e-6, [7e10, 0.22]));
    film
}

#[test]
fn the_truth_is_within_the_intervals_with_noise_in_the_radius() {
    let with_noise = |mut experiment: Experiment, seed| {
        experiment.abscissa_noise = RADIUS_NOISE;
        blurred(experiment, |_| RADIUS_NOISE, seed)
    };
    recover("radius noise", &lens(), 101, &[], with_noise);
    let robust = Imagined {
        loss: Loss::HUBER,
        ..lens()
    };
    recover("radius noise, huber", &robust, 102, &[], with_noise);
    let unknown = Imagined {
        noise: 2e-5,
        noise_is_known: false,
        ..lens()
    };
    recover("radius, not known", &unknown, 103, &[], with_noise);
    // A first model that is too stiff takes the points for farther off than they are.
    let film = film_between_rigid_bodies();
    let expected = [WarningKind::LargeStrain, WarningKind::Friction];
    recover(
        "film, radius noise",
        &film,
        105,
        &expected,
        |mut experiment, seed| {
            experiment.abscissa_noise = 1e-6;
            blurred(experiment, |_| 1e-6, seed)
        },
    );
    // Radii ten times as uncertain at one end as at the other, as columns give them.
    let of_point = |i: usize| 1e-7 * (1.0 + 0.25 * i as f64);
    recover(
        "radius noise, by points",
        &lens(),
        104,
        &[],
        |mut experiment, seed| {
            let count = experiment.measurement.points.len();
            experiment.errors = PointErrors {
                abscissa: (0..count).map(of_point).collect(),
                ordinate: vec![5e-6; count],
            };
            experiment.noise = None;
            blurred(experiment, of_point, seed)
        },
    );
}

#[test]
fn the_truth_is_within_the_intervals_with_noise_in_the_height() {
    let free = [Parameter::FilmModulus, Parameter::ContactPoint];
    let probe = Imagined::probe(Course::Approach, 0.0, &free);
    let noise = 3e-9;
    recover("height noise", &probe, 105, &[], |mut experiment, seed| {
        experiment.abscissa_noise = noise;
        blurred(experiment, |_| noise, seed)
    });
}

#[test]
fn noise_in_the_radius_that_is_not_given_is_a_poor_fit_under_any_loss() {
    // The noise of the loads is far below that of the radii: chi^2 is some 100.
    let lens = Imagined::lens(Kind::LoadRadius, 10e-6, 1e-6, &LENS);
    let exact = lens.exact();
    let blur = |seed| blurred(lens.measured(&exact, seed), |_| RADIUS_NOISE, seed);
    for loss in [Loss::Squares, Loss::HUBER, Loss::SOFT_L1] {
        for seed in 0..20 {
            let found = fitted(blur(seed), &lens, loss);
            assert_warned(&found, WarningKind::PoorFit);
            let mut given = blur(seed);
            given.abscissa_noise = RADIUS_NOISE;
            let found = fitted(given, &lens, loss);
            assert_no_doubts(&found, &[]);
        }
    }
    // One outlier in ten is what a robust loss is for, and no reason to doubt the model.
    for loss in [Loss::HUBER, Loss::SOFT_L1] {
        for seed in 0..20 {
            let mut experiment = lens.measured(&exact, seed);
            for point in experiment.measurement.points.iter_mut().skip(3).step_by(10) {
                point.ordinate += 4e-5;
            }
            let found = fitted(experiment, &lens, loss);
            assert_silent(&found, WarningKind::PoorFit);
        }
    }
}

/// Whether residuals are errors of the radius or of the load is told by their sizes, where neither is given, or a noise of
/// the load that is too small for them.
#[test]
fn errors_of_radii_that_are_not_given_are_told_from_those_of_loads() {
    let mut film = film_between_rigid_bodies();
    film.noise_is_known = false;
    let exact = film.exact();
    let told = |radius_noise: f64, load_noise: f64, is_outlier: bool, given| -> Vec<f64> {
        let fit = |seed| {
            let film = Imagined {
                noise: load_noise,
                ..film.clone()
            };
            let mut experiment = blurred(film.measured(&exact, seed), |_| radius_noise, seed);
            if is_outlier {
                experiment.measurement.points[17].ordinate += 8.0 * load_noise;
            }
            experiment.noise = given;
            let found = film.fit_of(&experiment);
            let is_told = found.warns_of(WarningKind::RadiusNoise);
            is_told.then(|| number_after(&text(&found, WarningKind::RadiusNoise), "of some "))
        };
        (0..40).filter_map(fit).collect()
    };
    for given in [None, Some(1e-6)] {
        let mut deviations = told(1e-6, 1e-6, false, given);
        deviations.sort_by(f64::total_cmp);
        let middle = deviations[deviations.len() / 2];
        assert!(
            deviations.len() > 30 && (middle / 1e-6 - 1.0).abs() < 0.2,
            "{deviations:?}"
        );
    }
    for given in [None, Some(1e-4), Some(5e-5)] {
        assert!(told(0.0, 1e-4, false, given).len() < 2);
        assert!(told(0.0, 1e-4, true, given).len() < 3);
    }
}

/// The equations of Johnson, Kendall and Roberts give the slope in closed form.
#[test]
fn the_effective_variance_is_that_of_the_slope() {
    let (radius, modulus, w) = (1e-3, 2e6, 0.04);
    let mut lens = Imagined::lens(Kind::LoadRadius, 1e-6, 5e-6, &LENS);
    lens.truth.bodies = half_space(radius, modulus, solid(f64::INFINITY, 0.25));
    let mut experiment = lens.measured(&lens.exact(), 1);
    experiment.abscissa_noise = RADIUS_NOISE;
    let found = fitted(experiment, &lens, Loss::Squares);
    let [modulus, w] = LENS.map(|parameter| {
        let found = found.estimate(parameter).expect("free").value;
        assert!((found / if parameter == LENS[0] { modulus } else { w } - 1.0).abs() < 0.3);
        found
    });
    let slope = |a: f64| 4.0 * modulus * a * a / radius - 1.5 * (8.0 * PI * w * modulus * a).sqrt();
    for point in &found.experiments[0].points {
        // Where the point most likely lies, by the tangent.
        let a = point.abscissa;
        let (tangent, above) = (slope(a), point.residual().expect("none is left out"));
        let variance = 5e-6_f64.powi(2) + (tangent * RADIUS_NOISE).powi(2);
        let a = a + above * tangent * RADIUS_NOISE.powi(2) / variance;
        let expected = 5e-6_f64.hypot(slope(a) * RADIUS_NOISE);
        let off = point.deviation / expected - 1.0;
        // The weights are those of the last round but one, to 1e-3.
        assert!(off.abs() < 2e-3, "{a:e}: {off:e}");
    }
}

/// A radius that is read too small is on a flatter part of the curve. With slopes and derivatives there, works of adhesion
/// are too small by two standard errors, and moduli by one.
#[test]
fn slopes_do_not_go_with_the_errors_of_the_radii() {
    const NOISE: f64 = 1e-6;
    let mut lens = Imagined {
        points: [1000, 0],
        radii: [4.5e-5, 1.3e-4],
        ..Imagined::lens(Kind::LoadRadius, 1e-6, 2e-6, &LENS)
    };
    lens.truth.bodies = half_space(1e-3, 2e6, solid(7e10, 0.2));
    let exact = lens.exact();
    let pulls = |seed| {
        let mut experiment = blurred(lens.measured(&exact, seed), |_| NOISE, seed);
        experiment.abscissa_noise = NOISE;
        let found = fitted(experiment, &lens, Loss::Squares);
        [(LENS[0], 2e6), (LENS[1], 0.04)].map(|(parameter, truth)| off(&found, parameter, truth))
    };
    let all: Vec<[f64; 2]> = (0..30).map(pulls).collect();
    for (k, parameter) in LENS.into_iter().enumerate() {
        let mean = all.iter().map(|pulls| pulls[k]).sum::<f64>() / all.len() as f64;
        println!("{parameter}: {mean:+.2} standard errors off in the mean");
        assert!(mean.abs() < 0.6, "{parameter}: {mean}");
    }
}

/// A radius is not moved below 0, whatever its error.
#[test]
fn a_small_radius_with_a_large_error_is_no_obstacle() {
    let lens = lens();
    for load in [-5e-5, 5e-5] {
        let mut experiment = lens.measured(&lens.exact(), 3);
        let mut small = experiment.measurement.points[0];
        (small.abscissa, small.ordinate) = (5e-6, load);
        experiment.errors.abscissa = vec![RADIUS_NOISE; experiment.measurement.points.len()];
        experiment.measurement.points.push(small);
        experiment.errors.abscissa.push(1e-5);
        // The start that such a point would give is not what is tested.
        let free = [
            Free::new(Parameter::SphereModulus).starting_from(1.2e6),
            Free::new(Parameter::WorkOfAdhesion).starting_from(0.03),
        ];
        let found = fit_with(&experiment, &free, |_| ()).expect("sound");
        assert!(found.converged, "{:?}", found.warnings);
    }
}

#[test]
fn columns_of_standard_deviations_are_read() {
    let read = |text: &str| read_from(text.as_bytes(), "lens.csv", &Format::default());
    let sound = |text: &str| read(text).expect(text);
    let reading =
        sound("Radius (um),Load [mN],radius_error,load std [uN]\n50,0.1,0.3,5\n60,0.2,0.4,6\n");
    let close = |found: &[f64], expected: [f64; 2]| {
        assert_eq!(found.len(), 2);
        let off = found.iter().zip(expected).map(|(f, e)| (f / e - 1.0).abs());
        assert!(off.fold(0.0, f64::max) < 1e-14, "{found:?}");
    };
    close(&reading.errors.abscissa, [0.3e-6, 0.4e-6]);
    close(&reading.errors.ordinate, [5e-6, 6e-6]);
    // A heading alone is that of the ordinate, in its unit; one in per cent is left alone.
    let reading =
        sound("contact_radius,load,sigma,load error [%]\n5e-5,1e-4,5e-6,1\n6e-5,2e-4,6e-6,1\n");
    close(&reading.errors.ordinate, [5e-6, 6e-6]);
    assert!(reading.errors.abscissa.is_empty());
    // The points of one direction keep their own.
    let format = Format {
        only: Some(fit::Direction::Retract),
        ..Format::default()
    };
    let text = "penetration [um],load [mN],std [uN],segment\n1,1,1,approach\n2,2,2,approach\n\
                2,2,5,retract\n1,1,6,retract\n";
    let reading = read_from(text.as_bytes(), "x.csv", &format).expect("sound");
    close(&reading.errors.ordinate, [5e-6, 6e-6]);
    // A deflection error of an AFM is a signal, not a standard deviation.
    let reading = sound("height,force,Deflection Error [V]\n1e-6,1e-9,0\n2e-6,2e-9,0\n");
    assert_eq!(reading.errors, PointErrors::default());
    // Numbers that are no standard deviations, with their place.
    let with = |cell: &str| {
        read(&format!(
            "contact_radius,load,load std [uN]\n5e-5,1e-4,5\n6e-5,2e-4,{cell}\n"
        ))
    };
    with("0").refused("line 3; load std [uN]; positive");
    with("-1").refused("line 3; load std [uN]; positive");
    with("").refused("line 3; load std [uN]; missing");
    let two = read("contact_radius,load,load std [uN],sigma load\n5e-5,1e-4,5,5\n6e-5,2e-4,5,5\n");
    two.refused("columns 3 and 4; load_error");
}

#[test]
fn what_is_no_standard_deviation_is_refused() {
    let lens = lens();
    let exact = lens.exact();
    let with = |edit: &dyn Fn(&mut Experiment)| {
        let mut experiment = lens.measured(&exact, 1);
        edit(&mut experiment);
        fit_all(&[experiment], &lens.free)
    };
    for noise in [-1e-7, f64::NAN, f64::INFINITY] {
        with(&|one| one.abscissa_noise = noise).refused("contact radius; imagined.csv; >= 0");
    }
    with(&|one| one.errors.ordinate = vec![1e-6; 3]).refused("errors of the load; 3; 40");
    with(&|one| one.errors.ordinate = vec![0.0; 40]).refused("imagined.csv; line 2; positive");
    let error = fit::forecast(
        Table::embedded(),
        std::slice::from_ref(&lens.truth),
        &lens.free,
    );
    assert!(matches!(error, Err(Error::Setting { .. })), "{error:?}");
}

/// Errors of the heights change no force off contact: one noise from all points is too small in contact.
/// Noise of the forces alone, and errors that are given, are no reason for doubt.
#[test]
fn noise_in_the_height_that_is_not_given_is_seen_beside_the_baseline() {
    let free = [Parameter::FilmModulus, Parameter::ContactPoint];
    let probe = Imagined {
        noise_is_known: false,
        points: [60, 120],
        ..Imagined::probe(Course::Approach, 0.0, &free)
    };
    let noise = 1e-8;
    let mut named = 0;
    for (seed, mut plain) in probe.data(0..20) {
        plain.noise = None;
        let experiment = blurred(plain.clone(), |_| noise, seed);
        let mut given = experiment.clone();
        given.abscissa_noise = noise;
        for loss in [Loss::Squares, Loss::HUBER] {
            for sound in [&plain, &given] {
                let found = fitted(sound.clone(), &probe, loss);
                assert_silent(&found, WarningKind::UnequalNoise);
            }
            let found = fitted(experiment.clone(), &probe, loss);
            // Points that scatter most at the end may also look like those of a wrong model.
            if found.warns_of(WarningKind::PoorFit)
                || found.warns_of(WarningKind::StructuredResiduals)
            {
                continue;
            }
            let words = "imagined.csv; in contact scatter; noise of the force; standard errors; too small; height";
            assert_warns(&found, WarningKind::UnequalNoise, words);
            named += 1;
            // A robust loss would take the baseline for the rule.
            if found.warns_of(WarningKind::Outliers) {
                assert!(!text(&found, WarningKind::Outliers).contains("robust"));
            }
        }
    }
    assert!(named >= 36, "{named}");
}
