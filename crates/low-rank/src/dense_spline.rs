//! The tensor spline through values on a grid that are held in full: from three of its variables to the
//! coefficients of splines of the functions along the fourth, as those of a [`PreparedTrain`].
//!
//! [`PreparedTrain`]: crate::PreparedTrain

use std::array;

use piecewise::bspline::{Basis, LARGEST_DEGREE, Weights};

use crate::vectors::{Vectors, WeightedSum};
use crate::weighted_sum::add_rows;

/// The tensor B-spline of functions of the variables 0 to 3.
#[derive(Clone, Debug)]
pub struct DenseSpline {
    /// The B-splines of the variables 1, 2 and 3.
    bases: [Basis; 3],
    /// A row for each combination of these B-splines, those of variable 1 slowest: a group of the
    /// functions for each B-spline of variable 0.
    rows: Vec<f64>,
}

impl DenseSpline {
    /// Makes the spline through `values` at the nodes, which become the coefficients in place. `bases`
    /// are those of the variables 1, 2 and 3, and `first` is that of variable 0.
    ///
    /// The values are row-major over the variables 1, 2, 3 and 0 and the functions: the coefficients at
    /// one place are then a sum of whole rows.
    ///
    /// # Panics
    /// If the values are not as many for each combination of the nodes.
    pub fn through(bases: [Basis; 3], first: &Basis, mut values: Vec<f64>) -> Self {
        let [n1, n2, n3] = bases.each_ref().map(Basis::count);
        let width = values.len() / (n1 * n2 * n3);
        assert_eq!(values.len(), n1 * n2 * n3 * width, "values for each node");
        bases[0].interpolate(&mut values, n2 * n3 * width);
        for slab in values.chunks_exact_mut(n2 * n3 * width) {
            bases[1].interpolate(slab, n3 * width);
            slab.chunks_exact_mut(n3 * width)
                .for_each(|slab| bases[2].interpolate(slab, width));
        }
        values
            .chunks_exact_mut(width)
            .for_each(|row| first.interpolate(row, width / first.count()));
        Self {
            bases,
            rows: values,
        }
    }

    /// Returns the coefficients of the splines of the functions at these values of the variables 1, 2
    /// and 3: a group of the functions for each B-spline.
    pub fn coefficients(&self, coordinates: [f64; 3]) -> Vec<f64> {
        let [value, ..] = self.coefficients_and_slopes(coordinates, [false; 3]);
        value
    }

    /// Returns these coefficients, followed by their derivatives with respect to the three
    /// coordinates; those that are not `wanted` are empty.
    pub fn coefficients_and_slopes(
        &self,
        coordinates: [f64; 3],
        wanted: [bool; 3],
    ) -> [Vec<f64>; 4] {
        let weights = self.weights(coordinates);
        let [n1, n2, n3] = self.bases.each_ref().map(Basis::count);
        let width = self.rows.len() / (n1 * n2 * n3);
        let [first, second, third] = &weights;
        // The axis with respect to which each sum is a derivative.
        let sums = [None, Some(0), Some(1), Some(2)];
        let is_wanted = |by: Option<usize>| by.is_none_or(|axis| wanted[axis]);
        let mut all = sums.map(|by| vec![0.0; if is_wanted(by) { width } else { 0 }]);
        // Each row is read once for all sums.
        for (i, j) in (0..first.count).flat_map(|i| (0..second.count).map(move |j| (i, j))) {
            let row = ((first.first + i) * n2 + second.first + j) * n3 + third.first;
            let rows = &self.rows[row * width..];
            for (sum, by) in all.iter_mut().zip(sums).filter(|(_, by)| is_wanted(*by)) {
                let [of_first, of_second, of_third] = array::from_fn(|axis| {
                    if by == Some(axis) {
                        &weights[axis].slopes
                    } else {
                        &weights[axis].values
                    }
                });
                let row_weights: [f64; LARGEST_DEGREE + 1] =
                    array::from_fn(|k| of_first[i] * of_second[j] * of_third[k]);
                add_rows(sum, &row_weights[..third.count], rows, width);
            }
        }
        all
    }

    /// Replaces the columns of `coefficients` that `sums` name by weighted sums of the coefficients
    /// at coordinates that differ in one of the three, the number `axis`, which has the values `places`.
    pub fn sums_along(
        &self,
        mut coordinates: [f64; 3],
        axis: usize,
        places: &[f64],
        sums: &[WeightedSum<'_>],
        coefficients: &mut [f64],
    ) {
        let mut at_places = Vectors::zeros(places.len(), coefficients.len());
        for (i, &place) in places.iter().enumerate() {
            coordinates[axis] = place;
            let own = self.coefficients(coordinates);
            at_places.get_mut(i).copy_from_slice(&own);
        }
        for sum in sums {
            for column in sum.columns.clone() {
                let term = |&(place, weight): &(usize, f64)| weight * at_places.get(place)[column];
                coefficients[column] = sum.weights.iter().map(term).sum();
            }
        }
    }

    /// Evaluates the B-splines of the variables 1, 2 and 3.
    fn weights(&self, coordinates: [f64; 3]) -> [Weights; 3] {
        array::from_fn(|axis| self.bases[axis].weights(coordinates[axis]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two functions that splines through so many nodes reproduce.
    fn functions([y, u, v, w]: [f64; 4]) -> [f64; 2] {
        [1.0 + y * u * u - v * w, (y - v).powi(2) * w]
    }

    /// Their derivatives with respect to `u`, `v` and `w`.
    fn slopes([y, u, v, w]: [f64; 4]) -> [[f64; 2]; 3] {
        [
            [2.0 * y * u, 0.0],
            [-w, -2.0 * (y - v) * w],
            [-v, (y - v).powi(2)],
        ]
    }

    fn nodes(count: u32) -> Vec<f64> {
        (0..count)
            .map(|i| f64::from(i) / f64::from(count - 1))
            .collect()
    }

    #[test]
    fn it_is_the_polynomial_through_the_nodes_with_its_slopes_and_sums() {
        let [y, u, v, w] = [nodes(4), nodes(5), nodes(3), nodes(6)];
        let mut values = Vec::new();
        for &u in &u {
            for &v in &v {
                for &w in &w {
                    values.extend(y.iter().flat_map(|&y| functions([y, u, v, w])));
                }
            }
        }
        let basis = |nodes: &Vec<f64>| Basis::new(nodes, 3);
        let first = basis(&y);
        let spline = DenseSpline::through([basis(&u), basis(&v), basis(&w)], &first, values);
        let at = |coefficients: &[f64], y: f64| -> [f64; 2] {
            let weights = first.weights(y);
            let groups = coefficients.as_chunks::<2>().0[weights.first..].iter();
            let terms = groups.zip(&weights.values[..weights.count]);
            terms.fold([0.0; 2], |[a, b], ([of_a, of_b], weight)| {
                [a + weight * of_a, b + weight * of_b]
            })
        };
        let close = |found: [f64; 2], expected: [f64; 2]| {
            let pairs = found.into_iter().zip(expected);
            for (found, expected) in pairs {
                assert!((found - expected).abs() < 1e-13, "{found}, not {expected}");
            }
        };
        for i in 0..50 {
            let [y, u, v, w] = [0.618, 0.414, 0.732, 0.236].map(|step| f64::from(i) * step % 1.0);
            let [value, by @ ..] = spline.coefficients_and_slopes([u, v, w], [true; 3]);
            assert_eq!(value, spline.coefficients([u, v, w]));
            close(at(&value, y), functions([y, u, v, w]));
            for (by, expected) in by.iter().zip(slopes([y, u, v, w])) {
                close(at(by, y), expected);
            }
            let mut sums = value.clone();
            let sum = WeightedSum {
                weights: &[(1, 2.0), (0, -0.5)],
                columns: 0..value.len(),
            };
            spline.sums_along([u, v, w], 1, &[0.1, 0.9], &[sum], &mut sums);
            let [low, high] = [0.1, 0.9].map(|v| functions([y, u, v, w]));
            close(at(&sums, y), [0, 1].map(|i| 2.0 * high[i] - 0.5 * low[i]));
        }
    }
}
