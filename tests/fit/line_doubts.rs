//! What a fit says where adhesion depends on the speed of the contact line by another law than the fitted one, or where no law
//! is fitted.

use fit::{Direction, Experiment, Fixed, Parameter, Point, Scale, WarningKind};

use crate::imagined::{assert_silent, assert_warns, fit_with, fitted, free_of};
use crate::line_speed::{LAW, LINE, contact, moved, read, with_noise};
use Parameter::{FilmModulus, WorkOfAdhesion, WorkOfAdhesionReceding};

/// The work of adhesion grows with the logarithm of the speed, not with a power.
#[test]
fn another_law_than_the_fitted_one_is_doubted() {
    let (noise, exact, contact) = ([1e-7, 1e-6], read(&moved(LINE), [120, 180]), contact());
    let [w, v0, _] = LINE;
    let logarithmic = |point: &Point| {
        let rate = contact.energy_release_rate_at_load(point.abscissa, point.ordinate);
        let ratio = rate.expect("in the table") / w;
        // The exponent is 1/2.
        let speed = v0 * (ratio.max(ratio.recip()) - 1.0).powi(2);
        let factor = 1.0 + 0.5 * (speed / 1e-7).ln_1p();
        let other = if ratio > 1.0 { w * factor } else { w / factor };
        contact.load(point.abscissa, other).expect("in the table")
    };
    let mut other = exact.clone();
    for point in &mut other.measurement.points {
        point.ordinate = logarithmic(point);
    }
    let words = "does not follow this law of the speed of the contact line";
    for seed in 0..5 {
        for (exact, is_other) in [(&exact, false), (&other, true)] {
            let mut measured = with_noise(exact.clone(), noise, seed);
            measured.abscissa_noise = noise[0];
            measured.noise = Some(noise[1]);
            let found = fitted(&measured, &free_of(&LAW));
            let is_doubted = found.warnings.iter().any(|one| one.text.contains(words));
            assert_eq!(is_doubted, is_other, "{:?}", found.warnings);
        }
    }
}

#[test]
fn adhesion_that_depends_on_the_way_alone_is_told() {
    let mut measured = read(&moved(LINE), [60, 120]);
    let contact = contact();
    for point in &mut measured.measurement.points {
        let work = if point.direction == Some(Direction::Retract) {
            0.1
        } else {
            0.05
        };
        point.ordinate = contact.load(point.abscissa, work).expect("in the table");
    }
    let mut measured = with_noise(measured, [2e-7, 2e-6], 1);
    measured.abscissa_noise = 2e-7;
    measured.noise = Some(2e-6);
    let found = fitted(&measured, &free_of(&LAW));
    assert_warns(&found, WarningKind::Undetermined, "on the way alone");
}

#[test]
fn without_the_law_such_data_ask_for_it() {
    let noise = [2e-7, 2e-6];
    let measured = with_noise(read(&moved(LINE), [30, 60]), noise, 1);
    let two_works = [FilmModulus, WorkOfAdhesion, WorkOfAdhesionReceding];
    for free in [&two_works[..2], &two_works[..]] {
        let found = fitted(&measured, &free_of(free));
        let asks = "free doubling-speed and speed-exponent";
        assert_warns(&found, WarningKind::Hysteresis, asks);
        let untimed = Experiment {
            times: Vec::new(),
            ..measured.clone()
        };
        let found = fitted(&untimed, &free_of(free));
        let loop_of = found
            .warnings
            .iter()
            .find(|one| one.kind == WarningKind::Hysteresis);
        assert!(!loop_of.expect("a loop").text.contains(asks));
    }
    let found = fitted(&measured, &free_of(&LAW));
    for kind in [
        WarningKind::Hysteresis,
        WarningKind::PinnedLine,
        WarningKind::MixedBranches,
    ] {
        assert_silent(&found, kind);
    }
}

/// The speeds are read from the radii, and err with them.
#[test]
fn a_scale_of_the_radii_counts_for_the_speeds() {
    let exact = read(&moved(LINE), [60, 120]);
    let free = free_of(&LAW);
    let of = |experiment: &Experiment| {
        let told = fit_with(experiment, &free, |options| options.fixed_values = true);
        told.expect("sound")
    };
    let here = of(&exact);
    let mut larger = exact;
    for point in &mut larger.measurement.points {
        point.abscissa *= 1.01;
    }
    let refitted = of(&larger);
    let radii = Fixed::Scale(Scale::ContactRadius);
    let mut rows = here.fixed_values.iter();
    let row = rows.find(|one| one.quantity == radii).expect("listed");
    let both = here.estimates.iter().zip(&refitted.estimates);
    for ((before, after), change) in both.zip(&row.changes) {
        let by_fit = after.value - before.value;
        let name = before.parameter;
        assert!(
            (change / by_fit - 1.0).abs() < 0.1,
            "{name}: {change:e}, by fits {by_fit:e}"
        );
    }
}
