//! Galerkin's method in even Legendre polynomials, with the results in energy form.
//!
//! With `x = a/t` and `g` in units of half the normalising modulus, the contact is
//!
//! ```text
//! g(rho)/es + (x/e1) int_0^1 [k(x(rho-s)) + k(x(rho+s))] g(s) ds = f(rho),    k(y) = 1/pi int_0^inf (X(q)-1) cos(qy) dq
//! f = 1 -> g1:  Eeq = int g1,  Gamma = g1(1)        f = rho^2 -> g2:  Delta0 = g2(1)/Gamma,  Pi0 = 4 int (Delta0 g1 - g2)
//! ```
//!
//! (Barthel, eq. 3, with the sphere's compliance as the diagonal term). In the orthonormal basis
//! `phi_n = sqrt(4n+1) P_2n`, whose cosine transforms are [`EvenBessel`], the kernel becomes
//! `A = I/es + M/e1` with `M_mn = (2/pi) int_0^inf (X-1) J_m J_n dz`, `z = q x`, and the right-hand
//! sides have one and two entries.
//!
//! The edge values come from the exact identity `Gamma^2 = es d(x Eeq)/dx` and from its bilinear
//! form, not from sums at the edge. If `C_mn = (2/pi) int q X' J_m J_n dz`, they are
//!
//! ```text
//! Gamma^2     = es (Eeq     + g1.C.g1 / e1)
//! Gamma g2(1) = es (3 g2[0] + g1.C.g2 / e1)
//! ```
//!
//! Both are stationary in the error of `g`, as `Eeq` is, and so converge twice as fast as `g`
//! itself.
//!
//! `M` and `C` do not depend on the sphere: one pair serves every `E1/E2*` at fixed `a/t`, `nu1`,
//! `nu0` and `E0/E1` ([`Operator::solve`]). The Bessel values do not depend on the material
//! ([`Abscissae`]).

use std::borrow::Borrow;
use std::f64::consts::FRAC_2_PI;

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::{
    LltRegularization, cholesky_in_place, cholesky_in_place_scratch,
};
use faer::linalg::triangular_solve::{
    solve_lower_triangular_in_place, solve_upper_triangular_in_place,
};
use faer::{Mat, Par, Spec};
use interp::{Material, Quantities};

use crate::solve::bessel::{EvenBessel, LANES};
use crate::solve::compliance::{Compliance, Sample};
use crate::solve::estimate::Estimate;
use crate::solve::quadrature::Panels;

/// Solves one contact at `x = a/t`. Adds modes and panels until the estimated error is at most
/// `tolerance`, or until only rounding is left of it.
pub fn solve(x: f64, material: &Material, tolerance: f64) -> Estimate {
    let compliance = Compliance::new(material);
    let (mut modes, ample) = (modes(x, tolerance), modes(x, FINEST));
    let mut panels = Panels::new(x, [&compliance], tolerance);
    let mut quadrature_tolerance = tolerance;
    loop {
        let abscissae = Abscissae::new(x, modes, panels.clone());
        let operator = Operator::assemble(&compliance, &abscissae, abscissae.blocks());
        let Some(solved) = operator.solve(material) else {
            // Too few modes, or too much rounding.
            if modes >= ample {
                return Estimate::FAILED;
            }
            modes = ample;
            continue;
        };
        let error = solved.error();
        if error <= tolerance {
            return Estimate {
                quantities: solved.quantities,
                error,
                modes,
            };
        }
        // Refines the larger source of the error, unless that is rounding.
        if solved.truncation >= 0.5 * error && modes < MOST_MODES {
            modes += 2 + modes / 4;
        } else if solved.quadrature >= 0.5 * error && quadrature_tolerance > FINEST {
            quadrature_tolerance *= 0.01;
            panels = Panels::new(x, [&compliance], quadrature_tolerance);
        } else {
            return Estimate {
                quantities: solved.quantities,
                error,
                modes,
            };
        }
    }
}

/// Estimates the time for one contact roughly, in microseconds, to choose between methods: a fit to
/// the bench `accuracy`.
pub fn cost(x: f64, tolerance: f64) -> f64 {
    let digits = tolerance.ln() * x;
    10.0 + 1e-4 * digits * digits
}

/// The smallest tolerance of truncation and quadrature that is of use: below it, rounding is the
/// larger error.
const FINEST: f64 = 1e-15;

/// A number of modes that no contact within reach needs, even at the tightest tolerance.
const MOST_MODES: usize = 1500;

/// Returns the number of modes that the worst material needs at `x = a/t`.
///
/// The edge layer has width `1/x`, which Legendre modes resolve with a number that grows like
/// `sqrt(x)`. The coefficients were measured over the whole domain of materials.
pub fn modes(x: f64, tolerance: f64) -> usize {
    let digits = -tolerance.log10();
    (2.4 + 0.35 * (digits - 6.0) + (2.6 + 0.42 * (digits - 6.0)) * x.sqrt())
        .ceil()
        .max(3.0) as usize
}

/// The number of abscissae handled at once: the Bessel values of a block stay in the processor's
/// cache.
const BLOCK: usize = 512;

/// The abscissae and weights for one `a/t`, and the number of modes. They do not depend on the
/// material.
#[derive(Clone, Debug)]
pub struct Abscissae {
    x: f64,
    modes: usize,
    panels: Panels,
    /// `q`, panel by panel, padded to a multiple of [`LANES`].
    q: Vec<f64>,
    /// The weight `(2/pi) x w` of every abscissa, zero for the padding.
    weights: Vec<f64>,
}

/// The Bessel values at up to [`BLOCK`] consecutive abscissae.
pub struct Block {
    /// Index of the first abscissa.
    first: usize,
    rows: usize,
    /// `rows x modes`, one column after the other.
    values: Vec<f64>,
}

impl Abscissae {
    /// Places abscissae on `panels`, for `modes` modes at `x = a/t`.
    pub fn new(x: f64, modes: usize, panels: Panels) -> Self {
        let (mut q, mut weights) = (Vec::new(), Vec::new());
        for ends in panels.edges.windows(2) {
            let (middle, half) = (0.5 * (ends[0] + ends[1]), 0.5 * (ends[1] - ends[0]));
            q.extend(panels.rule.abscissae.iter().map(|t| middle + half * t));
            weights.extend(panels.rule.weights.iter().map(|w| FRAC_2_PI * x * half * w));
        }
        let padded = q.len().next_multiple_of(LANES);
        q.resize(padded, q[q.len() - 1]);
        weights.resize(padded, 0.0);
        Self {
            x,
            modes,
            panels,
            q,
            weights,
        }
    }

    /// Evaluates the Bessel functions, a block at a time.
    pub fn blocks(&self) -> impl Iterator<Item = Block> {
        let bessel = EvenBessel::new(self.modes);
        self.q.chunks(BLOCK).enumerate().map(move |(i, q)| {
            let rows = q.len();
            let mut values = vec![0.0; rows * self.modes];
            for (j, q) in q.chunks_exact(LANES).enumerate() {
                let z = std::array::from_fn(|l| q[l] * self.x);
                bessel.fill(&z, &mut values, rows, j * LANES);
            }
            Block {
                first: i * BLOCK,
                rows,
                values,
            }
        })
    }
}

/// The matrices `M` and `C` of one film on one substrate at one `a/t`. Only their lower triangles
/// are stored.
#[derive(Clone, Debug)]
pub struct Operator {
    /// `M`.
    kernel: Mat<f64>,
    /// `C`.
    slope: Mat<f64>,
    /// The error of `g.M.g / (int g)^2` where the panels do not resolve `X` and `q X'`.
    resolution_error: f64,
    /// The error of `g.C.g / g(1)^2` where they do not resolve the Bessel products.
    design_error: f64,
    /// Rounding error of the sums, relative to the sum of absolute values. It grows with the number
    /// of panels that a small scale needs.
    rounding: f64,
}

/// The quantities of one contact, with the sources of their error.
#[derive(Clone, Copy, Debug)]
pub struct Solved {
    /// The four quantities.
    pub quantities: Quantities,
    /// Estimated relative error from the finite number of modes.
    pub truncation: f64,
    /// Estimated relative error from the quadrature.
    pub quadrature: f64,
    /// Estimated relative error from rounding.
    pub rounding: f64,
}

impl Solved {
    /// Returns the estimated relative error from all sources.
    pub fn error(&self) -> f64 {
        self.truncation + self.quadrature + self.rounding
    }
}

impl Operator {
    /// Sums `M` and `C` over the abscissae. `blocks` are those of `abscissae`, evaluated one by one
    /// or kept for many materials.
    pub fn assemble<B: Borrow<Block>>(
        compliance: &Compliance,
        abscissae: &Abscissae,
        blocks: impl IntoIterator<Item = B>,
    ) -> Self {
        let n = abscissae.modes;
        let samples: Vec<Sample> = abscissae.q.iter().map(|&q| compliance.sample(q)).collect();
        let mut operator = Self {
            kernel: Mat::zeros(n, n),
            slope: Mat::zeros(n, n),
            resolution_error: resolution_error(abscissae, &samples),
            design_error: abscissae.panels.design_error,
            rounding: ROUNDING * (1.0 - 0.05 * compliance.smallest_scale().ln()),
        };
        for block in blocks {
            let Block {
                first,
                rows,
                values,
            } = block.borrow();
            let samples = &samples[*first..first + rows];
            let weights = &abscissae.weights[*first..first + rows];
            let terms = || samples.iter().zip(weights);
            let excess: Vec<f64> = terms().map(|(sample, w)| w * sample.excess).collect();
            let slope: Vec<f64> = terms().map(|(sample, w)| w * sample.slope).collect();
            add_products(&mut operator.kernel, values, &excess);
            add_products(&mut operator.slope, values, &slope);
        }
        operator
    }

    /// Solves the contact of one sphere with the film and substrate of this operator. `material`
    /// holds all three bodies.
    ///
    /// Returns `None` where the matrix is not positive definite, by rounding, or `Gamma^2` is not
    /// positive, by too few modes.
    pub fn solve(&self, material: &Material) -> Option<Solved> {
        let n = self.kernel.nrows();
        let (film, es) = (material.film_modulus(), material.sphere_film_modulus());
        let mut factor = Mat::from_fn(n, n, |i, j| {
            self.kernel[(i, j)] / film + if i == j { 1.0 / es } else { 0.0 }
        });
        let mut memory = MemBuffer::new(cholesky_in_place_scratch::<f64>(
            n,
            Par::Seq,
            Spec::default(),
        ));
        let stack = MemStack::new(&mut memory);
        cholesky_in_place(
            factor.as_mut(),
            LltRegularization::default(),
            Par::Seq,
            stack,
            Spec::default(),
        )
        .ok()?;

        // f = 1 and f = rho^2 in the basis.
        let mut g = Mat::zeros(n, 2);
        g[(0, 0)] = 1.0;
        g[(0, 1)] = 1.0 / 3.0;
        g[(1, 1)] = 2.0 / (3.0 * 5.0_f64.sqrt());
        solve_lower_triangular_in_place(factor.as_ref(), g.as_mut(), Par::Seq);
        // Forward substitution does not depend on the modes that follow: the forms of any smaller
        // number of modes are partial sums over these.
        let missing = [0, 1].map(|column| missing_modes(g.col_as_slice(column)));
        solve_upper_triangular_in_place(factor.transpose(), g.as_mut(), Par::Seq);

        let (g1, g2) = (g.col_as_slice(0), g.col_as_slice(1));
        let eeq = g1[0];
        let gamma_squared =
            Some(es * (eeq + form(&self.slope, g1, g1) / film)).filter(|&square| square > 0.0)?;
        let delta0 = es * (3.0 * g2[0] + form(&self.slope, g1, g2) / film) / gamma_squared;
        let edge = (es * eeq / gamma_squared).max(1.0);
        let diagonal = g1.iter().map(|g| g * g).sum::<f64>() / es;
        Some(Solved {
            quantities: Quantities {
                pi0: 4.0 * (delta0 * eeq - g2[0]),
                eeq,
                gamma: gamma_squared.sqrt(),
                delta0,
            },
            truncation: TRUNCATION_SAFETY * missing[0].max(missing[1]) / eeq * edge,
            quadrature: (self.resolution_error * eeq * edge + self.design_error * es) / film,
            rounding: self.rounding * (diagonal + (eeq - diagonal).abs()) / eeq * edge,
        })
    }
}

/// Adds the lower triangle of `J^T F J` to `target`. `bessel` holds `J` by columns, `factors` the
/// diagonal of `F`.
///
/// A matrix library is no faster on matrices of this size: all of `J` is read for few products
/// each.
fn add_products(target: &mut Mat<f64>, bessel: &[f64], factors: &[f64]) {
    let rows = factors.len();
    let mut scaled = vec![0.0; rows];
    for (j, column) in bessel.chunks_exact(rows).enumerate() {
        scaled
            .iter_mut()
            .zip(column)
            .zip(factors)
            .for_each(|((scaled, value), factor)| *scaled = value * factor);
        for (i, column) in bessel.chunks_exact(rows).enumerate().skip(j) {
            target[(i, j)] += product(column, &scaled);
        }
    }
}

/// Returns `a.b` for a number of elements that is a multiple of [`LANES`].
fn product(a: &[f64], b: &[f64]) -> f64 {
    let mut sums = [0.0; LANES];
    for (a, b) in a.chunks_exact(LANES).zip(b.chunks_exact(LANES)) {
        for l in 0..LANES {
            sums[l] += a[l] * b[l];
        }
    }
    sums.iter().sum()
}

/// Returns `u.C.v`, where `matrix` holds the lower triangle of `C`.
fn form(matrix: &Mat<f64>, u: &[f64], v: &[f64]) -> f64 {
    let mut form = 0.0;
    for j in 0..u.len() {
        let column = &matrix.col_as_slice(j)[j..];
        let (u_j, v_j) = (u[j], v[j]);
        form += column[0] * u_j * v_j;
        for ((c, u), v) in column.iter().zip(&u[j..]).zip(&v[j..]).skip(1) {
            form += c * (u * v_j + u_j * v);
        }
    }
    form
}

/// Extrapolates `sum_{i >= n} y_i^2`, the contribution of the modes left out to a form, from the
/// sums over the last two stretches of the `n` modes in `y`.
///
/// A stretch spans the beats that the `y_i` show at large `a/t`, so that a node of a beat is not
/// mistaken for convergence.
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

/// The factor that brings the extrapolation above the true truncation error.
/// `tests/truth/reference.rs` and `tests/truth/domain.rs` measure how far above.
const TRUNCATION_SAFETY: f64 = 20.0;

/// The rounding error of the assembled matrices, for a film that is not stiffer than its substrate.
const ROUNDING: f64 = 12.0 * f64::EPSILON;

/// Estimates the error of the quadrature in `q` from how fast the Legendre coefficients of `q X'`
/// fall on each panel. Those of `X - 1` are smaller, as differentiation multiplies them with their
/// degree.
///
/// An `n`-point rule misses an integrand's coefficients from degree `2n` on. They are extrapolated
/// geometrically from the largest of the last four coefficients, which the panel's own values give.
/// The rate is the mean rate since degree 0, which poles prescribe, or the rate over the last eight
/// degrees if that is faster, as for exponentials. The panel's width keeps the error of the Bessel
/// product small.
fn resolution_error(abscissae: &Abscissae, samples: &[Sample]) -> f64 {
    let rule = abscissae.panels.rule;
    let n = rule.abscissae.len();
    let panels = samples
        .chunks_exact(n)
        .zip(abscissae.weights.chunks_exact(n));
    let error = |(samples, weights): (&[Sample], &[f64])| {
        let length: f64 = weights.iter().sum();
        let largest = samples
            .iter()
            .map(|s| s.slope.abs())
            .fold(f64::MIN_POSITIVE, f64::max);
        let coefficients = rule.coefficients.each_ref().map(|row| {
            row.iter()
                .zip(samples)
                .map(|(c, s)| c * s.slope)
                .sum::<f64>()
                .abs()
        });
        let [before, last] = [0, 4].map(|from| {
            coefficients[from..from + 4]
                .iter()
                .fold(f64::MIN_POSITIVE, |a, &b| a.max(b))
        });
        let mean_rate = (last / largest).powf(n as f64 / (n as f64 - 2.5));
        let present_rate = (last / before).powf(0.25 * n as f64);
        length * last * mean_rate.min(present_rate).min(1.0)
    };
    panels.map(error).sum()
}
