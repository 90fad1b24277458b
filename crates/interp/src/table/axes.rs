//! The axes of a table: the nodes of each parameter, and the coordinates of a material between
//! them.

use std::cmp::Ordering;

use crate::curve::bspline::Basis;
use crate::curve::nodes::{REASONABLE, too_close};
use crate::material::{ROUNDING, poisson_ratio};
use crate::{Error, Material, Parameter};

/// The parameters of a material in a table, in the order of [`Parameter::ALL`].
pub(crate) const MATERIAL: [Parameter; 3] =
    [Parameter::E1OverE2, Parameter::Nu1, Parameter::E0OverE2];

/// The nodes of each parameter, ascending, in the order of [`Parameter::ALL`].
///
/// A fixed parameter has one node.
#[derive(Clone, Debug)]
pub(crate) struct Axes([Vec<f64>; 4]);

impl Axes {
    /// Accepts nodes that splines can interpolate.
    ///
    /// # Errors
    /// [`Error::Malformed`] for an axis that is empty, does not ascend, holds a value outside
    /// physics, or has two nodes too close for a spline.
    pub(crate) fn new(nodes: [Vec<f64>; 4]) -> Result<Self, Error> {
        for (parameter, nodes) in Parameter::ALL.into_iter().zip(&nodes) {
            check(parameter, nodes)?;
        }
        Ok(Self(nodes))
    }

    /// Returns the nodes of a parameter.
    pub(crate) fn nodes(&self, parameter: Parameter) -> &[f64] {
        &self.0[parameter as usize]
    }

    /// Returns the nodes of all parameters.
    pub(crate) fn all(&self) -> &[Vec<f64>; 4] {
        &self.0
    }

    /// Returns the number of nodes on each axis.
    pub(crate) fn shape(&self) -> [usize; 4] {
        self.0.each_ref().map(Vec::len)
    }

    /// Returns the first and the last node of a parameter.
    pub(crate) fn ends(&self, parameter: Parameter) -> [f64; 2] {
        let nodes = self.nodes(parameter);
        [nodes[0], nodes[nodes.len() - 1]]
    }

    /// Makes the B-splines of a parameter, over its [coordinate](Parameter::coordinate).
    pub(crate) fn basis(&self, parameter: Parameter) -> Basis {
        let coordinates: Vec<f64> = self
            .nodes(parameter)
            .iter()
            .map(|&value| parameter.coordinate(value))
            .collect();
        Basis::of_table(&coordinates, parameter.is_flat_at(self.ends(parameter)[1]))
    }

    /// Returns the coordinates of a material, in the order of [`MATERIAL`].
    ///
    /// # Errors
    /// [`Error::OutsideTable`] if it is outside the box.
    pub(crate) fn locate(&self, material: &Material) -> Result<[f64; 3], Error> {
        let e1 = self.coordinate(Parameter::E1OverE2, material.e1_over_e2())?;
        let nu1 = self.coordinate(Parameter::Nu1, material.nu1())?;
        let e0 = self.coordinate(Parameter::E0OverE2, material.e0_over_e2())?;
        Ok([e1, nu1, e0])
    }

    /// Returns the coordinate of a value, which may be beyond an end by rounding.
    fn coordinate(&self, parameter: Parameter, value: f64) -> Result<f64, Error> {
        let [from, to] = self.ends(parameter);
        let size = |end: f64| {
            if parameter == Parameter::Nu1 {
                1.0
            } else {
                end.abs()
            }
        };
        let near = |end: f64| end.is_finite() && (value - end).abs() <= ROUNDING * size(end);
        if value >= from && value <= to {
            Ok(parameter.coordinate(value))
        } else if near(from) {
            Ok(parameter.coordinate(from))
        } else if near(to) {
            Ok(parameter.coordinate(to))
        } else {
            Err(Error::OutsideTable {
                axis: parameter.name(),
                value,
                from,
                to,
            })
        }
    }

    /// Returns the sphere-film modulus `es` at node `e1` of `e1_over_e2` and node `nu` of `nu1`.
    pub(crate) fn sphere_film_modulus(&self, e1: usize, nu: usize) -> f64 {
        let (e1, nu1) = (
            self.nodes(Parameter::E1OverE2)[e1],
            self.nodes(Parameter::Nu1)[nu],
        );
        // `es` does not depend on the substrate.
        let material = Material::new(e1, nu1, f64::INFINITY, 0.0).expect("the nodes were checked");
        material.sphere_film_modulus()
    }
}

/// Accepts the nodes of one parameter.
fn check(parameter: Parameter, nodes: &[f64]) -> Result<(), Error> {
    let malformed = |what: String| Err(Error::Malformed(what));
    let name = parameter.name();
    if nodes.is_empty() {
        return malformed(format!(
            "axis {name} is empty, it must have a node at least"
        ));
    }
    if let Some(pair) = nodes
        .windows(2)
        .find(|pair| pair[0].partial_cmp(&pair[1]) != Some(Ordering::Less))
    {
        return malformed(format!(
            "axis {name} is not ascending: {:?} is followed by {:?}",
            pair[0], pair[1]
        ));
    }
    let physical = |&node: &f64| match parameter {
        Parameter::Nu1 => poisson_ratio(name, node).is_ok(),
        Parameter::AOverT => REASONABLE.contains(&node),
        // A rigid sphere or substrate must be the only node of its axis.
        Parameter::E1OverE2 => REASONABLE.contains(&node) || (node == 0.0 && nodes.len() == 1),
        Parameter::E0OverE2 => {
            REASONABLE.contains(&node) || (node == f64::INFINITY && nodes.len() == 1)
        }
    };
    if let Some(node) = nodes.iter().find(|node| !physical(node)) {
        let allowed = match parameter {
            Parameter::AOverT => "in [1e-30, 1e30]",
            Parameter::E1OverE2 => "in [1e-30, 1e30], or 0 as the only node",
            Parameter::Nu1 => "in (-1, 0.5]",
            Parameter::E0OverE2 => "in [1e-30, 1e30], or inf as the only node",
        };
        return malformed(format!(
            "axis {name} holds {node:?}, its nodes must be {allowed}"
        ));
    }
    if let Some([low, high]) = too_close(parameter, nodes) {
        return malformed(format!(
            "axis {name} has nodes too close to each other, {low:?} and {high:?}: at least 1e-9 \
             and 1e-7 of the axis must be between them in the coordinate of the spline"
        ));
    }
    Ok(())
}
