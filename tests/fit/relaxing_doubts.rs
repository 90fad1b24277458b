//! Doubts about fits of bodies that relax, and what is refused.

use acceptance::{Contacts, Refused, half_space_of, prony, solid};
use contact::Relaxation;
use fit::{Bodies, Direction, Experiment, Free, Kind, Parameter, Point, Relaxing, WarningKind};
use interp::Probe;

use crate::imagined::{
    assert_silent, film, fit_all, fitted, free_of, half_space, measurement_of, off, text,
};
use crate::relaxing::{POWER_LAW, measured, noisy, planned, power, with_noise};

use Parameter::{FilmModulus, Law};
use contact::LawParameter::{Exponent, RelaxedFraction, Time};

/// A gel that relaxes on a base, 60 points in 2 s.
fn relaxing(law: Relaxation, young: f64, base: f64) -> Experiment {
    let mut plan = planned(Kind::LoadPenetration, 1e-5, &law, 0.0);
    film(&mut plan).solid = solid(young, 0.5);
    plan.bodies.base = solid(base, 0.25);
    if let Some(relaxing) = &mut plan.relaxing {
        relaxing.all_bodies = base < f64::INFINITY;
    }
    noisy(&plan, 1)
}

#[test]
fn a_relaxation_time_that_the_points_do_not_see_is_doubted() {
    for (time, is_doubted) in [(0.01, true), (0.3, false), (10.0, true)] {
        let law = prony(0.3, vec![[0.7, time]]);
        let data = relaxing(law, 2e3, f64::INFINITY);
        let bounds = Free::new(Law(Time(0))).within(0.5 * time, 2.0 * time);
        let found = fit_all(&[data], &[Free::new(FilmModulus), bounds]);
        let said = text(&found.expect("sound"), WarningKind::RelaxationTime);
        let is_said = said.contains("two intervals between points");
        assert_eq!(is_said, is_doubted, "{time}: {said}");
    }
}

/// A rigid cone is pressed into a standard linear solid at a uniform speed and held. With the depth `d = v t` up to `T` and
/// `m = min(t, T)` the load is, in closed form (Lee and Radok),
///
/// ```text
/// C (phi d(m)^2 + 2 (1 - phi) v^2 tau (m exp((m - t)/tau) - tau (exp((m - t)/tau) - exp(-t/tau))))
/// ```
///
/// A relaxation time of some three intervals between points is known to 40 % where the noise is a hundredth of the load, and
/// the modulus is off by more standard errors than by chance.
#[test]
fn standard_errors_that_do_not_hold_for_a_relaxation_time_are_doubted() {
    const E: f64 = 2e3;
    const PHI: f64 = 0.8;
    const TAU: f64 = 0.05;
    const SPEED: f64 = 1e-6;
    const TURN: f64 = 1.0;
    const INTERVAL: f64 = 0.0144;
    let half_angle = 70_f64.to_radians();
    let factor = std::f64::consts::FRAC_2_PI * E / 0.75 * half_angle.tan();
    let load = |t: f64| {
        let (t, m) = (t.max(0.0), t.clamp(0.0, TURN));
        let decays = ((m - t) / TAU).exp();
        let memory = TAU * (m * decays - TAU * (decays - (-t / TAU).exp()));
        factor * SPEED * SPEED * (PHI * m * m + 2.0 * (1.0 - PHI) * memory)
    };
    let law = prony(PHI, vec![[1.0 - PHI, TAU]]);
    let probe = Probe::Cone { half_angle };
    let solid = half_space_of(probe, f64::INFINITY, solid(E, 0.5));
    let free = free_of(&[
        FilmModulus,
        Law(RelaxedFraction),
        Law(Time(0)),
        Parameter::ContactPoint,
    ]);
    let fit_of = |noise: f64, seed: u64| {
        let mut random = Contacts::new(seed);
        let times: Vec<f64> = (0..180).map(|i| INTERVAL * f64::from(i)).collect();
        let touch = 0.3;
        let points = times.iter().map(|time| {
            let t = time - touch;
            let noise = noise * load(TURN) * random.normal();
            [SPEED * t.min(TURN), load(t) + noise]
        });
        let measured = measurement_of(Kind::LoadPenetration, points);
        let mut data = Experiment::new(measured, Bodies::half_space(solid.clone()));
        data.times = times;
        data.relaxing = Some(Relaxing::new(law.clone()));
        fitted(&data, &free)
    };
    let (mut wrong, mut unsaid) = (0, 0);
    for seed in 0..60 {
        let found = fit_of(0.01, seed);
        let is_said = found.warns_of(WarningKind::NonlinearError);
        if off(&found, FilmModulus, E).abs() > 2.5 {
            wrong += 1;
            unsaid += i32::from(!is_said);
        }
    }
    assert!(wrong > 2 && unsaid == 0, "{unsaid} of {wrong}");
    for seed in 0..5 {
        assert_silent(&fit_of(1e-4, seed), WarningKind::NonlinearError);
    }
}

#[test]
fn a_stiff_film_on_a_soft_base_that_relax_together_is_doubted() {
    for (young, base, is_doubted) in [(2e4, 2e3, true), (2e3, 2e4, false), (2e3, 1e3, false)] {
        let data = relaxing(power(), young, base);
        let found = fitted(&data, &free_of(&[FilmModulus]));
        let doubted = found.warns_of(WarningKind::TensileInside);
        assert_eq!(doubted, is_doubted, "{young:e} {base:e}");
    }
}

/// Flow of a solvent tells itself by other times under another sphere; its contacts grow with the root of the radius.
#[test]
fn a_gel_under_spheres_of_one_size_may_relax_by_flow() {
    for (young, radii, is_doubted) in [
        (2e3, &[2e-5][..], true),
        (2e3, &[2e-5, 3e-5], true),
        (2e3, &[2e-5, 6e-5], false),
        (2e6, &[2e-5], false),
    ] {
        let under = |&radius: &f64| {
            let mut data = relaxing(power(), young, f64::INFINITY);
            data.bodies.probe = Probe::Paraboloid { radius };
            noisy(&data, 1)
        };
        let data: Vec<Experiment> = radii.iter().map(under).collect();
        let found = fit_all(&data, &free_of(&[FilmModulus])).expect("sound");
        let doubted = found.warns_of(WarningKind::OneSize);
        assert_eq!(doubted, is_doubted, "{young:e} {radii:?}");
    }
}

#[test]
fn points_that_begin_in_contact_are_refused_with_a_level_that_is_known() {
    for seed in 0..10 {
        let mut data = noisy(&planned(Kind::LoadPenetration, 1e-5, &power(), 0.3), seed);
        data.contact_point = 0.0;
        // The first point is 70 nm into contact, of 600 nm.
        data.measurement.points.drain(..9);
        data.times.drain(..9);
        fit_all(&[data], &free_of(&POWER_LAW)).refused("begin in contact");
    }
}

/// A penetration that is held while the force falls moves the base of the cantilever back. A hold of the height and a slow
/// retract do not: they are fitted.
#[test]
fn heights_of_a_held_penetration_are_refused() {
    let of_penetrations = planned(Kind::LoadPenetration, 1e-5, &power(), 2.0);
    for (part, seed, faster) in [(0.0, 0, 1.0), (0.003, 1, 1.0), (0.003, 2, 0.25)] {
        let mut plan = of_penetrations.clone();
        for time in plan.times.iter_mut().filter(|time| **time > 1.0) {
            *time = 1.0 + faster * (*time - 1.0);
        }
        let mut data = with_noise(&plan, part, seed);
        let stiffness = data.stiffness.expect("planned");
        data.measurement.kind = Kind::ForceHeight;
        data.contact_point = 0.0;
        data.noise = None;
        for point in &mut data.measurement.points {
            point.abscissa = -(point.abscissa + point.ordinate / stiffness);
        }
        fit_all(&[data], &free_of(&POWER_LAW))
            .refused("penetration was held; give the penetrations");
    }
    for slower in [1.0, 20.0] {
        let mut plan = planned(Kind::ForceHeight, 1e-5, &power(), 2.0);
        for time in plan.times.iter_mut().filter(|time| **time > 3.0) {
            *time = 3.0 + slower * (*time - 3.0);
        }
        fit_all(&[noisy(&plan, 1)], &free_of(&POWER_LAW)).expect("no penetration was held");
    }
    // Nor do heights under a stiff cantilever, whose deflection is less than their noise, or than a drift in the hold.
    for (seed, drift) in (0..4).flat_map(|seed| [(seed, 0.0), (seed, 1.2e-8)]) {
        let mut plan = planned(Kind::ForceHeight, 1e-5, &power(), 2.0);
        plan.stiffness = Some(2.0);
        for (point, time) in plan.measurement.points.iter_mut().zip(&plan.times) {
            point.abscissa += drift * 0.5 * (time.min(3.0) - 1.0).max(0.0);
        }
        let mut data = noisy(&plan, seed);
        let mut random = Contacts::new(seed);
        let heights = data
            .measurement
            .points
            .iter_mut()
            .map(|point| &mut point.abscissa);
        heights.for_each(|height| *height += 1e-10 * random.normal());
        let found = fit_all(&[data], &free_of(&POWER_LAW)).expect("no penetration was held");
        let off = off(&found, FilmModulus, 2e3);
        assert!(off.abs() < 4.0, "{seed}, {drift:e}: {off}");
    }
}

#[test]
fn what_cannot_be_fitted_is_refused_with_the_reason() {
    let data = measured(&planned(Kind::LoadPenetration, 1e-5, &power(), 0.0), 1);
    let with_free = |change: fn(&mut Experiment), free: &[Parameter]| {
        let mut changed = data.clone();
        change(&mut changed);
        fit_all(&[changed], &free_of(free))
    };
    let with = |change| with_free(change, &POWER_LAW);
    with(|one| one.times[7] = one.times[6]).refused("line 8; times must rise");
    with(|one| one.times[7] = f64::NAN).refused("line 8; times must rise");
    with(|one| one.times.clear()).refused("no times; give each point its time");
    with(|one| one.times.truncate(9)).refused("number of times; 60");
    with(|one| one.work_of_adhesion = 0.01)
        .refused("work of adhesion; crack tip; without adhesion");
    let radii = |one: &mut Experiment| {
        one.measurement.kind = Kind::LoadRadius;
        for point in &mut one.measurement.points {
            point.abscissa = point.abscissa.abs();
        }
    };
    with_free(radii, &[FilmModulus, Law(Exponent)]).refused("penetrations; heights");
    for first in [20, 30] {
        let mut begins = data.clone();
        begins.measurement.points.drain(..first);
        begins.times.drain(..first);
        fit_all(&[begins], &free_of(&POWER_LAW)).refused("begin in contact; history; not known");
    }
    let flows = |one: &mut Experiment| {
        let (exponent, time) = (1.0, 1.0);
        one.relaxing = Some(Relaxing::new(Relaxation::PowerLaw { exponent, time }));
    };
    with(flows).refused("relaxation exponent; below 1");
    let again = |one: &mut Experiment| {
        let count = one.measurement.points.len();
        for (point, i) in one.measurement.points[count - 10..].iter_mut().zip(0..) {
            point.abscissa = 3e-7 + 5e-8 * f64::from(i);
        }
    };
    with(again).refused("one approach");
    with(|one| one.relaxing = None).refused("relaxation function; give one");
    with_free(|_| (), &[FilmModulus, Law(RelaxedFraction)])
        .refused("relaxed-fraction; does not have");
}

/// Hertz's loads with noise, and after them a load that is held while the penetration grows by a fifth.
#[test]
fn a_held_load_is_found_in_noise_and_none_where_none_is_held() {
    const DEEPEST: f64 = 5e-7;
    let hertz = |penetration: f64| 4.0 / 3.0 * 5e4 * (1e-5 * penetration.max(0.0).powi(3)).sqrt();
    for (count, held, noise) in [
        (60, 0, 0.1),
        (100, 0, 0.05),
        (1000, 250, 0.01),
        (3000, 900, 0.01),
    ] {
        for seed in 0..20 {
            let mut random = Contacts::new(seed);
            let points = (0..count + held).map(|i: u32| {
                let way = f64::from(i.min(count)) / f64::from(count);
                let exact = DEEPEST * (1.3 * way - 0.3);
                let crept = 0.2 * f64::from(i.saturating_sub(count)) / f64::from(held.max(1));
                let load = hertz(exact) + noise * hertz(DEEPEST) * random.normal();
                [exact + crept * DEEPEST, load]
            });
            let bodies = half_space(1e-5, 5e4, solid(f64::INFINITY, 0.3));
            let data = Experiment::new(measurement_of(Kind::LoadPenetration, points), bodies);
            let free = free_of(&[Parameter::SphereModulus, Parameter::ContactPoint]);
            let found = fitted(&data, &free);
            assert_eq!(
                found.warns_of(WarningKind::Relaxes),
                held > 0,
                "{count}, {seed}: {:?}",
                found.warnings
            );
        }
    }
}

/// Penetrations at a uniform speed, written with few digits, rise by one step and by two: what is imposed is a straight line.
#[test]
fn rounded_penetrations_of_a_uniform_speed_are_a_straight_line() {
    const STEP: f64 = 1e-9;
    const RATE: f64 = 512.0;
    let mut plan = planned(Kind::LoadPenetration, 1e-5, &power(), 0.0);
    let depth = |t: f64| if t < 1.0 { 1e-6 * t } else { 1e-6 * (2.0 - t) };
    let points = (0..1024_u32).map(|i| {
        let t = f64::from(i) / RATE;
        let direction = if t < 1.0 {
            Direction::Approach
        } else {
            Direction::Retract
        };
        Point {
            line: u64::from(i) + 1,
            abscissa: depth(t) - 2e-7,
            ordinate: 0.0,
            direction: Some(direction),
        }
    });
    plan.times = (0..1024_u32).map(|i| f64::from(i) / RATE).collect();
    plan.measurement.points = points.collect();
    plan.contact_point = 0.0;
    let mut made = with_noise(&plan, 1e-3, 1);
    for point in &mut made.measurement.points {
        point.abscissa = (point.abscissa / STEP).round() * STEP;
    }
    let found = fit_all(&[made], &free_of(&POWER_LAW[..2])).expect("sound");
    assert!(found.converged, "{:?}", found.warnings);
    let modulus = off(&found, FilmModulus, 2e3);
    assert!(modulus.abs() < 4.0, "{modulus}");
}
