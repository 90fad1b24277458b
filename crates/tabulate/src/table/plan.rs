//! The nodes of a table, so that the splines between them keep the tolerance at the least number of
//! solves.
//!
//! Each axis is planned by itself, on the `lines` that run along it. The error of a tensor spline
//! is, to first order, the sum of the errors of its axes.

use interp::{Parameter, Table};
use serde::{Deserialize, Serialize};

use crate::Error;
use crate::table::budget::Budget;
use crate::table::extent::{Extent, MOST_NODES};
use crate::table::lines::Lines;
use crate::table::placement::{EVENNESS, nodes};
use crate::table::scene::Scene;

/// The nodes of the table of a scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Plan {
    /// The number of nodes on each axis.
    pub nodes: [usize; 4],
    /// How evenly the nodes of each axis are spaced in the parameter's coordinate: 0 for Chebyshev points, which crowd
    /// towards the ends, and 1 for even spacing.
    pub evenness: [f64; 4],
}

/// The largest number of values of a table, 1.6 GB. A larger one is taken for a mistake.
const MOST_VALUES: usize = 200_000_000;

/// The largest error on the lines of each axis, in parts of the tolerance.
///
/// The errors of the axes are largest in different places, so that the error of the table is hardly
/// larger: 0.4 to 0.7 of the tolerance for the shipped scenes, and at most 0.83 for 90 random ones.
const SHARE: f64 = 0.5;

impl Plan {
    /// Plans the table of a scene. An axis has the number of nodes that the scene states for it.
    /// The plan does not depend on the number of threads.
    ///
    /// # Errors
    /// Those of the solve; [`Error::Nodes`] where an axis would need thousands of nodes, or
    /// nodes closer than f64 can tell apart or too close for splines, or a table of more than 2e8
    /// values would be needed.
    pub fn new(scene: &Scene) -> Result<Self, Error> {
        Self::within(scene, None)
    }

    /// Plans like [`Plan::new`], or returns [`Error::Budget`] when the budget is spent before.
    pub(crate) fn within(scene: &Scene, budget: Option<Budget<'_>>) -> Result<Self, Error> {
        let mut plan = Self {
            // At least two nodes on every axis: what cannot be made of these is refused before a solve.
            nodes: scene.extents.map(|extent| match extent {
                Extent::Fixed(_) => 1,
                Extent::Range { .. } => 2,
                Extent::Even { nodes, .. } => nodes,
            }),
            evenness: scene.extents.map(|extent| match extent {
                Extent::Range { .. } => EVENNESS[0],
                Extent::Fixed(_) | Extent::Even { .. } => 1.0,
            }),
        };
        plan.check(scene)?;
        for (i, parameter) in scene.parameters.into_iter().enumerate() {
            if let Extent::Range { from, to } = scene.extents[i] {
                let lines = Lines::solve(scene, parameter, [from, to], budget)?;
                let unresolved = || unresolved(parameter, lines.most(), scene);
                (plan.nodes[i], plan.evenness[i]) = lines
                    .fewest(SHARE * scene.tolerance)
                    .ok_or_else(unresolved)?;
            }
        }
        plan.check(scene)?;
        Ok(plan)
    }

    /// Returns the four parameters of the scene with their nodes.
    ///
    /// # Panics
    /// For a plan that [`Plan::new`] has not made, with no node on an axis or an evenness outside `[0, 1]`.
    pub fn axes(&self, scene: &Scene) -> [(Parameter, Vec<f64>); 4] {
        scene.parameters.map(|parameter| {
            let i = parameter.dimension();
            let rule = (self.nodes[i], self.evenness[i]);
            (parameter, nodes(parameter, scene.extents[i].ends(), rule))
        })
    }

    /// Returns the number of points to solve.
    pub fn points(&self) -> usize {
        self.nodes.iter().product()
    }

    /// Returns the plan with more nodes on some axes; none if nothing changes.
    ///
    /// An axis gets `factors[parameter]` times as many nodes, and two more at least, where the
    /// factor is above 1. A number of nodes that the scene states is not changed.
    pub(crate) fn refined(&self, factors: [f64; 4], scene: &Scene) -> Result<Option<Self>, Error> {
        let mut plan = self.clone();
        for (i, factor) in factors.into_iter().enumerate() {
            if matches!(scene.extents[i], Extent::Range { .. }) && factor > 1.0 {
                let nodes = plan.nodes[i];
                plan.nodes[i] = ((nodes as f64 * factor).ceil() as usize).max(nodes + 2);
            }
        }
        if plan == *self {
            return Ok(None);
        }
        plan.check(scene)?;
        Ok(Some(plan))
    }

    /// Returns true if this can be the plan of the scene, refined or not.
    pub(crate) fn fits(&self, scene: &Scene) -> bool {
        let is_sound = |i: usize| match scene.extents[i] {
            Extent::Fixed(_) => self.nodes[i] == 1,
            Extent::Range { .. } => self.nodes[i] >= 2 && EVENNESS.contains(&self.evenness[i]),
            Extent::Even { nodes, .. } => self.nodes[i] == nodes && self.evenness[i] == 1.0,
        };
        (0..4).all(is_sound) && self.check(scene).is_ok()
    }

    /// Accepts a plan whose nodes are not too many and can be told apart.
    fn check(&self, scene: &Scene) -> Result<(), Error> {
        let shape = self.nodes;
        let values = shape
            .iter()
            .fold(scene.quantities.len(), |product, &nodes| {
                product.saturating_mul(nodes)
            });
        if values > MOST_VALUES || shape.iter().any(|&nodes| nodes > MOST_NODES) {
            return Err(Error::Nodes(format!(
                "the table would have {} nodes and {values} values, where at most {MOST_NODES} nodes on an axis and {MOST_VALUES} values are \
                 allowed; ask for a larger tolerance, a smaller box or fewer nodes",
                shape.map(|nodes| nodes.to_string()).join(" x ")
            )));
        }
        for (parameter, nodes) in self.axes(scene) {
            // Near incompressibility, f64 cannot tell more than some hundred nodes apart.
            if !nodes.is_sorted_by(|a, b| a < b) {
                return Err(unresolved(parameter, nodes.len(), scene));
            }
        }
        self.is_tabulated(scene)
    }

    /// Accepts a plan whose description and axes a table accepts, which is known before its values
    /// are: each axis by itself, in a table of ones.
    fn is_tabulated(&self, scene: &Scene) -> Result<(), Error> {
        let table = |along: Option<Parameter>| {
            let axes = self.axes(scene).map(|(parameter, mut nodes)| {
                if Some(parameter) != along {
                    nodes.truncate(1);
                }
                (parameter, nodes)
            });
            let count = axes
                .each_ref()
                .map(|(_, nodes)| nodes.len())
                .iter()
                .product();
            let ones = [Some(vec![1.0; count]), None, None, None];
            Table::new(scene.description(), axes, ones)
        };
        table(None)?;
        for (parameter, nodes) in self.axes(scene) {
            let too_close = |_| {
                let (axis, count) = (parameter.name(), nodes.len());
                Error::Nodes(format!(
                    "{axis} has {count} nodes from {:?} to {:?}, which are too close to each other for splines; ask for a \
                     wider range, fewer nodes or one number",
                    nodes[0],
                    nodes[count - 1]
                ))
            };
            table(Some(parameter)).map_err(too_close)?;
        }
        Ok(())
    }
}

/// The error of a parameter along which the quantities are too steep to be tabulated with fewer than some `nodes`.
fn unresolved(parameter: Parameter, nodes: usize, scene: &Scene) -> Error {
    Error::Nodes(format!(
        "{} would take {nodes} nodes or more for the tolerance {:e}; ask for a larger tolerance, or for a smaller range",
        parameter.name(),
        scene.tolerance
    ))
}
