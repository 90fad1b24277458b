//! Pull-offs under a long range, whose contact is far smaller than the attraction around it.

use acceptance::{rigid_probe, solid};
use contact::Control;
use interp::Probe;
use solve::cohesive::{Cohesive, CohesiveState};

/// A film under a rigid sphere of 10 um, with its attraction, and what is imposed. SI units.
struct Separation {
    control: Control,
    film: [f64; 2],
    thickness: f64,
    base_modulus: f64,
    work_of_adhesion: f64,
    range: f64,
}

const SEPARATIONS: [Separation; 5] = [
    Separation {
        control: Control::Displacement,
        film: [5.85e10, 0.5],
        thickness: 1.87e-7,
        base_modulus: 1.21e4,
        work_of_adhesion: 5.6e-3,
        range: 1.63e-9,
    },
    Separation {
        control: Control::Load,
        film: [3.31e8, 0.187],
        thickness: 9.73e-6,
        base_modulus: f64::INFINITY,
        work_of_adhesion: 2.57e-3,
        range: 3.26e-8,
    },
    Separation {
        control: Control::Load,
        film: [3e9, 0.309],
        thickness: 3.78e-8,
        base_modulus: f64::INFINITY,
        work_of_adhesion: 1.09e-2,
        range: 2.49e-8,
    },
    Separation {
        control: Control::Spring { stiffness: 0.0456 },
        film: [1.54e10, 0.256],
        thickness: 7.02e-8,
        base_modulus: 3.96e6,
        work_of_adhesion: 2.52e-2,
        range: 3.4e-8,
    },
    // The annulus of a contact four times as large is another one.
    Separation {
        control: Control::Displacement,
        film: [2.3354e6, 0.3],
        thickness: 1.3172e-8,
        base_modulus: f64::INFINITY,
        work_of_adhesion: 6.48e-3,
        range: 3.928e-9,
    },
];

/// The lowest imposed value may be that of a contact a hundred times smaller than the attraction around it, lower than
/// before the contact by some 1e-5 of itself.
#[test]
fn no_contact_is_below_the_pull_off() {
    for separation in &SEPARATIONS {
        let [young, poisson] = separation.film;
        let system = rigid_probe(
            Probe::Paraboloid { radius: 1e-5 },
            solid(young, poisson),
            separation.thickness,
            solid(separation.base_modulus, 0.25),
        );
        let cohesive = Cohesive::new(&system, separation.work_of_adhesion, separation.range)
            .expect("physical");
        let control = separation.control;
        let imposed = |at: &CohesiveState| control.imposed(at.load, at.penetration);
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
