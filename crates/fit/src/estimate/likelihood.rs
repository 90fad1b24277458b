//! The likelihood of parameters, for samplers.

use std::f64::consts::TAU;

use interp::Table;

use super::problem::assigned::Assigned;
use super::problem::slot::{Slot, slots_of};
use super::solve::prepare;
use crate::model::contacts_of;
use crate::{Branch, Error, Experiment, Free, Parameter};

/// The logarithm of the likelihood of the free parameters of one or several experiments.
///
/// ```text
/// ln L = -1/2 sum_i ((model_i - ordinate_i) / sigma_i)^2 - sum_i ln(sqrt(2 pi) sigma_i)
/// ```
///
/// The sum is over the points that count, on fixed branches, and over the priors of [`Free`], which
/// are normal. The noise is known and normal. The values are in SI units, in the order of
/// [`Likelihood::parameters`].
#[derive(Clone, Debug)]
pub struct Likelihood {
    assigned: Vec<Assigned>,
    slots: Vec<Slot>,
    /// The least and the largest value of each slot.
    limits: Vec<[f64; 2]>,
    /// `-sum ln(sqrt(2 pi) sigma)`.
    constant: f64,
}

impl Likelihood {
    /// Takes the measurements with their noise, and the free parameters.
    ///
    /// `branches` holds the branch of each point of each experiment, such as those of a fit; `None`
    /// reads them from the data, as [`fit`](crate::fit) does before it leaves out points near the end
    /// of a branch. Errors of the abscissae are weighed by the slope of the model at the values of
    /// the experiments, and these weights stay.
    ///
    /// # Errors
    /// As [`fit`](crate::fit), and [`Error::Setting`] for an experiment without a noise, or with
    /// another number of branches than points.
    pub fn new(
        table: &Table,
        experiments: &[Experiment],
        free: &[Free],
        branches: Option<&[Vec<Branch>]>,
    ) -> Result<Self, Error> {
        for experiment in experiments {
            experiment.known_noise()?;
        }
        let (mut assigned, slots) = prepare(experiments, free)?;
        if let Some(branches) = branches {
            accept_lengths(branches, &assigned)?;
            for (own, given) in assigned.iter_mut().zip(branches) {
                own.branches = given.iter().map(|branch| branch.of_contact()).collect();
            }
        }
        for own in &mut assigned {
            own.weigh(&contacts_of(table))?;
        }
        let deviations = assigned
            .iter()
            .flat_map(|own| own.counting_points().map(|i| own.deviation(i)));
        let widths = slots.iter().filter_map(|slot| Some(slot.prior?.width));
        let constant = deviations.chain(widths).map(|one| -(TAU.sqrt() * one).ln());
        Ok(Self {
            constant: constant.sum(),
            limits: slots.iter().map(limits).collect(),
            assigned,
            slots,
        })
    }

    /// Lists the parameters in the order of the values, each with the number of the experiment to
    /// which it belongs; `None` is shared by all.
    pub fn parameters(&self) -> impl Iterator<Item = (Parameter, Option<usize>)> {
        self.slots
            .iter()
            .map(|slot| (slot.parameter, slot.experiment))
    }

    /// Computes the logarithm of the likelihood at values.
    ///
    /// It is negative infinity where there is none: outside the bounds, for a value that is not
    /// positive and must be, for one that is not finite, and where there is no contact, such as
    /// outside the table.
    ///
    /// # Errors
    /// [`Error::Setting`] for another number of values than parameters.
    pub fn value(&self, table: &Table, values: &[f64]) -> Result<f64, Error> {
        self.accept(values)?;
        Ok(self
            .evaluate(table, values, None)
            .unwrap_or(f64::NEG_INFINITY))
    }

    /// Computes the logarithm of the likelihood at values, and its derivatives with respect to them,
    /// exact or by central differences as those of [`Experiment::predictions`]. They are NaN where the
    /// likelihood is 0.
    ///
    /// # Errors
    /// As [`Likelihood::value`].
    pub fn value_and_gradient(
        &self,
        table: &Table,
        values: &[f64],
    ) -> Result<(f64, Vec<f64>), Error> {
        self.accept(values)?;
        let mut gradient = vec![0.0; values.len()];
        match self.evaluate(table, values, Some(&mut gradient)) {
            Some(value) => Ok((value, gradient)),
            None => Ok((f64::NEG_INFINITY, vec![f64::NAN; values.len()])),
        }
    }

    fn accept(&self, values: &[f64]) -> Result<(), Error> {
        if values.len() == self.slots.len() {
            return Ok(());
        }
        let names = Parameter::names(self.slots.iter().map(|slot| slot.parameter));
        let allowed = format!("{}, one for each of {names}", self.slots.len());
        let found = values.len() as f64;
        Err(Error::setting("the number of values", found, allowed))
    }

    /// Computes the logarithm of the likelihood, and adds its derivatives to `gradient`; `None`
    /// where there is none.
    fn evaluate(
        &self,
        table: &Table,
        values: &[f64],
        mut gradient: Option<&mut [f64]>,
    ) -> Option<f64> {
        let within = |(value, [least, most]): (&f64, &[f64; 2])| {
            (*least..=*most).contains(value) && value.is_finite()
        };
        if !values.iter().zip(&self.limits).all(within) {
            return None;
        }
        let mut squares = 0.0;
        for (e, own) in self.assigned.iter().enumerate() {
            let slots = slots_of(&self.slots, e, &own.experiment);
            let parameters = slots.iter().map(|&slot| self.slots[slot].parameter);
            let mut parameters: Vec<Parameter> = parameters.collect();
            let mut experiment = own.experiment.clone();
            for (&slot, &parameter) in slots.iter().zip(&parameters) {
                experiment.replace(parameter, values[slot]).ok()?;
            }
            if gradient.is_none() {
                parameters.clear();
            }
            let predicted = experiment
                .predict_with(&contacts_of(table), &own.branches, &own.order, &parameters)
                .ok()?;
            for i in own.counting_points() {
                let deviation = own.deviation(i);
                let residual = (predicted.values[i] - experiment.compared(i)) / deviation;
                squares += residual * residual;
                if let Some(gradient) = gradient.as_deref_mut() {
                    let row = &predicted.derivatives[i * slots.len()..][..slots.len()];
                    for (&slot, by) in slots.iter().zip(row) {
                        gradient[slot] -= residual * by / deviation;
                    }
                }
            }
        }
        for (slot, of) in self.slots.iter().enumerate() {
            let Some(prior) = of.prior else { continue };
            let residual = (values[slot] - prior.mean) / prior.width;
            squares += residual * residual;
            if let Some(gradient) = gradient.as_deref_mut() {
                gradient[slot] -= residual / prior.width;
            }
        }
        let value = self.constant - 0.5 * squares;
        let gradient_is_finite = gradient.is_none_or(|all| all.iter().all(|one| one.is_finite()));
        (value.is_finite() && gradient_is_finite).then_some(value)
    }
}

/// Returns the least and the largest value of a slot.
fn limits(slot: &Slot) -> [f64; 2] {
    slot.bounds.unwrap_or(match slot.parameter {
        Parameter::FilmPoissonRatio => [0.0, 0.5],
        parameter if parameter.is_positive() => [f64::MIN_POSITIVE, f64::MAX],
        _ => [f64::MIN, f64::MAX],
    })
}

/// Accepts branches for each point of each experiment.
fn accept_lengths(branches: &[Vec<Branch>], assigned: &[Assigned]) -> Result<(), Error> {
    let accept = |name: &str, found: usize, wanted: usize| {
        let allowed = format!("{wanted}, as many as there are");
        let wrong = || Error::setting(name, found as f64, allowed);
        (found == wanted).then_some(()).ok_or_else(wrong)
    };
    let name = "the number of experiments with branches";
    accept(name, branches.len(), assigned.len())?;
    let mut pairs = branches.iter().zip(assigned);
    pairs.try_for_each(|(given, own)| {
        let measurement = &own.experiment.measurement;
        let name = format!("the number of branches of {}", measurement.name);
        accept(&name, given.len(), own.branches.len())
    })
}
