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
//! On a piece `x = m (1 + r t)`, with its middle `m` and a ratio `r` of at most 1/3, and
//! `l = ln(Gamma/es)` is a polynomial in `t`. From here on let `S = x Eeq/m`, `D = (x/m)^2 Delta0` and
//! `L = (x/m)^3 Pi0`, with a prime for `d/dt`. Then
//!
//! ```text
//! S' = r Gamma^2/es      S'' = 2 l' S'
//! D' = 2 r es S/Gamma^2  D'' = 2 r^2 - 2 l' D'
//! L' = 4 S D'
//! ```
//!
//! The second equations give the [series](piecewise::series) of `S'` and `D'`, up to the 11th power of
//! `t`, term by term. `Eeq`, `Delta0` and `Pi0` are the integrals over powers of `1 + r t`, up to
//! the 13th power of `t`: where `L` hardly changes, `Pi0` is like `1/(1 + r t)^3`, whose series
//! converges slowest. The last terms of each are [economised]. The operations are those of
//! [several pieces](LANES) side by side; then the constants of integration go on from piece to piece.
//! [`QuantityResampler::fitting`] chooses the pieces such that this adds less than a tenth of the
//! table's tolerance. The constants at the first `a/t` are those of a
//! [thick film](crate::curve::thick_film).
//!
//! # Derivatives with respect to the material
//!
//! With `d` the derivative of the logarithm at a fixed `x` and a fixed `es`,
//!
//! ```text
//! d S' = 2 d Gamma      d D' = d S - 2 d Gamma      d L' = d S + d D'
//! ```
//!
//! These derivatives times `S'`, `D'` and `L'` are integrated as above, and the results are divided by
//! `S`, `D` and `L`.
//!
//! [`QuantityResampler::fitting`]: crate::curve::quantity_resampler::QuantityResampler::fitting

use std::array;

use fearless_simd::prelude::*;

use piecewise::exp::exp;
use piecewise::lanes::{LANES, Lanes, write_by_piece};
use piecewise::series::{
    QUOTIENT_TERMS, Series, constants_of_integration, difference, divided_by_powers, economised,
    exponential, first_terms, integral, limits, linear_solution, product, quotient, sum,
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

/// The pieces that are computed side by side: `x` is `middle (1 + ratio t)`, in units of the grid.
#[derive(Clone, Copy, Debug)]
struct Group {
    middles: [f64; LANES],
    ratios: [f64; LANES],
}

/// The integrals on a group of pieces, as functions of `t`.
pub(crate) struct Integrals<S: Simd> {
    /// `Gamma` in the middle.
    middle: Lanes<S>,
    /// The integrands `S'`, `D'` and `L'/4`.
    rates: [Series<Lanes<S>, TERMS>; 3],
    /// The integrals `S`, `D` and `L`.
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
            middles: group.map(|[from, to]| f64::midpoint(from, to)),
            ratios: group.map(|[from, to]| (to - from) / (from + to)),
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

    /// Returns `x Eeq`, `x^2 Delta0` and `x^3 Pi0` at the first `a/t`, in units of the grid, from
    /// `Eeq`, `Delta0` and `Pi0` there.
    pub(crate) fn at_start(&self, quantities: [f64; 3]) -> [f64; 3] {
        Self::at(self.first, quantities)
    }

    /// Returns `x Eeq`, `x^2 Delta0` and `x^3 Pi0` at `x`, in units of the grid, from the three
    /// quantities there.
    pub(crate) fn at(x: f64, [eeq, delta0, pi0]: [f64; 3]) -> [f64; 3] {
        [eeq * x, delta0 * x * x, pi0 * x * x * x]
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
        let middle = Lanes::simd_from(simd, self.groups[group].middles);
        // From `S`, `D` or `L` to what goes on from piece to piece.
        let unit = [middle, middle * middle, middle * middle * middle][order];
        let [from, to] = limits(start, integral);
        let limits = [from * unit, to * unit];
        integral[0] = constants.on_group(simd, order, group, limits) / unit;
    }

    /// Integrates on a group of pieces, where `logarithms` are the polynomials of `ln(Gamma/es)`.
    #[inline(always)]
    pub(crate) fn integrals<S: Simd>(
        &self,
        simd: S,
        group: usize,
        logarithms: &Series<Lanes<S>, SPLINE_TERMS>,
        es: f64,
        constants: &mut Constants<'_>,
    ) -> Integrals<S> {
        let ratio = Lanes::simd_from(simd, self.groups[group].ratios);
        let middle = exp(simd, logarithms[0]);
        let square = middle * middle * es;
        let stiffness_rate = exponential(simd, ratio * square, 2.0, logarithms);
        let mut stiffness = integral(simd, &stiffness_rate, 1.0);
        self.add_constants(simd, group, &mut stiffness, constants, 0);
        let at_middle = (ratio + ratio) * stiffness[0] / square;
        let penetration_rate =
            linear_solution(simd, at_middle, -2.0, logarithms, &[-ratio * ratio]);
        let mut penetration = integral(simd, &penetration_rate, 1.0);
        self.add_constants(simd, group, &mut penetration, constants, 1);
        let load_rate = product(simd, &stiffness, &penetration_rate);
        let mut load = integral(simd, &load_rate, 4.0);
        self.add_constants(simd, group, &mut load, constants, 2);
        Integrals {
            middle: middle * es,
            rates: [stiffness_rate, penetration_rate, load_rate],
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
        integrals: &Integrals<S>,
        pieces: &mut [Polynomials<FUNCTION_TERMS>; LANES],
    ) {
        let ratio = Lanes::simd_from(simd, self.groups[group].ratios);
        let gamma: Series<_, TERMS> = exponential(simd, integrals.middle, 1.0, logarithms);
        let [eeq, delta0, pi0]: [Series<_, QUOTIENT_TERMS>; 3] =
            divided_by_powers(simd, &integrals.integrals, ratio);
        let quantities = [
            &economised(simd, &pi0),
            &economised(simd, &eeq),
            &economised(simd, &gamma),
            &economised(simd, &delta0),
        ];
        write_by_piece(quantities, pieces);
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
        let [stiffness, penetration, load] = integrals.integrals.each_ref().map(first_terms);
        let [stiffness_rate, penetration_rate, load_rate] =
            integrals.rates.each_ref().map(first_terms);

        let of_square = sum(gamma, gamma);
        let mut by_stiffness = integral(simd, &product(simd, &of_square, &stiffness_rate), 1.0);
        self.add_constants(simd, group, &mut by_stiffness, constants, 0);
        let of_stiffness = quotient(simd, &by_stiffness, &stiffness);
        let of_rate = difference(&of_stiffness, &of_square);
        let mut by_penetration = integral(simd, &product(simd, &of_rate, &penetration_rate), 1.0);
        self.add_constants(simd, group, &mut by_penetration, constants, 1);
        let of_load_rate = sum(&of_stiffness, &of_rate);
        let mut by_load = integral(simd, &product(simd, &of_load_rate, &load_rate), 4.0);
        self.add_constants(simd, group, &mut by_load, constants, 2);
        let relative = [
            &relative(simd, &by_load, &load),
            &economised(simd, &of_stiffness),
            gamma,
            &relative(simd, &by_penetration, &penetration),
        ];
        write_by_piece(relative, pieces);
    }
}

/// The constants of integration: the values of `x Eeq`, `x^2 Delta0` and `x^3 Pi0`, or of their
/// derivatives, at the beginnings of the pieces. Unlike `S`, `D` and `L` they do not depend on the
/// middle of a piece.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Constants<'a> {
    /// They go on from piece to piece. These are their values where the next group begins.
    Running([f64; 3]),
    /// They have these values at the beginning of each piece.
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
                Lanes::simd_from(simd, of_group(beginnings, group, order)) - limits[0]
            }
        }
    }
}

/// Returns the given values of the integral of order `order` on the pieces of a group. The last piece
/// is repeated.
///
/// It is not inlined: then the integrals of a curve, which do not need it, take less time.
#[inline(never)]
fn of_group(beginnings: &[[f64; 3]], group: usize, order: usize) -> [f64; LANES] {
    array::from_fn(|lane| beginnings[(LANES * group + lane).min(beginnings.len() - 1)][order])
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
