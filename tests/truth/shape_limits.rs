//! Shapes of probes at their limits: derivatives below the nodes, and the flank of a rounded cone.

use acceptance::{on_half_space, rigid_probe, rounded_cone, solid};
use contact::{Contact, Input};
use interp::{Probe, Table};

#[test]
fn derivatives_below_the_nodes_under_a_sphere_are_differences() {
    // At the first node the contact has half the radius of the sphere.
    let system = |radius: f64, young: f64| {
        let probe = Probe::Sphere { radius };
        rigid_probe(probe, solid(young, 0.4), 1e-3, solid(1e9, 0.3))
    };
    let first = 1e-3 * Table::embedded().axis(interp::Parameter::AOverT)[0];
    let [radius, young] = [2e-6, 1e6];
    let all = Contact::in_table_with_gradient(Table::embedded(), &system(radius, young));
    let all = all.expect("inside");
    for part in [0.03, 0.3, 0.9] {
        let a = part * first;
        let inputs = [Input::FilmModulus, Input::SphereRadius];
        let mut found = [contact::Derivatives::ZERO; 2];
        all.derivatives(a, 0.0, &inputs, &mut found)
            .expect("inside");
        let at = |radius: f64, young: f64| {
            let moved = Contact::in_table(Table::embedded(), &system(radius, young));
            let moved = moved.expect("inside");
            moved.load_and_penetration(a, 0.0).expect("inside")
        };
        let pairs = [1.001, 0.999].map(|x| [at(radius, x * young), at(x * radius, young)]);
        for (i, size) in [young, radius].into_iter().enumerate() {
            let [above, below] = pairs.map(|pair| pair[i]);
            let by = |difference: f64| difference / (2e-3 * size);
            let by_load = found[i].load / by(above.0 - below.0);
            assert!((by_load - 1.0).abs() < 1e-5, "{part}, {i}");
            let by_penetration = found[i].penetration / by(above.1 - below.1);
            assert!((by_penetration - 1.0).abs() < 5e-3, "{part}, {i}");
        }
    }
}

#[test]
fn the_flank_of_a_rounded_cone_has_the_slope_of_the_cone() {
    let half_angle = 60_f64.to_radians();
    let probe = rounded_cone(1e-6, half_angle);
    // 1/tan(60 deg); the flank begins at 0.577 um.
    for (a, slope) in [(5e-7, 0.5), (2e-6, 1.0 / 3.0_f64.sqrt())] {
        let contact = on_half_space(probe.clone(), solid(1e6, 0.3));
        let validity = contact.validity(a).expect("in range");
        assert!(
            (validity.a_over_r / slope - 1.0).abs() < 1e-14,
            "{validity:?}"
        );
    }
}
