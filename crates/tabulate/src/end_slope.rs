//! The derivative with respect to `nu1` of incompressible films, as values at one more node of `nu1`.
//!
//! Splines through a table's nodes are [flat](Parameter::is_flat_at) at `nu1 = 0.5`, and their derivative with respect to `nu1` is a
//! part of their third derivative with respect to the coordinate: it divides errors of the values by the cube of the distance
//! between nodes. What is to keep derivatives small in error has to look at them.

use interp::Table;
use interp::schema::Parameter;
use interp::spline::Basis;

use crate::Error;

/// The fewest nodes that splines take to be flat at their end.
const FLAT_FROM: usize = 5;

/// What makes the derivatives at `nu1 = 0.5` of values at the nodes, in units of the range of `nu1` on which incompressible films
/// change, `1/(1 + (a/t)^2)`, and weighed beside the values.
#[derive(Debug)]
pub struct EndSlope {
    /// What the value at each node of `nu1` is multiplied with.
    of_nodes: Vec<f64>,
    /// The weight times the unit, for each `a_over_t` and quantity.
    units: Vec<f64>,
}

impl EndSlope {
    /// With a weight, which says how much an error of a derivative counts beside one of a value.
    ///
    /// # Errors
    /// [`Error::NoIncompressibleEnd`] where the splines have no flat end.
    pub fn of(table: &Table, weight: f64) -> Result<Self, Error> {
        let nodes = table.axis(Parameter::Nu1);
        let (count, last) = (nodes.len(), nodes[nodes.len() - 1]);
        if count < FLAT_FROM || !Parameter::Nu1.is_flat_at(last) {
            return Err(Error::NoIncompressibleEnd { least: FLAT_FROM, nodes: count, last });
        }
        let coordinates: Vec<f64> = nodes.iter().map(|&nu1| Parameter::Nu1.coordinate(nu1)).collect();
        let basis = Basis::of_table(&coordinates, true);
        // Row-major, the coefficients of the splines that are 1 at one node and 0 at the others.
        let mut splines: Vec<f64> = (0..count * count).map(|i| f64::from(i / count == i % count)).collect();
        basis.interpolate(&mut splines, count);
        // At the end it is 0 times infinity, and this near it is the same.
        let near = Parameter::Nu1.coordinate(last) - 1e-6;
        let (splines_there, speed) = (basis.weights(near), Parameter::Nu1.speed(near));
        let rows = splines.chunks_exact(count).skip(splines_there.first);
        let mut of_nodes = vec![0.0; count];
        for (row, slope) in rows.zip(&splines_there.slopes[..splines_there.count]) {
            of_nodes.iter_mut().zip(row).for_each(|(sum, coefficient)| *sum += speed * slope * coefficient);
        }
        let of_each = |x: &f64| vec![weight / (1.0 + x * x); table.quantities().len()];
        let units = table.axis(Parameter::AOverT).iter().flat_map(of_each).collect();
        Ok(Self { of_nodes, units })
    }

    /// Appends the derivatives to the logarithms of a table for one `e1_over_e2`, as [`Table::logarithms`] orders them, as though
    /// they belonged to one more `nu1`.
    pub fn append(&self, logarithms: &mut Vec<f64>) {
        let width = logarithms.len() / self.of_nodes.len();
        let mut slopes = vec![0.0; width];
        for (row, weight) in logarithms.chunks_exact(width).zip(&self.of_nodes) {
            slopes.iter_mut().zip(row).for_each(|(slope, logarithm)| *slope += weight * logarithm);
        }
        slopes.iter_mut().zip(self.units.iter().cycle()).for_each(|(slope, unit)| *slope *= unit);
        logarithms.append(&mut slopes);
    }
}
