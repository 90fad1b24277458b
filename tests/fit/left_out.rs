//! Points that are left out are counted by reason; most of them, or an error that is not finite, is
//! no result.

use acceptance::assert_names;
use fit::{
    Bodies, Branch, Direction, Experiment, Fit, Free, Kind, LeftOutReason, Options, Parameter,
    Point, WarningKind, fit,
};
use interp::Table;

use crate::imagined::{Course, Imagined, fit_all, gel, measurement};

fn fit_with(experiment: &Experiment, free: &[Parameter], allow: bool) -> Result<Fit, fit::Error> {
    let free: Vec<Free> = free.iter().copied().map(Free::new).collect();
    let options = Options {
        allow_left_out: allow,
        ..Options::default()
    };
    fit(
        Table::embedded(),
        std::slice::from_ref(experiment),
        &free,
        &options,
    )
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
    let mut experiment = Experiment::new(measurement, Bodies::Coated(gel()));
    experiment.stiffness = Some(0.2);
    experiment
}

#[test]
fn most_points_left_out_are_an_error_unless_allowed() {
    let free = [Parameter::WorkOfAdhesion];
    let refused = fit_with(&viscous(), &free, false).expect_err("most points are left out");
    assert!(
        matches!(
            refused,
            fit::Error::LeftOut {
                in_contact: 101,
                ..
            }
        ),
        "{refused:?}"
    );
    let text = refused.to_string();
    assert_names(
        &text,
        &[
            "imagined.csv",
            "of 101 points in contact are left out, more than a third",
            "within 4 standard errors of the end",
            "beyond the end of the fitted branch",
            "Check the units",
        ],
    );
    assert!(!text.contains("--"), "a library names no flag: {text}");
    let allowed = fit_with(&viscous(), &free, true).expect("allowed");
    let fitted = &allowed.experiments[0];
    let branches = fitted.points.iter().map(|point| point.branch);
    let left_out = branches.filter(|branch| *branch == Branch::LeftOut).count();
    let counted: usize = fitted.left_out.iter().map(|group| group.points).sum();
    assert_eq!(counted, left_out, "{:?}", fitted.left_out);
    let warning = allowed
        .warnings
        .iter()
        .find(|one| one.kind == WarningKind::LeftOut);
    let of_contact: usize = fitted
        .left_out
        .iter()
        .filter(|group| group.reason.is_of_contact())
        .map(|group| group.points)
        .sum();
    assert_names(
        &warning.expect("it is a doubt still").text,
        &[&format!(
            "{of_contact} of 101 points in contact do not count"
        )],
    );
}

#[test]
fn every_point_left_out_has_its_reason() {
    let free = [
        Parameter::FilmModulus,
        Parameter::WorkOfAdhesion,
        Parameter::ContactPoint,
        Parameter::Baseline,
    ];
    let probe = Imagined::probe(Course::Retract, 1e-4, &free);
    let found = probe.fit(3);
    let fitted = &found.experiments[0];
    let counted: usize = fitted.left_out.iter().map(|group| group.points).sum();
    let branches = fitted.points.iter().map(|point| point.branch);
    assert_eq!(
        counted,
        branches.filter(|branch| *branch == Branch::LeftOut).count()
    );
    assert!(counted > 0, "some are near the end of the branch");
    let reasons: Vec<LeftOutReason> = fitted.left_out.iter().map(|group| group.reason).collect();
    assert!(
        reasons.is_sorted() && reasons.contains(&LeftOutReason::NearEnd),
        "{reasons:?}"
    );
    for group in &fitted.left_out {
        let [first, last] = group.lines;
        assert!(
            first <= last && (last - first) as usize + 1 >= group.points,
            "{group:?}"
        );
    }
}

#[test]
fn a_value_that_changes_nothing_is_no_result() {
    let free = [Parameter::FilmModulus, Parameter::ContactPoint];
    let probe = Imagined::probe(Course::Approach, 1e-4, &free);
    let experiment = probe.measured(&probe.exact(), 1);
    assert!(fit_with(&experiment, &free, false).is_ok());
    // No point is on retract.
    let all = [free[0], free[1], Parameter::WorkOfAdhesionReceding];
    let refused = fit_with(&experiment, &all, false).expect_err("it has no effect");
    assert!(
        matches!(refused, fit::Error::NotDetermined { .. }),
        "{refused:?}"
    );
    assert_names(
        &refused.to_string(),
        &[
            "do not determine work-of-adhesion-receding",
            "Fix it",
            "prior",
        ],
    );
    let known = [
        Free::new(all[0]),
        Free::new(all[1]),
        Free::new(all[2]).with_prior(1e-4, 1e-5),
    ];
    let found = fit_all(&[experiment], &known);
    assert!(found.expect("the prior tells it").converged);
}
