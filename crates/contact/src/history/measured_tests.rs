//! Measured histories against those with many digits, and their derivatives against differences.

use interp::{Elastic, HalfSpace, Probe, System, Table};

use super::{HistoryInputs, Relaxation, TimedContact};
use crate::{Contact, Control, Error, Input};

fn system(young: f64) -> System {
    System {
        probe: Probe::Paraboloid { radius: 1e-5 },
        sphere_modulus: f64::INFINITY,
        film: Elastic::new(young, 0.48).expect("a solid"),
        film_thickness: 5e-6,
        substrate: Elastic::new(f64::INFINITY, 0.25).expect("a solid"),
    }
}

fn contact(young: f64) -> Contact {
    Contact::in_table_with_gradient(Table::embedded(), &system(young)).expect("in the table")
}

/// An approach that begins above the surface, a hold, and a retract, with a shift.
fn program(points: usize, shift: f64) -> Vec<(f64, f64)> {
    let value = |t: f64| match t {
        _ if t < 1.0 => 1.2e-6 * t,
        _ if t < 1.3 => 1.2e-6,
        _ => 1.2e-6 - 2e-6 * (t - 1.3),
    };
    let time = |i: usize| 2.0 * i as f64 / (points - 1) as f64;
    let point = |i: usize| (time(i), value(time(i)) - 1e-7 + shift);
    (0..points).map(point).collect()
}

fn laws() -> Vec<Relaxation> {
    vec![
        Relaxation::Prony {
            relaxed: 0.3,
            terms: vec![[0.7, 0.4]],
        },
        Relaxation::Prony {
            relaxed: 0.2,
            terms: vec![[0.5, 0.03], [0.3, 0.9]],
        },
        Relaxation::PowerLaw {
            exponent: 0.25,
            time: 1.0,
        },
        Relaxation::ModifiedPowerLaw {
            relaxed: 0.1,
            exponent: 0.4,
            time: 0.05,
        },
        Relaxation::FractionalZener {
            relaxed: 0.1,
            exponent: 0.5,
            time: 0.3,
        },
    ]
}

/// The error by the exponentials and the elastic curve.
const REST: f64 = 1e-5;

const SPRING: Control = Control::Spring { stiffness: 0.01 };

/// Returns the largest difference of the loads, in parts of the largest one.
fn difference<'a>(
    exact: impl Iterator<Item = &'a TimedContact>,
    own: impl Iterator<Item = &'a TimedContact>,
) -> f64 {
    let loads = |at: &TimedContact| at.state.load;
    let (mut worst, mut largest) = (0.0_f64, 0.0_f64);
    for (exact, own) in exact.map(loads).zip(own.map(loads)) {
        worst = worst.max((exact - own).abs());
        largest = largest.max(exact);
    }
    worst / largest
}

#[test]
fn loads_agree_with_those_of_many_digits() {
    let contact = contact(1e3);
    for law in laws() {
        let history = contact.history(&law).expect("a law");
        for points in [101, 401] {
            let program = program(points, 0.0);
            let exact = history.run(Control::Displacement, &program, None);
            let exact = exact.expect("a course").states;
            let own = history.measured(Control::Displacement, &program, None);
            let own = own.expect("measured").states;
            let error = difference(exact.iter(), own.iter());
            println!("{law:?} {points}: {error:.1e}");
            assert!(error < 3e-5, "{law:?} {points}: {error:.1e}");
        }
    }
    // Elements follow heights.
    for law in &laws()[..2] {
        let history = contact.history(law).expect("a law");
        let program = program(201, 0.0);
        let exact = history.run(SPRING, &program, Some(3e-5)).expect("a course");
        let own = history.measured(SPRING, &program, None).expect("measured");
        let error = difference(exact.states.iter(), own.states.iter());
        let estimate = history.error_of_measured(SPRING, &program, &own);
        let estimate = estimate.expect("an estimate");
        println!(
            "{law:?}: {error:.1e} of {estimate:.1e}, exact to {:.1e}",
            exact.error
        );
        assert!(error < 4e-5 && estimate < 1e-4, "{error:.1e}");
        assert!(
            error < estimate + exact.error + REST,
            "{error:.1e}, {estimate:.1e}"
        );
    }
}

/// A flat end has its whole stiffness at the first touch: the load after the first step, in parts of itself, tells.
#[test]
fn a_flat_end_that_begins_at_the_surface() {
    let contact = Contact::half_space(&HalfSpace {
        probe: Probe::FlatEndedCone {
            radius: 1e-6,
            half_angle: 1.2,
        },
        sphere_modulus: f64::INFINITY,
        solid: Elastic::new(1e3, 0.5).expect("a solid"),
    });
    let contact = contact.expect("a contact");
    let program = [(0.0, 0.0), (1e-5, 1e-11), (1.0, 1e-6), (2.0, 1e-6)];
    for law in laws() {
        let history = contact.history(&law).expect("a law");
        let exact = history.run(Control::Displacement, &program, Some(1e-10));
        let exact = exact.expect("a course").states;
        let own = history.measured(Control::Displacement, &program, None);
        let own = own.expect("measured").states;
        for (exact, own) in exact.iter().zip(&own).skip(1) {
            let error = own.state.load / exact.state.load - 1.0;
            println!("{law:?} {}: {error:.1e}", exact.time);
            assert!(error.abs() < 1e-6, "{law:?} {}: {error:.1e}", exact.time);
        }
    }
}

/// The load is nearly that of the speed: it rises like a root at the first touch.
#[test]
fn bodies_that_nearly_flow() {
    let contact = contact(1e3);
    let fluid = Relaxation::Prony {
        relaxed: 0.0,
        terms: vec![[1.0, 0.002]],
    };
    let power = Relaxation::PowerLaw {
        exponent: 0.9,
        time: 1e-3,
    };
    let program = program(201, 0.0);
    for law in [fluid, power] {
        let history = contact.history(&law).expect("a law");
        let exact = history.run(Control::Displacement, &program, Some(1e-6));
        let exact = exact.expect("a course").states;
        let own = history.measured(Control::Displacement, &program, None);
        let own = own.expect("measured");
        let error = difference(exact.iter(), own.states.iter());
        let estimate = history.error_of_measured(Control::Displacement, &program, &own);
        let estimate = estimate.expect("an estimate");
        println!("{law:?}: {error:.1e} of {estimate:.1e}");
        assert!(
            error < 2e-5 && error < estimate + REST,
            "{law:?}: {error:.1e}"
        );
    }
}

/// The error of the steps of a spring is of second order; of singular laws, of the order 2 less the exponent.
#[test]
fn steps_of_a_spring_halved() {
    let contact = contact(1e3);
    for law in laws() {
        let history = contact.history(&law).expect("a law");
        let course = |points: usize| {
            let found = history.measured(SPRING, &program(points, 0.0), None);
            let states = found.expect("measured").states.into_iter();
            states.step_by((points - 1) / 400).collect::<Vec<_>>()
        };
        let exact = course(6401);
        let errors = [401, 801, 1601].map(|points| {
            let own = course(points);
            // The first steps of singular laws are the worst.
            difference(exact[60..].iter(), own[60..].iter())
        });
        println!("{law:?}: {errors:?}");
        assert!(errors[0] < 1e-4, "{law:?}: {errors:?}");
        assert!(
            errors[0] > 2.5 * errors[1] && errors[1] > 2.5 * errors[2] || errors[0] < 1e-6,
            "{law:?}: {errors:?}"
        );
    }
}

#[test]
fn derivatives_agree_with_differences() {
    for law in laws() {
        let parameters = law.parameters();
        for control in [Control::Displacement, SPRING] {
            let loads = |law: &Relaxation, young: f64, control: Control, shift: f64| {
                let contact = contact(young);
                let history = contact.history(law).expect("a law");
                let found = history.measured(control, &program(201, shift), None);
                let states = found.expect("measured").states;
                states.iter().map(|at| at.state.load).collect::<Vec<f64>>()
            };
            let contact = contact(1e3);
            let inputs = HistoryInputs {
                contact: &[Input::FilmModulus],
                law: &parameters,
            };
            let found = contact
                .history(&law)
                .expect("a law")
                .measured(control, &program(201, 0.0), Some(inputs))
                .expect("measured");
            let width = 3 + parameters.len();
            let check = |name: &str, column: usize, step: f64, ends: [Vec<f64>; 2]| {
                let exact: Vec<f64> = ends[1]
                    .iter()
                    .zip(&ends[0])
                    .map(|(above, below)| (above - below) / (2.0 * step))
                    .collect();
                let largest = exact.iter().map(|x| x.abs()).fold(0.0, f64::max);
                let own = found.derivatives.iter().skip(column).step_by(width);
                let errors = own
                    .zip(&exact)
                    .map(|(own, exact)| (own - exact).abs() / largest);
                let mut errors: Vec<f64> = errors.collect();
                let worst = errors.iter().copied().fold(0.0, f64::max);
                errors.sort_by(f64::total_cmp);
                let middle = errors[errors.len() / 2];
                println!("{law:?} {control:?} {name}: {worst:.1e}, median {middle:.1e}");
                assert!(
                    worst < 3e-2 && middle < 1e-3,
                    "{law:?} {control:?} {name}: {worst:.1e}"
                );
            };
            let step = 1e-10;
            let ends = [-step, step].map(|step| loads(&law, 1e3, control, step));
            check("place", 0, step, ends);
            if let Control::Spring { stiffness } = control {
                let step = 1e-4 * stiffness;
                let ends = [-step, step].map(|step| {
                    let stiffness = stiffness + step;
                    loads(&law, 1e3, Control::Spring { stiffness }, 0.0)
                });
                check("stiffness", 1, step, ends);
            }
            let ends = [-1.0, 1.0].map(|step| loads(&law, 1e3 + step, control, 0.0));
            check("modulus", 2, 1.0, ends);
            for (i, &parameter) in parameters.iter().enumerate() {
                let value = law.parameter(parameter).expect("its own");
                let step = 1e-4 * value;
                let ends = [-step, step]
                    .map(|step| loads(&law.with(parameter, value + step), 1e3, control, 0.0));
                check(&format!("{parameter:?}"), 3 + i, step, ends);
            }
        }
    }
}

/// A short curve on a clock that counts from long ago: its times hardly resolve a step.
#[test]
fn times_of_a_clock() {
    let contact = contact(1e3);
    let law = &laws()[2];
    let history = contact.history(law).expect("a law");
    let at = |origin: f64| {
        let points = program(201, 0.0);
        let points: Vec<_> = points
            .iter()
            .map(|(t, v)| (origin + 1e-3 * t, *v))
            .collect();
        let found = history.measured(SPRING, &points, None).expect("measured");
        let estimate = history.error_of_measured(SPRING, &points, &found);
        assert!(estimate.expect("an estimate") < 1e-3);
        let times = found
            .states
            .iter()
            .zip(&points)
            .all(|(at, point)| at.time == point.0);
        assert!(times);
        found.states
    };
    let (early, late) = (at(0.0), at(1.7e9));
    // The clock of 1.7e9 s resolves 2.4e-7 s, a fortieth of an interval.
    let error = difference(early.iter(), late.iter());
    println!("a clock of 1.7e9 s: {error:.1e}");
    assert!(error < 1e-3, "{error:.1e}");
}

#[test]
fn mistakes() {
    let contact = contact(1e3);
    let law = &laws()[0];
    let history = contact.history(law).expect("a law");
    let follow = |points: &[(f64, f64)]| history.measured(Control::Displacement, points, None);
    let refused = |found: Result<_, Error>, words: &str| {
        let Err(Error::Refused(what)) = found else {
            panic!("not refused: {words}")
        };
        assert!(what.contains(words), "{what}");
    };
    refused(follow(&[(0.0, 1e-7), (1.0, 1e-6)]), "begins in contact");
    let twice = [(0.0, 0.0), (1.0, 1e-6), (1.2, 0.9e-6), (2.0, 1e-6)];
    assert!(matches!(follow(&twice), Err(Error::GrowsAgain { .. })));
    let apart = follow(&[(0.0, -1e-6), (1.0, -1e-7)]).expect("no contact");
    assert!(apart.states.iter().all(|at| at.state.load == 0.0));
    let loads = history.measured(Control::Load, &[(0.0, 0.0), (1.0, 1e-9)], None);
    refused(loads, "the loads are imposed");
}
