//! Stated errors of random histories beside the same histories to a hundredth of the tolerance, by the same method.
//!
//! This shows what a tolerance leaves out, not what the method does: series by other programs and closed forms do that.

use contact::{Contact, Control, Course, Relaxation};
use interp::Probe;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

use super::{PARABOLOID, half_space};
use acceptance::{rigid_probe, solid, solved_contact};

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
            Relaxation::Prony {
                relaxed,
                terms: vec![[part * rest, time], [(1.0 - part) * rest, other]],
            }
        }
        1 => Relaxation::PowerLaw {
            exponent: random.random_range(0.01..0.9),
            time,
        },
        2 => Relaxation::ModifiedPowerLaw {
            relaxed,
            exponent: random.random_range(0.01..0.95),
            time,
        },
        _ => Relaxation::FractionalZener {
            relaxed,
            exponent: random.random_range(0.05..0.95),
            time,
        },
    }
}

/// Returns the largest difference of loads, radii and penetrations, each in parts of the largest one.
fn difference(own: &Course, exact: &Course) -> f64 {
    let of = |of: fn(&contact::State) -> f64| {
        let largest = exact.states.iter().map(|at| of(&at.state).abs());
        let largest = largest.fold(f64::MIN_POSITIVE, f64::max);
        let pairs = own.states.iter().zip(&exact.states);
        let differences = pairs.map(|(own, exact)| (of(&own.state) - of(&exact.state)).abs());
        differences.fold(0.0, |most, own| if own <= most { most } else { own }) / largest
    };
    of(|state| state.load)
        .max(of(|state| state.contact_radius))
        .max(of(|state| state.penetration))
}

/// Follows `count` random programs to tolerances between two powers of 10, with a second approach if `again`, and
/// compares the stated errors with the differences from a tolerance that is `finer` times as large.
fn compare(count: u64, control: Control, again: bool, [from, to]: [f64; 2], finer: f64) {
    let tip = Probe::Cone { half_angle: 1.1 };
    let rounded = Probe::RoundedCone {
        radius: 1e-3,
        half_angle: 1.1,
    };
    let film = rigid_probe(
        PARABOLOID,
        solid(1.0, 0.45),
        0.02,
        solid(f64::INFINITY, 0.0),
    );
    let contacts: Vec<Contact> = [PARABOLOID, tip, rounded]
        .into_iter()
        .map(half_space)
        .chain([solved_contact(&film, [1e-6, 10.0], 1e-11)])
        .collect();
    let mut shares = Vec::new();
    for seed in 0..count {
        let random = &mut Pcg64Mcg::seed_from_u64(seed);
        let contact = &contacts[random.random_range(0..contacts.len())];
        let (load, penetration) = contact
            .load_and_penetration(spread(random, -3.0, -1.3), 0.0)
            .expect("within the curve");
        let most = if control == Control::Load {
            load
        } else {
            penetration
        };
        let law = law(random);
        let mut time = spread(random, -2.0, 2.0);
        let mut program = vec![(0.0, 0.0), (time, most)];
        if random.random_bool(0.4) {
            time *= 1.0 + spread(random, -2.0, 1.5);
            program.push((time, most));
        }
        if control != Control::Load {
            time *= 1.0 + spread(random, -1.0, 1.0);
            program.push((time, most * random.random_range(-0.2..0.9)));
        }
        if again {
            time *= 1.0 + spread(random, -1.0, 1.0);
            program.push((time, most * random.random_range(0.0..1.0)));
        }
        let times: Vec<f64> = (1..=20).map(|i| time * f64::from(i) / 20.0).collect();
        let tolerance = spread(random, from, to);
        let history = contact.history(&law).expect("a law");
        let of = |tolerance| history.at(control, &program, &times, Some(tolerance));
        let (Ok(own), Ok(exact)) = (of(tolerance), of(tolerance * finer)) else {
            continue;
        };
        assert!(own.error <= tolerance, "{seed}: {:.1e}", own.error);
        let share = (difference(&own, &exact) - exact.error) / own.error;
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
    println!(
        "{control:?}, again {again}: {worse} of {} too small, largest share {largest:.2}",
        shares.len()
    );
    assert!(
        shares.len() as u64 * 10 >= 8 * count,
        "{} answers",
        shares.len()
    );
    assert!(
        worse * 100 <= shares.len() && largest < 4.0,
        "{worse}, {largest}"
    );
}

#[test]
fn errors_of_one_turn() {
    compare(200, Control::Displacement, false, [-8.0, -2.0], 0.01);
}

#[test]
fn errors_under_a_load_that_grows() {
    compare(200, Control::Load, false, [-8.0, -2.0], 0.01);
}

#[test]
fn errors_of_elements() {
    compare(100, Control::Displacement, true, [-4.0, -2.0], 0.1);
}

/// The fastest exponentials of this law are too weak to be told from none.
#[test]
fn a_law_that_begins_to_fall_late() {
    let contact = half_space(PARABOLOID);
    let law = Relaxation::ModifiedPowerLaw {
        relaxed: 0.78,
        exponent: 0.24,
        time: 44.5,
    };
    let history = contact.history(&law).expect("a law");
    let program = [(0.0, 0.0), (5.0, 1e-2), (7.0, 5e-3), (10.0, 8e-3)];
    for tolerance in [1e-3, 1e-4, 1e-5] {
        let course = history
            .run(Control::Displacement, &program, Some(tolerance))
            .expect("a course");
        let held = course.states.iter().map(|at| at.state.load);
        assert!(held.clone().all(f64::is_finite), "{course:?}");
        assert!(held.fold(0.0, f64::max) > 0.0);
    }
}
