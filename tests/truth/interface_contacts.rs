//! Limits of contacts on films that slide, or that springs join.

use std::f64::consts::{FRAC_PI_2, PI};

use acceptance::{Refused, layer, springs, stack};
use contact::Contact;
use interp::Quantities;
use solve::stack::{Interface, Stack};
use solve::{solve_stack, stack_curve};

use crate::interface_limits::{INFINITY, film, rigid, solved};

/// The first order of small contacts of a film that slides on a rigid base, `Eeq/es = 1 + (es/e1)
/// 0.743302500450015 x`, at any Poisson ratio: extrapolated from two radii. Measured: 1.6e-6.
#[test]
fn small_contacts_of_a_sliding_film_grow_with_the_known_constant() {
    for nu in [0.5, 0.2] {
        for sphere in [INFINITY, 1.0] {
            let stack = film(rigid(), (2.0, nu), Interface::Sliding);
            let material = stack.material(sphere).expect("physical");
            let es = material.sphere_film_modulus();
            let rate = |x: f64| {
                (solved(x, &stack, sphere).eeq / es - 1.0) / x * material.film_modulus() / es
            };
            // The next order is a constant times x.
            let constant = 4.0 / 3.0 * (rate(1e-3) - 0.25 * rate(4e-3));
            let error = constant / 0.743_302_500_450_015 - 1.0;
            println!("nu = {nu}: {error:.1e}");
            assert!(error.abs() <= 1e-5);
        }
    }
}

/// Springs of the stiffness `E1*/t` under a rigid sphere, with an edge correction: `Eeq = (pi/2)(x
/// + c)`, `Gamma^2 = pi (x + c/2)`, `Delta0 = 1/2 + c/(2x)`, `Pi0 = (pi/2)(x + 2c)`, `c = 0.3543`.
/// The order left out falls like `1/x`.
#[test]
fn wide_contacts_of_a_sliding_film_on_a_rigid_base_are_springs() {
    const C: f64 = 0.3543;
    let stack = film(rigid(), (2.0, 0.4), Interface::Sliding);
    for x in [100.0, 400.0] {
        let Quantities {
            pi0,
            eeq,
            gamma,
            delta0,
        } = solve_stack(x, &stack, INFINITY, 1e-9)
            .expect("within reach")
            .quantities;
        let found = [
            eeq / FRAC_PI_2 - x,
            2.0 * (gamma * gamma / PI - x),
            2.0 * x * (delta0 - 0.5),
            0.5 * (pi0 / FRAC_PI_2 - x),
        ];
        assert!(found.iter().all(|c| (c - C).abs() <= 1.0 / x), "{found:?}");
    }
}

/// Returns `Eeq` under a rigid sphere.
fn stiffness(x: f64, stack: &Stack) -> f64 {
    let solution = solve_stack(x, stack, INFINITY, 1e-8).expect("within reach");
    solution.quantities.eeq
}

/// Bonded over sliding `Eeq` of one film under a rigid punch on a rigid base, to the digits of the
/// table that was computed by another program.
#[test]
fn the_effect_of_sliding_is_that_of_the_table() {
    let radii = [0.1, 0.3, 1.0, 3.0, 10.0];
    let table = [
        (0.5, [1.043, 1.152, 1.646, 3.43, 15.5]),
        (0.3, [1.014, 1.047, 1.130, 1.184, 1.212]),
    ];
    for (nu, factors) in table {
        let [bonded, sliding] =
            [Interface::Bonded, Interface::Sliding].map(|one| film(rigid(), (1.0, nu), one));
        for (x, factor) in radii.into_iter().zip(factors) {
            let [bonded, sliding] = [&bonded, &sliding].map(|stack| stiffness(x, stack));
            let found = bonded / sliding;
            let unit = if factor < 2.0 {
                1e-3
            } else if factor < 10.0 {
                1e-2
            } else {
                0.1
            };
            assert!(
                (found - factor).abs() <= 0.51 * unit,
                "{x}: {found} {factor}"
            );
        }
    }
    // The way from sliding (0) to bonded (1).
    let springs_at = |kt: f64, nu: f64, x: f64| {
        let reduced = 1.0 / (1.0 - nu * nu);
        let of = |one| stiffness(x, &film(rigid(), (1.0, nu), one));
        let (sliding, bonded) = (of(Interface::Sliding), of(Interface::Bonded));
        (of(springs(kt * reduced, INFINITY)) - sliding) / (bonded - sliding)
    };
    for (nu, x, ways) in [
        (0.5, 1.0, [0.03, 0.17, 0.61, 0.93, 0.99]),
        (0.5, 10.0, [0.03, 0.17, 0.61, 0.93, 0.99]),
        (0.3, 1.0, [0.03, 0.19, 0.63, 0.94, 0.99]),
        (0.3, 10.0, [0.30, 0.71, 0.94, 0.99, 1.00]),
    ] {
        for (kt, way) in [0.01, 0.1, 1.0, 10.0, 100.0].into_iter().zip(ways) {
            let found = springs_at(kt, nu, x);
            assert!(
                (found - way).abs() <= 0.0101,
                "{nu} {x} {kt}: {found} {way}"
            );
        }
    }
}

/// What a contact says of a stack that is not bonded, and how wide it may be.
#[test]
fn a_film_that_slides_has_no_compressibility_and_has_the_reach_of_stacks() {
    let sliding = film(rigid(), (1.0, 0.5), Interface::Sliding);
    assert!(sliding.compressibility().is_nan());
    let curve = stack_curve(&sliding, INFINITY, [0.1, 10.0], 1e-8).expect("within reach");
    let contact = Contact::new(&sliding.system(1e3, INFINITY), curve).expect("its own curve");
    let validity = contact.validity(5.0).expect("a radius");
    assert!(validity.film.expect("a film").compressibility.is_nan());
    // Beyond the nodes nothing continues the curve.
    assert!(contact.load(20.0, 0.1).is_err());

    assert!(solve_stack(1000.0, &sliding, INFINITY, 1e-4).is_ok());
    let beyond = solve_stack(1000.1, &sliding, INFINITY, 1e-4);
    beyond.refused("out of reach of this stack of one layer");
    let bonded = stack(rigid(), &[layer(1.0, 0.5, 1.0)]);
    assert!(solve_stack(1000.1, &bonded, INFINITY, 1e-4).is_ok());
}
