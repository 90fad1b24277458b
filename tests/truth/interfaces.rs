//! Layers that slide or are joined by springs: the slope of the surface compliance, and a second
//! method of solution at random contacts. `stacks.rs` compares them with independent values.

use std::f64::consts::FRAC_2_PI;

use acceptance::{
    Contacts, Data, larger, layer, relative_error, slopes, solid, springs, with_interfaces,
};
use interp::Quantities;
use solve::stack::{Interface, Stack};
use solve::{GaussLegendre, LayeredCompliance, SurfaceCompliance, solve_stack};

/// Measured: 1.1e-11 of the larger of 1, `X` and the slope.
#[test]
fn the_slope_is_the_derivative_of_the_compliance() {
    let mut worst = 0.0;
    for case in Data::read("interfaces_x").cases() {
        let compliance = LayeredCompliance::new(&case.stack_with_interfaces());
        for q in (0..40).map(|i| 10_f64.powf(-6.0 + 0.18 * f64::from(i))) {
            let [difference] = slopes(5e-3, |log| [compliance.x(q * log.exp())]);
            let slope = compliance.sample(q).slope;
            let unit = compliance.x(q).max(1.0).max(slope.abs());
            worst = larger(worst, (difference - slope).abs() / unit);
        }
    }
    println!("largest difference from the slope: {worst:.1e}");
    assert!(worst <= 1e-10);
}

/// Returns the nodes and weights of Gauss and Legendre's rule on `[0, 1]`.
fn gauss(count: usize) -> Vec<[f64; 2]> {
    let rule = GaussLegendre::new(count);
    let pairs = rule.abscissae.into_iter().zip(rule.weights);
    pairs.map(|(t, w)| [0.5 * (1.0 + t), 0.5 * w]).collect()
}

/// Solves `A x = b` for two right-hand sides by Gauss's elimination, `rows = [A | b]`.
fn eliminated(mut rows: Vec<Vec<f64>>) -> Vec<[f64; 2]> {
    let n = rows.len();
    for i in 0..n {
        let pivot = (i..n).max_by(|&a, &b| rows[a][i].abs().total_cmp(&rows[b][i].abs()));
        rows.swap(i, pivot.expect("a row is left"));
        let (done, below) = rows.split_at_mut(i + 1);
        for row in below {
            let factor = row[i] / done[i][i];
            for (value, pivot) in row.iter_mut().zip(&done[i]).skip(i) {
                *value -= factor * pivot;
            }
        }
    }
    let mut solution = vec![[0.0; 2]; n];
    for i in (0..n).rev() {
        for side in 0..2 {
            let known: f64 = (i + 1..n).map(|j| rows[i][j] * solution[j][side]).sum();
            solution[i][side] = (rows[i][n + side] - known) / rows[i][i];
        }
    }
    solution
}

/// Solves the contact by Nystrom's method, from the compliance alone: Barthel's eq. 3 at Gauss's
/// nodes, with the kernel from panels that begin 15 decades below the unit of the wave number.
/// `x` is the contact radius over the thickness of the top layer.
fn nystrom(x: f64, stack: &Stack, sphere: f64, count: usize) -> Quantities {
    let compliance = LayeredCompliance::new(stack);
    let material = stack.material(sphere).expect("physical");
    let (es, film) = (material.sphere_film_modulus(), material.film_modulus());
    let (nodes, rule) = (gauss(count), gauss(20));
    // The edge is one more point, of weight 0.
    let points: Vec<f64> = nodes.iter().map(|[s, _]| *s).chain([1.0]).collect();
    let mut kernel = vec![vec![0.0; count]; count + 1];
    let (mut from, mut to) = (0.0, 1e-15);
    while from < 20.0 {
        for &[t, w] in &rule {
            let q = from + (to - from) * t;
            let weight = FRAC_2_PI * x / film * (to - from) * w * compliance.sample(q).excess;
            let cosines: Vec<f64> = points.iter().map(|s| (q * x * s).cos()).collect();
            for (row, cosine) in kernel.iter_mut().zip(&cosines) {
                for (entry, other) in row.iter_mut().zip(&cosines) {
                    *entry += weight * cosine * other;
                }
            }
        }
        (from, to) = (to, (1.6 * to).min(to + 2.0 / (1.0 + x)));
    }
    let rows = (0..count)
        .map(|i| {
            let mut row: Vec<f64> = (0..count).map(|j| kernel[i][j] * nodes[j][1]).collect();
            row[i] += 1.0 / es;
            row.extend([1.0, points[i].powi(2)]);
            row
        })
        .collect();
    let g = eliminated(rows);
    let integral =
        |side: usize| -> f64 { nodes.iter().zip(&g).map(|([_, w], g)| w * g[side]).sum() };
    let edge = |side: usize| {
        let terms = kernel[count].iter().zip(&nodes).zip(&g);
        es * (1.0 - terms.map(|((k, [_, w]), g)| k * w * g[side]).sum::<f64>())
    };
    let gamma = edge(0);
    let delta0 = edge(1) / gamma;
    Quantities {
        pi0: 4.0 * (delta0 * integral(0) - integral(1)),
        eeq: integral(0),
        gamma,
        delta0,
    }
}

/// Draws a stack of one to four layers, most of which slide or have springs, of extreme moduli,
/// thicknesses, Poisson ratios and stiffnesses.
pub(crate) fn random_stack(draw: &mut Contacts) -> Stack {
    let poisson = |draw: &mut Contacts| {
        const SPECIAL: [f64; 6] = [0.5, 0.499_999, 0.3, 0.0, -0.5, -0.9];
        SPECIAL[draw.uniform(0.0, 6.0) as usize]
    };
    let base = if draw.uniform(0.0, 1.0) < 0.35 {
        solid(f64::INFINITY, 0.25)
    } else {
        solid(draw.log_uniform(1e-3, 1e3), poisson(draw))
    };
    let count = 1 + draw.uniform(0.0, 4.0) as usize;
    let layers: Vec<_> = (0..count)
        .map(|_| {
            let (young, thickness) = (draw.log_uniform(1e-3, 1e3), draw.log_uniform(0.03, 1.0));
            let interface = match draw.uniform(0.0, 1.0) {
                ..0.2 => Interface::Bonded,
                ..0.5 => Interface::Sliding,
                ..0.7 => springs(young * draw.log_uniform(1e-12, 1e4), f64::INFINITY),
                ..0.8 => springs(f64::INFINITY, young * draw.log_uniform(1e-4, 1e4)),
                _ => springs(
                    young * draw.log_uniform(1e-12, 1e4),
                    young * draw.log_uniform(1e-4, 1e4),
                ),
            };
            (layer(young, poisson(draw), thickness), interface)
        })
        .collect();
    with_interfaces(base, &layers)
}

/// Two methods that share the compliance alone. The stated errors at three tolerances are compared;
/// the second method has some 1e-10 of its own, and less accuracy where `X` is huge.
#[test]
fn stated_errors_bound_the_true_ones_of_random_contacts() {
    /// The error of the second method over the largest compliance.
    const ROUNDING: f64 = 2e-14;
    let mut draw = Contacts::new(34);
    let (mut compared, mut largest): (usize, f64) = (0, 0.0);
    for i in 0..120 {
        let stack = random_stack(&mut draw);
        let top = stack.layers().last().expect("a layer").thickness;
        let sphere = [1.0, f64::INFINITY, 1e-3][i % 3];
        let x = draw.log_uniform(1e-3, 6.0);
        let truth = nystrom(x, &stack, sphere, 44);
        let compliance = LayeredCompliance::new(&stack);
        let peak = (0..120)
            .map(|i| compliance.x(10_f64.powf(-8.0 + 0.1 * f64::from(i))))
            .fold(1.0, f64::max);
        for tolerance in [1e-4, 1e-7, 1e-10] {
            let a_over_t = x * top / stack.thickness();
            let solution = solve_stack(a_over_t, &stack, sphere, tolerance)
                .unwrap_or_else(|e| panic!("{i}: {e}\n{stack:?}"));
            let error = relative_error(&solution.quantities, &truth);
            let allowed = solution.error + 1e-11 + ROUNDING * peak;
            assert!(
                error <= allowed,
                "{i}: {error:.1e}, stated {:.1e}, X up to {peak:.1e}, x = {x}\n{stack:?}",
                solution.error
            );
            largest = largest.max(error / tolerance);
            compared += usize::from(ROUNDING * peak < 0.1 * tolerance);
        }
    }
    println!("{compared} contacts, errors at most {largest:.2} of the tolerance");
    assert!(compared >= 280);
}
