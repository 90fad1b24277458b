//! What points, known values and priors weigh in a fit.

use std::f64::consts::PI;

use acceptance::solid;
use fit::{Branch, Experiment, Fit, Fixed, Free, Kind, Known, Likelihood, Loss, Parameter};
use interp::Table;

use crate::imagined::{
    Course, Imagined, LENS, fit_with, fitted, free_of, half_space, measurement_of,
};

/// A force curve with hysteresis, some of whose points are pinned.
fn hysteretic(free: &[Parameter]) -> Imagined {
    let mut probe = Imagined::probe(Course::Cycle, 5e-5, free);
    probe.truth.work_of_adhesion_receding = Some(1.5e-4);
    probe
}

/// The branches of a fit are those of its model, and not only of data. Pinned points count in the likelihood as in the
/// fit.
#[test]
fn predictions_and_likelihoods_on_the_branches_of_a_fit_are_those_of_the_fit() {
    let probe = hysteretic(&[Parameter::FilmModulus, Parameter::ContactPoint]);
    let mut experiment = probe.measured(&probe.exact(), 1);
    let found = fitted(&experiment, &probe.free);
    for one in &found.estimates {
        experiment.set(one.parameter, one.value).expect("physical");
    }
    let points = &found.experiments[0].points;
    let branches: Vec<Branch> = points.iter().map(|point| point.branch).collect();
    assert!(branches.contains(&Branch::Pinned));
    let predicted = experiment.predictions(Table::embedded(), Some(&branches), &[]);
    let predicted = predicted.expect("sound");
    assert_eq!(predicted.branches, branches);
    for (point, ordinate) in points.iter().zip(&predicted.ordinates) {
        if let Some(fit) = point.fit {
            assert!(
                (ordinate - fit).abs() <= 1e-3 * probe.noise,
                "{point:?}: {ordinate}"
            );
        }
    }
    let (table, experiments) = (Table::embedded(), [experiment]);
    let likelihood = Likelihood::new(table, &experiments, &probe.free, Some(&[branches]));
    let values: Vec<f64> = found.estimates.iter().map(|one| one.value).collect();
    let value = likelihood.expect("sound").value(table, &values);
    let value = value.expect("in range");
    let of_points = points.iter().filter_map(|point| {
        let part = point.residual()? / probe.noise;
        Some(-0.5 * part * part - ((2.0 * PI).sqrt() * probe.noise).ln())
    });
    let expected = of_points.sum::<f64>();
    assert!((value / expected - 1.0).abs() < 1e-9, "{value} {expected}");
}

#[test]
fn the_error_of_a_known_value_moves_estimates_together() {
    let lens = Imagined::lens(Kind::LoadRadius, 30e-6, 1e-6, &LENS);
    let experiment = lens.measured(&lens.exact(), 1);
    for (quantity, error) in [
        (Fixed::Parameter(Parameter::FilmThickness), 1.5e-6),
        (Fixed::SphereRadius, 1e-5),
        (Fixed::Parameter(Parameter::FilmModulus), 1e5),
    ] {
        let found = |known: &[Known]| {
            let fit = fit_with(&experiment, &lens.free, |of| of.known = known.to_vec());
            fit.expect("sound")
        };
        let (with, bare) = (found(&[Known { quantity, error }]), found(&[]));
        let one = &with.fixed_values[0];
        let moved = [0, 1].map(|i| one.changes[i] / one.step * error);
        let [before, after] =
            [&bare, &with].map(|fit| [0, 1].map(|i| fit.estimates[i].standard_error));
        let covariance = bare.correlation[0][1] * before[0] * before[1] + moved[0] * moved[1];
        let expected = covariance / (after[0] * after[1]);
        let found = with.correlation[0][1];
        assert!((found - expected).abs() < 1e-12, "{found} {expected}");
        // The modulus without the film is off by fewer standard errors.
        let off = |fit: &Fit| {
            let without = fit.without_film.as_ref().expect("JKR");
            without.modulus.expect("it is free").standard_errors
        };
        let expected = off(&bare) * before[0] / after[0];
        assert!((off(&with) / expected - 1.0).abs() < 1e-12);
    }
}

#[test]
fn the_ends_of_an_interval_under_a_robust_loss_are_equally_likely() {
    let mut lens = Imagined::lens(Kind::LoadRadius, 30e-6, 5e-6, &LENS);
    lens.points[0] = 12;
    // A prior that is eight of its errors away.
    lens.free[0] = Free::new(LENS[0]).with_prior(2.4e6, 5e4);
    let experiment = lens.measured(&lens.exact(), 3);
    let Loss::Huber { threshold } = Loss::HUBER else {
        unreachable!("it is Huber's")
    };
    let huber = |r: f64| {
        let linear = threshold * (2.0 * r.abs() - threshold);
        if r.abs() <= threshold { r * r } else { linear }
    };
    let found = fit_with(&experiment, &lens.free, |options| {
        options.loss = Loss::HUBER;
        options.profile_level = Some(0.95);
    });
    let found = found.expect("sound");
    let [low, high] = found.estimates[0].profile.expect("asked for");
    // The loss with the modulus fixed at an end, and the work of adhesion found.
    let misfit = |modulus: f64| {
        let mut fixed = experiment.clone();
        fixed.set(LENS[0], modulus).expect("physical");
        let free = [Free::new(LENS[1])];
        let fit = fit_with(&fixed, &free, |options| options.loss = Loss::HUBER);
        let fit = fit.expect("sound");
        let points = fit.experiments[0].points.iter();
        let parts = points.filter_map(|point| Some(huber(point.residual()? / point.deviation)));
        parts.sum::<f64>() + huber((modulus - 2.4e6) / 5e4)
    };
    let least = misfit(found.estimates[0].value);
    let [low, high] = [low, high].map(|end| misfit(end) - least);
    assert!((low / high - 1.0).abs() < 0.03 && low > 1.0, "{low} {high}");
}

/// Hertz's contact, in which an error of the radius as large as the radius cannot make it negative, and one near the
/// end of the sphere is that of the other side.
fn hertz(radii: &[f64], abscissa_noise: f64) -> Fit {
    let (radius, modulus) = (1e-3, 2e6);
    let load = |a: f64| 4.0 / 3.0 * modulus * a.powi(3) / radius;
    let points = radii.iter().map(|&a| [a, load(a)]);
    let bodies = half_space(radius, modulus, solid(f64::INFINITY, 0.25));
    let mut experiment = Experiment::new(measurement_of(Kind::LoadRadius, points), bodies);
    experiment.noise = Some(1e-6);
    experiment.abscissa_noise = abscissa_noise;
    fitted(&experiment, &free_of(&[Parameter::SphereModulus]))
}

#[test]
fn an_error_of_a_radius_makes_none_negative() {
    let noise = 3e-7;
    let found = hertz(&[2e-7, 4e-5, 6e-5, 8e-5, 1e-4], noise);
    for point in &found.experiments[0].points[1..] {
        let slope = 4.0 * 2e6 * point.abscissa.powi(2) / 1e-3;
        let expected = 1e-6_f64.hypot(slope * noise);
        let off = point.deviation / expected - 1.0;
        // Of the third power the rule of three nodes adds (noise/a)^2.
        assert!(off.abs() < 1e-3, "{:e}: {off:e}", point.abscissa);
    }
}

#[test]
fn at_the_end_of_the_sphere_the_other_side_stands_for_both() {
    let noise = 1e-6;
    let found = hertz(&[2e-4, 4e-4, 6e-4, 8e-4, 9.99e-4], noise);
    let step = 3.0_f64.sqrt() * noise;
    for point in &found.experiments[0].points {
        let load = |a: f64| 4.0 / 3.0 * 2e6 * a.powi(3) / 1e-3;
        let change = (load(point.abscissa) - load(point.abscissa - step)) / 3.0_f64.sqrt();
        let off = point.deviation / 1e-6_f64.hypot(change) - 1.0;
        assert!(off.abs() < 1e-6, "{:e}: {off:e}", point.abscissa);
    }
}

#[test]
fn derivatives_of_pinned_points_are_differences() {
    let mut probe = hysteretic(&[Parameter::FilmModulus]);
    probe.truth.baseline_slope = 2e-4;
    let experiment = probe.planned();
    let branches = experiment.branches(&[]).expect("sound");
    let found = fitted(&experiment, &probe.free);
    let points = &found.experiments[0].points;
    let is_pinned = |&i: &usize| points[i].branch == Branch::Pinned;
    let pinned: Vec<usize> = (0..branches.len()).filter(is_pinned).collect();
    assert!(pinned.len() > 5, "{pinned:?}");
    for (parameter, step) in [
        (Parameter::BaselineSlope, 1e-6),
        (Parameter::Baseline, 1e-12),
        (Parameter::ContactPoint, 1e-11),
        (Parameter::WorkOfAdhesion, 1e-9),
        (Parameter::FilmModulus, 1e-1),
    ] {
        let at = |by: f64| {
            let mut moved = experiment.clone();
            let value = moved.get(parameter).expect("a value") + by;
            moved.set(parameter, value).expect("physical");
            let predictions = moved.predictions(Table::embedded(), Some(&branches), &[parameter]);
            predictions.expect("sound")
        };
        let (before, here, after) = (at(-step), at(0.0), at(step));
        let derivative = |i: usize| (after.ordinates[i] - before.ordinates[i]) / (2.0 * step);
        let sizes = pinned.iter().map(|&i| derivative(i).abs());
        let size = sizes.fold(0.0, f64::max);
        for &i in &pinned {
            let off = (here.derivatives[i] - derivative(i)).abs() / size;
            assert!(off < 1e-5, "{parameter}, {i}: {off:e}");
        }
    }
}
