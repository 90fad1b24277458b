//! A plain dense solver by Nyström's method, to measure the solve beside it.
//!
//! The equation of `galerkin.rs` on Gauss-Legendre abscissae `s_j` with weights `w_j`. The
//! kernel is a sum over wave numbers `q`,
//!
//! ```text
//! g(rho_i)/es + sum_j w_j K_ij g(s_j) = f(rho_i),    K_ij = (2x/(pi e1)) sum_q w_q (X(q)-1) cos(q x rho_i) cos(q x s_j)
//! ```
//!
//! and the equation at `rho = 1` gives the values at the edge.
//!
//! The comparison is fair. All pairs of abscissae share the cosines. The cosines follow from the
//! addition theorem within panels of equal width, so all loops are vectorised. The kernel is one
//! product of matrices, the solution one LU decomposition, both by faer. The wave numbers are those
//! of our own Galerkin method, on panels graded to the material. The method does not estimate its
//! error.

use std::f64::consts::FRAC_2_PI;

use faer::linalg::matmul::matmul;
use faer::linalg::solvers::Solve;
use faer::{Accum, Mat, Par};
use interp::{Material, Quantities};

use solve::{Compliance, GaussLegendre, PanelWeights, Panels, SurfaceCompliance};

/// Gauss-Legendre abscissae and weights on `[0, 1]`, with the edge as one more abscissa. They serve
/// every contact.
#[derive(Clone, Debug)]
pub struct Nystrom {
    nodes: Vec<f64>,
    weights: Vec<f64>,
}

impl Nystrom {
    /// Returns the method with `size` abscissae, which the rows call nodes.
    pub fn new(size: usize) -> Self {
        let rule = GaussLegendre::new(size);
        let nodes = rule
            .abscissae
            .iter()
            .map(|u| 0.5 + 0.5 * u)
            .chain([1.0])
            .collect();
        Self {
            nodes,
            weights: rule.weights.iter().map(|w| 0.5 * w).collect(),
        }
    }

    /// Returns the four quantities at `x = a/t`. The number of wave numbers follows from the
    /// relative `tolerance` of the kernel.
    pub fn solve(&self, x: f64, material: &Material, tolerance: f64) -> Quantities {
        let size = self.weights.len();
        let es = material.sphere_film_modulus();
        let compliance = Compliance::new(material);
        let panels = Panels::new(x, [&compliance], PanelWeights::Waves, tolerance);
        let cosines = self.cosines(x, &panels);
        let symbol = symbol(x / material.film_modulus(), &compliance, &panels);
        let scaled = Mat::from_fn(symbol.len(), size, |q, j| {
            symbol[q] * self.weights[j] * cosines[(q, j)]
        });
        let mut kernel = Mat::zeros(size + 1, size);
        matmul(
            &mut kernel,
            Accum::Replace,
            cosines.transpose(),
            &scaled,
            1.0,
            Par::Seq,
        );

        let mut matrix = kernel.subrows(0, size).to_owned();
        for i in 0..size {
            matrix[(i, i)] += 1.0 / es;
        }
        let right = |rho: f64| [1.0, rho * rho];
        let g = matrix
            .partial_piv_lu()
            .solve(Mat::from_fn(size, 2, |i, f| right(self.nodes[i])[f]));
        let integral = |f: usize| (0..size).map(|j| self.weights[j] * g[(j, f)]).sum::<f64>();
        let edge = |f: usize| {
            es * (right(1.0)[f]
                - (0..size)
                    .map(|j| kernel[(size, j)] * g[(j, f)])
                    .sum::<f64>())
        };
        let (eeq, gamma) = (integral(0), edge(0));
        let delta0 = edge(1) / gamma;
        Quantities {
            pi0: 4.0 * (delta0 * eeq - integral(1)),
            eeq,
            gamma,
            delta0,
        }
    }

    /// Returns `cos(q x rho)`: a row for each wave number, a column for each abscissa and the edge.
    fn cosines(&self, x: f64, panels: &Panels) -> Mat<f64> {
        let rule = &panels.rule.abscissae;
        let mut cosines = Mat::zeros(rule.len() * (panels.edges.len() - 1), self.nodes.len());
        let (mut cos, mut sin) = (vec![0.0; rule.len()], vec![0.0; rule.len()]);
        for (column, rho) in self.nodes.iter().enumerate() {
            let mut half = f64::NAN;
            let column = cosines.col_as_slice_mut(column);
            for (values, ends) in column
                .chunks_exact_mut(rule.len())
                .zip(panels.edges.windows(2))
            {
                let width = 0.5 * (ends[1] - ends[0]);
                if (width - half).abs() > f64::EPSILON * ends[1] || half.is_nan() {
                    half = width;
                    for ((cos, sin), u) in cos.iter_mut().zip(&mut sin).zip(rule) {
                        (*sin, *cos) = (half * u * x * rho).sin_cos();
                    }
                }
                let (middle_sin, middle_cos) = (0.5 * (ends[0] + ends[1]) * x * rho).sin_cos();
                for ((value, cos), sin) in values.iter_mut().zip(&cos).zip(&sin) {
                    *value = middle_cos * cos - middle_sin * sin;
                }
            }
        }
        cosines
    }
}

/// Returns `(2 scale/pi) w (X - 1)` at every wave number.
fn symbol(scale: f64, compliance: &Compliance, panels: &Panels) -> Vec<f64> {
    let rule = panels.rule;
    let panel = |ends: &[f64]| {
        let (middle, half) = (0.5 * (ends[0] + ends[1]), 0.5 * (ends[1] - ends[0]));
        let q: Vec<f64> = rule.abscissae.iter().map(|u| middle + half * u).collect();
        let value = move |(w, excess): (&f64, f64)| FRAC_2_PI * scale * half * w * excess;
        let excesses = compliance.sample_all(&q).excess;
        rule.weights.iter().zip(excesses).map(value)
    };
    panels.edges.windows(2).flat_map(panel).collect()
}
