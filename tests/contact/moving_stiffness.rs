//! The slope of the force curve, against differences of the curve and closed forms.

use acceptance::{
    assert_matches, larger, looked_up, on_half_space, paper_system, slopes, solid, system_of,
};
use contact::{Contact, Error};
use interp::Probe;

use crate::shapes::shapes;

/// Returns `dF/d delta` along the force curve, by differences.
fn by_differences(contact: &Contact, a: f64, w: f64) -> f64 {
    let [load, penetration] = slopes(5e-3 * a, |change| {
        let at = contact.load_and_penetration(a + change, w);
        at.expect("in range").into()
    });
    load / penetration
}

/// The paper's sphere on a film of 30 um, by differences of force curves of an independent program.
#[test]
fn the_sphere_of_the_paper_has_the_slopes_of_independent_curves() {
    let contact = looked_up(&paper_system(3e-5));
    for (a, expected, digits) in [
        (4e-5, -0.33, 5e-3),
        (6e-5, 0.463, 5e-4),
        (1e-4, 0.791, 5e-4),
        (1.3e-4, 0.866, 5e-4),
    ] {
        let pinned = contact.stiffness(a).expect("in range");
        let moving = contact.moving_stiffness(a, 0.04).expect("in range");
        assert!(
            (moving / pinned - expected).abs() < digits,
            "{a:e}: {}",
            moving / pinned
        );
    }
}

/// Without adhesion the slope is the stiffness of the flat punch.
#[test]
fn every_shape_has_the_slope_of_its_force_curve() {
    let mut worst: f64 = 0.0;
    let films = [
        (5e7, solid(3.5e6, 0.49), 5e-6, solid(2e11, 0.25)),
        (f64::INFINITY, solid(1e8, 0.2), 2e-6, solid(1e6, 0.4)),
    ];
    for (probe, (sphere_modulus, film, film_thickness, substrate)) in shapes()
        .into_iter()
        .flat_map(|probe| films.map(|film| (probe.clone(), film)))
    {
        let system = system_of(
            probe.clone(),
            sphere_modulus,
            film,
            film_thickness,
            substrate,
        );
        let bare = Contact::half_space(&system.without_film()).expect("physical");
        for contact in [looked_up(&system), bare] {
            for (a, w) in [6e-6, 9e-6, 1.3e-5]
                .into_iter()
                .flat_map(|a| [0.0, 1e-3, 0.04].map(|w| (a, w)))
            {
                let moving = contact.moving_stiffness(a, w).expect("in range");
                let pinned = contact.stiffness(a).expect("in range");
                let by_curve = by_differences(&contact, a, w);
                let miss = (moving - by_curve).abs() / moving.abs().max(pinned);
                assert!(miss < 3e-6, "{probe:?}, {a:e}, {w}: {moving} {by_curve}");
                assert!(w != 0.0 || moving == pinned, "{probe:?}");
                worst = larger(worst, miss);
            }
        }
    }
    println!("largest miss {worst:e}");
}

/// A small work of adhesion changes `K` by little: `K - S` keeps its digits, as a ratio of
/// differences of force curves would not.
#[test]
fn a_vanishing_work_of_adhesion_leaves_the_pinned_stiffness() {
    let contact = looked_up(&paper_system(1e-5));
    let a = 8e-5;
    let pinned = contact.stiffness(a).expect("in range");
    let lost = |w: f64| (pinned - contact.moving_stiffness(a, w).expect("in range")) / w.sqrt();
    // `S - K` goes as the root of `w`.
    let [one, other] = [lost(1e-12), lost(1e-16)];
    assert!(
        one > 0.0 && (one / other - 1.0).abs() < 1e-3,
        "{one} {other}"
    );
}

#[test]
fn a_flat_punch_and_a_wrong_radius_are_refused() {
    let punch = on_half_space(Probe::FlatPunch { radius: 1e-5 }, solid(1e6, 0.3));
    for w in [0.0, 0.04] {
        let error = punch.moving_stiffness(1e-5, w).expect_err("it cannot move");
        assert_matches!(error, Error::Table(interp::Error::OtherProbe { .. }));
    }
    let sphere = on_half_space(Probe::Paraboloid { radius: 1e-5 }, solid(1e6, 0.3));
    for (a, w) in [(2e-5, 0.04), (-1e-6, 0.04), (1e-6, -0.04), (f64::NAN, 0.0)] {
        assert!(sphere.moving_stiffness(a, w).is_err(), "{a} {w}");
    }
}
