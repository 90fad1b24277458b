//! The model where contacts have no exact derivatives: on layers, and beyond the nodes of a table in
//! `a/t`. Central differences stand for them.
//!
//! A contact on layers is a spline through solves to 1e-8, so that a step of 1e-3 in a modulus or a
//! thickness leaves errors of some 1e-6 of the derivative. At a given contact a step can be
//! smaller. Measured on one layer, against the exact derivatives of the film: at most 6.3e-6 of the
//! largest (`tests/fit/layers.rs`).

use contact::Contact;
use interp::Table;

use super::predicted::{BranchEnd, Predicted};
use super::{Bodies, Branch, Experiment, Kind, Measurement, Parameter, Point};
use crate::Error;
use crate::statistics::extremes;

/// The step of the logarithm of a parameter of the bodies.
const BODY_STEP: f64 = 1e-3;
/// The step of other values, relative to themselves or to the range of the data.
const STEP: f64 = 1e-5;

/// Makes the contact of bodies, with its derivatives with respect to parameters where they are known.
pub(crate) type ContactOf<'a> = dyn Fn(&Bodies, &[Parameter]) -> Result<Contact, Error> + 'a;

/// Makes contacts by a table.
pub(crate) fn contacts_of(
    table: &Table,
) -> impl Fn(&Bodies, &[Parameter]) -> Result<Contact, Error> {
    |bodies, parameters| bodies.contact(table, parameters)
}

impl Experiment {
    /// Predicts all points that are not left out, with derivatives with respect to `parameters`. See [`Experiment::predict`].
    pub(crate) fn predict_with(
        &self,
        contact_of: &ContactOf<'_>,
        branches: &[Branch],
        order: &[usize],
        parameters: &[Parameter],
    ) -> Result<Predicted, Error> {
        if self.relaxing.is_some() {
            return self.predict_history(contact_of, parameters);
        }
        let is_stiffness = self.measurement.kind.is_stiffness();
        if !is_stiffness && (parameters.is_empty() || !self.bodies.are_layered()) {
            let contact = contact_of(&self.bodies, parameters)?;
            match self.predict(&contact, branches, order, parameters) {
                Err(error) if !parameters.is_empty() && is_beyond_nodes(&error) => {}
                predicted => return Ok(predicted?),
            }
        }
        let plain = |experiment: &Self| {
            if is_stiffness {
                return experiment.predict_stiffness(contact_of, branches);
            }
            let contact = contact_of(&experiment.bodies, &[])?;
            Ok(experiment.predict(&contact, branches, order, &[])?)
        };
        let mut predicted = plain(self)?;
        predicted.derivatives = vec![0.0; predicted.values.len() * parameters.len()];
        for (column, &parameter) in parameters.iter().enumerate() {
            let by = self.differences(parameter, |moved| Ok(plain(moved)?.values))?;
            predicted.set_column(column, parameters.len(), by);
        }
        Ok(predicted)
    }

    /// Returns where a stable branch ends on unloading, with the derivatives of its abscissa. See
    /// [`Experiment::branch_end`].
    pub(crate) fn branch_end_with(
        &self,
        contact_of: &ContactOf<'_>,
        branch: Branch,
        columns: &[Parameter],
    ) -> Result<Option<BranchEnd>, Error> {
        if !self.bodies.are_layered() {
            let contact = contact_of(&self.bodies, columns)?;
            match self.branch_end(&contact, branch, columns) {
                Err(error) if is_beyond_nodes(&error) => {}
                end => return Ok(end?),
            }
        }
        let contact = contact_of(&self.bodies, &[])?;
        let Some(mut end) = self.branch_end(&contact, branch, &[])? else {
            return Ok(None);
        };
        let abscissa = |experiment: &Self| {
            let contact = contact_of(&experiment.bodies, &[])?;
            let end = experiment.branch_end(&contact, branch, &[])?;
            Ok(end.into_iter().map(|end| end.abscissa).collect())
        };
        for &parameter in columns {
            let by = self.differences(parameter, abscissa)?;
            end.derivatives.push(by.first().copied().unwrap_or(0.0));
        }
        Ok(Some(end))
    }

    /// Returns the central differences of numbers, over that of a parameter. They are 0 for a work
    /// of adhesion of 0, as the exact ones. Where the model ends on one side, they are those to the other side.
    pub(super) fn differences(
        &self,
        parameter: Parameter,
        numbers: impl Fn(&Self) -> Result<Vec<f64>, Error>,
    ) -> Result<Vec<f64>, Error> {
        let value = self.get(parameter).unwrap_or(0.0);
        let at = |value: f64| {
            let mut moved = self.clone();
            moved.replace(parameter, value)?;
            numbers(&moved)
        };
        let mut ends = if parameter.is_positive() {
            let step: f64 = if parameter.is_of_bodies() {
                BODY_STEP
            } else {
                STEP
            };
            [-step, step].map(|step| value * step.exp())
        } else {
            let step = STEP * self.unit(parameter, &[]);
            [value - step, value + step]
        };
        let mut found = ends.map(at);
        if let Some(end) = found.iter().position(Result::is_err) {
            (ends[end], found[end]) = (value, at(value));
        }
        let [before, after] = found;
        let (before, after) = (before?, after?);
        let width = ends[1] - ends[0];
        let difference = |(before, after): (f64, f64)| {
            if width > 0.0 {
                (after - before) / width
            } else {
                0.0
            }
        };
        Ok(before.into_iter().zip(after).map(difference).collect())
    }

    /// Returns the size of a change that matters, for a parameter that may be negative. A contact point is looked for
    /// among the points that are not on the baseline.
    pub(crate) fn unit(&self, parameter: Parameter, branches: &[Branch]) -> f64 {
        let Measurement { kind, points, .. } = &self.measurement;
        let range = |value: fn(&Point) -> f64, contact: bool| {
            let is_off = |i: usize| branches.get(i) == Some(&Branch::Baseline);
            let points = points.iter().enumerate();
            let points = points.filter(|&(i, _)| !(contact && is_off(i)));
            let [least, most] = extremes(points.map(|(_, point)| value(point)));
            if most > least { most - least } else { 1.0 }
        };
        let ordinates = range(|point| point.ordinate, false);
        match parameter {
            Parameter::LoadOffset | Parameter::Baseline => ordinates,
            Parameter::BaselineSlope => ordinates / range(|point| point.abscissa, false),
            Parameter::ContactPoint if *kind == Kind::PenetrationRadius => ordinates,
            Parameter::ContactPoint | Parameter::TipRounding => range(|point| point.abscissa, true),
            Parameter::FrameCompliance => 1.0 / ordinates,
            _ => 1.0,
        }
    }
}

/// Tells whether an error is that of exact derivatives beyond the nodes of a table in `a/t`, where the
/// expansion about the limit gives values only.
const fn is_beyond_nodes(error: &contact::Error) -> bool {
    matches!(
        error,
        contact::Error::Table(interp::Error::OutsideTable { .. })
    )
}
