//! Contacts in time against independently computed series, and against Lee and Radok's and Ting's
//! closed forms on a half-space.

mod elements;
mod errors;
mod oscillation;
mod refused;

use std::f64::consts::PI;

use acceptance::{Case, Data, larger, on_half_space, prony, rigid_probe, solid, solved_contact};
use contact::{Contact, Control, Course, Hysteresis, Phase, Relaxation, State, TimedContact};
use interp::{Probe, System};

/// Returns a law as the file writes it.
fn law(text: &str) -> Relaxation {
    let words: Vec<&str> = text.split(' ').collect();
    let number = |text: &str| text.parse().expect("a number");
    let pair = |text: &str| {
        let (first, second) = text.split_once('@').expect("two numbers");
        [number(first), number(second)]
    };
    match words[0] {
        "prony" => {
            let terms = words[2..].iter().map(|term| pair(term)).collect();
            prony(number(words[1]), terms)
        }
        "power" => {
            let [exponent, time] = pair(words[1]);
            Relaxation::PowerLaw { exponent, time }
        }
        other => panic!("{other}"),
    }
}

/// Returns what is imposed and the points of a program. A penetration that ends at 0 goes on to
/// fall, as the file does.
fn program(text: &str, last: f64) -> (Control, Vec<(f64, f64)>) {
    let (imposed, points) = text.split_once(' ').expect("a program");
    let number = |text: &str| text.parse::<f64>().expect("a number");
    let mut points: Vec<(f64, f64)> = points
        .split(' ')
        .map(|point| {
            let (time, value) = point.split_once(':').expect("a point");
            (number(time), number(value))
        })
        .collect();
    let [(t0, v0), (t1, v1)] = [points[points.len() - 2], points[points.len() - 1]];
    if v1 == 0.0 && last > t1 {
        points.push((last, v1 + (v1 - v0) / (t1 - t0) * (last - t1)));
    }
    (
        if imposed == "load" {
            Control::Load
        } else {
            Control::Displacement
        },
        points,
    )
}

/// Returns the film of a row on a rigid base under a rigid probe.
fn system(case: &Case<'_>) -> System {
    let size = case.get("size");
    let probe = match case.text("shape") {
        "cone" => Probe::Cone {
            half_angle: size.to_radians(),
        },
        _ => Probe::Paraboloid { radius: size },
    };
    rigid_probe(
        probe,
        solid(case.get("reference_modulus"), case.get("poisson_ratio")),
        case.get("film_thickness"),
        solid(f64::INFINITY, 0.25),
    )
}

/// Follows a protocol on a curve of direct solves.
fn follow(rows: &[Case<'_>], tolerance: Option<f64>) -> Course {
    let first = &rows[0];
    let system = system(first);
    let contact = solved_contact(&system, [1e-4, 8.0], 1e-10);
    let times: Vec<f64> = rows.iter().map(|row| row.get("time")).collect();
    let (control, program) = program(first.text("program"), times[times.len() - 1]);
    let mut history = contact.history(&law(first.text("law"))).expect("a law");
    let work = first.get("receding_work");
    if work > 0.0 {
        let law = Hysteresis::new(0.0, work).expect("a law");
        history = history.receding(law).expect("no growing adhesion");
    }
    let course = history.at(control, &program, &times, tolerance);
    course.expect("a course")
}

/// Returns the largest errors of loads, radii and penetrations, each over the largest of the column.
fn errors(rows: &[Case<'_>], course: &Course) -> [f64; 3] {
    let of = |column: &str, own: fn(&State) -> f64| {
        let found = course.states.iter().map(|at| own(&at.state));
        let pairs = rows.iter().map(|row| row.get(column)).zip(found);
        let largest = pairs
            .clone()
            .map(|(given, _)| given.abs())
            .fold(0.0, larger);
        pairs
            .map(|(given, found)| (found - given).abs())
            .fold(0.0, larger)
            / largest
    };
    [
        of("load", |state| state.load),
        of("contact_radius", |state| state.contact_radius),
        of("penetration", |state| state.penetration),
    ]
}

/// The integrals hold 1e-8 and elements 1e-5, the error stated is not exceeded, and a contact has
/// separated exactly where the series says so.
#[test]
fn independent_series() {
    let data = Data::read("viscoelastic");
    let cases: Vec<Case<'_>> = data.cases().collect();
    for rows in cases.chunk_by(|one, next| one.text("protocol") == next.text("protocol")) {
        let name = rows[0].text("protocol");
        for tolerance in [None, Some(1e-4), Some(1e-6)] {
            let course = follow(rows, tolerance);
            let errors = errors(rows, &course);
            let allowed = match tolerance {
                Some(tolerance) => tolerance,
                None if name.starts_with("two-cycles") => 1e-5,
                None => 1e-8,
            };
            println!("{name}: {errors:?} {:.1e} {allowed:.0e}", course.error);
            for error in errors {
                assert!(error <= allowed, "{name}: {errors:?}");
                // The curve has an error of its own.
                assert!(
                    error <= course.error + 1e-10,
                    "{name}: {errors:?}, stated {}",
                    course.error
                );
            }
            for (row, at) in rows.iter().zip(&course.states) {
                let separated = row.get("contact_radius") == 0.0;
                assert_eq!(
                    separated,
                    at.phase == Phase::Separated,
                    "{name} at {}",
                    at.time
                );
            }
        }
    }
}

/// A solid that relaxes to 0.3 of its modulus in 0.6 s.
fn solid_law() -> Relaxation {
    prony(0.3, vec![[0.7, 0.6]])
}

/// A rigid probe on a half-space with `E* = 1`.
fn half_space(probe: Probe) -> Contact {
    on_half_space(probe, solid(0.75, 0.5))
}

const PARABOLOID: Probe = Probe::Paraboloid { radius: 1.0 };

/// Follows a program by a law, and returns the states at `times`.
fn states(
    (contact, law): (&Contact, &Relaxation),
    control: Control,
    program: &[(f64, f64)],
    times: &[f64],
    tolerance: f64,
) -> Vec<TimedContact> {
    let history = contact.history(law).expect("a law");
    let course = history.at(control, program, times, Some(tolerance));
    course.expect("a course").states
}

/// Returns the integral of a smooth function from 0 to `end`, to rounding, for factors
/// `x^p (end-x)^q` at its ends: the double exponential rule.
fn integral(f: impl Fn(f64, f64) -> f64, end: f64) -> f64 {
    let h = 1.0 / 64.0;
    let mut sum = 0.0;
    for i in -400..=400 {
        let u = f64::from(i) * h;
        let q = (-PI * u.sinh()).exp();
        let (x, rest) = (end / (1.0 + q), end * q / (1.0 + q));
        let weight = h * PI * u.cosh() * x * rest / end;
        if weight > 0.0 && weight.is_finite() {
            sum += weight * f(x, rest);
        }
    }
    sum
}

/// Ting's contact under a power law, equal and unequal speeds: `t1 = t - q (t - t_m)` with
/// `q = (1 + v2/v1)^(1/(1-alpha))`, the load is an incomplete Beta function, and the contact
/// separates at `t_m q/(q-1)`.
#[test]
fn approach_and_retract_at_constant_speeds() {
    let cone = Probe::Cone { half_angle: 1.2 };
    for (probe, power) in [(PARABOLOID, 1.5), (cone, 2.0)] {
        let contact = half_space(probe);
        let unit = contact
            .equilibria(0.0, Control::Displacement)
            .and_then(|all| all.loading(1e-2));
        let unit = unit.expect("a state").load / 1e-2_f64.powf(power);
        for (alpha, ratio) in [(0.2, 1.0), (0.5, 3.0), (0.1, 0.25), (0.8, 1.0)] {
            let law = Relaxation::PowerLaw {
                exponent: alpha,
                time: 0.5,
            };
            let relaxing = (&contact, &law);
            let q = (1.0_f64 + ratio).powf(1.0 / (1.0 - alpha));
            let separation = q / (q - 1.0);
            let (speed, end) = (1e-2, 1.0 + 1.0 / ratio);
            let program = [(0.0, 0.0), (1.0, speed), (end, 0.0)];
            let mut times = vec![0.2, 0.7, 1.0];
            times.extend([0.01, 0.1, 0.5, 0.9, 0.99].map(|x| 1.0 + x * (separation - 1.0)));
            times.push(separation + 1e-6);
            times.retain(|&time| time <= end);
            let states = states(relaxing, Control::Displacement, &program, &times, 1e-9);
            let exact = |t: f64| {
                let t1 = if t <= 1.0 { t } else { t - q * (t - 1.0) };
                if t1 <= 0.0 {
                    return 0.0;
                }
                let f = |x: f64, rest: f64| {
                    ((t - t1 + rest) / 0.5).powf(-alpha)
                        * power
                        * speed.powf(power)
                        * x.powf(power - 1.0)
                };
                unit * integral(f, t1)
            };
            let largest = exact(1.0);
            for at in &states {
                let error = (at.state.load - exact(at.time)).abs() / largest;
                assert!(error < 2e-9, "{alpha} {ratio} at {}: {error:.1e}", at.time);
                assert_eq!(
                    at.phase == Phase::Separated,
                    at.time > separation,
                    "{alpha} {ratio} at {}",
                    at.time
                );
            }
        }
    }
}

/// A ramp and a hold under the standard linear solid, and under a law that is singular at once, whose parts between the
/// times are an impulse; by quadrature of Lee and Radok's integral.
#[test]
fn a_hold_relaxes_by_the_law() {
    let contact = half_space(PARABOLOID);
    let program = [(0.0, 0.0), (1.0, 1e-2)];
    let times = [0.3, 1.0, 1.5, 4.0, 50.0];
    for law in [solid_law(), power_law(0.9)] {
        let relaxing = (&contact, &law);
        for at in &states(relaxing, Control::Displacement, &program, &times, 1e-9) {
            let t1 = at.time.min(1.0);
            let f = |x: f64, rest: f64| {
                law.modulus(at.time - t1 + rest).expect("a time") * 2.0 * (1e-2 * x).sqrt() * 1e-2
            };
            let exact = integral(f, t1);
            let error = (at.state.load / exact - 1.0).abs();
            assert!(error < 1e-8, "at {}: {error:.1e}", at.time);
            assert!((at.state.contact_radius - (1e-2 * t1).sqrt()).abs() < 1e-11);
        }
    }
}

/// After a fast retract the surface recovers and meets the probe again, or the contact grows again. In the end the load is
/// the relaxed one of an elastic contact.
#[test]
fn a_surface_that_recovers_meets_the_probe_again() {
    let (contact, law) = (half_space(PARABOLOID), solid_law());
    for (held, phase) in [(8e-3, Phase::Receding), (3e-3, Phase::Separated)] {
        let program = [(0.0, 0.0), (1.0, 1e-2), (1.01, held)];
        let times = [1.01, 60.0];
        let relaxing = (&contact, &law);
        let states = states(relaxing, Control::Displacement, &program, &times, 1e-4);
        assert_eq!(states[0].phase, phase, "{held}");
        let exact = State {
            contact_radius: held.sqrt(),
            load: 0.3 * 4.0 / 3.0 * held.powf(1.5),
            penetration: held,
        };
        let found = &states[1].state;
        for (found, exact) in [
            (found.load, exact.load),
            (found.contact_radius, exact.contact_radius),
        ] {
            assert!((found / exact - 1.0).abs() < 1e-3, "{held}: {found:?}");
        }
    }
}

/// A load that grows and is held: `(4/3) a^3 = int J dF` on a half-space.
#[test]
fn creep_under_a_load() {
    let contact = half_space(PARABOLOID);
    let laws = [prony(0.0, vec![[0.6, 0.1], [0.4, 3.0]]), power_law(0.3)];
    for law in laws {
        let program = [(0.0, 0.0), (0.5, 1e-4)];
        let times = [0.1, 0.5, 0.6, 3.0, 20.0];
        for at in &states((&contact, &law), Control::Load, &program, &times, 1e-10) {
            let t1 = at.time.min(0.5);
            let f = |_: f64, rest: f64| law.creep(at.time - t1 + rest).expect("a time") * 2e-4;
            let a = (0.75 * integral(f, t1)).cbrt();
            let error = (at.state.contact_radius / a - 1.0).abs();
            assert!(error < 1e-9, "{law:?} at {}: {error:.1e}", at.time);
            assert!((at.state.penetration / (a * a) - 1.0).abs() < 2e-9);
        }
    }
}

const CYCLES: [(f64, f64); 5] = [
    (0.0, 0.0),
    (1.0, 1e-2),
    (1.4, 6e-3),
    (2.0, 1.1e-2),
    (3.0, 0.0),
];

/// A power law with its modulus at 1 s.
const fn power_law(exponent: f64) -> Relaxation {
    Relaxation::PowerLaw {
        exponent,
        time: 1.0,
    }
}

/// The cantilever's balance holds, and a stiff one imposes the penetration.
#[test]
fn heights_of_a_cantilever() {
    let contact = half_space(PARABOLOID);
    let law = solid_law();
    let program = [(0.0, -1e-3), (1.0, 1e-2), (2.0, 1e-2), (3.0, -5e-3)];
    let times = [0.05, 0.5, 1.0, 1.7, 2.2, 2.9];
    let value = |t: f64| {
        let end = program
            .iter()
            .position(|point| point.0 >= t)
            .expect("a point");
        let [(t0, v0), (t1, v1)] = [program[end - 1], program[end]];
        v0 + (v1 - v0) * (t - t0) / (t1 - t0)
    };
    let of =
        |control, tolerance: f64| states((&contact, &law), control, &program, &times, tolerance);
    let soft = of(Control::Spring { stiffness: 0.1 }, 1e-5);
    for at in &soft {
        let balance = at.state.penetration + at.state.load / 0.1 - value(at.time);
        assert!(balance.abs() < 2e-7, "{at:?}: {balance:e}");
    }
    // In a hold of the base the penetration goes on.
    assert!(soft[3].state.penetration > 1.01 * soft[2].state.penetration);
    let stiff = of(Control::Spring { stiffness: 1e7 }, 1e-5);
    let fixed = of(Control::Displacement, 1e-9);
    let largest = fixed[2].state.load;
    for (stiff, fixed) in stiff.iter().zip(&fixed) {
        assert!(
            (stiff.state.load - fixed.state.load).abs() < 1e-5 * largest,
            "{stiff:?} {fixed:?}"
        );
    }
}

/// A load that falls again: the contact recedes, and separates at no load with a dent.
#[test]
fn a_load_that_falls() {
    let contact = half_space(PARABOLOID);
    let law = solid_law();
    let relaxing = (&contact, &law);
    let loads = [(0.0, 0.0), (1.0, 1e-3), (2.0, 0.0)];
    let times = [0.5, 1.0, 1.3, 1.6, 1.9];
    let own = states(relaxing, Control::Load, &loads, &times, 1e-5);
    // The same penetrations, imposed, need the same loads.
    let fine: Vec<f64> = (0..=380).map(|i| 0.005 * f64::from(i)).collect();
    let path: Vec<_> = states(relaxing, Control::Load, &loads, &fine, 1e-5)
        .iter()
        .map(|at| (at.time, at.state.penetration))
        .collect();
    let back = states(relaxing, Control::Displacement, &path, &times, 1e-4);
    for (own, back) in own.iter().zip(&back) {
        assert!(
            (own.state.load - back.state.load).abs() < 1e-4 * 1e-3,
            "{own:?} {back:?}"
        );
    }
    // No tension is borne: the surfaces part where the load is 0.
    let pulled = [loads[0], loads[1], (3.0, -1e-3)];
    let apart = states(relaxing, Control::Load, &pulled, &[2.5], 1e-5)[0].state;
    assert_eq!((apart.load, apart.contact_radius), (0.0, 0.0));
}

#[test]
fn a_contact_is_separated_where_it_has_no_radius_and_rests_where_it_is_held() {
    let contact = half_space(PARABOLOID);
    let law = power_law(0.2);
    let program = [(0.0, -1e-3), (1.0, 1e-3), (2.0, 1e-3), (3.0, -1e-3)];
    let times: Vec<f64> = (0..=12).map(|i| 0.25 * f64::from(i)).collect();
    let course = states(
        (&contact, &law),
        Control::Displacement,
        &program,
        &times,
        1e-6,
    );
    for at in course {
        let is_apart = at.state.contact_radius == 0.0;
        assert_eq!(at.phase == Phase::Separated, is_apart, "{at:?}");
        let is_held = at.time > 1.0 && at.time <= 2.0;
        assert_eq!(at.phase == Phase::Resting, is_held, "{at:?}");
    }
}
