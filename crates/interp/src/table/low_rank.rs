//! The low-rank form of a table: a tensor train, one small tensor for each axis.

use crate::curve::bspline::TABLE_DEGREE;
use crate::curve::nodes::REASONABLE;
use crate::table::mixed_precision::BLOCK;
use crate::table::weighted_sum::add_rows;
use crate::{Error, Quantity};

/// Entries of a core are whole numbers that f64 holds exactly.
const LARGEST_ENTRY: i64 = 1 << 53;

/// More values on the nodes are taken for a mistake or a forgery: writing them out would not fit in
/// memory.
const MOST_VALUES: usize = 200_000_000;

/// So are more numbers prepared for lookup. The default box to 1e-8 has 5 million.
const MOST_PREPARED: usize = 20_000_000;

/// The logarithms that a table splines, as a tensor train (I. V. Oseledets, SIAM J. Sci. Comput. 33
/// (2011) 2295). With the scale `s = es`, or 1 for `Delta0`, and at the nodes
/// `(x_i, e1_j, nu1_k, e0_l)`,
///
/// ```text
/// ln(Q_q / s) = sum_{abc}  C0[l,a] / w0[a]  C1[a,j,b] / w1[b]  C2[b,k,c] / w2[c]  C3[c,i,q]
/// C1[a,j,b] = sum_f F1[j,f] G1[a,f,b], and so the others
/// ```
///
/// with the cores `C` of `e0_over_e2`, `e1_over_e2`, `nu1` and `a_over_t`, in the order that takes
/// the fewest multiplications, and the weights `w` of the indices that join them. A core combines a
/// few functions `F` along its axis, which are smooth: rounding its numbers `G` leaves derivatives
/// alone. Between the nodes every core is a spline like the table's own, so that this is the tensor
/// spline through these logarithms: what is measured of it holds for
/// [`Table::expand`](crate::Table::expand) as well.
///
/// A number of a core is to be about as large as what it adds to the logarithms, which is what the
/// weights are for: the root mean square that an index adds. Then all numbers of a core may be
/// rounded to multiples of one step.
#[derive(Clone, Debug)]
pub struct LowRank {
    quantities: Vec<Quantity>,
    weights: [Vec<f64>; 3],
    /// In the order of the cores, as what follows: a row of the functions' values for each node.
    functions: [Vec<f64>; 4],
    steps: [f64; 4],
    /// Whole numbers, multiples of the steps.
    cores: [Vec<f64>; 4],
    nodes: [usize; 4],
}

impl LowRank {
    /// From its parts: the quantities held, ascending; the weights of the three indices that join
    /// the cores, as many as the index has values; the functions of each core's axis, a row of
    /// their values for each node; and the cores as multiples of their steps, row-major over the
    /// index before, the function, and the index after or the quantities held.
    ///
    /// # Errors
    /// [`Error::Malformed`] if no quantity is given, or one twice or not in order; if an index or
    /// an axis has no value; if the lengths contradict each other; if there are more functions than
    /// nodes, or more values of an index than of the index before it and the nodes between
    /// together; if a weight or a step is not in `[1e-30, 1e30]`, a function's value, or an entry
    /// of a core times the step, not in `[-1e30, 1e30]`, or an entry of a core not in
    /// `[-2^53, 2^53]`; or if there are more than 2e8 values on the nodes, or more than 2e7 numbers
    /// to prepare for lookup.
    pub fn new(
        quantities: Vec<Quantity>,
        weights: [Vec<f64>; 3],
        functions: [Vec<f64>; 4],
        steps: [f64; 4],
        cores: [&[i64]; 4],
    ) -> Result<Self, Error> {
        let malformed = |what: String| Err(Error::Malformed(what));
        if quantities.is_empty() || !quantities.is_sorted_by(|a, b| a < b) {
            return malformed(format!("a low-rank form of {quantities:?}"));
        }
        if let Some(number) = weights
            .iter()
            .flatten()
            .chain(&steps)
            .find(|number| !REASONABLE.contains(number))
        {
            return malformed(format!("a low-rank form has the weight or step {number:?}"));
        }
        if let Some(number) = functions
            .iter()
            .flatten()
            .find(|number| !(0.0..=*REASONABLE.end()).contains(&number.abs()))
        {
            return malformed(format!("a low-rank form has the function value {number:?}"));
        }
        for (core, step) in cores.iter().zip(steps) {
            let allowed = |entry: &&i64| {
                entry.unsigned_abs() <= LARGEST_ENTRY.unsigned_abs()
                    && (**entry as f64).abs() * step <= *REASONABLE.end()
            };
            if let Some(entry) = core.iter().find(|entry| !allowed(entry)) {
                return malformed(format!("a core holds {entry} times {step:?}"));
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
                    "a core of {core} entries joins {before} and {after} with {values} values of functions"
                ));
            };
            nodes[i] = count;
        }
        let values = nodes.iter().try_fold(quantities.len(), |product, &nodes| {
            product.checked_mul(nodes)
        });
        if values.is_none_or(|values| values > MOST_VALUES) {
            return malformed(format!("a low-rank form has {nodes:?} nodes"));
        }
        // A lookup fills up the rows, and has one for each function of each interval between nodes.
        let prepared = [[1, a], [a, b], [b, c]].iter().zip(nodes).try_fold(
            0_usize,
            |sum, ([before, after], nodes)| {
                let rows = before.checked_mul(nodes)?.checked_mul(TABLE_DEGREE + 1)?;
                sum.checked_add(rows.checked_mul(after.checked_next_multiple_of(BLOCK)?)?)
            },
        );
        if prepared.is_none_or(|numbers| numbers > MOST_PREPARED) {
            return malformed(format!(
                "a low-rank form has the ranks {:?} with {nodes:?} nodes",
                [a, b, c]
            ));
        }
        let cores = cores.map(|core| core.iter().map(|&entry| entry as f64).collect());
        Ok(Self {
            quantities,
            weights,
            functions,
            steps,
            cores,
            nodes,
        })
    }

    /// The quantities held, in the order of [`Quantity::ALL`].
    pub fn quantities(&self) -> &[Quantity] {
        &self.quantities
    }

    /// How many values each of the indices has that join the cores of `e0_over_e2`, `e1_over_e2`,
    /// `nu1` and `a_over_t`.
    pub fn ranks(&self) -> [usize; 3] {
        self.weights.each_ref().map(Vec::len)
    }

    /// The number of nodes on each axis, in the order of [`Parameter::ALL`](crate::Parameter::ALL).
    pub(crate) fn shape(&self) -> [usize; 4] {
        let [e0, e1, nu, a] = self.nodes;
        [a, e1, nu, e0]
    }

    /// The functions along the axes, in the order of the cores.
    pub(crate) fn functions(&self) -> &[Vec<f64>; 4] {
        &self.functions
    }

    /// The steps, and the whole numbers of the cores.
    pub(crate) fn rounded(&self) -> ([f64; 4], [Vec<i64>; 4]) {
        (
            self.steps,
            self.cores
                .each_ref()
                .map(|core| core.iter().map(|&entry| entry as i64).collect()),
        )
    }

    /// The weights of the indices that join the cores.
    pub(crate) fn weights(&self) -> &[Vec<f64>; 3] {
        &self.weights
    }

    /// The weights and the [cores](Self::cores), scaled such that each index has the root mean
    /// square 1 over the nodes before it, and the weight that it adds to the logarithms. That is
    /// what they should be already, but a lookup leaves out what adds little, and takes nobody's
    /// word for it.
    pub(crate) fn normalised(&self) -> ([Vec<f64>; 3], [Vec<f64>; 4]) {
        let (mut weights, mut cores) = (self.weights.clone(), self.cores());
        // Not of an index that adds nothing.
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
            let (length, added_up) = (
                next.len() / width,
                weights.get(bond + 1).map_or(1, Vec::len),
            );
            for (j, (weight, row)) in weights[bond]
                .iter_mut()
                .zip(next.chunks_exact(length))
                .enumerate()
            {
                let mean_square = sum_of_squares(row.iter()) * added_up as f64 / length as f64;
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

    /// The cores of `e0_over_e2`, `e1_over_e2`, `nu1` and `a_over_t`, row-major over the index
    /// before, the node, and the index after.
    pub(crate) fn cores(&self) -> [Vec<f64>; 4] {
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

    /// The logarithms at all nodes with one `e1_over_e2`, row-major over `nu1`, `e0_over_e2`,
    /// `a_over_t` and the quantities held.
    ///
    /// # Panics
    /// If there is no node of this number.
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
        let joined: Vec<Vec<f64>> = substrate
            .chunks_exact(a)
            .map(|vector| product(0, vector, &film_modulus, n_e1, e1, b))
            .collect();
        let width = radius.len() / c;
        let mut logarithms = Vec::with_capacity(n_nu * joined.len() * width);
        for nu in 0..n_nu {
            for vector in &joined {
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

fn sum_of_squares<'a>(numbers: impl Iterator<Item = &'a f64>) -> f64 {
    numbers.map(|number| number * number).sum()
}

#[cfg(all(test, feature = "embedded"))]
mod tests {
    use crate::Parameter;
    use crate::{Material, Table};

    /// Factors that cancel in the product, between a core and the one after it or a core and its
    /// weights.
    #[test]
    fn what_a_lookup_leaves_out_depends_on_the_product_only() {
        let embedded = Table::embedded();
        let form = embedded.low_rank().expect("it is low-rank");
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
                    let mut other = form.clone();
                    other.weights[bond]
                        .iter_mut()
                        .for_each(|weight| *weight *= factor);
                    other.steps[scaled] *= factor;
                    let axes = Parameter::ALL.map(|parameter| embedded.axis(parameter).to_vec());
                    let table = Table::from_low_rank(embedded.description().clone(), axes, other)
                        .expect("a sound form");
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
