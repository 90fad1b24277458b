//! The fit, from the data to the result.

use interp::Table;

use super::fixed_values;
use super::left_out;
use super::minima::minimum::Minimum;
use super::minima::profile;
use super::minima::{minimum, replace_by};
use super::problem::assigned::Assigned;
use super::problem::loss;
use super::problem::slot::{Slot, slots};
use super::problem::uncertainty::{UNDETERMINED, Uncertainty, estimates};
use super::problem::{Ending, Problem};
use super::relaxing;
use super::warnings;
use super::without_film;
use crate::model::has_no_start;
use crate::statistics::{deviations, student_deviations};
use crate::{
    Branch, Direction, Error, Experiment, Fit, FittedExperiment, FittedPoint, Free, LeftOut,
    Options, Parameter, Solver, Undetermined, WarningKind, WithoutFilm,
};

/// The number of standard deviations beyond which a residual is an outlier.
const OUTLIER: f64 = 5.0;
/// The number of standard errors from the least squares beyond which a fit that contacts have stopped is none.
const FAR: f64 = 10.0;
/// The standard error of the work of adhesion of a flat punch, over its value, from which on it is none: it rests on the
/// rounding of a load that does not depend on it.
const NO_ERROR: f64 = 100.0;
/// Why no flat punch is fitted with full friction.
const STICKING_PUNCH: &str = "a flat punch is fitted without friction only. Full friction multiplies its load at each \
     penetration by one number: fit it without friction, and where nothing but the film deforms, the warning about friction \
     names the modulus with full friction";
/// The most minima that intervals may replace by lower ones.
const MOST_RESTARTS: usize = 8;

/// Finds the free parameters of one or several experiments.
///
/// Levenberg and Marquardt's method, with the derivatives of [`Experiment::predictions`], minimises
/// the loss. Moduli, works of
/// adhesion, thickness and stiffness are varied by their logarithms. The start comes from straight
/// lines through the data without the film. Where it ends in a bad minimum, or tells a modulus, a
/// thickness or a work of adhesion to no better than 3 %, other starts are tried, and the best
/// minimum counts.
///
/// Points whose force lies within 4 standard errors of the end of their branch are left out,
/// because there it depends on the parameters in no linear way, and standard errors would be too
/// small; but no more than a tenth of the points in contact, beside those that are clearly beyond the
/// end.
///
/// The fit is deterministic and uses one thread. The curves of a map can be fitted side by side:
/// threads may share the `table`.
///
/// # Errors
/// [`Error`] for points, parameters or options that cannot be used; [`Error::LeftOut`] if more than
/// a third of the points in contact is left out, unless [`Options::allow_left_out`];
/// [`Error::NotDetermined`] for a minimum at which a standard error is not finite. A fit that does
/// not converge is no error: see [`Fit::converged`]. [`Error::Interrupted`] if an
/// [`Interrupt`](crate::Interrupt) was requested.
pub fn fit(
    table: &Table,
    experiments: &[Experiment],
    free: &[Free],
    options: &Options,
) -> Result<Fit, Error> {
    let found = to_the_end(table, experiments, free, options);
    // Without its contacts a fit ends early, as one that does not converge.
    if experiments.iter().any(Experiment::is_interrupted) {
        return Err(Error::Interrupted);
    }
    found
}

/// Fits, and takes refused contacts for states that do not exist.
fn to_the_end(
    table: &Table,
    experiments: &[Experiment],
    free: &[Free],
    options: &Options,
) -> Result<Fit, Error> {
    accept(options)?;
    let (data, slots) = prepare(experiments, free)?;
    let points: usize = data.iter().map(Assigned::counting).sum();
    let priors = slots.iter().filter(|slot| slot.prior.is_some()).count();
    if points + priors <= slots.len() {
        return Err(Assigned::too_few(&data, slots.len()));
    }
    fixed_values::accept(&data, &slots, &options.known)?;
    let mut found = minimum(table, &data, (free, &slots), options.loss)?;
    let intervals = intervals(&mut found, &data, options);
    let left_out = left_out::left_out(&found, &data);
    if !options.allow_left_out {
        left_out::accept(&data, &left_out)?;
    }
    accept_errors(&found)?;
    let (without_film, without) = options
        .without_film
        .then(|| without_film::without_film(table, &found, options.loss))
        .flatten()
        .unzip();
    let experiments = left_out.into_iter().enumerate();
    let experiments =
        experiments.map(|(e, left_out)| experiment(&found, e, left_out, without.as_ref()));
    let experiments: Result<Vec<_>, _> = experiments.collect();
    let experiments = experiments.map_err(|error| of_undetermined(error, &found))?;
    let fit = result(&found, &data, options, intervals, experiments, without_film);
    fixed_values::accept_changes(&fit.fixed_values)?;
    Ok(fit)
}

/// Finds the intervals asked for. One that leads to a lower minimum starts the fit again from there.
fn intervals<'a>(
    found: &mut Minimum<'a>,
    data: &[Assigned],
    options: &Options,
) -> Option<Vec<[profile::End; 2]>> {
    let level = options.profile_level?;
    for _ in 0..MOST_RESTARTS {
        let uncertainty = found.uncertainty.as_ref()?;
        if found.problem.ending != Ending::Converged {
            return None;
        }
        // An estimated noise has an error of its own, which is large where points are few.
        let (freedom, known) = freedom(&found.problem);
        let deviations = if known {
            deviations(level)
        } else {
            student_deviations(level, freedom.max(1))
        };
        match profile::intervals(&found.problem, uncertainty, deviations) {
            Ok(ends) => return Some(ends),
            Err(lower) => replace_by(found, *lower, data),
        }
    }
    // Each round has found a lower minimum: this one is none.
    found.problem.ending = Ending::OutOfPatience;
    None
}

/// Returns the number of points that count, and of priors, less that of the values found, and whether
/// the noise of all experiments is known.
fn freedom(problem: &Problem<'_>) -> (usize, bool) {
    let rows = problem.residual_count();
    let known = problem.experiments().all(|one| one.usual_noise().is_some());
    (rows.saturating_sub(problem.slots.len()), known)
}

/// Accepts a minimum whose values all have finite errors, or one that the result calls none.
fn accept_errors(found: &Minimum<'_>) -> Result<(), Error> {
    let problem = &found.problem;
    let is_punch = |one: &Assigned| one.experiment.bodies.probe.is_flat_punch();
    let are_punches = problem.assigned.iter().all(is_punch);
    let open = with_error(found, |parameter, error| {
        let is_of_punch = are_punches && parameter.is_work_of_adhesion();
        !error.is_finite() || (is_of_punch && error > NO_ERROR)
    });
    if problem.ending != Ending::Converged || found.uncertainty.is_none() || open.is_empty() {
        return Ok(());
    }
    let recedes = |one: &Experiment| {
        let mut points = one.measurement.points.iter();
        points.any(|point| point.direction == Some(Direction::Retract))
    };
    let mut parameters = open.iter().map(|&slot| problem.slots[slot].parameter);
    let why = if are_punches && parameters.clone().all(Parameter::is_work_of_adhesion) {
        Undetermined::PullOffOnly
    } else if parameters.all(|one| one == Parameter::WorkOfAdhesionReceding)
        && !problem.experiments().any(recedes)
    {
        Undetermined::NothingRecedes
    } else {
        Undetermined::Insensitive
    };
    Err(Error::NotDetermined {
        parameters: names_of(problem, &open),
        why,
    })
}

/// Returns the error of bodies that do not relax, or that of the data where they do not determine how the others do.
fn of_undetermined(error: Error, found: &Minimum<'_>) -> Error {
    let open = with_error(found, |_, error| error > UNDETERMINED);
    match error {
        Error::Contact(cause @ contact::Error::UnlikeBodies { .. }) if !open.is_empty() => {
            let parameters = names_of(&found.problem, &open);
            Error::NotFitted(format!(
                "the data do not determine {parameters}, and at the values found {cause}. Fix a number of the relaxation \
                 function or give it a prior, measure with less noise, or hold for longer"
            ))
        }
        error => error,
    }
}

/// Lists the slots whose relative standard error `is` such; all, where no error is known.
fn with_error(found: &Minimum<'_>, is: impl Fn(Parameter, f64) -> bool) -> Vec<usize> {
    let of_slot = |&slot: &usize| {
        let (uncertainty, parameter) = (
            found.uncertainty.as_ref(),
            found.problem.slots[slot].parameter,
        );
        uncertainty.is_none_or(|own| is(parameter, own.relative_error(slot)))
    };
    (0..found.problem.slots.len()).filter(of_slot).collect()
}

/// Returns the names of slots, between "and".
fn names_of(problem: &Problem<'_>, slots: &[usize]) -> String {
    let names = problem.slot_names();
    let names: Vec<&str> = slots.iter().map(|&slot| &*names[slot]).collect();
    names.join(" and ")
}

/// Accepts the experiments, reads the branches of their points, and lists the values to be found.
pub(crate) fn prepare(
    experiments: &[Experiment],
    free: &[Free],
) -> Result<(Vec<Assigned>, Vec<Slot>), Error> {
    let slots = slots(experiments, free)?;
    let is_free = |parameter| free.iter().any(|one| one.parameter == parameter);
    let mut assigned = Vec::new();
    for experiment in experiments {
        let mut experiment = experiment.clone();
        // A shared parameter has no effect on some kinds of measurement.
        for one in Parameter::OF_LINE.into_iter().filter(|&one| is_free(one)) {
            if experiment.get(one).is_none() && experiment.why_without_effect(one).is_none() {
                experiment.set(one, 1.0)?;
            }
        }
        experiment.accept_instrument()?;
        if experiment.measurement.points.is_empty() {
            return Err(Error::too_few_points(0, free.len(), 0));
        }
        experiment.accept_errors()?;
        let bodies = &experiment.bodies;
        if bodies.probe.is_flat_punch() && matches!(bodies.solver, Solver::Stick { .. }) {
            return Err(experiment.not_fitted(STICKING_PUNCH));
        }
        for work in Parameter::WORKS {
            let value = experiment.get(work);
            if let Some(value) = value.filter(|value| !(0.0..f64::INFINITY).contains(value)) {
                return Err(experiment.wrong_setting(work, value, ">= 0 and finite"));
            }
        }
        if is_free(Parameter::Hardness) && experiment.indentation.hardness.is_none() {
            experiment.indentation.hardness = experiment.hardness_to_start_from(has_no_start(free));
        }
        experiment.reach_contacts();
        if is_free(Parameter::WorkOfAdhesionReceding) {
            let work = experiment.work_of_adhesion;
            experiment.work_of_adhesion_receding.get_or_insert(work);
        }
        if experiment.from_deflection && is_free(Parameter::Stiffness) {
            let reason = "the forces are the deflection times it, by their column or the head of the file: fix it, and state its \
                          standard error";
            return Err(experiment.not_applicable(Parameter::Stiffness, reason));
        }
        for work in Parameter::WORKS {
            // The value of a free parameter does not count; with 0 the points near the end of a branch
            // would be read as those of a contact without adhesion.
            if is_free(work)
                && experiment.get(work) == Some(0.0)
                && experiment.why_without_effect(work).is_none()
            {
                experiment.set(work, f64::MIN_POSITIVE)?;
            }
        }
        let mut works = Parameter::WORKS
            .into_iter()
            .filter_map(|work| experiment.get(work));
        if experiment.has_line_law() && works.all(|work| work == 0.0) {
            let reason = "its work of adhesion is 0: give one, or free it";
            return Err(experiment.not_applicable(Parameter::DoublingSpeed, reason));
        }
        experiment.keep_line_speeds();
        let assignment = experiment.assign(is_free)?;
        assigned.push(Assigned::new(experiment, assignment));
    }
    Ok((assigned, slots))
}

fn accept(options: &Options) -> Result<(), Error> {
    loss::accept(options.loss)?;
    let range = options.interaction_range;
    if !(range > 0.0 && range.is_finite()) {
        let allowed = "positive and finite";
        return Err(Error::setting("the interaction range", range, allowed));
    }
    if options.profile_level.is_some() && !options.known.is_empty() {
        return Err(Error::setting(
            "the number of known errors beside profile-likelihood intervals",
            options.known.len() as f64,
            "0: a profile keeps the known values and holds nothing of their errors; leave the intervals out, or give \
             values that can be free a prior instead",
        ));
    }
    if let Some(level) = options
        .profile_level
        .filter(|level| !(*level > 0.0 && *level < 1.0))
    {
        let name = "the level of profile-likelihood intervals";
        return Err(Error::setting(name, level, "between 0 and 1"));
    }
    Ok(())
}

/// Puts the result together.
fn result(
    found: &Minimum<'_>,
    data: &[Assigned],
    options: &Options,
    intervals: Option<Vec<[profile::End; 2]>>,
    experiments: Vec<FittedExperiment>,
    without_film: Option<WithoutFilm>,
) -> Fit {
    let problem = &found.problem;
    let uncertainty = found.uncertainty.as_ref();
    let mut estimates = estimates(problem, uncertainty);
    for (estimate, ends) in estimates.iter_mut().zip(intervals.iter().flatten()) {
        let [low, high] = *ends;
        let unlimited = if estimate.parameter.is_positive() {
            0.0
        } else {
            f64::NEG_INFINITY
        };
        estimate.profile = Some([low.or(unlimited), high.or(f64::INFINITY)]);
    }
    let residuals = problem.plain_residuals();
    let chi_squared = residuals.map_or(f64::NAN, |residuals| residuals.norm_squared());
    let (degrees_of_freedom, all_given) = freedom(problem);
    let mut fit = Fit {
        converged: found.problem.ending == Ending::Converged,
        evaluations: problem.evaluations.get(),
        estimates,
        correlation: uncertainty.map_or_else(Vec::new, Uncertainty::correlation),
        fixed_values: Vec::new(),
        chi_squared,
        degrees_of_freedom,
        reduced_chi_squared: all_given.then(|| chi_squared / degrees_of_freedom as f64),
        experiments,
        without_film,
        undetermined: uncertainty.map_or_else(Vec::new, |uncertainty| {
            uncertainty.undetermined(&problem.slot_names())
        }),
        loss: options.loss,
        warnings: Vec::new(),
    };
    if let Some(uncertainty) = uncertainty {
        let (known, all) = (&options.known, options.fixed_values);
        fit.fixed_values = fixed_values::effects(problem, uncertainty, known, all);
        fixed_values::pass_on(&mut fit);
    }
    fit.warnings = warnings::warnings(&fit, found, data, options, intervals.as_deref());
    fit.converged &= !(found.is_stopped(FAR) && fit.warns_of(WarningKind::EndOfTable));
    fit
}

/// Returns an experiment as fitted, with the ordinates that the fit without the film predicts.
fn experiment(
    found: &Minimum<'_>,
    e: usize,
    left_out: Vec<LeftOut>,
    without_film: Option<&Problem<'_>>,
) -> Result<FittedExperiment, Error> {
    let problem = &found.problem;
    let assigned = &problem.assigned[e];
    let predicted = problem.predicted.as_ref().map(|all| &all[e]);
    let experiment = &assigned.experiment;
    let measurement = &experiment.measurement;
    let contact = problem.contact(&experiment.bodies, false);
    let contact = contact.ok().filter(|_| experiment.has_line_law());
    let point = |(i, point): (usize, &crate::Point)| {
        let branch = assigned.branches[i];
        let counts = branch != Branch::LeftOut;
        let predicted = predicted.filter(|_| counts);
        let fit = problem.ordinate(e, i);
        let without_film = without_film.and_then(|all| all.ordinate(e, i));
        let speed = experiment.line_speeds.get(i);
        let speed = speed.filter(|one| branch.is_contact() && one.deviation.is_finite());
        let line_speed = speed.map(|one| one.speed);
        let deviation = assigned.deviation(i) * measurement.kind.scale(point.ordinate);
        FittedPoint {
            line: point.line,
            abscissa: point.abscissa,
            ordinate: point.ordinate,
            fit,
            deviation,
            contact_radius: predicted
                .map(|predicted| predicted.radii[i])
                .filter(|&radius| radius > 0.0),
            without_film: without_film.filter(|value| value.is_finite()),
            branch: predicted.map_or(branch, |predicted| predicted.branch(i, branch)),
            line_speed,
            energy_release_rate: line_speed.and_then(|_| {
                let energy = experiment.measured_energy(contact.as_ref()?, point);
                energy.ok()
            }),
            outlier: fit.is_some_and(|fit| (point.ordinate - fit).abs() > OUTLIER * deviation),
        }
    };
    Ok(FittedExperiment {
        name: measurement.name.clone(),
        noise: assigned.noise,
        noise_is_estimated: assigned.experiment.usual_noise().is_none(),
        abscissa_noise: assigned.experiment.usual_abscissa_noise(),
        points: measurement.points.iter().enumerate().map(point).collect(),
        left_out,
        loss: assigned
            .experiment
            .loss_angle(&problem.contact_of(), &assigned.branches)?,
        relaxation: relaxing::of(found, e)?,
    })
}
