//! The low-rank form of a table, a tensor train, by successive singular value decompositions of its
//! logarithms (I. V. Oseledets, SIAM J. Sci. Comput. 33 (2011) 2295).
//!
//! For one mode after the other, the rest of the tensor is projected on the leading left singular
//! vectors of its unfolding, which become the core of the mode. The quantities belong to the last
//! mode: they share all other cores. Each core is then projected on the leading functions along its
//! axis. Among the orders of the material axes, `e0_over_e2`, `e1_over_e2`, `nu1` takes the fewest
//! multiplications at a lookup: in the default box the pairs (`e0`, `e1`), (`e1`, `nu`) and (`e0`,
//! `nu`) have the ranks 81, 117 to 125 and 86 at 7e-8.
//!
//! Everything but the measurement of errors, whose maximum does not depend on an order, happens in
//! one thread: the result does not depend on the number of threads.

use faer::{Mat, MatRef};
use interp::{LowRank, Table};
use rayon::prelude::*;

use crate::Error;
use crate::solve::larger;

/// The root mean square of the part left out at each bond, over the largest error allowed anywhere:
/// the bounds of the search. In the default box it ends between a twentieth and a fiftieth.
const LOOSEST: f64 = 1.0;
const TIGHTEST: f64 = 1e-3;
/// The number of bisections. Each halves the range of the logarithm of the root mean square, to 3 %
/// in the end.
const BISECTIONS: usize = 8;
/// The part left out at each bond, in units of the root mean square. The few indices of the first
/// bond cost little.
const BONDS: [f64; 3] = [0.1, 1.0, 1.0];
/// The part left out of the functions along an axis, in units of the root mean square. They add
/// nothing to the cost of a lookup.
const FUNCTIONS: f64 = 0.1;
/// The step of a core in units of the root mean square that is left out at a bond, spread over its
/// numbers: the rounding of a core adds `0.2/sqrt(12)` of what each truncation does. Larger steps
/// save a tenth of the bytes and show in derivatives with respect to `nu1` near 0.5.
const STEP: f64 = 0.2;

/// Returns a table as one tensor train, with about as few numbers as `error` allows, the largest
/// relative error of the quantities at the nodes.
///
/// # Errors
/// [`Error::Truncation`] where a form that leaves out next to nothing has a larger error.
pub(super) fn truncate(table: &Table, error: f64) -> Result<LowRank, Error> {
    // The part left out here does not show beside the part left out later.
    let train = Train::of(table, 0.1 * TIGHTEST * error);
    let attempt = |share: f64| -> Result<Result<LowRank, f64>, Error> {
        let form = train.truncated(table, BONDS.map(|part| part * share * error), share * error)?;
        let reached = largest_difference(table, &form);
        Ok(if reached <= error {
            Ok(form)
        } else {
            Err(reached)
        })
    };
    let (mut best, mut tight, mut loose) = (None, TIGHTEST.ln(), LOOSEST.ln());
    for _ in 0..BISECTIONS {
        let middle = 0.5 * (tight + loose);
        match attempt(middle.exp()) {
            Ok(Ok(form)) => (best, tight) = (Some(form), middle),
            Ok(Err(_)) => loose = middle,
            // A form with as many numbers as this is of no use, whatever its error.
            Err(Error::Table(interp::Error::LowRankTooLarge { .. })) => tight = middle,
            Err(error) => return Err(error),
        }
    }
    match best {
        Some(form) => Ok(form),
        None => attempt(TIGHTEST)?.map_err(|reached| Error::Truncation { error, reached }),
    }
}

/// Returns the largest difference of a table's logarithms at the nodes from those of a low-rank
/// form, which is the largest relative error of its quantities.
fn largest_difference(table: &Table, form: &LowRank) -> f64 {
    let [_, n_e1, ..] = table.shape();
    let differences = (0..n_e1).into_par_iter().map(|e1| {
        let (exact, truncated) = (table.logarithms(e1), form.logarithms(e1));
        exact
            .iter()
            .zip(truncated)
            .map(|(exact, truncated)| (exact - truncated).abs())
            .fold(0.0, larger)
    });
    differences.reduce(|| 0.0, larger)
}

/// The logarithms of a table as a tensor train that leaves out next to nothing.
struct Train {
    /// For each bond, the root mean square that each of its indices adds to the logarithms,
    /// descending.
    weights: [Vec<f64>; 3],
    /// The cores, scaled such that the vectors of each index of a bond have the root mean square 1
    /// on the nodes before the bond. Those of the last core have the root mean square of the index.
    cores: [Vec<f64>; 4],
}

impl Train {
    /// Decomposes the logarithms of a table. Leaves out at most `tail` (root mean square) at each
    /// bond.
    fn of(table: &Table, tail: f64) -> Self {
        let [n_a, n_e1, n_nu, n_e0] = table.shape();
        let mut rest = tensor(table);
        let scale = (rest.len() as f64).sqrt();
        let (mut weights, mut cores) = ([const { Vec::new() }; 3], [const { Vec::new() }; 4]);
        let mut before = 1;
        for (i, nodes) in [n_e0, n_e1, n_nu].into_iter().enumerate() {
            let rows = before * nodes;
            let unfolding = MatRef::from_row_major_slice(&rest, rows, rest.len() / rows);
            let (vectors, values) = singular_vectors(unfolding, tail * scale);
            let projected = vectors.transpose() * unfolding;
            let norm = (nodes as f64).sqrt();
            cores[i] = row_major(vectors.as_ref())
                .map(|component| norm * component)
                .collect();
            rest = row_major(projected.as_ref()).collect();
            before = values.len();
            weights[i] = values.into_iter().map(|value| value / scale).collect();
        }
        let norm = (scale * scale / (n_a * table.quantities().len()) as f64).sqrt();
        cores[3] = rest.into_iter().map(|entry| entry / norm).collect();
        Self { weights, cores }
    }

    /// Returns the low-rank form without the last indices of each bond, which leave out at most
    /// `at_bonds` (root mean square), and with entries rounded to about `tail`.
    fn truncated(&self, table: &Table, at_bonds: [f64; 3], tail: f64) -> Result<LowRank, Error> {
        let [n_a, n_e1, n_nu, n_e0] = table.shape();
        let held = table.quantities().len();
        let (mut kept, mut most) = ([0; 3], 1);
        for (bond, nodes) in [n_e0, n_e1, n_nu].into_iter().enumerate() {
            let squares: Vec<f64> = self.weights[bond]
                .iter()
                .map(|weight| weight * weight)
                .collect();
            // A bond has no more indices than the bond before it and the nodes between together.
            most *= nodes;
            most = rank(&squares, at_bonds[bond]).min(most);
            kept[bond] = most;
        }
        let weights: [&[f64]; 3] = std::array::from_fn(|bond| &self.weights[bond][..kept[bond]]);
        let (mut functions, mut steps, mut cores) = (
            [const { Vec::new() }; 4],
            [0.0; 4],
            [const { Vec::new() }; 4],
        );
        for (i, nodes) in [n_e0, n_e1, n_nu, n_a].into_iter().enumerate() {
            let before = if i == 0 { 1 } else { kept[i - 1] };
            let (after, of_after) = if i == 3 {
                (held, held)
            } else {
                (kept[i], self.weights[i].len())
            };
            let entry = |node: usize, pair: usize| {
                let (index, after) = (pair / after, pair % after);
                let weight = if i == 3 { 1.0 } else { weights[i][after] };
                weight * self.cores[i][(index * nodes + node) * of_after + after]
            };
            let core = Mat::from_fn(nodes, before * after, entry);
            // The root mean square is that over the quantities.
            let of_one = if i == 3 { held as f64 } else { 1.0 };
            let (vectors, values) = singular_vectors(
                core.as_ref(),
                FUNCTIONS * tail * (nodes as f64 * of_one).sqrt(),
            );
            let norm = (nodes as f64).sqrt();
            let numbers = vectors.transpose() * &core / norm;
            let count = values.len();
            functions[i] = row_major(vectors.as_ref())
                .map(|value| norm * value)
                .collect();
            // Steps finer than the rounding of f64 at the largest entry are of no use.
            let largest = numbers.norm_max().max(f64::MIN_POSITIVE);
            steps[i] = (STEP * tail / ((before * count * after) as f64 / of_one).sqrt())
                .max(f64::EPSILON * largest);
            let ordered = (0..before).flat_map(|b| {
                (0..count).flat_map(move |f| (0..after).map(move |a| (f, b * after + a)))
            });
            cores[i] = ordered
                .map(|at| (numbers[at] / steps[i]).round() as i64)
                .collect();
        }
        let cores = cores.each_ref().map(Vec::as_slice);
        Ok(LowRank::new(
            table.quantities(),
            weights.map(<[f64]>::to_vec),
            functions,
            steps,
            cores,
        )?)
    }
}

/// Returns the logarithms of a table, row-major over `e0_over_e2`, `e1_over_e2`, `nu1`, `a_over_t`
/// and the quantities held.
fn tensor(table: &Table) -> Vec<f64> {
    let [n_a, n_e1, n_nu, n_e0] = table.shape();
    let width = n_a * table.quantities().len();
    let mut tensor = vec![0.0; n_e0 * n_e1 * n_nu * width];
    for e1 in 0..n_e1 {
        for (i, row) in table.logarithms(e1).chunks_exact(width).enumerate() {
            let (nu, e0) = (i / n_e0, i % n_e0);
            tensor[((e0 * n_e1 + e1) * n_nu + nu) * width..][..width].copy_from_slice(row);
        }
    }
    tensor
}

/// Returns the left singular vectors of a matrix and their singular values, without the last ones,
/// which leave out at most `tail` (Frobenius norm).
///
/// They are those of the triangle of a QR decomposition of the transposed matrix, which is read in
/// blocks of rows. The matrix of scalar products would be faster and have half the digits.
fn singular_vectors(matrix: MatRef<'_, f64>, tail: f64) -> (Mat<f64>, Vec<f64>) {
    const BLOCK: usize = 1024;
    let mut triangle: Mat<f64> = Mat::zeros(0, matrix.nrows());
    for first in (0..matrix.ncols()).step_by(BLOCK) {
        let above = triangle.nrows();
        let stacked = Mat::from_fn(
            above + BLOCK.min(matrix.ncols() - first),
            matrix.nrows(),
            |row, i| match row.checked_sub(above) {
                None => triangle[(row, i)],
                Some(row) => matrix[(i, first + row)],
            },
        );
        triangle = stacked.qr().thin_R().to_owned();
    }
    let decomposition = triangle
        .transpose()
        .thin_svd()
        .expect("a table holds no NaN");
    let mut values: Vec<f64> = decomposition.S().column_vector().iter().copied().collect();
    let squares: Vec<f64> = values.iter().map(|value| value * value).collect();
    values.truncate(rank(&squares, tail));
    (
        decomposition.U().subcols(0, values.len()).to_owned(),
        values,
    )
}

/// Returns the entries of a matrix, row by row.
fn row_major(matrix: MatRef<'_, f64>) -> impl Iterator<Item = f64> {
    (0..matrix.nrows())
        .flat_map(move |row| (0..matrix.ncols()).map(move |column| matrix[(row, column)]))
}

/// Returns the number of squares, one at least, that are left when the last ones are dropped, whose
/// sum is at most the square of `tail`.
fn rank(squares: &[f64], tail: f64) -> usize {
    let mut dropped = 0.0;
    let small = squares.iter().rev().take_while(|&&square| {
        dropped += square;
        dropped <= tail * tail
    });
    (squares.len() - small.count()).max(1)
}
