//! A minimum, and how far the data tell it from others.

use super::valley::Bend;
use crate::estimate::problem::no_adhesion;
use crate::estimate::problem::uncertainty::Uncertainty;
use crate::estimate::problem::{Ending, Problem};

/// A minimum, and what is known about the way to it.
pub(crate) struct Minimum<'a> {
    pub problem: Problem<'a>,
    /// The uncertainty there; `None` where there are no derivatives.
    pub uncertainty: Option<Uncertainty>,
    /// Other minima that the data do not rule out.
    pub rivals: Vec<Rival>,
    /// A value whose standard error says too little.
    pub bend: Option<Bend>,
}

/// A minimum that is worse, but not by more than chance explains.
pub(crate) struct Rival {
    pub values: Vec<f64>,
    /// The excess of its sum of squares.
    pub excess: f64,
}

impl<'a> Minimum<'a> {
    /// Tells whether contacts were refused on the way to the least squares, so that the fit ended by more than
    /// `short` standard errors before.
    pub fn is_stopped(&self, short: f64) -> bool {
        let is_short = |own: &Uncertainty| own.short > short;
        self.problem.refused && self.uncertainty.as_ref().is_some_and(is_short)
    }

    /// Takes the minimum of a problem, which has failed where there are no derivatives.
    pub fn new(mut problem: Problem<'a>, uncertainty: Option<Uncertainty>) -> Self {
        let uncertainty = no_adhesion::uncertainty(&problem).or(uncertainty);
        if uncertainty.is_none() {
            problem.ending = Ending::Failed;
        }
        Self {
            problem,
            uncertainty,
            rivals: Vec::new(),
            bend: None,
        }
    }
}
