//! The axes of a table: the nodes of each parameter, and the coordinates of a material between
//! them.

use std::cmp::Ordering;

use piecewise::bspline::Basis;

use crate::curve::nodes::{REASONABLE, too_close};
use crate::material::equivalence::Invariants;
use crate::material::{ROUNDING, poisson_ratio};
use crate::{Error, Material, Normalisation, Parameter};

/// The parameters of a table and the nodes of each, ascending.
///
/// A fixed parameter has one node.
#[derive(Clone, Debug)]
pub(crate) struct Axes {
    parameters: [Parameter; 4],
    nodes: [Vec<f64>; 4],
}

impl Axes {
    /// Accepts nodes that splines can interpolate.
    ///
    /// # Errors
    /// [`Error::Malformed`] for parameters that are none of [`Parameter::ALL`],
    /// [`Parameter::REDUCED`] and [`Parameter::STACK`], or an axis that is empty, does not ascend,
    /// holds a value outside physics, or has two nodes too close for a spline.
    pub(crate) fn new(axes: [(Parameter, Vec<f64>); 4]) -> Result<Self, Error> {
        let parameters = axes.each_ref().map(|(parameter, _)| *parameter);
        if ![Parameter::ALL, Parameter::REDUCED, Parameter::STACK].contains(&parameters) {
            let names = |parameters: [Parameter; 4]| parameters.map(Parameter::name).join(", ");
            return Err(Error::Malformed(format!(
                "its axes are {}; they must be {}, {} or {}",
                names(parameters),
                names(Parameter::ALL),
                names(Parameter::REDUCED),
                names(Parameter::STACK)
            )));
        }
        for (parameter, nodes) in &axes {
            check(*parameter, nodes)?;
        }
        if let [_, _, (_, nu1), (Parameter::E0OverE1, _)] = &axes
            && nu1.len() > 1
        {
            return Err(Error::Malformed(format!(
                "axis nu1 has {} nodes, it must have 1 in a table of one stack of layers",
                nu1.len()
            )));
        }
        Ok(Self {
            parameters,
            nodes: axes.map(|(_, nodes)| nodes),
        })
    }

    /// Returns the parameters, one for each dimension.
    pub(crate) fn parameters(&self) -> [Parameter; 4] {
        self.parameters
    }

    /// Returns the parameters of a material.
    pub(crate) fn of_material(&self) -> [Parameter; 3] {
        let [_, film, nu1, substrate] = self.parameters;
        [film, nu1, substrate]
    }

    /// Returns the nodes of a parameter; none for a parameter that is no axis.
    pub(crate) fn nodes(&self, parameter: Parameter) -> &[f64] {
        let dimension = parameter.dimension();
        if self.parameters[dimension] == parameter {
            &self.nodes[dimension]
        } else {
            &[]
        }
    }

    /// Returns the parameters with their nodes.
    pub(crate) fn all(&self) -> [(Parameter, Vec<f64>); 4] {
        self.parameters
            .map(|parameter| (parameter, self.nodes(parameter).to_vec()))
    }

    /// Returns the number of nodes on each axis.
    pub(crate) fn shape(&self) -> [usize; 4] {
        self.nodes.each_ref().map(Vec::len)
    }

    /// Returns the first and the last node of a parameter of these axes.
    pub(crate) fn ends(&self, parameter: Parameter) -> [f64; 2] {
        let nodes = self.nodes(parameter);
        [nodes[0], nodes[nodes.len() - 1]]
    }

    /// Returns whether a single number is the only node of a parameter, such that the table does
    /// not know the derivative with respect to it. At a limit, a rigid sphere or substrate, the
    /// derivative is 0.
    pub(crate) fn fixes(&self, parameter: Parameter) -> bool {
        let [from, to] = self.ends(parameter);
        let is_limit = from == f64::INFINITY || from == 0.0 && parameter != Parameter::Nu1;
        from == to && !is_limit
    }

    /// Makes the B-splines of a parameter, over its [coordinate](Parameter::coordinate).
    pub(crate) fn basis(&self, parameter: Parameter) -> Basis {
        let coordinates: Vec<f64> = self
            .nodes(parameter)
            .iter()
            .map(|&value| parameter.coordinate(value))
            .collect();
        Basis::of_table(&coordinates)
    }

    /// Returns the symbol of the modulus in whose units the quantities at the nodes are.
    pub(crate) fn unit(&self) -> &'static str {
        let [film, ..] = self.of_material();
        match film {
            Parameter::E1OverE2 if self.ends(film)[0] == 0.0 => Normalisation::Film.symbol(),
            Parameter::E1OverE2 => Normalisation::Sphere.symbol(),
            _ => "Es*",
        }
    }

    /// Returns the coordinates of a material, on a substrate with the table's Poisson ratio, along
    /// the axes of [`Self::of_material`].
    ///
    /// # Errors
    /// [`Error::Normalisation`] for a rigid sphere in a table of `e1_over_e2` for compliant
    /// spheres, or the reverse; [`Error::OutsideTable`] if it is outside the box.
    pub(crate) fn locate(&self, material: &Material) -> Result<[f64; 3], Error> {
        let [film, nu1, substrate] = self.of_material();
        let [film_value, substrate_value] = if film == Parameter::E1OverE2 {
            let (table, query) = (self.unit(), material.normalisation().symbol());
            if table != query {
                return Err(Error::Normalisation { table, query });
            }
            [material.e1_over_e2(), material.e0_over_e2()]
        } else {
            let invariants = Invariants::of(material);
            [invariants.e1s_over_einfs(), invariants.e0s_over_e2s()]
        };
        Ok([
            self.coordinate(film, film_value)?,
            self.coordinate(nu1, material.nu1())?,
            self.coordinate(substrate, substrate_value)?,
        ])
    }

    /// Returns whether these are the axes of a table of one stack of layers.
    pub(crate) fn are_of_stack(&self) -> bool {
        self.parameters == Parameter::STACK
    }

    /// Returns the coordinates of a stack of layers under a sphere, along the axes of
    /// [`Self::of_material`], and the material of its top layer and base, with `nu0` of the base.
    /// The axes are those of a stack.
    ///
    /// # Errors
    /// [`Error::Unphysical`]; [`Error::Normalisation`] and [`Error::OutsideTable`] as
    /// [`Self::locate`].
    pub(crate) fn locate_sphere(
        &self,
        e1_over_e2: f64,
        nu0: f64,
    ) -> Result<(Material, [f64; 3]), Error> {
        let [film, nu1, base] = self.of_material();
        let [nu1_value, ratio] = [nu1, base].map(|parameter| self.ends(parameter)[0]);
        // Under a rigid sphere a material holds `E0/E1` itself.
        let base_value = if e1_over_e2 == 0.0 {
            ratio
        } else {
            ratio * e1_over_e2
        };
        let material = Material::new(e1_over_e2, nu1_value, base_value, nu0)?;
        let (table, query) = (self.unit(), material.normalisation().symbol());
        if table != query {
            return Err(Error::Normalisation { table, query });
        }
        let coordinates = [
            self.coordinate(film, e1_over_e2)?,
            nu1.coordinate(nu1_value),
            base.coordinate(ratio),
        ];
        Ok((material, coordinates))
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

    /// Returns the sphere-film modulus `es` in the unit of the table, at node `e1` of the film's
    /// modulus and node `nu` of `nu1`.
    pub(crate) fn sphere_film_modulus(&self, e1: usize, nu: usize) -> f64 {
        if self.parameters == Parameter::REDUCED {
            return 1.0;
        }
        let [_, e1_nodes, nu1_nodes, _] = &self.nodes;
        let (e1, nu1) = (e1_nodes[e1], nu1_nodes[nu]);
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
        Parameter::E0OverE1 => {
            nodes.len() == 1 && (REASONABLE.contains(&node) || node == f64::INFINITY)
        }
        Parameter::E1sOverEinfs => REASONABLE.contains(&node) || node == 0.0,
        Parameter::E0sOverE2s => REASONABLE.contains(&node) || node == 0.0 || node == f64::INFINITY,
    };
    if let Some(node) = nodes.iter().find(|node| !physical(node)) {
        let allowed = match parameter {
            Parameter::AOverT => "in [1e-30, 1e30]",
            Parameter::E1OverE2 => "in [1e-30, 1e30], or 0 as the only node",
            Parameter::Nu1 => "in (-1, 0.5]",
            Parameter::E0OverE2 => "in [1e-30, 1e30], or inf as the only node",
            Parameter::E0OverE1 => "one number in [1e-30, 1e30], or inf",
            Parameter::E1sOverEinfs => "in [1e-30, 1e30], or 0",
            Parameter::E0sOverE2s => "in [1e-30, 1e30], 0 or inf",
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
