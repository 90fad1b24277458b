//! The low-rank form of a table, a tensor train, by successive singular value decompositions of its
//! logarithms (I. V. Oseledets, SIAM J. Sci. Comput. 33 (2011) 2295).
//!
//! Mode after mode, what is left of the tensor is projected on the leading left singular vectors of
//! its unfolding, which become the mode's core. The four quantities belong to the last mode: they
//! share all cores but that one. Each core is then projected on the leading functions along its
//! axis. Of the orders of the material axes, `e0_over_e2`, `e1_over_e2`, `nu1` takes the fewest
//! multiplications at a lookup: in the default box the pairs (`e0`, `e1`), (`e1`, `nu`) and (`e0`,
//! `nu`) have the ranks 81, 117 to 125 and 86 at 7e-8.
//!
//! Everything but the measurement of errors, whose maximum knows no order, happens in one thread:
//! the result depends on no number of threads.

use faer::{Mat, MatRef};
use interp::{LowRank, Table};
use rayon::prelude::*;

use crate::Error;
use crate::table::compress::end_slope::EndSlope;

/// The root mean square of what is left out at each joint, over the largest error allowed anywhere:
/// the bounds of the search. In the default box it ends between a twentieth and a fiftieth.
const LOOSEST: f64 = 1.0;
const TIGHTEST: f64 = 1e-3;
/// The same where derivatives are kept, of which errors of values may be a small part. In the
/// default box it ends near a hundredth.
const TIGHTEST_WITH_DERIVATIVES: f64 = 1e-5;
/// Each halves the range of its logarithm, to 3 % at last, or 5 %.
const BISECTIONS: usize = 8;
/// What is left out at each joint, in parts of it. The first one's few indices cost little and
/// weigh little from one to the next.
const JOINTS: [f64; 3] = [0.1, 1.0, 1.0];
/// The same where derivatives are kept: they see most what is left out at the last joint. The
/// default box to 1e-7 has the ranks 82 and 93 then, and is within 75 tolerances of the true
/// derivatives; else 81 and 77, and hundreds of tolerances.
const JOINTS_WITH_DERIVATIVES: [f64; 3] = [0.1, 3.0, 0.3];
/// The same of the functions along an axis, which cost nothing at a lookup.
const FUNCTIONS: f64 = 0.1;
/// The step of a core in units of the root mean square that is left out at a joint, spread over its
/// numbers: the rounding of a core adds `0.2/sqrt(12)` of what each truncation does. Larger steps
/// save a tenth of the bytes and show in derivatives with respect to `nu1` near 0.5.
const STEP: f64 = 0.2;

/// A table in low-rank form, with about as few numbers as its largest relative error at the nodes
/// allows; and, if an error is given for them, the derivatives of the logarithms with respect to
/// `nu1` at 0.5, times `1/(1 + (a/t)^2)`, at the other axes' nodes.
///
/// # Errors
/// [`Error::Truncation`] or [`Error::DerivativeTruncation`] where a form that leaves out next to
/// nothing has a larger error; [`Error::NoIncompressibleEnd`] for that of derivatives that the
/// table does not have.
pub fn compress(
    table: &Table,
    error: f64,
    derivative_error: Option<f64>,
) -> Result<LowRank, Error> {
    let kept = match derivative_error {
        Some(allowed) => Some((EndSlope::of(table)?, allowed)),
        None => None,
    };
    let (tightest, joints) = if kept.is_some() {
        (TIGHTEST_WITH_DERIVATIVES, JOINTS_WITH_DERIVATIVES)
    } else {
        (TIGHTEST, JOINTS)
    };
    // What is left out here shows no more beside what is left out later.
    let train = Train::of(table, 0.1 * tightest * error);
    let attempt = |share: f64| -> Result<(LowRank, Result<(), Error>), Error> {
        let form = train.truncated(
            table,
            joints.map(|part| part * share * error),
            share * error,
        )?;
        let [reached, derivative] =
            largest_differences(table, kept.as_ref().map(|(slope, _)| slope), &form);
        let verdict = match kept {
            _ if reached > error => Err(Error::Truncation { error, reached }),
            Some((_, allowed)) if derivative > allowed => Err(Error::DerivativeTruncation {
                allowed,
                reached: derivative,
            }),
            _ => Ok(()),
        };
        Ok((form, verdict))
    };
    let (mut best, verdict) = attempt(tightest)?;
    verdict?;
    let (mut tight, mut loose) = (tightest.ln(), LOOSEST.ln());
    for _ in 0..BISECTIONS {
        let middle = 0.5 * (tight + loose);
        let (form, verdict) = attempt(middle.exp())?;
        if verdict.is_ok() {
            (best, tight) = (form, middle);
        } else {
            loose = middle;
        }
    }
    Ok(best)
}

/// The largest difference of a table's logarithms at the nodes from those of a low-rank form, which
/// is the largest relative error of its quantities; and of their derivatives, if these are kept.
fn largest_differences(table: &Table, kept: Option<&EndSlope>, form: &LowRank) -> [f64; 2] {
    let [_, n_e1, ..] = table.shape();
    let differences = (0..n_e1).into_par_iter().map(|e1| {
        let mut differences = table.logarithms(e1);
        differences
            .iter_mut()
            .zip(form.logarithms(e1))
            .for_each(|(exact, truncated)| *exact -= truncated);
        let largest = differences
            .iter()
            .fold(0.0, |largest, difference| difference.abs().max(largest));
        [
            largest,
            kept.map_or(0.0, |slope| slope.largest(&differences)),
        ]
    });
    differences.reduce(|| [0.0; 2], |a, b| [a[0].max(b[0]), a[1].max(b[1])])
}

/// The logarithms of a table as a train that leaves next to nothing out.
struct Train {
    /// For each joint, the root mean square that each of its indices adds to the logarithms,
    /// descending.
    weights: [Vec<f64>; 3],
    /// Scaled such that the vectors of each index, of whatever joint, have the root mean square 1
    /// on the nodes before it. The last one's have that of the index.
    cores: [Vec<f64>; 4],
}

impl Train {
    /// Leaves out no more than `tail` (root mean square) at each joint.
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

    /// The low-rank form without the last indices of each joint, as many as leave out no more than
    /// this (root mean square), and with entries rounded to about `tail`.
    fn truncated(&self, table: &Table, at_joints: [f64; 3], tail: f64) -> Result<LowRank, Error> {
        let [n_a, n_e1, n_nu, n_e0] = table.shape();
        let held = table.quantities().len();
        let (mut kept, mut most) = ([0; 3], 1);
        for (joint, nodes) in [n_e0, n_e1, n_nu].into_iter().enumerate() {
            let squares: Vec<f64> = self.weights[joint]
                .iter()
                .map(|weight| weight * weight)
                .collect();
            // An index has no more values than that before it and the nodes between together.
            most *= nodes;
            most = rank(&squares, at_joints[joint]).min(most);
            kept[joint] = most;
        }
        let weights: [&[f64]; 3] = std::array::from_fn(|joint| &self.weights[joint][..kept[joint]]);
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
            // Each quantity is one of those that the root mean square is taken of.
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
            // Finer steps than those of f64 at the largest entry are of no use.
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

/// The logarithms of a table, row-major over `e0_over_e2`, `e1_over_e2`, `nu1`, `a_over_t` and the
/// quantities held.
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

/// The left singular vectors of a matrix and their singular values, without as many of the last as
/// leave out no more than `tail` (Frobenius norm).
///
/// They are those of the triangle of a QR decomposition of the transposed matrix, which comes in
/// blocks of rows; the matrix of scalar products would be quicker and have half the digits.
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

fn row_major(matrix: MatRef<'_, f64>) -> impl Iterator<Item = f64> {
    (0..matrix.nrows())
        .flat_map(move |row| (0..matrix.ncols()).map(move |column| matrix[(row, column)]))
}

/// How many squares are left, one at least, if the last ones whose sum is no more than the square
/// of `tail` are dropped.
fn rank(squares: &[f64], tail: f64) -> usize {
    let mut dropped = 0.0;
    let small = squares.iter().rev().take_while(|&&square| {
        dropped += square;
        dropped <= tail * tail
    });
    (squares.len() - small.count()).max(1)
}
