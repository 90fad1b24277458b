//! Odd powers of the radius from `Gamma`, `Eeq` and `Delta1` of a curve: the cone, `r^3` and `r^5`.
//!
//! The flat punch at all smaller radii determines the contact of every shape, but for a cone only
//! by its field (see the page `shape/field.rs` of the crate `contact`, of the source): the identity that gives even
//! powers from `Gamma` alone needs the field's value on the axis for a cone. A table that holds
//! `Delta1` saves that work. In the notation of the page `curve/even_powers/mod.rs`,
//!
//! ```text
//! (x^2 mu_1)' = x Gamma^2 Delta_1/es               Pi_1 = 4 (Delta_1 Eeq - mu_1)
//! (x^n Delta_n)' = n (n - 1) es x^(n-1) mu_(n-2)/Gamma^2
//! (x^(n+1) mu_n)' = x^n Gamma^2 Delta_n/es         (x^(n+1) Pi_n)' = 4 x Eeq (x^n Delta_n)'
//! ```
//!
//! for `n = 3, 5`. The first line is the second one of that page for `n = 1`, and `Pi_n` follows
//! from `F0' = S delta0'`. All integrands are positive. The integrals begin with a thick film.
//!
//! The results are stored in the places of `Pi0` and `Delta0` of another curve: `Delta_n`, and
//! `Pi_n` times `2 (n + 1)/(3 n)`. So both have the limits of `Pi0` and `Delta0` on a thick film,
//! `8/3 es` and 1, and depart from them by the same orders of `a/t`.

use std::ops::RangeInclusive;
use std::sync::Arc;

use fearless_simd::prelude::*;
use fearless_simd::{Level, dispatch, f64x4};

use super::even_powers::ladder::{continued, scale, times_linear};
use super::even_powers::{Source, ratio, scaled};
use super::grid::Position;
use super::piecewise::{LOGARITHM, Logarithms, Polynomial, VALUE, Values, evaluate_one, is_within};
use super::series::{
    LANES, Lanes, Series, difference, economised, integral, lanes_of_rows, pairs_by_lane, product,
    quotient,
};
use crate::{Curve, Error, Quantity};

/// The number of coefficients of a series on a piece.
const TERMS: usize = 12;
/// The exponents that follow from `Delta1`.
const EXPONENTS: [u32; 3] = [1, 3, 5];
/// The step of the differences for derivatives. Their error is of the order of its square.
const STEP: f64 = 1e-4;

/// `Delta1` on the pieces of a curve.
#[derive(Clone, Debug)]
pub(crate) struct Cone {
    pub(crate) pieces: Arc<[Polynomial]>,
    /// The derivatives of `ln Delta1` with respect to `ln e1_over_e2`, `nu1` and `ln e0_over_e2` of
    /// the table.
    pub(crate) by_table: Option<[Arc<[[f64; LOGARITHM]]>; 3]>,
}

impl Cone {
    /// Takes the polynomials of `Delta1`, without derivatives.
    pub(super) const fn new(pieces: Arc<[Polynomial]>) -> Self {
        Self {
            pieces,
            by_table: None,
        }
    }

    /// Returns `Delta1` at a position, and its derivative with respect to the place on the piece.
    pub(super) fn at(&self, Position { piece, t }: Position) -> [f64; 2] {
        let polynomial = &self.pieces[piece];
        let slope = (1..VALUE)
            .rev()
            .fold(0.0, |sum, k| sum * t + k as f64 * polynomial[k]);
        [evaluate_one(polynomial, t), slope]
    }

    /// Returns the value in the middle of the first piece on which `Delta1` may leave `range`.
    pub(super) fn first_outside(&self, range: &RangeInclusive<f64>) -> Option<f64> {
        // The sizes of the coefficients decide most pieces, which saves the dearer test.
        let stays = |polynomial: &Polynomial| {
            let size: f64 = polynomial[1..].iter().map(|term| term.abs()).sum();
            let ends = [polynomial[0] - size, polynomial[0] + size];
            ends.iter().all(|end| range.contains(end))
        };
        let leaving =
            |polynomial: &&Polynomial| !stays(polynomial) && !is_within(range, polynomial);
        self.pieces
            .iter()
            .find(leaving)
            .map(|polynomial| polynomial[0])
    }
}

/// Load and penetration without adhesion of a probe `f = c r^n` as functions of `a/t`, for one
/// material. [`Curve::odd_power`] makes it.
///
/// With `kappa_n = sqrt(pi) Gammafunction(n/2 + 1)/Gammafunction((n + 1)/2)`, which is `pi/2` for
/// a cone,
///
/// ```text
/// delta0 = c kappa_n a^n Delta_n          F0 = c kappa_n a^(n+1) (E*/2) Pi_n
/// ```
///
/// where `E*` is the modulus that normalises the quantities. On a half-space of modulus `E*`,
/// `Delta_n = 1` and `Pi_n = 4 n/(n + 1)` (I. N. Sneddon, Int. J. Eng. Sci. 3 (1965) 47).
#[derive(Clone, Debug)]
pub struct OddPowerCurve {
    curve: Curve,
    exponent: u32,
}

impl OddPowerCurve {
    /// Returns the exponent `n`.
    pub const fn exponent(&self) -> u32 {
        self.exponent
    }

    /// Returns `Pi_n` at `a_over_t`.
    ///
    /// # Errors
    /// As [`Curve::quantity`], and [`Error::OutsideTable`] everywhere above the nodes.
    pub fn pi(&self, a_over_t: f64) -> Result<f64, Error> {
        Ok(self.curve.quantity(Quantity::Pi0, a_over_t)? / over_pi0(self.exponent))
    }

    /// Returns `Delta_n` at `a_over_t`.
    ///
    /// # Errors
    /// As [`OddPowerCurve::pi`].
    pub fn delta(&self, a_over_t: f64) -> Result<f64, Error> {
        self.curve.quantity(Quantity::Delta0, a_over_t)
    }

    /// Returns the curve that holds `Delta_n` and `Pi_n` times [`over_pi0`] in the places of
    /// `Delta0` and `Pi0`.
    pub const fn curve(&self) -> &Curve {
        &self.curve
    }
}

/// Returns the ratio of `Pi0` and `Pi_n` on a half-space, `2 (n + 1)/(3 n)`.
pub fn over_pi0(exponent: u32) -> f64 {
    let n = f64::from(exponent);
    2.0 * (n + 1.0) / (3.0 * n)
}

impl Curve {
    /// Returns load and penetration without adhesion of a probe `f = c r^n` with `n` of 1 (a cone),
    /// 3 or 5, from `Delta1`. They have derivatives with respect to the material if this curve has
    /// them.
    ///
    /// Their errors are about that of the table: its certificate is measured with `Delta1`, and
    /// with the `Pi_1` that follows from it.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`] for any other `n`; [`Error::MissingQuantity`] unless the curve
    /// holds `delta1` and knows the four quantities of a sphere; [`Error::BeginsTooLate`] if it
    /// begins at so large an `a/t` that the contact is not that of a thick film there;
    /// [`Error::StackProbe`] on a stack of layers; [`Error::Malformed`] if a result leaves
    /// `[1e-30, 1e30]`, which happens only in forged tables.
    pub fn odd_power(&self, n: u32) -> Result<OddPowerCurve, Error> {
        Error::argument(
            EXPONENTS.contains(&n),
            "the exponent of an odd power",
            f64::from(n),
            "1, 3 or 5; even powers follow from the curve without delta1",
        )?;
        let Some(cone) = &self.cone else {
            return Err(Error::MissingQuantity(Quantity::Delta1.name()));
        };
        self.accept_integrals("the contact of this probe")?;
        let source = OddSource {
            source: self.source(),
            cone: &cone.pieces,
        };
        let pieces = source.integrated(n);
        let sensitivities = match (&self.sensitivities, &cone.by_table) {
            (Some(own), Some(by_table)) => {
                let mut by_table = by_table.iter();
                Some(Arc::new(own.of_other(|by| {
                    let by_cone = by_table.next().expect("there are three of both");
                    source.by_parameter(n, &pieces, by, by_cone)
                })))
            }
            _ => None,
        };
        let curve = self.with_odd_power(pieces, sensitivities);
        if let Some((quantity, value)) = curve.unreasonable() {
            let name = if quantity == Quantity::Pi0 {
                "Pi"
            } else {
                "Delta"
            };
            return Err(Error::Malformed(format!(
                "{name}_{n} of delta1 reaches {value:?}, outside [1e-30, 1e30]"
            )));
        }
        Ok(OddPowerCurve { curve, exponent: n })
    }
}

/// The pieces of a curve with those of its `Delta1`.
#[derive(Clone, Copy)]
struct OddSource<'a> {
    source: Source<'a>,
    cone: &'a [Polynomial],
}

/// The values of the integrals at the end of the last piece, in units of the grid.
struct Running {
    /// Those of `y^(n+1) mu_n/es` for `n` of 1 and 3.
    moments: [f64; 2],
    /// Those of `y^n Delta_n` for `n` of 3 and 5.
    penetrations: [f64; 2],
    /// That of `y^(n+1) Pi_n/es`.
    load: f64,
}

/// The pieces that are computed side by side.
struct Group<'a> {
    /// Their ends, in units of the grid.
    ends: [[f64; 2]; LANES],
    pieces: [&'a Values; LANES],
    cone: [&'a Polynomial; LANES],
    /// The place of the first node on the first piece, in the first group.
    start: Option<f64>,
}

impl OddSource<'_> {
    /// Returns the pieces with `Pi_n` and `Delta_n` in the places of `Pi0` and `Delta0`.
    fn integrated(&self, n: u32) -> Arc<[Values]> {
        let Source {
            grid, range, es, ..
        } = self.source;
        let beginning = self.source.beginning();
        let kernel = beginning.at(beginning.first);
        let order = n as usize;
        let mut running = Running {
            moments: [1, 3].map(|n| kernel.moment(n)),
            penetrations: [3, 5].map(|n| kernel.penetration(n)),
            load: 4.0 * (kernel.penetration(order) * kernel.moment(0) - kernel.moment(order)),
        };
        let ends: Vec<[f64; 2]> = grid.pieces(range[1]).map(|(_, ends)| ends).collect();
        let mut pieces: Arc<[Values]> = self.source.pieces.into();
        let own = Arc::make_mut(&mut pieces);
        for (number, ends) in ends.chunks(LANES).enumerate() {
            let lanes: [usize; LANES] = std::array::from_fn(|lane| lane.min(ends.len() - 1));
            let group = Group {
                ends: lanes.map(|lane| ends[lane]),
                pieces: lanes.map(|lane| &self.source.pieces[LANES * number + lane]),
                cone: lanes.map(|lane| &self.cone[LANES * number + lane]),
                start: (number == 0).then(|| grid.locate(range[0]).t),
            };
            let new = dispatch!(Level::new(), simd => group.integrated(simd, es, n, &mut running));
            let places = own[LANES * number..].iter_mut().zip(new);
            for (own, new) in places.take(ends.len()) {
                for (row, [load, penetration]) in own.iter_mut().zip(new) {
                    row[Quantity::Pi0 as usize] = load;
                    row[Quantity::Delta0 as usize] = penetration;
                }
            }
        }
        pieces
    }

    /// Returns the pieces of the derivatives of the logarithms with respect to a parameter of the
    /// material, with those of `Pi_n` and `Delta_n` in the places of `Pi0` and `Delta0`. `by` and
    /// `by_cone` hold those of the curve's own quantities over `es`, and of `Delta1`.
    fn by_parameter(
        &self,
        n: u32,
        of_power: &[Values],
        by: &[Logarithms],
        by_cone: &[[f64; LOGARITHM]],
    ) -> Arc<[Logarithms]> {
        let [more, less] = [STEP, -STEP].map(|step| {
            let pieces = self.source.pieces.iter().zip(by);
            let pieces: Vec<Values> = pieces.map(|(of, by)| scaled(of, by, step)).collect();
            let cone = self.cone.iter().zip(by_cone);
            let cone: Vec<Polynomial> = cone.map(|(of, by)| changed(of, by, step)).collect();
            let source = Source {
                pieces: &pieces,
                ..self.source
            };
            OddSource {
                source,
                cone: &cone,
            }
            .integrated(n)
        });
        let mut relative: Vec<Logarithms> = by.to_vec();
        for (i, relative) in relative.iter_mut().enumerate() {
            let difference: Values = std::array::from_fn(|k| {
                std::array::from_fn(|q| (more[i][k][q] - less[i][k][q]) / (2.0 * STEP))
            });
            let quotient = ratio(&difference, &of_power[i]);
            let quotient: Logarithms = dispatch!(Level::new(), simd => {
                let series = quotient.map(|row| f64x4::simd_from(simd, row));
                economised::<_, _, VALUE, LOGARITHM>(simd, &series).map(|row| *row.as_array())
            });
            for (own, new) in relative.iter_mut().zip(quotient) {
                for quantity in [Quantity::Pi0, Quantity::Delta0] {
                    own[quantity as usize] = new[quantity as usize];
                }
            }
        }
        relative.into()
    }
}

/// Returns a polynomial times `1 + step by`.
fn changed(of: &Polynomial, by: &[f64; LOGARITHM], step: f64) -> Polynomial {
    std::array::from_fn(|k| {
        let change: f64 = (0..=k.min(LOGARITHM - 1)).map(|i| by[i] * of[k - i]).sum();
        of[k] + step * change
    })
}

impl Group<'_> {
    /// Returns the series of `Pi_n`, times [`over_pi0`], and of `Delta_n` on the pieces.
    #[inline(always)]
    fn integrated<S: Simd>(
        &self,
        simd: S,
        es: f64,
        n: u32,
        running: &mut Running,
    ) -> [[[f64; 2]; VALUE]; LANES] {
        let vector = |values: [f64; LANES]| Lanes::simd_from(simd, values);
        let number = |value: f64| Lanes::splat(simd, value);
        let half = vector(self.ends.map(|[from, to]| 0.5 * (to - from)));
        let middle = vector(self.ends.map(|[from, to]| 0.5 * (from + to)));
        let mut stiffness: Series<Lanes<S>, TERMS> = [number(0.0); TERMS];
        let (mut gamma, mut penetration) = (stiffness, stiffness);
        let inverse_es = number(1.0 / es);
        for k in 0..VALUE {
            let mut rows = [f64x4::splat(simd, 0.0); LANES];
            for (row, piece) in rows.iter_mut().zip(self.pieces) {
                *row = f64x4::from_slice(simd, &piece[k]);
            }
            let [_, eeq, own, _] = lanes_of_rows(rows);
            stiffness[k] = eeq * inverse_es;
            gamma[k] = own * inverse_es;
            penetration[k] = vector(self.cone.map(|cone| cone[k]));
        }
        times_linear(&mut stiffness, middle, half);
        times_linear(&mut penetration, middle, half);
        // Half of the length of a piece is a factor of the integrands: the integrals are those over
        // the place on the piece.
        let mut square = product(simd, &gamma, &gamma);
        let mut numerator = [number(0.0); TERMS];
        numerator[0] = half;
        let inverse = quotient(simd, &numerator, &square);
        scale(&mut square, half);
        let mut moment = integral(simd, &product(simd, &square, &penetration));
        continued(simd, self.start, &mut moment, &mut running.moments[0]);
        let mut load;
        if n == 1 {
            load = difference(&product(simd, &stiffness, &penetration), &moment);
            scale(&mut load, number(4.0));
        } else {
            let mut step = 0;
            loop {
                let order = (2 * step + 3) as f64;
                let mut rate = product(simd, &moment, &inverse);
                scale(&mut rate, number(order * (order - 1.0)));
                penetration = integral(simd, &rate);
                let at = &mut running.penetrations[step];
                continued(simd, self.start, &mut penetration, at);
                if 2 * step + 3 == n as usize {
                    load = integral(simd, &product(simd, &stiffness, &rate));
                    scale(&mut load, number(4.0));
                    continued(simd, self.start, &mut load, &mut running.load);
                    break;
                }
                step += 1;
                moment = integral(simd, &product(simd, &square, &penetration));
                continued(simd, self.start, &mut moment, &mut running.moments[step]);
            }
        }
        let inverse = number(1.0) / middle;
        let slope = half * inverse;
        for _ in 0..n {
            divide_by_linear(&mut penetration, inverse, slope);
            divide_by_linear(&mut load, inverse, slope);
        }
        divide_by_linear(&mut load, inverse, slope);
        scale(&mut load, number(es * over_pi0(n)));
        let penetration: Series<Lanes<S>, VALUE> = economised(simd, &penetration);
        let load: Series<Lanes<S>, VALUE> = economised(simd, &load);
        pairs_by_lane(&load, &penetration)
    }
}

/// Divides a series by `(1 + slope t)/inverse`.
#[inline(always)]
fn divide_by_linear<S: Simd>(
    series: &mut Series<Lanes<S>, TERMS>,
    inverse: Lanes<S>,
    slope: Lanes<S>,
) {
    series[0] *= inverse;
    for k in 1..TERMS {
        series[k] = (-slope).mul_add(series[k - 1], series[k] * inverse);
    }
}
