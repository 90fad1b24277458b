//! A stack of layers answers what a film answers; what would assume one film is an error, or is of
//! all layers.

use acceptance::{assert_matches, layer, paper_system, power_law, solid, solved_contact, stack};
use contact::{Contact, Error};
use interp::{Probe, Quantity, System};
use solve::stack::{Interface, Layer, Stack};
use solve::stack_curve;

const RADIUS: f64 = 1e-3;
const SPHERE: f64 = 2e6;
const W: f64 = 0.04;
/// The ends of the curves, m.
const RADII: [f64; 2] = [5e-6, 2e-4];

/// An elastomer on a softer primer on silicon, 100 um together.
fn two_layers() -> Stack {
    let layers = [layer(5e5, 0.49, 2.5e-5), layer(3.5e6, 0.5, 7.5e-5)];
    stack(solid(2e11, 0.25), &layers)
}

fn contact(stack: &Stack) -> Contact {
    let range = RADII.map(|a| a / stack.thickness());
    let curve = stack_curve(stack, SPHERE, range, 1e-10).expect("within reach");
    Contact::new(&stack.system(RADIUS, SPHERE), curve).expect("the curve of this stack")
}

/// Film bias is redefined only in name: it is relative to the bare base.
#[test]
fn the_film_bias_of_a_stack_is_that_of_all_layers() {
    let contact = contact(&two_layers());
    let radii = [4e-5, 1.3e-4];
    let bias = contact.film_bias(W, radii, 15).expect("a compliant sphere");
    let fit = contact.jkr_fit(W, radii, 15).expect("in range");
    let bare = contact.mechanics().sphere_substrate_modulus();
    let expected = 1.0 / (1.0 / SPHERE + 1.0 / solid(2e11, 0.25).reduced());
    assert!((bare / expected - 1.0).abs() <= 1e-14);
    assert_eq!(bias.modulus, fit.modulus / bare - 1.0);
    // A softer primer makes the coating softer than the film alone.
    let alone = paper_system(1e-4);
    let film = solved_contact(&alone, RADII.map(|a| a / 1e-4), 1e-8);
    let of_film = film.film_bias(W, radii, 15).expect("a compliant sphere");
    assert!(bias.modulus < of_film.modulus && of_film.modulus < 0.0);
}

#[test]
fn beyond_its_ends_and_for_derivatives_of_one_film_the_curve_of_a_stack_is_an_error() {
    let contact = contact(&two_layers());
    let curve = contact.curve().expect("a stack has one");
    for a in [0.9 * RADII[0], 1.1 * RADII[1]] {
        for error in [
            curve
                .quantity(Quantity::Eeq, a / 1e-4)
                .expect_err("beyond")
                .into(),
            contact.load(a, W).expect_err("beyond"),
        ] {
            assert_matches!(error, Error::Table(interp::Error::OutsideTable { .. }));
        }
    }
    let error = contact.gradient(5e-5, W).expect_err("none");
    assert_matches!(error, Error::Table(interp::Error::NoGradient));
}

/// Springs below a film take part of the penetration from it, in any unit of length.
#[test]
fn the_strain_beside_springs_does_not_depend_on_the_unit_of_length() {
    let strain = |unit: f64, stiffness: f64| {
        let film = Layer {
            interface: Interface::Springs {
                tangential: stiffness / unit,
                normal: stiffness / unit,
            },
            ..layer(1e6, 0.4, 1e-4 * unit)
        };
        let stack = stack(solid(f64::INFINITY, 0.25), &[film]);
        let curve = stack_curve(&stack, SPHERE, [0.1, 2.0], 1e-8).expect("within reach");
        let system = stack.system(RADIUS * unit, SPHERE);
        let contact = Contact::new(&system, curve).expect("the curve of this stack");
        let validity = contact.validity(1e-4 * unit).expect("in range");
        validity.film.expect("layers").strain
    };
    let [in_metres, in_millimetres] = [1.0, 1e3].map(|unit| strain(unit, 1e10));
    assert!((in_millimetres / in_metres - 1.0).abs() < 1e-12);
    assert!((0.1..0.9).contains(&(in_metres / strain(1.0, 1e15))));
}

/// Springs in series over squeeze flow, integrated numerically; and the formula for one film.
#[test]
fn compressibility_is_that_of_all_layers() {
    let (soft, stiff) = ((1e6, 0.4), (3e6, 0.49));
    let two = stack(
        solid(f64::INFINITY, 0.25),
        &[layer(soft.0, soft.1, 3e-5), layer(stiff.0, stiff.1, 7e-5)],
    );
    // Heights and thickness in units of t.
    const STEPS: u32 = 100_000;
    let dz = 1.0 / f64::from(STEPS);
    let (mut series, mut velocity, mut flux) = (0.0, 0.0, 0.0);
    for i in 0..STEPS {
        let z = (f64::from(i) + 0.5) * dz;
        let (young, nu) = if z < 0.3 { soft } else { stiff };
        let g = young / (2.0 * (1.0 + nu));
        series += dz * (1.0 - 2.0 * nu) / (2.0 * (1.0 - nu) * g);
        // Lubrication: the shear stress is (1 - z) dp/dr from the frictionless top, the sideways
        // displacement its integral from the base, and the flux the integral of that.
        velocity += dz * (1.0 - z) / g;
        flux += dz * velocity;
    }
    // The flux of one film is t^3/(3 G), its stiffness 3 pi G a^4/(8 t^3).
    let expected = series / (8.0 * flux);
    let found = two.compressibility();
    println!("compressibility: {found}, by integration {expected}");
    assert!((found / expected - 1.0).abs() <= 1e-4);

    let film = stack(
        solid(1e9, 0.3),
        &[layer(1e6, 0.4, 2e-5), layer(1e6, 0.4, 5e-5)],
    );
    assert!((film.compressibility() / (3.0 / 16.0 * 0.2 / 0.6) - 1.0).abs() <= 1e-14);
    // Beside a cohesive zone its layers are one.
    assert_eq!(film.shape().top, 1.0);
    let contact = contact(&two_layers());
    let validity = contact
        .validity(1e-4)
        .expect("in range")
        .film
        .expect("layers");
    let expected = two_layers().compressibility() * validity.a_over_t.powi(2);
    assert!((validity.compressibility / expected - 1.0).abs() <= 1e-14);
}

/// Under a flat punch a program that lets the contact be any set of rings found loads smaller by 4.2 %, 10.9 % and 3.5 % than
/// those of a disc, on a stiff layer on a soft one on a rigid base, and the same load on a thin soft one that keeps its volume.
/// At the last radius it is smaller by 0.3 %.
#[test]
fn a_stiff_layer_that_bends_under_a_flat_punch_is_told_of() {
    for (young, poisson, thickness, interface, a_over_top, is_told) in [
        (1e7, 0.3, 5.0, Interface::Bonded, 3.0, true),
        (1e8, 0.5, 5.0, Interface::Bonded, 3.0, true),
        (1e7, 0.5, 5.0, Interface::Sliding, 3.0, true),
        (1e7, 0.5, 0.3, Interface::Bonded, 3.0, false),
        (1e7, 0.3, 5.0, Interface::Bonded, 1.0, false),
    ] {
        let top = 2e-6;
        let stiff = Layer {
            interface,
            ..layer(young, 0.3, top)
        };
        let layers = [layer(1e5, poisson, thickness * top), stiff];
        let stack = stack(solid(f64::INFINITY, 0.0), &layers);
        let radius = a_over_top * top;
        let system = System {
            probe: Probe::FlatPunch { radius },
            ..stack.system(1e-3, f64::INFINITY)
        };
        let range = [0.5, 1.5].map(|of| of * radius / stack.thickness());
        let curve = stack_curve(&stack, f64::INFINITY, range, 1e-8).expect("converges");
        let contact = Contact::new(&system, curve).expect("its own curve");
        let film = contact
            .validity(radius)
            .expect("in range")
            .film
            .expect("layers");
        assert_eq!(
            film.no_disc, is_told,
            "{young:e} {poisson} {thickness} {a_over_top}"
        );
    }
}

/// A film that is taken as a stack: its bending length is found from its compliance.
#[test]
fn a_stack_of_one_film_bends_as_the_film() {
    const RANGE: [f64; 2] = [1e-3, 100.0];
    let (mut none, mut count) = (0, 0);
    for contrast in [1.0, 10.0, 100.0, 1e3, 1e4, 1e5] {
        let stack = stack(solid(1.0, 0.3), &[layer(contrast, 0.3, 1.0)]);
        let system = stack.system(1.0, f64::INFINITY);
        let material = system.material().expect("physical");
        let curves = [
            stack_curve(&stack, f64::INFINITY, RANGE, 1e-8),
            solve::curve(&material, RANGE, 1e-8),
        ]
        .map(|curve| curve.expect("within reach"));
        for a_over_t in [0.05, 0.2, 0.5, 1.0, 2.0, 5.0, 15.0, 40.0] {
            let (radius, half_angle) = (0.5 * a_over_t, 1.2);
            for probe in [
                Probe::Cone { half_angle },
                Probe::FlatEndedCone { radius, half_angle },
                power_law(0.1, 6.0),
            ] {
                let name = probe.name();
                let system = System {
                    probe,
                    ..system.clone()
                };
                let [of_stack, of_film] = curves.clone().map(|curve| {
                    let contact = Contact::new(&system, curve).expect("its own curve");
                    let validity = contact.validity(a_over_t).expect("in range");
                    validity.film.expect("layers")
                });
                let place = format!("{name}, {contrast:e}, {a_over_t}");
                assert_eq!(of_stack.no_disc, of_film.no_disc, "{place}");
                if a_over_t < 3.9 * (contrast / 6.0).cbrt() && a_over_t <= 5.0 {
                    let [of_stack, of_film] = [of_stack, of_film].map(|film| film.bending);
                    let is_alike = (of_stack - of_film).abs() <= 0.1 * of_film + 1e-9;
                    assert!(is_alike, "{place}: {of_stack:e}, {of_film:e}");
                }
                count += 1;
                none += u32::from(of_film.no_disc);
            }
        }
    }
    println!("{none} of {count} contacts are no discs");
    assert!((30..count - 30).contains(&none));
}

/// The thin layers of a graded film are no plates, though the surface is stiffer than what lies below it.
#[test]
fn a_graded_film_does_not_bend() {
    let at = |height: f64| solid(1e6 * (3.0 * height / 1e-4).exp(), 0.3);
    let graded = Stack::graded(at(0.0), 1e-4, 100, at).expect("physical");
    let curve = stack_curve(&graded, f64::INFINITY, [0.01, 2.0], 1e-6).expect("within reach");
    let system = graded.system(RADIUS, f64::INFINITY);
    let contact = Contact::new(&system, curve).expect("its own curve");
    for a in [1e-5, 5e-5, 2e-4] {
        let film = contact.validity(a).expect("in range").film;
        assert_eq!(film.expect("layers").bending, 0.0, "{a}");
    }
}
