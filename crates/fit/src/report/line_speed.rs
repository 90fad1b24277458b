//! What a report and a picture show of adhesion that depends on the speed of the contact line.

use contact::{Hysteresis, RateDependent};

use super::unit::three_digits;
use crate::statistics::extremes;
use crate::{Error, Experiment, Fit, FittedExperiment, Parameter};

/// The adhesion of an experiment over the speed of the contact line.
#[derive(Clone, Debug, PartialEq)]
pub struct LinePlot {
    /// The speed (m/s, positive where the line recedes) of each point that counts, and the energy release rate (J/m^2) that
    /// its load or penetration tells.
    pub points: Vec<[f64; 2]>,
    /// The law, as it was found.
    pub law: RateDependent<Hysteresis>,
}

/// Returns the adhesion of the experiment `number` of a fit over the speed of the contact line. `experiment` is this
/// experiment.
///
/// # Errors
/// [`Error::NotFitted`] where adhesion does not depend on the speed; [`Error::Contact`] for numbers that
/// [`RateDependent`] does not take, as where the receding work of adhesion is the smaller one.
///
/// # Panics
/// If the fit has no experiment of this `number`.
pub fn line_plot(fit: &Fit, experiment: &Experiment, number: usize) -> Result<LinePlot, Error> {
    let value = |parameter: Parameter| {
        let found = Fit::value_of(&fit.estimates, parameter, number);
        found.or(experiment.get(parameter))
    };
    let [Some(v0), Some(n)] = Parameter::OF_LINE.map(value) else {
        let reason = "its adhesion does not depend on the speed of the contact line: free the doubling-speed and the speed-exponent, or \
             give them, to see the law";
        return Err(experiment.not_fitted(reason));
    };
    let [advancing, receding] = Parameter::WORKS.map(value);
    let advancing = advancing.unwrap_or(0.0);
    let slow = Hysteresis::new(advancing, receding.unwrap_or(advancing))?;
    let points = fit.experiments[number].points.iter();
    let point = |point: &crate::FittedPoint| Some([point.line_speed?, point.energy_release_rate?]);
    Ok(LinePlot {
        points: points.filter_map(point).collect(),
        law: RateDependent::new(slow, v0, n)?,
    })
}

/// Returns the least and the largest speed of the contact line, m/s, of the points that count, without their signs; `None`
/// where adhesion does not depend on it.
pub fn line_speeds(fitted: &FittedExperiment) -> Option<[f64; 2]> {
    let speeds = fitted.points.iter().filter_map(|point| point.line_speed);
    let [least, most] = extremes(speeds.map(f64::abs));
    (least <= most).then_some([least, most])
}

/// Returns these speeds of each measurement.
pub(super) fn lines(fit: &Fit) -> Vec<String> {
    let line = |fitted: &FittedExperiment| {
        let [least, most] = line_speeds(fitted)?.map(|speed| three_digits(speed, "m/s"));
        let name = &fitted.name;
        Some(format!(
            "{name}: speeds of the contact line from {least} to {most}"
        ))
    };
    fit.experiments.iter().filter_map(line).collect()
}
