//! The matrices of Galerkin's method for one film on one substrate, or for one stack of layers, and
//! the contact of a sphere with them. Of `C` a contact needs a few forms only (`slope.rs`).
//!
//! # The motion of the contact as a whole
//!
//! A stiff film on a soft base yields to long waves without bending within the contact: `M_00` is
//! larger than all other elements by up to `(E1/E0)^{2/3}`, and the two terms of `Gamma^2` cancel
//! to as many digits. The first mode is therefore eliminated by hand. In units of `es`, with `f =
//! es/e1`, the first column `m` of `M` and `c` of `C` and the remaining blocks `M'` and `C'`,
//!
//! ```text
//! B = I + f M',      h = B^-1 f m,      w = B^-1 (2/(3 sqrt5), 0, ...),      k = 1/3 - h.(2/(3 sqrt5), 0, ...)
//! softness = 1 + f M_00 - f m.h                               edge = 1 + f (M_00 + C_00) - f m.h - 2 f c.h + f h.C'.h
//! load = 2 k + f c.w - f h.C'.w
//!
//! Eeq = 1/softness      Gamma = sqrt(edge)/softness      Pi0 = 4 load/edge      Delta0 = k + Pi0 softness/4
//! ```
//!
//! Another power `rho^n` has its own `w`, from its coefficients without the first, and its own `k`,
//! with its first coefficient instead of `1/3`; in its load `2 k` becomes `n k`.
//!
//! Long waves enter the softness only: in `M_00 + C_00 = (2/pi) int (q (X-1))' J_0^2 dz` they are
//! integrated by parts ([`LongWaves`](crate::galerkin::abscissae::LongWaves)). Each term is then
//! accurate for every contrast of the moduli.

use std::iter;

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::{
    LltRegularization, cholesky_in_place, cholesky_in_place_scratch,
};
use faer::linalg::matmul::triangular::{BlockStructure, matmul};
use faer::linalg::triangular_solve::{
    solve_lower_triangular_in_place, solve_upper_triangular_in_place,
};
use faer::{Accum, Mat, MatRef, Par, Spec};
use fearless_simd::prelude::*;
use fearless_simd::{Level, dispatch, f64x8};
use interp::Quantities;

use crate::compliance::surface::{AllSamples, SurfaceCompliance};
use crate::compliance::symbol::Symbol;
use crate::estimate::larger;
use crate::galerkin::abscissae::{Abscissae, BesselValues, SQRT_5};
use crate::galerkin::bessel::LANES;
use crate::galerkin::slope::{Slope, dot};
use crate::power_law::{PowerLaw, coefficients};

/// The second entry of `rho^2` in the basis.
const PARABOLA: f64 = 2.0 / (3.0 * SQRT_5);

/// The matrices `M`, as its lower triangle, and `C` of one surface at one `a/t`.
#[derive(Clone, Debug)]
pub struct Operator<'a> {
    /// `M`.
    kernel: Mat<f64>,
    /// `C`.
    slope: Slope<'a>,
    /// `M_00 + C_00`, in which the compliance of long waves cancels.
    translation: f64,
    /// The error of `v.M.v` where the panels do not resolve `X` and `q X'`.
    resolution_error: f64,
    /// The same for `v.(M + C).v`, to which long waves hardly add.
    shape_error: f64,
    /// The error of `g.C.g / g(1)^2` where they do not resolve the Bessel products.
    design_error: f64,
    /// Rounding error of the sums, relative to the sum of absolute values. It grows with the number
    /// of panels that a small scale needs.
    rounding: f64,
}

/// The quantities of one contact, with the sources of their error.
#[derive(Clone, Debug)]
pub struct Solved {
    /// The four quantities.
    pub quantities: Quantities,
    /// The contacts of the power laws asked for.
    pub power_laws: Vec<PowerLaw>,
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

impl Operator<'static> {
    /// Sums `M` and `C` over the abscissae, for many spheres. `bessel` holds the values at
    /// `abscissae`, which may serve many surfaces.
    pub fn for_many_spheres(
        compliance: &dyn SurfaceCompliance,
        abscissae: &Abscissae,
        bessel: &BesselValues,
    ) -> Self {
        let (mut operator, factors) = Self::assemble(compliance, abscissae, bessel);
        let mut slope = Mat::zeros(abscissae.modes, abscissae.modes);
        for block in bessel.blocks() {
            add_products(&mut slope, block.values, &factors[block.range()]);
        }
        operator.slope = Slope::Matrix(slope);
        operator
    }
}

impl<'a> Operator<'a> {
    /// Sums `M` over the abscissae, and keeps what one sphere needs of `C`.
    pub fn for_one_sphere(
        compliance: &dyn SurfaceCompliance,
        abscissae: &Abscissae,
        bessel: &'a BesselValues,
    ) -> Self {
        let (mut operator, factors) = Self::assemble(compliance, abscissae, bessel);
        operator.slope = Slope::Values(bessel, factors);
        operator
    }

    /// Sums `M` and `M_00 + C_00`. Returns the operator without `C`, and the factor of the Bessel
    /// products of `C` at every abscissa.
    fn assemble(
        compliance: &dyn SurfaceCompliance,
        abscissae: &Abscissae,
        bessel: &BesselValues,
    ) -> (Self, Vec<f64>) {
        let n = abscissae.modes;
        let AllSamples {
            mut excess,
            mut slope,
        } = compliance.sample_all(&abscissae.q);
        let [resolution_error, shape_error] = quadrature_errors(abscissae, &slope);
        for values in [&mut excess, &mut slope] {
            let weigh = |(value, weight): (&mut f64, &f64)| *value *= weight;
            values.iter_mut().zip(&abscissae.weights).for_each(weigh);
        }
        let [of_excess, of_slope] = &bessel.translation;
        let mut operator = Self {
            kernel: Mat::zeros(n, n),
            slope: Slope::Matrix(Mat::new()),
            translation: abscissae.long_waves().boundary(abscissae.x, compliance)
                + dot(of_excess, &excess)
                + dot(of_slope, &slope),
            resolution_error,
            shape_error,
            design_error: abscissae.panels.design_error,
            rounding: ROUNDING * (1.0 - 0.05 * compliance.smallest_scale().ln()),
        };
        for block in bessel.blocks() {
            add_products(&mut operator.kernel, block.values, &excess[block.range()]);
        }
        (operator, slope)
    }

    /// Solves the contact of one sphere alone, as [`Operator::solve`], if its estimated error is at most
    /// `tolerance`.
    pub fn solve_to<C: SurfaceCompliance>(
        &self,
        symbol: &Symbol<C>,
        tolerance: f64,
    ) -> Option<Solved> {
        self.solve(symbol, &[])
            .filter(|solved| solved.error() <= tolerance)
    }

    /// Solves the contact of one sphere with the film and substrate of this operator, and of the
    /// probes `c r^n` with the `exponents` n. Of the `symbol` it takes the share of the film and the
    /// modulus.
    ///
    /// Returns `None` where the matrix is not positive definite, by rounding, or `Gamma^2` is not
    /// positive, by too few modes.
    pub fn solve<C: SurfaceCompliance>(
        &self,
        symbol: &Symbol<C>,
        exponents: &[f64],
    ) -> Option<Solved> {
        let (film, es) = (symbol.film(), symbol.modulus());
        let n = self.kernel.nrows() - 1;
        let mut factor = Mat::zeros(n, n);
        for j in 0..n {
            let column = &self.kernel.col_as_slice(j + 1)[j + 1..];
            let target = &mut factor.col_as_slice_mut(j)[j..];
            target
                .iter_mut()
                .zip(column)
                .for_each(|(target, kernel)| *target = film * kernel);
            target[0] += 1.0;
        }
        factorise(&mut factor)?;

        // The first mode, the paraboloid, then the other profiles.
        let mut solutions = Mat::zeros(n, 2 + exponents.len());
        for (i, value) in solutions.col_as_slice_mut(0).iter_mut().enumerate() {
            *value = film * self.kernel[(i + 1, 0)];
        }
        solutions[(0, 1)] = PARABOLA;
        for (j, &exponent) in exponents.iter().enumerate() {
            let coefficients = coefficients(exponent, n + 1).skip(1);
            let column = solutions.col_as_slice_mut(2 + j);
            column
                .iter_mut()
                .zip(coefficients)
                .for_each(|(value, c)| *value = c);
        }
        solve_lower_triangular_in_place(factor.as_ref(), solutions.as_mut(), Par::Seq);
        // Forward substitution does not depend on the modes that follow: the forms of any smaller
        // number of modes are partial sums over these.
        let half = solutions.col_as_slice(0);
        let missing = missing_modes(half);
        let yielding = dot(half, half);
        let profiles = || iter::once(2.0).chain(exponents.iter().copied()).zip(1..);
        let halves: Vec<Half> = profiles()
            .map(|(_, column)| {
                let profile = solutions.col_as_slice(column);
                Half {
                    missing: missing_modes(profile),
                    tilt: dot(half, profile),
                }
            })
            .collect();
        solve_upper_triangular_in_place(factor.transpose(), solutions.as_mut(), Par::Seq);
        let h = solutions.col_as_slice(0);
        let squares = 1.0 + dot(h, h);
        let forms = self.slope.forms(&solutions);
        let [ch, chh] = forms[0].map(|form| film * form);

        let softness = 1.0 + film * self.kernel[(0, 0)] - yielding;
        let edge = 1.0 + film * self.translation - yielding - 2.0 * ch + chh;
        if !(softness > 0.0 && edge > 0.0) {
            return None;
        }
        let mut size = larger(
            (squares + (softness - squares).abs()) / softness,
            (squares + film * self.translation.abs() + yielding + 2.0 * ch.abs() + chh.abs())
                / edge,
        );
        let mut truncation = larger(missing / softness, missing / edge);
        let mut solve_profile = |((exponent, column), half): ((f64, usize), Half)| {
            let w = solutions.col_as_slice(column);
            let share = 1.0 / (exponent + 1.0) - half.tilt;
            let [cw, chw] = forms[column].map(|form| film * form);
            let sum = exponent * share + cw - chw;
            let terms = (squares * dot(w, w)).sqrt()
                + 1.0
                + exponent * half.tilt.abs()
                + cw.abs()
                + chw.abs();
            size = larger(size, terms / sum);
            // The tilt enters the load times the exponent. The safety factor is for a paraboloid.
            let weight = (0.5 * exponent).max(1.0);
            truncation = larger(truncation, weight * (missing * half.missing).sqrt() / sum);
            let load = 4.0 * sum / edge;
            (sum > 0.0).then_some(PowerLaw {
                exponent,
                pi: es * load,
                delta: share + 0.25 * load * softness,
            })
        };
        let mut solved = profiles().zip(halves).map(&mut solve_profile);
        let paraboloid = solved.next()??;
        let power_laws = solved.collect::<Option<_>>()?;
        Some(Solved {
            quantities: Quantities {
                pi0: paraboloid.pi,
                eeq: es / softness,
                gamma: es * edge.sqrt() / softness,
                delta0: paraboloid.delta,
            },
            power_laws,
            truncation: TRUNCATION_SAFETY * truncation,
            quadrature: film
                * (self.resolution_error / softness + self.shape_error / edge + self.design_error),
            rounding: self.rounding * size,
        })
    }
}

/// Replaces the lower triangle of a matrix by Cholesky's factor. Returns `None` where the matrix is
/// not positive definite.
pub fn factorise(matrix: &mut Mat<f64>) -> Option<()> {
    let (rows, parallel) = (matrix.nrows(), Par::Seq);
    let scratch = cholesky_in_place_scratch::<f64>(rows, parallel, Spec::default());
    let (mut memory, regularization) = (MemBuffer::new(scratch), LltRegularization::default());
    let stack = MemStack::new(&mut memory);
    cholesky_in_place(
        matrix.as_mut(),
        regularization,
        parallel,
        stack,
        Spec::default(),
    )
    .ok()
    .map(|_| ())
}

/// What forward substitution gives of one profile.
struct Half {
    /// The contribution of the modes left out to the square of its norm.
    missing: f64,
    /// The form with the first mode, `h.(c_1, c_2, ...)`.
    tilt: f64,
}

/// The number of modes from which on the products of a matrix library are faster.
const LIBRARY: usize = 20;

/// Adds the lower triangle of `J^T F J` to `target`. `bessel` holds `J` by columns, `factors` the
/// diagonal of `F`; their number is a multiple of [`LANES`].
pub(crate) fn add_products(target: &mut Mat<f64>, bessel: &[f64], factors: &[f64]) {
    let (rows, modes) = (factors.len(), target.nrows());
    if modes < LIBRARY {
        dispatch!(Level::new(), simd => add_small(simd, target, bessel, factors));
        return;
    }
    let mut scaled = Vec::with_capacity(bessel.len());
    for column in bessel.chunks_exact(rows) {
        let scale = |(value, factor): (&f64, &f64)| value * factor;
        scaled.extend(column.iter().zip(factors).map(scale));
    }
    matmul(
        target.as_mut(),
        BlockStructure::TriangularLower,
        Accum::Add,
        MatRef::from_column_major_slice(bessel, rows, modes).transpose(),
        BlockStructure::Rectangular,
        MatRef::from_column_major_slice(&scaled, rows, modes),
        BlockStructure::Rectangular,
        1.0,
        Par::Seq,
    );
}

/// Adds the products of a few modes, as [`add_products`].
#[inline(always)]
fn add_small<S: Simd>(simd: S, target: &mut Mat<f64>, bessel: &[f64], factors: &[f64]) {
    /// The number of columns that are multiplied at once. Their sums are independent: the processor
    /// need not wait for one addition before it begins the next.
    const AT_ONCE: usize = 4;
    let rows = factors.len();
    let mut scaled = vec![0.0; rows];
    for j in 0..target.ncols() {
        let columns = &bessel[j * rows..];
        for (i, scaled) in scaled.chunks_exact_mut(LANES).enumerate() {
            let group = |values: &[f64]| f64x8::from_slice(simd, &values[i * LANES..][..LANES]);
            (group(columns) * group(factors)).store_slice(scaled);
        }
        let target = &mut target.col_as_slice_mut(j)[j..];
        let (several, rest) = target.as_chunks_mut::<AT_ONCE>();
        let (columns, columns_of_rest) = columns.split_at(several.len() * AT_ONCE * rows);
        for (target, columns) in several.iter_mut().zip(columns.chunks_exact(AT_ONCE * rows)) {
            add_dots(simd, target.each_mut(), columns, &scaled);
        }
        match rest {
            [a] => add_dots(simd, [a], columns_of_rest, &scaled),
            [a, b] => add_dots(simd, [a, b], columns_of_rest, &scaled),
            [a, b, c] => add_dots(simd, [a, b, c], columns_of_rest, &scaled),
            _ => {}
        }
    }
}

/// Adds the scalar products of `N` columns with `right`.
#[inline(always)]
fn add_dots<S: Simd, const N: usize>(
    simd: S,
    targets: [&mut f64; N],
    columns: &[f64],
    right: &[f64],
) {
    let rows = right.len();
    let mut sums = [f64x8::splat(simd, 0.0); N];
    for (i, right) in right.chunks_exact(LANES).enumerate() {
        let right = f64x8::from_slice(simd, right);
        for (k, sum) in sums.iter_mut().enumerate() {
            let left = f64x8::from_slice(simd, &columns[k * rows + i * LANES..][..LANES]);
            *sum = left.mul_add(right, *sum);
        }
    }
    for (target, sum) in targets.into_iter().zip(sums) {
        *target += sum.iter().sum::<f64>();
    }
}

/// Extrapolates `sum_{i >= n} y_i^2`, the contribution of the modes left out to a form, from the
/// sums over the last stretches of the `n` modes in `y`.
///
/// A stretch spans the beats that the `y_i` show at large `a/t`, so that a node of a beat is not
/// mistaken for convergence. Of few modes a stretch is one mode, which may be nearly 0 by chance.
/// Therefore the last sum counts as no less than a part of what the sums before lead to expect.
pub fn missing_modes(y: &[f64]) -> f64 {
    /// The least ratio of the last two sums, as a part of the ratio of the two before.
    const LEAST: f64 = 0.2;
    /// The least ratio where there are only two sums, as a part of the first.
    const LEAST_OF_TWO: f64 = 5e-4;
    let n = y.len();
    let stretch = (2 + n / 8).min(n / 3).max(1);
    let mut sums = y
        .rchunks_exact(stretch)
        .map(|y| y.iter().map(|y| y * y).sum::<f64>().max(f64::MIN_POSITIVE));
    let [last, before] = [(); 2].map(|()| sums.next().expect("there are two modes at least"));
    let least = match sums.next() {
        Some(earlier) => LEAST * (before / earlier).min(1.0),
        // The mode before them, which is eliminated by hand, is of size 1.
        None => LEAST_OF_TWO * before.min(1.0),
    };
    let ratio = (last / before).max(least);
    let (last, ratio) = (before * ratio, ratio.clamp(0.1, 0.9));
    last * ratio / (1.0 - ratio)
}

/// The factor that brings the extrapolation above the true truncation error.
/// `tests/truth/reference.rs` and `tests/truth/hard_cases.rs` measure how far above.
pub const TRUNCATION_SAFETY: f64 = 20.0;

/// The rounding error of the assembled matrices, for a film that is not stiffer than its substrate.
pub const ROUNDING: f64 = 12.0 * f64::EPSILON;

/// Estimates the errors of the quadrature in `q`, for `M` and for `M + C`, from how fast the
/// Legendre coefficients of `q X'` fall on each panel. Those of `X - 1` are smaller, as
/// differentiation multiplies them with their degree.
///
/// An `n`-point rule misses an integrand's coefficients from degree `2n` on. They are extrapolated
/// geometrically from the largest of the last four coefficients, which the panel's own values give.
/// The rate is the mean rate since degree 0, which poles prescribe, or the rate over the last eight
/// degrees if that is faster, as for exponentials. The panel's width keeps the error of the Bessel
/// product small.
pub fn quadrature_errors(abscissae: &Abscissae, slope: &[f64]) -> [f64; 2] {
    dispatch!(Level::new(), simd => resolution_errors(simd, abscissae, slope))
}

/// [`quadrature_errors`] with vector instructions.
#[inline(always)]
fn resolution_errors<S: Simd>(simd: S, abscissae: &Abscissae, slope: &[f64]) -> [f64; 2] {
    let rule = abscissae.panels.rule;
    let n = rule.abscissae.len();
    let mut errors = [0.0; 2];
    let ends = abscissae.panels.edges.windows(2);
    for ((slope, weights), ends) in slope
        .chunks_exact(n)
        .zip(abscissae.weights.chunks_exact(n))
        .zip(ends)
    {
        let length: f64 = weights.iter().sum();
        let mut coefficients = f64x8::splat(simd, 0.0);
        for (factors, &slope) in rule.coefficients.iter().zip(slope) {
            coefficients = f64x8::from_slice(simd, factors).mul_add(slope, coefficients);
        }
        let largest = |values: &[f64]| {
            let larger = |largest: f64, value: &f64| largest.max(value.abs());
            values.iter().fold(f64::MIN_POSITIVE, larger)
        };
        let (before, last) = coefficients.as_slice().split_at(4);
        let (before, last, largest) = (largest(before), largest(last), largest(slope));
        // An estimate needs no more than single precision, which takes a fraction of the time.
        let mean_rate = ((last / largest) as f32).powf(n as f32 / (n as f32 - 2.5));
        // The numbers of points of all rules are multiples of 4.
        let present_rate = (last / before).powi(n as i32 / 4);
        let error = length * last * f64::from(mean_rate).min(present_rate).min(1.0);
        errors[0] += error;
        errors[1] += error * (abscissae.x * ends[1]).powi(2).min(1.0);
    }
    errors
}
