//! The growing contact with stick: every smaller punch, and the Volterra equation along them.
//!
//! While a contact grows, points inside it move with the tip, and every increment is a stuck flat
//! punch of the present radius. With the unit punch of radius `a`, lengths in units of `t`, and its
//! transforms `p^`, `q^`,
//!
//! ```text
//! int_0^s v(a) D(s;a) da = b(s)        D(s;a) = 1 - f (2/pi) int [(X11-1) a p^ + (X12-b) a q^] cos(ks) dk
//! ```
//!
//! gives the rate `v = d delta/da` for every radius `s` up to the largest. With attraction (a point
//! joins the contact with the displacement it has), the part in proportion to the root of the work
//! of adhesion solves the same equation,
//!
//! ```text
//! int_0^s v_w D da = -(1/es) [sqrt(s) + int_0^s sqrt(a) Q(s;a) da]        Q(s;a) = f (2/pi) int [(X11-1)(cos ka - p^') - (X12-b) q^'] cos(ks) dk
//! ```
//!
//! with the answer `p^'`, `q^'` of the punch to its edge. In `tau = sqrt(a)` all is smooth:
//! `v da = tau^{2n-1} psi d tau` for the profile `r^n`, and `v_w da = psi_w d tau`.

use faer::linalg::solvers::Solve;
use faer::{Mat, Par};

use crate::estimate::larger;
use crate::parallel::try_map;
use crate::stick::field::{Field, Waves};
use crate::stick::integration::Points;

/// The numbers of a growing contact at one radius.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grown {
    /// `a/t`.
    pub a_over_t: f64,
    /// The stiffness of the flat punch with stick, `S_s = 2 a E* Eeq_s`.
    pub eeq_s: f64,
    /// The singularity of the normal stress at the edge of this punch.
    pub gamma_s: f64,
    /// The singularity of the shear stress at the edge of this punch.
    pub gamma_t: f64,
    /// The load without adhesion, `F = a^3 E* Pi_s/(2R)` under a sphere; in general as
    /// [`PowerLaw::pi`](crate::PowerLaw::pi).
    pub pi_s: f64,
    /// The penetration without adhesion, `delta = a^2 Delta_s/R` under a sphere; in general as
    /// [`PowerLaw::delta`](crate::PowerLaw::delta).
    pub delta_s: f64,
    /// The penetration that the work of adhesion takes off, `(2 pi a w Es*)^{1/2}/(E* Gamma_g)`.
    pub gamma_g: f64,
    /// The load that it takes off, `2 a E* Eeq_g` times this penetration.
    pub eeq_g: f64,
}

/// A growing contact, at Gauss's points in the root of the radius.
pub struct Growth {
    pub points: Points,
    pub at_points: Vec<Grown>,
    /// The largest estimated relative error of a punch.
    pub error_of_punches: f64,
}

/// Solves the contact of the profile `r^exponent` up to `a/t = largest` with `count` points.
pub fn grow(
    waves: &Waves<'_>,
    largest: f64,
    exponent: f64,
    count: usize,
    modes: impl Fn(f64) -> usize + Sync,
) -> Option<Growth> {
    let points = Points::new(count, largest.sqrt());
    let fields: Vec<Field> = try_map(&points.at, |tau| {
        let x = tau * tau;
        waves.field(x, modes(x), true).ok_or(())
    })
    .ok()?;
    let es = waves.bodies.modulus;
    let rows = waves.q.len();
    let columns = |value: &dyn Fn(usize, usize) -> f64| Mat::from_fn(rows, count, value);
    let mut cosines = Mat::<f64>::zeros(rows, count);
    for (j, tau) in points.at.iter().enumerate() {
        let column = cosines.col_as_slice_mut(j);
        for ((cosine, q), weight) in column.iter_mut().zip(&waves.q).zip(&waves.weights) {
            *cosine = weight * (q * tau * tau).cos();
        }
    }
    let product = |right: Mat<f64>| {
        let mut product = Mat::<f64>::zeros(count, count);
        faer::linalg::matmul::matmul(
            product.as_mut(),
            faer::Accum::Replace,
            cosines.transpose(),
            right.as_ref(),
            1.0,
            Par::Seq,
        );
        product
    };
    let normal = product(columns(&|k, j| fields[j].x * fields[j].normal[k]));
    let answer = product(columns(&|k, j| {
        fields[j].answer.as_ref().expect("asked for")[k]
    }));
    let power = 2.0 * exponent - 1.0;
    let [of_shape, of_load, of_edge, of_edge_load] =
        [power, power + 2.0, 0.0, 2.0].map(|power| points.integrals(power));
    let system = |integrals: &Mat<f64>| {
        Mat::from_fn(count, count, |i, j| {
            integrals[(j, i)] * (1.0 - normal[(i, j)])
        })
    };
    let shape = system(&of_shape)
        .partial_piv_lu()
        .solve(Mat::from_fn(count, 1, |_, _| 1.0));
    let edge = system(&of_edge)
        .partial_piv_lu()
        .solve(Mat::from_fn(count, 1, |i, _| {
            let a = points.at[i] * points.at[i];
            let sum: f64 = (0..count)
                .map(|j| of_edge_load[(j, i)] * answer[(i, j)])
                .sum();
            -(1.0 + 2.0 * a * sum) / es
        }));
    let sum = |integrals: &Mat<f64>, i: usize, value: &dyn Fn(usize) -> f64| -> f64 {
        let weights = integrals.col_as_slice(i).iter().enumerate();
        weights.map(|(j, weight)| weight * value(j)).sum()
    };
    let mut error_of_punches: f64 = 0.0;
    let at_points = (0..count)
        .map(|i| {
            let field = &fields[i];
            error_of_punches = larger(error_of_punches, field.error());
            let eeq = |j: usize| es * fields[j].eeq;
            let [gamma_s, gamma_t] = field.parts.expect("no coupling");
            let gamma_g = -1.0 / sum(&of_edge, i, &|j| edge[(j, 0)]);
            let gammas = |j: usize| fields[j].parts.expect("no coupling")[0];
            Grown {
                a_over_t: field.x,
                eeq_s: es * field.eeq,
                gamma_s: es * gamma_s,
                gamma_t: es * gamma_t,
                delta_s: sum(&of_shape, i, &|j| shape[(j, 0)]),
                pi_s: 4.0 * sum(&of_load, i, &|j| eeq(j) * shape[(j, 0)]),
                gamma_g,
                eeq_g: -gamma_g
                    * sum(&of_edge_load, i, &|j| {
                        eeq(j) * edge[(j, 0)] - 2.0 * gammas(j)
                    }),
            }
        })
        .collect();
    Some(Growth {
        points,
        at_points,
        error_of_punches,
    })
}

impl Growth {
    /// Returns the largest relative difference from a contact solved with more points.
    pub fn difference(&self, finer: &Self) -> f64 {
        let mut largest = 0.0;
        for coarse in &self.at_points {
            let fine = finer.at(coarse.a_over_t);
            let pairs = [
                (coarse.pi_s, fine.pi_s),
                (coarse.delta_s, fine.delta_s),
                (coarse.gamma_g, fine.gamma_g),
                (coarse.eeq_g, fine.eeq_g),
            ];
            for (a, b) in pairs {
                largest = larger(largest, (a / b - 1.0).abs());
            }
        }
        largest
    }

    /// Returns the contact at a radius up to the largest.
    pub fn at(&self, a_over_t: f64) -> Grown {
        let weights = self.points.interpolation(a_over_t.sqrt());
        let mean = |value: fn(&Grown) -> f64| -> f64 {
            self.at_points
                .iter()
                .zip(&weights)
                .map(|(grown, weight)| weight * value(grown))
                .sum()
        };
        Grown {
            a_over_t,
            eeq_s: mean(|grown| grown.eeq_s),
            gamma_s: mean(|grown| grown.gamma_s),
            gamma_t: mean(|grown| grown.gamma_t),
            pi_s: mean(|grown| grown.pi_s),
            delta_s: mean(|grown| grown.delta_s),
            gamma_g: mean(|grown| grown.gamma_g),
            eeq_g: mean(|grown| grown.eeq_g),
        }
    }
}
