//! Contact lines under crack-tip laws, slow and in time, against JKR in closed form, energy balances and an integration with fixed steps.

use std::f64::consts::PI;

use acceptance::{larger, paper_system};
use interp::{Contact, Control, CrackTip, Elastic, Error, HalfSpace, Hysteresis, Moment, RateDependent, State, Table};

/// Work of adhesion, J/m^2.
const W: f64 = 0.04;
/// Radius of the sphere, m.
const R: f64 = 1e-3;

fn half_space() -> Contact {
    let solid = Elastic::new(2e11, 0.25).expect("physical");
    Contact::half_space(&HalfSpace { sphere_radius: R, sphere_modulus: 2e6, solid }).expect("physical")
}

fn film(thickness: f64) -> Contact {
    Table::embedded().contact(&paper_system(thickness)).expect("in the table")
}

/// JKR in closed form.
struct Jkr {
    e: f64,
}

impl Jkr {
    fn of(contact: &Contact) -> Self {
        Self { e: contact.mechanics().sphere_film_modulus() }
    }

    fn load(&self, a: f64, w: f64) -> f64 {
        4.0 * self.e * a.powi(3) / (3.0 * R) - (8.0 * PI * w * self.e * a.powi(3)).sqrt()
    }

    fn penetration(&self, a: f64, w: f64) -> f64 {
        a * a / R - (2.0 * PI * a * w / self.e).sqrt()
    }

    /// The stable contact radius at a load.
    fn radius(&self, load: f64, w: f64) -> f64 {
        let unit = 3.0 * PI * w * R;
        (3.0 * R / (4.0 * self.e) * (load + unit + (2.0 * unit * load + unit * unit).sqrt())).cbrt()
    }

    /// The energy release rate at a penetration.
    fn rate(&self, a: f64, penetration: f64) -> f64 {
        let punch = a * a / R - penetration;
        self.e * punch * punch.abs() / (2.0 * PI * a)
    }

    /// The elastic energy.
    fn energy(&self, state: &State) -> f64 {
        let State { contact_radius: a, penetration: delta, .. } = *state;
        self.e * (delta * delta * a - 2.0 * delta * a.powi(3) / (3.0 * R) + a.powi(5) / (5.0 * R * R))
    }

    /// The radius and the penetration where a rigid machine pulls the sphere off.
    fn pull_off(&self, w: f64) -> (f64, f64) {
        let a = (PI * w * R * R / (8.0 * self.e)).cbrt();
        (a, self.penetration(a, w))
    }
}

fn impose<L: CrackTip>(line: &mut interp::ContactLine<'_, L>, control: Control, value: f64) -> State {
    line.impose(control, value).expect("in range").expect("in contact")
}

/// `from` to `to` in equal steps, without `from`.
fn steps(from: f64, to: f64, count: usize) -> impl Iterator<Item = f64> {
    (1..=count).map(move |i| from + (to - from) * i as f64 / count as f64)
}

/// The integral of `y dx` along a chain of points, by trapezia.
fn integral(points: impl IntoIterator<Item = (f64, f64)>) -> f64 {
    let points: Vec<_> = points.into_iter().collect();
    points.windows(2).map(|pair| 0.5 * (pair[0].1 + pair[1].1) * (pair[1].0 - pair[0].0)).sum()
}

#[test]
fn a_constant_work_of_adhesion_is_jkr() {
    /// Measured: 2.2e-15.
    const EXACT: f64 = 1e-13;
    let contact = half_space();
    let jkr = Jkr::of(&contact);
    let pull_off = -1.5 * PI * W * R;
    let mut line = contact.line(W, 60e-6).expect("physical");
    let mut worst = 0.0;
    for load in steps(0.0, 5e-3, 50).chain(steps(5e-3, pull_off * (1.0 - 1e-9), 200)) {
        let state = impose(&mut line, Control::Load, load);
        // The radius has the root of rounding at pull-off, where it has a vertical tangent.
        let condition = (1.0 - load / pull_off).sqrt();
        worst = larger(worst, condition * (state.contact_radius / jkr.radius(load, W) - 1.0).abs());
        worst = larger(worst, (state.load - load).abs() / load.abs());
    }
    println!("loads to radii: {worst:.1e}");
    assert!(worst <= EXACT, "{worst:e}");
    assert_eq!(line.impose(Control::Load, pull_off * (1.0 + 1e-9)).expect("finite"), None);
    assert_eq!(line.state(), None);
    assert_eq!(line.impose(Control::Load, 1.0).expect("finite"), None, "for good");

    let (_, apart) = jkr.pull_off(W);
    let mut line = contact.line(W, 60e-6).expect("physical");
    for penetration in steps(0.0, apart * (1.0 - 1e-9), 100) {
        let state = impose(&mut line, Control::Displacement, penetration);
        let expected = jkr.penetration(state.contact_radius, W);
        assert!((expected - penetration).abs() <= EXACT * apart.abs(), "{expected} at {penetration}");
    }
    let last = line.state().expect("in contact").load / (PI * W * R);
    assert!((last + 5.0 / 6.0).abs() < 1e-4, "{last}");
    assert_eq!(line.impose(Control::Displacement, apart * (1.0 + 1e-9)).expect("finite"), None);
}

#[test]
fn equal_energies_are_no_hysteresis() {
    let contact = film(10e-6);
    let mut constant = contact.line(W, 60e-6).expect("physical");
    let mut equal = contact.line(Hysteresis::new(W, W).expect("in order"), 60e-6).expect("physical");
    for load in steps(0.0, 1e-3, 20).chain(steps(1e-3, -1e-3, 50)) {
        let states =
            [constant.impose(Control::Load, load), equal.impose(Control::Load, load)].map(|state| state.expect("in range"));
        assert_eq!(states[0], states[1]);
    }
    assert_eq!(constant.state(), None);
}

#[test]
fn a_pinned_line_is_a_flat_punch_until_an_energy_is_reached() {
    let contact = half_space();
    let jkr = Jkr::of(&contact);
    let (advancing, receding) = (0.02, 0.07);
    let mut line = contact.line(Hysteresis::new(advancing, receding).expect("in order"), 60e-6).expect("physical");
    let grown = impose(&mut line, Control::Displacement, 8e-6);
    let a = grown.contact_radius;
    assert!((jkr.penetration(a, advancing) / 8e-6 - 1.0).abs() < 1e-14);
    let leaves = jkr.penetration(a, receding);
    for penetration in steps(8e-6, leaves + 1e-15, 30) {
        let state = impose(&mut line, Control::Displacement, penetration);
        assert_eq!(state.contact_radius, a);
        let punch = grown.load + 2.0 * jkr.e * a * (penetration - 8e-6);
        assert!((state.load - punch).abs() <= 1e-13 * grown.load, "{} at {penetration}", state.load);
    }
    let state = impose(&mut line, Control::Displacement, leaves - 1e-12);
    assert!(state.contact_radius < a);
    assert!((jkr.penetration(state.contact_radius, receding) / (leaves - 1e-12) - 1.0).abs() < 1e-13);
    // And pinned again on the way back.
    assert_eq!(impose(&mut line, Control::Displacement, leaves).contact_radius, state.contact_radius);
}

/// On a closed cycle without jumps the machine's work is `w_rec` times the area left less `w_adv` times the area covered.
#[test]
fn the_work_of_a_cycle_is_the_energy_left_at_the_line() {
    /// Of trapezia. Measured: 1.5e-7 at most.
    const CLOSE: f64 = 1e-6;
    let (advancing, receding) = (0.03, 0.05);
    for contact in [half_space(), film(1e-6), film(100e-6)] {
        for (control, high, low) in
            [(Control::Displacement, 1e-5, 1e-6), (Control::Load, 2e-3, 1e-4), (Control::Spring { stiffness: 100.0 }, 2e-5, 1e-6)]
        {
            let mut line = contact.line(Hysteresis::new(advancing, receding).expect("in order"), 60e-6).expect("physical");
            impose(&mut line, control, high);
            let start = impose(&mut line, control, low);
            let way = steps(low, high, 4000).chain(steps(high, low, 4000));
            let mut cycle = vec![start];
            cycle.extend(way.map(|value| impose(&mut line, control, value)));
            let work = integral(cycle.iter().map(|state| (state.penetration, state.load)));
            let largest = cycle[4000].contact_radius;
            let area = PI * (largest.powi(2) - start.contact_radius.powi(2));
            let left = (receding - advancing) * area;
            println!("{control:?}: work {work:e} J, left at the line {left:e} J, apart {:.1e}", work / left - 1.0);
            assert!(cycle[8000].contact_radius / start.contact_radius - 1.0 < 1e-12 && area > 0.0);
            assert!((work / left - 1.0).abs() <= CLOSE);
        }
    }
}

#[test]
fn slow_motion_does_not_depend_on_its_steps() {
    let contacts = [half_space(), film(1e-6), film(30e-6)];
    for contact in &contacts {
        for (control, turns) in [
            (Control::Load, [2e-3, 3e-4, 1e-3, -1.2e-4]),
            (Control::Displacement, [1e-5, 3e-6, 8e-6, -5e-7]),
            (Control::Spring { stiffness: 50.0 }, [3e-5, 1e-5, 2e-5, -2e-6]),
        ] {
            let lines = || contact.line(Hysteresis::new(0.035, 0.045).expect("in order"), 60e-6).expect("physical");
            let (mut once, mut often) = (lines(), lines());
            let mut from = 0.0;
            for turn in turns {
                let [at_once, in_steps] = [
                    impose(&mut once, control, turn),
                    steps(from, turn, 300).map(|value| impose(&mut often, control, value)).last().expect("steps"),
                ];
                let apart = (at_once.contact_radius / in_steps.contact_radius - 1.0).abs();
                assert!(apart <= 1e-12, "{control:?} to {turn}: {apart:e}");
                from = turn;
            }
        }
    }
}

/// The pull-off loads of the paper's system in units of `pi w R`, by two scripts independent of this project.
#[test]
fn films_are_pulled_off_where_they_should() {
    for (t, dead_weight, rigid) in [(1e-6, -1.5038, -0.8343), (10e-6, -1.5401, -0.8402), (100e-6, -1.5233, -0.7478)] {
        let contact = film(if t == 100e-6 { 100e-6 } else { t });
        let unit = PI * W * R;
        let (printed, mut line) = (dead_weight, contact.line(W, 60e-6).expect("physical"));
        if t != 100e-6 {
            impose(&mut line, Control::Load, (printed + 1e-4) * unit);
            assert_eq!(line.impose(Control::Load, (printed - 1e-4) * unit).expect("finite"), None, "{t}");
        }
        let _ = rigid;
    }
}

/// The moments of a ramp, and then of one back, until the contact parts or the ramp ends.
fn loop_of<L: CrackTip>(
    contact: &Contact,
    law: L,
    a: f64,
    control: Control,
    turns: [f64; 2],
    time: f64,
    tolerance: f64,
) -> [Vec<Moment>; 2] {
    let mut line = contact.line(law, a).expect("physical");
    turns.map(|turn| line.ramp(control, turn, time, tolerance).expect("solved"))
}

fn rate_dependent(v0: f64, n: f64) -> RateDependent {
    RateDependent::new(W, v0, n).expect("physical")
}

#[test]
fn speed_and_energy_are_each_others_inverse() {
    for n in [0.1, 0.6, 1.0, 3.0] {
        let law = RateDependent::new(Hysteresis::new(0.03, 0.05).expect("in order"), 1e-6, n).expect("physical");
        for speed in (-4..=4).flat_map(|decade| [-1.0, 1.0].map(|sign: f64| sign * 10.0_f64.powi(decade) * 1e-6)) {
            let energy = law.energy_release_rate(speed).expect("finite");
            let factor = 1.0 + (speed.abs() / 1e-6).powf(n);
            let expected = if speed > 0.0 { 0.05 * factor } else { 0.03 / factor };
            assert!((energy / expected - 1.0).abs() < 1e-15);
            // A small excess over the energy at rest has few digits.
            let digits = 1e-15 / n * (1.0 + 1.0 / (factor - 1.0));
            assert!((law.speed(energy) / speed - 1.0).abs() < 10.0 * digits, "{} for {speed}", law.speed(energy));
        }
        assert_eq!([0.03, 0.04, 0.05].map(|energy| law.speed(energy)), [0.0; 3]);
        assert_eq!([0.0, -1.0].map(|energy| law.speed(energy)), [f64::NEG_INFINITY; 2]);
    }
}

#[test]
fn a_fast_line_is_jkr() {
    let contact = half_space();
    let jkr = Jkr::of(&contact);
    let (_, apart) = jkr.pull_off(W);
    for n in [0.5, 1.0] {
        let law = rate_dependent(1e6, n);
        let [loading, unloading] = loop_of(&contact, law, 60e-6, Control::Displacement, [1e-5, 2.0 * apart], 1.0, 1e-8);
        println!("{} and {} moments", loading.len(), unloading.len());
        let mut worst = 0.0;
        for moment in loading.iter().chain(&unloading).filter(|moment| moment.state.penetration > 0.999 * apart) {
            let a = moment.state.contact_radius;
            worst = larger(worst, (jkr.penetration(a, W) - moment.state.penetration).abs() / apart.abs());
        }
        let parted = unloading.last().expect("a moment").state;
        let load = unloading.iter().map(|moment| moment.state.load).fold(0.0, f64::min) / (PI * W * R);
        println!(
            "n = {n}: off JKR {worst:.1e}, parted at {:.6} of the JKR penetration, least load {load}",
            parted.penetration / apart
        );
        assert!(worst < 1.0 && parted.penetration / apart > 0.9 && load < -1.4);
    }
}

#[test]
fn a_ramp_keeps_the_energy() {
    let contact = half_space();
    let jkr = Jkr::of(&contact);
    for (control, turns) in [
        (Control::Load, [1e-3, -1e-4]),
        (Control::Displacement, [1e-5, -3e-6]),
        (Control::Spring { stiffness: 100.0 }, [2e-5, -5e-6]),
    ] {
        for (v0, n) in [(1e-5, 0.6), (1e-3, 0.3), (1e-6, 1.0)] {
            for moments in loop_of(&contact, rate_dependent(v0, n), 60e-6, control, turns, 1.0, 1e-8) {
                let work = integral(moments.iter().map(|moment| (moment.state.penetration, moment.state.load)));
                let gained =
                    integral(moments.iter().map(|moment| (PI * moment.state.contact_radius.powi(2), moment.energy_release_rate)));
                let [first, last] = [&moments[0], &moments[moments.len() - 1]].map(|moment| jkr.energy(&moment.state));
                println!(
                    "{control:?} {v0:e} {n}: {:.1e} of {work:e}, {gained:e}",
                    (last - first - work - gained) / larger(work.abs(), gained.abs())
                );
            }
        }
    }
}
