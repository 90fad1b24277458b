//! Contact lines under crack-tip laws, slow or at a finite speed, against JKR in closed form,
//! energy balances and an integration with fixed steps.

mod in_time;
mod ramps;
mod slow;

use acceptance::{assert_matches, looked_up, paper_system};
use contact::{Contact, Control, CrackTip, Error, Hysteresis, RateDependent, State};

use crate::contact::beginning_at;

/// Work of adhesion, J/m^2.
const W: f64 = 0.04;
/// Radius of the sphere, m.
const R: f64 = 1e-3;

fn film(thickness: f64) -> Contact {
    looked_up(&paper_system(thickness))
}

fn rate_dependent(v0: f64, n: f64) -> RateDependent {
    RateDependent::new(W, v0, n).expect("physical")
}

fn impose<L: CrackTip>(
    line: &mut contact::ContactLine<'_, L>,
    control: Control,
    value: f64,
) -> State {
    line.impose(control, value)
        .expect("in range")
        .expect("in contact")
}

/// Returns `count` equally spaced values from `from` to `to`, without `from`.
fn steps(from: f64, to: f64, count: usize) -> impl Iterator<Item = f64> {
    (1..=count).map(move |i| from + (to - from) * i as f64 / count as f64)
}

/// Integrates `y dx` along a chain of points by the trapezium rule.
fn integral(points: impl IntoIterator<Item = (f64, f64)>) -> f64 {
    let points: Vec<_> = points.into_iter().collect();
    points
        .windows(2)
        .map(|pair| 0.5 * (pair[0].1 + pair[1].1) * (pair[1].0 - pair[0].0))
        .sum()
}

#[test]
fn a_line_that_leaves_the_table_is_an_error_and_stays() {
    let contact = film(1e-6);
    let [_, most] = contact.contact_radius_range();
    let load = 2.0 * contact.load(most, W).expect("in range");
    let mut line = contact.line(W, 60e-6).expect("physical");
    let before = line.state();
    let imposed = line.impose(Control::Load, load);
    assert_matches!(imposed, Err(Error::OutsideRadii { .. }));
    assert_eq!(line.state(), before);
    let line = contact.line(rate_dependent(1e-3, 0.6), 60e-6);
    let mut line = line.expect("physical");
    let ramp = line.ramp(Control::Load, load, 1.0, 1e-4);
    assert!(matches!(ramp, Err(Error::OutsideRadii { .. })), "{ramp:?}");
    assert_eq!(line.state(), before);
    // Smaller contacts than the smallest of the curve would be stable.
    let contact = beginning_at(55e-6);
    let line = contact.line(rate_dependent(1e-3, 0.6), 60e-6);
    let mut line = line.expect("physical");
    let ramp = line.ramp(Control::Displacement, -2e-7, 1e3, 1e-4);
    assert!(matches!(ramp, Err(Error::OutsideRadii { .. })), "{ramp:?}");
}

/// Lines of any numbers are in `tests/hostile/functions.rs`.
#[test]
fn laws_of_hostile_numbers_are_errors() {
    const HOSTILE: [f64; 12] = [
        f64::NAN,
        f64::INFINITY,
        f64::NEG_INFINITY,
        0.0,
        -0.0,
        -1.0,
        5e-324,
        f64::MIN_POSITIVE,
        1e-150,
        1e150,
        f64::MAX,
        f64::MIN,
    ];
    for x in HOSTILE {
        for y in HOSTILE {
            let in_order = (0.0..=y).contains(&x) && y.is_finite();
            assert_eq!(Hysteresis::new(x, y).is_ok(), in_order, "{x} {y}");
            let positive = |value: f64| value > 0.0 && value.is_finite();
            for made in [RateDependent::new(W, x, y), RateDependent::new(x, y, y)] {
                assert_eq!(made.is_ok(), positive(x) && positive(y), "{x} {y}");
            }
            if let Ok(law) = RateDependent::new(W, x, y) {
                for z in HOSTILE {
                    // The energy of a finite speed may still be too large.
                    let energy = law.energy_release_rate(z);
                    assert!(energy.is_err() || z.is_finite());
                    let is_slow = z.is_finite() && z.abs() < x;
                    assert!(!is_slow || energy.is_ok_and(f64::is_finite), "{x} {y} {z}");
                    assert_eq!(law.speed(z).is_nan(), z.is_nan(), "{x} {y} {z}");
                }
            }
        }
    }
}
