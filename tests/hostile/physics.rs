//! Properties of the results of any contact in the embedded table's box: signs, order and units.

use contact::{CohesiveZone, Contact, Control};
use interp::{Elastic, Material, Parameter, Probe, System, Table};
use proptest::prelude::*;

use crate::config;

/// Generates powers of ten with exponents in `range`.
fn magnitude(range: std::ops::RangeInclusive<f64>) -> impl Strategy<Value = f64> {
    range.prop_map(|exponent| 10_f64.powf(exponent))
}

/// Generates any material in the box of the embedded table.
fn material() -> impl Strategy<Value = Material> {
    (magnitude(-2.99..=2.99), 0.0..=0.5, magnitude(0.01..=5.99))
        .prop_map(|(e1, nu1, e0)| Material::new(e1, nu1, e0, 0.25).expect("physical"))
}

/// Generates any system with such a material, with thickness and modulus within nine decades. The
/// sphere is wider than any contact in the table.
fn system() -> impl Strategy<Value = System> {
    let lengths = (
        magnitude(3.0..=9.0),
        magnitude(-9.0..=0.0),
        magnitude(0.0..=9.0),
    );
    (material(), lengths).prop_map(|(material, (spheres, film_thickness, sphere_modulus))| {
        let solid =
            |ratio: f64, poisson| Elastic::new(ratio * sphere_modulus, poisson).expect("physical");
        let film = solid(material.e1_over_e2(), material.nu1());
        let substrate = solid(material.e0_over_e2(), material.nu0());
        System {
            probe: Probe::Paraboloid {
                radius: spheres * film_thickness,
            },
            sphere_modulus,
            film,
            film_thickness,
            substrate,
        }
    })
}

proptest! {
    #![proptest_config(config(300))]

    #[test]
    fn the_value_of_a_coordinate_is_the_parameter(modulus in magnitude(-30.0..=30.0), nu in -1.0..=0.5) {
        for parameter in Parameter::ALL {
            let (value, size) = if parameter == Parameter::Nu1 { (nu, 1.0) } else { (modulus, modulus) };
            let again = parameter.value(parameter.coordinate(value));
            prop_assert!((again - value).abs() < 2e-14 * size, "{}: {again} instead of {value}", parameter.name());
        }
    }

    /// Adhesion lowers load and penetration, and their energy release rate is the work of adhesion.
    #[test]
    fn adhesion_pulls_and_its_energy_is_released(system in system(), x in magnitude(-2.99..=2.99), pull in magnitude(-3.0..=1.0)) {
        let contact = Contact::in_table(Table::embedded(), &system).expect("in the box");
        let a = x * system.film_thickness;
        let bare = contact.load_and_penetration(a, 0.0).expect("in the box");
        prop_assert!(bare.0 > 0.0 && bare.1 > 0.0, "{bare:?}");
        // `pull` is the edge singularity over the adhesionless load per radius.
        let edge = pull * bare.0 / a;
        let w = contact.mechanics().energy_release_rate(a, edge);
        let (load, penetration) = contact.load_and_penetration(a, w).expect("in the box");
        prop_assert!(load < bare.0 && penetration < bare.1, "{load}, {penetration} with adhesion, {bare:?} without");
        let more = contact.load(a, 1.5 * w).expect("in the box");
        prop_assert!(more < load, "{more} with more adhesion, {load} with less");
        for released in [contact.energy_release_rate_at_load(a, load), contact.energy_release_rate_at_penetration(a, penetration)] {
            let released = released.expect("in the box");
            prop_assert!((released / w - 1.0).abs() < 1e-12, "{released} of {w}");
        }
        // Where the flat punch takes a small part, it and the radius have few digits of it.
        let part = ((bare.1 - penetration) / bare.1).min(1.0);
        let (radius, released) = contact.radius_and_energy_release_rate(load, penetration).expect("in the box");
        let errors = [(radius / a - 1.0) * part, (released / w - 1.0) * part * part];
        prop_assert!(errors.iter().all(|error| error.abs() < 1e-11), "{errors:?} at {part}");
    }

    /// A rigid machine separates a contact later than a spring, and a spring later than a dead
    /// weight. At separation the edge is in equilibrium.
    #[test]
    fn a_stiffer_machine_separates_later(system in system(), x in magnitude(-2.0..=2.0), stiffness in magnitude(-3.0..=3.0)) {
        let contact = Contact::in_table(Table::embedded(), &system).expect("in the box");
        let a = x * system.film_thickness;
        // This work of adhesion balances the adhesionless load at this radius, so that the radii of
        // separation are near it.
        let bare = contact.load(a, 0.0).expect("in the box");
        let w = contact.mechanics().energy_release_rate(a, bare / a);
        let stiffness = stiffness * contact.stiffness(a).expect("in the box");
        let controls = [Control::Load, Control::Spring { stiffness }, Control::Displacement];
        let separations = controls.map(|control| contact.pull_off(w, control));
        for state in separations.iter().flatten() {
            let released = contact.energy_release_rate_at_load(state.contact_radius, state.load).expect("in the box");
            prop_assert!((released / w - 1.0).abs() < 1e-13 && state.load < 0.0, "{state:?} releases {released} of {w}");
        }
        for pair in separations.windows(2) {
            let [Ok(softer), Ok(stiffer)] = pair else { continue };
            prop_assert!(softer.load <= stiffer.load && softer.penetration >= stiffer.penetration, "{softer:?}, {stiffer:?}");
        }
        // A finite range makes the pull-off load larger, by about what it says to first order.
        if let [Ok(jkr), ..] = separations {
            let zone = 0.05 * jkr.contact_radius.min(contact.system().expect("a film").film_thickness);
            let modulus = contact.mechanics().sphere_film_modulus();
            let stress = (0.25 * std::f64::consts::PI * modulus * w / zone).sqrt();
            let attraction = contact.cohesive_zone(w, CohesiveZone { stress }).expect("a short zone");
            if let Ok(state) = attraction.pull_off(Control::Load) {
                let range = contact.zone_size(w, w / stress).expect("physical");
                let told = range.pull_off_error().expect("a short zone");
                let excess = state.load / jkr.load - 1.0;
                prop_assert!(excess > 0.0 && (told / excess - 1.0).abs() < 0.1, "{told}, {excess}");
                prop_assert!(state.contact_radius < jkr.contact_radius && state.outer_radius > jkr.contact_radius);
            }
        }
        if let Ok(rest) = contact.zero_load(w) {
            prop_assert!(rest.load.abs() < 1e-11 * bare, "{rest:?}");
            let (radius, released) =
                contact.radius_and_energy_release_rate(rest.load, rest.penetration).expect("in the box");
            prop_assert!((radius / rest.contact_radius - 1.0).abs() < 1e-13 && (released / w - 1.0).abs() < 1e-12);
        }
    }

    /// The results scale with the units of length and modulus.
    #[test]
    fn other_units_change_nothing(
        system in system(),
        x in magnitude(-2.0..=2.0),
        pull in magnitude(-2.0..=1.0),
        length in magnitude(-6.0..=6.0),
        modulus in magnitude(-6.0..=6.0),
    ) {
        let solid = |solid: Elastic| Elastic::new(modulus * solid.young(), solid.poisson()).expect("physical");
        let radius = system.probe.radius().expect("a paraboloid");
        let scaled = System {
            probe: Probe::Paraboloid { radius: length * radius },
            sphere_modulus: modulus * system.sphere_modulus,
            film: solid(system.film),
            film_thickness: length * system.film_thickness,
            substrate: solid(system.substrate),
        };
        let [one, other] = [&system, &scaled].map(|system| Contact::in_table(Table::embedded(), system).expect("in the box"));
        let a = x * system.film_thickness;
        let bare = one.load(a, 0.0).expect("in the box");
        let w = one.mechanics().energy_release_rate(a, pull * bare / a);
        let stiffness = [(&one, a), (&other, length * a)].map(|(contact, a)| contact.stiffness(a).expect("in the box"));
        prop_assert!((stiffness[1] / (length * modulus * stiffness[0]) - 1.0).abs() < 1e-12, "{stiffness:?}");
        let (one, other) = (one.load_and_penetration(a, w), other.load_and_penetration(length * a, length * modulus * w));
        let (one, other) = (one.expect("in the box"), other.expect("in the box"));
        let (load, penetration) = (length * length * modulus * one.0, length * one.1);
        prop_assert!((other.0 - load).abs() < 1e-12 * length * length * modulus * bare * (1.0 + pull), "{other:?}, not {load}");
        prop_assert!((other.1 - penetration).abs() < 1e-12 * length * (one.1.abs() + a * a / radius), "{other:?}, not {penetration}");
    }

}
