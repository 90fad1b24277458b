//! What is refused of contacts in time, and what is answered at the ends of the range.

use acceptance::{
    Refused, assert_matches, assert_names, larger, modified_power_law, rigid_sphere, solid,
    solved_contact, system_of,
};
use contact::{Control, Error, Hysteresis, RateDependent, Relaxation, TimedContact};
use interp::{Probe, System};

use super::{CYCLES, PARABOLOID, half_space, solid_law};

/// The bound for bodies that do not relax, on both sides of the largest that is accepted.
#[test]
fn bodies_that_do_not_relax() {
    let of = |substrate: f64| rigid_sphere(1e-5, [1e3, 0.5], 1e-5, [substrate, 0.5]);
    let contact = |substrate: f64| {
        let system = of(substrate);
        solved_contact(&system, [1e-4, 2.0], 1e-9)
    };
    let rigid = contact(f64::INFINITY);
    let law = solid_law();
    let program = [(0.0, 0.0), (1.0, 1e-6), (2.0, 0.0)];
    let run = |substrate: f64| {
        let own = contact(substrate);
        let history = own.history(&law).expect("a law").beside(&rigid);
        history
            .run(Control::Displacement, &program, None)
            .map(|course| course.unlike_bodies)
    };
    let [soft, stiff] = [1e5, 1e7].map(|substrate| run(substrate).expect("a course"));
    // The rise of the load is inversely proportional to the modulus of the base.
    assert!(
        soft > 1e-4 && soft < 2e-2 && (soft / stiff / 100.0 - 1.0).abs() < 0.05,
        "{soft} {stiff}"
    );
    let refused = run(3e3).expect_err("too soft a base");
    assert_matches!(refused, Error::UnlikeBodies { .. });
    assert_names(&refused.to_string(), &["do not relax", "2e-2", "rigid"]);
    let own = contact(1e5);
    for other in [
        &own,
        &half_space(PARABOLOID),
        &solved_contact(
            &System {
                film_thickness: 2e-5,
                ..of(f64::INFINITY)
            },
            [1e-4, 1.0],
            1e-9,
        ),
    ] {
        let history = own.history(&law).expect("a law").beside(other);
        let refused = history.run(Control::Displacement, &program, None);
        let refused = refused.expect_err("other bodies").to_string();
        assert_names(&refused, &["same film, thickness and probe", "rigid base"]);
    }
}

/// A film so thick that it is a half-space, under an elastic sphere: all bodies together relax by the law of their summed
/// compliance, which is that of a standard linear solid again, and the same program with this law is exact. Relaxations
/// that are over before the first step, and in the midst of the program, leave errors within the bound, or are refused.
/// Measured: up to 0.99 of the bound.
#[test]
fn the_bound_for_an_elastic_sphere_holds() {
    let of = |sphere_modulus: f64, young: f64| {
        let system = system_of(
            Probe::Paraboloid { radius: 1e-5 },
            sphere_modulus,
            solid(young, 0.5),
            1e-3,
            solid(f64::INFINITY, 0.5),
        );
        solved_contact(&system, [1e-6, 1e-2], 1e-9)
    };
    let film = 1e3;
    let rigid = of(f64::INFINITY, film);
    let softnesses =
        [1e-3, 1e-2, 0.1, 1.0].map(|softness| (softness, of(film / 0.75 / softness, film)));
    let held = (
        Control::Displacement,
        [(0.0, 0.0), (1.0, 1e-7), (3.0, 1e-7)],
    );
    let creep = (Control::Load, [(0.0, 0.0), (1e-3, 1e-10), (3.0, 1e-10)]);
    let falls = (Control::Load, [(0.0, 0.0), (1.0, 1e-10), (2.0, 1e-12)]);
    let (mut answered, mut refused, mut closest) = (0, 0, 0.0);
    for relaxed in [0.1, 0.6, 0.95] {
        for time in [1e-6, 1e-3, 0.3, 100.0] {
            for (softness, own) in &softnesses {
                let solid_of = |relaxed: f64, time: f64| Relaxation::Prony {
                    relaxed,
                    terms: vec![[1.0 - relaxed, time]],
                };
                let law = solid_of(relaxed, time);
                let left = (1.0 + softness) / (1.0 / relaxed + softness);
                let summed = solid_of(left, time / relaxed * left);
                for (control, program) in [held, creep, falls] {
                    let part = |i: i32| f64::from(i) / 20.0 * program[2].0;
                    let mut times: Vec<f64> = (0..=20).map(part).chain([program[1].0]).collect();
                    times.sort_by(f64::total_cmp);
                    let history = own.history(&law).expect("a law").beside(&rigid);
                    let course = match history.at(control, &program, &times, None) {
                        Ok(course) => course,
                        Err(Error::UnlikeBodies { .. }) => {
                            refused += 1;
                            continue;
                        }
                        Err(error) => panic!("{error}"),
                    };
                    let exact = own.history(&summed).expect("a law");
                    let exact = exact.at(control, &program, &times, None).expect("a course");
                    let of_state = |at: &TimedContact| match control {
                        Control::Load => at.state.penetration,
                        _ => at.state.load,
                    };
                    let largest = course.states.iter().map(of_state).fold(0.0, f64::max);
                    let pairs = course.states.iter().zip(&exact.states);
                    let error =
                        pairs.map(|(own, exact)| (of_state(own) - of_state(exact)).abs() / largest);
                    let error = error.fold(0.0, larger);
                    let bound = course.unlike_bodies;
                    // The bound is that of the program, whatever times are asked for.
                    let end = &times[times.len() - 1..];
                    let at_end = history.at(control, &program, end, None);
                    let of_end = at_end.expect("a course").unlike_bodies;
                    assert!(of_end >= 0.9 * bound, "{of_end:.2e}, {bound:.2e}");
                    // The film is no half-space, and elements have errors of their own.
                    assert!(
                        error <= 1.02 * bound + 5e-5,
                        "{relaxed} {time} {softness} {control:?}: {error:.2e}, {bound:.2e}"
                    );
                    if bound > 1e-3 {
                        closest = larger(closest, error / bound);
                    }
                    answered += 1;
                }
            }
        }
    }
    println!("{answered} answered, {refused} refused, up to {closest:.2} of the bound");
    assert!(answered >= 45 && refused >= 45, "{answered} {refused}");
    assert!(closest > 0.8, "{closest}");
}

/// Times count from the first point: a program at 1.7e9 s (a clock that counts from 1970) is that at 0.
#[test]
fn a_history_does_not_depend_on_when_it_begins() {
    let contact = half_space(PARABOLOID);
    let law = solid_law();
    let history = contact.history(&law).expect("a law");
    let of = |origin: f64| {
        let program = [(origin, 0.0), (origin + 0.5, 1e-6), (origin + 2.0, 0.0)];
        let times = [0.25, 0.5, 1.0].map(|time| origin + time);
        let course = history
            .at(Control::Displacement, &program, &times, None)
            .expect("a course");
        course
            .states
            .into_iter()
            .map(|at| (at.time - origin, at.state))
            .collect::<Vec<_>>()
    };
    assert_eq!(of(0.0), of(1.7e9));
    let close = [(-1e10, 0.0), (0.0, 1e-6), (1e-9, 0.0)];
    history
        .at(Control::Displacement, &close, &[], None)
        .refused("point 3; close together");
}

/// Each mistake has an error that says what to do.
#[test]
fn mistakes() {
    let contact = half_space(PARABOLOID);
    let law = solid_law();
    let history = contact.history(&law).expect("a law");
    let up = [(0.0, 0.0), (1.0, 1e-3)];
    let depth = Control::Displacement;
    let of = |program: &[(f64, f64)]| history.at(depth, program, &[], None);
    of(&up[..1]).refused("two points; 1");
    of(&[up[1], up[0]]).refused("point 2; at 0.0 s; before it at 1.0 s; times; rise");
    of(&[up[0], (0.0, 1e-3)]).refused("point 2; close together");
    of(&[up[0], (f64::NAN, 1e-3)]).refused("point 2; finite");
    of(&[(0.0, 1e-4), up[1]]).refused("begins in contact; 0.0001; not known");
    let at = |time: f64, tolerance| history.at(depth, &up, &[time], tolerance);
    at(-1.0, None).refused("-1.0; begins at 0.0");
    at(f64::INFINITY, None).refused("inf; finite");
    at(0.5, Some(1e-12)).refused("1e-12; 1e-10");
    let spring = Control::Spring { stiffness: 0.0 };
    history.at(spring, &up, &[0.5], None).refused("stiffness");
    let power = |exponent, time| Relaxation::PowerLaw { exponent, time };
    let prony = |relaxed, term| Relaxation::Prony {
        relaxed,
        terms: vec![term],
    };
    let (relaxed, time) = (0.1, 1.0);
    for (law, name) in [
        (power(1.0, 1.0), "below 1"),
        (power(0.5, 0.0), "relaxation time"),
        (prony(0.3, [0.7 - 1e-8, 1.0]), "sum"),
        (prony(-0.1, [1.1, 1.0]), "relaxed fraction"),
        (modified_power_law(relaxed, f64::NAN, time), "exponent"),
        (
            Relaxation::FractionalZener {
                relaxed,
                exponent: 1e-4,
                time,
            },
            "0.001",
        ),
        (
            Relaxation::FractionalZener {
                relaxed: 1.0,
                exponent: 0.5,
                time,
            },
            "relaxed fraction; elastic",
        ),
    ] {
        contact.history(&law).refused(name);
    }
    // Two times with one reciprocal make one term.
    let twins = Relaxation::Prony {
        relaxed: 0.2,
        terms: vec![
            [0.4, 1.999_999_999_999_999_6],
            [0.4, 1.999_999_999_999_999_8],
        ],
    };
    let falls = [(0.0, 0.0), (1.0, 1e-9), (2.0, 0.0)];
    let of_twins = contact.history(&twins).expect("a law");
    assert!(
        of_twins
            .run(Control::Load, &falls, None)
            .expect("a course")
            .error
            < 1e-3
    );
    let punch = half_space(Probe::FlatPunch { radius: 1.0 });
    punch.history(&law).refused("punch");
    let growing = contact.history(&law).expect("a law").receding(1e-4);
    growing.refused("0.0001; Hysteresis; no law");
    let slow = Hysteresis::new(0.0, 1e-4).expect("a law");
    let rate = RateDependent::new(slow, 1e-6, 0.6).expect("a law");
    let history = contact.history(&law).expect("a law");
    history.receding(rate).refused("speed; Hysteresis");
    let history = contact.history(&law).expect("a law");
    history
        .at(depth, &CYCLES, &[0.5, 0.2], None)
        .refused("time 2; 0.2 s; 0.5 s; ascending");
    let adhesive = contact.history(&law).expect("a law");
    let adhesive = adhesive
        .receding(Hysteresis::new(0.0, 1e-6).expect("a law"))
        .expect("receding alone");
    for (control, program) in [(Control::Load, &up[..]), (depth, &CYCLES[..])] {
        let course = adhesive.at(control, program, &[0.5], None);
        course.refused("adhesion; grows, may be held, and falls");
    }
}

/// Two instants that nothing tells apart ask for no more exponentials than others do.
#[test]
fn instants_at_any_distance_are_answered() {
    let contact = half_space(Probe::Paraboloid { radius: 1.0 });
    let law = Relaxation::FractionalZener {
        relaxed: 0.1,
        exponent: 0.5,
        time: 1.0,
    };
    let history = contact.history(&law).expect("a law");
    let program = [(0.0, 0.0), (1.0, 1e-3), (1.0_f64.next_up(), 1e-3)];
    for first in [1e-49, 1e-300, 5e-324] {
        let found = history.at(Control::Displacement, &program, &[first, 1.0], Some(1e-2));
        match found {
            Ok(course) => assert_eq!(course.states.len(), 2),
            Err(error) => assert_names(&error.to_string(), &["time"]),
        }
    }
}
