//! The four exact identities between the quantities and their derivatives in `x = a/t`, at random
//! contacts:
//!
//! ```text
//! Gamma^2 = es d(x Eeq)/dx                         energy release rate from the compliance, and from the singularity
//! 3 Pi0 + x Pi0' = 4 Eeq (2 Delta0 + x Delta0')    dF0/da = S d(delta0)/da
//! 2 Delta0 + x Delta0' = 2 es Eeq/Gamma^2          d(delta0)/da = (2/R) S/S'
//! 3 Pi0 + x Pi0' = 8 es Eeq^2/Gamma^2              dF0/da = (2/R) S^2/S'
//! ```
//!
//! The derivatives are those of the Chebyshev interpolant in `ln x`. It converges spectrally: the
//! quantities are analytic functions of `ln x` in a strip of half-width about 0.9, which the poles
//! of `X` set.

use std::f64::consts::PI;

use acceptance::{Contacts, larger, solved};

/// Tolerance of the solves.
const TOLERANCE: f64 = 1e-12;
/// Nodes of the interpolant.
const NODES: usize = 24;
/// Half of the interval of `ln x` that the nodes cover.
const HALF_WIDTH: f64 = 0.5;
/// Number of random contacts.
const CONTACTS: usize = 150;
/// Largest relative residual of the first identity. Measured: 1.2e-13.
const ENERGY: f64 = 2e-12;
/// Largest relative residual of the second identity. Measured: 9.8e-14.
const LOAD: f64 = 1e-12;
/// Largest relative residuals of the third and the fourth identity. Measured: 1.8e-13.
const PENETRATION: f64 = 2e-12;

/// Returns the four quantities at `x` and their derivatives with respect to `ln x`.
fn with_derivatives(x: f64, values: impl Fn(f64) -> [f64; 4]) -> ([f64; 4], [f64; 4]) {
    let mut derivatives = [0.0; 4];
    for j in 0..NODES {
        let angle = PI * (j as f64 + 0.5) / NODES as f64;
        // d/dt at t = 0 of sum_k c_k T_k(t), with T_k'(0) = k sin(k pi/2) and c_k = 2/n sum_j f_j
        // cos(k angle_j).
        let odd = (1..NODES).step_by(2);
        let weight: f64 = odd
            .map(|k| k as f64 * (k as f64 * PI / 2.0).sin() * (k as f64 * angle).cos())
            .sum();
        let f = values(x * (HALF_WIDTH * angle.cos()).exp());
        for (derivative, f) in derivatives.iter_mut().zip(f) {
            *derivative += 2.0 / NODES as f64 / HALF_WIDTH * weight * f;
        }
    }
    (values(x), derivatives)
}

/// Returns the relative residuals of the four identities at `x`: of the quantities `values`, with
/// the reduced modulus `es` of a half-space of the film and the sphere.
pub fn residuals(x: f64, es: f64, values: impl Fn(f64) -> [f64; 4]) -> [f64; 4] {
    let ([pi0, eeq, gamma, delta0], [pi0_rate, eeq_rate, _, delta0_rate]) =
        with_derivatives(x, values);
    let penetration_rate = 2.0 * delta0 + delta0_rate;
    let load_rate = 3.0 * pi0 + pi0_rate;
    [
        (gamma * gamma, es * (eeq + eeq_rate)),
        (load_rate, 4.0 * eeq * penetration_rate),
        (penetration_rate, 2.0 * es * eeq / (gamma * gamma)),
        (load_rate, 8.0 * es * (eeq / gamma).powi(2)),
    ]
    .map(|(left, right)| (left / right - 1.0).abs())
}

#[test]
fn the_identities_hold() {
    let mut contacts = Contacts::new(20);
    let (mut energy, mut load, mut penetration) = (0.0, 0.0, 0.0);
    for _ in 0..CONTACTS {
        let material = contacts.material([1e-2, 1e4], [1e-2, 1e6]);
        let x = contacts.log_uniform(1e-3, 100.0);
        let values = |x: f64| solved(x, &material, TOLERANCE).to_array();
        let [first, second, third, fourth] = residuals(x, material.sphere_film_modulus(), values);
        energy = larger(energy, first);
        load = larger(load, second);
        penetration = larger(penetration, larger(third, fourth));
    }
    println!("{CONTACTS} {energy:.1e} {load:.1e} {penetration:.1e}");
    assert!(energy <= ENERGY);
    assert!(load <= LOAD);
    assert!(penetration <= PENETRATION);
}
