//! Errors of an experiment that no residual shows, by as much as the documents say.

use acceptance::{Contacts, rigid_probe, solid};
use contact::Contact;
use fit::{Experiment, Fit, Kind, Measurement, Parameter, WarningKind};
use interp::{Probe, Table};

use crate::imagined::{assert_silent, fit_with, free_of, half_space, measurement_of};

/// The radius of a lens, m, and the reduced modulus, Pa, of the half-space that it touches.
const RADIUS: f64 = 1e-3;
const MODULUS: f64 = 2e6;
/// What a rigid lens on a half-space tells.
const LENS_OF_FILM: [Parameter; 2] = [Parameter::FilmModulus, Parameter::WorkOfAdhesion];

/// Makes loads by JKR at contact radii from the first to the second, with the work of adhesion at each, and 2 uN and 0.3 um of noise.
fn lens([from, to]: [f64; 2], work: impl Fn(f64) -> f64, seed: u64) -> Measurement {
    let mut random = Contacts::new(seed);
    let points = (0..60).map(|i| {
        let a = from + (to - from) * f64::from(i) / 59.0;
        let hertz = 4.0 / 3.0 * MODULUS * a.powi(3) / RADIUS;
        let pull = (8.0 * std::f64::consts::PI * MODULUS * work(a) * a.powi(3)).sqrt();
        [
            a + 3e-7 * random.normal(),
            hertz - pull + 2e-6 * random.normal(),
        ]
    });
    measurement_of(Kind::LoadRadius, points)
}

fn fitted(measured: Measurement, radius: f64, free: &[Parameter]) -> Fit {
    let is_lens = measured.kind == Kind::LoadRadius;
    let mut experiment =
        Experiment::new(measured, half_space(radius, f64::INFINITY, solid(1e6, 0.5)));
    if is_lens {
        experiment.noise = Some(2e-6);
        experiment.abscissa_noise = 3e-7;
    }
    fit_with(&experiment, &free_of(free), |_| ()).expect("sound")
}

/// Returns the mean over seeds of what a fit finds, after its residuals have raised no doubt in most of them.
fn mean(parameter: Parameter, fit: impl Fn(u64) -> Fit) -> f64 {
    let found: Vec<Fit> = (0..20).map(fit).collect();
    let is_silent = |one: &&Fit| {
        let kinds = [WarningKind::PoorFit, WarningKind::StructuredResiduals];
        !one.warnings
            .iter()
            .any(|warning| kinds.contains(&warning.kind))
    };
    let silent = found.iter().filter(is_silent).count();
    assert!(silent >= 15, "{silent} of 20");
    let values = found
        .iter()
        .map(|one| one.estimate(parameter).expect("free").value);
    values.sum::<f64>() / found.len() as f64
}

#[test]
fn radii_that_are_all_too_large_change_the_work_of_adhesion() {
    let shifted = |seed| {
        let mut measured = lens([45e-6, 130e-6], |_| 0.04, seed);
        for point in &mut measured.points {
            point.abscissa += 1.5e-6;
        }
        fitted(
            measured,
            RADIUS,
            &[LENS_OF_FILM[0], LENS_OF_FILM[1], Parameter::LoadOffset],
        )
    };
    let work = mean(Parameter::WorkOfAdhesion, shifted);
    assert!((work / 0.04 - 1.13).abs() < 0.02, "{work}");
    let offset = mean(Parameter::LoadOffset, shifted);
    assert!((offset - 22e-6).abs() < 3e-6, "{offset}");
}

#[test]
fn adhesion_that_changes_on_the_way_back_changes_the_modulus() {
    let work = |a: f64| 0.11 - 0.02 * (a - 50e-6) / 70e-6;
    let back = |seed| fitted(lens([120e-6, 50e-6], work, seed), RADIUS, &LENS_OF_FILM);
    let modulus = mean(Parameter::FilmModulus, back) / (0.75 * MODULUS);
    assert!((modulus - 1.09).abs() < 0.01, "{modulus}");
}

#[test]
fn a_drift_of_the_position_changes_the_modulus_of_an_approach() {
    let free = [Parameter::FilmModulus, Parameter::ContactPoint];
    let drifts = |seed| {
        let mut random = Contacts::new(seed);
        let load = |depth: f64| 4.0 / 3.0 * MODULUS * RADIUS.sqrt() * depth.max(0.0).powf(1.5);
        let points = (0..150).map(|i| {
            let depth = 1e-6 * (f64::from(i) / 130.0 - 20.0 / 130.0);
            [
                depth * 1.04,
                load(depth) + 0.003 * load(1e-6) * random.normal(),
            ]
        });
        fitted(measurement_of(Kind::LoadPenetration, points), RADIUS, &free)
    };
    let modulus = mean(Parameter::FilmModulus, drifts) / (0.75 * MODULUS);
    assert!((modulus - 0.94).abs() < 0.01, "{modulus}");
    assert_silent(&drifts(0), WarningKind::SpringWanted);
}

/// A lens that is a cap of height `h` on glass, on a rigid sample, is a film under a rigid sphere.
#[test]
fn a_cap_bears_more_than_a_half_space() {
    let (radius, height) = (2e-3, 1e-3);
    let sphere = Probe::Paraboloid { radius };
    let cap = rigid_probe(sphere, solid(0.75 * MODULUS, 0.5), height, solid(7e10, 0.2));
    let contact = Contact::in_table(Table::embedded(), &cap).expect("in the table");
    for (part, percent) in [(0.2, 0.6), (0.3, 2.0), (0.5, 7.9)] {
        let a = part * height;
        let hertz = 4.0 / 3.0 * MODULUS * a.powi(3) / radius;
        let more = 1e2 * (contact.load(a, 0.0).expect("in the table") / hertz - 1.0);
        assert!((more - percent).abs() < 0.05, "{part}: {more}");
    }
}
