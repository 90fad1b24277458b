//! Ramps of every speed: times rise, slow ramps are the slow motion, and nothing ends in a failure of
//! the integration.

use contact::{Contact, Control, Error, Hysteresis, RateDependent, State, TimedState};
use interp::{Probe, System, Table};

use acceptance::{Contacts, cases, larger, looked_up, paper_system, relative};

use super::{W, film, impose, rate_dependent};

/// Checks what holds for every ramp.
fn check(states: &[TimedState], a1: f64, duration: f64) {
    assert_eq!(states[0].time, 0.0);
    for pair in states.windows(2) {
        let rise = pair[1].time - pair[0].time;
        let moved = pair[1].state.contact_radius - pair[0].state.contact_radius;
        let allowed = 0.0..=0.010_000_1 * duration;
        assert!(allowed.contains(&rise), "{rise} of {duration}");
        assert!(moved.abs() <= 0.010_000_1 * a1, "{moved} of {a1}");
    }
}

/// The ramps of a film of 10 um whose times ran back by up to 2.7 % of the duration.
#[test]
fn times_rise_at_every_tolerance() {
    let contact = film(1e-5);
    let mut count = 0;
    for tolerance in [1e-3, 1e-4, 1e-6] {
        for v0 in [1e-9, 1e-8, 1e-7, 1e-6] {
            for n in [0.5, 0.6, 1.0, 2.0, 4.0] {
                for (control, to) in [
                    (Control::Load, 1e-3),
                    (Control::Displacement, 3e-6),
                    (Control::Displacement, -1e-6),
                ] {
                    for duration in [1.0, 100.0, 1e4] {
                        for energies in [[0.04, 0.04], [0.03, 0.05]] {
                            let slow = Hysteresis::new(energies[0], energies[1]).expect("in order");
                            let law = RateDependent::new(slow, v0, n).expect("physical");
                            let mut line = contact.line(law, 65e-6).expect("physical");
                            let states = line
                                .ramp(control, to, duration, tolerance)
                                .unwrap_or_else(|e| panic!("{v0} {n} {control:?} {duration}: {e}"));
                            check(&states, 65e-6, duration);
                            count += 1;
                        }
                    }
                }
            }
        }
    }
    assert_eq!(count, 3 * 4 * 5 * 3 * 3 * 2);
}

/// Random films, laws and ramps, over ten decades of the duration: the only failure is a contact that
/// leaves the table or the sphere.
#[test]
fn every_ramp_ends() {
    let mut contacts = Contacts::new(31);
    let mut log_uniform = |from: f64, to: f64| contacts.log_uniform(from, to);
    let table = Table::embedded();
    let (mut ended, mut outside) = (0, 0);
    for i in 0..cases(600) as usize {
        let radius = log_uniform(1e-5, 1e-2);
        let system = System {
            probe: Probe::Paraboloid { radius },
            sphere_modulus: log_uniform(1e5, 1e8),
            film_thickness: radius * log_uniform(1e-4, 1e-1),
            ..paper_system(1e-6)
        };
        let Ok(contact) = Contact::in_table(table, &system) else {
            continue;
        };
        let w = log_uniform(1e-3, 1.0);
        let least = if i % 2 == 0 {
            1.0
        } else {
            log_uniform(0.1, 1.0)
        };
        let advancing = w * least;
        let slow = Hysteresis::new(advancing, w).expect("in order");
        let law = RateDependent::new(slow, log_uniform(1e-10, 1e-3), log_uniform(0.15, 5.0));
        let Ok(at_rest) = contact.zero_load(w) else {
            continue;
        };
        let a1 = at_rest.contact_radius * log_uniform(0.7, 2.0);
        let Ok(mut line) = contact.line(law.expect("physical"), a1) else {
            continue;
        };
        let start = line.state().expect("in contact");
        let (control, unit) = match i % 3 {
            0 => (Control::Load, 6.0 * w * radius),
            1 => (Control::Displacement, a1 * a1 / radius),
            _ => {
                let stiffness = contact.stiffness(a1).expect("in range") * log_uniform(1e-2, 1e2);
                (Control::Spring { stiffness }, a1 * a1 / radius)
            }
        };
        let sign = if i % 4 < 2 { -1.0 } else { 1.0 };
        let to =
            control.imposed(start.load, start.penetration) + sign * unit * log_uniform(0.01, 10.0);
        let duration = log_uniform(1e-3, 1e7);
        let tolerance = [1e-2, 1e-3, 1e-4, 1e-6, 1e-8][i % 5];
        match line.ramp(control, to, duration, tolerance) {
            Ok(states) => {
                check(&states, a1, duration);
                let last = states.last().expect("a state");
                assert!(line.state().is_none() || last.time == duration);
                ended += 1;
            }
            Err(Error::OutsideRadii { .. }) => outside += 1,
            Err(error) => panic!("{i}: {error}"),
        }
    }
    println!("{ended} ended, {outside} left the table or the sphere");
    assert!(ended > 400, "{ended}");
}

/// However slow a ramp is, it is followed, and its end is that of the slow motion.
#[test]
fn the_slowest_ramps_are_the_slow_motion() {
    let contact = film(1e-5);
    let mut worst = 0.0;
    for duration in [1e6, 1e9, 1e12] {
        for n in [0.5, 1.0, 2.0, 5.0] {
            for (control, to) in [
                (Control::Load, 1e-3),
                (Control::Load, -5e-5),
                (Control::Displacement, 3e-6),
            ] {
                for tolerance in [1e-4, 1e-8] {
                    let line = contact.line(rate_dependent(1.0, n), 65e-6);
                    let mut line = line.expect("physical");
                    let mut slow = contact.line(W, 65e-6).expect("physical");
                    let states = line.ramp(control, to, duration, tolerance);
                    check(&states.expect("followed"), 65e-6, duration);
                    let found = line.state().expect("in contact");
                    let expected = impose(&mut slow, control, to);
                    // `(v/v0)^n` of a speed of 65 um in the duration, and the rounding of G.
                    let excess = (65e-6 / duration).powf(n);
                    let apart = relative(found.contact_radius, expected.contact_radius);
                    worst = larger(worst, apart / (excess + 1e-9));
                    let is_near = apart < 2.0 * excess + 1e-9;
                    assert!(is_near, "{duration} {n} {control:?}: {apart:e}");
                }
            }
        }
    }
    println!("{worst:.2} of the excess at most");
}

/// Making a line and restoring one refuse a flat punch in one sentence.
#[test]
fn a_flat_punch_has_no_line() {
    let system = System {
        probe: Probe::FlatPunch { radius: 1e-5 },
        ..paper_system(1e-6)
    };
    let contact = looked_up(&system);
    let made = contact.line(W, 1e-5).expect_err("a punch").to_string();
    let state = State {
        contact_radius: 1e-5,
        load: 0.0,
        penetration: 0.0,
    };
    for state in [Some(state), None] {
        let restored = contact.line_in(W, state).expect_err("a punch").to_string();
        assert_eq!(restored, made);
    }
    assert!(made.contains("contact line"), "{made}");
}
