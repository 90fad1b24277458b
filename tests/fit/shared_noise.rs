//! Penetrations that were computed from heights and deflections, against Hertz's formula.

use acceptance::{Contacts, solid};
use fit::{Experiment, Fit, Kind, Parameter, Point, WarningKind};

use crate::imagined::{fitted, free_of, half_space, measurement, number_after, off, text};

const RADIUS: f64 = 1e-5;
const MODULUS: f64 = 5e4;
const DEEPEST: f64 = 5e-7;

fn hertz(penetration: f64) -> f64 {
    4.0 / 3.0 * MODULUS * RADIUS.sqrt() * penetration.max(0.0).powf(1.5)
}

/// Fits 300 points with a noise of the force of 1 % of the largest, whose penetrations have an error of `-share/stiffness`
/// times that of the force, and one of their own.
fn found(kind: Kind, stiffness: f64, [share, own]: [f64; 2]) -> Fit {
    let mut random = Contacts::new(5);
    let point = |i: u32| {
        let exact = DEEPEST * (f64::from(i) / 230.0 - 0.3);
        let error = 0.01 * hertz(DEEPEST) * random.normal();
        let load = hertz(exact) + error;
        let penetration = exact + (own * random.normal() - share * error) / stiffness;
        let abscissa = match kind {
            Kind::ForceHeight => -(penetration + load / stiffness),
            _ => penetration,
        };
        Point {
            line: u64::from(i) + 1,
            abscissa,
            ordinate: load,
            direction: None,
        }
    };
    let points = (0..300).map(point).collect();
    let bodies = half_space(RADIUS, MODULUS, solid(f64::INFINITY, 0.3));
    let mut experiment = Experiment::new(measurement(kind, points), bodies);
    experiment.stiffness = (kind == Kind::ForceHeight).then_some(stiffness);
    fitted(
        &experiment,
        &free_of(&[Parameter::SphereModulus, Parameter::ContactPoint]),
    )
}

#[test]
fn a_deflection_that_was_taken_off_with_its_noise_is_named() {
    let stiffness = 0.1 * hertz(DEEPEST) / DEEPEST;
    let shared = found(Kind::LoadPenetration, stiffness, [1.0, 0.0]);
    let said = text(&shared, WarningKind::SharedNoise);
    let told = number_after(&said, "of a cantilever of ");
    assert!((told / stiffness - 1.0).abs() < 0.01, "{said}");
    let miss = 1.0 - shared.estimates[0].value / MODULUS;
    let part = 0.01 * number_after(&said, "here by ");
    assert!(
        miss > 0.05 && part < miss && part > 0.4 * miss,
        "{miss}: {said}"
    );
    assert!(!shared.warns_of(WarningKind::UnequalNoise));
    // The remedy that it names.
    let heights = found(Kind::ForceHeight, stiffness, [1.0, 0.0]);
    assert!(!heights.warns_of(WarningKind::SharedNoise));
    let off = off(&heights, Parameter::SphereModulus, MODULUS);
    assert!(off.abs() < 4.0, "{off}");
}

#[test]
fn noise_that_is_not_shared_or_does_not_matter_is_not_named() {
    let stiffness = 0.1 * hertz(DEEPEST) / DEEPEST;
    let own = 0.01 * hertz(DEEPEST);
    for (stiffness, errors) in [(stiffness, [0.0, own]), (100.0 * stiffness, [1.0, 0.0])] {
        let found = found(Kind::LoadPenetration, stiffness, errors);
        assert!(!found.warns_of(WarningKind::SharedNoise), "{errors:?}");
    }
}
