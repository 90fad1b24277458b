//! The flat punch with stick: one linear system for its normal and tangential fields.
//!
//! With `x = a/t`, `p_n` and `q_n` of `coulomb.rs`, and `f = es/E1*`, in units of `es`
//!
//! ```text
//! A_mn = delta_mn/cosh(pi eps) + f (2/pi) int_0^inf [ (X11-1) p_m p_n + (X12-b) (p_m q_n + q_m p_n) + (X22-1) q_m q_n ] dz,    z = q x
//! A c = c0 e_0        Eeq_s = es c0 c_0
//! ```
//!
//! Symmetric and positive definite. With `p^ = sum c_n p_n`, `q^ = sum c_n q_n`, the identity
//! `Gamma_eff^2 = es d(x Eeq_s)/dx` in its energy form, which converges twice as fast as the fields,
//! and for `eps = 0` the equation itself at the edge give
//!
//! ```text
//! Gamma_eff^2 = es^2 { c0 c_0 + f (2/pi) int [ q X11' p^^2 + 2 q X12' p^ q^ + q X22' q^^2 ] dz }
//! Gamma_s =  es { 1 - f (2/pi) int [ (X11-1) p^ + (X12-b) q^ ] cos z dz }
//! Gamma_t = -es       f (2/pi) int [ (X22-1) q^ + (X12-b) p^ ] sin z dz
//! ```

use std::f64::consts::PI;

use faer::linalg::triangular_solve::{
    solve_lower_triangular_in_place, solve_upper_triangular_in_place,
};
use faer::{Mat, Par};

use crate::galerkin::abscissae::Abscissae;

use crate::compliance::surface::SurfaceCompliance;
use crate::estimate::larger;
use crate::galerkin::operator::{ROUNDING, TRUNCATION_SAFETY, factorise, quadrature_errors};
use crate::galerkin::quadrature::Panels;
use crate::stick::bodies::Bodies;
use crate::stick::compliances::{Samples, Three, sample_all};
use crate::stick::coulomb::{ASYMPTOTIC, Coulomb};
use crate::stick::lattice::{beyond, matrix};
use crate::stick::transforms::{Factors, Transforms};

/// The bodies at the wave numbers of the integrals, for punches up to some radius.
pub struct Waves<'a> {
    /// The bodies.
    pub bodies: &'a Bodies,
    /// The wave numbers `q`, padded to a multiple of eight.
    pub q: Vec<f64>,
    /// The weights `(2/pi) dq`, 0 for the padding.
    pub weights: Vec<f64>,
    /// `f` times the compliances without their limits.
    pub excess: Three<Vec<f64>>,
    /// `f X11` and `f X22`, with their limits.
    whole: [Vec<f64>; 2],
    /// `f q` times their derivatives.
    slope: Three<Vec<f64>>,
    /// The end of the panels.
    end: f64,
    /// The error of `f (2/pi) int X dq` where the panels do not resolve the compliances.
    resolution: f64,
    /// The relative error of products of two transforms that the panels do not resolve.
    design: f64,
    /// The rounding error of sums, relative to the sum of absolute values.
    rounding: f64,
}

/// The field of the flat punch of one radius, in units of `es`.
pub struct Field {
    /// `a/t`.
    pub x: f64,
    /// `Eeq_s/es`.
    pub eeq: f64,
    /// `(Gamma_eff/es)^2`.
    pub edge: f64,
    /// `Gamma_s/es` and `Gamma_t/es` for `eps = 0`.
    pub parts: Option<[f64; 2]>,
    /// `(X11-1) p^ + (X12-b) q^`, times `f`, at all wave numbers.
    pub normal: Vec<f64>,
    /// What the punch answers to the edge of the contact, if asked for.
    pub answer: Option<Vec<f64>>,
    /// The estimated relative error of all these numbers from the finite number of modes; that of
    /// `Gamma_t` is relative to `Gamma_eff`.
    pub truncation: f64,
    /// The error of `Gamma_s` and `Gamma_t` from it, which converge half as fast.
    pub parts_error: f64,
    /// The same from the integrals.
    pub quadrature: f64,
    /// The same from rounding.
    pub rounding: f64,
}

impl Field {
    /// Returns the estimated relative error from all sources.
    pub fn error(&self) -> f64 {
        self.truncation + self.parts_error + self.quadrature + self.rounding
    }
}

/// The linear system of a punch.
struct Assembled {
    /// The weights of the integrals over `z`.
    weights: Vec<f64>,
    coulomb: Coulomb,
    transforms: Transforms,
    matrix: Mat<f64>,
    /// The roots of the diagonal of the matrix of a wide contact, whose compliances are integrated with their limits.
    roots: Option<Vec<f64>>,
    /// `sin z` and `cos z`, without coupling.
    waves: [Vec<f64>; 2],
}

impl<'a> Waves<'a> {
    /// Samples the surface on `panels`.
    ///
    /// `largest` is the largest radius.
    pub fn new(bodies: &'a Bodies, panels: Panels, largest: f64) -> Self {
        let mut abscissae = Abscissae::new(1.0, 0, panels);
        let Samples {
            mut excess,
            mut whole,
            mut slope,
        } = sample_all(&bodies.surface, &abscissae.q);
        for values in excess.iter_mut().chain(&mut whole).chain(&mut slope) {
            values.iter_mut().for_each(|value| *value *= bodies.film);
        }
        if !bodies.sticks {
            for values in excess[1..].iter_mut().chain(&mut slope[1..]) {
                values.fill(0.0);
            }
            whole[1].fill(bodies.film);
        }
        // The tangential transforms begin in proportion to `q`: long waves of the tangential
        // compliance hardly matter. Where a film slides on its base they grow like `1/q`, and the
        // product with two transforms is what the first panel resolves.
        abscissae.x = largest;
        let errors = |slope: &[f64]| quadrature_errors(&abscissae, slope);
        let edges = &abscissae.panels.edges;
        let (end, first_end) = (edges[edges.len() - 1], edges[1]);
        let mut tangential = slope[2].clone();
        let first = abscissae.panels.rule.abscissae.len();
        for (value, q) in tangential.iter_mut().zip(&abscissae.q).take(first) {
            *value *= (q / first_end).powi(2) * larger(1.0, largest * first_end);
        }
        let resolution = errors(&slope[0])[0] + errors(&slope[1])[0] + errors(&tangential)[1];
        Self {
            bodies,
            resolution,
            design: abscissae.panels.design_error,
            rounding: ROUNDING * (1.0 - 0.05 * bodies.surface.smallest_scale().ln()),
            q: abscissae.q,
            weights: abscissae.weights,
            excess,
            whole,
            slope,
            end,
        }
    }

    /// Solves the punch of radius `x = a/t` with an even number of `modes`; `with_answer` asks for
    /// [`Field::answer`].
    ///
    /// Returns `None` where the matrix is not positive definite, by rounding.
    pub fn field(&self, x: f64, modes: usize, with_answer: bool) -> Option<Field> {
        let rows = self.q.len();
        let (end, uncoupled) = (x * self.end, self.bodies.eps == 0.0);
        let [y11, y12, y22] = &self.excess;
        let Assembled {
            weights,
            coulomb,
            transforms,
            mut matrix,
            roots,
            waves: [sines, cosines],
        } = self.assembled(x, modes);
        // In the order of the modes, the tail of the forward substitution is that of `Eeq_s`.
        factorise(&mut matrix)?;

        let c0 = self.bodies.c0();
        let mut solutions = Mat::<f64>::zeros(modes, if uncoupled { 3 } else { 1 });
        solutions[(0, 0)] = c0;
        if uncoupled {
            for (n, (scale, sums)) in coulomb.scale.iter().zip(&transforms.sums).enumerate() {
                solutions[(n, 1)] = 2.0 * scale * sums[3];
                solutions[(n, 2)] = 2.0 * scale * sums[4];
            }
        }
        solve_lower_triangular_in_place(matrix.as_ref(), solutions.as_mut(), Par::Seq);
        // Each sum over the modes is one over the products of these columns.
        let missing_beside = |column: usize| {
            let pairs = solutions
                .col_as_slice(0)
                .iter()
                .zip(solutions.col_as_slice(column));
            missing_modes(&pairs.map(|(a, b)| (a * b).abs()).collect::<Vec<f64>>())
        };
        let missing = missing_beside(0);
        let missing_at_edge = if uncoupled {
            missing_beside(1) + missing_beside(2)
        } else {
            0.0
        };
        let asked = if with_answer { 2 } else { 1 };
        let asked = solutions.as_mut().subcols_mut(0, asked);
        solve_upper_triangular_in_place(matrix.transpose(), asked, Par::Seq);

        let c = solutions.col_as_slice(0);
        let [p_hat, q_hat] = transforms.fields(&coulomb, c);
        let eeq = c0 * c[0];
        let (edge, terms, form) = self.edge(&weights, [&p_hat, &q_hat], (c, eeq), roots.as_deref());
        if !(eeq > 0.0 && edge > 0.0) {
            return None;
        }
        let mut size = larger(form / eeq, terms / edge);
        let normal: Vec<f64> = (0..rows)
            .map(|k| y11[k] * p_hat[k] + y12[k] * q_hat[k])
            .collect();
        let parts = uncoupled.then(|| {
            let (mut of_normal, mut of_shear, mut terms) = (0.0, 0.0, 1.0);
            for k in 0..rows {
                let shear = y22[k] * q_hat[k] + y12[k] * p_hat[k];
                of_normal += weights[k] * normal[k] * cosines[k];
                of_shear += weights[k] * shear * sines[k];
                terms += weights[k] * (normal[k].abs() + shear.abs());
            }
            size += terms / edge.sqrt();
            [1.0 - of_normal, -of_shear]
        });
        // Both ways to the edge must agree, which does not tell an error of the phase.
        let parts_error = parts.map_or(0.0, |[normal, shear]| {
            (normal * normal + shear * shear - edge).abs() / edge + missing_at_edge / edge.sqrt()
        });
        // Beyond the panels, the coupling at the edge is that of `cos^2 z/z`.
        let cut = y12[rows - 1].abs() / (2.0 * PI * self.end) * end.powi(2).min(1.0);
        let answer = with_answer.then(|| {
            let [p_hat, q_hat] = transforms.fields(&coulomb, solutions.col_as_slice(1));
            (0..rows)
                .map(|k| y11[k] * (cosines[k] - p_hat[k]) - y12[k] * q_hat[k])
                .collect()
        });
        Some(Field {
            x,
            eeq,
            edge,
            parts,
            normal,
            answer,
            truncation: TRUNCATION_SAFETY * missing * larger(1.0 / eeq, 1.0 / edge),
            parts_error,
            quadrature: x * self.resolution * larger(eeq, eeq * eeq / edge) + self.design + cut,
            rounding: self.rounding * size,
        })
    }

    /// Assembles the linear system of the punch of radius `x` with a number of `modes`.
    fn assembled(&self, x: f64, modes: usize) -> Assembled {
        let z: Vec<f64> = self.q.iter().map(|q| q * x).collect();
        let weights: Vec<f64> = self.weights.iter().map(|w| w * x).collect();
        let weighted = |factor: &[f64]| -> Vec<f64> {
            factor.iter().zip(&weights).map(|(f, w)| f * w).collect()
        };
        let coulomb = Coulomb::new(self.bodies.eps, modes, z[z.len() - 1]);
        // Of a wide contact, the compliances are integrated with their limits.
        let end = x * self.end;
        let wide = self.bodies.eps == 0.0 && end >= ASYMPTOTIC;
        let [y11, y12, y22] = &self.excess;
        let [x11, x22] = &self.whole;
        let [of_normal, of_shear] = if wide { [x11, x22] } else { [y11, y22] };
        let products = [of_normal, y12, of_shear].map(|factor| weighted(factor));
        let uncoupled = self.bodies.eps == 0.0;
        let [sines, cosines] = if uncoupled {
            waves_at(&z)
        } else {
            [Vec::new(), Vec::new()]
        };
        // Without coupling, even modes are normal and odd ones tangential. The edge asks for both
        // stresses there.
        let at_edge = |factor: &[f64], waves: &[f64]| -> Vec<f64> {
            let pairs = factor.iter().zip(waves).zip(&weights);
            pairs.map(|((factor, wave), w)| factor * wave * w).collect()
        };
        let single = [
            [at_edge(y11, &cosines), at_edge(y12, &sines)],
            [at_edge(y12, &cosines), at_edge(y22, &sines)],
        ];
        let transforms = Transforms::new(
            &coulomb,
            &z,
            &Factors {
                products: products.each_ref().map(Vec::as_slice),
                single: single
                    .each_ref()
                    .map(|pair| pair.each_ref().map(Vec::as_slice)),
            },
        );
        let rest = wide.then(|| {
            beyond(&coulomb, end).map(|row| row.iter().map(|r| self.bodies.film * r).collect())
        });
        let mut matrix = matrix(&coulomb, &transforms.sums, rest);
        let diagonal = if wide {
            self.bodies.sphere
        } else {
            1.0 / self.bodies.cosh()
        };
        let roots: Vec<f64> = (0..modes)
            .map(|n| {
                matrix[(n, n)] += diagonal;
                larger(0.0, matrix[(n, n)]).sqrt()
            })
            .collect();
        Assembled {
            weights,
            coulomb,
            transforms,
            matrix,
            roots: wide.then_some(roots),
            waves: [sines, cosines],
        }
    }

    /// Returns `Gamma_eff^2` in units of `es` by the energy form, the sum of the absolute values of its terms, and that of the
    /// quadratic form of the matrix. `roots` are those of the diagonal of the matrix of a wide contact.
    fn edge(
        &self,
        weights: &[f64],
        [p_hat, q_hat]: [&[f64]; 2],
        (c, eeq): (&[f64], f64),
        roots: Option<&[f64]>,
    ) -> (f64, f64, f64) {
        // The terms of the quadratic form of the matrix. Of a wide contact all are positive; elsewhere
        // the unit matrix is one of two that may cancel. Those of the slopes are up to three times
        // as large.
        let [form, of_slopes] = if let Some(roots) = roots {
            let sum: f64 = c.iter().zip(roots).map(|(c, root)| c.abs() * root).sum();
            [sum * sum, 3.0 * sum * sum]
        } else {
            let squares: f64 = c.iter().map(|c| c * c).sum();
            [eeq + 2.0 * squares, squares]
        };
        let (mut edge, mut terms) = (eeq, eeq + of_slopes);
        let [s11, s12, s22] = &self.slope;
        for k in 0..weights.len() {
            let (p, q) = (p_hat[k], q_hat[k]);
            let parts = [s11[k] * p * p, 2.0 * s12[k] * p * q, s22[k] * q * q];
            edge += weights[k] * parts.iter().sum::<f64>();
            terms += weights[k] * parts.iter().map(|part| part.abs()).sum::<f64>();
        }
        (edge, terms, form)
    }
}

/// Returns the sines and cosines of `z`.
fn waves_at(z: &[f64]) -> [Vec<f64>; 2] {
    let (mut sines, mut cosines) = (Vec::new(), Vec::new());
    for z in z {
        let (sine, cosine) = z.sin_cos();
        sines.push(sine);
        cosines.push(cosine);
    }
    [sines, cosines]
}

/// Extrapolates `sum_{i >= n} y_i` of positive terms, the contribution of the modes left out.
///
/// The envelope of the last `y_i` is continued with the rate at which the sums over two neighbouring
/// stretches fall. A stretch spans the beats that the `y_i` show at large `a/t`.
fn missing_modes(y: &[f64]) -> f64 {
    let n = y.len();
    let stretch = (2 + n / 8).min(n / 2);
    let (before, last) = y[n - 2 * stretch..].split_at(stretch);
    let sum = |y: &[f64]| y.iter().sum::<f64>();
    let ratio = sum(last) / sum(before).max(f64::MIN_POSITIVE);
    let rate = ratio.powf(1.0 / stretch as f64).clamp(0.1, 0.95);
    let envelope = last
        .iter()
        .rev()
        .enumerate()
        .map(|(i, y)| y * rate.powi(i as i32));
    envelope.fold(0.0, larger) * rate / (1.0 - rate)
}
