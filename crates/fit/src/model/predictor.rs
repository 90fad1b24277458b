//! The points of an experiment while they are predicted.

use contact::{Contact, Derivatives, Input};

use super::predicted::Predicted;
use super::{Branch, Experiment, Parameter};

/// Predicts the points of an experiment in one contact.
pub(super) struct Predictor<'a> {
    pub experiment: &'a Experiment,
    pub contact: &'a Contact,
    pub branches: &'a [Branch],
    /// The points by descending imposed value.
    pub order: &'a [usize],
    /// The parameters with respect to which there are derivatives.
    pub columns: &'a [Parameter],
    /// What is predicted so far.
    pub predicted: Predicted,
}

impl Predictor<'_> {
    /// Returns the inputs of the contact on a branch that parameters are, and the number of each of
    /// these parameters.
    pub fn inputs_on(&self, branch: Branch) -> (Vec<Input>, Vec<usize>) {
        let columns = self.columns.iter().enumerate();
        let input = |parameter| self.experiment.input_on(parameter, branch);
        columns
            .filter_map(|(column, &parameter)| Some((input(parameter)?, column)))
            .unzip()
    }

    /// Returns the derivatives of a point.
    pub fn row(&mut self, i: usize) -> &mut [f64] {
        let width = self.columns.len();
        &mut self.predicted.derivatives[i * width..][..width]
    }

    /// Returns the imposed value of a point.
    pub fn imposed(&self, i: usize) -> f64 {
        let points = &self.experiment.measurement.points;
        self.experiment.imposed(points[i].abscissa)
    }
}

impl Experiment {
    /// Returns the change of the imposed value that belongs to a change of load and penetration.
    pub(super) fn imposed_by(&self, by: Derivatives) -> f64 {
        self.control().imposed(by.load, by.penetration)
    }
}
