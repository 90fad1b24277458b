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

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::{
    LltRegularization, cholesky_in_place, cholesky_in_place_scratch,
};
use faer::linalg::triangular_solve::{
    solve_lower_triangular_in_place, solve_upper_triangular_in_place,
};
use faer::{Mat, Par, Spec};

use crate::abscissae::Abscissae;

use crate::quadrature::Panels;
use crate::slope::dot;
use crate::stick::bodies::Bodies;
use crate::stick::compliances::{Samples, Three, sample_all};
use crate::stick::coulomb::{Coulomb, LANES, Target};
use crate::stick::products::add_lower;

/// The bodies at the wave numbers of the integrals, for punches up to some radius.
pub struct Waves<'a> {
    /// The bodies.
    pub bodies: &'a Bodies,
    /// The wave numbers `q`, padded to a multiple of [`LANES`].
    pub q: Vec<f64>,
    /// The weights `(2/pi) dq`, 0 for the padding.
    pub weights: Vec<f64>,
    /// `f` times the compliances without their limits.
    pub excess: Three<Vec<f64>>,
    /// `f q` times their derivatives.
    slope: Three<Vec<f64>>,
    /// The error of the integrals, relative to the squares of the fields' edge values.
    pub quadrature: f64,
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
    /// The contribution to `Eeq_s/es` of the modes left out.
    pub missing: f64,
    /// The number of modes.
    pub modes: usize,
}

impl<'a> Waves<'a> {
    /// Samples the surface on `panels`.
    pub fn new(bodies: &'a Bodies, panels: Panels) -> Self {
        let abscissae = Abscissae::new(1.0, 0, panels);
        let Samples {
            mut excess,
            mut slope,
        } = sample_all(&bodies.surface, &abscissae.q);
        for values in excess.iter_mut().chain(&mut slope) {
            values.iter_mut().for_each(|value| *value *= bodies.film);
        }
        if !bodies.sticks {
            for values in excess[1..].iter_mut().chain(&mut slope[1..]) {
                values.fill(0.0);
            }
        }
        Self {
            bodies,
            q: abscissae.q,
            weights: abscissae.weights,
            excess,
            slope,
            quadrature: abscissae.panels.design_error,
        }
    }

    /// Solves the punch of radius `x = a/t` with an even number of `modes`; `with_answer` asks for
    /// [`Field::answer`].
    ///
    /// Returns `None` where the matrix is not positive definite, by rounding.
    pub fn field(&self, x: f64, modes: usize, with_answer: bool) -> Option<Field> {
        let rows = self.q.len();
        let coulomb = Coulomb::new(self.bodies.eps, modes, x * self.q[rows - 1]);
        let [of_p, of_q] = coulomb.columns();
        let (mut p, mut q) = (vec![0.0; of_p * rows], vec![0.0; of_q * rows]);
        for (j, group) in self.q.chunks_exact(LANES).enumerate() {
            let z = std::array::from_fn(|l| group[l] * x);
            let mut target = Target {
                p: &mut p,
                q: &mut q,
                stride: rows,
                at: j * LANES,
            };
            coulomb.fill(&z, &mut target);
        }
        let weights: Vec<f64> = self.weights.iter().map(|w| w * x).collect();
        let first_q = modes - of_q;
        // The products of the compliances with the transforms, columns of all modes: those beside
        // `p` and those beside `q`.
        let combine = |[direct, mixed]: [usize; 2], transposed: bool| {
            let mut columns = vec![0.0; modes * rows];
            for (n, column) in columns.chunks_exact_mut(rows).enumerate() {
                let of_p = (n < of_p).then(|| &p[n * rows..][..rows]);
                let of_q = (n >= first_q).then(|| &q[(n - first_q) * rows..][..rows]);
                let (own, other) = if transposed {
                    (of_q, of_p)
                } else {
                    (of_p, of_q)
                };
                for (values, factor) in [(own, direct), (other, mixed)] {
                    let Some(values) = values else { continue };
                    let factors = self.excess[factor].iter().zip(&weights);
                    for ((sum, value), (factor, weight)) in
                        column.iter_mut().zip(values).zip(factors)
                    {
                        *sum += factor * weight * value;
                    }
                }
            }
            columns
        };
        let beside_p = combine([0, 1], false);
        let beside_q = combine([2, 1], true);
        let mut matrix = Mat::<f64>::zeros(modes, modes);
        add_lower(&mut matrix, 0, &p, &beside_p, rows);
        add_lower(&mut matrix, first_q, &q, &beside_q, rows);
        let diagonal = 1.0 / self.bodies.cosh();
        for n in 0..modes {
            matrix[(n, n)] += diagonal;
        }
        let mut memory = MemBuffer::new(cholesky_in_place_scratch::<f64>(
            modes,
            Par::Seq,
            Spec::default(),
        ));
        let stack = MemStack::new(&mut memory);
        cholesky_in_place(
            matrix.as_mut(),
            LltRegularization::default(),
            Par::Seq,
            stack,
            Spec::default(),
        )
        .ok()?;

        let c0 = self.bodies.c0();
        let [sines, cosines] = self.waves_at(x);
        let mut solutions = Mat::<f64>::zeros(modes, if with_answer { 2 } else { 1 });
        solutions[(0, 0)] = c0;
        if with_answer {
            for n in 0..modes {
                solutions[(n, 1)] = dot(&beside_p[n * rows..][..rows], &cosines);
            }
        }
        solve_lower_triangular_in_place(matrix.as_ref(), solutions.as_mut(), Par::Seq);
        let half = solutions.col_as_slice(0);
        let ne = modes / 2;
        let missing = missing_modes(&half[..ne]) + missing_modes(&half[ne..]);
        solve_upper_triangular_in_place(matrix.transpose(), solutions.as_mut(), Par::Seq);

        let transform = |solution: &[f64]| {
            let mut hats = [vec![0.0; rows], vec![0.0; rows]];
            for (hat, (values, first)) in hats.iter_mut().zip([(&p, 0), (&q, first_q)]) {
                for (values, c) in values.chunks_exact(rows).zip(&solution[first..]) {
                    for (sum, value) in hat.iter_mut().zip(values) {
                        *sum += c * value;
                    }
                }
            }
            hats
        };
        let c = solutions.col_as_slice(0);
        let [p_hat, q_hat] = transform(c);
        let eeq = c0 * c[0];
        let mut edge = eeq;
        let [s11, s12, s22] = &self.slope;
        for k in 0..rows {
            let (p, q) = (p_hat[k], q_hat[k]);
            edge += weights[k] * (s11[k] * p * p + 2.0 * s12[k] * p * q + s22[k] * q * q);
        }
        let [y11, y12, y22] = &self.excess;
        let normal: Vec<f64> = (0..rows)
            .map(|k| y11[k] * p_hat[k] + y12[k] * q_hat[k])
            .collect();
        let parts = (self.bodies.eps == 0.0).then(|| {
            let (mut of_normal, mut of_shear) = (0.0, 0.0);
            for k in 0..rows {
                of_normal += weights[k] * normal[k] * cosines[k];
                of_shear += weights[k] * (y22[k] * q_hat[k] + y12[k] * p_hat[k]) * sines[k];
            }
            [1.0 - of_normal, -of_shear]
        });
        let answer = with_answer.then(|| {
            let [p_hat, q_hat] = transform(solutions.col_as_slice(1));
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
            missing,
            modes,
        })
    }

    /// Returns the sines and cosines of `q x`.
    pub fn waves_at(&self, x: f64) -> [Vec<f64>; 2] {
        let (mut sines, mut cosines) = (Vec::new(), Vec::new());
        for q in &self.q {
            let (sine, cosine) = (q * x).sin_cos();
            sines.push(sine);
            cosines.push(cosine);
        }
        [sines, cosines]
    }
}

/// Extrapolates `sum_{i >= n} y_i^2`, the contribution of the modes left out, from the sums over
/// the last two stretches of the `n` modes in `y`.
fn missing_modes(y: &[f64]) -> f64 {
    let n = y.len();
    let stretch = (2 + n / 8).min(n / 2);
    let sum = |y: &[f64]| y.iter().map(|y| y * y).sum::<f64>();
    let (before, last) = (
        sum(&y[n - 2 * stretch..n - stretch]),
        sum(&y[n - stretch..]),
    );
    let ratio = (last / before.max(f64::MIN_POSITIVE)).clamp(0.1, 0.9);
    last * ratio / (1.0 - ratio)
}
