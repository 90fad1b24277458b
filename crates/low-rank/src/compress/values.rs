//! The values of a train on a grid of places.

use faer::MatRef;

use super::matrices::column_major;
use crate::IntegerTrain;
use crate::chebyshev::polynomials;

impl IntegerTrain {
    /// Returns the values at a grid of coordinates, row-major over those of the variables 1, 2, 3 and
    /// 0, and the functions.
    ///
    /// `ends` are the ends of the box, and `places` the coordinates of the grid: an entry for each
    /// variable, 0 to 3.
    pub fn values(&self, ends: [[f64; 2]; 4], places: [&[f64]; 4]) -> Vec<f64> {
        let (variables, bonds) = (self.variables(), self.weights());
        // Row-major over the places so far and the bond. A row here is a column of a matrix of `faer`.
        let mut vectors = vec![1.0];
        for (i, [before, terms, after]) in self.shapes().into_iter().enumerate() {
            let (variable, at) = (variables[i], places[variables[i]]);
            let degree = self.smooth_degrees()[variable];
            let of_place = |&place: &f64| polynomials(degree, terms, ends[variable], place);
            let polynomials: Vec<f64> = at.iter().flat_map(of_place).collect();
            let polynomials = MatRef::from_column_major_slice(&polynomials, terms, at.len());
            let integers: Vec<f64> = self.cores()[i].iter().map(|&n| n as f64).collect();
            // For each index of the bond before, a row over the next bond at each place.
            let mut core = Vec::with_capacity(before * at.len() * after);
            for (b, terms_of_index) in integers.chunks_exact(terms * after).enumerate() {
                let weight = if i == 0 { 1.0 } else { bonds[i - 1][b] };
                let sums =
                    MatRef::from_column_major_slice(terms_of_index, after, terms) * polynomials;
                core.extend(column_major(&sums).map(|sum| self.step() / weight * sum));
            }
            let core = MatRef::from_column_major_slice(&core, at.len() * after, before);
            let vectors_before =
                MatRef::from_column_major_slice(&vectors, before, vectors.len() / before);
            vectors = column_major(&(core * vectors_before)).collect();
        }
        // From the order of the cores to that of the variables.
        let counts = self.order().map(|variable| places[variable].len());
        let core = |variable: usize| {
            let core = self.order().iter().position(|&other| other == variable);
            1 + core.expect("the order holds each variable")
        };
        permuted(&vectors, &counts, [1, 2, 3].map(core))
    }
}

/// Returns a tensor of the axes 1, 2, 3 and the rest, with the first three in another order.
pub(super) fn permuted(tensor: &[f64], counts: &[usize], order: [usize; 3]) -> Vec<f64> {
    let width = tensor.len() / counts[..3].iter().product::<usize>();
    let strides = [counts[1] * counts[2], counts[2], 1];
    let [first, second, third] = order.map(|axis| (counts[axis - 1], strides[axis - 1]));
    let mut result = Vec::with_capacity(tensor.len());
    for i in 0..first.0 {
        for j in 0..second.0 {
            for k in 0..third.0 {
                let at = i * first.1 + j * second.1 + k * third.1;
                result.extend_from_slice(&tensor[at * width..][..width]);
            }
        }
    }
    result
}
