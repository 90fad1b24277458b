//! What the values that a fit takes as given do to its result.
//!
//! At the minimum `J^T r = 0`. A change of a given value changes the residuals by `dr`, and the
//! values found by `-(J^T J)^-1 J^T dr`, to the first order and without the second derivatives of
//! the model: the implicit function theorem with the matrix of Gauss and Newton. A robust loss puts
//! the derivative of its influence between the factors.

use nalgebra::DVector;

use super::problem::Problem;
use super::problem::assigned::Assigned;
use super::problem::blocks::svd;
use super::problem::loss::influence;
use super::problem::no_adhesion;
use super::problem::slot::Slot;
use super::problem::uncertainty::Uncertainty;
use super::result::each_once;
use crate::model::contacts_of;
use crate::{Error, Experiment, Fit, Fixed, Known};

/// The relative change of a given value, and the change of a Poisson ratio, whose effect is told.
const STEP: f64 = 0.01;
/// The change of a zero or drift of what is read as abscissa, over the largest one: some pixels of a picture.
const OF_READINGS: f64 = 0.005;
/// The part of this change with which contacts are made, because only small changes have effects in proportion: on a
/// thin film at a Poisson ratio of 0.5 the slope over 0.01 is a third less than that at 0.5.
const PART: f64 = 0.01;
/// The ratio of two singular values at which a direction does not respond.
const SINGULAR: f64 = 1e-9;

/// What a value that the fit takes as given does to the values found.
#[derive(Clone, Debug, PartialEq)]
pub struct FixedValue {
    /// The value taken as given.
    pub quantity: Fixed,
    /// The number, in SI units: that of the first measurement, if they differ.
    pub value: f64,
    /// The numbers of all measurements that have one, in their order, if they differ; else empty.
    pub values: Vec<f64>,
    /// A change of it: 1 %, 0.01 of a Poisson ratio, or of a zero its known error or the noise of a reading, of the zero of contact
    /// radii 0.5 % of the largest, and of a drift what moves positions by 0.5 % of their range. Where the
    /// value is at the end of what is possible, as a Poisson ratio of 0.5, it goes to the other side.
    pub step: f64,
    /// The change of each estimate that follows, in SI units and in their order: to the first order, as
    /// if the effect of a small change grew in proportion. NaN where the change leads to no contact.
    pub changes: Vec<f64>,
    /// The standard error of the value, if it is [`Known`](crate::Known).
    pub error: Option<f64>,
}

impl FixedValue {
    /// Returns the standard error of an estimate that follows from that of the value; 0 without one.
    pub fn error_of(&self, estimate: usize) -> f64 {
        let by = |error: f64| (self.changes[estimate] / self.step).abs() * error;
        self.error.map_or(0.0, by)
    }
}

/// Accepts what is known of given values.
pub(super) fn accept(assigned: &[Assigned], slots: &[Slot], known: &[Known]) -> Result<(), Error> {
    for (i, Known { quantity, error }) in known.iter().enumerate() {
        let name = format!("the known {}", quantity.name());
        if !(*error > 0.0 && error.is_finite()) {
            let name = format!("the standard error of {name}");
            return Err(Error::setting(name, *error, "positive and finite"));
        }
        let has_effect = |one: &Assigned| match quantity {
            Fixed::Parameter(zero) if !zero.is_positive() => {
                one.experiment.why_without_effect(*zero).is_none()
            }
            _ => true,
        };
        let experiments = assigned.iter().map(|one| &one.experiment);
        let mut values = experiments
            .clone()
            .filter_map(|one| one.value_of(*quantity));
        // A body that is rigid in one measurement may not be in another.
        let finite = values.clone().find(|value| value.is_finite());
        let Some(first) = finite.or_else(|| values.next()) else {
            let allowed = match quantity {
                Fixed::Scale(_) | Fixed::ContactRadiusZero => "of a quantity that is read",
                Fixed::PositionDrift => "of penetrations or heights that have times",
                _ => "of a value that the measurement has: check its name and the bodies",
            };
            return Err(Error::setting(name, f64::NAN, allowed));
        };
        let is_free = |parameter| slots.iter().any(|slot| slot.parameter == parameter);
        let mut apart = experiments
            .clone()
            .map(|one| own_value(experiments.clone(), one, *quantity));
        let refused = if apart.all(|value| value.is_none()) {
            Some(
                "left out: the sample is of the material of the substrate; give the error of the substrate, which counts for both",
            )
        } else if !assigned.iter().any(has_effect) {
            Some("of a value that has an effect on these measurements: leave its error out")
        } else if first.is_infinite() {
            Some("finite, and this body is rigid: leave its error out, or give the body a modulus")
        } else if quantity.parameter().is_some_and(is_free) {
            Some("of a value that is not free: give a free one a prior instead")
        } else if known[..i].iter().any(|before| before.quantity == *quantity) {
            Some("given once")
        } else {
            None
        };
        if let Some(allowed) = refused {
            return Err(Error::setting(name, first, allowed));
        }
        let is_scale = match quantity {
            Fixed::Parameter(parameter) => {
                parameter.is_positive() && !parameter.is_work_of_adhesion()
            }
            quantity => quantity.errs_in_proportion(),
        };
        if is_scale && *error > first {
            let name = format!("the standard error of {name}");
            let allowed = match quantity {
                Fixed::Scale(_) => "at most 1, a part of the readings: 0.02 is 2 %".to_owned(),
                _ => format!(
                    "at most its value, {first:?} {}: give it in this unit, and not as a part of the value",
                    quantity.unit()
                ),
            };
            return Err(Error::setting(name, *error, allowed));
        }
        if let Some(largest) = largest_move(experiments, *quantity)
            && *error > largest
        {
            let name = format!("the standard error of {name}");
            let (read, unit) = match quantity {
                Fixed::ContactRadiusZero => ("the largest contact radius", "m"),
                _ => ("the range of the positions over the duration", "m/s"),
            };
            let allowed = format!("at most {read}, {largest:?} {unit}: check its unit");
            return Err(Error::setting(name, *error, allowed));
        }
    }
    Ok(())
}

/// Returns the largest [`Experiment::largest_move`].
fn largest_move<'e>(
    experiments: impl Iterator<Item = &'e Experiment>,
    quantity: Fixed,
) -> Option<f64> {
    let moves = experiments.filter_map(|one| one.largest_move(quantity));
    moves.reduce(f64::max)
}

/// Refuses a known error of a value that cannot vary: it would make the standard errors NaN.
pub(super) fn accept_changes(values: &[FixedValue]) -> Result<(), Error> {
    let cannot_vary =
        |one: &&FixedValue| one.error.is_some() && one.changes.iter().any(|change| change.is_nan());
    values.iter().find(cannot_vary).map_or(Ok(()), |one| {
        let name = format!("the known {}", one.quantity.name());
        let allowed = "of a value that can vary, and contacts with a little more or less of this one are not solved: \
                       it is that of a table, or full friction needs it as it is, or it is at the end of what is \
                       solved; leave its error out";
        Err(Error::setting(name, one.value, allowed))
    })
}

/// Returns what changes of given values do: of those `known`, and of all that matter if `all` are
/// asked for.
pub(super) fn effects(
    problem: &Problem<'_>,
    uncertainty: &Uncertainty,
    known: &[Known],
    all: bool,
) -> Vec<FixedValue> {
    let free: Vec<_> = problem.slots.iter().map(|slot| slot.parameter).collect();
    let given = known.iter().map(|one| one.quantity);
    let listed = problem.experiments().filter(|_| all);
    let listed = listed.flat_map(|one| one.fixed(&free));
    let quantities = each_once(listed.chain(given));
    let Some(response) = response(problem, uncertainty) else {
        return Vec::new();
    };
    let effect = |quantity: Fixed| {
        let value_of = |one: &Experiment| own_value(problem.experiments(), one, quantity);
        let mut values: Vec<f64> = problem.experiments().filter_map(value_of).collect();
        // One that is rigid does not change.
        let value = values.iter().copied().find(|value| value.is_finite())?;
        if values.iter().all(|own| *own == value) {
            values.clear();
        }
        let error = known.iter().find(|one| one.quantity == quantity);
        let error = error.map(|one| one.error);
        let is_relative = quantity.errs_in_proportion() && value != 0.0;
        let step = match error {
            // No Poisson ratio is above 0.5.
            _ if quantity.is_poisson_ratio() && value + STEP > 0.5 => -STEP,
            _ if quantity.is_poisson_ratio() => STEP,
            _ if is_relative => STEP * value.abs(),
            Some(error) => error,
            None if quantity.moves_readings() => {
                OF_READINGS * largest_move(problem.experiments(), quantity)?
            }
            // A zero is known to some noise of the readings whose zero it is.
            None => {
                let mut assigned = problem.assigned.iter();
                let is_zero = |one: &&Assigned| one.experiment.is_zero_of_ordinates(quantity);
                assigned.find(is_zero)?.noise
            }
        };
        let moved = |step: f64| {
            let by = PART * step;
            // Several measurements may have values of their own.
            residuals_of(problem, |experiment| {
                let Some(own) = value_of(experiment) else {
                    return Ok(());
                };
                let change = if is_relative { by / value * own } else { by };
                experiment.replace_fixed(quantity, own + change)
            })
        };
        let here = problem.plain_residuals()?;
        let one_sided = |step: f64, near: DVector<f64>| {
            let far = moved(2.0 * step)?;
            Some((4.0 * near - far - 3.0 * &here) / (2.0 * PART))
        };
        let (step, change) = match (moved(step), moved(-step)) {
            (Some(above), Some(below)) => (step, Some((above - below) / (2.0 * PART))),
            (None, Some(below)) => (-step, one_sided(-step, below)),
            (Some(above), None) => (step, one_sided(step, above)),
            (None, None) => (step, None),
        };
        let unknown = || vec![f64::NAN; problem.slots.len()];
        let changes = change.as_ref().map_or_else(unknown, &response);
        Some(FixedValue {
            quantity,
            value,
            values,
            step,
            changes,
            error,
        })
    };
    quantities.into_iter().filter_map(effect).collect()
}

/// Returns the value of a quantity of `one` of the experiments, if it has an effect of its own. The base of a bare sample
/// is of the material of the substrate that others have, or else a reference.
fn own_value<'e>(
    mut experiments: impl Iterator<Item = &'e Experiment>,
    one: &Experiment,
    quantity: Fixed,
) -> Option<f64> {
    let value = one.value_of(quantity)?;
    let substrate = match quantity {
        Fixed::SubstrateModulus | Fixed::ReferenceModulus => Fixed::SubstrateModulus,
        Fixed::SubstratePoissonRatio | Fixed::ReferencePoissonRatio => Fixed::SubstratePoissonRatio,
        _ => return Some(value),
    };
    let of_others = experiments.find_map(|other| {
        other
            .value_of(substrate)
            .filter(|_| !other.bodies.are_bare())
    });
    let is_reference = one.bodies.are_bare() && of_others.is_some_and(|other| other != value);
    (is_reference == (quantity != substrate)).then_some(value)
}

/// Adds the errors of known values to the standard errors and the correlation.
pub(super) fn pass_on(fit: &mut Fit) {
    let known = fit.fixed_values.iter().filter(|one| one.error.is_some());
    let known: Vec<&FixedValue> = known.collect();
    if known.is_empty() {
        return;
    }
    let before: Vec<f64> = fit.estimates.iter().map(|one| one.standard_error).collect();
    let covariance = |i: usize, j: usize| {
        let of_known = |one: &&FixedValue| {
            let sign = (one.changes[i] * one.changes[j]).signum();
            sign * one.error_of(i) * one.error_of(j)
        };
        fit.correlation[i][j] * before[i] * before[j] + known.iter().map(of_known).sum::<f64>()
    };
    let count = before.len();
    let covariance: Vec<Vec<f64>> = (0..count)
        .map(|i| (0..count).map(|j| covariance(i, j)).collect())
        .collect();
    let errors: Vec<f64> = (0..count).map(|i| covariance[i][i].sqrt()).collect();
    let without_film = fit.without_film.as_mut();
    let mut estimates = fit.estimates.iter();
    if let Some(bias) = without_film.and_then(|one| one.modulus.as_mut())
        && let Some(i) = estimates.position(|one| one.parameter == bias.parameter)
    {
        bias.standard_errors *= before[i] / errors[i];
    }
    let estimates = fit.estimates.iter_mut().zip(&mut fit.correlation);
    for (i, (estimate, row)) in estimates.enumerate() {
        estimate.standard_error = errors[i];
        for (j, entry) in row.iter_mut().enumerate() {
            *entry = (covariance[i][j] / (errors[i] * errors[j])).clamp(-1.0, 1.0);
        }
    }
}

/// Returns the residuals of experiments that `change` changes, at the same values of the slots; `None` where there is no
/// contact.
pub(super) fn residuals_of(
    problem: &Problem<'_>,
    change: impl Fn(&mut Experiment) -> Result<(), contact::Error>,
) -> Option<DVector<f64>> {
    let mut residuals = problem.plain_residuals()?;
    for (assigned, rows) in problem.assigned.iter().zip(problem.rows_of_experiments()) {
        let mut experiment = assigned.experiment.clone();
        change(&mut experiment).ok()?;
        if experiment != assigned.experiment {
            let contact_of = contacts_of(problem.table);
            let predicted = assigned.predict(&experiment, &contact_of, &[]).ok()?;
            for (row, i) in rows.zip(assigned.counting_points()) {
                residuals[row] =
                    (predicted.values[i] - experiment.compared(i)) / assigned.deviation(i);
            }
        }
    }
    let are_finite = residuals.iter().all(|residual| residual.is_finite());
    are_finite.then_some(residuals)
}

/// Returns how the values found follow a change of the residuals, in SI units: by `-(J^T P J)^-1 J^T P`, with the
/// derivatives `P` of the influence of each residual.
fn response<'u>(
    problem: &Problem<'_>,
    uncertainty: &'u Uncertainty,
) -> Option<impl Fn(&DVector<f64>) -> Vec<f64> + use<'u>> {
    let residuals = problem.plain_residuals()?;
    let roots = residuals.map(|residual| influence(problem.loss, residual).1.max(0.0).sqrt());
    let mut weighted = uncertainty.jacobian.clone();
    for (mut row, root) in weighted.row_iter_mut().zip(roots.iter()) {
        row *= *root;
    }
    let mut lengths: Vec<f64> = weighted.column_iter().map(|column| column.norm()).collect();
    let ended = no_adhesion::ended_at_zero(problem);
    for (i, slot) in problem.slots.iter().enumerate() {
        // A value at its bound stays there, and a work of adhesion that ended at 0, as in the standard errors.
        let stays = slot.coordinate.is_at_bound(problem.value(i)) || ended.contains(&i);
        if stays || lengths[i] == 0.0 {
            weighted.column_mut(i).fill(0.0);
            lengths[i] = 1.0;
        }
        weighted.column_mut(i).unscale_mut(lengths[i]);
    }
    let mut matrix = svd(weighted, &uncertainty.blocks)
        .pseudo_inverse(SINGULAR)
        .ok()?;
    for (mut column, root) in matrix.column_iter_mut().zip(roots.iter()) {
        column *= *root;
    }
    for (mut row, length) in matrix.row_iter_mut().zip(&lengths) {
        row /= *length;
    }
    Some(move |change: &DVector<f64>| {
        let changes = -&matrix * change;
        let changes = changes.iter().zip(&uncertainty.sizes);
        changes.map(|(change, size)| change * size).collect()
    })
}
