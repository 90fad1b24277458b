//! Probes on films that are stiffer than their substrates.

use acceptance::{
    flat_ended_cone, looked_up, power_law, rigid_probe, rounded_cone, solid, system_of,
};
use contact::{Contact, Control};
use interp::{Probe, System};

/// The probe on a film of 1 um and 1 GPa, `contrast` times as stiff as its substrate.
fn on_stiff_film(probe: Probe, contrast: f64) -> System {
    rigid_probe(probe, solid(1e9, 0.2), 1e-6, solid(1e9 / contrast, 0.3))
}

/// Every contact is among those at its own penetration.
#[test]
fn no_equilibrium_is_missed() {
    let half_angle = 70_f64.to_radians();
    let probes = [
        Probe::Cone { half_angle },
        rounded_cone(2e-7, half_angle),
        flat_ended_cone(5e-8, half_angle),
        power_law(10.0, 1.2),
        Probe::Paraboloid { radius: 1e-4 },
    ];
    let mut falling = 0;
    for (probe, contrast) in probes
        .iter()
        .flat_map(|probe| [30.0, 300.0, 1e4].map(|c| (probe, c)))
    {
        let contact = looked_up(&on_stiff_film(probe.clone(), contrast));
        let penetration = |a: f64| contact.load_and_penetration(a, 0.0).expect("in range").1;
        let equilibria = contact
            .equilibria(0.0, Control::Displacement)
            .expect("in range");
        for i in 0..60 {
            let a = 8e-8 * 1e3_f64.powf(f64::from(i) / 60.0);
            let at = equilibria.at(penetration(a)).expect("in range");
            let is_it = |found: f64| (found / a - 1.0).abs() < 1e-6;
            assert!(
                at.iter().any(|one| is_it(one.state.contact_radius)),
                "{probe:?}, contrast {contrast}: {a:.4e} is not in {at:?}"
            );
            falling += u32::from(penetration(1.001 * a) < penetration(a));
        }
    }
    assert!(
        falling > 20,
        "{falling} contacts lie where the penetration falls"
    );
}

/// The smallest load at any radius, here that of the flat end, is that of the pull-off, also where the radius of the flat end has
/// so many digits that its logarithm rounds.
#[test]
fn the_pull_off_of_a_flat_ended_cone_does_not_depend_on_rounding() {
    for radius in [2.146283024914619e-5, 2.146283e-5] {
        let half_angle = 50_f64.to_radians();
        let system = system_of(
            Probe::FlatEndedCone { radius, half_angle },
            29.74e9,
            solid(1e9, 0.3),
            1e-6,
            solid(6.8557e6, 0.45),
        );
        let contact = looked_up(&system);
        let load = |a: f64| contact.load_and_penetration(a, 0.04).expect("in range").0;
        let radii = (0..3000).map(|i| radius * 20_f64.powf(f64::from(i) / 3000.0));
        let least = radii.map(load).fold(f64::INFINITY, f64::min);
        let found = contact.pull_off(0.04, Control::Load).expect("there").load;
        assert!(
            found < 0.0 && (found / least - 1.0).abs() < 1e-9,
            "{found}, {least}"
        );
    }
}

/// A sphere so soft that numbers overflow has no state, and no NaN.
#[test]
fn a_punch_without_stiffness_is_refused() {
    let bodies = interp::HalfSpace {
        probe: Probe::FlatPunch { radius: 7e-6 },
        sphere_modulus: 1e-310,
        solid: solid(1e7, 0.3),
    };
    let state = Contact::half_space(&bodies).and_then(|contact| contact.zero_load(0.02));
    assert!(state.is_err(), "{state:?}");
}
