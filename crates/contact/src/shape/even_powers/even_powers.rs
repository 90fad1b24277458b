//! The contact without adhesion under a shape of even powers, from the curve of a material.

use std::sync::Arc;

use fearless_simd::prelude::*;
use fearless_simd::{Level, dispatch, f64x4};
use interp::{Curve, Error, Quantity};
use piecewise::lanes::LANES;
use piecewise::series::{economised, product, quotient};
use piecewise::{FUNCTION_TERMS, Piecewise, Polynomials};

use super::beginning::Beginning;
use super::ladder::{Group, Running};
use super::thick_films::ThickFilms;
use super::weights::{EvenShape, Weights, dilated};

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
    pub(in crate::shape) fn new(own: &Curve, shape: EvenShape) -> Result<Self, Error> {
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
