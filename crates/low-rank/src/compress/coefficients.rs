//! The coefficients of functions, given at nodes, in the polynomials of a box.
//!
//! The splines through all nodes are evaluated at Chebyshev points of the box, and the values at these
//! points become coefficients. The splines reach over the whole axis: next to an end of the box inside
//! it they are as accurate as elsewhere.

use faer::{Mat, MatRef};

use super::matrices::{larger, row_major, singular_vectors};
use crate::chebyshev::{points, transform};
use piecewise::bspline::Basis;

/// The first number of points for each node of a box, and the number of further ones.
const POINTS: [f64; 2] = [1.25, 12.0];
/// The largest number of points for each node. Splines of degree 9 have coefficients that fall as
/// the tenth power of the degree at last.
const MOST_POINTS: f64 = 8.0;
/// The largest coefficient of the last quarter of the degrees, relative to the allowed error.
const CONVERGED: f64 = 0.01;
/// The part left out of the coefficients along an axis, relative to the allowed error. It does not
/// show beside what the truncation of the train leaves out.
const LEFT_OUT: f64 = 2e-4;

/// The axis of a variable: all nodes, and those of the box.
#[derive(Clone, Debug)]
pub struct Axis {
    /// The coordinates of all nodes.
    pub coordinates: Vec<f64>,
    /// The first and the last node of the box.
    pub nodes: [usize; 2],
    /// The degree from which the factors of the polynomials fall, positive.
    pub smooth_degree: f64,
}

/// Coefficients as a sum over functions along each axis: `sum core[f1,f2,...] g1[f1] g2[f2] ...`.
pub(super) struct Coefficients {
    /// For each axis, the coefficients of orthonormal functions: a column for each.
    pub functions: Vec<Mat<f64>>,
    /// The core, row-major over the functions of the axes, then the compressed functions.
    pub core: Vec<f64>,
}

impl Axis {
    /// Returns the coordinates of the ends of the box.
    pub(super) fn ends(&self) -> [f64; 2] {
        self.nodes.map(|node| self.coordinates[node])
    }

    /// Returns the matrix from the values at the nodes of the axis to `count` coefficients in the
    /// box.
    fn matrix(&self, count: usize) -> Mat<f64> {
        let nodes = self.coordinates.len();
        let basis = Basis::of_table(&self.coordinates);
        // The spline through 1 at a node and 0 at the others, for each node.
        let mut splines = vec![0.0; nodes * nodes];
        splines
            .iter_mut()
            .step_by(nodes + 1)
            .for_each(|one| *one = 1.0);
        basis.interpolate(&mut splines, nodes);
        let mut values: Mat<f64> = Mat::zeros(count, nodes);
        for (i, u) in points(count, self.ends()).into_iter().enumerate() {
            let weights = basis.weights(u);
            for (k, weight) in weights.values[..weights.count].iter().enumerate() {
                let row = &splines[(weights.first + k) * nodes..][..nodes];
                for (node, value) in row.iter().enumerate() {
                    values[(i, node)] += weight * value;
                }
            }
        }
        let transform = transform(self.smooth_degree, count);
        Mat::from_fn(count, count, |k, i| transform[k][i]) * values
    }

    /// Returns the coefficients of the rows of a matrix of values at the nodes, as many as `error`
    /// needs.
    fn expand(&self, values: MatRef<'_, f64>, error: f64) -> Mat<f64> {
        let [first, last] = self.nodes;
        if self.coordinates.len() == 1 {
            return values.to_owned();
        }
        let nodes = (last - first + 1) as f64;
        let mut count = POINTS[0].mul_add(nodes, POINTS[1]) as usize;
        loop {
            let coefficients = self.matrix(count) * values;
            let tail = coefficients.subrows(3 * count / 4, count - 3 * count / 4);
            let largest = row_major(tail).map(f64::abs).fold(0.0, larger);
            // Not `>`: NaN must end the loop.
            let goes_on = largest > CONVERGED * error && (count as f64) < MOST_POINTS * nodes;
            if !goes_on {
                return coefficients;
            }
            count *= 2;
        }
    }
}

impl Coefficients {
    /// Expands the `values` at the nodes of the `axes`, row-major over them and then the `count`
    /// functions, accurate enough for `error`.
    pub fn new(axes: &[Axis], count: usize, values: &[f64], error: f64) -> Self {
        let mut tensor = values.to_vec();
        let mut functions = Vec::with_capacity(axes.len());
        for (i, axis) in axes.iter().enumerate() {
            // The axis comes first and goes last: after all of them, the order is that of `values`.
            let nodes = axis.coordinates.len();
            let width = tensor.len() / nodes;
            let unfolding = MatRef::from_row_major_slice(&tensor, nodes, width);
            let coefficients = axis.expand(unfolding, error);
            // A sum of squares over all other nodes and functions, as a mean.
            let others: usize = axes[i + 1..]
                .iter()
                .map(|axis| axis.coordinates.len())
                .product();
            let scale = ((others * count) as f64).sqrt();
            let (vectors, _) = singular_vectors(coefficients.as_ref(), LEFT_OUT * error * scale);
            let projected = coefficients.transpose() * &vectors;
            // A row for each place on the other axes, a column for each function.
            tensor = row_major(projected.as_ref()).collect();
            functions.push(vectors);
        }
        // The functions, last at first, have come first.
        let places = tensor.len() / count;
        let core = (0..places * count)
            .map(|i| tensor[i % count * places + i / count])
            .collect();
        Self { functions, core }
    }
}
