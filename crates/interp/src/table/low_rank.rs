//! The low-rank form of a table: a tensor train, one core for each axis.

use crate::curve::nodes::REASONABLE;
use crate::table::demand::Demand;
use crate::table::weighted_sum::add_rows;
use crate::{Error, Quantity};

/// The largest entry of a core: f64 holds whole numbers up to this one exactly.
const LARGEST_ENTRY: i64 = 1 << 53;

/// The largest number of values at the nodes. More are taken for a mistake or a forgery: they would
/// not fit in memory when written out.
const MOST_VALUES: usize = 200_000_000;

/// The logarithms of a table's quantities at its nodes, as a tensor train (I. V. Oseledets, SIAM J.
/// Sci. Comput. 33 (2011) 2295).
///
/// With the scale `s = es`, or 1 for `Delta0`, and at the nodes `(x_i, e1_j, nu1_k, e0_l)`,
///
/// ```text
/// ln(Q_q / s) = sum_{abc}  C0[l,a] / w0[a]  C1[a,j,b] / w1[b]  C2[b,k,c] / w2[c]  C3[c,i,q]
/// C1[a,j,b] = sum_f F1[j,f] G1[a,f,b], and the other cores likewise
/// ```
///
/// with the cores `C` of `e0_over_e2`, `e1_over_e2`, `nu1` and `a_over_t`, in the order that needs
/// the fewest multiplications. The bonds `a`, `b` and `c` are the indices shared by neighbouring
/// cores; `w` are their weights. A core combines a few smooth functions `F` along its axis;
/// therefore rounding its numbers `G` does not spoil derivatives. Between the nodes every core is
/// interpolated by the splines of the table. The form is then the tensor spline through these
/// logarithms, and its measured errors hold for [`Table::expand`](crate::Table::expand), too.
///
/// The weight of a bond index is the root mean square of its contribution to the logarithms. With
/// these weights each number of a core is about as large as its contribution, and all numbers of a
/// core can be rounded to multiples of one step.
#[derive(Clone, Debug)]
pub struct LowRank {
    quantities: Vec<Quantity>,
    /// The weights of the three bonds.
    weights: [Vec<f64>; 3],
    /// For each core, in the order of the cores: a row of the functions' values for each node.
    functions: [Vec<f64>; 4],
    /// The steps to whose multiples the numbers of each core are rounded.
    steps: [f64; 4],
    /// The numbers of each core as multiples of its step: whole numbers.
    cores: [Vec<f64>; 4],
    /// The number of nodes of each core's axis.
    nodes: [usize; 4],
    demand: Demand,
}

impl LowRank {
    /// Makes the form from its parts.
    ///
    /// * `quantities`: the quantities held, ascending.
    /// * `weights`: the weights of the three bonds, one for each value of the bond.
    /// * `functions`: the functions along each core's axis, a row of their values for each node.
    /// * `steps`: the step of each core.
    /// * `cores`: the cores as multiples of their steps, row-major over the bond before, the
    ///   function, and the bond after (the quantities held, for the last core).
    ///
    /// # Errors
    /// [`Error::Malformed`]
    ///
    /// * if no quantity is given, one is given twice, or they are not in order;
    /// * if a bond or an axis is empty, or the lengths contradict each other;
    /// * if there are more functions than nodes, or a bond is longer than the product of the bond
    ///   before and the nodes between;
    /// * if a weight or a step is not in `[1e-30, 1e30]`, a function's value, or an entry of a core
    ///   times its step, not in `[-1e30, 1e30]`, or an entry of a core not in `[-2^53, 2^53]`;
    /// * if there are more than 2e8 values at the nodes.
    ///
    /// [`Error::LowRankTooLarge`] if the first lookup would need more than 1e8 numbers, or more
    /// numbers or products than 100 and 2500 for each byte that the parts take in a file. These
    /// limits do not hold below 1e6 numbers and 1e8 products. The parts of an honest table need 13
    /// and 392 for each byte (the embedded table). What does not depend on the size of the form, the
    /// choice of the pieces of a curve, has a limit of its own: 500,000 comparisons of a piece with a
    /// curve, about a second.
    pub fn new(
        quantities: Vec<Quantity>,
        weights: [Vec<f64>; 3],
        functions: [Vec<f64>; 4],
        steps: [f64; 4],
        cores: [&[i64]; 4],
    ) -> Result<Self, Error> {
        let malformed = |what: String| Err(Error::Malformed(what));
        if quantities.is_empty() || !quantities.is_sorted_by(|a, b| a < b) {
            return malformed(format!(
                "a low-rank form holds {quantities:?}: it must hold one quantity at least, in order"
            ));
        }
        if let Some(number) = weights
            .iter()
            .flatten()
            .chain(&steps)
            .find(|number| !REASONABLE.contains(number))
        {
            return malformed(format!(
                "a low-rank form has the weight or step {number:?}, outside [1e-30, 1e30]"
            ));
        }
        if let Some(number) = functions
            .iter()
            .flatten()
            .find(|number| !(0.0..=*REASONABLE.end()).contains(&number.abs()))
        {
            return malformed(format!(
                "a low-rank form has the function value {number:?}, outside [-1e30, 1e30]"
            ));
        }
        for (core, step) in cores.iter().zip(steps) {
            let allowed = |entry: &&i64| {
                entry.unsigned_abs() <= LARGEST_ENTRY.unsigned_abs()
                    && (**entry as f64).abs() * step <= *REASONABLE.end()
            };
            if let Some(entry) = core.iter().find(|entry| !allowed(entry)) {
                return malformed(format!(
                    "a core holds {entry} times {step:?}: entries must be in [-2^53, 2^53], and their \
                     products with the step in [-1e30, 1e30]"
                ));
            }
        }
        let [a, b, c] = weights.each_ref().map(Vec::len);
        let mut nodes = [0; 4];
        for (i, [before, after]) in [[1, a], [a, b], [b, c], [c, quantities.len()]]
            .into_iter()
            .enumerate()
        {
            let (core, values) = (cores[i].len(), functions[i].len());
            let quotient = |whole: usize, part: usize| {
                (part > 0 && whole > 0 && whole.is_multiple_of(part)).then(|| whole / part)
            };
            let count = before
                .checked_mul(after)
                .and_then(|pairs| quotient(core, pairs));
            let sound = |&[count, nodes]: &[usize; 2]| {
                count <= nodes && (i == 3 || after <= before * nodes)
            };
            let Some([_, count]) = count
                .and_then(|count| Some([count, quotient(values, count)?]))
                .filter(sound)
            else {
                return malformed(format!(
                    "a core of {core} entries between bonds of {before} and {after} cannot have {values} \
                     values of functions"
                ));
            };
            nodes[i] = count;
        }
        let values = nodes.iter().try_fold(quantities.len(), |product, &nodes| {
            product.checked_mul(nodes)
        });
        if values.is_none_or(|values| values > MOST_VALUES) {
            return malformed(format!(
                "a low-rank form has {nodes:?} nodes, more than {MOST_VALUES} values"
            ));
        }
        let demand = Demand::new([a, b, c], nodes, &functions, cores, quantities.len());
        demand.check([a, b, c], nodes)?;
        let cores = cores.map(|core| core.iter().map(|&entry| entry as f64).collect());
        Ok(Self {
            quantities,
            weights,
            functions,
            steps,
            cores,
            nodes,
            demand,
        })
    }

    /// Returns the quantities held, in the order of [`Quantity::ALL`].
    pub fn quantities(&self) -> &[Quantity] {
        &self.quantities
    }

    /// Returns the ranks: the lengths of the bonds between the cores of `e0_over_e2`, `e1_over_e2`,
    /// `nu1` and `a_over_t`.
    pub fn ranks(&self) -> [usize; 3] {
        self.weights.each_ref().map(Vec::len)
    }

    /// Returns the number of nodes on each axis, in the order of
    /// [`Parameter::ALL`](crate::Parameter::ALL).
    pub(crate) fn shape(&self) -> [usize; 4] {
        let [e0, e1, nu, a] = self.nodes;
        [a, e1, nu, e0]
    }

    /// Returns what the first lookup needs.
    pub(crate) fn demand(&self) -> Demand {
        self.demand
    }

    /// Returns the functions along the axes, in the order of the cores.
    pub(crate) fn functions(&self) -> &[Vec<f64>; 4] {
        &self.functions
    }

    /// Returns the steps, and the cores as multiples of them.
    pub(crate) fn rounded(&self) -> ([f64; 4], [Vec<i64>; 4]) {
        (
            self.steps,
            self.cores
                .each_ref()
                .map(|core| core.iter().map(|&entry| entry as i64).collect()),
        )
    }

    /// Returns the weights of the bonds.
    pub(crate) fn weights(&self) -> &[Vec<f64>; 3] {
        &self.weights
    }

    /// Returns the weights and the [cores](Self::cores), scaled such that each bond index has a
    /// root mean square of 1 over the nodes before it, and its contribution to the logarithms as
    /// weight.
    ///
    /// Recomputed, because lookup drops small entries and must not trust the file.
    pub(crate) fn normalised(&self) -> ([Vec<f64>; 3], [Vec<f64>; 4]) {
        let (mut weights, mut cores) = (self.weights.clone(), self.cores());
        // A bond index without any contribution is not scaled.
        let sound = |scale: f64| {
            if REASONABLE.contains(&scale) {
                scale
            } else {
                1.0
            }
        };
        for bond in 0..3 {
            let (before, after) = cores.split_at_mut(bond + 1);
            let (core, next, width) = (&before[bond], &mut after[0], weights[bond].len());
            let length = next.len() / width;
            for (j, (weight, row)) in weights[bond]
                .iter_mut()
                .zip(next.chunks_exact_mut(length))
                .enumerate()
            {
                let mean_square =
                    sum_of_squares(core[j..].iter().step_by(width)) / self.nodes[bond] as f64;
                let size = sound(mean_square.sqrt() / *weight);
                *weight *= size;
                row.iter_mut().for_each(|entry| *entry *= size);
            }
        }
        for bond in (0..3).rev() {
            let (before, after) = cores.split_at_mut(bond + 1);
            let (core, next, width) = (&mut before[bond], &after[0], weights[bond].len());
            let (length, summed) = (
                next.len() / width,
                weights.get(bond + 1).map_or(1, Vec::len),
            );
            for (j, (weight, row)) in weights[bond]
                .iter_mut()
                .zip(next.chunks_exact(length))
                .enumerate()
            {
                let mean_square = sum_of_squares(row.iter()) * summed as f64 / length as f64;
                let share = sound(mean_square.sqrt() / *weight);
                *weight *= share;
                core[j..]
                    .iter_mut()
                    .step_by(width)
                    .for_each(|entry| *entry *= share);
            }
        }
        (weights, cores)
    }

    /// Returns the cores of `e0_over_e2`, `e1_over_e2`, `nu1` and `a_over_t`, row-major over the
    /// bond before, the node, and the bond after (the quantities held, for the last core).
    fn cores(&self) -> [Vec<f64>; 4] {
        let [a, b, c] = self.ranks();
        let at_nodes = |i: usize, after: usize| {
            let (functions, core, nodes) = (&self.functions[i], &self.cores[i], self.nodes[i]);
            let count = functions.len() / nodes;
            let mut at_nodes = vec![0.0; core.len() / count * nodes];
            for (numbers, at_nodes) in core
                .chunks_exact(count * after)
                .zip(at_nodes.chunks_exact_mut(nodes * after))
            {
                for (values, row) in functions
                    .chunks_exact(count)
                    .zip(at_nodes.chunks_exact_mut(after))
                {
                    add_rows(row, values, numbers, after);
                    row.iter_mut().for_each(|entry| *entry *= self.steps[i]);
                }
            }
            at_nodes
        };
        [
            at_nodes(0, a),
            at_nodes(1, b),
            at_nodes(2, c),
            at_nodes(3, self.quantities.len()),
        ]
    }

    /// Returns the logarithms at all nodes with node `e1` of `e1_over_e2`, row-major over `nu1`,
    /// `e0_over_e2`, `a_over_t` and the quantities held.
    ///
    /// # Panics
    /// If `e1` is not below the number of nodes of `e1_over_e2`.
    pub fn logarithms(&self, e1: usize) -> Vec<f64> {
        let [substrate, film_modulus, film, radius] = self.cores();
        let [_, n_e1, n_nu, _] = self.nodes;
        let [a, b, c] = self.ranks();
        let product = |bond: usize,
                       vector: &[f64],
                       core: &[f64],
                       nodes: usize,
                       node: usize,
                       length: usize| {
            let vector: Vec<f64> = vector
                .iter()
                .zip(&self.weights[bond])
                .map(|(entry, weight)| entry / weight)
                .collect();
            let mut sum = vec![0.0; length];
            add_rows(&mut sum, &vector, &core[node * length..], nodes * length);
            sum
        };
        let before: Vec<Vec<f64>> = substrate
            .chunks_exact(a)
            .map(|vector| product(0, vector, &film_modulus, n_e1, e1, b))
            .collect();
        let width = radius.len() / c;
        let mut logarithms = Vec::with_capacity(n_nu * before.len() * width);
        for nu in 0..n_nu {
            for vector in &before {
                logarithms.extend(product(
                    2,
                    &product(1, vector, &film, n_nu, nu, c),
                    &radius,
                    1,
                    0,
                    width,
                ));
            }
        }
        logarithms
    }
}

/// Returns the sum of the squares of the numbers.
fn sum_of_squares<'a>(numbers: impl Iterator<Item = &'a f64>) -> f64 {
    numbers.map(|number| number * number).sum()
}

#[cfg(all(test, feature = "embedded"))]
mod tests {
    use crate::{Material, Table, Tiles};

    /// Factors that cancel, between two neighbouring cores or between a core and its weights.
    #[test]
    fn what_a_lookup_leaves_out_depends_on_the_product_only() {
        let embedded = Table::embedded();
        let tiles = embedded.low_rank().expect("it is low-rank");
        let material = Material::new(1e-3, 0.4999, 2e5, 0.25).expect("physical");
        let look_up = |table: &Table| {
            table
                .curve(&material)
                .and_then(|curve| curve.quantities(0.5))
                .expect("inside")
                .to_array()
        };
        let expected = look_up(embedded);
        for bond in 0..3 {
            for factor in [1e-9, 1e9] {
                for scaled in [bond, bond + 1] {
                    let mut forms = tiles.forms().to_vec();
                    let other = &mut forms[0];
                    other.weights[bond]
                        .iter_mut()
                        .for_each(|weight| *weight *= factor);
                    other.steps[scaled] *= factor;
                    let (description, axes) = (embedded.description().clone(), embedded.axes());
                    let table = Tiles::new(tiles.cuts().to_vec(), forms)
                        .and_then(|tiles| Table::from_low_rank(description, axes, tiles))
                        .expect("sound forms");
                    for (found, expected) in look_up(&table).into_iter().zip(expected) {
                        assert!(
                            (found / expected - 1.0).abs() < 1e-12,
                            "bond {bond}, {factor}: {found}, not {expected}"
                        );
                    }
                }
            }
        }
    }
}
