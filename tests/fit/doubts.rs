//! Doubts where there is reason for them, and none where there is not.

use acceptance::{Refused, assert_names, rigid_sphere, solid, table};
use fit::{
    Bodies, Experiment, Fit, Fixed, Free, Kind, Known, Options, Parameter, Scope, WarningKind, fit,
};
use interp::Probe;

use crate::imagined::{
    Course, Imagined, LENS, assert_no_doubts, assert_silent, assert_warns, film, fit_all, fit_with,
    fitted, fitted_of_few, half_space, lens, number_after, off, profiled, text,
};

#[test]
fn an_offset_that_is_not_fitted_is_missed() {
    let mut lens = lens();
    lens.truth.load_offset = 4e-5;
    let mut experiment = lens.measured(&lens.exact(), 1);
    experiment.load_offset = 0.0;
    let found = fitted(&experiment, &lens.free);
    let off = off(&found, Parameter::WorkOfAdhesion, 0.04);
    assert!(off.abs() > 5.0, "{off}");
    assert_warns(&found, WarningKind::OffsetWanted, "load-offset; free it");
    lens.free.push(Free::new(Parameter::LoadOffset));
    assert_no_doubts(&fitted(&experiment, &lens.free), &[]);
}

/// The number in the warning is the change of the value found where the zero is off.
#[test]
fn a_zero_of_the_load_that_no_point_shows_is_named() {
    let free = [LENS[0], LENS[1], Parameter::ContactPoint];
    let mut lens = Imagined::lens(Kind::LoadPenetration, 10e-6, 3e-6, &free);
    let exact = lens.exact();
    let mut experiment = lens.measured(&exact, 1);
    let found = fitted(&experiment, &lens.free);
    let said = text(&found, WarningKind::ZeroNotSeen);
    assert_names(
        &said,
        "no point is off contact; work-of-adhesion; free load-offset",
    );
    let loads = experiment.measurement.points.iter().map(|one| one.ordinate);
    let offset = 1e-4 * loads.fold(0.0, f64::max);
    for point in &mut experiment.measurement.points {
        point.ordinate -= offset;
    }
    let moved = fitted(&experiment, &lens.free);
    let [before, after] = [&found, &moved].map(|one| &one.estimates[1]);
    // Of a hundredth of it, in proportion.
    let change = 100.0 * (after.value - before.value) / before.standard_error;
    let told = number_after(&said, "change work-of-adhesion by ");
    assert!((told / change - 1.0).abs() < 0.05, "{change}: {said}");
    // One of which an error is stated, or that is found, needs no doubt.
    let known = Known {
        quantity: Fixed::Parameter(Parameter::LoadOffset),
        error: offset,
    };
    let found = fit_with(&experiment, &lens.free, |options| options.known.push(known));
    assert_silent(&found.expect("sound data"), WarningKind::ZeroNotSeen);
    lens.free.push(Free::new(Parameter::LoadOffset));
    assert_silent(&fitted(&experiment, &lens.free), WarningKind::ZeroNotSeen);
}

#[test]
fn loading_and_unloading_are_not_mixed_unnoticed() {
    let mut lens = lens();
    lens.course = Course::Cycle;
    lens.radii[0] = 60e-6;
    lens.truth.work_of_adhesion = 0.03;
    lens.truth.work_of_adhesion_receding = Some(0.06);
    let mut experiment = lens.measured(&lens.exact(), 1);
    experiment.work_of_adhesion_receding = None;
    let assert_mixed = |experiment: &Experiment| {
        let found = fitted(experiment, &lens.free);
        let words = "work-of-adhesion-receding";
        assert_warns(&found, WarningKind::MixedBranches, words);
    };
    assert_mixed(&experiment);
    // Without directions the order in time tells them apart, and without order the residuals do.
    let points = &mut experiment.measurement.points;
    points.iter_mut().for_each(|point| point.direction = None);
    assert_mixed(&experiment);
    let points = &mut experiment.measurement.points;
    points.sort_by_key(|point| point.line * 37 % 101);
    assert_mixed(&experiment);
}

#[test]
fn a_retract_without_adhesion_in_the_model_is_doubted() {
    let free = [Parameter::FilmModulus, Parameter::ContactPoint];
    let probe = Imagined::probe(Course::Retract, 1e-4, &free);
    let mut experiment = probe.measured(&probe.exact(), 1);
    experiment.work_of_adhesion = 0.0;
    let found = fitted(&experiment, &probe.free);
    assert_warns(&found, WarningKind::PoorFit, "reduced chi^2");
    let words = "neighbouring residuals are alike; too small by a factor";
    assert_warns(&found, WarningKind::StructuredResiduals, words);
}

#[test]
fn what_the_data_do_not_tell_is_named() {
    let free = [LENS[0], LENS[1], Parameter::FilmModulus];
    for kind in [Kind::LoadRadius, Kind::LoadPenetration] {
        let lens = Imagined::lens(kind, 1e-6, 5e-6, &free);
        let found = lens.fit(1);
        let words = "film-modulus is not determined; standard error";
        assert_warns(&found, WarningKind::Undetermined, words);
        let words = "a/t is from; film-modulus";
        assert_warns(&found, WarningKind::FilmNotSeen, words);
        // If the film's modulus is known, there is no doubt.
        let known = Imagined::lens(kind, 1e-6, 5e-6, &LENS).fit(1);
        let zero = (kind == Kind::LoadPenetration).then_some(WarningKind::ZeroNotSeen);
        assert_no_doubts(&known, zero.as_slice());
    }
    // Penetrations at contact radii on a half-space tell w/E* alone.
    let mut lens = Imagined::lens(Kind::PenetrationRadius, 1e-6, 5e-9, &LENS);
    lens.truth.bodies = half_space(1e-3, 2e6, solid(2e11, 0.25));
    let found = lens.fit(1);
    let both = "sphere-modulus and work-of-adhesion";
    assert_eq!(found.undetermined.len(), 1);
    assert_eq!(found.undetermined[0].text, both);
    let [(_, one), (_, other)] = found.undetermined[0].weights[..] else {
        panic!("{:?}", found.undetermined);
    };
    assert!((one - other).abs() < 0.01, "{one}, {other}");
    assert_warns(&found, WarningKind::Undetermined, both);
    let ratio = |fit: &Fit| {
        fit.estimate(LENS[1]).expect("free").value / fit.estimate(LENS[0]).expect("free").value
    };
    assert!((ratio(&found) / (0.04 / 2e6) - 1.0).abs() < 0.05);
    // A prior on one of them decides.
    lens.free[0] = lens.free[0].with_prior(2e6, 2e4);
    let found = lens.fit(1);
    assert_no_doubts(&found, &[]);
    let error = found.estimate(LENS[0]).expect("free").standard_error;
    assert!((error / 2e4 - 1.0).abs() < 0.01, "{error}");
}

#[test]
fn wrong_values_and_wrong_units_are_doubted() {
    let lens = Imagined::lens(Kind::LoadRadius, 100e-6, 5e-6, &LENS);
    let exact = lens.exact();
    let with = |edit: &dyn Fn(&mut Experiment)| {
        let mut experiment = lens.measured(&exact, 1);
        edit(&mut experiment);
        fit_with(&experiment, &lens.free, |_| ())
    };
    let thickness = Parameter::FilmThickness;
    let thin = with(&|experiment| experiment.set(thickness, 10e-6).expect("physical"));
    assert_warns(&thin.expect("sound"), WarningKind::PoorFit, "reduced chi^2");
    // Loads in uN taken for N, and the other way round.
    for factor in [1e6, 1e-6] {
        let found = with(&|experiment| {
            let points = &mut experiment.measurement.points;
            points.iter_mut().for_each(|point| point.ordinate *= factor);
            experiment.noise = experiment.noise.map(|noise| factor * noise);
        });
        let found = found.expect("a fit");
        let kinds = [WarningKind::Implausible, WarningKind::PoorFit];
        let is_doubted = kinds.iter().any(|kind| found.warns_of(*kind));
        assert!(is_doubted, "{:?}", found.warnings);
    }
    // Radii in um taken for m.
    let error = with(&|experiment| {
        let points = &mut experiment.measurement.points;
        points.iter_mut().for_each(|point| point.abscissa *= 1e6);
    });
    error.refused("imagined.csv; line 2; contact radius; 42; units");
    // And the other way round.
    let found = with(&|experiment| {
        let points = &mut experiment.measurement.points;
        points.iter_mut().for_each(|point| point.abscissa *= 1e-6);
    });
    match found {
        Ok(found) => assert_warns(&found, WarningKind::Implausible, "check the units"),
        refused => refused.refused("imagined.csv"),
    }
}

#[test]
fn points_far_from_the_fit_are_listed() {
    let lens = lens();
    let mut experiment = lens.measured(&lens.exact(), 1);
    experiment.measurement.points[20].ordinate += 1e-4;
    let found = fitted(&experiment, &lens.free);
    assert_warns(&found, WarningKind::Outliers, "1 of 40 points; line 22");
    let flagged = found.experiments[0].points.iter().filter(|p| p.outlier);
    assert_eq!(flagged.map(|point| point.line).collect::<Vec<_>>(), [22]);
}

/// A zero of the balance that the data hardly tell, but that changes the work of adhesion by many of its errors.
#[test]
fn a_small_offset_that_misleads_is_named() {
    let mut lens = Imagined::lens(Kind::LoadRadius, 30e-6, 5e-6, &LENS);
    (lens.radii, lens.points) = ([42e-6, 130e-6], [20, 0]);
    lens.truth.load_offset = 25e-6;
    let (mut named, mut hinted, mut wrong) = (0, 0, 0);
    for (_, mut experiment) in lens.data(0..40) {
        experiment.load_offset = 0.0;
        let found = fitted(&experiment, &lens.free);
        let work = found.estimate(Parameter::WorkOfAdhesion).expect("free");
        wrong += i32::from((work.value - 0.04).abs() > 5.0 * work.standard_error);
        hinted += i32::from(found.warns_of(WarningKind::OffsetHinted));
        let kinds = [WarningKind::OffsetWanted, WarningKind::OffsetHinted];
        named += i32::from(kinds.into_iter().any(|kind| found.warns_of(kind)));
    }
    let counts = [wrong, named, hinted];
    assert!(wrong >= 38 && named >= 24 && hinted >= 8, "{counts:?}");
}

#[test]
fn contacts_outside_the_model_are_warned_of() {
    let free = [Parameter::FilmModulus];
    let mut probe = Imagined::probe(Course::Retract, 1e-4, &free);
    probe.radii[1] = 9e-6;
    let found = probe.fit(1);
    let words = "a/R reaches 0.45; 0.3; fit the exact sphere";
    assert_warns(&found, WarningKind::LargeContact, words);
    assert_warns(&found, WarningKind::LargeStrain, "of its thickness");
    // The exact sphere does not serve wider contacts on a film.
    probe.radii[1] = 12e-6;
    let words = "a/R reaches 0.60; leave out; above 0.55 R; fit the exact sphere";
    assert_warns(&probe.fit(1), WarningKind::LargeContact, words);
    let half_angle = 20_f64.to_radians();
    probe.truth.bodies.probe = Probe::Cone { half_angle };
    probe.radii[1] = 6e-6;
    let words = "reaches 2.75; half angle 20 degrees";
    assert_warns(&probe.fit(1), WarningKind::LargeContact, words);
    // A hard and weakly adhesive contact: mu = (20e-9 (1e-3/5e10)^2/(3e-10)^3)^(1/3) = 0.07.
    let mut hard = Imagined::hard();
    hard.truth.work_of_adhesion = 0.05;
    let words = "Tabor's parameter; below 5; does not hold; zone; work of adhesion is wrong; a direct solve";
    let found = hard.fit(1);
    assert_warns(&found, WarningKind::LongRange, words);
    assert!(!text(&found, WarningKind::LongRange).contains("larger stress"));
    // On a softer film the cohesive zone is short, and its effect a few per cent.
    let mut softer = Imagined::lens(Kind::LoadPenetration, 1e-6, 1e-9, &[LENS[1]]);
    softer.truth = hard.truth;
    softer.truth.bodies = Bodies::coated(&rigid_sphere(20e-9, [5e8, 0.2], 1e-7, [2e11, 0.2]));
    softer.radii = [5e-9, 9e-9];
    softer.noise = 1e-11;
    let words = "Tabor's parameter; too small by 2.; %";
    assert_warns(&softer.fit(1), WarningKind::LongRange, words);
    // The lens is soft and in the limit of JKR.
    assert_no_doubts(&lens().fit(1), &[]);
}

#[test]
fn points_beyond_the_pull_off_of_the_fit_are_warned_of() {
    // The data separate at a penetration at which a contact of this fixed work of adhesion cannot
    // be.
    let free = [Parameter::SphereModulus];
    let mut lens = Imagined::lens(Kind::LoadPenetration, 10e-6, 3e-6, &free);
    lens.radii[0] = 21e-6;
    let mut experiment = lens.measured(&lens.exact(), 1);
    experiment.work_of_adhesion = 0.02;
    let found = fitted(&experiment, &lens.free);
    let words = "in contact; end of the fitted branch";
    assert_warns(&found, WarningKind::LeftOut, words);
}

#[test]
fn a_doubt_about_one_of_several_measurements_names_it() {
    let free = [LENS[0], LENS[1], Parameter::FilmModulus];
    let lens = Imagined::lens(Kind::LoadRadius, 1e-6, 5e-6, &free);
    let experiments = ["first", "second"].map(|name| {
        let mut experiment = lens.measured(&lens.exact(), 1);
        experiment.measurement.name = name.into();
        experiment
    });
    let own = free.map(|parameter| Free::new(parameter).with_scope(Scope::Own));
    let found = fit_all(&experiments, &own).expect("sound");
    let words = "film-modulus of first is not determined; film-modulus of second is not determined";
    assert_warns(&found, WarningKind::Undetermined, words);
}

#[test]
fn a_fit_that_would_leave_the_table_is_warned_of() {
    let limited = table(
        "title = 'Soft films'\ntolerance = 1e-6\nquantities = ['gamma']
        a_over_t = { from = 1e-3, to = 1e3 }\ne1_over_e2 = { from = 1e-3, to = 0.1 }
        nu1 = 0.5\ne0_over_e2 = { from = 1e4, to = 1e6 }\nnu0 = 0.25",
    );
    // The sphere is 3000 times as stiff as the film, and the table ends at 1000.
    let free = [Parameter::WorkOfAdhesion, Parameter::FilmModulus];
    let mut lens = Imagined::lens(Kind::LoadRadius, 3e-6, 5e-6, &free);
    lens.radii = [90e-6, 200e-6];
    let modulus = Parameter::FilmModulus;
    lens.truth.set(modulus, 2e6 / 3000.0).expect("physical");
    lens.free[1] = lens.free[1].starting_from(4e3);
    let experiment = lens.measured(&lens.exact(), 1);
    let options = Options::default();
    let found = fit(&limited, &[experiment], &lens.free, &options).expect("it starts inside");
    assert_warns(&found, WarningKind::EndOfTable, "the table ends");
    assert!(!found.converged);
}

#[test]
fn a_value_at_its_bound_is_named() {
    let mut lens = lens();
    lens.free[0] = lens.free[0].within(1e6, 1.9e6).starting_from(1.5e6);
    let found = lens.fit(1);
    assert_warns(&found, WarningKind::AtBound, "sphere-modulus; at its bound");
    let value = found.estimate(LENS[0]).expect("free").value;
    assert!((1.89e6..=1.9e6).contains(&value), "{value}");
    // The end of what is possible is no bound that somebody has set.
    let free = [
        Parameter::FilmModulus,
        Parameter::FilmPoissonRatio,
        Parameter::ContactPoint,
    ];
    let mut gel = Imagined::probe(Course::Approach, 0.0, &free);
    let film = film(&mut gel.truth);
    film.solid = solid(film.solid.young(), 0.5);
    gel.free[1] = gel.free[1].starting_from(0.4);
    let said: Vec<String> = (0..8)
        .map(|seed| text(&gel.fit(seed), WarningKind::AtBound))
        .collect();
    let at_end = said.iter().filter(|said| !said.is_empty());
    assert!(at_end.clone().count() > 0, "{said:?}");
    for said in at_end {
        assert_names(
            said,
            "film-poisson-ratio =; is at the end of what is possible; fix it there",
        );
    }
    // Bounds that hold the truth change nothing.
    let free = self::lens().fit(1);
    lens.free[0] = lens.free[0].within(1e5, 1e7);
    let bounded = lens.fit(1);
    for parameter in LENS {
        let [one, other] = [&free, &bounded].map(|fit| *fit.estimate(parameter).expect("free"));
        assert!((one.value - other.value).abs() < 1e-2 * one.standard_error);
        assert!((one.standard_error / other.standard_error - 1.0).abs() < 1e-3);
    }
}

/// Figure 4 of the paper: the lens of Tardivat and Leger on films of 1 to 30 um, with the moduli,
/// the radius and the adhesion of the paper's tables.
#[test]
fn films_below_10_um_change_what_jkr_finds_by_less_than_3_percent() {
    for thickness in [1e-6, 3e-6, 10e-6, 30e-6] {
        let mut lens = Imagined::lens(Kind::LoadRadius, thickness, 1e-6, &LENS);
        lens.radii[0] = 40e-6;
        let found = lens.fit(7);
        let without = found.without_film.as_ref().expect("JKR");
        let modulus = without.estimates[0].value;
        let bias = without.modulus.expect("the sphere's modulus is free");
        // The paper reads the modulus and the adhesion from the slope and the intercept of a
        // straight line in the JKR plot; this fit weights the loads themselves.
        assert_eq!(bias.parameter, LENS[0]);
        let expected = modulus / found.estimates[0].value - 1.0;
        assert!((bias.relative - expected).abs() < 1e-12);
        assert_eq!(bias.relative.abs() < 0.03, thickness <= 10e-6, "{bias:?}");
        assert!(bias.matters(), "{bias:?}");
        for (parameter, truth) in LENS.into_iter().zip([2e6, 0.04]) {
            let off = off(&found, parameter, truth);
            assert!(off.abs() < 3.5, "{thickness:e} m, {parameter}: {off}");
        }
    }
    // With twenty times the noise the data do not tell a film of 1 um from none.
    let found = Imagined::lens(Kind::LoadRadius, 1e-6, 2e-5, &LENS).fit(7);
    let bias = found.without_film.and_then(|without| without.modulus);
    assert!(!bias.expect("a modulus is free").matters());
}

#[test]
fn the_fit_without_the_film_can_be_left_out_and_changes_nothing_else() {
    let lens = Imagined::lens(Kind::LoadRadius, 10e-6, 1e-6, &LENS);
    let experiment = lens.measured(&lens.exact(), 7);
    let found = |without_film| {
        let fit = fit_with(&experiment, &lens.free, |options| {
            options.without_film = without_film
        });
        fit.expect("fitted")
    };
    let (mut with, left_out) = (found(true), found(false));
    assert!(with.without_film.take().is_some());
    for point in &mut with.experiments[0].points {
        assert!(point.without_film.take().is_some());
    }
    assert_eq!(with, left_out);
}

#[test]
fn profiles_agree_with_standard_errors_where_the_model_is_linear() {
    let profiled = |lens: &Imagined| profiled(&lens.measured(&lens.exact(), 1), &lens.free);
    let found = profiled(&lens());
    for estimate in &found.estimates {
        let ([low, high], [from, to]) = (estimate.interval(1.96), estimate.profile.expect("asked"));
        let width = high - low;
        assert!((from - low).abs() < 0.02 * width && (to - high).abs() < 0.02 * width);
    }
    // These data set a lower limit to the film's modulus, and no upper one.
    let free = [LENS[0], LENS[1], Parameter::FilmModulus];
    let found = profiled(&Imagined::lens(Kind::LoadRadius, 10e-6, 5e-6, &free));
    let modulus = found.estimate(free[2]).expect("free");
    let [low, high] = modulus.profile.expect("asked");
    let is_open = low > 1e5 && low < 3.5e6 && high == f64::INFINITY;
    assert!(is_open, "{modulus:?}");
}

#[test]
fn directions_without_hysteresis_are_no_reason_for_doubt() {
    let mut lens = lens();
    lens.course = Course::Cycle;
    for seed in 0..20 {
        let found = lens.fit(seed);
        assert_no_doubts(&found, &[]);
        let retracts = found.experiments[0].points.iter();
        let retracts = retracts.filter(|point| point.branch == fit::Branch::Receding);
        assert_eq!(retracts.count(), 40);
    }
}

/// Adhesion that is left out is named, and not a zero of the balance, which explains the data less well.
#[test]
fn adhesion_that_is_left_out_is_named_before_any_zero() {
    let film = [Parameter::FilmModulus];
    for thickness in [10e-6, 30e-6] {
        let free = [Parameter::SphereModulus];
        let imagined = Imagined::lens(Kind::LoadRadius, thickness, 2e-6, &free);
        let mut experiment = imagined.measured(&imagined.exact(), 1);
        experiment.work_of_adhesion = 0.0;
        let found = fitted_of_few(&experiment, &imagined.free);
        let words = "work-of-adhesion is 0; adhesion would describe the data better; free it";
        assert_warns(&found, WarningKind::AdhesionWanted, words);
        assert_silent(&found, WarningKind::OffsetWanted);
    }
    // Against positions the force falls below the baseline, and jumps back.
    for course in [Course::Retract, Course::Cycle] {
        let probe = Imagined::probe(
            course,
            5e-5,
            &[
                Parameter::FilmModulus,
                Parameter::ContactPoint,
                Parameter::Baseline,
            ],
        );
        let mut experiment = probe.measured(&probe.exact(), 1);
        experiment.work_of_adhesion = 0.0;
        let found = fitted_of_few(&experiment, &probe.free);
        let words = "below the baseline; jumps back; is adhesion; free it (work-of-adhesion)";
        assert_warns(&found, WarningKind::AdhesionWanted, words);
        assert_silent(&found, WarningKind::OffsetWanted);
    }
    // A pull-off that the noise hides makes the modulus too large.
    for course in [Course::Approach, Course::Retract, Course::Cycle] {
        let free = [Parameter::FilmModulus, Parameter::ContactPoint];
        let probe = Imagined::probe(course, 5e-6, &free);
        let mut experiment = probe.measured(&probe.exact(), 1);
        experiment.work_of_adhesion = 0.0;
        let found = fitted_of_few(&experiment, &probe.free);
        let words = "work-of-adhesion is 0; adhesion would describe the data better; free it";
        assert_warns(&found, WarningKind::AdhesionWanted, words);
    }
    // A contact point that is fixed wrongly explains the data better.
    for shift in [-3e-8, 3e-8] {
        let free = [Parameter::FilmModulus, Parameter::Baseline];
        let probe = Imagined::probe(Course::Approach, 0.0, &free);
        let mut experiment = probe.measured(&probe.exact(), 1);
        experiment.contact_point += shift;
        let found = fitted_of_few(&experiment, &probe.free);
        assert_warns(&found, WarningKind::OffsetWanted, "contact-point; free it");
        assert_silent(&found, WarningKind::AdhesionWanted);
    }
    // Without adhesion nothing is said of it.
    for seed in 0..20 {
        let probe = Imagined::probe(Course::Approach, 0.0, &film);
        let found = fitted(&probe.measured(&probe.exact(), seed), &probe.free);
        assert_silent(&found, WarningKind::AdhesionWanted);
        assert_silent(&found, WarningKind::OffsetWanted);
    }
}
