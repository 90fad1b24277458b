//! Where the fit of a contact stiffness starts.

use std::f64::consts::PI;

use interp::Table;

use crate::estimate::assigned::Assigned;
use crate::statistics::median;
use crate::{Bodies, Branch, Error, Parameter};

/// The steps of the logarithm of a modulus on the search for one that matches the data.
const STEPS: usize = 30;
const BISECTIONS: usize = 6;
/// The number of points that are compared on this search.
const FEW: usize = 10;
/// The pull-off load over the middle load, of the work of adhesion to start from.
const PULL_OFF: f64 = 0.1;

/// Lists the starts that the data show, and gives them to the experiment.
pub(in crate::estimate) fn starts(
    table: &Table,
    at: &mut Assigned,
    matched: Option<Parameter>,
    is_unknown: impl Fn(Parameter) -> bool,
) -> Result<Vec<(Parameter, f64)>, Error> {
    let experiment = &mut at.experiment;
    let mut starts = Vec::new();
    if is_unknown(Parameter::Hardness)
        && let Some(hardness) = experiment.hardness_to_start_from()
    {
        experiment.replace(Parameter::Hardness, hardness)?;
        starts.push((Parameter::Hardness, hardness));
    }
    if is_unknown(Parameter::WorkOfAdhesion) {
        let loads = experiment.measurement.points.iter();
        let load = median(loads.map(|point| point.abscissa).collect());
        let radius = experiment.bodies.probe().radius().unwrap_or(1.0);
        let work = PULL_OFF * load / (1.5 * PI * radius);
        experiment.replace(Parameter::WorkOfAdhesion, work)?;
        starts.push((Parameter::WorkOfAdhesion, work));
    }
    if let Some(parameter) = matched
        && let Some(value) = matching(table, at, parameter)
    {
        at.experiment.replace(parameter, value)?;
        starts.push((parameter, value));
    }
    Ok(starts)
}

/// Returns the modulus with which the model has the stiffness of the data on average; `None` where
/// it has no contact.
fn matching(table: &Table, at: &Assigned, parameter: Parameter) -> Option<f64> {
    let mut branches = at.branches.clone();
    let counting: Vec<usize> = (0..branches.len())
        .filter(|&i| branches[i] != Branch::LeftOut)
        .collect();
    let every = counting.len().div_ceil(FEW).max(1);
    for (n, &i) in counting.iter().enumerate() {
        if n % every != 0 {
            branches[i] = Branch::LeftOut;
        }
    }
    let contact_of = |bodies: &Bodies, by: Option<&[Parameter]>| bodies.contact(table, by);
    let excess = |logarithm: f64| -> Option<f64> {
        let mut experiment = at.experiment.clone();
        experiment.replace(parameter, logarithm.exp()).ok()?;
        // The phase between stiffness and oscillation changes the stiffness by little.
        experiment.indentation.phases.clear();
        let predicted = experiment.predict_stiffness(&contact_of, &branches).ok()?;
        let counts = (0..branches.len()).filter(|&i| branches[i] != Branch::LeftOut);
        let differences: Vec<f64> = counts
            .map(|i| predicted.values[i] - experiment.compared(i))
            .collect();
        let mean = differences.iter().sum::<f64>() / differences.len() as f64;
        mean.is_finite().then_some(mean)
    };
    let guess = at.experiment.modulus_of_half_space(parameter)?.ln();
    // The stiffness grows with each modulus. Steps go on where the table has no contact.
    let steps = (0..STEPS).map(|k| k.div_ceil(2) as f64 * if k % 2 == 0 { 0.5 } else { -0.5 });
    let (mut u, mut value) = steps
        .map(|step| guess + step)
        .find_map(|u| Some((u, excess(u)?)))?;
    let step = if value < 0.0 { 0.5 } else { -0.5 };
    for _ in 0..STEPS {
        let Some(next) = excess(u + step) else {
            return Some(u.exp());
        };
        if (next < 0.0) != (value < 0.0) {
            let (mut low, mut high) = (u, u + step);
            for _ in 0..BISECTIONS {
                let middle = 0.5 * (low + high);
                if (excess(middle)? < 0.0) == (value < 0.0) {
                    low = middle;
                } else {
                    high = middle;
                }
            }
            return Some((0.5 * (low + high)).exp());
        }
        if (next - value).abs() < 1e-6 {
            return Some(u.exp());
        }
        (u, value) = (u + step, next);
    }
    Some(u.exp())
}
