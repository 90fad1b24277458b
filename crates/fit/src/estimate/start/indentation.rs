//! Where the fit of a contact stiffness starts.

use std::f64::consts::PI;

use interp::Table;

use super::starts::{Starts, root_of_modulus};
use crate::estimate::problem::assigned::Assigned;
use crate::model::contacts_of;
use crate::statistics::median;
use crate::{Error, Parameter};

/// The steps of the logarithm of a modulus on the search for one with a contact.
const STEPS: usize = 30;
/// The pull-off load over the middle load, of the work of adhesion to start from.
const PULL_OFF: f64 = 0.1;

/// Gives the starts that the data show.
pub(crate) fn give(starts: &mut Starts<'_>) -> Result<(), Error> {
    let experiment = &starts.at.experiment;
    let loads = experiment.measurement.points.iter();
    let load = median(loads.map(|point| point.abscissa).collect());
    let radius = experiment.bodies.probe.radius().unwrap_or(1.0);
    if let Some(hardness) = experiment.hardness_to_start_from(starts.is_unknown) {
        starts.give_unknown(Parameter::Hardness, hardness)?;
    }
    let work = PULL_OFF * load / (1.5 * PI * radius);
    starts.give_unknown(Parameter::WorkOfAdhesion, work)?;
    if let Some(parameter) = starts.matched
        && let Some(value) = matching(starts.table, &starts.at, parameter)
    {
        starts.give(parameter, value)?;
    }
    Ok(())
}

/// Returns the modulus with which the model has the stiffness of the data on average; `None` where
/// it has no contact.
fn matching(table: &Table, at: &Assigned, parameter: Parameter) -> Option<f64> {
    let excess = |logarithm: f64| -> Option<f64> {
        let mut experiment = at.experiment.clone();
        experiment.replace(parameter, logarithm.exp()).ok()?;
        // The phase between stiffness and oscillation changes the stiffness by little.
        experiment.indentation.phases.clear();
        let predicted = experiment
            .predict_stiffness(&contacts_of(table), &at.branches)
            .ok()?;
        let counts = at.counting_points();
        let differences: Vec<f64> = counts
            .map(|i| predicted.values[i] - experiment.compared(i))
            .collect();
        let mean = differences.iter().sum::<f64>() / differences.len() as f64;
        mean.is_finite().then_some(mean)
    };
    let guess = at.experiment.modulus_of_half_space(parameter)?.ln();
    // The stiffness grows with each modulus. Steps go on where the table has no contact.
    let steps = (0..STEPS).map(|k| k.div_ceil(2) as f64 * if k % 2 == 0 { 0.5 } else { -0.5 });
    let mut tried = steps.map(|step| guess + step);
    root_of_modulus(tried.find(|&u| excess(u).is_some())?, excess)
}
