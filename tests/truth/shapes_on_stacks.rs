//! Probes of other shapes on layers: what follows from the flat punch at all smaller radii, against direct solves.

use acceptance::{Contacts, larger, layer, on_half_space, power_law, solid, stack};
use contact::Contact;
use interp::{Probe, System};
use solve::{solve_stack_power_laws, stack_curve};

use crate::interfaces::random_stack;

/// The exponents of the direct solves.
const EXPONENTS: [f64; 8] = [1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0, 10.0];

/// A cone, three powers, and a sphere of ten times the contact radius `a`, each with the coefficients of the powers that
/// it is a sum of. The power `r^12` of the sphere is negligible.
fn probes(a: f64) -> [(Probe, [f64; 8]); 5] {
    let coefficients = |pairs: &[(f64, f64)]| {
        EXPONENTS.map(|n| {
            let of_power = pairs.iter().find(|&&(exponent, _)| exponent == n);
            of_power.map_or(0.0, |&(_, unitless)| unitless * a.powf(1.0 - n))
        })
    };
    let power = |n: f64| {
        let of = coefficients(&[(n, 0.1)]);
        (power_law(0.1 * a.powf(1.0 - n), n), of)
    };
    let half_angle = 70_f64.to_radians();
    let sphere = [0.5, 0.125, 0.0625, 0.0390625, 0.02734375];
    let powers = [2.0, 4.0, 6.0, 8.0, 10.0].into_iter().zip(sphere);
    let of_sphere: Vec<(f64, f64)> = powers
        .map(|(n, factor)| (n, factor * 0.1_f64.powf(n - 1.0)))
        .collect();
    [
        (
            Probe::Cone { half_angle },
            coefficients(&[(1.0, half_angle.tan().recip())]),
        ),
        power(1.5),
        power(3.0),
        power(4.0),
        (Probe::Sphere { radius: 10.0 * a }, coefficients(&of_sphere)),
    ]
}

/// Layers of extreme moduli, thicknesses and Poisson ratios, most of which slide or have springs, under probes of three
/// stiffnesses. The solves share the compliance with the curve, and nothing of the integrals.
///
/// Measured with 1500 stacks, with curves to 1e-8: 1.2e-7 for the cone, 5.5e-8 for `r^1.5`, 4e-9 for `r^3` and `r^4`, and
/// 1e-8 for the sphere.
#[test]
fn shapes_on_random_layers_are_direct_solves() {
    const ALLOWED: [f64; 5] = [3e-7, 3e-7, 1e-8, 1e-8, 3e-8];
    let mut draw = Contacts::new(61);
    let (mut worst, mut count) = ([0.0; 5], 0);
    for i in 0..150 {
        let stack = random_stack(&mut draw);
        let (thickness, top) = (stack.thickness(), stack.shape().top);
        let modulus = [1.0, f64::INFINITY, 1e-3][i % 3];
        let x = top * draw.log_uniform(1e-2, 300.0);
        let unit = if modulus.is_finite() {
            modulus
        } else {
            stack.top().solid.reduced()
        };
        let truth = solve_stack_power_laws(x, &stack, modulus, &EXPONENTS, 1e-10);
        let curve = stack_curve(&stack, modulus, [1e-3 * top, 1.5 * x], 1e-8);
        let (Ok((_, truth)), Ok(curve)) = (truth, curve) else {
            continue;
        };
        let a = x * thickness;
        for (worst, (probe, coefficients)) in worst.iter_mut().zip(probes(a)) {
            let (mut load, mut penetration) = (0.0, 0.0);
            for ((c, n), truth) in coefficients.into_iter().zip(EXPONENTS).zip(&truth) {
                if c > 0.0 {
                    // The penetration of the power on a half-space is `c kappa_n a^n`.
                    let bare = on_half_space(power_law(c, n), solid(1.0, 0.0));
                    let (_, scale) = bare.load_and_penetration(a, 0.0).expect("in range");
                    load += 0.5 * scale * a * unit * truth.pi;
                    penetration += scale * truth.delta;
                }
            }
            let system = System {
                probe,
                ..stack.system(1.0, modulus)
            };
            let contact = Contact::new(&system, curve.clone()).expect("its own curve");
            let found = contact.load_and_penetration(a, 0.0).expect("in range");
            *worst = larger(*worst, (found.0 / load - 1.0).abs());
            *worst = larger(*worst, (found.1 / penetration - 1.0).abs());
        }
        count += 1;
    }
    println!("{count} stacks: {worst:?}");
    assert!(count > 120);
    for (worst, allowed) in worst.into_iter().zip(ALLOWED) {
        assert!(worst < allowed, "{worst:.1e}");
    }
}

/// By an independent program: the impedance of the layers by exponentials of the equations of elasticity, from the base up,
/// and Nystrom's method with 220 points. Its own error is about 1e-8 under the cone.
#[test]
fn cones_and_spheres_on_two_layers_are_those_of_an_independent_program() {
    let skin = stack(
        solid(f64::INFINITY, 0.0),
        &[layer(1e4, 0.45, 1e-5), layer(1e7, 0.3, 5e-7)],
    );
    let coating = stack(
        solid(2e11, 0.25),
        &[layer(5e5, 0.499, 2.5e-6), layer(3.5e6, 0.499, 7.5e-6)],
    );
    let half_angle = 70_f64.to_radians();
    let probes = [Probe::Cone { half_angle }, Probe::Sphere { radius: 2e-4 }];
    // The contact radius over the thickness of the top layer; load and penetration of the cone, and of the sphere.
    let values = [
        (
            &skin,
            [
                (
                    0.3,
                    [
                        [1.2905129900e-7, 1.0840270844e-6],
                        [2.2579409962e-10, 1.8587849042e-9],
                    ],
                ),
                (
                    2.0,
                    [
                        [3.0429718228e-7, 2.5584094587e-6],
                        [4.8833226389e-9, 3.6250720779e-8],
                    ],
                ),
                (
                    8.0,
                    [
                        [4.2931853753e-7, 2.8541859453e-6],
                        [3.0998129841e-8, 1.3576227757e-7],
                    ],
                ),
            ],
        ),
        (
            &coating,
            [
                (
                    0.3,
                    [
                        [1.3422590604e-5, 1.1998789655e-6],
                        [3.5221713444e-7, 2.3041628010e-8],
                    ],
                ),
                (
                    2.0,
                    [
                        [8.3452399350e-4, 5.6611869285e-6],
                        [1.4353183512e-4, 6.2238100402e-7],
                    ],
                ),
                (
                    8.0,
                    [
                        [6.9744907580e-2, 1.8656665432e-5],
                        [4.4142476006e-2, 7.2435142734e-6],
                    ],
                ),
            ],
        ),
    ];
    let mut worst = [0.0; 2];
    for (stack, contacts) in values {
        let top = stack.shape().top;
        let curve = stack_curve(stack, f64::INFINITY, [1e-3 * top, 12.0 * top], 1e-9);
        let curve = curve.expect("within reach");
        for (x, of_probes) in contacts {
            for ((worst, probe), truth) in worst.iter_mut().zip(&probes).zip(of_probes) {
                let system = System {
                    probe: probe.clone(),
                    ..stack.system(1.0, f64::INFINITY)
                };
                let contact = Contact::new(&system, curve.clone()).expect("its own curve");
                let a = x * top * stack.thickness();
                let found = contact.load_and_penetration(a, 0.0).expect("in range");
                *worst = larger(*worst, (found.0 / truth[0] - 1.0).abs());
                *worst = larger(*worst, (found.1 / truth[1] - 1.0).abs());
            }
        }
    }
    println!("cone {:.1e}, sphere {:.1e}", worst[0], worst[1]);
    assert!(worst[0] <= 3e-8 && worst[1] <= 3e-9, "{worst:?}");
}
