//! Exact identities and limits of layers that slide or are joined by springs.

use acceptance::{
    larger, layer, random_stack, relative_error, solid, springs, stack, with_interfaces,
};
use interp::{Elastic, Quantities};
use solve::stack::{Interface, Layer, Stack};
use solve::{LayeredCompliance, Method, solve_stack};

pub const INFINITY: f64 = f64::INFINITY;

pub fn rigid() -> Elastic {
    solid(INFINITY, 0.25)
}

/// Returns one film on a base.
pub fn film(base: Elastic, (young, poisson): (f64, f64), interface: Interface) -> Stack {
    with_interfaces(base, &[(layer(young, poisson, 1.0), interface)])
}

/// Returns `X(k)` of a stack, with the wave number in 1/m.
fn compliance(stack: &Stack) -> impl Fn(f64) -> f64 + use<> {
    let top = stack.layers().last().expect("a layer").thickness;
    let compliance = LayeredCompliance::new(stack);
    move |k| compliance.x(k * top)
}

pub fn wave_numbers() -> impl Iterator<Item = f64> {
    (0..=60).map(|i| 10_f64.powf(-7.0 + 0.15 * f64::from(i)))
}

/// Returns the largest relative difference of `X` of two stacks.
fn apart(a: &Stack, b: &Stack) -> f64 {
    let (a, b) = (compliance(a), compliance(b));
    wave_numbers().fold(0.0, |worst, k| larger(worst, (a(k) / b(k) - 1.0).abs()))
}

pub fn solved(x: f64, stack: &Stack, sphere: f64) -> Quantities {
    let solution = solve_stack(x, stack, sphere, 1e-12);
    solution.expect("solved").quantities
}

/// Replaces all interfaces of a random stack.
pub fn joined(seed: u64, interface: Interface) -> Stack {
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
            assert_eq!(joined(seed, ends), joined(seed, plain));
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
}

/// Returns the slope of `X` at wave number 0 (per 1/m): sums over groups between sliding interfaces.
pub fn slope_at_zero(stack: &Stack) -> f64 {
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

/// A plate on a soft interlayer on a stiff base: three layers of very different moduli.
pub fn sandwich(base: Elastic) -> Stack {
    let layers = [
        layer(1.0, 0.4, 0.3),
        layer(0.02, 0.5, 0.5),
        layer(5.0, 0.25, 0.2),
    ];
    stack(base, &layers)
}

/// Stacks of every kind of interface, on an elastic or a rigid base.
pub fn samples(base: Elastic) -> Vec<Stack> {
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
        for stack in samples(base).into_iter().chain([sandwich(base)]) {
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
