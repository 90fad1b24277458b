//! The derivative with respect to `nu1` of incompressible films, made of the values at a table's
//! nodes.
//!
//! Splines through them are [flat](Parameter::is_flat_at) at `nu1 = 0.5`, and their derivative with
//! respect to `nu1` is a part of their third derivative with respect to the coordinate: it divides
//! errors of the values by the cube of the distance between nodes.

use interp::Parameter;
use interp::Table;
use interp::bspline::Basis;

use crate::Error;

/// The fewest nodes that splines take to be flat at their end.
const FLAT_FROM: usize = 5;

/// What makes the derivatives at `nu1 = 0.5` of values at the nodes.
#[derive(Debug)]
pub struct EndSlope {
    /// What the value at each node of `nu1` is multiplied with.
    of_nodes: Vec<f64>,
    /// For each `a_over_t` and quantity, the range of `nu1` on which incompressible films change,
    /// `1/(1 + (a/t)^2)`.
    ranges: Vec<f64>,
}

impl EndSlope {
    /// # Errors
    /// [`Error::NoIncompressibleEnd`] where the splines have no flat end.
    pub fn of(table: &Table) -> Result<Self, Error> {
        let nodes = table.axis(Parameter::Nu1);
        let (count, last) = (nodes.len(), nodes[nodes.len() - 1]);
        if count < FLAT_FROM || !Parameter::Nu1.is_flat_at(last) {
            return Err(Error::NoIncompressibleEnd {
                least: FLAT_FROM,
                nodes: count,
                last,
            });
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
        // At the end it is 0 times infinity, and this near it is the same.
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
        Ok(Self {
            of_nodes,
            ranges: table
                .axis(Parameter::AOverT)
                .iter()
                .flat_map(range)
                .collect(),
        })
    }

    /// The largest derivative of logarithms, or of differences of them, for one `e1_over_e2`, in
    /// the order of [`Table::logarithms`]: how much they change over the range of `nu1` on which
    /// incompressible films change.
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
        changes.fold(0.0, f64::max)
    }
}
