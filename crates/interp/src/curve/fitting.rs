//! The choice of the pieces of a curve: the longest on which its polynomials are accurate enough.

use std::sync::Arc;

use crate::curve::bspline::Basis;
use crate::curve::grid::{Grid, Position};
use crate::curve::piecewise::{Values, evaluate, evaluate_all};
use crate::curve::resampler::{Pieces, Resampler, chebyshev_points};
use crate::{Parameter, Quantity};

impl Resampler {
    /// The binary logarithm of the largest number of pieces in an octave that is tried. Pieces as
    /// short as these follow everything but noise.
    const FINEST: u32 = 6;

    /// The binary logarithm of the number of pieces in an octave with which derived quantities are
    /// compared.
    const REFERENCE: u32 = 4;

    /// Finds the longest pieces on which `count` curves follow their splines, and the quantities
    /// derived from them, to a relative `error`.
    ///
    /// `curve(i)` returns the coefficients of curve `i`: a group of the quantities `held` for each
    /// B-spline.
    pub(crate) fn fitting<Coefficients: AsRef<[f64]>>(
        basis: &Basis,
        range: [f64; 2],
        held: &[Quantity],
        count: usize,
        curve: impl Fn(usize) -> Coefficients,
        error: f64,
    ) -> Self {
        // A piece is shorter than the whole range. Otherwise the samples of a piece that extends
        // out of the range would lie closer to each other.
        let length = (range[1] - range[0]) / range[0];
        let coarsest = if length > 0.0 {
            (-length.log2()).ceil().clamp(0.0, 40.0) as u32
        } else {
            0
        };
        let finest = coarsest.max(Self::FINEST);
        let mut bits = vec![coarsest; Grid::most_octaves(range)];
        let mut resampler = Self::new(basis, range, held, &bits);
        let fine = resampler
            .derivation
            .is_some()
            .then(|| Self::new(basis, range, held, &vec![Self::REFERENCE; bits.len()]));
        // New lengths move the ends of all pieces. Therefore the search ends only after all curves,
        // one after another, were followed by the present pieces.
        let mut followed = 0;
        for i in (0..count).cycle() {
            let coefficients = curve(i);
            let target = Target::new(basis, range, held, coefficients.as_ref(), fine.as_ref());
            loop {
                let pieces = target.followed_by(&resampler);
                let mut too_long = vec![false; bits.len()];
                for (piece, (octave, ends)) in resampler.grid.pieces(range[1]).enumerate() {
                    if bits[octave] < finest && !too_long[octave] {
                        too_long[octave] =
                            target.error(&resampler.grid, piece, ends, &pieces[piece]) > error;
                    }
                }
                drop(pieces);
                if !too_long.contains(&true) {
                    break;
                }
                bits.iter_mut()
                    .zip(too_long)
                    .for_each(|(bits, too_long)| *bits += u32::from(too_long));
                resampler = Self::new(basis, range, held, &bits);
                followed = 0;
            }
            followed += 1;
            if followed == count {
                break;
            }
        }
        resampler
    }
}

/// A curve that polynomials on pieces are to follow.
struct Target<'a> {
    basis: &'a Basis,
    range: [f64; 2],
    held: &'a [Quantity],
    /// The coefficients of the splines: a group of the quantities held for each B-spline.
    coefficients: &'a [f64],
    /// The derived quantities on short pieces; none if nothing is derived.
    derived: Option<(&'a Grid, Arc<[Values]>)>,
}

impl<'a> Target<'a> {
    /// Makes the target of splines, with the quantities derived from them on the pieces of `fine`,
    /// if there are any.
    fn new(
        basis: &'a Basis,
        range: [f64; 2],
        held: &'a [Quantity],
        coefficients: &'a [f64],
        fine: Option<&'a Resampler>,
    ) -> Self {
        let derived = |fine: &'a Resampler| {
            let Pieces {
                values,
                start_error,
            } = fine.values(coefficients, 1.0);
            // An error of the size of the quantities, or NaN, belongs to no thick film. Then
            // nothing is derived, and integrals that begin there need not be accurate.
            (start_error? < 1.0).then_some((&*fine.grid, values))
        };
        Self {
            basis,
            range,
            held,
            coefficients,
            derived: fine.and_then(derived),
        }
    }

    /// Returns the polynomials on the pieces of `resampler`. The integrals of derived quantities
    /// begin anew on each piece, because the errors of a piece are to be its own.
    fn followed_by(&self, resampler: &Resampler) -> Arc<[Values]> {
        let (Some((fine, derived)), Some(derivation)) = (&self.derived, &resampler.derivation)
        else {
            return resampler.values(self.coefficients, 1.0).values;
        };
        let grid = &resampler.grid;
        let beginnings = grid.pieces(self.range[1]).map(|(_, [from, _])| {
            let x = (from / grid.factor).max(self.range[0]);
            let position = fine.locate(x);
            let [pi0, eeq, _, delta0] = evaluate_all(&derived[position.piece], position);
            let y = x * grid.factor;
            [eeq * y, delta0 * y.powi(2), pi0 * y.powi(3)]
        });
        let beginnings: Vec<[f64; 3]> = beginnings.collect();
        resampler.derived_from(derivation, self.coefficients, &beginnings)
    }

    /// Returns the largest relative difference between the polynomials on a piece and the target,
    /// midway between the samples and,
    /// if quantities are derived, at the ends; infinity if a difference is NaN.
    fn error(&self, grid: &Grid, piece: usize, ends: [f64; 2], values: &Values) -> f64 {
        let [from, to] = self.range;
        let samples = chebyshev_points(ends, [from, to].map(|x| x * grid.factor));
        let middles = samples
            .windows(2)
            .map(|pair| (pair[0].midpoint(pair[1]) / grid.factor).clamp(from, to));
        // The samples of a piece that extends out of the range are shifted, some to the piece
        // before.
        let middles = middles
            .map(|x| (x, grid.locate(x)))
            .filter(|(_, position)| position.piece == piece);
        // What is left out of the series of the derived quantities is largest at the ends.
        let ends = [(ends[0], -1.0), (ends[1], 1.0)]
            .map(|(y, t)| (y / grid.factor, Position { piece, t }))
            .into_iter()
            .filter(|(x, _)| self.derived.is_some() && (from..=to).contains(x));
        let points = middles.chain(ends);
        let errors = points.flat_map(|(x, position)| {
            let difference = move |(quantity, expected): (Quantity, f64)| {
                (evaluate(values, position, quantity as usize) / expected - 1.0).abs()
            };
            self.of_splines(x).chain(self.of_derived(x)).map(difference)
        });
        errors.fold(0.0, |largest, error| {
            if error.is_nan() {
                f64::INFINITY
            } else {
                largest.max(error)
            }
        })
    }

    /// Returns the quantities held at `x`, over their scales.
    fn of_splines(&self, x: f64) -> impl Iterator<Item = (Quantity, f64)> {
        let splines = self.basis.weights(Parameter::AOverT.coordinate(x));
        let count = self.held.len();
        let sum = move |i: usize| {
            let values = splines.values[..splines.count].iter();
            let groups = self.coefficients.chunks_exact(count).skip(splines.first);
            values
                .zip(groups)
                .map(|(value, group)| value * group[i])
                .sum::<f64>()
        };
        let held = self.held.iter().enumerate();
        held.map(move |(i, &quantity)| (quantity, sum(i).exp()))
    }

    /// Returns the derived quantities at `x`, over their scales.
    fn of_derived(&self, x: f64) -> impl Iterator<Item = (Quantity, f64)> {
        let values = self.derived.as_ref().map(|(grid, pieces)| {
            let position = grid.locate(x);
            evaluate_all(&pieces[position.piece], position)
        });
        let derived = [Quantity::Pi0, Quantity::Eeq, Quantity::Delta0];
        values
            .into_iter()
            .flat_map(move |values| derived.map(|quantity| (quantity, values[quantity as usize])))
    }
}
