//! The low-rank (Tucker) form of a table: a few functions along each axis, and a core that combines them.

use crate::table::REASONABLE;
use crate::{Error, Quantity};

/// Entries of the core are whole numbers that f64 holds exactly.
const LARGEST_ENTRY: i64 = 1 << 53;

/// More values on the nodes are taken for a mistake or a forgery: writing them out would not fit in memory.
const MOST_VALUES: usize = 200_000_000;

/// The logarithms that a table splines, in Tucker form. With the scale `s = es`, or 1 for `Delta0`, and at the nodes
/// `(x_i, e1_j, nu1_k, e0_l)`,
///
/// ```text
/// ln(Q_q / s) = step  sum_{abcd}  F0[i,a] F1[j,b] F2[k,c] F3[l,d] core[b,c,d,a,q]
/// ```
///
/// with the factors `F` of `a_over_t`, `e1_over_e2`, `nu1`, `e0_over_e2`, which all quantities share. Between the nodes every column of a
/// factor is a spline like the table's own, so that this is the tensor spline through these logarithms: what is measured of it holds for
/// [`Table::expand`](crate::Table::expand) as well.
#[derive(Clone, Debug)]
pub struct LowRank {
    pub(crate) quantities: Vec<Quantity>,
    pub(crate) ranks: [usize; 4],
    pub(crate) factors: [Vec<f64>; 4],
    pub(crate) step: f64,
    /// Whole numbers.
    pub(crate) core: Vec<f64>,
}

impl LowRank {
    /// From its parts: the quantities held, ascending; the ranks of the four axes; their factors, a row of as many numbers as the rank for each
    /// node; and the core as multiples of `step`, row-major over `e1_over_e2`, `nu1`, `e0_over_e2`, `a_over_t` and the quantities held.
    ///
    /// # Errors
    /// [`Error::Malformed`] if no quantity is given, or one twice or not in order; if a rank is 0, more than there are nodes, or
    /// contradicts the length of factor or core; if a number of a factor is not in `[-1e30, 1e30]`, the step not in `[1e-30, 1e30]`, or an entry of
    /// the core not in `[-2^53, 2^53]`; or if there are more than 2e8 values on the nodes.
    pub fn new(
        quantities: Vec<Quantity>,
        ranks: [usize; 4],
        factors: [Vec<f64>; 4],
        step: f64,
        core: &[i64],
    ) -> Result<Self, Error> {
        let malformed = |what: String| Err(Error::Malformed(what));
        if quantities.is_empty() || !quantities.is_sorted_by(|a, b| a < b) {
            return malformed(format!("a low-rank form of {quantities:?}"));
        }
        for (rank, factor) in ranks.iter().zip(&factors) {
            if *rank == 0 || factor.len() % rank != 0 || factor.len() / rank < *rank {
                return malformed(format!("a factor of {} numbers has rank {rank}", factor.len()));
            }
            if let Some(number) = factor.iter().find(|number| !(0.0..=*REASONABLE.end()).contains(&number.abs())) {
                return malformed(format!("a factor holds {number:?}"));
            }
        }
        let held = quantities.len();
        let product = |sizes: [usize; 4]| sizes.iter().try_fold(held, |product, &size| product.checked_mul(size));
        if product(ranks) != Some(core.len()) {
            return malformed(format!("a core of {} entries has the ranks {ranks:?}", core.len()));
        }
        if !REASONABLE.contains(&step) {
            return malformed(format!("a core in steps of {step:?}"));
        }
        if let Some(entry) = core.iter().find(|entry| entry.unsigned_abs() > LARGEST_ENTRY.unsigned_abs()) {
            return malformed(format!("a core holds {entry}"));
        }
        let core = core.iter().map(|&entry| entry as f64).collect();
        let form = Self { quantities, ranks, factors, step, core };
        if product(form.nodes()).is_none_or(|values| values > MOST_VALUES) {
            return malformed(format!("a low-rank form has {:?} nodes", form.nodes()));
        }
        Ok(form)
    }

    /// The quantities held, in the order of [`Quantity::ALL`].
    pub fn quantities(&self) -> &[Quantity] {
        &self.quantities
    }

    /// How many functions there are along each axis, in the order of [`Parameter::ALL`](crate::schema::Parameter::ALL).
    pub const fn ranks(&self) -> [usize; 4] {
        self.ranks
    }

    /// The number of nodes on each axis.
    pub(crate) fn nodes(&self) -> [usize; 4] {
        std::array::from_fn(|axis| self.factors[axis].len() / self.ranks[axis])
    }

    /// The logarithms at all nodes with one `e1_over_e2`, row-major over `nu1`, `e0_over_e2`, `a_over_t` and the quantities held.
    ///
    /// # Panics
    /// If there is no node of this number.
    pub fn logarithms(&self, e1: usize) -> Vec<f64> {
        let [a_over_t, ..] = &self.factors;
        let held = self.quantities.len();
        let row = |axis: usize, node: usize| &self.factors[axis][node * self.ranks[axis]..][..self.ranks[axis]];
        let [nodes, _, n_nu, n_e0] = self.nodes();
        let mut logarithms = Vec::with_capacity(n_nu * n_e0 * nodes * held);
        let film_modulus = combine(row(1, e1), &self.core);
        for nu in 0..n_nu {
            let film = combine(row(2, nu), &film_modulus);
            for e0 in 0..n_e0 {
                let material = combine(row(3, e0), &film);
                for weights in a_over_t.chunks_exact(self.ranks[0]) {
                    let start = logarithms.len();
                    logarithms.resize(start + held, 0.0);
                    add_rows(&mut logarithms[start..], self.step, weights, &material);
                }
            }
        }
        logarithms
    }
}

/// The weighted sum of rows of equal length, as many as there are weights.
pub(crate) fn combine(weights: &[f64], rows: &[f64]) -> Vec<f64> {
    let mut sum = vec![0.0; rows.len() / weights.len()];
    add_rows(&mut sum, 1.0, weights, rows);
    sum
}

/// Adds `factor` times the weighted sum of rows, each as long as the sum.
pub(crate) fn add_rows(sum: &mut [f64], factor: f64, weights: &[f64], rows: &[f64]) {
    for (weight, row) in weights.iter().zip(rows.chunks_exact(sum.len())) {
        add_row(sum, factor * weight, row);
    }
}

/// `sum += weight row`, as far as the row goes.
pub(crate) fn add_row(sum: &mut [f64], weight: f64, row: &[f64]) {
    for (sum, value) in sum.iter_mut().zip(row) {
        *sum += weight * value;
    }
}
