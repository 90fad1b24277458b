//! Elements, which serve any history, beside the integrals and beside themselves.

use acceptance::{modified_power_law, on_half_space, rigid_sphere, solid, solved_contact};
use contact::{Control, Relaxation};
use interp::Probe;

use super::{CYCLES, PARABOLOID, half_space, power_law, solid_law, states};

/// Elements and the integrals agree for one turn, where the elements are asked for by a second turn
/// after the last time.
#[test]
fn elements_agree_with_the_integrals() {
    let contact = half_space(PARABOLOID);
    let laws = [
        solid_law(),
        power_law(0.1),
        power_law(0.2),
        power_law(0.5),
        power_law(0.8),
        modified_power_law(0.2, 0.5, 0.1),
        Relaxation::FractionalZener {
            relaxed: 0.2,
            exponent: 0.5,
            time: 0.1,
        },
    ];
    for law in laws {
        let relaxing = (&contact, &law);
        let once = [(0.0, 0.0), (1.0, 1e-2), (1.5, 8e-3), (2.5, 0.0)];
        let again = [once[0], once[1], once[2], once[3], (4.0, 1e-3)];
        // The first two after the turn are steps in which hardly an element is released.
        let times = [0.4, 1.0, 1.001, 1.002, 1.1, 1.3, 1.8, 2.2];
        let of = |program: &[(f64, f64)], tolerance: f64| {
            states(relaxing, Control::Displacement, program, &times, tolerance)
        };
        let (exact, own) = (of(&once, 1e-9), of(&again, 1e-5));
        let largest = exact[1].state;
        for (exact, own) in exact.iter().zip(&own) {
            let load = (own.state.load - exact.state.load).abs() / largest.load;
            let radius = (own.state.contact_radius - exact.state.contact_radius).abs()
                / largest.contact_radius;
            assert!(
                load < 1e-5 && radius < 1e-5,
                "{law:?} at {}: {load:.1e} {radius:.1e}",
                own.time
            );
        }
    }
}

/// Cuts each straight line of a program in two.
fn cut(program: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let mut cut = vec![program[0]];
    for pair in program.windows(2) {
        let [(t0, v0), (t1, v1)] = [pair[0], pair[1]];
        cut.extend([(t0 + 0.3 * (t1 - t0), v0 + 0.3 * (v1 - v0)), (t1, v1)]);
    }
    cut
}

/// An element that touches and is released within one straight line is no ring outside the contact: both programs are
/// answered, and the same.
#[test]
fn an_element_that_touches_within_a_step_is_no_ring() {
    let system = rigid_sphere(1e-5, [1e3, 0.5], 5e-6, [f64::INFINITY, 0.25]);
    let contact = solved_contact(&system, [1e-4, 8.0], 1e-8);
    let law = power_law(0.8712366898122368);
    let relaxing = (&contact, &law);
    let program = [
        (0.0, 0.0),
        (0.07753188060455914, -3.302387599303665e-07),
        (0.13780841206216754, 1.9889986174639647e-07),
        (1.1639676597099524, -3.618665514663257e-07),
        (1.2558288227859544, 4.4762828830413774e-07),
        (1.2712708215669881, 4.2457568664236546e-07),
        (2.62537464831824, -4.518779770727694e-07),
        (2.895347899462901, 7.111341715619417e-07),
        (2.913901690908775, 6.801921414092479e-07),
    ];
    let times: Vec<f64> = program[1..].iter().map(|(time, _)| *time).collect();
    let of =
        |program: &[(f64, f64)]| states(relaxing, Control::Displacement, program, &times, 1e-2);
    let (whole, parts) = (of(&program), of(&cut(&program)));
    let largest = whole.iter().map(|at| at.state.load).fold(0.0, f64::max);
    assert!(largest > 0.0);
    for (whole, parts) in whole.iter().zip(&parts) {
        let error = (whole.state.load - parts.state.load).abs() / largest;
        assert!(error < 1e-4, "at {}: {error:.1e}", whole.time);
    }
}

/// A history cut in two by a point on its straight lines is the same history.
#[test]
fn a_history_cut_in_two() {
    let contact = half_space(PARABOLOID);
    let solid = solid_law();
    let times = [0.5, 1.0, 1.2, 1.7, 2.0, 2.3];
    let (once, twice) = (&CYCLES[..2], &CYCLES[..]);
    for (law, program, tolerance, allowed) in [
        (&solid, once, 1e-9, 1e-9),
        (&solid, twice, 1e-5, 2e-5),
        (&power_law(0.5), twice, 1e-5, 2e-5),
        (&power_law(0.7), twice, 1e-5, 2e-5),
    ] {
        let (relaxing, cut) = ((&contact, law), cut(program));
        let of = |program: &[(f64, f64)]| {
            states(relaxing, Control::Displacement, program, &times, tolerance)
        };
        let (whole, cut) = (of(program), of(&cut));
        let largest = whole.iter().map(|at| at.state.load).fold(0.0, f64::max);
        for (whole, cut) in whole.iter().zip(&cut) {
            let error = (whole.state.load - cut.state.load).abs() / largest;
            assert!(error < allowed, "at {}: {error:.1e}", whole.time);
        }
    }
}

/// Other units of length, force and time change nothing.
#[test]
fn units() {
    let [length, pressure, time] = [3e-6, 7e4, 2e-3];
    let of = |l: f64, p: f64, s: f64, program: &[(f64, f64)], control: Control| {
        let contact = on_half_space(Probe::Paraboloid { radius: l }, solid(0.75 * p, 0.5));
        let law = modified_power_law(0.1, 0.4, 0.3 * s);
        let value = |value: f64| {
            if control == Control::Load {
                value * l * l * p
            } else {
                value * l
            }
        };
        let program: Vec<_> = program.iter().map(|&(t, v)| (t * s, value(v))).collect();
        let course = contact
            .history(&law)
            .expect("a law")
            .run(control, &program, None);
        course.expect("a course").states
    };
    let up = [(0.0, 0.0), (1.0, 1e-3), (2.0, 1e-3)];
    let all = [
        (&CYCLES[..], Control::Displacement),
        (&up[..], Control::Load),
        (&up[..2], Control::Displacement),
    ];
    for (program, control) in all {
        let (own, other) = (
            of(1.0, 1.0, 1.0, program, control),
            of(length, pressure, time, program, control),
        );
        for (own, other) in own.iter().zip(&other) {
            let [own, other] = [own, other].map(|one| &one.state);
            for (own, other) in [
                (own.load, other.load / (length * length * pressure)),
                (own.contact_radius, other.contact_radius / length),
                (own.penetration, other.penetration / length),
            ] {
                let near = 1e-11 * own.abs() + 1e-16;
                assert!((own - other).abs() <= near, "{own} {other}");
            }
        }
    }
}
