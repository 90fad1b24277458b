//! Doubts about fits of bodies that relax.

use acceptance::{rigid_probe, solid};
use contact::Relaxation;
use fit::{
    Bodies, Direction, Experiment, Free, Kind, Parameter, Point, Relaxing, WarningKind, simulate,
};
use interp::{Probe, Table};

use crate::imagined::{fit_all, free_of, measurement, text};

/// A gel that relaxes on a base, 60 points in 2 s.
fn relaxing(law: Relaxation, young: f64, base: f64) -> Experiment {
    let bodies = Bodies::Coated(rigid_probe(
        Probe::Paraboloid { radius: 2e-5 },
        solid(young, 0.5),
        1e-5,
        solid(base, 0.25),
    ));
    let times: Vec<f64> = (0..60).map(|i| 2.0 * f64::from(i) / 59.0).collect();
    let depth = |t: f64| {
        6e-7 * if t < 1.0 {
            1.2 * t - 0.2
        } else {
            1.0 - 1.2 * (t - 1.0)
        }
    };
    let point = |(line, &t): (u64, &f64)| Point {
        line,
        abscissa: depth(t),
        ordinate: 0.0,
        direction: Some(if t <= 1.0 {
            Direction::Approach
        } else {
            Direction::Retract
        }),
    };
    let points = (1..).zip(&times).map(point).collect();
    let mut plan = Experiment::new(measurement(Kind::LoadPenetration, points), bodies);
    plan.times = times;
    plan.relaxing = Some(Relaxing {
        law,
        all_bodies: base < f64::INFINITY,
    });
    let exact = simulate(Table::embedded(), &plan, 0.0, 0).expect("in the table");
    let noise = 0.01
        * exact
            .points
            .iter()
            .fold(0.0_f64, |most, one| most.max(one.ordinate));
    plan.measurement = simulate(Table::embedded(), &plan, noise, 1).expect("in the table");
    plan.noise = Some(noise);
    plan
}

#[test]
fn a_relaxation_time_that_the_points_do_not_see_is_doubted() {
    for (time, is_doubted) in [(0.01, true), (0.3, false), (10.0, true)] {
        let law = Relaxation::Prony {
            relaxed: 0.3,
            terms: vec![[0.7, time]],
        };
        let data = relaxing(law, 2e3, f64::INFINITY);
        let bounds = Free::new(Parameter::RelaxationTime(1)).within(0.5 * time, 2.0 * time);
        let found = fit_all(&[data], &[Free::new(Parameter::FilmModulus), bounds]);
        let said = text(&found.expect("sound"), WarningKind::RelaxationTime);
        assert_eq!(
            said.contains("two intervals between points"),
            is_doubted,
            "{time}: {said}"
        );
    }
}

#[test]
fn a_stiff_film_on_a_soft_base_that_relax_together_is_doubted() {
    let law = Relaxation::PowerLaw {
        exponent: 0.2,
        time: 1.0,
    };
    for (young, base, is_doubted) in [(2e4, 2e3, true), (2e3, 2e4, false), (2e3, 1e3, false)] {
        let data = relaxing(law.clone(), young, base);
        let found = fit_all(&[data], &free_of(&[Parameter::FilmModulus])).expect("sound");
        let doubted = found.warns_of(WarningKind::TensileInside);
        assert_eq!(
            doubted, is_doubted,
            "{young:e} {base:e}: {:?}",
            found.warnings
        );
    }
}
