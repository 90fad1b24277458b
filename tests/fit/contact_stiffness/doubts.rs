//! Doubts about contact stiffnesses: deep contacts, contact depths, friction, units.

use std::f64::consts::PI;

use acceptance::{Refused, assert_names, solid};
use fit::{Bodies, Experiment, Free, Kind, Parameter, WarningKind, simulate};
use interp::{System, Table};

use super::{at_loads, at_radii, oxide};
use crate::imagined::{assert_warns, fit_all, fitted, free_of, measurement_at, number_after, text};
use crate::layers::{layer, modulus_of, on_layers};

/// Contacts of a fifth of the thickness of the top layer and of seven tenths of it.
fn on_primer(depths: [f64; 2]) -> Experiment {
    let system = oxide();
    let primer = layer("primer", solid(1.2e11, 0.34), 9e-7);
    let top = layer("top", system.film, 1e-7);
    let [from, to] = depths;
    let depths = (0..10).map(|i| from + (to - from) * f64::from(i) / 9.0);
    let depths = measurement_at(Kind::StiffnessDepth, depths);
    let mut plan = Experiment::new(depths, on_layers(&system, &[primer, top]));
    plan.indentation.hardness = Some(1e10);
    simulate(Table::embedded(), &plan, 0.01, 5).expect("a contact")
}

#[test]
fn a_contact_that_is_deep_in_the_top_layer_is_doubted() {
    let top = Free::new(modulus_of("top"));
    let mut made = on_primer([2e-8, 1e-7]);
    made.noise = Some(0.01);
    let depths = made.measurement.points.iter().zip(&made.indentation.loads);
    let deepest = depths.map(|(point, load)| point.abscissa - 0.75 * load / point.ordinate);
    let deepest = deepest.fold(0.0, f64::max);
    let said = text(&fitted(&made, &[top]), WarningKind::DeepContact);
    let percent = number_after(&said, "the contact depth reaches ");
    let error = percent - 1e9 * deepest;
    assert!(error.abs() < 0.51, "{deepest:e}: {said}");
}

#[test]
fn the_depth_of_a_plastic_contact_is_said() {
    let depths = (0..20).map(|i| 5e-8 + 1e-8 * f64::from(i));
    let depths = measurement_at(Kind::StiffnessDepth, depths);
    let mut plan = Experiment::new(depths, Bodies::coated(&oxide()));
    plan.indentation.hardness = Some(8e8);
    let mut made = simulate(Table::embedded(), &plan, 0.0, 5).expect("a contact");
    made.noise = Some(1e-3);
    let pairs = made.measurement.points.iter().zip(&made.indentation.loads);
    let parts = pairs.map(|(point, load)| 1.0 - 0.75 * load / point.ordinate / point.abscissa);
    let mut parts: Vec<f64> = parts.collect();
    parts.sort_by(f64::total_cmp);
    let middle = 0.5 * (parts[9] + parts[10]);
    let found = fitted(&made, &free_of(&[Parameter::FilmModulus]));
    let said = text(&found, WarningKind::ContactDepth);
    let part = number_after(&said, "contact depth over depth ");
    assert!((part - middle).abs() < 0.0051, "{middle}: {said}");
}

#[test]
fn a_hardness_that_is_found_leaves_no_bounds_by_friction() {
    let mut exact = at_loads(&oxide(), [5e-8, 1e-6], 30);
    exact.bodies.sphere_modulus = f64::INFINITY;
    exact.bodies.base = solid(f64::INFINITY, 0.25);
    for point in &mut exact.measurement.points {
        point.ordinate = 0.0;
    }
    let mut made = simulate(Table::embedded(), &exact, 1e-4, 3).expect("a contact");
    made.noise = Some(1e-4);
    for (free, expected) in [
        (&[Parameter::FilmModulus][..], "is between"),
        (
            &[Parameter::FilmModulus, Parameter::Hardness],
            "also changes the contact radius",
        ),
    ] {
        let found = fitted(&made, &free_of(free));
        assert_warns(&found, WarningKind::Friction, expected);
    }
}

#[test]
fn the_noise_of_an_abscissa_has_its_unit() {
    let mut exact = at_loads(&oxide(), [5e-8, 1e-6], 30);
    exact.noise = Some(0.01);
    exact.abscissa_noise = 1e-6;
    let found = fitted(&exact, &free_of(&[Parameter::FilmModulus]));
    let report = fit::report::report(&found, &[exact], &[], &[]);
    assert_names(&report, "noise 1.00 %, of the abscissa 1.00 uN");
}

#[test]
fn loads_of_a_contact_stiffness_have_a_range_of_loads() {
    let exact = at_radii(&oxide(), [5e-8, 1e-6], 5);
    for (factor, words) in [
        (1.0, None),
        (1e9, Some("range of the load; nN were probably taken")),
    ] {
        let mut made = exact.clone();
        made.measurement.kind = Kind::StiffnessLoad;
        for point in &mut made.measurement.points {
            point.abscissa = factor * PI * 1e10 * point.abscissa.powi(2);
        }
        let told: Vec<String> = made.magnitudes().iter().map(ToString::to_string).collect();
        match words {
            Some(words) => assert_names(&told.join("; "), words),
            None => assert!(told.is_empty(), "{told:?}"),
        }
    }
}

#[test]
fn a_top_layer_that_is_thinned_to_nothing_is_refused() {
    let mut made = on_primer([2e-8, 1.6e-7]);
    made.noise = Some(0.01);
    made.indentation.thinning = 1.0;
    let top = Free::new(modulus_of("top"));
    fit_all(&[made], &[top]).refused("contact depth; something of the thinned film is left");
}

/// Contacts that are small beside the film say less of a thicker film than of a thinner one, at depths as at radii.
#[test]
fn an_error_that_is_too_small_on_one_side_is_told() {
    let system = System {
        film_thickness: 4e-6,
        ..oxide()
    };
    let at_radii = at_radii(&system, [1e-7, 4e-7], 20);
    let mut at_depths = at_radii.clone();
    at_depths.measurement.kind = Kind::StiffnessDepth;
    at_depths.indentation.hardness = Some(8e9);
    for point in &mut at_depths.measurement.points {
        point.abscissa *= 0.5;
    }
    let free = free_of(&[Parameter::FilmThickness]);
    for plan in [at_radii, at_depths] {
        let fitted_with = |noise: f64| {
            let made = simulate(Table::embedded(), &plan, noise, 1);
            let mut made = made.expect("a contact");
            made.noise = Some(noise);
            fitted(&made, &free)
        };
        let found = fitted_with(0.03);
        let said = text(&found, WarningKind::NonlinearError);
        let thickness = number_after(&said, "too small on one side: ");
        let estimate = &found.estimates[0];
        // Five standard errors of the logarithm above the value.
        let expected = estimate.value * (5.0 * estimate.standard_error / estimate.value).exp();
        assert!((thickness / expected - 1.0).abs() < 1e-3, "{said}");
        assert!(number_after(&said, "chi^2 by ") < 16.0, "{said}");
        // With a tenth of the noise the problem is linear as far as the data allow.
        assert!(!fitted_with(0.003).warns_of(WarningKind::NonlinearError));
    }
}
