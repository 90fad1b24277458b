//! Exact identities and limits of layers that slide or are joined by springs.

use std::f64::consts::{FRAC_PI_2, LN_2, PI};

use acceptance::{
    larger, layer, random_stack, relative_error, solid, springs, stack, with_interfaces,
};
use contact::Contact;
use interp::{Elastic, Quantities};
use solve::stack::{Interface, Layer, Stack};
use solve::{Error, solve_stack, stack_curve};
use solve::{LayeredCompliance, Method, SurfaceCompliance};

use crate::identities::with_derivatives;

const INFINITY: f64 = f64::INFINITY;

fn rigid() -> Elastic {
    solid(INFINITY, 0.25)
}

/// Returns one film on a base.
fn film(base: Elastic, (young, poisson): (f64, f64), interface: Interface) -> Stack {
    with_interfaces(base, &[(layer(young, poisson, 1.0), interface)])
}

/// Returns `X(k)` of a stack, with the wave number in 1/m.
fn compliance(stack: &Stack) -> impl Fn(f64) -> f64 + use<> {
    let top = stack.layers().last().expect("a layer").thickness;
    let compliance = LayeredCompliance::new(stack);
    move |k| compliance.x(k * top)
}

fn wave_numbers() -> impl Iterator<Item = f64> {
    (0..=60).map(|i| 10_f64.powf(-7.0 + 0.15 * f64::from(i)))
}

/// Returns the largest relative difference of `X` of two stacks.
fn apart(a: &Stack, b: &Stack) -> f64 {
    let (a, b) = (compliance(a), compliance(b));
    wave_numbers().fold(0.0, |worst, k| larger(worst, (a(k) / b(k) - 1.0).abs()))
}

fn solved(x: f64, stack: &Stack, sphere: f64) -> Quantities {
    let solution = solve_stack(x, stack, sphere, 1e-12);
    solution.unwrap_or_else(|e| panic!("{e}")).quantities
}

/// Replaces all interfaces of a random stack.
fn joined(seed: u64, interface: Interface) -> Stack {
    let (stack, _) = random_stack(seed);
    let layers = stack.layers().iter().map(|&layer| (layer, interface));
    with_interfaces(stack.base(), &layers.collect::<Vec<_>>())
}

#[test]
fn the_ends_of_the_springs_are_bonded_and_sliding_bit_for_bit() {
    for seed in 0..60 {
        for (ends, plain) in [
            (springs(INFINITY, INFINITY), Interface::Bonded),
            (springs(0.0, INFINITY), Interface::Sliding),
        ] {
            let [ends, plain] = [ends, plain].map(|interface| joined(seed, interface));
            assert_eq!(ends, plain);
            let [a, b] = [&ends, &plain].map(LayeredCompliance::new);
            for q in wave_numbers() {
                let [a, b] = [&a, &b].map(|c| [c.sample(q).excess, c.sample(q).slope, c.x(q)]);
                assert_eq!(a.map(f64::to_bits), b.map(f64::to_bits));
            }
            let top = plain.layers().last().expect("a layer").thickness;
            let a_over_t = 0.7 * top / plain.thickness();
            let [a, b] = [&ends, &plain].map(|stack| {
                solve_stack(a_over_t, stack, 1e6, 1e-6)
                    .expect("within reach")
                    .quantities
            });
            assert_eq!(a, b);
        }
    }
    // What the words mean for one film, which is solved as a film where it is bonded.
    let bonded = film(solid(7.0, 0.2), (1.0, 0.3), springs(INFINITY, INFINITY));
    let plain = stack(solid(7.0, 0.2), &[layer(1.0, 0.3, 1.0)]);
    assert_eq!(solved(2.0, &bonded, 1.0), solved(2.0, &plain, 1.0));
}

/// Stiffnesses of 1e60 and 1e-60 times a modulus. Measured: 1.7e-15 and 2.6e-15.
#[test]
fn the_ends_of_the_springs_are_limits() {
    let (mut stiff, mut soft) = (0.0, 0.0);
    for seed in 0..200 {
        let bonded = joined(seed, Interface::Bonded);
        stiff = larger(stiff, apart(&joined(seed, springs(1e60, 1e60)), &bonded));
        let sliding = joined(seed, Interface::Sliding);
        soft = larger(
            soft,
            apart(&joined(seed, springs(1e-60, INFINITY)), &sliding),
        );
    }
    println!("stiff springs {stiff:.1e}, soft springs {soft:.1e}");
    assert!(stiff <= 1e-14 && soft <= 1e-14);
}

/// The closed form of one sliding film on a half-space, `r = E1*/E0*`:
///
/// ```text
/// X = [cosh 2q - 1 + r (sinh 2q + 2q)] / [sinh 2q + 2q + r (cosh 2q - 1 - 2q^2)]
/// ```
///
/// No Poisson ratio but through `E*`. Measured: 6.7e-16.
#[test]
fn one_sliding_film_has_its_closed_form() {
    let mut worst = 0.0;
    for r in [0.0, 1e-8, 0.03, 1.0, 40.0, 1e5] {
        for (nu1, nu0) in [(0.5, 0.3), (0.2, 0.5), (-0.9, -0.4)] {
            let base = if r == 0.0 {
                rigid()
            } else {
                solid((1.0 - nu0 * nu0) / r, nu0)
            };
            let young = 1.0 - nu1 * nu1;
            let x = compliance(&film(base, (young, nu1), Interface::Sliding));
            for q in (0..50).map(|i| 0.3 + 0.4 * f64::from(i)) {
                let p = 2.0 * q;
                // `cosh p - 1 - p^2/2` by its series where it is small.
                let rest: f64 = if p < 2.0 {
                    let mut term = p.powi(4) / 24.0;
                    let mut sum = 0.0;
                    for n in 0..12 {
                        sum += term;
                        term *= p * p / f64::from((2 * n + 5) * (2 * n + 6));
                    }
                    sum
                } else {
                    p.cosh() - 1.0 - 0.5 * p * p
                };
                let square = 2.0 * q.sinh().powi(2);
                let expected = (square + r * (p.sinh() + p)) / (p.sinh() + p + r * rest);
                worst = larger(worst, (x(q) / expected - 1.0).abs());
            }
        }
    }
    println!("closed form of one sliding film: {worst:.1e}");
    assert!(worst <= 5e-15);
}

/// The equal moduli that make a bonded film a half-space do not make a sliding one.
#[test]
fn a_sliding_film_of_the_material_of_the_base_is_no_half_space() {
    use Interface::{Bonded, Sliding};
    let base = solid(2.0, 0.3);
    let sliding = film(base, (2.0, 0.3), Sliding);
    let solution = solve_stack(0.5, &sliding, 1.0, 1e-10).expect("within reach");
    assert_eq!(solution.method, Method::Galerkin);
    let bonded = stack(base, &[layer(2.0, 0.3, 1.0)]);
    let hertz = solve_stack(0.5, &bonded, 1.0, 1e-10).expect("in closed form");
    assert_eq!(hertz.method, Method::ClosedForm);
    assert!(solution.quantities.eeq < 0.99 * hertz.quantities.eeq);

    // Merging stops at interfaces, and goes on above and below them.
    let cut = |interfaces: [Interface; 4]| {
        let part = layer(2.0, 0.3, 0.25);
        with_interfaces(base, &interfaces.map(|interface| (part, interface)))
    };
    let divided = cut([Bonded, Bonded, Sliding, Bonded]);
    let halves = with_interfaces(
        base,
        &[
            (layer(2.0, 0.3, 0.5), Bonded),
            (layer(2.0, 0.3, 0.5), Sliding),
        ],
    );
    let single = film(base, (2.0, 0.3), Sliding);
    let a = solved(1.0, &divided, 1.0);
    assert!(relative_error(&a, &solved(1.0, &halves, 1.0)) <= 1e-13);
    // Half a film on a half-space, at the same radius.
    assert!(relative_error(&a, &solved(2.0, &single, 1.0)) <= 1e-13);
    let whole = cut([Sliding, Bonded, Bonded, Bonded]);
    assert!(relative_error(&solved(1.0, &whole, 1.0), &solved(1.0, &single, 1.0)) <= 1e-13);
    assert!(relative_error(&a, &solved(1.0, &cut([Sliding; 4]), 1.0)) > 1e-3);
}

/// `kappa_i = (1-2nu_i)/((1-nu_i) E_i*)` of a group of layers between sliding interfaces, shifted by
/// a constant of the group at fixed `E_i*`. Measured: 1.3e-15.
#[test]
fn each_group_between_sliding_interfaces_has_a_constant_of_dundurs() {
    let kappa = |s: Elastic| (1.0 - 2.0 * s.poisson()) / ((1.0 - s.poisson()) * s.reduced());
    let shifted = |s: Elastic, shift: f64| {
        let k = (kappa(s) + shift) * s.reduced();
        let poisson = (1.0 - k) / (2.0 - k);
        solid(s.reduced() * (1.0 - poisson * poisson), poisson)
    };
    let below = [
        (layer(3.0, 0.3, 0.4), Interface::Bonded),
        (layer(0.7, 0.2, 0.3), springs(2.0, 5.0)),
    ];
    let above = [
        (layer(5.0, 0.25, 0.2), Interface::Sliding),
        (layer(1.0, 0.1, 0.5), springs(0.3, INFINITY)),
    ];
    let of = |base: f64, top: f64| {
        let shift = |part: [(Layer, Interface); 2], by: f64| {
            part.map(|(one, interface)| {
                (
                    Layer::bonded(shifted(one.solid, by), one.thickness),
                    interface,
                )
            })
        };
        let layers = [shift(below, base), shift(above, top)].concat();
        with_interfaces(shifted(solid(2.0, 0.35), base), &layers)
    };
    let given = of(0.0, 0.0);
    let mut worst = 0.0;
    for (base, top) in [(0.05, 0.0), (0.0, 0.06), (-0.1, 0.03), (0.1, -0.05)] {
        worst = larger(worst, apart(&given, &of(base, top)));
    }
    println!("groups with shifted Poisson ratios: {worst:.1e}");
    assert!(worst <= 1e-14);
    // A constant that is not the same in a group changes X.
    let other = [below, shift_one(above)].concat();
    assert!(apart(&given, &with_interfaces(solid(2.0, 0.35), &other)) > 1e-3);
}

/// Changes the Poisson ratio of the upper of two layers at a fixed `E*`.
fn shift_one([lower, (upper, interface)]: [(Layer, Interface); 2]) -> [(Layer, Interface); 2] {
    let reduced = upper.solid.reduced();
    let poisson: f64 = 0.45;
    let changed = solid(reduced * (1.0 - poisson * poisson), poisson);
    [lower, (Layer::bonded(changed, upper.thickness), interface)]
}

/// Returns the slope of `X` at wave number 0 (per 1/m): sums over groups between sliding interfaces.
fn slope_at_zero(stack: &Stack) -> f64 {
    let base = stack.base();
    let s = (1.0 - 2.0 * base.poisson()) * (1.0 + base.poisson()) / base.young();
    // The sums `h l` and `h e G` of the group, of which the lowest one is known.
    let (mut total, mut group): (f64, Option<[f64; 2]>) = (0.0, None);
    let close = |group: Option<[f64; 2]>| group.map_or(0.0, |[l, e]| l * l / e);
    for Layer {
        solid,
        thickness,
        interface,
    } in stack.layers()
    {
        let nu = solid.poisson();
        let shear = solid.young() / (2.0 * (1.0 + nu));
        let (b, l, e) = (
            (1.0 - 2.0 * nu) / (2.0 * (1.0 - nu)),
            nu / (1.0 - nu),
            2.0 / (1.0 - nu),
        );
        let [tangential, normal] = interface.stiffnesses();
        total += normal.recip();
        if tangential == 0.0 {
            total += close(group);
            group = Some([0.0; 2]);
        }
        total += thickness * b / shear;
        match &mut group {
            None => total -= thickness * (2.0 * l * s + e * shear * s * s),
            Some([of_l, of_e]) => {
                *of_l += thickness * l;
                *of_e += thickness * e * shear;
            }
        }
    }
    0.5 * stack.surface().reduced() * (total + close(group))
}

/// Stacks of every kind of interface, on an elastic or a rigid base.
fn samples(base: Elastic) -> Vec<Stack> {
    use Interface::{Bonded, Sliding};
    let of = |interfaces: [Interface; 3]| {
        let parts = [
            layer(1.0, 0.4, 0.3),
            layer(0.2, 0.45, 0.5),
            layer(5.0, 0.25, 0.2),
        ];
        let layers: Vec<_> = parts.into_iter().zip(interfaces).collect();
        with_interfaces(base, &layers)
    };
    vec![
        film(base, (2.0, 0.3), Sliding),
        film(base, (2.0, 0.4), springs(0.5, INFINITY)),
        film(base, (2.0, 0.3), springs(0.5, 3.0)),
        of([Sliding, Bonded, Bonded]),
        of([Bonded, Sliding, Bonded]),
        of([Bonded, springs(2.0, 1.0), Sliding]),
        of([Sliding, Sliding, Sliding]),
    ]
}

/// `X = E_N*/E_0* + k X1` on an elastic base, `X = k X1` on a rigid one: einf is the same for every
/// interface. The next order, some 10 k, is left out.
#[test]
fn long_waves_feel_the_base_and_the_groups_of_layers() {
    for base in [solid(3.0, 0.3), solid(0.5, 0.5), rigid()] {
        for stack in samples(base) {
            let x = compliance(&stack);
            let limit = stack.surface().reduced() / base.reduced();
            let slope = slope_at_zero(&stack);
            for k in [1e-5, 1e-6] {
                let found = (x(k) - limit) / k;
                let allowed = (100.0 * k).max(2e-15 / k * limit);
                assert!(
                    (found - slope).abs() <= allowed * slope.abs().max(1.0),
                    "{found} is not {slope} at {k:e}: {stack:?}"
                );
            }
        }
    }
    // One sliding film: half its thickness, on every base and at every Poisson ratio.
    for (base, nu) in [(rigid(), 0.5), (rigid(), -0.5), (solid(40.0, 0.1), 0.3)] {
        let slope = slope_at_zero(&film(base, (1.7, nu), Interface::Sliding));
        assert!((slope - 0.5).abs() <= 1e-12);
    }
}

/// `X = r/(1 + r q^3/6)` of a film that is 1e6 times as stiff as the base it slides on, with a
/// relative order of `q` left out.
#[test]
fn a_stiff_sliding_film_is_a_free_plate() {
    let r = 1e6;
    let x = compliance(&film(solid(1.0 / r, 0.0), (1.0, 0.0), Interface::Sliding));
    for q in [1e-4_f64, 3e-3, 1e-2, 0.02] {
        let plate = r / (1.0 + r * q.powi(3) / 6.0);
        assert!(
            (x(q) / plate - 1.0).abs() <= 0.1 * q,
            "{q}: {} {plate}",
            x(q)
        );
    }
}

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
        println!("c at {x}: {found:?}");
        assert!(found.iter().all(|c| (c - C).abs() <= 1.0 / x), "{found:?}");
    }
}

/// The first order in `t/a` on an elastic base, with `X1` of the groups.
#[test]
fn wide_contacts_approach_the_bare_base_with_the_slope_of_the_groups() {
    const C0: f64 = LN_2 + 0.577_215_664_901_532_9;
    let sphere = 2.0;
    for stack in samples(solid(3.0, 0.3)) {
        let material = stack.material(sphere).expect("physical");
        let limit = material.thin_film_limit();
        let a = limit.eeq * slope_at_zero(&stack) / (PI * material.film_modulus());
        let remainders = [40.0, 120.0].map(|x: f64| {
            let q = solve_stack(x, &stack, sphere, 1e-9)
                .expect("within reach")
                .quantities;
            let bracket = |offset: f64| a * (x.ln() + C0 - offset);
            // `C` by each quantity.
            let c = [
                x * (1.0 - q.eeq / limit.eeq) - bracket(0.0),
                x * (1.0 - q.pi0 / limit.pi0) / 3.0 - bracket(1.0),
                x * (1.0 - q.delta0) / 2.0 - bracket(2.0),
            ];
            let of_gamma = q.gamma / limit.gamma - 1.0 + a / (2.0 * x);
            [of_gamma, (c[0] - c[1]) / x, (c[0] - c[2]) / x].map(f64::abs)
        });
        // `(ln x/x)^2` falls to 0.19.
        let [near, far] = remainders.map(|all| all.into_iter().fold(0.0, f64::max));
        assert!(far <= 0.25 * near + 1e-8, "{remainders:?}: {stack:?}");
    }
}

/// A layer of glue that becomes thinner, `kt = G/d`, `kn = 2 G (1 - nu)/((1 - 2 nu) d)` with both
/// kept: its contact comes to that of the springs in proportion to its thickness.
#[test]
fn a_layer_of_glue_comes_to_springs_in_proportion_to_its_thickness() {
    let contacts = [
        (0.5, rigid(), 0.5, 1.0),
        (0.4, solid(50.0, 0.3), 0.3, 0.7),
        (0.5, solid(1e5, 0.25), 0.45, 3.0),
    ];
    for (nu, base, nu_glue, x) in contacts {
        let tangential = 0.8;
        let normal = tangential * 2.0 * (1.0 - nu_glue) / (1.0 - 2.0 * nu_glue);
        let limit = solved(x, &film(base, (1.75, nu), springs(tangential, normal)), 1.0);
        let errors = [1e-2, 1e-3, 1e-4].map(|d: f64| {
            let young = 2.0 * (1.0 + nu_glue) * tangential * d;
            let glued = stack(base, &[layer(young, nu_glue, d), layer(1.75, nu, 1.0)]);
            relative_error(&solved(x / (1.0 + d), &glued, 1.0), &limit)
        });
        println!("with glue of nu = {nu_glue}: {errors:?}");
        assert!(errors[0] <= 2e-2);
        for (thick, thin) in errors.iter().zip(&errors[1..]) {
            let ratio = thick / thin;
            assert!((7.0..13.0).contains(&ratio), "{errors:?}");
        }
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

/// As `identities.rs`. Measured: 2.3e-14 and 7.8e-15.
#[test]
fn the_identities_between_the_quantities_hold() {
    let [mut energy, mut load] = [0.0; 2];
    for base in [rigid(), solid(3.0, 0.3)] {
        for stack in samples(base) {
            for (x, sphere) in [(0.3, 1.0), (2.0, INFINITY)] {
                let material = stack.material(sphere).expect("physical");
                let es = material.sphere_film_modulus();
                let values = |x: f64| {
                    let solution = solve_stack(x, &stack, sphere, 1e-13).expect("within reach");
                    solution.quantities.to_array()
                };
                let ([pi0, eeq, gamma, delta0], [pi0_rate, eeq_rate, _, delta0_rate]) =
                    with_derivatives(x, values);
                let residual = |left: f64, right: f64| (left / right - 1.0).abs();
                energy = larger(energy, residual(gamma * gamma, es * (eeq + eeq_rate)));
                let right = 4.0 * eeq * (2.0 * delta0 + delta0_rate);
                load = larger(load, residual(3.0 * pi0 + pi0_rate, right));
            }
        }
    }
    println!("largest residuals: energy {energy:.1e}, load {load:.1e}");
    assert!(energy <= 2e-13 && load <= 2e-13);
}

/// What a contact says of a stack that is not bonded, and how wide it may be.
#[test]
fn a_film_that_slides_is_never_confined_and_has_the_reach_of_stacks() {
    let sliding = film(rigid(), (1.0, 0.5), Interface::Sliding);
    assert!(sliding.compressibility().is_nan());
    let curve = stack_curve(&sliding, INFINITY, [0.1, 10.0], 1e-8).expect("within reach");
    let contact = Contact::new(&sliding.system(1e3, INFINITY), curve).expect("its own curve");
    let validity = contact.validity(5.0).expect("a radius");
    let film_validity = validity.film.expect("a film");
    assert!(film_validity.compressibility.is_nan() && !film_validity.is_confined());
    // Beyond the nodes nothing continues the curve.
    assert!(contact.load(20.0, 0.1).is_err());

    assert!(solve_stack(1000.0, &sliding, INFINITY, 1e-4).is_ok());
    let error = solve_stack(1000.1, &sliding, INFINITY, 1e-4).expect_err("beyond reach");
    assert!(
        matches!(error, Error::StackReach { layers: 1, .. }),
        "{error}"
    );
    let bonded = stack(rigid(), &[layer(1.0, 0.5, 1.0)]);
    assert!(solve_stack(1000.1, &bonded, INFINITY, 1e-4).is_ok());
}
