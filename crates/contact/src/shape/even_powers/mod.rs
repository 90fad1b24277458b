//! Other shapes than the paraboloid from `Gamma` and `Eeq` of a curve: even powers of `r`, and the
//! sphere as a sum of them.
//!
//! `weights` holds the sum, `beginning` the thick film with which the integrals begin, `ladder` the
//! integrals over the pieces of the curve, and `thick_films` what comes before its first node.
//!
//! # The ladder
//!
//! For the shape `f = c r^n` with `b = c kappa_n s^n` (see `transform`) let `delta0 = c kappa_n a^n Delta_n`, and let `mu_n` be the moment of order `n` of
//! the transform `g1` of the flat punch's stress on the unit interval, so that `mu_0 = Eeq`. With
//! `x = a/t`, for even `n`,
//!
//! ```text
//! (x^n Delta_n)'     = n (n - 1) es x^(n-1) mu_(n-2)/Gamma^2
//! (x^(n+1) mu_n)'    = x^n Gamma^2 Delta_n/es
//! ```
//!
//! The proof goes on from that of the page `interp/src/curve/derived.rs` of the source, in its notation. Without adhesion
//! `dg/da = delta0' g1` for every shape. Two derivatives with respect to `r` commute with `A` but
//! for terms of the edges, `A d2g/dr2 = -b'' + edges`. As there, the equation at the edge gives
//! `(delta0' g1(a)^2)'` of a shape with a constant `b''`; for any other it gives
//!
//! ```text
//! delta0' = (es/Gamma^2) [b'(0) g1(0) + int_0^a b''(s) g1(s; a) ds]
//! ```
//!
//! because `b''` takes the place of the right-hand side 1, and the flux `Gamma^2 delta0'/es`
//! through the edge is the product of both right-hand sides, `int b'' g1`. With `b'' ~ s^(n-2)` it
//! is the first line. The second line is step 1 of `derived.rs` for the right-hand sides 1 and
//! `r^n`. As `Delta_2 = Delta0`, both lines in turn give `mu_2`, `Delta_4`, `mu_4`, and so on. All
//! integrands are positive: nothing cancels.
//!
//! # The sphere
//!
//! With `b'' = sum_k beta_k s^(2k)` the first line is `delta0' = (es/Gamma^2) sum_k beta_k a^(2k+1)
//! mu_2k`, and `F0' = S delta0'`. So only these two sums are integrated, and `delta0` and `F0` are
//! continuous although the `beta_k` are others on every piece. For small `a/R` they are the
//! first terms of the series of `b = s artanh(s/R)`; above, those of the polynomial in `s^2` that
//! equals `b'/s` at seven Chebyshev points of the contact.
//!
//! The results are stored as `Pi0` and `Delta0` of the paraboloid that would have this load and this
//! penetration, so that a lookup takes the same time.

mod beginning;
mod ladder;
mod thick_films;
mod weights;

use std::sync::Arc;

use fearless_simd::prelude::*;
use fearless_simd::{Level, dispatch, f64x4};
use interp::{Curve, Error, Quantity};
use piecewise::lanes::LANES;
use piecewise::series::{economised, product, quotient};
use piecewise::{FUNCTION_TERMS, Piecewise, Polynomials};

use self::beginning::Beginning;
use self::ladder::{Group, Running};
use self::thick_films::ThickFilms;
use self::weights::{Weights, dilated};

pub(super) use self::weights::{EvenShape, LARGEST_A_OVER_R};

/// The contact without adhesion under a shape of even powers.
#[derive(Clone, Debug)]
pub(crate) struct EvenPowers {
    curve: Curve,
    thick_films: Arc<ThickFilms>,
    /// The derivatives of the logarithms of load and penetration with respect to that of all lengths
    /// of the shape, at a fixed contact radius, in the places of `Pi0` and `Delta0`; none without
    /// derivatives.
    by_size: Option<Piecewise<FUNCTION_TERMS>>,
}

impl EvenPowers {
    /// Integrates a shape over the curve of a material, with derivatives if that has them.
    ///
    /// # Errors
    /// As [`Curve::accept_integrals`].
    pub(super) fn new(own: &Curve, shape: EvenShape) -> Result<Self, Error> {
        own.accept_integrals("the contact of this probe")?;
        let source = Source {
            functions: own.functions(),
            es: own.material().sphere_film_modulus(),
        };
        let beginning = source.beginning();
        let functions = source.integrated(shape, &beginning, |weights| weights);
        let by_size = own.derivatives().map(|_| {
            let by_size = source.integrated(shape, &beginning, dilated);
            let pairs = by_size.pieces().iter().zip(functions.pieces());
            source.on_grid(pairs.map(|(by, of)| ratio(by, of)).collect())
        });
        let derivatives = own.derivatives().map(|all| {
            let of_shape = |by| source.by_parameter(shape, &functions, by);
            all.iter().map(of_shape).collect()
        });
        let thick_films = Arc::new(ThickFilms {
            shape,
            unit: source.functions.grid().factor(),
            beginning,
            es: source.es,
        });
        Ok(Self {
            curve: own.of_shape(functions, derivatives, thick_films.clone()),
            thick_films,
            by_size,
        })
    }

    /// Returns the curve whose `Pi0` and `Delta0` are those of the paraboloid with the load and the
    /// penetration of the shape. The radius of the paraboloid is that of a sphere; of a power law it is
    /// the thickness of the film.
    pub(crate) const fn curve(&self) -> &Curve {
        &self.curve
    }

    /// Returns the derivatives of the logarithms of load and penetration with respect to that of all
    /// lengths of the shape, at a fixed contact radius; none without derivatives.
    pub(crate) fn by_size(&self, a_over_t: f64) -> Option<[f64; 2]> {
        let by_size = self.by_size.as_ref()?;
        let [first, last] = by_size.grid().range();
        if a_over_t < first {
            return Some(self.thick_films.by_size(a_over_t));
        }
        let [load, _, _, penetration] = by_size.values(a_over_t.min(last));
        Some([load, penetration])
    }
}

/// The pieces of a curve, from which those of other shapes follow.
#[derive(Clone, Copy)]
struct Source<'a> {
    functions: &'a Piecewise<FUNCTION_TERMS>,
    /// The sphere-film modulus in the unit of the quantities.
    es: f64,
}

impl Source<'_> {
    /// Returns the pieces of the derivatives of the logarithms of `Pi0` and `Delta0` of a shape with
    /// respect to a parameter of the material. `by` holds those of the curve's own quantities over
    /// `es`.
    fn by_parameter<const N: usize>(
        &self,
        shape: EvenShape,
        of_shape: &Piecewise<FUNCTION_TERMS>,
        by: &Piecewise<N>,
    ) -> Piecewise<N> {
        /// The step of the differences. Their error is of the order of its square.
        const STEP: f64 = 1e-4;
        let [more, less] = [STEP, -STEP].map(|step| {
            let pairs = self.functions.pieces().iter().zip(by.pieces());
            let changed = pairs.map(|(piece, by)| scaled(piece, by, step)).collect();
            let changed = Source {
                functions: &self.on_grid(changed),
                ..*self
            };
            changed.integrated(shape, &changed.beginning(), |weights| weights)
        });
        let [more, less] = [more.pieces(), less.pieces()];
        let mut relative = by.pieces().to_vec();
        for (i, relative) in relative.iter_mut().enumerate() {
            let difference: Polynomials<FUNCTION_TERMS> = std::array::from_fn(|k| {
                std::array::from_fn(|q| (more[i][k][q] - less[i][k][q]) / (2.0 * STEP))
            });
            let quotient = ratio(&difference, &of_shape.pieces()[i]);
            let quotient: [[f64; 4]; N] = dispatch!(Level::new(), simd => {
                let series = quotient.map(|row| f64x4::simd_from(simd, row));
                economised::<_, _, FUNCTION_TERMS, N>(simd, &series).map(|row| *row.as_array())
            });
            for (own, new) in relative.iter_mut().zip(quotient) {
                for quantity in [Quantity::Pi0, Quantity::Delta0] {
                    own[quantity as usize] = new[quantity as usize];
                }
            }
        }
        self.on_grid(relative)
    }

    /// Returns polynomials on the pieces of the curve.
    fn on_grid<const N: usize>(&self, pieces: Vec<Polynomials<N>>) -> Piecewise<N> {
        Piecewise::new(self.functions.grid().clone(), pieces)
    }

    /// Returns the thick film with which the ladder begins.
    fn beginning(&self) -> Beginning {
        let grid = self.functions.grid();
        let [first, _] = grid.range();
        let [pi0, eeq, ..] = self.functions.values(first);
        Beginning::new([pi0 / self.es, eeq / self.es], first * grid.factor())
    }

    /// Integrates the ladder of a shape, with changed weights, and returns the pieces. Those beyond
    /// the largest contact of the shape keep the values of the paraboloid.
    fn integrated(
        &self,
        shape: EvenShape,
        beginning: &Beginning,
        change: impl Fn(Weights) -> Weights,
    ) -> Piecewise<FUNCTION_TERMS> {
        let grid = self.functions.grid();
        let unit = grid.factor();
        let most = shape.largest() * unit;
        let ends: Vec<[f64; 2]> = grid
            .pieces()
            .map(|(_, ends)| ends)
            .take_while(|[from, _]| *from < most)
            .collect();
        let of_paraboloid = self.functions.pieces();
        // The last piece is repeated until its group is full. The repetitions are cut off at the end.
        let padded = ends.len().next_multiple_of(LANES);
        let mut pieces = Vec::with_capacity(padded.max(of_paraboloid.len()));
        pieces.resize(padded, [[0.0; 4]; FUNCTION_TERMS]);
        let first = change(shape.weights(beginning.first, unit));
        let mut running = Running::new(&beginning.at(beginning.first), &first, self.es);
        let radius = shape.unit_radius() * unit;
        let targets = pieces.as_chunks_mut().0.iter_mut();
        for ((group, ends), target) in ends.chunks(LANES).enumerate().zip(targets) {
            // Those of the last piece are computed once.
            let mut weights = change(shape.weights(ends[0][1], unit));
            let lanes = std::array::from_fn(|lane| lane.min(ends.len() - 1));
            let group = Group {
                ends: lanes.map(|lane| ends[lane]),
                weights: std::array::from_fn(|lane| {
                    if (1..ends.len()).contains(&lane) {
                        weights = change(shape.weights(ends[lane][1], unit));
                    }
                    weights
                }),
                pieces: lanes.map(|lane| &of_paraboloid[LANES * group + lane]),
                start: (group == 0).then(|| grid.locate(grid.range()[0]).t),
            };
            group.integrated(self.es, radius, &mut running, target);
        }
        pieces.truncate(ends.len());
        pieces.extend_from_slice(&of_paraboloid[ends.len()..]);
        self.on_grid(pieces)
    }
}

/// Returns the quotients of the quantities, as polynomials on a piece.
fn ratio(
    numerator: &Polynomials<FUNCTION_TERMS>,
    denominator: &Polynomials<FUNCTION_TERMS>,
) -> Polynomials<FUNCTION_TERMS> {
    dispatch!(Level::new(), simd => {
        let series = |piece: &Polynomials<FUNCTION_TERMS>| piece.map(|row| f64x4::simd_from(simd, row));
        quotient(simd, &series(numerator), &series(denominator)).map(|row| *row.as_array())
    })
}

/// Returns the quantities times `1 + step by`, as polynomials on a piece.
fn scaled<const N: usize>(
    piece: &Polynomials<FUNCTION_TERMS>,
    by: &Polynomials<N>,
    step: f64,
) -> Polynomials<FUNCTION_TERMS> {
    dispatch!(Level::new(), simd => {
        let by = by.map(|row| f64x4::simd_from(simd, row));
        let piece = piece.map(|row| f64x4::simd_from(simd, row));
        let mut changed = product(simd, &by, &piece);
        let step = f64x4::splat(simd, step);
        for (changed, piece) in changed.iter_mut().zip(piece) {
            *changed = step.mul_add(*changed, piece);
        }
        changed.map(|row| *row.as_array())
    })
}
