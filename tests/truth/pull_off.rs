//! Pull-offs with an attraction of finite range: in the limit of short ranges those of JKR with their
//! correction of first order, and otherwise the lowest value of a scan of all states.

use acceptance::{assert_names, cases, larger, paper_system, rigid_probe, rows, solid, system_of};
use contact::{CohesiveZone, Contact, Control};
use interp::{Probe, System};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use solve::cohesive::{Cohesive, CohesiveState};
use std::f64::consts::PI;

/// Bodies with an attraction, and what is imposed on them.
#[derive(Clone)]
struct Case {
    system: System,
    work_of_adhesion: f64,
    range: f64,
    control: Control,
}

impl Case {
    fn imposed(&self, state: &CohesiveState) -> f64 {
        self.control.imposed(state.load, state.penetration)
    }

    fn sphere_radius(&self) -> f64 {
        let Probe::Paraboloid { radius } = self.system.probe else {
            unreachable!("all probes are paraboloids")
        };
        radius
    }

    fn cohesive(&self) -> Cohesive {
        Cohesive::new(&self.system, None, self.work_of_adhesion, self.range).expect("physical")
    }

    /// Returns the contact without range, from solves of its own.
    fn jkr(&self) -> Contact {
        let material = self.system.material().expect("physical");
        let largest = 0.9 * self.sphere_radius() / self.system.film_thickness;
        let curve = solve::curve(&material, [1e-5, largest.min(1e3)], 1e-9).expect("within reach");
        Contact::new(&self.system, curve).expect("its curve")
    }

    fn cohesive_zone(&self) -> CohesiveZone {
        CohesiveZone {
            stress: self.work_of_adhesion / self.range,
        }
    }
}

/// A random film and sphere, soft or stiff, confined or not, with the length `zone` of its zone over
/// the contact radius of JKR without load on a half-space of the film.
fn random(seed: u64, zone: [f64; 2]) -> Case {
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    let mut uniform = |from: f64, to: f64| from + (to - from) * random.random::<f64>();
    let mut log_uniform = |from: f64, to: f64| uniform(from.ln(), to.ln()).exp();
    let radius = log_uniform(1e-7, 1e-2);
    let young = log_uniform(1e5, 1e10);
    let base = young * log_uniform(1e-2, 1e5);
    let sphere = young * log_uniform(1e-1, 1e4);
    let w = log_uniform(1e-3, 0.3);
    let thin = log_uniform(3e-3, 10.0);
    let zone = log_uniform(zone[0], zone[1]);
    let spring = log_uniform(1e-2, 1e2);
    let poisson = [0.5, 0.49, 0.3, 0.45, 0.0][(seed % 5) as usize];
    let sphere = if seed.is_multiple_of(2) {
        f64::INFINITY
    } else {
        sphere
    };
    let film = solid(young, poisson);
    let es = 1.0 / (1.0 / film.reduced() + 1.0 / sphere);
    let scale = (4.5 * PI * w * radius * radius / es).cbrt();
    // l = (pi/4) es w/sigma0^2
    let range = w / (0.25 * PI * es * w / (zone * scale)).sqrt();
    let control = match seed % 3 {
        0 => Control::Load,
        1 => Control::Displacement,
        _ => Control::Spring {
            stiffness: es * scale * spring,
        },
    };
    Case {
        system: system_of(
            Probe::Paraboloid { radius },
            sphere,
            film,
            scale * thin,
            solid(base, 0.25),
        ),
        work_of_adhesion: w,
        range: range.min(0.1 * radius),
        control,
    }
}

/// Soft confined films far thinner than the contact without load is wide, whose pull-off under an
/// imposed displacement is at a radius below the thickness. The difference from JKR is of first order
/// in the length of the zone, which is of second order in the range.
#[test]
fn the_pull_off_of_soft_confined_films_tends_to_that_of_jkr() {
    let rigid = |radius, film, thickness, base| {
        rigid_probe(
            Probe::Paraboloid { radius },
            film,
            thickness,
            solid(base, 0.25),
        )
    };
    let glass = System {
        sphere_modulus: solid(7e10, 0.25).reduced(),
        ..rigid(3.734e-3, solid(9.9e6, 0.5), 1.24e-7, 1.47e11)
    };
    let cases = [
        (
            rigid(9.5e-4, solid(2.65e7, 0.49), 2.6e-8, 5.9e10),
            0.0184,
            4.2e-10,
        ),
        (glass, 0.062, 4e-10),
    ];
    for (system, work_of_adhesion, first) in cases {
        for control in [Control::Displacement, Control::Spring { stiffness: 1e5 }] {
            let excess = [1.0, 0.25, 0.0625].map(|factor| {
                let case = Case {
                    system: system.clone(),
                    work_of_adhesion,
                    range: factor * first,
                    control,
                };
                let jkr = case
                    .jkr()
                    .pull_off(work_of_adhesion, control)
                    .expect("a pull-off");
                let jkr = control.imposed(jkr.load, jkr.penetration);
                let found = case.cohesive().pull_off(control).expect("solved");
                case.imposed(&found) / jkr - 1.0
            });
            assert!(excess[0].abs() < 0.02, "{excess:?}");
            let ratio = excess[1] / excess[2];
            assert!((ratio / 16.0 - 1.0).abs() < 0.1, "{excess:?}");
        }
    }
}

/// How a pull-off compares with the correction of first order in the zone, from curves of JKR.
enum Compared {
    /// The relative difference, and the zone over the shortest length of the contact.
    Differs(f64, f64),
    /// Wider than is solved, or nearly as wide as the sphere.
    OutOfReach,
    /// A confined film pulls harder inside than the attraction can, or rises against the sphere beside
    /// the contact: the state is not one disc.
    NoDisc,
    /// JKR has no pull-off there.
    None,
}

fn compared(seed: u64, case: &Case) -> Compared {
    let jkr = case.jkr();
    let Ok(short) = jkr.cohesive_zone(case.work_of_adhesion, case.cohesive_zone()) else {
        return Compared::None;
    };
    let Ok(state) = short.pull_off(case.control) else {
        return Compared::None;
    };
    match case.cohesive().pull_off(case.control) {
        Ok(found) => {
            let shortest = case.system.film_thickness.min(state.contact_radius);
            let [value, expected] = [found, state].map(|state| case.imposed(&state));
            Compared::Differs((value / expected - 1.0).abs(), short.zone() / shortest)
        }
        Err(solve::Error::PullOffReach { .. }) => {
            let wide = state.outer_radius / case.system.film_thickness;
            let of_sphere = state.contact_radius / case.sphere_radius();
            assert!(
                wide > 80.0 || of_sphere > 0.6,
                "{seed}: {wide}, {of_sphere}"
            );
            Compared::OutOfReach
        }
        Err(solve::Error::NotAContact { what, .. })
            if what.contains("open there") || what.contains("not between 0 and the range") =>
        {
            println!("{seed}: {what}");
            Compared::NoDisc
        }
        Err(error) => panic!("{seed}: {error}"),
    }
}

/// Random films, spheres and controls with a short zone: the correction of first order leaves an error
/// of second order. Where it exceeds the square of the zone, it falls with the fourth power of the
/// range, which is the square of the zone.
#[test]
fn pull_offs_of_short_ranges_are_those_of_the_first_order() {
    let (mut count, mut refused, mut no_disc, mut above, mut worst) = (0, 0, 0, 0, 0.0);
    for seed in 0..cases(250) {
        let case = random(seed, [1e-5, 0.1]);
        match compared(seed, &case) {
            Compared::None => continue,
            Compared::OutOfReach => refused += 1,
            Compared::NoDisc => no_disc += 1,
            Compared::Differs(error, zone) => {
                count += 1;
                worst = larger(worst, error / (zone * zone + 1e-8));
                if error < zone * zone + 1e-8 {
                    continue;
                }
                above += 1;
                // At some ranges between, the contact is not one disc.
                let shorter = [0.5, 0.25, 0.125].into_iter().find_map(|factor: f64| {
                    let range = factor * case.range;
                    match compared(
                        seed,
                        &Case {
                            range,
                            ..case.clone()
                        },
                    ) {
                        Compared::Differs(smaller, _) => Some((factor, smaller)),
                        _ => None,
                    }
                });
                let Some((factor, smaller)) = shorter else {
                    panic!("{seed}: {error:e} at the zone {zone:.1e}");
                };
                assert!(
                    smaller < 2.0 * factor.powi(4) * error,
                    "{seed}: {error:e}, then {smaller:e} at {factor} of the range"
                );
            }
        }
    }
    println!("{count} {refused} {no_disc} {above} {worst:.2}");
    assert!(count > 100, "{count}");
    assert!(100 * no_disc < count, "{no_disc}");
    assert!(worst < 10.0, "{worst}");
}

/// Of all states of a fine scan, in contact and before it, none has a lower imposed value than the
/// pull-off, and the lowest is near it. Zones from a hundredth of the contact to ten times as long.
#[test]
fn no_state_is_lower_than_the_pull_off() {
    const STEP: f64 = 0.04;
    let (mut scanned, mut without_contact) = (0, 0);
    for seed in 1000..1000 + cases(20) {
        let case = random(seed, [1e-2, 10.0]);
        let cohesive = case.cohesive();
        let Ok(found) = cohesive.pull_off(case.control) else {
            continue;
        };
        let value = case.imposed(&found);
        let middle = if found.contact_radius > 0.0 {
            found.contact_radius
        } else {
            without_contact += 1;
            found.outer_radius
        };
        let radii = (-60..60).map(|i| middle * (STEP * f64::from(i)).exp());
        let contacts = radii.clone().filter_map(|a| cohesive.state(a).ok());
        let before = radii.filter_map(|c| cohesive.without_contact(c).ok());
        let lowest = contacts
            .chain(before)
            .map(|state| case.imposed(&state))
            .fold(f64::INFINITY, f64::min);
        let above = (lowest - value) / value.abs();
        assert!(
            (-1e-9..2e-3).contains(&above),
            "{seed}: {value:e}, {lowest:e}"
        );
        scanned += 1;
    }
    assert!(2 * scanned > cases(20), "{scanned}");
    assert!(without_contact > 0);
}

/// All lengths a thousand times as large at the same moduli.
#[test]
fn scales_change_nothing() {
    let mut compared = 0;
    for seed in 2000..2012 {
        let case = random(seed, [1e-3, 3.0]);
        let Ok(found) = case.cohesive().pull_off(case.control) else {
            continue;
        };
        let factor = 1e3;
        let system = System {
            probe: Probe::Paraboloid {
                radius: factor * case.sphere_radius(),
            },
            film_thickness: factor * case.system.film_thickness,
            ..case.system.clone()
        };
        let control = match case.control {
            Control::Spring { stiffness } => Control::Spring {
                stiffness: factor * stiffness,
            },
            other => other,
        };
        let (w, range) = (factor * case.work_of_adhesion, factor * case.range);
        let large = Cohesive::new(&system, None, w, range)
            .and_then(|large| large.pull_off(control))
            .unwrap_or_else(|e| panic!("{seed}: {e}"));
        let scaled = control.imposed(large.load, large.penetration);
        let expected = case.imposed(&found)
            * match control {
                Control::Load => factor * factor,
                _ => factor,
            };
        assert!(
            (scaled / expected - 1.0).abs() < 1e-8,
            "{seed}: {scaled:e}, {expected:e}"
        );
        compared += 1;
    }
    assert!(compared >= 6, "{compared}");
}

/// The refusal of a contact wider than is solved names lengths of the bodies, not a radius that nobody
/// gave.
#[test]
fn a_pull_off_beyond_the_reach_names_the_layer() {
    let system = paper_system(1e-7);
    for control in [Control::Load, Control::Displacement] {
        let cohesive = Cohesive::new(&system, None, 0.04, 1e-10).expect("physical");
        let error = cohesive
            .pull_off(control)
            .expect_err("too wide")
            .to_string();
        assert_names(&error, "pull-off; 1e-7 m; 1.200e-5 m; JKR");
        assert!(!error.contains("contact radius"), "{error}");
    }
}

/// A sphere that is smaller than its contact would be: a larger one helps, and a thicker layer does not.
#[test]
fn a_pull_off_as_wide_as_the_sphere_names_the_sphere() {
    // Film and substrate of one material, and a film on a stiffer one.
    for (base, radius, range) in [(1e6, 1e-6, 6e-7), (2e6, 1e-7, 5e-8)] {
        for film_thickness in [1e-6, 1e-4] {
            let pull_off = |radius: f64| {
                let [film, base] = [1e6, base].map(|young| solid(young, 0.5));
                let system = rigid_probe(Probe::Paraboloid { radius }, film, film_thickness, base);
                let cohesive = Cohesive::new(&system, None, 0.05, range).expect("physical");
                cohesive.pull_off(Control::Load)
            };
            let error = pull_off(radius).expect_err("too wide");
            let words = format!(
                "wider than {:.3e} m; radius of the sphere; larger sphere",
                0.9 * radius
            );
            assert_names(&error.to_string(), &words);
            pull_off(100.0 * radius).expect("narrow");
        }
    }
}

/// Contacts of a rigid sphere of 10 um that are far smaller than the attraction around them: what is imposed; modulus,
/// Poisson ratio and thickness of the film, modulus of its substrate, work of adhesion and range. In the last one the
/// annulus of a contact four times as large is another one.
const LONG_RANGES: &str = "
    displacement | 5.85e10 | 0.5 | 1.87e-7 | 1.21e4 | 5.6e-3 | 1.63e-9
    load | 3.31e8 | 0.187 | 9.73e-6 | inf | 2.57e-3 | 3.26e-8
    load | 3e9 | 0.309 | 3.78e-8 | inf | 1.09e-2 | 2.49e-8
    spring | 1.54e10 | 0.256 | 7.02e-8 | 3.96e6 | 2.52e-2 | 3.4e-8
    displacement | 2.3354e6 | 0.3 | 1.3172e-8 | inf | 6.48e-3 | 3.928e-9
";

/// The lowest imposed value may be that of a contact a hundred times smaller than the attraction around it, lower than
/// before the contact by some 1e-5 of itself.
#[test]
fn no_contact_is_below_the_pull_off() {
    for [imposed, numbers @ ..] in rows::<7>(LONG_RANGES) {
        let control = match imposed {
            "load" => Control::Load,
            "displacement" => Control::Displacement,
            _ => Control::Spring { stiffness: 0.0456 },
        };
        let [young, poisson, thickness, base, work_of_adhesion, range] =
            numbers.map(|number| number.parse().expect("a number"));
        let probe = Probe::Paraboloid { radius: 1e-5 };
        let case = Case {
            system: rigid_probe(probe, solid(young, poisson), thickness, solid(base, 0.25)),
            work_of_adhesion,
            range,
            control,
        };
        let (cohesive, imposed) = (case.cohesive(), |at: &CohesiveState| case.imposed(at));
        let pull_off = cohesive.pull_off(control).expect("within reach");
        let (lowest, outer) = (imposed(&pull_off), pull_off.outer_radius);
        let radius = pull_off.contact_radius;
        println!("{control:?}: {lowest} at {radius} of {outer}");
        assert!(radius > 0.0);
        // The radii of the attraction before the contact end at that of the first one.
        let before = (1..=100)
            .map(|i| outer * 1e-2 * f64::from(i))
            .map_while(|c| cohesive.without_contact(c).ok())
            .map(|state| imposed(&state));
        assert!(before.fold(f64::INFINITY, f64::min) > lowest);
        let mut solved = 0;
        for i in 0..70 {
            let Ok(state) = cohesive.state(outer * 10f64.powf(-3.0 + 0.05 * f64::from(i))) else {
                continue;
            };
            solved += 1;
            let value = imposed(&state);
            assert!(
                value >= lowest + 1e-9 * lowest,
                "{control:?}: {value} at {}, below {lowest} at {radius}",
                state.contact_radius
            );
        }
        assert!(solved > 40, "{solved} states");
    }
}
