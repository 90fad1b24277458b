//! The low-rank (Tucker) form of a table, by the higher-order singular value decomposition of its logarithms.
//!
//! Mode after mode, the tensor is projected on the leading left singular vectors of its unfolding, which become the mode's factor; what is
//! left of it is the core (Vannieuwenhoven, Vandebril and Meerbergen, SIAM J. Sci. Comput. 34 (2012) A1027). The four quantities are one more
//! mode, which is not touched: they share the factors, and a joint form is as small as four separate ones. The entries of the core are rounded to
//! multiples of one step, because most are small and then take a byte each.
//!
//! Everything but the measurement of errors, whose maximum knows no order, happens in one thread: the result depends on no number of threads.

use std::borrow::Cow;

use faer::Mat;
use interp::{LowRank, Quantity, Table};
use rayon::prelude::*;

use crate::Error;

/// The root mean square of what is left out along each mode, over the largest error allowed anywhere: the bounds of the search. In the default
/// box it ends between a twentieth and a fiftieth.
const LOOSEST: f64 = 1.0;
const TIGHTEST: f64 = 1e-3;
/// Each halves the range of its logarithm, to 3 % at last.
const BISECTIONS: usize = 8;
/// The step of the core in units of the root mean square that is left out along a mode, spread over the entries of the core: rounding then adds
/// `3/sqrt(12)` of what each truncation does. More shows in the error, less in the bytes.
const STEP: f64 = 3.0;

/// A table in low-rank form, with about as few bytes as its largest relative error at the nodes allows.
///
/// # Errors
/// [`Error::Truncation`] where rounding does not allow the error.
pub fn compress(table: &Table, error: f64) -> Result<LowRank, Error> {
    let logarithms = Tensor::of(table);
    let norm = |rms: f64| rms * (logarithms.entries.len() as f64).sqrt();
    // What is left out here shows no more beside what is left out later.
    let least = norm(0.1 * TIGHTEST * error);
    let (mut core, mut factors) = (Cow::Borrowed(&logarithms), [const { Vec::new() }; 4]);
    // The first axes have the longest rows, and leave little for the last one.
    for axis in [1, 2, 3, 0] {
        factors[axis] = core.singular_vectors(MODES[axis], least);
        core = Cow::Owned(core.projected(MODES[axis], &factors[axis]));
    }
    let attempt = |share: f64| -> Result<(LowRank, f64), Error> {
        let form = core.truncated(table.quantities(), &factors, norm(share * error))?;
        let reached = logarithms.largest_difference(&form);
        Ok((form, reached))
    };
    let (mut best, reached) = attempt(TIGHTEST)?;
    if reached > error {
        return Err(Error::Truncation { error, reached });
    }
    let (mut tight, mut loose) = (TIGHTEST.ln(), LOOSEST.ln());
    for _ in 0..BISECTIONS {
        let middle = 0.5 * (tight + loose);
        let (form, reached) = attempt(middle.exp())?;
        if reached <= error {
            (best, tight) = (form, middle);
        } else {
            loose = middle;
        }
    }
    Ok(best)
}

/// The modes of the tensor that belong to `a_over_t`, `e1_over_e2`, `nu1`, `e0_over_e2`.
const MODES: [usize; 4] = [3, 0, 1, 2];

/// The logarithms of a table, and what becomes of them.
#[derive(Clone)]
struct Tensor {
    /// `e1_over_e2`, `nu1`, `e0_over_e2`, `a_over_t`, quantities held; row-major.
    shape: [usize; 5],
    entries: Vec<f64>,
}

impl Tensor {
    fn of(table: &Table) -> Self {
        let [n_a, n_e1, n_nu, n_e0] = table.shape();
        let shape = [n_e1, n_nu, n_e0, n_a, table.quantities().len()];
        let mut entries = vec![0.0; shape.iter().product()];
        let slabs = entries.par_chunks_exact_mut(shape[1..].iter().product());
        slabs.enumerate().for_each(|(e1, slab)| slab.copy_from_slice(&table.logarithms(e1)));
        Self { shape, entries }
    }

    /// The largest difference of the logarithms at the nodes from those of a low-rank form: the largest relative error of its quantities.
    fn largest_difference(&self, form: &LowRank) -> f64 {
        let slabs = self.entries.par_chunks_exact(self.shape[1..].iter().product());
        let differences = slabs.enumerate().map(|(e1, slab)| {
            let pairs = slab.iter().zip(form.logarithms(e1));
            pairs.map(|(exact, truncated)| (exact - truncated).abs()).fold(0.0, f64::max)
        });
        differences.reduce(|| 0.0, f64::max)
    }

    /// The length of a mode, and of what varies faster.
    fn mode(&self, mode: usize) -> (usize, usize) {
        (self.shape[mode], self.shape[mode + 1..].iter().product())
    }

    /// The left singular vectors of the unfolding along a mode, without as many of the last as leave out no more than `tail` (Frobenius norm): a
    /// row of components for each index of the mode.
    ///
    /// They are those of the triangle of a QR decomposition of the transposed unfolding, which comes in blocks of rows; the matrix of scalar
    /// products would be quicker and have half the digits.
    fn singular_vectors(&self, mode: usize, tail: f64) -> Vec<f64> {
        const BLOCK: usize = 1024;
        let (length, inner) = self.mode(mode);
        let count = self.entries.len() / length;
        let mut triangle: Mat<f64> = Mat::zeros(0, length);
        for first in (0..count).step_by(BLOCK) {
            let above = triangle.nrows();
            let stacked = Mat::from_fn(above + BLOCK.min(count - first), length, |row, i| match row.checked_sub(above) {
                None => triangle[(row, i)],
                Some(row) => {
                    let (outer, after) = ((first + row) / inner, (first + row) % inner);
                    self.entries[(outer * length + i) * inner + after]
                }
            });
            triangle = stacked.qr().thin_R().to_owned();
        }
        let decomposition = triangle.transpose().thin_svd().expect("a table holds no NaN");
        let values: Vec<f64> = decomposition.S().column_vector().iter().map(|value| value * value).collect();
        let rank = rank(&values, tail);
        (0..length).flat_map(|i| (0..rank).map(move |k| (i, k))).map(|at| decomposition.U()[at]).collect()
    }

    /// The tensor with the components along the columns of a factor in place of a mode.
    fn projected(&self, mode: usize, factor: &[f64]) -> Self {
        let (length, inner) = self.mode(mode);
        let rank = factor.len() / length;
        let mut projected = vec![0.0; self.entries.len() / length * rank];
        for (slab, projected) in self.entries.chunks_exact(length * inner).zip(projected.chunks_exact_mut(rank * inner)) {
            for (row, weights) in slab.chunks_exact(inner).zip(factor.chunks_exact(rank)) {
                for (projected, weight) in projected.chunks_exact_mut(inner).zip(weights) {
                    projected.iter_mut().zip(row).for_each(|(sum, entry)| *sum += weight * entry);
                }
            }
        }
        let mut shape = self.shape;
        shape[mode] = rank;
        Self { shape, entries: projected }
    }

    /// The low-rank form without the last indices of each mode, as many as leave out no more than `tail` (Frobenius norm), and with entries
    /// rounded to about as much.
    fn truncated(&self, quantities: Vec<Quantity>, factors: &[Vec<f64>; 4], tail: f64) -> Result<LowRank, Error> {
        let ranks = MODES.map(|mode| rank(&self.energies(mode), tail));
        let [r_a, r_e1, r_nu, r_e0] = ranks;
        let [_, n_nu, n_e0, n_a, held] = self.shape;
        let mut kept: Vec<f64> = Vec::with_capacity(ranks.iter().product::<usize>() * held);
        for e1 in 0..r_e1 {
            for nu in 0..r_nu {
                for e0 in 0..r_e0 {
                    let row = ((e1 * n_nu + nu) * n_e0 + e0) * n_a * held;
                    kept.extend(&self.entries[row..row + r_a * held]);
                }
            }
        }
        // Finer steps than those of f64 at the largest entry are of no use.
        let largest = kept.iter().fold(f64::MIN_POSITIVE, |largest, entry| largest.max(entry.abs()));
        let step = (STEP * tail / (kept.len() as f64).sqrt()).max(f64::EPSILON * largest);
        let core: Vec<i64> = kept.iter().map(|entry| (entry / step).round() as i64).collect();
        let leading = |axis: usize| {
            let rows = factors[axis].chunks_exact(self.shape[MODES[axis]]);
            rows.flat_map(|row| row[..ranks[axis]].iter().copied()).collect()
        };
        Ok(LowRank::new(quantities, ranks, std::array::from_fn(leading), step, &core)?)
    }

    /// The sums of squares of the slices along a mode.
    fn energies(&self, mode: usize) -> Vec<f64> {
        let (length, inner) = self.mode(mode);
        let mut energies = vec![0.0; length];
        for (i, row) in self.entries.chunks_exact(inner).enumerate() {
            energies[i % length] += row.iter().map(|entry| entry * entry).sum::<f64>();
        }
        energies
    }
}

/// How many squares are left, one at least, if the last ones whose sum is no more than the square of `tail` are dropped.
fn rank(squares: &[f64], tail: f64) -> usize {
    let mut dropped = 0.0;
    let small = squares.iter().rev().take_while(|&&square| {
        dropped += square;
        dropped <= tail * tail
    });
    (squares.len() - small.count()).max(1)
}
