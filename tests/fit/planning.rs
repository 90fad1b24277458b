//! Synthetic data, and what an experiment would tell.

use acceptance::{Refused, rigid_probe, solid};
use fit::{Bodies, Direction, Experiment, Free, Kind, Parameter, WarningKind, forecast, simulate};
use interp::{Probe, Table};

use crate::imagined::{
    Course, FORCE_CURVE, Imagined, LENS, assert_warned, fit_with, fitted, free_of, lens,
    measurement_at,
};

/// Returns the experiments of all kinds and courses.
fn imagined() -> Vec<Imagined> {
    use Parameter::{ContactPoint, FilmModulus, WorkOfAdhesion};
    let probe = &FORCE_CURVE[..3];
    let mut hysteresis = Imagined::probe(Course::Cycle, 5e-5, probe);
    hysteresis.truth.work_of_adhesion_receding = Some(1.5e-4);
    hysteresis.truth.baseline_slope = 2e-4;
    let mut hertz = Imagined::probe(Course::Cycle, 0.0, &[FilmModulus, ContactPoint]);
    hertz.radii[0] = 0.5e-6;
    let mut retract = Imagined::lens(Kind::LoadPenetration, 10e-6, 3e-6, &LENS);
    (retract.course, retract.radii[0], retract.points) = (Course::Retract, 10e-6, [60, 20]);
    let depths = [WorkOfAdhesion, FilmModulus];
    vec![
        lens(),
        Imagined::lens(Kind::PenetrationRadius, 100e-6, 5e-9, &depths),
        retract,
        Imagined::probe(Course::Cycle, 1e-4, probe),
        hysteresis,
        hertz,
    ]
}

#[test]
fn simulated_data_are_those_of_direct_solves() {
    for imagined in imagined() {
        let experiment = imagined.planned();
        let exact = &experiment.measurement;
        let made = simulate(Table::embedded(), &experiment, 0.0, 1).expect("in the table");
        let readings = exact.points.iter().map(|point| point.ordinate.abs());
        let scale = readings.fold(0.0, f64::max);
        for (point, made) in exact.points.iter().zip(&made.measurement.points) {
            // The points at the very contact point may fall on either side of the jump.
            let at_touch = point.direction == Some(Direction::Approach)
                && (point.abscissa - experiment.contact_point).abs() < 2e-9;
            let off = (point.ordinate - made.ordinate).abs() / scale;
            assert!(off < 2e-5 || at_touch, "{point:?}, {made:?}");
        }
    }
}

#[test]
fn noise_is_normal_and_belongs_to_its_seed() {
    let experiment = imagined()[0].planned();
    let data = |noise, seed| {
        let made = simulate(Table::embedded(), &experiment, noise, seed);
        made.expect("inside").measurement
    };
    assert_eq!(data(1e-6, 3), data(1e-6, 3));
    assert_ne!(data(1e-6, 3), data(1e-6, 4));
    let exact = data(0.0, 3);
    let deviations: Vec<f64> = (0..100)
        .flat_map(|seed| {
            let noisy = data(1e-6, seed);
            let pairs = noisy.points.into_iter().zip(exact.points.clone());
            pairs.map(|(one, other)| (one.ordinate - other.ordinate) / 1e-6)
        })
        .collect();
    let mean_of = |power| {
        deviations.iter().map(|d: &f64| d.powi(power)).sum::<f64>() / deviations.len() as f64
    };
    // 4000 normal numbers: the moments are within 4.5 standard deviations of 0, 1, 0, 3.
    for (power, moment, spread) in [(1, 0.0, 1.0), (2, 1.0, 2.0), (3, 0.0, 15.0), (4, 3.0, 96.0)] {
        let most = 4.5 * f64::sqrt(spread / deviations.len() as f64);
        let mean = mean_of(power);
        assert!((mean - moment).abs() < most, "moment {power}: {mean}");
    }
    for noise in [-1.0, f64::NAN] {
        simulate(Table::embedded(), &experiment, noise, 1).refused("noise");
    }
}

#[test]
fn a_plan_outside_the_model_is_told_as_its_fit_is() {
    let mut probe = Imagined::probe(Course::Retract, 1e-4, &[Parameter::FilmModulus]);
    probe.radii[1] = 9e-6;
    let planned = probe.planned();
    let of_plan = planned.broken_assumptions(Table::embedded());
    let of_plan = of_plan.expect("sound");
    let kinds: Vec<WarningKind> = of_plan.iter().map(|one| one.kind).collect();
    assert_eq!(
        kinds,
        [
            WarningKind::LargeContact,
            WarningKind::SurfaceTension,
            WarningKind::LargeStrain
        ]
    );
    let expected = forecast(Table::embedded(), &[planned], &probe.free).expect("sound");
    assert_eq!(expected.warnings[..of_plan.len()], of_plan);
    let found = probe.fit(1);
    for kind in kinds {
        assert_warned(&found, kind);
    }
    let none = lens().planned().broken_assumptions(Table::embedded());
    assert_eq!(none.expect("sound"), []);
}

#[test]
fn a_forecast_tells_the_errors_of_the_fit() {
    for mut imagined in imagined() {
        // Off the end of the branch, near which a point counts in one data set and not in the next.
        match imagined.truth.measurement.kind {
            Kind::ForceHeight => imagined.radii[0] = 2.2e-6,
            _ => imagined.radii[0] = 42e-6,
        }
        let planned = imagined.planned();
        let expected = forecast(Table::embedded(), &[planned], &imagined.free).expect("sound");
        let found = imagined.fit(5);
        for (one, other) in expected.estimates.iter().zip(&found.estimates) {
            let ratio = one.standard_error / other.standard_error;
            assert!((0.95..1.05).contains(&ratio), "{} {ratio}", one.parameter);
            assert_eq!(Some(one.value), imagined.truth.get(one.parameter));
        }
    }
    // Nothing tells the film's modulus here, and the forecast says so.
    let free = [LENS[0], LENS[1], Parameter::FilmModulus];
    let lens = Imagined::lens(Kind::LoadRadius, 1e-6, 5e-6, &free);
    let mut experiment = lens.planned();
    let one = std::slice::from_ref(&experiment);
    let expected = forecast(Table::embedded(), one, &lens.free).expect("sound");
    let others: Vec<&str> = expected.undetermined.iter().map(|one| &*one.text).collect();
    let is_named = others.iter().any(|text| text.contains("film-modulus"));
    assert!(is_named, "{others:?}");
    // Points of an approach alone tell nothing of the receding work of adhesion, whose variance overflows: that hides
    // no other combination.
    let mut approach = experiment.clone();
    for point in &mut approach.measurement.points {
        point.direction = Some(Direction::Approach);
    }
    approach.work_of_adhesion_receding = Some(0.05);
    let receding = Free::new(Parameter::WorkOfAdhesionReceding);
    let free: Vec<Free> = lens.free.iter().copied().chain([receding]).collect();
    let lost = forecast(Table::embedded(), &[approach], &free).expect("sound");
    let mut texts: Vec<&str> = lost.undetermined.iter().map(|one| &*one.text).collect();
    assert_eq!(texts.remove(0), "work-of-adhesion-receding");
    assert_eq!(texts, others);
    experiment.noise = None;
    let planned = forecast(Table::embedded(), &[experiment], &lens.free);
    planned.refused("the noise of imagined.csv");
}

/// The noise of the radii is that of the simulation, and counts in the plan. Its loads are not used.
#[test]
fn plans_with_errors_of_the_radii_have_the_scatter_of_their_fits() {
    const SEEDS: u64 = 60;
    let imagined = lens();
    let mut planned = imagined.planned();
    planned.abscissa_noise = 3e-7;
    for point in &mut planned.measurement.points {
        point.ordinate = 0.0;
    }
    let expected = forecast(Table::embedded(), &[planned.clone()], &imagined.free).expect("sound");
    let fits: Vec<_> = (0..SEEDS)
        .map(|seed| {
            let made = simulate(Table::embedded(), &planned, imagined.noise, seed);
            imagined.fit_of(&made.expect("in the table"))
        })
        .collect();
    for (i, plan) in expected.estimates.iter().enumerate() {
        let off = |fit: &fit::Fit| {
            let found = &fit.estimates[i];
            [found.value - plan.value, found.standard_error]
                .map(|error| error / plan.standard_error)
        };
        let squares: [f64; 2] = fits.iter().map(off).fold([0.0; 2], |sum, [off, error]| {
            [sum[0] + off * off, sum[1] + error * error]
        });
        let [scatter, error] = squares.map(|sum| (sum / SEEDS as f64).sqrt());
        println!("{}: scatter {scatter:.2}, error {error:.2}", plan.parameter);
        // The scatter of 60 fits is known to 9 %.
        assert!(
            (0.75..1.25).contains(&scatter),
            "{}: {scatter}",
            plan.parameter
        );
        assert!((0.95..1.05).contains(&error), "{}: {error}", plan.parameter);
    }
    for noise in [-1e-9, f64::NAN, f64::INFINITY] {
        planned.abscissa_noise = noise;
        simulate(Table::embedded(), &planned, 0.0, 1).refused("noise of the contact radius; >= 0");
    }
    planned.abscissa_noise = 1.0;
    simulate(Table::embedded(), &planned, 0.0, 1).refused("noise of the contact radius; negative");
}

#[test]
fn free_parameters_are_made_with_the_scope_they_need() {
    let is_own = |parameter: &Parameter| Free::new(*parameter).scope == fit::Scope::Own;
    let own = Parameter::ALL.into_iter().filter(is_own);
    let names: Vec<_> = own.map(Parameter::name).collect();
    let expected = ["load-offset", "contact-point", "baseline", "baseline-slope"];
    assert_eq!(names, expected);
}

/// Points near the jump off are left out of plans as they are of fits, whatever their number.
#[test]
fn plans_of_curves_that_jump_off_have_the_errors_of_their_fits() {
    let probe = Probe::Paraboloid { radius: 1e-5 };
    let system = rigid_probe(probe, solid(2e4, 0.5), 5e-6, solid(2e11, 0.25));
    let noise = 6e-11;
    for count in [40, 90, 100, 150] {
        let way = |i: u32| -0.3e-6 + 0.9e-6 * f64::from(i) / f64::from(count - 1);
        let mut measurement = measurement_at(Kind::ForceHeight, (0..count).map(way));
        for point in &mut measurement.points {
            point.direction = Some(Direction::Retract);
        }
        let planned = Experiment {
            work_of_adhesion: 8e-5,
            stiffness: Some(0.02),
            noise: Some(noise),
            ..Experiment::new(measurement, Bodies::coated(&system))
        };
        let free = free_of(&FORCE_CURVE);
        let one = std::slice::from_ref(&planned);
        let expected = forecast(Table::embedded(), one, &free).expect("sound");
        assert!(expected.undetermined.is_empty());
        let error = |seed: u64| {
            let measured = simulate(Table::embedded(), &planned, noise, seed);
            let measured = measured.expect("in the table");
            fitted(&measured, &free).estimates[0].standard_error
        };
        let mut errors: Vec<f64> = (0..9).map(error).collect();
        errors.sort_by(f64::total_cmp);
        let ratio = expected.estimates[0].standard_error / errors[4];
        println!("{count}: {ratio:.2}");
        assert!((0.6..1.6).contains(&ratio), "{count} points: {ratio}");
    }
}

/// A plan tells what calibrations and given values would do as a fit of exact data does.
#[test]
fn fixed_values_of_a_plan_are_those_of_a_fit() {
    let lens = Imagined::lens(Kind::LoadRadius, 30e-6, 1e-6, &LENS);
    let probe = Imagined::probe(Course::Approach, 0.0, &[FORCE_CURVE[0], FORCE_CURVE[2]]);
    for imagined in [lens, probe] {
        let mut planned = imagined.planned();
        let told = fit_with(&planned, &imagined.free, |options| {
            options.fixed_values = true;
        });
        let told = told.expect("sound");
        // A plan does not use ordinates.
        for point in &mut planned.measurement.points {
            point.ordinate = 0.0;
        }
        let plan = forecast(Table::embedded(), &[planned], &imagined.free).expect("sound");
        let count = told.fixed_values.len();
        assert!(count > 7 && plan.fixed_values.len() == count);
        for (plan, told_row) in plan.fixed_values.iter().zip(&told.fixed_values) {
            assert_eq!(
                (plan.quantity, plan.step),
                (told_row.quantity, told_row.step)
            );
            let changes = plan.changes.iter().zip(&told_row.changes);
            for ((planned, found), estimate) in changes.zip(&told.estimates) {
                assert!(
                    (planned - found).abs() < 1e-2 * found.abs() + 1e-3 * estimate.standard_error,
                    "{:?}, {}: {planned:e}, not {found:e}",
                    plan.quantity,
                    estimate.parameter
                );
            }
        }
    }
}
