//! What points, known values and priors weigh in a fit.

use std::f64::consts::PI;

use acceptance::{half_space_of, solid};
use fit::{
    Bodies, Branch, Direction, Experiment, Fit, Fixed, Free, Kind, Known, Likelihood, Loss,
    Parameter,
};
use interp::{Probe, Table};

use crate::imagined::{
    Course, Imagined, LENS, fit_with, fitted, free_of, half_space, measurement_at, measurement_of,
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

/// At contact radii load and penetration fall like the root of the work of adhesion: its derivative at 0 is none.
#[test]
fn a_work_of_adhesion_of_0_has_no_derivative_at_radii() {
    for kind in [Kind::LoadRadius, Kind::PenetrationRadius] {
        let bodies = half_space(1e-5, 5e4, solid(f64::INFINITY, 0.3));
        let experiment = Experiment::new(measurement_at(kind, [1e-6, 2e-6, 3e-6]), bodies);
        let derivatives = |by: &[Parameter]| {
            let predictions = experiment.predictions(Table::embedded(), None, by);
            predictions.expect("sound").derivatives
        };
        let of_modulus = derivatives(&[Parameter::SphereModulus]);
        let both = derivatives(&[Parameter::WorkOfAdhesion, Parameter::SphereModulus]);
        for (both, of_modulus) in both.chunks(2).zip(of_modulus) {
            assert_eq!(both, [0.0, of_modulus], "{kind:?}");
        }
    }
}

/// A cycle that turns before the contact point holds no line: its retract is that without the approach.
#[test]
fn a_turn_before_the_contact_pins_no_points() {
    let mut experiment = hysteretic(&[]).planned();
    let branches = experiment.branches(&[]).expect("sound");
    let heights = experiment
        .measurement
        .points
        .iter()
        .map(|point| point.abscissa);
    experiment.contact_point = heights.fold(f64::INFINITY, f64::min) - 1e-9;
    let predict = |experiment: &Experiment, branches: &[Branch]| {
        let predictions = experiment.predictions(Table::embedded(), Some(branches), &[]);
        predictions.expect("sound").ordinates
    };
    let is_retract =
        |i: usize| experiment.measurement.points[i].direction == Some(Direction::Retract);
    let both = predict(&experiment, &branches);
    let own: Vec<usize> = (0..both.len()).filter(|&i| is_retract(i)).collect();
    let mut retract = experiment.clone();
    retract
        .measurement
        .points
        .retain(|point| point.direction == Some(Direction::Retract));
    let alone = predict(
        &retract,
        &own.iter().map(|&i| branches[i]).collect::<Vec<_>>(),
    );
    assert!(own.iter().any(|&i| branches[i] == Branch::Receding));
    assert_eq!(own.iter().map(|&i| both[i]).collect::<Vec<_>>(), alone);
}

#[test]
fn another_stiffness_changes_the_forces_of_deflections_and_their_deviations() {
    let mut experiment = hysteretic(&[]).planned();
    experiment.from_deflection = true;
    let points = experiment.measurement.points.iter_mut();
    points
        .zip(1..)
        .for_each(|(point, i)| point.ordinate = 1e-9 * f64::from(i));
    experiment.errors.ordinate = vec![1e-10; experiment.measurement.points.len()];
    let stiffness = experiment.stiffness.expect("planned");
    let mut stiffer = experiment.clone();
    stiffer
        .set(Parameter::Stiffness, 2.0 * stiffness)
        .expect("positive");
    let twice = |before: f64, after: f64| assert_eq!(after, 2.0 * before);
    let forces = experiment
        .measurement
        .points
        .iter()
        .zip(&stiffer.measurement.points);
    forces.for_each(|(before, after)| twice(before.ordinate, after.ordinate));
    let errors = experiment
        .errors
        .ordinate
        .iter()
        .zip(&stiffer.errors.ordinate);
    errors.for_each(|(before, after)| twice(*before, *after));
}

/// The load of a flat punch is its stiffness times the penetration, and goes on so beyond the pull-off.
#[test]
fn a_flat_punch_goes_on_straight_beyond_its_pull_off() {
    let radius = 1e-5;
    let punch = half_space_of(
        Probe::FlatPunch { radius },
        f64::INFINITY,
        solid(7.5e5, 0.5),
    );
    let depths = (-10..=10).map(|i| 1e-7 * f64::from(i));
    let measurement = measurement_at(Kind::LoadPenetration, depths);
    let mut experiment = Experiment::new(measurement, Bodies::half_space(punch));
    // The pull-off is at -0.25 um.
    experiment.work_of_adhesion = 1e-3;
    let branches = [Branch::Advancing; 21];
    let found = experiment.predictions(Table::embedded(), Some(&branches), &[]);
    let loads = found.expect("sound").ordinates;
    for (point, load) in experiment.measurement.points.iter().zip(loads) {
        let off = load - 2.0 * radius * 1e6 * point.abscissa;
        assert!(off.abs() < 1e-9 * 2e-5, "{:e}: {off:e}", point.abscissa);
    }
}

/// An approach that is in contact below the contact point has the contact of a retract.
#[test]
fn an_approach_in_tension_has_the_contact_of_a_retract() {
    let bodies = half_space(1e-5, 5e4, solid(f64::INFINITY, 0.3));
    // The pull-off is at -55 nm.
    let depths = (-5..0).map(|i| 1e-8 * f64::from(i));
    let mut experiment = Experiment::new(measurement_at(Kind::LoadPenetration, depths), bodies);
    experiment.work_of_adhesion = 1e-4;
    let [approach, retract] = Direction::ALL.map(|direction| {
        let points = experiment.measurement.points.iter_mut();
        points.for_each(|point| point.direction = Some(direction));
        let found = experiment.predictions(Table::embedded(), Some(&[Branch::Advancing; 5]), &[]);
        found.expect("sound").ordinates
    });
    assert_eq!(approach, retract);
}

/// Of a retract with a work of adhesion of its own the points within 2 % of the largest radius may be pinned.
#[test]
fn only_radii_near_the_turn_may_be_pinned() {
    let radii = [5e-5, 1e-4, 9.9e-5, 9.7e-5, 9.1e-5, 6e-5];
    let mut measurement = measurement_at(Kind::LoadRadius, radii);
    for (i, point) in measurement.points.iter_mut().enumerate() {
        point.ordinate = f64::from(i as u32);
        point.direction = Some(Direction::ALL[usize::from(i > 1)]);
    }
    let bodies = half_space(1e-3, 2e6, solid(f64::INFINITY, 0.25));
    let experiment = Experiment::new(measurement, bodies);
    let (contact, receding) = (Branch::Advancing, Branch::Receding);
    let branches = experiment.branches(&[Parameter::WorkOfAdhesionReceding]);
    let expected = [
        contact,
        contact,
        Branch::LeftOut,
        receding,
        receding,
        receding,
    ];
    assert_eq!(branches.expect("sound"), expected);
}

/// The likelihood of a value with a prior is that without, times the density of the prior.
#[test]
fn a_prior_adds_the_logarithm_of_its_density() {
    let bodies = half_space(1e-5, f64::INFINITY, solid(1e5, 0.3));
    let measurement = measurement_of(Kind::LoadRadius, [[1e-6, 2e-8], [2e-6, 1e-7]]);
    let mut experiment = Experiment::new(measurement, bodies);
    experiment.noise = Some(1e-8);
    let ratio = Free::new(Parameter::FilmPoissonRatio);
    let value = |free: Free, ratio: f64| {
        let likelihood = Likelihood::new(Table::embedded(), &[experiment.clone()], &[free], None);
        let found = likelihood
            .expect("sound")
            .value(Table::embedded(), &[ratio]);
        found.expect("one value")
    };
    let (mean, width) = (0.25, 0.1);
    let added = value(ratio.with_prior(mean, width), 0.3) - value(ratio, 0.3);
    let density = -0.5 * ((0.3 - mean) / width).powi(2) - ((2.0 * PI).sqrt() * width).ln();
    assert!((added - density).abs() < 1e-12, "{added} {density}");
    // Without bounds of its own a Poisson ratio is between 0 and 0.5.
    for outside in [-0.01, 0.51] {
        assert_eq!(value(ratio, outside), f64::NEG_INFINITY);
    }
    assert!(value(ratio.within(-0.5, 0.5), -0.01).is_finite());
}
