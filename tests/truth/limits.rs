//! The limits of the quantities: thick and thin films, film = substrate, rigid bodies,
//! incompressible films. Where the approach to a limit is known, it is tested too, so that a wrong
//! constant or power fails.

use std::f64::consts::PI;

use acceptance::{Contacts, larger, material, relative_error, relative_errors, solved};
use interp::{Material, Quantities};
use solve::Compliance;
use solve::SurfaceCompliance;

use crate::domain::in_units_of_the_film;

/// The film and the substrate of Barthel's figures.
const PAPER: [f64; 4] = [1.75, 0.5, 1e5, 0.25];

/// Materials of moderate contrast, one of them under a rigid sphere.
const MODERATE: [[f64; 4]; 6] = [
    PAPER,
    [1e-2, 0.3, 1e6, 0.3],
    [1.0, 0.3, 10.0, 0.0],
    [10.0, 0.0, 1.0, 0.5],
    [0.5, -0.4, f64::INFINITY, 0.25],
    [0.0, 0.3, 0.5, 0.25],
];

/// Integrates `f` by Simpson's rule with `2 n` intervals.
fn simpson(f: impl Fn(f64) -> f64, from: f64, to: f64, n: u32) -> f64 {
    let step = (to - from) / f64::from(2 * n);
    let at = |i: u32| f(from + f64::from(i) * step);
    let inner: f64 = (1..2 * n)
        .map(|i| if i % 2 == 1 { 4.0 } else { 2.0 } * at(i))
        .sum();
    (at(0) + inner + at(2 * n)) * step / 3.0
}

/// Returns the quantities of a thick film with errors of order `x^3`. The kernel is then the
/// constant `k(0)`, for which eq. 3 has the solution `Eeq = Gamma = es/(1 + beta)`,
/// `Delta0 = 1 + 2 beta/3`, `Pi0 = 8 es/3` with `beta = 2 k(0) x es/e1`.
fn thick_film(x: f64, material: &Material) -> Quantities {
    let compliance = Compliance::new(material);
    let kernel_at_zero = simpson(|q| compliance.sample(q).excess, 0.0, 20.0, 4000) / PI;
    let es = material.sphere_film_modulus();
    let beta = 2.0 * kernel_at_zero * x * es / material.film_modulus();
    Quantities {
        pi0: 8.0 / 3.0 * es,
        eeq: es / (1.0 + beta),
        gamma: es / (1.0 + beta),
        delta0: 1.0 + 2.0 / 3.0 * beta,
    }
}

#[test]
fn thick_films_approach_the_half_space_of_film_like_the_constant_kernel() {
    let [mut worst, mut distance, mut power] = [0.0; 3];
    for material in MODERATE.map(material) {
        let at = |x: f64| solved(x, &material, 1e-13);
        let [far, near] = [1e-2, 2e-3].map(|x| relative_errors(&at(x), &thick_film(x, &material)));
        for (far, near) in far.into_iter().zip(near) {
            power = larger(power, (far / near / 125.0 - 1.0).abs());
        }
        worst = larger(
            worst,
            relative_error(&at(1e-6), &thick_film(1e-6, &material)),
        );
        distance = larger(
            distance,
            relative_error(&at(1e-6), &material.thick_film_limit()),
        );
    }
    println!(
        "thick films: from the limit {distance:.1e}, from the constant kernel {worst:.1e}, third power off by {power:.1e}"
    );
    // Measured 8.7e-7, 6.7e-16 (both at x = 1e-6) and 6.9e-3.
    assert!(distance <= 2e-6);
    assert!(worst <= 1e-14);
    assert!(power <= 0.03);
}

/// Returns the quantities of a thin film to first order in `1/x`, with errors of order
/// `(ln x / x)^2`, and the constants `A` and `C`.
///
/// With `S(q) = 1 + X(q)/e1` (`X` alone under a rigid sphere) and `A = einf X'(0)/(pi e1)`,
/// `C = 1/pi int_0^inf [ln(einf S) - pi A q 1_{q<1}]/q^2 dq`, `c0 = ln 2 + 0.5772`.
fn thin_film(x: f64, material: &Material) -> (Quantities, f64, f64) {
    let compliance = Compliance::new(material);
    let limit = material.thin_film_limit();
    let einf = limit.eeq;
    let symbol = |q: f64| material.sphere_compliance() + compliance.x(q) / material.film_modulus();
    let a = einf * compliance.sample(1e-9).slope / 1e-9 / (PI * material.film_modulus());
    let below = |q: f64| ((einf * symbol(q)).ln() - PI * a * q) / (q * q);
    // Below 1 in ln q, down to where the integrand is constant; above 1 in u = 1/q, up to where X
    // is 1.
    const START: f64 = 1e-5;
    let inner = START * below(START) + simpson(|v| below(v.exp()) * v.exp(), START.ln(), 0.0, 2000);
    let outer = simpson(|u| (einf * symbol(1.0 / u.max(0.01))).ln(), 0.0, 1.0, 2000);
    let c = (inner + outer) / PI;
    const C0: f64 = std::f64::consts::LN_2 + 0.577_215_664_901_532_9;
    let term = |shift: f64| (a * (x.ln() + C0 - shift) + c) / x;
    let quantities = Quantities {
        pi0: limit.pi0 * (1.0 - 3.0 * term(1.0)),
        eeq: limit.eeq * (1.0 - term(0.0)),
        gamma: limit.gamma * (1.0 - a / (2.0 * x)),
        delta0: limit.delta0 * (1.0 - 2.0 * term(2.0)),
    };
    (quantities, a, c)
}

#[test]
fn thin_films_approach_the_bare_substrate_like_the_first_order_expansion() {
    let [mut worst, mut second_order, mut distance, mut first_order] = [0.0; 4];
    // The soft film of the list is not yet thin at a/t = 1000: A/x is 6 % there.
    for material in MODERATE
        .map(material)
        .into_iter()
        .filter(|material| material.e1_over_e2() != 1e-2)
    {
        let limit = material.thin_film_limit();
        let [near, far] = [1000.0, 100.0].map(|x| {
            let quantities = solved(x, &material, 1e-11);
            (
                relative_errors(&quantities, &thin_film(x, &material).0),
                relative_errors(&quantities, &limit),
            )
        });
        for i in 0..4 {
            worst = larger(worst, near.0[i]);
            second_order = larger(second_order, near.0[i] / far.0[i]);
            distance = larger(distance, near.1[i]);
            first_order = larger(first_order, near.1[i] / far.1[i]);
        }
    }
    println!(
        "thin films at x = 1000: from the limit {distance:.1e}, {first_order:.3} of that at 100"
    );
    println!(
        "                        from the expansion {worst:.1e}, {second_order:.3} of that at 100"
    );
    // Measured 5.9e-3 and 0.155, 1.3e-5 and 0.044: ln x / x falls to 0.15 and its square to 0.0225
    // of their former values.
    assert!(distance <= 1e-2);
    assert!(first_order <= 0.2);
    assert!(worst <= 5e-5);
    assert!(second_order <= 0.06);
}

/// Up to the end of the domain, the error of the first-order expansion is of second order:
/// `(ln x/x)^2` times a number that converges.
#[test]
fn thin_films_approach_the_bare_substrate_to_second_order_up_to_the_end_of_the_domain() {
    let (_, a, c) = thin_film(1e6, &material(PAPER));
    println!("the paper's material: A = {a:.2e}, C = {c:.5}");
    assert!((c - 0.10293).abs() <= 5e-6);
    for parameters in [PAPER, [10.0, 0.0, 1.0, 0.5], [1.0, 0.3, 10.0, 0.0]] {
        let material = material(parameters);
        let misses = [1e4, 1e5, 1e6].map(|x: f64| {
            let miss = relative_error(&solved(x, &material, 1e-12), &thin_film(x, &material).0);
            let of_second_order = miss / (x.ln() / x).powi(2);
            println!(
                "{parameters:?} at x = {x:e}: {miss:.1e}, {of_second_order:.1e} of (ln x/x)^2"
            );
            of_second_order
        });
        // Measured: 0.039, 0.037 and 0.035 for the softest of them, below 5e-4 for the others,
        // whose A is small.
        assert!(misses.iter().all(|miss| *miss <= 0.1));
        assert!(misses[2] < misses[0], "{misses:?}");
    }
}

#[test]
fn a_film_of_the_substrates_own_material_makes_no_difference() {
    let mut contacts = Contacts::new(10);
    for _ in 0..50 {
        let (e, nu) = (contacts.log_uniform(1e-6, 1e8), contacts.poisson_ratio());
        let material = material([e, nu, e, nu]);
        let x = contacts.log_uniform(1e-6, 1e4);
        assert_eq!(
            solved(x, &material, 1e-13),
            Quantities::homogeneous(material.sphere_film_modulus()),
            "{material:?} at {x}"
        );
    }
    let rigid = material([0.0, 0.2, 1.0, 0.2]);
    assert_eq!(solved(3.0, &rigid, 1e-13), Quantities::homogeneous(1.0));
}

#[test]
fn nearly_equal_film_and_substrate_differ_by_their_difference() {
    let [mut rounding, mut nonlinearity] = [0.0; 2];
    for (e, nu) in [(1e-3, 0.5), (1.0, 0.3), (1e3, 0.0), (30.0, -0.5)] {
        for x in [1e-3, 1.0, 100.0] {
            let distance = |factor: f64| {
                let material = material([e, nu, e * factor, nu]);
                relative_error(
                    &solved(x, &material, 1e-12),
                    &Quantities::homogeneous(material.sphere_film_modulus()),
                )
            };
            for factor in [1.0 + f64::EPSILON, 1.0 + 1e-15, 1.0 - 1e-15] {
                rounding = larger(rounding, distance(factor));
            }
            nonlinearity = larger(
                nonlinearity,
                (0.1 * distance(1.0 + 1e-5) / distance(1.0 + 1e-6) - 1.0).abs(),
            );
        }
    }
    println!("nearly equal: 1e-15 apart {rounding:.1e}, off proportionality {nonlinearity:.1e}");
    assert!(rounding <= 1e-14);
    // Measured 5.8e-15 and 7.0e-5.
    assert!(nonlinearity <= 1e-3);
}

/// The measured approach to a limit.
#[derive(Default)]
struct Approach {
    /// The largest distance from the limit at the last point.
    end: f64,
    /// The largest distance from the limit a chosen step before it.
    start: f64,
    /// The largest relative deviation from a distance that is proportional to the step.
    nonlinearity: f64,
}

impl Approach {
    /// Measures the approach of `quantities(s)` to `limit` from `s = start` to `s = end`.
    fn add(
        &mut self,
        start: f64,
        end: f64,
        limit: Quantities,
        quantities: impl Fn(f64) -> Quantities,
    ) {
        let distances = |s: f64| relative_errors(&quantities(s), &limit);
        self.end = distances(end).into_iter().fold(self.end, larger);
        for (far, near) in distances(start).into_iter().zip(distances(0.1 * start)) {
            self.start = larger(self.start, far);
            self.nonlinearity = larger(self.nonlinearity, (0.1 * far / near - 1.0).abs());
        }
    }

    /// Prints the approach and asserts its bounds.
    fn assert(&self, what: &str, end: f64, start: f64, nonlinearity: f64) {
        println!(
            "{what}: {:.1e} at the end, {:.1e} before, {:.1e} off linear",
            self.end, self.start, self.nonlinearity
        );
        assert!(self.end <= end && self.start <= start && self.nonlinearity <= nonlinearity);
    }
}

#[test]
fn a_very_stiff_substrate_is_a_rigid_one() {
    let mut approach = Approach::default();
    for (e1, nu1) in [(0.1, 0.3), (1.0, 0.5), (100.0, 0.0)] {
        for x in [0.1, 1.0, 30.0] {
            let at = |e0: f64| solved(x, &material([e1, nu1, e0, 0.25]), 1e-12);
            approach.add(
                1e-7,
                1e-12,
                at(f64::INFINITY),
                |softness| at(1.0 / softness),
            );
        }
    }
    // Measured 9.3e-13, 9.3e-8 and 1.2e-4, which is the rounding of differences of 1e-11.
    approach.assert("rigid substrate, E2/E0 = 1e-7 to 1e-12", 3e-12, 3e-7, 1e-3);
}

#[test]
fn a_very_soft_film_makes_the_sphere_rigid() {
    let mut approach = Approach::default();
    for (nu1, e0_over_e1) in [
        (0.5, 1e3),
        (0.3, 300.0),
        (0.0, f64::INFINITY),
        (0.5, f64::INFINITY),
    ] {
        for x in [0.1, 1.0, 10.0] {
            let soft = |e1: f64| {
                let material = material([e1, nu1, e0_over_e1 * e1, 0.25]);
                in_units_of_the_film(&solved(x, &material, 1e-11), &material)
            };
            approach.add(
                1e-5,
                1e-8,
                solved(x, &material([0.0, nu1, e0_over_e1, 0.25]), 1e-11),
                soft,
            );
        }
    }
    // Measured 4.0e-6, 4.0e-3 and 3.6e-3, all for the incompressible film on a rigid substrate at x
    // = 10, where Eeq = 300 E1*.
    approach.assert("rigid sphere, E1/E2* = 1e-5 to 1e-8", 1e-5, 1e-2, 1e-2);
}

#[test]
fn a_nearly_incompressible_film_is_an_incompressible_one() {
    let mut approach = Approach::default();
    for (e1, e0) in [(0.1, 1e6), (1.0, f64::INFINITY), (100.0, 1.0)] {
        for x in [0.1, 1.0, 30.0] {
            let film = |defect: f64| solved(x, &material([e1, 0.5 - defect, e0, 0.25]), 1e-12);
            approach.add(1e-7, 1e-12, film(0.0), film);
        }
    }
    // Measured 3.6e-12, 3.6e-7 and 3.2e-6.
    approach.assert(
        "incompressible, 0.5 - nu1 = 1e-7 to 1e-12",
        1e-11,
        1e-6,
        1e-4,
    );
}
