//! The choice of the pieces: the longest on which polynomials follow curves accurately enough.

use crate::FUNCTION_TERMS;
use crate::bspline::Basis;
use crate::functions::Piecewise;
use crate::grid::{Grid, Position};
use crate::resampler::Resampler;
use crate::spans::chebyshev_points;

/// A curve that polynomials on pieces are to follow: some of four functions of `x`. `R` makes the
/// polynomials.
pub trait Target<R> {
    /// Returns the polynomials of the functions on the pieces of a resampler.
    fn polynomials(&self, resampler: &R) -> Piecewise<FUNCTION_TERMS>;

    /// Returns the number and the value of each function at `x`.
    fn values(&self, x: f64) -> impl Iterator<Item = (usize, f64)>;

    /// Returns whether the polynomials are tested at the ends of the pieces, too. What is left out of
    /// truncated series is largest there.
    fn is_tested_at_ends(&self) -> bool;
}

/// The functions whose logarithms are splines over `ln x`, as a [`Target`].
#[derive(Clone, Copy, Debug)]
pub struct Exponentials<'a, C> {
    /// The B-splines.
    pub basis: &'a Basis,
    /// The places of the functions among four.
    pub functions: &'a [usize],
    /// The coefficients of the splines: a group of the functions for each B-spline.
    pub coefficients: C,
}

/// What is asked of the pieces.
#[derive(Clone, Copy, Debug)]
pub struct Fitting {
    /// The range of `x`.
    pub range: [f64; 2],
    /// The number of curves that the polynomials are to follow.
    pub curves: usize,
    /// The largest relative error of the polynomials.
    pub error: f64,
}

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
    /// The number of pieces, about a second: six times what the embedded table of the crate `interp`
    /// needs.
    const PIECES: usize = 500_000;

    /// Takes a number from one of the two. Returns whether so many were left.
    fn take(left: &mut usize, number: usize) -> bool {
        let rest = left.checked_sub(number);
        *left = rest.unwrap_or(*left);
        rest.is_some()
    }
}

impl Fitting {
    /// The largest mean number of times that a curve is made for the choice of the pieces. The
    /// embedded table of the crate `interp` needs 1.8.
    pub const ROUNDS: usize = 6;

    /// The binary logarithm of the largest number of pieces in an octave that is tried. Pieces as
    /// short as these follow everything but noise.
    const FINEST: u32 = 6;

    /// Returns whether [`Self::longest`] may choose `2^bits[i]` pieces in octave `i` of `range`.
    pub fn may_choose(range: [f64; 2], bits: &[u32]) -> bool {
        let [coarsest, finest] = Self::coarsest_and_finest(range);
        let is_tried = |bits: &u32| (coarsest..=finest).contains(bits);
        bits.len() == Grid::most_octaves(range) && bits.iter().all(is_tried)
    }

    /// Returns the binary logarithms of the smallest and the largest number of pieces in an octave
    /// of `range`.
    fn coarsest_and_finest(range: [f64; 2]) -> [u32; 2] {
        // A piece is shorter than the whole range. Otherwise the samples of a piece that extends
        // out of the range would lie closer to each other. An octave has two pieces at least, because the
        // loads of other functions of `x` than these, such as the shape of a sphere, follow on them.
        let length = (range[1] - range[0]) / range[0];
        let coarsest = if length > 0.0 {
            (-length.log2()).ceil().clamp(1.0, 40.0) as u32
        } else {
            0
        };
        [coarsest, coarsest.max(Self::FINEST)]
    }

    /// Finds the longest pieces on which polynomials follow all curves.
    ///
    /// `resampler(bits)` makes what turns curves into polynomials on `2^bits[i]` pieces in octave `i`,
    /// and `curve(i)` makes curve `i`, which takes as long as its comparison with `pieces_of_curve` pieces.
    /// It is called [`Self::ROUNDS`] times the number of curves at most. If pieces that suffice are not
    /// found with these calls and 500,000 comparisons of a piece with a curve, all pieces are the shortest.
    pub fn longest<R: AsRef<Resampler>, T: Target<R>>(
        &self,
        pieces_of_curve: usize,
        resampler: impl Fn(&[u32]) -> R,
        curve: impl Fn(usize) -> T,
    ) -> R {
        let [coarsest, finest] = Self::coarsest_and_finest(self.range);
        let octaves = Grid::most_octaves(self.range);
        let mut bits = vec![coarsest; octaves];
        let mut own = resampler(&bits);
        // New lengths move the ends of all pieces. Therefore the search ends only after all curves,
        // one after another, were followed by the present pieces.
        let mut followed = 0;
        let shortest = || resampler(&vec![finest; octaves]);
        let mut allowance = Allowance {
            curves: self.curves * Self::ROUNDS,
            pieces: Allowance::PIECES,
        };
        for i in (0..self.curves).cycle() {
            if !Allowance::take(&mut allowance.curves, 1)
                || !Allowance::take(&mut allowance.pieces, pieces_of_curve)
            {
                return shortest();
            }
            let target = curve(i);
            loop {
                let grid = own.as_ref().grid();
                if !Allowance::take(&mut allowance.pieces, grid.count()) {
                    return shortest();
                }
                let polynomials = target.polynomials(&own);
                let mut too_long = vec![false; octaves];
                for (piece, (octave, ends)) in grid.pieces().enumerate() {
                    if bits[octave] < finest && !too_long[octave] {
                        too_long[octave] = error(&target, &polynomials, piece, ends) > self.error;
                    }
                }
                if !too_long.contains(&true) {
                    break;
                }
                // Before there are others.
                drop(polynomials);
                bits.iter_mut()
                    .zip(too_long)
                    .for_each(|(bits, too_long)| *bits += u32::from(too_long));
                own = resampler(&bits);
                followed = 0;
            }
            followed += 1;
            if followed == self.curves {
                break;
            }
        }
        own
    }
}

impl Resampler {
    /// Returns the resampler with the longest pieces on which polynomials follow functions whose
    /// logarithms are splines, see [`Fitting::longest`]. `coefficients(i)` returns the coefficients of
    /// curve `i`, as [`Exponentials`] holds them.
    pub fn fitting<C: AsRef<[f64]>>(
        basis: &Basis,
        functions: &[usize],
        fitting: &Fitting,
        coefficients: impl Fn(usize) -> C,
    ) -> Self {
        let curve = |i: usize| Exponentials {
            basis,
            functions,
            coefficients: coefficients(i),
        };
        let resampler = |bits: &[u32]| Self::new(basis, fitting.range, functions, bits);
        fitting.longest(0, resampler, curve)
    }
}

impl AsRef<Self> for Resampler {
    fn as_ref(&self) -> &Self {
        self
    }
}

/// Returns the largest relative difference between the polynomials on a piece and the target, midway
/// between the samples and, if the target asks for it, at the ends; infinity if a difference is NaN.
fn error<R>(
    target: &impl Target<R>,
    polynomials: &Piecewise<FUNCTION_TERMS>,
    piece: usize,
    ends: [f64; 2],
) -> f64 {
    let grid = polynomials.grid();
    let ([from, to], factor) = (grid.range(), grid.factor());
    let samples = chebyshev_points(ends, [from, to].map(|x| x * factor));
    let middles = samples
        .windows(2)
        .map(|pair| (pair[0].midpoint(pair[1]) / factor).clamp(from, to));
    // The samples of a piece that extends out of the range are shifted, some to the piece before.
    let middles = middles
        .map(|x| (x, grid.locate(x)))
        .filter(|(_, position)| position.piece == piece);
    let ends = [(ends[0], -1.0), (ends[1], 1.0)]
        .map(|(y, t)| (y / factor, Position { piece, t }))
        .into_iter()
        .filter(|(x, _)| target.is_tested_at_ends() && (from..=to).contains(x));
    let errors = middles.chain(ends).flat_map(|(x, position)| {
        target.values(x).map(move |(function, expected)| {
            (polynomials.value_at(function, position) / expected - 1.0).abs()
        })
    });
    errors.fold(0.0, |largest, error| {
        if error.is_nan() {
            f64::INFINITY
        } else {
            largest.max(error)
        }
    })
}

impl<C: AsRef<[f64]>> Target<Resampler> for Exponentials<'_, C> {
    fn polynomials(&self, resampler: &Resampler) -> Piecewise<FUNCTION_TERMS> {
        resampler.exponentials(self.coefficients.as_ref(), [1.0; 4])
    }

    fn values(&self, x: f64) -> impl Iterator<Item = (usize, f64)> {
        let splines = self.basis.weights(x.ln());
        let count = self.functions.len();
        let sum = move |i: usize| {
            let values = splines.values[..splines.count].iter();
            let groups = self
                .coefficients
                .as_ref()
                .chunks_exact(count)
                .skip(splines.first);
            values
                .zip(groups)
                .map(|(value, group)| value * group[i])
                .sum::<f64>()
        };
        let functions = self.functions.iter().enumerate();
        functions.map(move |(i, &function)| (function, sum(i).exp()))
    }

    fn is_tested_at_ends(&self) -> bool {
        false
    }
}

#[cfg(test)]
mod tests {
    use std::cell::Cell;

    use super::*;

    /// Each curve needs short pieces in another octave.
    #[test]
    fn each_curve_is_made_a_few_times_at_most() {
        const CURVES: usize = 125;
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
        let fitting = Fitting {
            range,
            curves: CURVES,
            error: 1e-9,
        };
        Resampler::fitting(&basis, &[1], &fitting, curve);
        println!("{} curves", calls.get());
        assert!((CURVES..=Fitting::ROUNDS * CURVES).contains(&calls.get()));
    }
}
