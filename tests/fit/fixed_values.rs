//! What the values that a fit takes as given do to its result: against fits with other values, and
//! against many specimens whose values are not quite the given ones.

use acceptance::{Contacts, Refused, assert_names};
use fit::{
    Bodies, Experiment, Fit, Fixed, Free, Kind, Known, LayerQuantity, Loss, Options, Parameter,
    Scale, WarningKind, simulate,
};
use interp::{Probe, Table};
use rayon::prelude::*;

use crate::contact_stiffness::{at_radii, noisy, oxide};
use crate::imagined::{
    Course, FORCE_CURVE, Imagined, LENS, as_film, assert_silent, assert_warns, film, fit_with,
    free_of,
};
use crate::recovery::{SETS, assert_coverage};

const THICKNESS: Fixed = Fixed::Parameter(Parameter::FilmThickness);
const POISSON: Fixed = Fixed::Parameter(Parameter::FilmPoissonRatio);
const RADII: Fixed = Fixed::Scale(Scale::ContactRadius);

fn found(experiment: &Experiment, free: &[Free], change: impl FnOnce(&mut Options)) -> Fit {
    fit_with(experiment, free, change).expect("sound")
}

/// Fits by default options, and tells what the fixed values do.
fn told(experiment: &Experiment, free: &[Free]) -> Fit {
    found(experiment, free, |options| options.fixed_values = true)
}

/// Multiplies all readings of a quantity, from their zero in a fit.
fn multiply(experiment: &mut Experiment, scale: Scale, factor: f64, fit: &Fit) {
    let value = |parameter| fit.estimate(parameter).map(|one| one.value);
    let first = value(Parameter::ContactPoint).unwrap_or(experiment.contact_point);
    let level = value(Parameter::Baseline).unwrap_or(experiment.baseline);
    for point in &mut experiment.measurement.points {
        match scale {
            Scale::ContactRadius => point.abscissa *= factor,
            Scale::Penetration | Scale::Height => {
                point.abscissa = first + factor * (point.abscissa - first);
            }
            Scale::Load => point.ordinate = level + factor * (point.ordinate - level),
            Scale::ContactStiffness => point.ordinate *= factor,
        }
    }
}

/// Asserts that every change listed is that of fits with other values.
fn assert_as_refits(name: &str, experiment: &Experiment, free: &[Free], loss: Loss, names: &str) {
    let here = found(experiment, free, |options| {
        options.loss = loss;
        options.fixed_values = true;
    });
    let listed = here.fixed_values.iter().map(|one| one.quantity.name());
    assert_eq!(listed.collect::<Vec<_>>().join(" "), names, "{name}");
    for one in &here.fixed_values {
        // The changes told are in proportion to small ones. Fits end within 1 % of a standard error, which is much of the
        // effect of a small change, unless they find one value.
        let part = match one.quantity {
            _ if free.len() == 1 => 0.02,
            // It moves the values by up to 90 standard errors.
            Fixed::ContactRadiusZero => 0.1,
            _ => 0.5,
        };
        let values = |value: f64| {
            let mut changed = experiment.clone();
            match one.quantity {
                Fixed::Scale(scale) => multiply(&mut changed, scale, value, &here),
                Fixed::ContactRadiusZero => {
                    let points = changed.measurement.points.iter_mut();
                    points.for_each(|point| point.abscissa -= value);
                }
                Fixed::PositionDrift => {
                    let begin = changed.times[0];
                    let points = changed.measurement.points.iter_mut();
                    for (point, time) in points.zip(&changed.times) {
                        point.abscissa -= value * (time - begin);
                    }
                }
                quantity => changed.set_fixed(quantity, value).expect("physical"),
            }
            let found = found(&changed, free, |options| options.loss = loss);
            let estimates = found.estimates.iter();
            estimates.map(|one| one.value).collect::<Vec<_>>()
        };
        let step = part * one.step;
        let (above, is_one_sided) = (values(one.value + step), step < 0.0);
        let other = if is_one_sided {
            here.estimates.iter().map(|one| one.value).collect()
        } else {
            values(one.value - step)
        };
        let width = part * if is_one_sided { 1.0 } else { 2.0 };
        for (i, estimate) in here.estimates.iter().enumerate() {
            let (refitted, change) = ((above[i] - other[i]) / width, one.changes[i]);
            let size = estimate.standard_error;
            assert!(
                (change - refitted).abs() < 0.03 * refitted.abs() + 0.05 * size,
                "{name}, {}: {} changes by {change:e}, by fits {refitted:e}, error {size:e}",
                one.quantity.name(),
                estimate.parameter
            );
        }
    }
}

#[test]
fn changes_are_those_of_fits_with_other_values() {
    let of_film = "sphere-radius substrate-modulus substrate-poisson-ratio film-modulus \
                  film-poisson-ratio film-thickness load-offset contact-radius-zero contact-radius load";
    let lens = Imagined::lens(Kind::LoadRadius, 30e-6, 1e-6, &LENS);
    let experiment = lens.measured(&lens.exact(), 1);
    for loss in [Loss::Squares, Loss::HUBER, Loss::SOFT_L1] {
        assert_as_refits("lens", &experiment, &lens.free, loss, of_film);
    }
    // On an approach no point is left out for being near a jump, so that all fits have one set of
    // points.
    let free = [
        Parameter::FilmModulus,
        Parameter::ContactPoint,
        Parameter::Baseline,
    ];
    let probe = Imagined::probe(Course::Approach, 0.0, &free);
    let experiment = probe.measured(&probe.exact(), 1);
    let names = "sphere-radius substrate-modulus substrate-poisson-ratio film-poisson-ratio \
                 film-thickness stiffness height load";
    assert_as_refits("probe", &experiment, &probe.free, Loss::Squares, names);
    // Of a deflection the forces are as uncertain as the stiffness.
    let mut experiment = experiment;
    experiment.from_deflection = true;
    assert_as_refits("deflection", &experiment, &probe.free, Loss::Squares, names);
    // With times the heights may drift.
    experiment.times = (0..experiment.measurement.points.len())
        .map(|i| 0.01 * i as f64)
        .collect();
    let names = names.replace(
        "stiffness height",
        "baseline stiffness position-drift height",
    );
    experiment.contact_point = probe.truth.contact_point;
    experiment.baseline = probe.truth.baseline;
    let free = free_of(&[Parameter::FilmModulus]);
    assert_as_refits("drift", &experiment, &free, Loss::Squares, &names);
    // The factor of a contact stiffness.
    let stiffness = noisy(&at_radii(&oxide(), [5e-8, 1.5e-6], 30), 0.01, 1);
    let free = free_of(&[Parameter::FilmModulus]);
    let names = "substrate-modulus substrate-poisson-ratio beta sphere-modulus film-poisson-ratio film-thickness \
                 contact-radius-zero contact-radius contact-stiffness";
    assert_as_refits("beta", &stiffness, &free, Loss::Squares, names);
    // A confined film that keeps its volume: the modulus follows the Poisson ratio far from in proportion.
    let mut gel = Imagined::probe(Course::Approach, 0.0, &[Parameter::FilmModulus]);
    let radius = Probe::Paraboloid { radius: 20e-6 };
    let film = acceptance::solid(2e4, 0.5);
    let system = acceptance::rigid_probe(radius, film, 2e-7, acceptance::solid(7e10, 0.2));
    gel.truth.bodies = Bodies::coated(&system);
    gel.truth.measurement.kind = Kind::LoadPenetration;
    gel.truth.stiffness = None;
    let experiment = gel.measured(&gel.exact(), 1);
    let names = "sphere-radius substrate-modulus substrate-poisson-ratio film-poisson-ratio film-thickness load-offset \
         penetration load";
    assert_as_refits("gel", &experiment, &gel.free, Loss::Squares, names);
    let here = told(&experiment, &gel.free);
    let of_poisson = &here.fixed_values[3];
    let mut less = experiment;
    less.set_fixed(of_poisson.quantity, 0.49).expect("physical");
    let whole = found(&less, &gel.free, |_| ()).estimates[0].value - here.estimates[0].value;
    let (change, step) = (of_poisson.changes[0], of_poisson.step);
    assert!(step == -0.01 && whole < 0.9 * change, "{change} {whole}");
}

/// On a half-space a change of 1 % has an effect in closed form.
#[test]
fn changes_are_those_of_hertz_and_sneddon() {
    let free = [Parameter::FilmModulus];
    let mut imagined = Imagined::probe(Course::Approach, 0.0, &free);
    let system = as_film(&imagined.truth.bodies);
    let half_space = |probe: Probe| {
        Bodies::half_space(interp::HalfSpace {
            solid: system.film,
            probe,
            ..system.without_film()
        })
    };
    imagined.truth.measurement.kind = Kind::LoadPenetration;
    let theta = 20_f64.to_radians();
    let cone = Probe::Cone { half_angle: theta };
    let (penetration, load) = (Fixed::Scale(Scale::Penetration), Fixed::Scale(Scale::Load));
    let of_poisson = -2.0 * 0.45 * 0.01 / (1.0 - 0.45 * 0.45);
    for (probe, expected) in [
        // (1 - nu^2) 3/4 P / (sqrt(R) delta^3/2)
        (
            system.probe.clone(),
            [(Fixed::SphereRadius, -0.005), (penetration, -0.015)],
        ),
        // (1 - nu^2) pi/2 P cot(theta) / delta^2
        (
            cone,
            [
                (
                    Fixed::HalfAngle,
                    -0.01 * theta / (theta.sin() * theta.cos()),
                ),
                (penetration, -0.02),
            ],
        ),
    ] {
        imagined.truth.bodies = half_space(probe);
        let experiment = imagined.measured(&imagined.exact(), 1);
        let here = told(&experiment, &imagined.free);
        for (quantity, expected) in expected
            .into_iter()
            .chain([(load, 0.01), (POISSON, of_poisson)])
        {
            let mut rows = here.fixed_values.iter();
            let row = rows.find(|one| one.quantity == quantity).expect("listed");
            let found = row.changes[0] / here.estimates[0].value;
            assert!(
                (found / expected - 1.0).abs() < 1e-3,
                "{quantity:?}: {found}, not {expected}"
            );
        }
    }
}

/// Force and deflection of one spring: the penetration does not depend on its stiffness, so that modulus
/// and work of adhesion follow the stiffness in proportion.
#[test]
fn of_a_deflection_the_stiffness_scales_the_modulus() {
    let probe = Imagined::probe(Course::Approach, 5e-5, &FORCE_CURVE);
    let mut experiment = probe.measured(&probe.exact(), 1);
    // With a rigid sphere and substrate the modulus of the film is the only one.
    experiment.bodies.base = acceptance::solid(f64::INFINITY, 0.25);
    experiment.from_deflection = true;
    let stiffness = experiment.stiffness.expect("that of a cantilever");
    let known = Known {
        quantity: Fixed::Parameter(Parameter::Stiffness),
        error: 0.05 * stiffness,
    };
    let here = found(&experiment, &probe.free, |options| {
        options.known = vec![known]
    });
    for i in 0..2 {
        let estimate = &here.estimates[i];
        let part = here.fixed_values[0].changes[i] / estimate.value;
        assert!((part - 0.01).abs() < 3e-4, "{estimate:?}: {part}");
        let error = estimate.standard_error / estimate.value;
        assert!(error > 0.05, "{estimate:?}");
    }
    let mut free = probe.free;
    free.push(Free::new(Parameter::Stiffness));
    fit_with(&experiment, &free, |_| ()).refused("stiffness; deflection; standard error");
}

/// A zero that is fixed may be off by the noise of the readings whose zero it is, whatever other files read.
#[test]
fn zeros_of_files_of_several_kinds_are_off_by_their_own_noise() {
    let [loads, depths] = [(Kind::LoadRadius, 1e-6), (Kind::PenetrationRadius, 2e-8)]
        .map(|(kind, noise)| Imagined::lens(kind, 30e-6, noise, &LENS))
        .map(|lens| lens.measured(&lens.exact(), 1));
    let options = Options {
        fixed_values: true,
        ..Options::default()
    };
    for files in [[&loads, &depths], [&depths, &loads]] {
        let here = fit::fit(
            Table::embedded(),
            &files.map(Clone::clone),
            &free_of(&LENS),
            &options,
        );
        let here = here.expect("sound");
        for (zero, noise) in [
            (Parameter::LoadOffset, 1e-6),
            (Parameter::ContactPoint, 2e-8),
        ] {
            let mut rows = here.fixed_values.iter();
            let row = rows.find(|one| one.quantity == Fixed::Parameter(zero));
            assert_eq!(row.map(|row| row.step), Some(noise), "{zero}");
        }
    }
    // A free level takes up a load offset.
    let free = [
        Parameter::FilmModulus,
        Parameter::ContactPoint,
        Parameter::Baseline,
    ];
    let mut gel = Imagined::probe(Course::Approach, 0.0, &free);
    gel.truth.measurement.kind = Kind::LoadPenetration;
    gel.truth.stiffness = None;
    let here = told(&gel.measured(&gel.exact(), 1), &gel.free);
    let offset = Fixed::Parameter(Parameter::LoadOffset);
    assert!(here.fixed_values.iter().all(|one| one.quantity != offset));
}

/// A film below a sphere that is known: its part of the compliance is small, so that a calibration of 1 % decides. A known
/// error is in the standard error.
#[test]
fn a_value_that_a_calibration_decides_is_doubted() {
    let free = [Parameter::FilmModulus, LENS[1]];
    let lens = Imagined::lens(Kind::LoadRadius, 30e-6, 1e-6, &free);
    let experiment = lens.measured(&lens.exact(), 1);
    let here = told(&experiment, &lens.free);
    let rows = here.fixed_values.iter();
    let row = rows
        .clone()
        .find(|one| one.quantity == RADII)
        .expect("listed");
    let percent = 1e2 * row.changes[0] / here.estimates[0].value;
    let words = format!(
        "film-modulus changes by {percent:+.0} % with +1 % of contact-radius, and by more than 10 % with contact-radius-zero, \
         sphere-radius, load, \
         sphere-modulus, film-poisson-ratio; give the errors"
    );
    assert!(percent < -50.0);
    assert_warns(&here, WarningKind::Calibration, &words);
    let known: Vec<Known> = rows
        .filter(|one| one.quantity.errs_in_proportion() || one.quantity == POISSON)
        .map(|one| Known {
            quantity: one.quantity,
            error: 0.01 * one.value,
        })
        .collect();
    let all = found(&experiment, &lens.free, |options| {
        options.fixed_values = true;
        options.known = known;
    });
    assert_silent(&all, WarningKind::Calibration);
    assert!(all.estimates[0].standard_error > row.changes[0].abs());
    // The modulus of the sphere is not decided by 1 %.
    let free = [LENS[0], LENS[1]];
    let whole = Imagined::lens(Kind::LoadRadius, 30e-6, 1e-6, &free);
    assert_silent(&told(&experiment, &whole.free), WarningKind::Calibration);
}

#[test]
fn a_poisson_ratio_at_its_end_moves_to_the_other_side() {
    let lens = Imagined::lens(Kind::LoadRadius, 30e-6, 1e-6, &LENS);
    let experiment = lens.measured(&lens.exact(), 1);
    let here = told(&experiment, &lens.free);
    let one = here.fixed_values.iter().find(|one| one.quantity == POISSON);
    let one = one.expect("listed");
    assert_eq!((one.value, one.step), (0.5, -0.01));
    let report = fit::report::report(&here, std::slice::from_ref(&lens.truth), &[], &[]);
    assert_names(
        &report,
        "what the fixed values do; 0.5 -> 0.49; film-thickness; +1 %",
    );
    // Nor is one near its end moved beyond it.
    let mut near = lens.clone();
    let film = film(&mut near.truth);
    film.solid = acceptance::solid(film.solid.young(), 0.495);
    let near = told(&near.measured(&near.exact(), 1), &lens.free);
    let mut values = near.fixed_values.iter();
    let one = values.find(|one| one.quantity == POISSON);
    assert_eq!(one.map(|one| (one.value, one.step)), Some((0.495, -0.01)));
    // Nothing is computed where nobody asks.
    let quiet = found(&experiment, &lens.free, |_| ());
    assert!(quiet.fixed_values.is_empty());
}

/// Specimens whose films are not quite as thick as the fit takes them.
#[test]
fn the_truth_is_within_the_intervals_with_a_thickness_that_is_known_with_an_error() {
    let lens = Imagined::lens(Kind::LoadRadius, 30e-6, 1e-6, &LENS);
    let (nominal, error) = (30e-6, 1.5e-6);
    let planned = lens.measured(&lens.exact(), 1);
    let fits = |known: &[Known]| -> Vec<Fit> {
        let one = |seed: u64| {
            let mut random = Contacts::new(seed ^ 0xf11);
            let mut specimen = planned.clone();
            let truth = [(LENS[0], 2e6), (LENS[1], 0.04)];
            let thickness = nominal + error * random.normal();
            let film = (Parameter::FilmThickness, thickness);
            for (parameter, value) in truth.into_iter().chain([film]) {
                specimen.set(parameter, value).expect("physical");
            }
            let measured = simulate(Table::embedded(), &specimen, 1e-6, seed);
            let mut experiment = planned.clone();
            experiment.measurement = measured.expect("in the table").measurement;
            found(&experiment, &lens.free, |options| {
                options.known = known.to_vec()
            })
        };
        (0..SETS).into_par_iter().map(one).collect()
    };
    let truth = |parameter: Parameter, _| lens.truth.get(parameter).expect("a value");
    let known = Known {
        quantity: THICKNESS,
        error,
    };
    // A film of another thickness is no doubt by itself: the fit may describe the data less well.
    let expected = [
        WarningKind::PoorFit,
        WarningKind::Outliers,
        WarningKind::OffsetWanted,
        WarningKind::OffsetHinted,
        WarningKind::LargeStrain,
        WarningKind::StructuredResiduals,
    ];
    assert_coverage("known thickness", &fits(&[known]), truth, &expected);
    // Without its error the intervals hold the truth far less often than 68 %.
    let bare = fits(&[]);
    for (i, parameter) in LENS.into_iter().enumerate() {
        let holds = |fit: &&Fit| {
            let [low, high] = fit.estimates[i].interval(1.0);
            (low..=high).contains(&truth(parameter, None))
        };
        let covered = bare.iter().filter(holds).count();
        assert!(covered < 100, "{parameter}: {covered}");
    }
    // The sum of squares, by hand.
    let [with, without] = [&fits(&[known])[0], &bare[0]];
    for (i, (one, other)) in with.estimates.iter().zip(&without.estimates).enumerate() {
        assert_eq!(one.value, other.value);
        let by_known = with.fixed_values[0].error_of(i);
        let expected = other.standard_error.hypot(by_known);
        assert!((one.standard_error / expected - 1.0).abs() < 1e-12);
    }
}

/// The error is that of the first film, and the other one is off by the same part.
#[test]
fn thicknesses_of_several_films_err_in_proportion() {
    // Fits end within 1 % of a standard error: the change is larger.
    let part = 0.03;
    let lenses =
        [30e-6, 60e-6].map(|thickness| Imagined::lens(Kind::LoadRadius, thickness, 1e-6, &LENS));
    let fits = |factor: f64| {
        let experiments = lenses.each_ref().map(|lens| {
            let mut one = lens.measured(&lens.exact(), 1);
            film(&mut one).thickness *= factor;
            one
        });
        let options = Options {
            known: vec![Known {
                quantity: THICKNESS,
                error: part * 30e-6,
            }],
            ..Options::default()
        };
        fit::fit(Table::embedded(), &experiments, &lenses[0].free, &options).expect("sound")
    };
    let [below, here, above] = [1.0 - part, 1.0, 1.0 + part].map(fits);
    for (i, estimate) in here.estimates.iter().enumerate() {
        let expected = 0.5 * (above.estimates[i].value - below.estimates[i].value).abs();
        let found = here.fixed_values[0].error_of(i);
        let parameter = estimate.parameter;
        assert!(
            (found / expected - 1.0).abs() < 0.05,
            "{parameter}: {found:e}, not {expected:e}"
        );
    }
}

#[test]
fn an_error_that_cannot_be_known_is_refused() {
    let lens = Imagined::lens(Kind::LoadRadius, 30e-6, 1e-6, &LENS);
    let experiment = lens.measured(&lens.exact(), 1);
    let with = |known: &[(Fixed, f64)], profile_level: Option<f64>| {
        let known = known.iter();
        fit_with(&experiment, &lens.free, |options| {
            options.known = known
                .map(|&(quantity, error)| Known { quantity, error })
                .collect();
            options.profile_level = profile_level;
        })
    };
    let free = Fixed::Parameter(LENS[0]);
    with(&[(free, 1e4)], None).refused("known sphere-modulus; not free; prior");
    with(&[(THICKNESS, 0.0)], None).refused("known film-thickness; 0.0; positive");
    with(&[(THICKNESS, f64::NAN)], None).refused("known film-thickness; positive");
    // A part of the value, in place of its error.
    with(&[(THICKNESS, 0.03)], None).refused("known film-thickness; 0.03; at most its value; m");
    with(&[(Fixed::SphereRadius, 0.01)], None).refused("known sphere-radius; 0.01; at most");
    with(&[(THICKNESS, 1e-6); 2], None).refused("film-thickness; once");
    with(&[(Fixed::Layer(1, LayerQuantity::Modulus), 1e6)], None)
        .refused("layer-1.modulus; bodies");
    with(&[(THICKNESS, 1e-6)], Some(0.95)).refused("profile; prior");
}
