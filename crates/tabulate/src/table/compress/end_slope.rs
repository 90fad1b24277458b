//! The derivatives of a table with respect to `nu1` at incompressible films, from the values at its
//! nodes.
//!
//! The splines through these values are [flat](Parameter::is_flat_at) at `nu1 = 0.5`. Their
//! derivative with respect to `nu1` there is a part of their third derivative with respect to the
//! coordinate. It divides errors of the values by the cube of the distance between nodes.

use interp::bspline::Basis;
use interp::{Parameter, Table};

use crate::solve::larger;

/// The smallest number of nodes of splines with a flat end.
const FLAT_FROM: usize = 5;

/// The linear map from values at the nodes to derivatives at `nu1 = 0.5`.
#[derive(Debug)]
pub struct EndSlope {
    /// The factor of the value at each node of `nu1`.
    of_nodes: Vec<f64>,
    /// For each `a_over_t` and quantity, the range of `nu1` on which incompressible films change,
    /// `1/(1 + (a/t)^2)`.
    ranges: Vec<f64>,
}

impl EndSlope {
    /// Returns the map of a table; none where its splines have no flat end in `nu1`.
    pub fn of(table: &Table) -> Option<Self> {
        let nodes = table.axis(Parameter::Nu1);
        let (count, last) = (nodes.len(), nodes[nodes.len() - 1]);
        if count < FLAT_FROM || !Parameter::Nu1.is_flat_at(last) {
            return None;
        }
        let coordinates: Vec<f64> = nodes
            .iter()
            .map(|&nu1| Parameter::Nu1.coordinate(nu1))
            .collect();
        let basis = Basis::of_table(&coordinates, true);
        // Row-major, the coefficients of the splines that are 1 at one node and 0 at the others.
        let mut splines: Vec<f64> = (0..count * count)
            .map(|i| f64::from(i / count == i % count))
            .collect();
        basis.interpolate(&mut splines, count);
        // At the end the product is 0 times infinity. So near to it, it has the value of the end.
        let near = Parameter::Nu1.coordinate(last) - 1e-6;
        let (weights, speed) = (basis.weights(near), Parameter::Nu1.speed(near));
        let mut of_nodes = vec![0.0; count];
        for (row, slope) in splines
            .chunks_exact(count)
            .skip(weights.first)
            .zip(&weights.slopes[..weights.count])
        {
            of_nodes
                .iter_mut()
                .zip(row)
                .for_each(|(sum, coefficient)| *sum += speed * slope * coefficient);
        }
        let range = |x: &f64| vec![1.0 / (1.0 + x * x); table.quantities().len()];
        Some(Self {
            of_nodes,
            ranges: table
                .axis(Parameter::AOverT)
                .iter()
                .flat_map(range)
                .collect(),
        })
    }

    /// Returns the largest derivative of `logarithms`, or of differences of logarithms, for one
    /// `e1_over_e2`, in the order of [`Table::logarithms`]: their change over the range of `nu1` on
    /// which incompressible films change.
    pub fn largest(&self, logarithms: &[f64]) -> f64 {
        let width = logarithms.len() / self.of_nodes.len();
        let mut slopes = vec![0.0; width];
        for (row, weight) in logarithms.chunks_exact(width).zip(&self.of_nodes) {
            slopes
                .iter_mut()
                .zip(row)
                .for_each(|(slope, logarithm)| *slope += weight * logarithm);
        }
        let changes = slopes
            .iter()
            .zip(self.ranges.iter().cycle())
            .map(|(slope, range)| (slope * range).abs());
        changes.fold(0.0, larger)
    }
}
