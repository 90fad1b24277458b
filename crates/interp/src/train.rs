//! A tensor train prepared for lookup: from its splines at a material to those over `ln(a/t)`.

use crate::low_rank::{LowRank, add_rows};
use crate::spline::{Basis, Weights};

/// The cores of a [`LowRank`] form, as coefficients of splines.
#[derive(Clone, Debug)]
pub(crate) struct Train {
    /// Of `e0_over_e2`, `e1_over_e2` and `nu1`.
    carriages: [Carriage; 3],
    /// A row for each value of the last index: coefficients over `ln(a/t)`, all quantities of one after those of the other.
    last: Vec<f64>,
}

/// A core, row-major over the index before, the splines, and the index after.
#[derive(Clone, Debug)]
struct Carriage {
    coefficients: Vec<f64>,
    /// How many splines there are.
    splines: usize,
    /// How many values the index after it has.
    after: usize,
}

impl Train {
    /// With the bases of `e1_over_e2`, `nu1`, `e0_over_e2`, and of `a_over_t`.
    pub(crate) fn new(form: &LowRank, [e1, nu, e0]: [&Basis; 3], along: &Basis) -> Self {
        let ranks = form.ranks();
        let [substrate, film_modulus, film, mut last] = form.cores();
        let carriage = |mut coefficients: Vec<f64>, basis: &Basis, after: usize| {
            let splines = basis.len();
            coefficients.chunks_exact_mut(splines * after).for_each(|slab| basis.interpolate(slab, after));
            Carriage { coefficients, splines, after }
        };
        let held = form.quantities().len();
        last.chunks_exact_mut(along.len() * held).for_each(|row| along.interpolate(row, held));
        let carriages = [carriage(substrate, e0, ranks[0]), carriage(film_modulus, e1, ranks[1]), carriage(film, nu, ranks[2])];
        Self { carriages, last }
    }

    /// The coefficients over `ln(a/t)` at a material, from the splines of `e1_over_e2`, `nu1` and `e0_over_e2` there.
    pub(crate) fn at(&self, [e1, nu, e0]: &[Weights; 3]) -> Vec<f64> {
        let mut vector = vec![1.0];
        for (carriage, weights) in self.carriages.iter().zip([e0, e1, nu]) {
            let splines = carriage.splines_at(&vector, weights);
            vector = sum_rows(&weights.values[..weights.count], &splines);
        }
        sum_rows(&vector, &self.last)
    }

    /// The same, followed by the derivatives with respect to the three coordinates.
    pub(crate) fn with_slopes(&self, [e1, nu, e0]: &[Weights; 3]) -> [Vec<f64>; 4] {
        // The vector, and its derivatives with respect to what is behind.
        let mut vectors = vec![vec![1.0]];
        for (carriage, weights) in self.carriages.iter().zip([e0, e1, nu]) {
            let splines: Vec<Vec<f64>> = vectors.iter().map(|vector| carriage.splines_at(vector, weights)).collect();
            vectors = splines.iter().map(|splines| sum_rows(&weights.values[..weights.count], splines)).collect();
            vectors.push(sum_rows(&weights.slopes[..weights.count], &splines[0]));
        }
        [0, 2, 3, 1].map(|i| sum_rows(&vectors[i], &self.last))
    }
}

impl Carriage {
    /// The product with a vector, for each spline that does not vanish.
    fn splines_at(&self, vector: &[f64], weights: &Weights) -> Vec<f64> {
        let mut sum = vec![0.0; weights.count * self.after];
        add_rows(&mut sum, vector, &self.coefficients[weights.first * self.after..], self.splines * self.after);
        sum
    }
}

/// The weighted sum of rows of equal length, as many as there are weights.
fn sum_rows(weights: &[f64], rows: &[f64]) -> Vec<f64> {
    let length = rows.len() / weights.len();
    let mut sum = vec![0.0; length];
    add_rows(&mut sum, weights, rows, length);
    sum
}
