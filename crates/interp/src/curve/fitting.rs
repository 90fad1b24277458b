//! The choice of the pieces of a curve: the longest on which its polynomials are accurate enough.

use std::sync::Arc;

use low_rank::bspline::Basis;

use crate::curve::derived::Derivation;
use crate::curve::grid::{Grid, Position};
use crate::curve::piecewise::{Values, evaluate, evaluate_all};
use crate::curve::resampler::{Pieces, Resampler};
use crate::curve::spans::chebyshev_points;
use crate::{Parameter, Quantity};

/// What the choice of the pieces may still take. Curves that ask for new pieces one after another,
/// as those of a forged table may, would make it begin again for each piece of each curve.
#[derive(Clone, Copy, Debug)]
struct Allowance {
    /// The curves to make. They may need much more than their comparison with the pieces.
    curves: usize,
    /// The pieces to compare with a curve.
    pieces: usize,
}

impl Allowance {
    /// The number of pieces, about a second: six times what the embedded table needs.
    const PIECES: usize = 500_000;

    /// Takes a number from one of the two. Returns whether so many were left.
    fn take(left: &mut usize, number: usize) -> bool {
        match left.checked_sub(number) {
            Some(rest) => {
                *left = rest;
                true
            }
            None => false,
        }
    }
}

impl Resampler {
    /// Returns whether [`Self::fitting`] may choose `2^bits[i]` pieces in octave `i` of `range`.
    pub(crate) fn may_have(range: [f64; 2], bits: &[u32]) -> bool {
        let [coarsest, finest] = Self::coarsest_and_finest(range);
        let is_tried = |bits: &u32| (coarsest..=finest).contains(bits);
        bits.len() == Grid::most_octaves(range) && bits.iter().all(is_tried)
    }

    /// Returns the binary logarithms of the smallest and the largest number of pieces in an octave
    /// of `range`.
    fn coarsest_and_finest(range: [f64; 2]) -> [u32; 2] {
        // A piece is shorter than the whole range. Otherwise the samples of a piece that extends
        // out of the range would lie closer to each other.
        let length = (range[1] - range[0]) / range[0];
        let coarsest = if length > 0.0 {
            (-length.log2()).ceil().clamp(0.0, 40.0) as u32
        } else {
            0
        };
        [coarsest, coarsest.max(Self::FINEST)]
    }

    /// The largest mean number of times that a curve is made for the choice of the pieces. The
    /// embedded table needs 1.8.
    pub(crate) const ROUNDS: usize = 6;

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
    /// B-spline. It is called [`Self::ROUNDS`] times `count` at most. If pieces that suffice
    /// are not found with these calls and 500,000 comparisons of a piece with a curve, all pieces
    /// are the shortest.
    pub(crate) fn fitting<Coefficients: AsRef<[f64]>>(
        basis: &Basis,
        range: [f64; 2],
        held: &[Quantity],
        count: usize,
        curve: impl Fn(usize) -> Coefficients,
        error: f64,
    ) -> Self {
        let [coarsest, finest] = Self::coarsest_and_finest(range);
        let mut bits = vec![coarsest; Grid::most_octaves(range)];
        let mut resampler = Self::new(basis, range, held, &bits);
        let fine = resampler
            .derivation
            .is_some()
            .then(|| Self::new(basis, range, held, &vec![Self::REFERENCE; bits.len()]));
        // New lengths move the ends of all pieces. Therefore the search ends only after all curves,
        // one after another, were followed by the present pieces.
        let mut followed = 0;
        let octaves = bits.len();
        let shortest = || Self::new(basis, range, held, &vec![finest; octaves]);
        let mut allowance = Allowance {
            curves: count * Self::ROUNDS,
            pieces: Allowance::PIECES,
        };
        for i in (0..count).cycle() {
            if !Allowance::take(&mut allowance.curves, 1) {
                return shortest();
            }
            let of_fine = fine.as_ref().map_or(0, Self::pieces);
            if !Allowance::take(&mut allowance.pieces, of_fine) {
                return shortest();
            }
            let coefficients = curve(i);
            let target = Target::new(basis, range, held, coefficients.as_ref(), fine.as_ref());
            loop {
                if !Allowance::take(&mut allowance.pieces, resampler.pieces()) {
                    return shortest();
                }
                let pieces = target.followed_by(&resampler);
                let mut too_long = vec![false; bits.len()];
                for (piece, (octave, ends)) in resampler.grid.pieces(range[1]).enumerate() {
                    if bits[octave] < finest && !too_long[octave] {
                        let found = &pieces.values[piece];
                        too_long[octave] =
                            target.error(&resampler.grid, piece, ends, found) > error;
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
                ..
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
    fn followed_by(&self, resampler: &Resampler) -> Pieces {
        let (Some((fine, derived)), Some(derivation)) = (&self.derived, &resampler.derivation)
        else {
            return resampler.values(self.coefficients, 1.0);
        };
        let grid = &resampler.grid;
        let beginnings = grid.pieces(self.range[1]).map(|(_, [from, _])| {
            let x = (from / grid.factor).max(self.range[0]);
            let position = fine.locate(x);
            let [pi0, eeq, _, delta0] = evaluate_all(&derived[position.piece], position);
            Derivation::at(x * grid.factor, [eeq, delta0, pi0])
        });
        let beginnings: Vec<[f64; 3]> = beginnings.collect();
        Pieces {
            values: resampler.derived_from(derivation, self.coefficients, &beginnings),
            start_error: None,
        }
    }

    /// Returns the largest relative difference between the polynomials on a piece and the target, midway between the samples and,
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

#[cfg(test)]
mod tests {
    use std::cell::Cell;

    use super::*;

    /// Curves of noise on sixty decades need the shortest pieces. To compare all of them would take
    /// seconds.
    #[test]
    fn noise_takes_no_more_than_is_allowed() {
        const COUNT: usize = 125;
        let range = [1e-30, 1e30];
        let nodes: Vec<f64> = (0..4000)
            .map(|i| (range[0] * 10_f64.powf(60.0 * f64::from(i) / 3999.0)).ln())
            .collect();
        let basis = Basis::of_table(&nodes);
        for held in [&Quantity::ALL[..], &[Quantity::Gamma]] {
            let calls = Cell::new(0);
            let curve = |i: usize| -> Vec<f64> {
                calls.set(calls.get() + 1);
                let noise = |k: usize| 0.1 * (k as f64 * (1.0 + i as f64)).sin();
                (0..nodes.len() * held.len()).map(noise).collect()
            };
            let resampler = Resampler::fitting(&basis, range, held, COUNT, curve, 1e-12);
            let pieces = resampler.pieces();
            println!("{} curves, {pieces} pieces", calls.get());
            assert!(pieces > 12_000);
            assert!(calls.get() * pieces <= Allowance::PIECES);
        }
    }

    /// Each curve needs short pieces in another octave.
    #[test]
    fn each_curve_is_made_a_few_times_at_most() {
        const COUNT: usize = 125;
        let range = [1e-10, 1e10];
        let nodes: Vec<f64> = (0..1001)
            .map(|i| (range[0] * 10_f64.powf(20.0 * f64::from(i) / 1000.0)).ln())
            .collect();
        let basis = Basis::of_table(&nodes);
        let calls = Cell::new(0);
        let curve = |i: usize| -> Vec<f64> {
            calls.set(calls.get() + 1);
            let bump = |k: usize| {
                if k / 8 == i {
                    1e-3 * (i + 1) as f64
                } else {
                    0.0
                }
            };
            (0..nodes.len()).map(bump).collect()
        };
        Resampler::fitting(&basis, range, &[Quantity::Eeq], COUNT, curve, 1e-9);
        println!("{} curves", calls.get());
        assert!((COUNT..=Resampler::ROUNDS * COUNT).contains(&calls.get()));
    }
}
