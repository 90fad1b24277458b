//! The box of parameters of a scene.

use interp::{Parameter, SubstratePoissonRatio};

use crate::stack::NamedStack;

/// The largest number of nodes on an axis. A larger one is taken for a mistake.
pub(crate) const MOST_NODES: usize = 10_000;

/// The values of one parameter in a checked scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Extent {
    /// One number. The parameter is held fixed and adds no cost.
    Fixed(f64),
    /// A range. The planner chooses its nodes.
    Range {
        /// The smallest value.
        from: f64,
        /// The largest value.
        to: f64,
    },
    /// A range with a stated number of nodes, evenly spaced in the parameter's coordinate.
    Even {
        /// The smallest value.
        from: f64,
        /// The largest value.
        to: f64,
        /// The number of nodes, two or more.
        nodes: usize,
    },
}

impl Extent {
    /// Returns the smallest and the largest value.
    pub const fn ends(&self) -> [f64; 2] {
        match *self {
            Self::Fixed(value) => [value; 2],
            Self::Range { from, to } | Self::Even { from, to, .. } => [from, to],
        }
    }
}

/// The box of a scene, and what it is of.
pub(super) struct Bounds {
    pub(super) parameters: [Parameter; 4],
    pub(super) extents: [Extent; 4],
    pub(super) nu0: SubstratePoissonRatio,
    pub(super) stack: Option<NamedStack>,
}
