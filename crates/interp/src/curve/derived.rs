//! All quantities of a curve from `Gamma` alone, by three integrals over `a/t`.
//!
//! # The identities
//!
//! With `x = a/t`, a prime for `d/dx` and `es` the sphere-film modulus,
//!
//! ```text
//! (x Eeq/es)'   = (Gamma/es)^2
//! (x^2 Delta0)' = 2 x (Eeq/es) / (Gamma/es)^2
//! (x^3 Pi0/es)' = 8 x^2 (Eeq/es)^2 / (Gamma/es)^2
//! ```
//!
//! In terms of the stiffness `S` of the flat punch they are `S' = 2 E2* Gamma^2/es`,
//! `delta0' = (2/R) S/S'` and `F0' = S delta0'`, with derivatives in the contact radius `a`. They
//! hold for every laterally uniform body whose response depends on distances only. For the proof
//! let `g` be the transform of the normal stress, continued as an even function to `-a < r < a`:
//!
//! ```text
//! (A g)(r) = g(r)/es + int_-a^a k(r - s) g(s) ds = f(r)          g = g1 for f = 1
//! ```
//!
//! 1. The derivative of this equation with respect to `a` at a fixed `f` is
//!    `A dg/da = -g(a) [k(r - a) + k(r + a)]`. So `dg/da = g(a) h(r)` with one function `h` for all
//!    `f`. As `A` is symmetric, `d/da int_0^a g1 ds = g1(a)^2/es`: the first identity.
//! 2. In the contact of a paraboloid without adhesion `f = delta0 - r^2/R`, and `g(a) = 0`. The
//!    derivative with respect to `a` is then `dg/da = delta0' g1`, without `h`. Its integral is
//!    `F0' = S delta0'`.
//! 3. The kernel depends on `r - s`. Therefore two derivatives with respect to `r` commute with `A`
//!    except for terms of the edges: `d2g/dr2 = -(2/R) g1 - (dg/dr)(a) h`. As `g(a) = 0` for every
//!    `a`, `dg/dr + dg/da = 0` at the edge, and `d2g/dr2 + 2 d2g/drda + d2g/da2 = 0` there. With
//!    `dg/da` of step 2 this is `-(2/R) g1(a) + delta0'' g1(a) + 2 delta0' d(g1(a))/da = 0`, or
//!    `(delta0' g1(a)^2)' = (2/R) g1(a)^2`. Its integral, with step 1, is `delta0' S' = (2/R) S`.
//!
//! All integrands are positive: nothing cancels. A relative error `e` of `Gamma` becomes at most
//! `2e` of `Eeq`, `4e` of `Delta0` and `6e` of `Pi0`. The last two would need an error that changes
//! its sign suddenly. Measured by `tests/truth/derived.rs`: an error like `sin(ln x)` becomes
//! `3.3e`, like `sin(5 ln x)` and faster `1.7e`; the errors of a table, which change their sign
//! between the nodes, become `1.1e`.
//!
//! # The integrals on a piece
//!
//! On a piece `x` is a linear function of `t`, and `ln(Gamma/es)` a polynomial in `t`. The squares,
//! the quotients and the integrals are [series](crate::curve::series) in `t` to its 11th power. The
//! divisions by `x` are recurrences of two terms. The last two terms of each result are
//! [economised](economised). The operations are those of four pieces side by side; then the
//! constants of integration go on from piece to piece. [`Resampler::fitting`] chooses the pieces
//! such that this adds less than a tenth of the table's tolerance. The constants at the first `a/t`
//! are those of a [thick film](crate::curve::thick_film).
//!
//! # Derivatives with respect to the material
//!
//! With `D` the derivative of `ln Gamma`, the derivatives of the three integrands, in their order,
//! are
//!
//! ```text
//! 2 D (Gamma/es)^2
//! 2 [d(x Eeq/es) - 2 D x Eeq/es] / (Gamma/es)^2
//! 8 x Eeq/es [2 d(x Eeq/es) - 2 D x Eeq/es] / (Gamma/es)^2
//! ```
//!
//! They are integrated in the same way and divided by the integrals.
//!
//! [`Resampler::fitting`]: crate::curve::resampler::Resampler::fitting

use fearless_simd::f64x4;
use fearless_simd::prelude::*;

use crate::curve::grid::{Grid, Position};
use crate::curve::piecewise::{LOGARITHM, Logarithms, Values};
use crate::curve::series::{
    Series, difference, economised, ends, exponential, first_terms, integral, product, quotient,
    sum, transposed,
};
use crate::curve::thick_film::{LARGEST, MULTIPLES};

/// The number of coefficients of the integrals on a piece.
const TERMS: usize = 12;
/// The number of coefficients of the derivatives of the integrals on a piece.
const RELATIVE_TERMS: usize = 10;

/// What the integrals need to know about the pieces of a grid, made once for a table.
#[derive(Clone, Debug)]
pub(crate) struct Derivation {
    /// The pieces four by four. The last one is repeated until its group is full.
    groups: Vec<Group>,
    /// The first `a/t`, in units of the grid.
    first: f64,
    /// The positions of the [`MULTIPLES`] of the first `a/t`.
    pub(crate) starts: [Position; 3],
}

/// Four pieces.
#[derive(Clone, Copy, Debug)]
struct Group {
    /// Half of their lengths.
    half_lengths: [f64; 4],
    /// The inverses of their middles.
    inverse_middles: [f64; 4],
}

/// The quantities on four pieces.
pub(crate) struct Integrals<S: Simd> {
    /// `Gamma/es`.
    gamma: Series<S, TERMS>,
    /// `Gamma^2` and its inverse.
    square: Series<S, TERMS>,
    inverse: Series<S, TERMS>,
    /// `x es Eeq/Gamma^2`.
    rate: Series<S, TERMS>,
    /// `x Eeq/es`, `x^2 Delta0` and `x^3 Pi0/es`.
    integrals: [Series<S, TERMS>; 3],
}

impl Derivation {
    /// Returns what the integrals need for the pieces of `grid` over `range`; none if the range
    /// does not contain the points at which they begin, or begins with too thin a film.
    pub(crate) fn new(grid: &Grid, range: [f64; 2]) -> Option<Self> {
        if range[0] > LARGEST || MULTIPLES[2] * range[0] > range[1] {
            return None;
        }
        let mut ends: Vec<[f64; 2]> = grid.pieces(range[1]).map(|(_, ends)| ends).collect();
        let last = *ends.last()?;
        ends.resize(ends.len().next_multiple_of(4), last);
        let groups = ends.as_chunks::<4>().0.iter().map(|group| Group {
            half_lengths: group.map(|[from, to]| 0.5 * (to - from)),
            inverse_middles: group.map(|[from, to]| 2.0 / (from + to)),
        });
        Some(Self {
            groups: groups.collect(),
            first: range[0] * grid.factor,
            starts: MULTIPLES.map(|multiple| grid.locate(multiple * range[0])),
        })
    }

    pub(crate) fn groups(&self) -> usize {
        self.groups.len()
    }

    /// Returns `x Eeq`, `x^2 Delta0` and `x^3 Pi0` at the first `a/t`, from the quantities there.
    pub(crate) fn at_start(&self, [eeq, delta0, pi0]: [f64; 3]) -> [f64; 3] {
        let y = self.first;
        [eeq * y, delta0 * y * y, pi0 * y * y * y]
    }

    /// Adds the constants of integration to the integrals of order `order` on a group.
    #[inline(always)]
    fn add_constants<S: Simd, const N: usize>(
        &self,
        simd: S,
        group: usize,
        integral: &mut Series<S, N>,
        mut constants: impl FnMut(usize, [f64; 2]) -> f64,
    ) {
        let [from, to] = ends(integral);
        let (mut from, to) = (*from.as_array(), *to.as_array());
        if group == 0 {
            let Position { t, .. } = self.starts[0];
            from[0] = integral
                .iter()
                .rev()
                .fold(0.0, |sum, term| sum * t + term[0]);
        }
        let constants: [f64; 4] =
            std::array::from_fn(|lane| constants(4 * group + lane, [from[lane], to[lane]]));
        integral[0] = f64x4::simd_from(simd, constants);
    }

    /// Integrates on a group of pieces. `constants(order, piece, [from, to])` returns the constant
    /// of an integral on a piece, from its values without the constant at the beginning and at the
    /// end of the piece.
    #[inline(always)]
    pub(crate) fn integrals<S: Simd>(
        &self,
        simd: S,
        group: usize,
        logarithms: &Series<S, LOGARITHM>,
        mut constants: impl FnMut(usize, usize, [f64; 2]) -> f64,
    ) -> Integrals<S> {
        let half_lengths = f64x4::simd_from(simd, self.groups[group].half_lengths);
        let middle = f64x4::simd_from(simd, logarithms[0].as_array().map(f64::exp));
        let square = middle * middle;
        let gamma = exponential(simd, middle, 1.0, logarithms);
        let squares = exponential(simd, square, 2.0, logarithms);
        let inverse = exponential(simd, f64x4::splat(simd, 1.0) / square, -2.0, logarithms);
        let mut stiffness = integral(simd, &squares, half_lengths);
        self.add_constants(simd, group, &mut stiffness, |piece, ends| {
            constants(0, piece, ends)
        });
        // Half of the rate of `x^2 Delta0`, and a quarter of that of `x^3 Pi0`.
        let rate = product(&stiffness, &inverse);
        let mut penetration = integral(simd, &rate, half_lengths * 2.0);
        self.add_constants(simd, group, &mut penetration, |piece, ends| {
            constants(1, piece, ends)
        });
        let load = product(&stiffness, &rate);
        let mut load = integral(simd, &load, half_lengths * 8.0);
        self.add_constants(simd, group, &mut load, |piece, ends| {
            constants(2, piece, ends)
        });
        Integrals {
            gamma,
            square: squares,
            inverse,
            rate,
            integrals: [stiffness, penetration, load],
        }
    }

    /// Writes the polynomials of the four quantities on the `pieces` of a group.
    #[inline(always)]
    pub(crate) fn values<S: Simd>(
        &self,
        simd: S,
        group: usize,
        integrals: Integrals<S>,
        es: f64,
        pieces: &mut [Values; 4],
    ) {
        let Group {
            half_lengths,
            inverse_middles,
        } = self.groups[group];
        let inverse = f64x4::simd_from(simd, inverse_middles);
        let ratio = f64x4::simd_from(simd, half_lengths) * inverse;
        let [mut eeq, mut delta0, mut pi0] = integrals.integrals;
        divide_by_linear(&mut eeq, inverse, ratio);
        for _ in 0..2 {
            divide_by_linear(&mut delta0, inverse, ratio);
        }
        for _ in 0..3 {
            divide_by_linear(&mut pi0, inverse, ratio);
        }
        let pi0 = economised(simd, &pi0);
        let eeq = economised(simd, &eeq);
        let gamma = economised(simd, &integrals.gamma);
        let delta0 = economised(simd, &delta0);
        write_by_piece([&pi0, &eeq, &gamma, &delta0], [es, es, es, 1.0], pieces);
    }

    /// Writes the polynomials of the derivatives of the logarithms of the four quantities on the
    /// `pieces` of a group, with respect to a parameter of the material. `gamma` is that of
    /// `ln(Gamma/es)`; the `constants` are those of the derivatives of the integrals.
    #[inline(always)]
    pub(crate) fn sensitivities<S: Simd>(
        &self,
        simd: S,
        group: usize,
        integrals: &Integrals<S>,
        gamma: &Series<S, LOGARITHM>,
        mut constants: impl FnMut(usize, usize, [f64; 2]) -> f64,
        pieces: &mut [Logarithms; 4],
    ) {
        let half_lengths = f64x4::simd_from(simd, self.groups[group].half_lengths);
        let square = first_terms(&integrals.square);
        let inverse = first_terms(&integrals.inverse);
        let rate = first_terms(&integrals.rate);
        let stiffness = first_terms(&integrals.integrals[0]);
        let penetration = first_terms(&integrals.integrals[1]);
        let load = first_terms(&integrals.integrals[2]);

        let mut by_stiffness = integral(simd, &product(gamma, &square), half_lengths * 2.0);
        self.add_constants(simd, group, &mut by_stiffness, |piece, ends| {
            constants(0, piece, ends)
        });
        let twice_gamma = sum(gamma, gamma);
        let by_rate = difference(
            &product(&by_stiffness, &inverse),
            &product(&twice_gamma, &rate),
        );
        let mut by_penetration = integral(simd, &by_rate, half_lengths * 2.0);
        self.add_constants(simd, group, &mut by_penetration, |piece, ends| {
            constants(1, piece, ends)
        });
        let by_load = sum(
            &product(&by_stiffness, &rate),
            &product(&stiffness, &by_rate),
        );
        let mut by_load = integral(simd, &by_load, half_lengths * 8.0);
        self.add_constants(simd, group, &mut by_load, |piece, ends| {
            constants(2, piece, ends)
        });
        let relative = [
            &relative(simd, &by_load, &load),
            &relative(simd, &by_stiffness, &stiffness),
            gamma,
            &relative(simd, &by_penetration, &penetration),
        ];
        write_by_piece(relative, [1.0; 4], pieces);
    }
}

/// The constants of integration of a whole curve: the integrals go on from piece to piece.
pub(crate) fn running(mut at: [f64; 3]) -> impl FnMut(usize, usize, [f64; 2]) -> f64 {
    move |order, _, [from, to]| {
        let constant = at[order] - from;
        at[order] = constant + to;
        constant
    }
}

/// Divides a series by `(1 + ratio t)/inverse`.
#[inline(always)]
fn divide_by_linear<S: Simd>(series: &mut Series<S, TERMS>, inverse: f64x4<S>, ratio: f64x4<S>) {
    series[0] *= inverse;
    for k in 1..TERMS {
        series[k] = (-ratio).mul_add(series[k - 1], series[k] * inverse);
    }
}

/// Returns the series of a derivative over its value.
#[inline(always)]
fn relative<S: Simd>(
    simd: S,
    derivative: &Series<S, RELATIVE_TERMS>,
    value: &Series<S, RELATIVE_TERMS>,
) -> Series<S, LOGARITHM> {
    economised(simd, &quotient(simd, derivative, value))
}

/// Writes the coefficients of the quantities, each of them on four pieces, times its scale, to the
/// `pieces`.
#[inline(always)]
fn write_by_piece<S: Simd, const N: usize>(
    [pi0, eeq, gamma, delta0]: [&Series<S, N>; 4],
    scales: [f64; 4],
    pieces: &mut [[[f64; 4]; N]; 4],
) {
    for k in 0..N {
        let rows = transposed([
            pi0[k] * scales[0],
            eeq[k] * scales[1],
            gamma[k] * scales[2],
            delta0[k] * scales[3],
        ]);
        for (piece, row) in pieces.iter_mut().zip(rows) {
            row.store_slice(&mut piece[k]);
        }
    }
}
