//! Interpolating splines in one variable, on nodes of any spacing.
//!
//! A spline of degree `p` through `n` nodes has the knots of the "not-a-knot" choice: the nodes
//! without the `(p+1)/2 - 1` next to each end. It has exactly `n` coefficients and reproduces
//! polynomials of degree `p`. Its error falls like `h^{p+1}` with the distance `h` of the nodes.

/// The degree of the splines through the nodes of a table; on fewer than ten nodes it is lower.
///
/// Higher degrees save few nodes at tolerances from 1e-4 to 1e-8, and each doubles the number of
/// coefficients that a curve is summed from. On lines through the default box of tables, a quintic needs
/// 1.2 to 1.3 times as many nodes on each axis at 1e-6, and 1.7 to 1.9 times as many at 1e-8.
pub const TABLE_DEGREE: usize = 9;

/// The highest degree of a [`Basis`].
pub const LARGEST_DEGREE: usize = 13;

/// The B-splines of one set of nodes, with the factorised collocation matrix.
#[derive(Clone, Debug)]
pub struct Basis {
    /// The degree of the polynomials.
    degree: usize,
    /// Ascending; the first and the last are repeated `degree + 1` times.
    knots: Vec<f64>,
    /// The number of nodes, and of coefficients.
    count: usize,
    /// The `LU` factors of the collocation matrix: row `i` holds the entries
    /// `i - degree ..= i + degree` of `L` (below the diagonal, which is 1) and of `U`.
    factors: Vec<[f64; 2 * LARGEST_DEGREE + 1]>,
}

/// The B-splines that do not vanish at one point, with their values and first derivatives.
#[derive(Clone, Copy, Debug)]
pub struct Weights {
    /// The index of the first B-spline that does not vanish.
    pub first: usize,
    /// The values of the B-splines from `first` on; the first [`Weights::count`] entries are used.
    pub values: [f64; LARGEST_DEGREE + 1],
    /// The first derivatives, in the order of the values.
    pub slopes: [f64; LARGEST_DEGREE + 1],
    /// The number of B-splines that do not vanish: the degree plus one.
    pub count: usize,
}

impl Basis {
    /// Makes the basis of a table along an axis; `nodes` are the coordinates of the axis' nodes.
    /// Its degree is [`TABLE_DEGREE`].
    ///
    /// # Panics
    /// If `nodes` is empty.
    pub fn of_table(nodes: &[f64]) -> Self {
        Self::new(nodes, TABLE_DEGREE)
    }

    /// Makes the basis of `degree`, or of one less than the number of nodes if that is lower.
    ///
    /// # Panics
    /// If `nodes` is empty or `degree` is above [`LARGEST_DEGREE`]. Nodes that do not ascend
    /// strictly give a useless basis, not a panic.
    pub fn new(nodes: &[f64], degree: usize) -> Self {
        assert!(
            !nodes.is_empty() && degree <= LARGEST_DEGREE,
            "{} nodes, degree {degree}",
            nodes.len()
        );
        let count = nodes.len();
        let degree = degree.min(count - 1);
        let dropped = degree.div_ceil(2);
        let mut knots = vec![nodes[0]; degree + 1];
        let inner = count - degree - 1;
        if inner > 0 {
            knots.extend(&nodes[dropped..dropped + inner]);
        }
        knots.extend(vec![nodes[count - 1]; degree + 1]);
        let mut basis = Self {
            degree,
            knots,
            count,
            factors: Vec::new(),
        };
        basis.factors = basis.factorise(nodes);
        basis
    }

    /// Returns the number of nodes, and of coefficients.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Evaluates the B-splines that do not vanish at `u`.
    ///
    /// Beyond the first and the last node they are the polynomials of the nearest interval, which
    /// grow without bound. At NaN they are NaN, except for the one of degree 0.
    pub fn weights(&self, u: f64) -> Weights {
        let p = self.degree;
        let inner = &self.knots[p + 1..self.knots.len() - p - 1];
        let span = p + inner.partition_point(|&knot| knot <= u);
        let mut values = [0.0; LARGEST_DEGREE + 1];
        let mut lower = [0.0; LARGEST_DEGREE + 1];
        values[0] = 1.0;
        // The recursion of Cox and de Boor, degree by degree.
        for degree in 1..=p {
            lower = values;
            let mut carried = 0.0;
            for (i, &value) in lower[..degree].iter().enumerate() {
                let (left, right) = (self.knots[span + 1 + i - degree], self.knots[span + 1 + i]);
                let share = value / (right - left);
                values[i] = carried + (right - u) * share;
                carried = (u - left) * share;
            }
            values[degree] = carried;
        }
        let first = span - p;
        let mut slopes = [0.0; LARGEST_DEGREE + 1];
        for (i, &value) in lower[..p].iter().enumerate() {
            let share =
                p as f64 * value / (self.knots[span + 1 + i] - self.knots[span + 1 + i - p]);
            slopes[i] -= share;
            slopes[i + 1] += share;
        }
        Weights {
            first,
            values,
            slopes,
            count: p + 1,
        }
    }

    /// Factorises the banded collocation matrix `B_j(nodes_i)`. It is totally positive and needs no
    /// pivoting.
    fn factorise(&self, nodes: &[f64]) -> Vec<[f64; 2 * LARGEST_DEGREE + 1]> {
        let p = self.degree;
        let mut rows: Vec<[f64; 2 * LARGEST_DEGREE + 1]> = nodes
            .iter()
            .enumerate()
            .map(|(i, &node)| {
                let weights = self.weights(node);
                let mut row = [0.0; 2 * LARGEST_DEGREE + 1];
                for (k, value) in weights.values[..weights.count].iter().enumerate() {
                    // A value outside the band is 0, for instance one at the last node.
                    if let Some(entry) = (weights.first + k + p)
                        .checked_sub(i)
                        .and_then(|at| row.get_mut(at))
                    {
                        *entry = *value;
                    }
                }
                row
            })
            .collect();
        for i in 0..rows.len() {
            let pivot = rows[i];
            for below in i + 1..rows.len().min(i + p + 1) {
                let offset = below - i;
                let factor = rows[below][p - offset] / pivot[p];
                rows[below][p - offset] = factor;
                for k in 1..=p {
                    rows[below][p - offset + k] -= factor * pivot[p + k];
                }
            }
        }
        rows
    }

    /// Turns values at the nodes into coefficients, in place, for `width` splines at once.
    ///
    /// `values` is row-major: a row of `width` numbers for each node, one for each spline. Numbers
    /// after the last row are not changed.
    ///
    /// # Panics
    /// If `values` has fewer numbers than nodes times `width`.
    pub fn interpolate(&self, values: &mut [f64], width: usize) {
        let (n, p) = (self.count(), self.degree);
        for i in 0..n {
            for k in 1..=p.min(i) {
                subtract_row(values, width, i, i - k, self.factors[i][p - k]);
            }
        }
        for i in (0..n).rev() {
            for k in 1..=p.min(n - 1 - i) {
                subtract_row(values, width, i, i + k, self.factors[i][p + k]);
            }
            let pivot = self.factors[i][p];
            values[i * width..][..width]
                .iter_mut()
                .for_each(|value| *value /= pivot);
        }
    }
}

/// Computes `values[target] -= factor * values[source]` for rows of `width` numbers.
fn subtract_row(values: &mut [f64], width: usize, target: usize, source: usize, factor: f64) {
    if factor == 0.0 {
        return;
    }
    let (low, high) = values.split_at_mut(target.max(source) * width);
    let (low, high) = (
        &mut low[target.min(source) * width..][..width],
        &mut high[..width],
    );
    let (target, source) = if target > source {
        (high, low)
    } else {
        (low, high)
    };
    for (target, source) in target.iter_mut().zip(source) {
        *target -= factor * *source;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn nodes(n: usize) -> Vec<f64> {
        (0..n)
            .map(|i| (i as f64 + 0.3 * (i as f64).sin()) / n as f64)
            .collect()
    }

    fn evaluate(
        weights: &Weights,
        factors: &[f64; LARGEST_DEGREE + 1],
        coefficients: &[f64],
    ) -> f64 {
        (0..weights.count)
            .map(|k| factors[k] * coefficients[weights.first + k])
            .sum()
    }

    #[test]
    fn reproduces_polynomials_of_its_degree_with_their_slopes() {
        for degree in [1, 3, 5, 9, 13] {
            for n in 1..20 {
                let order = degree.min(n - 1) as i32;
                let nodes = nodes(n);
                let basis = Basis::new(&nodes, degree);
                let mut coefficients: Vec<f64> =
                    nodes.iter().map(|x| (x - 0.4).powi(order)).collect();
                basis.interpolate(&mut coefficients, 1);
                for i in 0..=50 {
                    let u = nodes[0] + (nodes[n - 1] - nodes[0]) * f64::from(i) / 50.0;
                    let weights = basis.weights(u);
                    let value = evaluate(&weights, &weights.values, &coefficients);
                    let slope = evaluate(&weights, &weights.slopes, &coefficients);
                    assert!(
                        (value - (u - 0.4).powi(order)).abs() < 1e-13,
                        "degree {degree}, {n} nodes, u = {u}: {value}"
                    );
                    let expected = if order == 0 {
                        0.0
                    } else {
                        f64::from(order) * (u - 0.4).powi(order - 1)
                    };
                    assert!(
                        (slope - expected).abs() < 1e-11,
                        "degree {degree}, {n} nodes, u = {u}: slope {slope}"
                    );
                }
            }
        }
    }

    #[test]
    fn beyond_its_nodes_it_is_the_polynomial_of_the_end_and_at_nan_it_is_nan() {
        for n in [1, 4, 12, 20] {
            let nodes = nodes(n);
            let basis = Basis::new(&nodes, 9);
            let order = 9.min(n - 1) as i32;
            let mut coefficients: Vec<f64> = nodes.iter().map(|x| (x - 0.4).powi(order)).collect();
            coefficients.push(7.0);
            basis.interpolate(&mut coefficients, 1);
            assert_eq!(coefficients[n], 7.0, "it is after the last row");
            for u in [nodes[0] - 0.1, nodes[n - 1] + 0.1] {
                let weights = basis.weights(u);
                let value = evaluate(&weights, &weights.values, &coefficients);
                assert!(
                    (value - (u - 0.4).powi(order)).abs() < 1e-9,
                    "{n} nodes, u = {u}: {value}"
                );
            }
            let weights = basis.weights(f64::NAN);
            assert!(n == 1 || evaluate(&weights, &weights.values, &coefficients).is_nan());
            for u in [f64::INFINITY, f64::NEG_INFINITY] {
                assert!(basis.weights(u).first + basis.weights(u).count <= n);
            }
        }
    }

    #[test]
    fn goes_through_the_values_at_its_nodes_and_converges_with_its_order() {
        for (degree, order) in [(3, 4), (5, 6), (9, 10)] {
            let error = |n: usize| {
                let nodes: Vec<f64> = (0..n).map(|i| i as f64 / (n - 1) as f64).collect();
                let basis = Basis::new(&nodes, degree);
                let mut coefficients: Vec<f64> = nodes.iter().map(|x| (12.0 * x).sin()).collect();
                basis.interpolate(&mut coefficients, 1);
                let error = |u: f64| {
                    let weights = basis.weights(u);
                    (evaluate(&weights, &weights.values, &coefficients) - (12.0 * u).sin()).abs()
                };
                assert!(nodes.iter().all(|&u| error(u) < 8e-15));
                (0..=997)
                    .map(|i| error(f64::from(i) / 997.0))
                    .fold(0.0, f64::max)
            };
            let measured = (error(30) / error(59)).log2();
            assert!(
                (measured - f64::from(order)).abs() < 0.5,
                "degree {degree}: order {measured}"
            );
        }
    }
}
