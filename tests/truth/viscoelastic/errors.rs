//! Stated errors of random histories beside the same histories to a smaller tolerance, by the same method.
//!
//! This shows what a tolerance leaves out, not what the method does: series by other programs and closed forms do that.

use contact::{Contact, Control, Course, Relaxation};
use interp::{Probe, System};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

use super::{PARABOLOID, half_space, solid_law};
use acceptance::{modified_power_law, prony, rigid_probe, rounded_cone, solid, solved_contact};

fn spread(random: &mut Pcg64Mcg, from: f64, to: f64) -> f64 {
    10f64.powf(random.random_range(from..to))
}

fn law(random: &mut Pcg64Mcg) -> Relaxation {
    let relaxed = match random.random_range(0..3) {
        0 => 0.0,
        1 => spread(random, -4.0, 0.0),
        _ => random.random_range(0.0..1.0),
    };
    let time = spread(random, -4.0, 3.0);
    match random.random_range(0..4) {
        0 => {
            let part = random.random_range(0.05..0.95);
            let other = spread(random, -4.0, 3.0);
            let rest = 1.0 - relaxed;
            prony(
                relaxed,
                vec![[part * rest, time], [(1.0 - part) * rest, other]],
            )
        }
        1 => Relaxation::PowerLaw {
            exponent: random.random_range(0.01..0.9),
            time,
        },
        2 => modified_power_law(relaxed, random.random_range(0.01..0.95), time),
        _ => Relaxation::FractionalZener {
            relaxed,
            exponent: random.random_range(0.05..0.95),
            time,
        },
    }
}

/// Returns the largest difference of loads, radii and penetrations, each in parts of the largest one. Panics if one of them
/// is not finite.
fn difference(own: &Course, exact: &Course) -> f64 {
    let of = |of: fn(&contact::State) -> f64| {
        let states = own.states.iter().chain(&exact.states);
        assert!(
            states.clone().all(|at| of(&at.state).is_finite()),
            "{own:?}"
        );
        let largest = exact.states.iter().map(|at| of(&at.state).abs());
        let largest = largest.fold(f64::MIN_POSITIVE, f64::max);
        let pairs = own.states.iter().zip(&exact.states);
        let differences = pairs.map(|(own, exact)| (of(&own.state) - of(&exact.state)).abs());
        differences.fold(0.0, f64::max) / largest
    };
    of(|state| state.load)
        .max(of(|state| state.contact_radius))
        .max(of(|state| state.penetration))
}

/// A kind of random programs, and the tolerances to which they are followed.
struct Programs {
    count: u64,
    /// `None`: a spring a third to 30 times as stiff as the contact.
    control: Option<Control>,
    /// Whether the value falls and grows again.
    again: bool,
    /// The powers of 10 between which the tolerances are.
    powers: [f64; 2],
    /// The tolerance of the reference over the one compared with it.
    finer: f64,
    /// The part of the histories whose stated errors may be too small.
    too_small: f64,
}

fn film() -> System {
    let rigid = solid(f64::INFINITY, 0.0);
    rigid_probe(PARABOLOID, solid(1.0, 0.45), 0.02, rigid)
}

fn contacts() -> Vec<Contact> {
    let tip = Probe::Cone { half_angle: 1.1 };
    let rounded = rounded_cone(1e-3, 1.1);
    [PARABOLOID, tip, rounded]
        .into_iter()
        .map(half_space)
        .chain([solved_contact(&film(), [1e-6, 10.0], 1e-11)])
        .collect()
}

fn compare(programs: &Programs) {
    let contacts = contacts();
    let mut shares = Vec::new();
    for seed in 0..programs.count {
        let random = &mut Pcg64Mcg::seed_from_u64(seed);
        let contact = &contacts[random.random_range(0..contacts.len())];
        let (load, penetration) = contact
            .load_and_penetration(spread(random, -3.0, -1.3), 0.0)
            .expect("within the curve");
        let control = programs.control.unwrap_or(Control::Spring {
            stiffness: load / penetration * spread(random, -0.5, 1.5),
        });
        let most = control.imposed(load, penetration);
        let law = law(random);
        let mut time = spread(random, -2.0, 2.0);
        let mut program = vec![(0.0, 0.0), (time, most)];
        if random.random_bool(0.4) {
            time *= 1.0 + spread(random, -2.0, 1.5);
            program.push((time, most));
        }
        if programs.again || control != Control::Load {
            time *= 1.0 + spread(random, -1.0, 1.0);
            program.push((time, most * random.random_range(-0.2..0.9)));
        }
        if programs.again {
            time *= 1.0 + spread(random, -1.0, 1.0);
            program.push((time, most * random.random_range(0.0..1.0)));
        }
        let count = [1, 2, 20][random.random_range(0..3)];
        let times: Vec<f64> = (1..=count)
            .map(|i| time * (f64::from(i) - 0.3) / f64::from(count))
            .collect();
        let [from, to] = programs.powers;
        let tolerance = spread(random, from, to);
        let history = contact.history(&law).expect("a law");
        // The largest values are those of the program, not of the times asked for.
        let mut all: Vec<f64> = program.iter().map(|point| point.0).chain(times).collect();
        all.sort_by(f64::total_cmp);
        let of = |tolerance| history.at(control, &program, &all, Some(tolerance));
        let (Ok(own), Ok(exact)) = (of(tolerance), of(tolerance * programs.finer)) else {
            continue;
        };
        assert!(own.error <= tolerance, "{seed}: {:.1e}", own.error);
        let share = (difference(&own, &exact) - exact.error) / own.error;
        assert!(share.is_finite(), "{seed}: {own:?}");
        if share > 1.0 {
            println!(
                "{seed}: {share:.2} of {:.1e} at {tolerance:.1e}, {law:?}",
                own.error
            );
        }
        shares.push(share);
    }
    let worse = shares.iter().filter(|&&share| share > 1.0).count();
    let largest = shares.iter().copied().fold(0.0, f64::max);
    let answers = shares.len();
    let case = format!("{:?}, again {}", programs.control, programs.again);
    println!("{case}: {worse} of {answers} too small, largest share {largest:.2}");
    assert!(
        answers as u64 * 10 >= 8 * programs.count,
        "{case}: {answers} answers"
    );
    let allowed = programs.too_small * answers as f64;
    assert!(
        worse as f64 <= allowed && largest < 5.0,
        "{case}: {worse}, {largest}"
    );
}

/// A penetration with one turn and a load that grows are followed by integrals; elements serve programs that fall and
/// grow again, also under a load that falls and under a spring.
#[test]
fn stated_errors_of_random_histories() {
    let (load, displacement) = (Some(Control::Load), Some(Control::Displacement));
    for (count, control, again, powers, finer, too_small) in [
        (200, displacement, false, [-8.0, -2.0], 0.01, 0.01),
        (200, load, false, [-8.0, -2.0], 0.01, 0.01),
        (100, displacement, true, [-4.0, -2.0], 0.1, 0.05),
        (50, load, true, [-3.0, -2.0], 0.2, 0.05),
        (50, None, true, [-3.0, -2.0], 0.2, 0.05),
    ] {
        compare(&Programs {
            count,
            control,
            again,
            powers,
            finer,
            too_small,
        });
    }
}

/// The states do not depend on the other times that are asked for, and their error is within the tolerance for any
/// times.
#[test]
fn the_times_asked_for_do_not_matter() {
    let contact = half_space(PARABOLOID);
    let history = contact.history(&solid_law()).expect("a law");
    let cycle = [(0.0, 0.0), (1.0, 1e-2), (2.0, -1e-2)];
    let creep = [(0.0, -1e-4), (1.0, 1e-4)];
    for (control, program) in [
        (Control::Displacement, &cycle[..]),
        (Control::Load, &creep[..]),
    ] {
        let of = |times: &[f64]| {
            history
                .at(control, program, times, Some(1e-6))
                .expect("a course")
        };
        let many: Vec<f64> = (0..=20).map(|i| 0.1 * f64::from(i)).collect();
        let all = of(&many);
        let largest = all.states.iter().map(|at| at.state.contact_radius);
        let largest = largest.fold(0.0, f64::max);
        for times in [&[][..], &[0.0], &[1e-6], &[1.0], &[1.95]] {
            let course = of(times);
            assert!(course.error <= 1e-6, "{times:?}: {}", course.error);
            assert_eq!(course.states.len(), times.len());
        }
        for (&time, state) in many.iter().zip(&all.states) {
            let alone = of(&[time]).states[0].state.contact_radius;
            let change = (alone - state.state.contact_radius).abs() / largest;
            assert!(change <= 2e-6, "{control:?} at {time}: {change:.1e}");
        }
    }
}

/// A table of a film may begin at a contact that the load exceeds late.
#[test]
fn smaller_contacts_than_those_of_the_curve() {
    let of = |least| {
        let contact = solved_contact(&film(), [least, 10.0], 1e-10);
        let most = contact.load(0.02, 0.0).expect("within the curve");
        let program: Vec<(f64, f64)> = (0..=40)
            .map(|i| 0.025 * f64::from(i))
            .map(|time| (time, most * time))
            .collect();
        let history = contact.history(&solid_law()).expect("a law");
        history
            .run(Control::Load, &program, None)
            .expect("a course")
    };
    let (cut, whole) = (of(0.5), of(1e-6));
    let difference = difference(&cut, &whole);
    println!("{difference:.1e}, stated {:.1e}", cut.error);
    assert!(difference <= cut.error && cut.error <= 30.0 * difference);
}

/// The fastest exponentials of this law are too weak to be told from none.
#[test]
fn terms_too_weak_for_elements_are_left_out() {
    let contact = half_space(PARABOLOID);
    let law = modified_power_law(0.78, 0.24, 44.5);
    let history = contact.history(&law).expect("a law");
    let program = [(0.0, 0.0), (5.0, 1e-2), (7.0, 5e-3), (10.0, 8e-3)];
    let [coarse, fine, finest] = [1e-3, 1e-4, 1e-5].map(|tolerance| {
        history
            .run(Control::Displacement, &program, Some(tolerance))
            .expect("a course")
    });
    for own in [coarse, fine] {
        let difference = difference(&own, &finest);
        assert!(difference <= own.error + finest.error, "{difference:.1e}");
    }
}
