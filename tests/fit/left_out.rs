//! Points that are left out are counted by reason; most of them, or an error that is not finite, is
//! no result.

use acceptance::{Refused, assert_names, paper_system, rigid_probe, solid};
use fit::{
    Bodies, Branch, Direction, Experiment, Fit, Free, Kind, LeftOutReason, Parameter, Point,
    WarningKind, simulate,
};
use interp::{Probe, Table};

use crate::imagined::{
    Course, FORCE_CURVE, Imagined, LENS, assert_warns, fit_all, fit_with, free_of, gel,
    measurement, measurement_at, of_file, text,
};

/// Fits an experiment; most of its points may be left out if `allow`.
fn fitted(experiment: &Experiment, free: &[Parameter], allow: bool) -> Result<Fit, fit::Error> {
    fit_with(experiment, &free_of(free), |options| {
        options.allow_left_out = allow
    })
}

/// Returns the number of points of a fit that are left out, in contact or anywhere.
fn left_out(found: &Fit, in_contact: bool) -> usize {
    let groups = found.experiments[0].left_out.iter();
    let groups = groups.filter(|group| !in_contact || group.reason.is_of_contact());
    groups.map(|group| group.points).sum()
}

/// Asserts that as many points are left out as have no other branch.
fn assert_counted(found: &Fit) {
    let points = found.experiments[0].points.iter();
    let branches = points.filter(|point| point.branch == Branch::LeftOut);
    assert_eq!(left_out(found, false), branches.count());
}

/// A retract whose tension grows in proportion to the height up to a jump, as that of a viscous
/// solid: no contact of the model holds so long.
fn viscous() -> Experiment {
    let point = |i: u32| {
        let height = -1e-6 + 3e-8 * f64::from(i);
        let noise = f64::from((i * 7919 + 13) % 101) / 101.0 - 0.5;
        let force = if height < 2e-6 { -5e-3 * height } else { 0.0 };
        Point {
            line: u64::from(i) + 2,
            abscissa: height,
            ordinate: force + 1e-11 * noise,
            direction: Some(Direction::Retract),
        }
    };
    let measurement = measurement(Kind::ForceHeight, (0..200).map(point).collect());
    let mut experiment = Experiment::new(measurement, Bodies::coated(&gel()));
    experiment.stiffness = Some(0.2);
    experiment
}

#[test]
fn most_points_left_out_are_an_error_unless_allowed() {
    let free = [Parameter::WorkOfAdhesion];
    fitted(&viscous(), &free, false).refused(
        "imagined.csv; of 101 points in contact are left out, more than a third; within 4 standard errors of the end; \
         beyond the end of the fitted branch; Check the units",
    );
    let allowed = fitted(&viscous(), &free, true).expect("allowed");
    assert_counted(&allowed);
    let count = left_out(&allowed, true);
    let words = format!("{count} of 101 points in contact do not count");
    assert_warns(&allowed, WarningKind::LeftOut, &words);
}

#[test]
fn every_point_left_out_has_its_reason() {
    let found = Imagined::probe(Course::Retract, 1e-4, &FORCE_CURVE).fit(3);
    assert_counted(&found);
    let groups = &found.experiments[0].left_out;
    let reasons: Vec<LeftOutReason> = groups.iter().map(|group| group.reason).collect();
    assert!(reasons.is_sorted(), "{reasons:?}");
    assert!(reasons.contains(&LeftOutReason::NearEnd), "{reasons:?}");
    for group in groups {
        let [first, last] = group.lines;
        let are_within = first <= last && (last - first) as usize + 1 >= group.points;
        assert!(are_within && group.points > 0, "{group:?}");
    }
}

#[test]
fn a_value_that_changes_nothing_is_no_result() {
    let free = [Parameter::FilmModulus, Parameter::ContactPoint];
    let probe = Imagined::probe(Course::Approach, 1e-4, &free);
    let experiment = probe.measured(&probe.exact(), 1);
    assert!(fitted(&experiment, &free, false).is_ok());
    // No point is on retract.
    let all = [free[0], free[1], Parameter::WorkOfAdhesionReceding];
    let words = "do not determine work-of-adhesion-receding; unloading; directions";
    fitted(&experiment, &all, false).refused(words);
    let mut known = all.map(Free::new);
    known[2] = known[2].with_prior(1e-4, 1e-5);
    let found = fit_all(&[experiment], &known);
    assert!(found.expect("the prior tells it").converged);
}

/// The curve that the program shows as an example, made with a film of 5 kPa and 20 um.
fn shipped_gel() -> Experiment {
    let probe = Probe::Paraboloid { radius: 10e-6 };
    let system = rigid_probe(probe, solid(5e3, 0.5), 20e-6, solid(70e9, 0.25));
    let mut experiment = of_file("data/gel.csv", Bodies::coated(&system));
    experiment.stiffness = Some(0.1);
    experiment
}

#[test]
fn a_start_that_leads_nowhere_does_not_leave_out_all_points() {
    let free = [
        Parameter::FilmModulus,
        Parameter::FilmThickness,
        Parameter::WorkOfAdhesion,
        Parameter::ContactPoint,
        Parameter::Baseline,
    ];
    let found = fitted(&shipped_gel(), &free, false).expect("sound data");
    assert!(found.converged, "{:?}", found.warnings);
    for (parameter, truth, largest) in [
        (Parameter::FilmModulus, 5e3, 200.0),
        (Parameter::FilmThickness, 20e-6, 4e-6),
        (Parameter::WorkOfAdhesion, 5e-5, 5e-7),
    ] {
        let estimate = found.estimate(parameter).expect("it is free");
        let error = estimate.standard_error;
        assert!(error < largest, "{estimate:?}");
        assert!((estimate.value - truth).abs() < 3.0 * error, "{estimate:?}");
    }
    // Of 94 points in contact.
    let near = left_out(&found, true);
    assert!(near <= 10, "{near}");
}

/// Loads without adhesion, whose noise asks for less than none in half of the cases.
#[test]
fn a_work_of_adhesion_that_ends_at_0_is_told() {
    let radii = (0..40).map(|i| 4e-5 + 2e-6 * f64::from(i));
    let measurement = measurement_at(Kind::LoadRadius, radii);
    let mut plan = Experiment::new(measurement, Bodies::coated(&paper_system(3e-5)));
    plan.work_of_adhesion = 0.0;
    let noise = 1e-5;
    let mut ended = 0;
    for seed in 0..12 {
        let mut made = simulate(Table::embedded(), &plan, noise, seed).expect("in the table");
        made.noise = Some(noise);
        made.work_of_adhesion = 0.04;
        let found = fitted(&made, &LENS, true).expect("sound data");
        let work = found.estimate(LENS[1]).expect("free").value;
        if work < 1e-12 {
            ended += 1;
            let told = text(&found, WarningKind::AtBound);
            assert_names(&told, "work-of-adhesion; ended at 0; fix it at 0");
            assert_eq!(told.matches("ended at 0").count(), 1, "{told}");
        }
    }
    assert!(ended > 0);
}

/// A free work of adhesion has no value yet: whether it stands as 0 or as another number, the points near
/// the ends of the branches are the same, and so is the result.
#[test]
fn the_value_of_a_free_work_of_adhesion_does_not_count() {
    let probe = Imagined::probe(Course::Cycle, 5e-5, &FORCE_CURVE);
    for (seed, mut experiment) in probe.data(0..20) {
        let [none, other] = [0.0, 1.0].map(|work| {
            experiment.work_of_adhesion = work;
            let found = fit_all(std::slice::from_ref(&experiment), &probe.free).expect("sound");
            found.estimates
        });
        assert_eq!(none, other, "seed {seed}");
    }
}
