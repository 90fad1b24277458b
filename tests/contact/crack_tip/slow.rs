//! Contact lines in slow motion, at rest in every state.

use std::f64::consts::PI;

use acceptance::{assert_near, larger, relative};
use contact::{Control, Hysteresis};

use crate::contact::half_space;
use crate::crack_tip::{R, W, film, impose, integral, steps};
use crate::jkr::Jkr;

#[test]
fn a_constant_work_of_adhesion_is_jkr() {
    /// Measured: 7.9e-14.
    const EXACT: f64 = 5e-13;
    let contact = half_space();
    let jkr = Jkr::of(&contact, W);
    let pull_off = -1.5 * PI * W * R;
    let mut line = contact.line(W, 60e-6).expect("physical");
    let mut worst = 0.0;
    for load in steps(0.0, 5e-3, 50).chain(steps(5e-3, pull_off * (1.0 - 1e-9), 200)) {
        let state = impose(&mut line, Control::Load, load);
        // The radius has the root of rounding at pull-off, where it has a vertical tangent.
        let condition = (1.0 - load / pull_off).sqrt();
        let miss = relative(state.contact_radius, jkr.radii(load)[0]);
        worst = larger(worst, condition * miss);
        worst = larger(worst, relative(state.load, load));
    }
    println!("loads to radii: {worst:.1e}");
    assert!(worst <= EXACT, "{worst:e}");
    let apart = line.impose(Control::Load, pull_off * (1.0 + 1e-9));
    assert_eq!(apart.expect("finite"), None);
    assert_eq!(line.state(), None);
    let again = line.impose(Control::Load, 1.0);
    assert_eq!(again.expect("finite"), None, "for good");

    let apart = jkr.penetration(jkr.least_penetration());
    let mut line = contact.line(W, 60e-6).expect("physical");
    for penetration in steps(0.0, apart * (1.0 - 1e-9), 100) {
        let state = impose(&mut line, Control::Displacement, penetration);
        let expected = jkr.penetration(state.contact_radius);
        assert_near(penetration, expected, EXACT * apart.abs());
    }
    let last = line.state().expect("in contact").load / (PI * W * R);
    assert!((last + 5.0 / 6.0).abs() < 1e-4, "{last}");
    let parted = line.impose(Control::Displacement, apart * (1.0 + 1e-9));
    assert_eq!(parted.expect("finite"), None);
}

/// Rounding of the energy moves no line that is at rest.
#[test]
fn a_line_under_its_own_load_stays() {
    let contact = film(10e-6);
    for a in steps(65e-6, 90e-6, 50) {
        for control in [Control::Load, Control::Displacement] {
            let mut line = contact.line(W, a).expect("physical");
            let state = line.state().expect("in contact");
            let value = control.imposed(state.load, state.penetration);
            let stays = impose(&mut line, control, value).contact_radius;
            assert!(relative(stays, a) < 1e-9, "{a} {stays}");
        }
    }
}

#[test]
fn a_pinned_line_is_a_flat_punch_until_an_energy_is_reached() {
    let contact = half_space();
    let (advancing, receding) = (0.02, 0.07);
    let [grows, recedes] = [advancing, receding].map(|w| Jkr::of(&contact, w));
    let law = Hysteresis::new(advancing, receding).expect("in order");
    let mut line = contact.line(law, 60e-6).expect("physical");
    let grown = impose(&mut line, Control::Displacement, 8e-6);
    let a = grown.contact_radius;
    assert!(relative(grows.penetration(a), 8e-6) < 1e-14);
    let leaves = recedes.penetration(a);
    for penetration in steps(8e-6, leaves + 1e-15, 30) {
        let state = impose(&mut line, Control::Displacement, penetration);
        assert_eq!(state.contact_radius, a);
        let punch = grown.load + 2.0 * grows.e * a * (penetration - 8e-6);
        assert_near(state.load, punch, 1e-13 * grown.load);
    }
    let state = impose(&mut line, Control::Displacement, leaves - 1e-12);
    assert!(state.contact_radius < a);
    let penetration = recedes.penetration(state.contact_radius);
    assert!(relative(penetration, leaves - 1e-12) < 1e-13);
    // And pinned again on the way back.
    let back = impose(&mut line, Control::Displacement, leaves);
    assert_eq!(back.contact_radius, state.contact_radius);
}

/// On a closed cycle without jumps the work of the machine is `w_rec` times the uncovered area less
/// `w_adv` times the covered area.
#[test]
fn the_work_of_a_cycle_is_the_energy_left_at_the_line() {
    /// The error of the trapezium rule. Measured: 1.9e-7 at most.
    const CLOSE: f64 = 1e-6;
    let (advancing, receding) = (0.03, 0.05);
    let law = Hysteresis::new(advancing, receding).expect("in order");
    for contact in [half_space(), film(1e-6), film(100e-6)] {
        for (control, high, low) in [
            (Control::Displacement, 1e-5, 1e-6),
            (Control::Load, 2e-3, 1e-4),
            (Control::Spring { stiffness: 100.0 }, 2e-5, 1e-6),
        ] {
            let mut line = contact.line(law, 60e-6).expect("physical");
            impose(&mut line, control, high);
            let start = impose(&mut line, control, low);
            let way = steps(low, high, 4000).chain(steps(high, low, 4000));
            let mut cycle = vec![start];
            cycle.extend(way.map(|value| impose(&mut line, control, value)));
            let work = integral(cycle.iter().map(|state| (state.penetration, state.load)));
            let largest = cycle[4000].contact_radius;
            let area = PI * (largest.powi(2) - start.contact_radius.powi(2));
            let left = (receding - advancing) * area;
            println!("{control:?}: {work:e} {left:e} {:.1e}", work / left - 1.0);
            assert!(cycle[8000].contact_radius / start.contact_radius - 1.0 < 1e-12 && area > 0.0);
            assert!((work / left - 1.0).abs() <= CLOSE);
        }
    }
}

#[test]
fn slow_motion_does_not_depend_on_its_steps() {
    let law = Hysteresis::new(0.035, 0.045).expect("in order");
    for contact in [half_space(), film(1e-6), film(30e-6)] {
        for (control, turns) in [
            (Control::Load, [2e-3, 3e-4, 1e-3, -1.2e-4]),
            (Control::Displacement, [1e-5, 3e-6, 8e-6, -5e-7]),
            (
                Control::Spring { stiffness: 50.0 },
                [3e-5, 1e-5, 2e-5, -2e-6],
            ),
        ] {
            let mut once = contact.line(law, 60e-6).expect("physical");
            let mut often = once.clone();
            let mut from = 0.0;
            for turn in turns {
                let at_once = impose(&mut once, control, turn);
                let steps = steps(from, turn, 300);
                let in_steps = steps.map(|value| impose(&mut often, control, value)).last();
                let in_steps = in_steps.expect("steps").contact_radius;
                let apart = relative(at_once.contact_radius, in_steps);
                assert!(apart <= 1e-12, "{control:?} to {turn}: {apart:e}");
                from = turn;
            }
        }
    }
}

#[test]
fn films_are_pulled_off_where_they_should() {
    for contact in [1e-6, 10e-6, 30e-6, 100e-6].map(film) {
        for control in [Control::Load, Control::Displacement] {
            let end = contact.pull_off(W, control).expect("in range");
            let end = control.imposed(end.load, end.penetration);
            let mut line = contact.line(W, 60e-6).expect("physical");
            impose(&mut line, control, end * (1.0 - 1e-10));
            let beyond = line.impose(control, end * (1.0 + 1e-10));
            assert_eq!(beyond.expect("finite"), None, "{control:?}");
        }
    }
}
