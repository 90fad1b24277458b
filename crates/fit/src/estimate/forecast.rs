//! What an experiment would tell, before it is made.

use interp::Table;

use super::fixed_values;
use super::minima::search::{Beyond, ROUNDS, clear_branches};
use super::problem::Problem;
use super::problem::assigned::Assigned;
use super::problem::few::hold_back;
use super::problem::slot::slots;
use super::problem::uncertainty::{Uncertainty, estimates};
use super::warnings::{assumptions, calibration};
use crate::{Error, Experiment, Forecast, Free, LayerQuantity, Loss, Options, Parameter};

/// Computes the standard errors that a planned experiment would give.
///
/// The values of the experiments are taken for the truth, the abscissae of their points for those
/// to be measured; ordinates are not used. Each experiment needs its noise; that of its abscissae counts, too. The
/// errors are those of least squares, from the derivatives of the model at the truth. Bounds and starts of the free
/// parameters are not used; priors are.
///
/// A fit of force curves that jump leaves out points near the ends of their branches by the noise of the data.
/// Its errors are then larger than these.
///
/// # Errors
/// As [`fit`](crate::fit); [`Error::Setting`] without a noise, and for a free quantity such as the work of
/// adhesion that must be positive and is planned as 0; [`Error::NotFitted`] for a free tangential stiffness
/// of an interface that is planned as 0 or infinite.
pub fn forecast(
    table: &Table,
    experiments: &[Experiment],
    free: &[Free],
) -> Result<Forecast, Error> {
    let without_limits = |one: &Free| Free {
        start: None,
        bounds: None,
        ..*one
    };
    let free: Vec<Free> = free.iter().map(without_limits).collect();
    let planned = experiments.iter().map(|one| planned(table, one, &free));
    let assigned: Vec<Assigned> = planned.collect::<Result<_, _>>()?;
    let mut slots = slots(experiments, &free)?;
    for slot in &mut slots {
        let e = slot.experiment.unwrap_or(0);
        let own = &assigned[e];
        let unit = own.experiment.unit(slot.parameter, &own.branches);
        slot.coordinate = slot.coordinate.without_bounds().with_unit(unit);
    }
    let whole = assigned.clone();
    let mut problem = Problem::new(table, assigned, slots, Loss::Squares)?;
    // As in a fit, points near the end of a branch are left out. The first round leaves out those
    // at the end itself, where there are no derivatives.
    for (assigned, whole) in problem.assigned.iter_mut().zip(&whole) {
        *assigned = hold_back(whole);
    }
    problem.weigh()?;
    for _ in 0..ROUNDS {
        let uncertainty = uncertainty(&problem)?;
        for (e, whole) in whole.iter().enumerate() {
            let (branches, _) = clear_branches(&problem, e, &uncertainty, whole, Beyond::Counts);
            problem.assigned[e].branches = branches;
        }
    }
    let uncertainty = uncertainty(&problem)?;
    let estimates = estimates(&problem, Some(&uncertainty));
    let range = Options::default().interaction_range;
    let broken = |e| assumptions::of_problem(&problem, e, range, &estimates);
    let broken = (0..problem.assigned.len()).filter_map(broken).flatten();
    let broken: Vec<_> = broken.collect();
    read_as_predicted(&mut problem);
    let fixed_values = fixed_values::effects(&problem, &uncertainty, &[], true);
    let mut warnings = calibration::doubts(&problem.slot_names(), &estimates, &fixed_values);
    warnings.extend(broken);
    Ok(Forecast {
        correlation: uncertainty.correlation(),
        undetermined: uncertainty.undetermined(&problem.slot_names()),
        warnings,
        estimates,
        fixed_values,
    })
}

/// Returns an experiment with its branches at the planned values.
fn planned(table: &Table, experiment: &Experiment, free: &[Free]) -> Result<Assigned, Error> {
    experiment.accept_instrument()?;
    experiment.accept_errors()?;
    experiment.known_noise()?;
    let mut experiment = experiment.clone();
    if free
        .iter()
        .any(|one| one.parameter == Parameter::WorkOfAdhesionReceding)
    {
        let work = experiment.work_of_adhesion;
        experiment.work_of_adhesion_receding.get_or_insert(work);
    }
    for one in free {
        accept_planned(&experiment, one.parameter)?;
    }
    // The stiffness itself tells contact depths, and the error of an abscissa counts by the slope where the reading says
    // that the point lies.
    experiment.reach_contacts();
    experiment.make(table)?;
    if experiment.measurement.kind.is_stiffness() {
        experiment.accept_stiffness()?;
    }
    let contact = experiment.bodies.contact(table, &[])?;
    let (mut branches, order) = experiment.branches_of_model(&contact)?;
    experiment.keep_line_speeds();
    experiment.leave_out_unknown_speeds(&mut branches);
    Ok(Assigned::new(experiment, (branches, order, None)))
}

/// Refuses a free parameter whose planned value has no errors.
fn accept_planned(experiment: &Experiment, parameter: Parameter) -> Result<(), Error> {
    if parameter.is_positive()
        && experiment.get(parameter) == Some(0.0)
        && experiment.why_without_effect(parameter).is_none()
    {
        let allowed = "positive where it is free: the errors are those at the planned value";
        return Err(experiment.wrong_setting(parameter, 0.0, allowed));
    }
    if Parameter::OF_LINE.contains(&parameter)
        && experiment.get(parameter).is_none()
        && experiment.why_without_effect(parameter).is_none()
    {
        let allowed = "given, also where it is free: the errors are those at the planned value";
        return Err(experiment.wrong_setting(parameter, f64::NAN, allowed));
    }
    if let Parameter::Layer(name, LayerQuantity::InterfaceStiffness) = parameter
        && let Some(layer) = experiment.bodies.layer(name)
        && layer.interface_stiffness().is_none()
    {
        let reason = "its tangential stiffness is planned as 0 or infinite, and the errors are those at the planned \
                      value: plan another one, such as the modulus of the layer over its thickness";
        return Err(experiment.not_applicable(parameter, reason));
    }
    Ok(())
}

/// Takes what the model predicts for the readings.
fn read_as_predicted(problem: &mut Problem<'_>) {
    let predicted = problem.predicted.iter().flatten();
    for (assigned, predicted) in problem.assigned.iter_mut().zip(predicted) {
        let counting: Vec<usize> = assigned.counting_points().collect();
        for i in counting {
            let ordinate = assigned.experiment.ordinate_of(predicted.values[i]);
            assigned.experiment.measurement.points[i].ordinate = ordinate;
        }
    }
}

/// Computes the uncertainty, which does not depend on the residuals.
fn uncertainty(problem: &Problem<'_>) -> Result<Uncertainty, Error> {
    let (points, parameters) = (problem.residual_count(), problem.slots.len());
    if points < parameters {
        return Err(Assigned::too_few(&problem.assigned, parameters));
    }
    Uncertainty::of(problem).ok_or_else(|| {
        Error::NotFitted(
            "the model has no derivatives with respect to the free parameters at these points: the table must \
             hold a range of each of them, and the points must be away from the end of a branch and of the \
             table"
                .into(),
        )
    })
}
