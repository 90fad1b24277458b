//! Penetrations that were computed from heights and deflections, against Hertz's formula.

use acceptance::{Contacts, assert_close, solid};
use fit::{Experiment, Fit, Kind, Parameter, WarningKind};

use crate::imagined::{
    assert_silent, fitted, free_of, half_space, measurement_of, number_after, off, text,
};

const RADIUS: f64 = 1e-5;
const MODULUS: f64 = 5e4;
const DEEPEST: f64 = 5e-7;

fn hertz(penetration: f64) -> f64 {
    4.0 / 3.0 * MODULUS * RADIUS.sqrt() * penetration.max(0.0).powf(1.5)
}

/// What a set of points has.
#[derive(Clone, Copy)]
struct Made {
    count: u32,
    stiffness: f64,
    /// Whether the noise of the loads is taken off the penetrations.
    is_shared: bool,
    /// The noise of the penetrations by themselves, over that of the loads divided by the stiffness.
    own: f64,
    /// The tension before the contact jumps off, over the largest load.
    pull: f64,
    seed: u64,
}

const SHARED: Made = Made {
    count: 300,
    stiffness: 0.1,
    is_shared: true,
    own: 0.0,
    pull: 0.0,
    seed: 5,
};

impl Made {
    fn stiffness(&self) -> f64 {
        self.stiffness * hertz(DEEPEST) / DEEPEST
    }

    /// Fits loads with a noise of 1 % of the largest.
    fn fit(self, kind: Kind) -> Fit {
        let (largest, stiffness) = (hertz(DEEPEST), self.stiffness());
        let mut random = Contacts::new(self.seed);
        let point = |i: u32| {
            let mut exact = DEEPEST * (1.3 * f64::from(i) / f64::from(self.count - 1) - 0.3);
            let mut load = hertz(exact);
            if exact < 0.0 {
                // Off contact, as far as the spring has gone back.
                exact -= self.pull * largest / stiffness;
            } else {
                load -= self.pull * largest * (1.0 - exact / DEEPEST);
            }
            let error = 0.01 * largest * random.normal();
            let own = 0.01 * largest * self.own * random.normal();
            let shared = if self.is_shared { error } else { 0.0 };
            let (load, penetration) = (load + error, exact + (own - shared) / stiffness);
            let abscissa = match kind {
                Kind::ForceHeight => -(penetration + load / stiffness),
                _ => penetration,
            };
            [abscissa, load]
        };
        let points = (0..self.count).map(point);
        let bodies = half_space(RADIUS, MODULUS, solid(f64::INFINITY, 0.3));
        let mut experiment = Experiment::new(measurement_of(kind, points), bodies);
        experiment.stiffness = (kind == Kind::ForceHeight).then_some(stiffness);
        let free = [Parameter::SphereModulus, Parameter::ContactPoint];
        fitted(&experiment, &free_of(&free))
    }
}

#[test]
fn a_deflection_that_was_taken_off_with_its_noise_is_named() {
    for (count, own, seed) in [
        (300, 0.0, 5),
        (300, 0.0, 6),
        (3000, 0.0, 7),
        (300, 1.0, 8),
        (3000, 1.0, 9),
    ] {
        let made = Made {
            count,
            own,
            seed,
            ..SHARED
        };
        let shared = made.fit(Kind::LoadPenetration);
        let said = text(&shared, WarningKind::SharedNoise);
        let told = number_after(&said, "of a cantilever of ");
        assert_close(told, made.stiffness(), 0.1);
        let miss = 1.0 - shared.estimates[0].value / MODULUS;
        let part = 0.01 * number_after(&said, "here by ");
        // Of the noise of the penetrations, some is their own.
        let share = 0.4 / (1.0 + own * own);
        assert!(
            part < miss && part > share * miss,
            "{count}, {own}, {miss}: {said}"
        );
        assert_silent(&shared, WarningKind::UnequalNoise);
        // The remedy that it names.
        let heights = made.fit(Kind::ForceHeight);
        assert_silent(&heights, WarningKind::SharedNoise);
        let off = off(&heights, Parameter::SphereModulus, MODULUS);
        assert!(own > 0.0 || off.abs() < 4.0, "{count}: {off}");
    }
}

/// Nor is the step of a contact that jumps off in an instrument that gives way, in which load and penetration change
/// together.
#[test]
fn noise_that_is_not_shared_or_does_not_matter_is_not_named() {
    for (count, stiffness, is_shared, own, pull) in [
        (300, 0.1, false, 1.0, 0.0),
        (300, 10.0, true, 0.0, 0.0),
        (300, 0.1, false, 0.3, 0.2),
        (60, 0.1, false, 0.3, 0.2),
        (1000, 0.1, false, 0.3, 0.5),
    ] {
        for seed in 0..10 {
            let made = Made {
                count,
                stiffness,
                is_shared,
                own,
                pull,
                seed,
            };
            assert_silent(&made.fit(Kind::LoadPenetration), WarningKind::SharedNoise);
        }
    }
}
