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
//! the quotients and the integrals are [series](piecewise::series) in `t` to its 11th power. The
//! divisions by `x` are recurrences of two terms. The last two terms of each result are
//! [economised]. The operations are those of [several pieces](LANES) side by side; then the constants
//! of integration go on from piece to piece. [`QuantityResampler::fitting`] chooses the pieces such that this
//! adds less than a tenth of the table's tolerance. The constants at the first `a/t`
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
//! [`QuantityResampler::fitting`]: crate::curve::quantity_resampler::QuantityResampler::fitting

use fearless_simd::prelude::*;

use piecewise::lanes::{LANES, Lanes, write_by_piece};
use piecewise::series::{
    Series, constants_of_integration, difference, divided_by_powers, economised, exp, exponential,
    first_terms, integral, limits, product, quotient, scale, sum,
};
use piecewise::{FUNCTION_TERMS, Grid, Polynomials, Position, SPLINE_TERMS};

use crate::curve::thick_film::{LARGEST, MULTIPLES};

/// The number of coefficients of the integrals on a piece.
const TERMS: usize = 12;
/// The number of coefficients of the derivatives of the integrals on a piece.
const RELATIVE_TERMS: usize = 10;

/// What the integrals need to know about the pieces of a grid, made once for a table.
#[derive(Clone, Debug)]
pub(crate) struct Derivation {
    /// The pieces in groups of [`LANES`]. The last one is repeated until its group is full.
    groups: Vec<Group>,
    /// The first `a/t`, in units of the grid.
    first: f64,
    /// The positions of the [`MULTIPLES`] of the first `a/t`.
    pub(crate) starts: [Position; 3],
}

/// The pieces that are computed side by side.
#[derive(Clone, Copy, Debug)]
struct Group {
    /// Half of their lengths.
    half_lengths: [f64; LANES],
    /// The inverses of their middles.
    inverse_middles: [f64; LANES],
}

/// The integrals on a group of pieces, as functions of `t`. With half of the length of a piece,
/// `h`, as a factor of the integrands they are integrals over `t`.
pub(crate) struct Integrals<S: Simd> {
    /// `Gamma/es` in the middle.
    middle: Lanes<S>,
    /// `h (Gamma/es)^2` and `h/(Gamma/es)^2`.
    square: Series<Lanes<S>, TERMS>,
    inverse: Series<Lanes<S>, TERMS>,
    /// The integrand of the second integral: `h x (Eeq/es)/(Gamma/es)^2`.
    rate: Series<Lanes<S>, TERMS>,
    /// `x Eeq/es`, `x^2 Delta0/2` and `x^3 Pi0/(8 es)`.
    integrals: [Series<Lanes<S>, TERMS>; 3],
}

impl Derivation {
    /// Returns whether `range` contains the points at which the integrals begin, and begins with a
    /// thick film.
    pub(crate) fn begins(range: [f64; 2]) -> bool {
        range[0] <= LARGEST && MULTIPLES[2] * range[0] <= range[1]
    }

    /// Returns what the integrals need for the pieces of `grid`; none if its range does not contain the
    /// points at which they begin, or begins with too thin a film.
    pub(crate) fn new(grid: &Grid) -> Option<Self> {
        let range = grid.range();
        if !Self::begins(range) {
            return None;
        }
        let mut ends: Vec<[f64; 2]> = grid.pieces().map(|(_, ends)| ends).collect();
        let last = *ends.last()?;
        ends.resize(ends.len().next_multiple_of(LANES), last);
        let groups = ends.as_chunks::<LANES>().0.iter().map(|group| Group {
            half_lengths: group.map(|[from, to]| 0.5 * (to - from)),
            inverse_middles: group.map(|[from, to]| 2.0 / (from + to)),
        });
        Some(Self {
            groups: groups.collect(),
            first: range[0] * grid.factor(),
            starts: MULTIPLES.map(|multiple| grid.locate(multiple * range[0])),
        })
    }

    pub(crate) fn groups(&self) -> usize {
        self.groups.len()
    }

    /// Returns the three integrals at the first `a/t`, from `Eeq/es`, `Delta0` and `Pi0/es` there.
    pub(crate) fn at_start(&self, quantities: [f64; 3]) -> [f64; 3] {
        Self::at(self.first, quantities)
    }

    /// Returns the three integrals at `y`, in units of the grid, from `Eeq/es`, `Delta0` and
    /// `Pi0/es` there.
    pub(crate) fn at(y: f64, [eeq, delta0, pi0]: [f64; 3]) -> [f64; 3] {
        [eeq * y, 0.5 * delta0 * y * y, 0.125 * pi0 * y * y * y]
    }

    /// Adds the constants of integration to the integrals of order `order` on a group.
    #[inline(always)]
    fn add_constants<S: Simd, const N: usize>(
        &self,
        simd: S,
        group: usize,
        integral: &mut Series<Lanes<S>, N>,
        constants: &mut Constants<'_>,
        order: usize,
    ) {
        let start = (group == 0).then_some(self.starts[0].t);
        integral[0] = constants.on_group(simd, order, group, limits(start, integral));
    }

    /// Integrates on a group of pieces, where `logarithms` are the polynomials of `ln(Gamma/es)`.
    #[inline(always)]
    pub(crate) fn integrals<S: Simd>(
        &self,
        simd: S,
        group: usize,
        logarithms: &Series<Lanes<S>, SPLINE_TERMS>,
        constants: &mut Constants<'_>,
    ) -> Integrals<S> {
        let half_lengths = Lanes::simd_from(simd, self.groups[group].half_lengths);
        let middle = exp(simd, logarithms[0]);
        let of_square = middle * middle;
        let square = exponential(simd, half_lengths * of_square, 2.0, logarithms);
        let inverse = exponential(simd, half_lengths / of_square, -2.0, logarithms);
        let mut stiffness = integral(simd, &square);
        self.add_constants(simd, group, &mut stiffness, constants, 0);
        let rate = product(simd, &stiffness, &inverse);
        let mut penetration = integral(simd, &rate);
        self.add_constants(simd, group, &mut penetration, constants, 1);
        let mut load = integral(simd, &product(simd, &stiffness, &rate));
        self.add_constants(simd, group, &mut load, constants, 2);
        Integrals {
            middle,
            square,
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
        logarithms: &Series<Lanes<S>, SPLINE_TERMS>,
        integrals: Integrals<S>,
        es: f64,
        pieces: &mut [Polynomials<FUNCTION_TERMS>; LANES],
    ) {
        let Group {
            half_lengths,
            inverse_middles,
        } = self.groups[group];
        // `x` is `(1 + ratio t)/inverse`.
        let inverse = Lanes::simd_from(simd, inverse_middles);
        let ratio = Lanes::simd_from(simd, half_lengths) * inverse;
        let [eeq, delta0, pi0] = divided_by_powers(integrals.integrals, ratio);
        let (square, es) = (inverse * inverse, Lanes::splat(simd, es));
        let mut pi0 = economised(simd, &pi0);
        scale(&mut pi0, square * inverse * es * 8.0);
        let mut eeq = economised(simd, &eeq);
        scale(&mut eeq, inverse * es);
        let mut delta0 = economised(simd, &delta0);
        scale(&mut delta0, square * 2.0);
        let gamma: Series<_, TERMS> = exponential(simd, integrals.middle * es, 1.0, logarithms);
        write_by_piece([&pi0, &eeq, &economised(simd, &gamma), &delta0], pieces);
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
        gamma: &Series<Lanes<S>, SPLINE_TERMS>,
        constants: &mut Constants<'_>,
        pieces: &mut [Polynomials<SPLINE_TERMS>; LANES],
    ) {
        let square = first_terms(&integrals.square);
        let inverse = first_terms(&integrals.inverse);
        let rate = first_terms(&integrals.rate);
        let [stiffness, penetration, load] = integrals.integrals.each_ref().map(first_terms);

        let twice = sum(gamma, gamma);
        let mut by_stiffness = integral(simd, &product(simd, &twice, &square));
        self.add_constants(simd, group, &mut by_stiffness, constants, 0);
        // The two brackets of the formulas.
        let in_penetration = difference(&by_stiffness, &product(simd, &twice, &stiffness));
        let in_load = sum(&in_penetration, &by_stiffness);
        let mut by_penetration = integral(simd, &product(simd, &in_penetration, &inverse));
        self.add_constants(simd, group, &mut by_penetration, constants, 1);
        let mut by_load = integral(simd, &product(simd, &in_load, &rate));
        self.add_constants(simd, group, &mut by_load, constants, 2);
        let relative = [
            &relative(simd, &by_load, &load),
            &relative(simd, &by_stiffness, &stiffness),
            gamma,
            &relative(simd, &by_penetration, &penetration),
        ];
        write_by_piece(relative, pieces);
    }
}

/// The constants of integration: the values of the three integrals at the beginnings of the pieces.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Constants<'a> {
    /// The integrals go on from piece to piece. These are their values where the next group begins.
    Running([f64; 3]),
    /// The integrals have these values at the beginning of each piece.
    Given(&'a [[f64; 3]]),
}

impl Constants<'_> {
    /// Returns the constants of the integral of order `order` on the pieces of a group, from its
    /// [limits] without them.
    #[inline(always)]
    fn on_group<S: Simd>(
        &mut self,
        simd: S,
        order: usize,
        group: usize,
        limits: [Lanes<S>; 2],
    ) -> Lanes<S> {
        match self {
            Self::Running(at) => constants_of_integration(simd, &mut at[order], limits),
            Self::Given(beginnings) => {
                let mut constants = -limits[0];
                for lane in 0..LANES {
                    let piece = (LANES * group + lane).min(beginnings.len() - 1);
                    constants[lane] += beginnings[piece][order];
                }
                constants
            }
        }
    }
}

/// Returns the series of a derivative over its value.
#[inline(always)]
fn relative<S: Simd>(
    simd: S,
    derivative: &Series<Lanes<S>, RELATIVE_TERMS>,
    value: &Series<Lanes<S>, RELATIVE_TERMS>,
) -> Series<Lanes<S>, SPLINE_TERMS> {
    economised(simd, &quotient(simd, derivative, value))
}
