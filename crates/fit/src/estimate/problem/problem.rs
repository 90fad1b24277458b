//! The least-squares problem: the data with the present values, residuals and derivatives.

use std::borrow::Cow;
use std::cell::{Cell, RefCell};
use std::ops::Range;
use std::rc::Rc;

use contact::Contact;
use interp::Table;
use nalgebra::{DMatrix, DVector};

use super::assigned::Assigned;
use super::basin::Basin;
use super::loss::weighted;
use super::slot::{Slot, slots_of};
use crate::model::{Predicted, ends_of_radii};
use crate::statistics::LARGEST;
use crate::{Bodies, Branch, Error, Experiment, Loss, Parameter};

/// The parameters to be found, at their present values, with the data.
#[derive(Clone)]
pub(crate) struct Problem<'a> {
    pub table: &'a Table,
    pub assigned: Vec<Assigned>,
    pub slots: Vec<Slot>,
    pub loss: Loss,
    /// The coordinates of the slots.
    pub x: DVector<f64>,
    /// The predictions, with the derivatives with respect to the slots where the bodies have exact ones;
    /// `None` if there is no contact with these parameters.
    pub predicted: Option<Vec<Predicted>>,
    /// How the last minimisation ended.
    pub ending: Ending,
    /// The number of evaluations, of all copies of the problem.
    pub evaluations: Rc<Cell<usize>>,
    /// Whether the last minimisation met parameters without a contact, such as those outside the
    /// table.
    pub refused: bool,
    /// Whether contacts were refused because the table ends before them.
    pub beyond_table: bool,
    /// Where a minimisation stops, because it leads to a minimum that is known.
    pub known: Rc<[Basin]>,
    /// The contacts made last, and whether they have derivatives.
    contacts: RefCell<Vec<(Bodies, bool, Contact)>>,
}

/// How a fit ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Ending {
    Converged,
    /// The most evaluations allowed were made.
    OutOfPatience,
    /// The method stopped for another reason.
    Failed,
    /// It leads to a minimum that is known.
    Known,
}

impl<'a> Problem<'a> {
    /// Starts from the coordinates' own starts.
    pub fn new(
        table: &'a Table,
        assigned: Vec<Assigned>,
        slots: Vec<Slot>,
        loss: Loss,
    ) -> Result<Self, Error> {
        let x = DVector::from_iterator(
            slots.len(),
            slots.iter().map(|slot| slot.coordinate.first()),
        );
        let mut problem = Self {
            table,
            assigned,
            slots,
            loss,
            x,
            predicted: None,
            ending: Ending::Converged,
            evaluations: Rc::default(),
            refused: false,
            beyond_table: false,
            known: Rc::new([]),
            contacts: RefCell::new(Vec::new()),
        };
        problem.update()?;
        Ok(problem)
    }

    /// Returns the present value of a slot.
    pub fn value(&self, slot: usize) -> f64 {
        self.slots[slot].coordinate.value(self.x[slot])
    }

    /// Takes over the coordinates of another problem, at the present values.
    pub fn with_slots_of(mut self, other: &Self) -> Result<Self, Error> {
        let values: Vec<f64> = (0..self.slots.len()).map(|slot| self.value(slot)).collect();
        self.slots.clone_from(&other.slots);
        for (i, value) in values.into_iter().enumerate() {
            self.x[i] = self.slots[i].coordinate.of(value);
        }
        self.update()?;
        Ok(self)
    }

    /// Returns the experiments with the present values.
    pub fn experiments(&self) -> impl Iterator<Item = &Experiment> + Clone {
        self.assigned.iter().map(|one| &one.experiment)
    }

    /// Returns the names of the values to be found.
    pub fn slot_names(&self) -> Vec<String> {
        let name = |slot: &Slot| match slot.experiment {
            Some(e) if self.assigned.len() > 1 => format!(
                "{} of {}",
                slot.parameter, self.assigned[e].experiment.measurement.name
            ),
            _ => slot.parameter.to_string(),
        };
        self.slots.iter().map(name).collect()
    }

    /// Returns the first slot of a parameter.
    pub fn slot_of(&self, parameter: Parameter) -> Option<usize> {
        self.slots
            .iter()
            .position(|slot| slot.parameter == parameter)
    }

    /// Returns the numbers of the slots that are of an experiment.
    pub fn slots_of(&self, experiment: usize) -> Vec<usize> {
        slots_of(
            &self.slots,
            experiment,
            &self.assigned[experiment].experiment,
        )
    }

    /// Gives the experiments the present values, and predicts their points.
    pub fn update(&mut self) -> Result<(), Error> {
        self.predicted = None;
        self.evaluations.set(self.evaluations.get() + 1);
        for e in 0..self.assigned.len() {
            for slot in self.slots_of(e) {
                let (parameter, value) = (self.slots[slot].parameter, self.value(slot));
                self.assigned[e].experiment.replace(parameter, value)?;
            }
        }
        let predicted: Result<Vec<_>, _> = (0..self.assigned.len())
            .map(|e| self.predict_now(e))
            .collect();
        self.predicted = Some(predicted?);
        Ok(())
    }

    /// Predicts the points of an experiment at its present values. The derivatives are predicted at
    /// once where they are exact, because nearly every value is one to go on from.
    fn predict_now(&self, experiment: usize) -> Result<Predicted, Error> {
        let own = &self.assigned[experiment].experiment;
        if !own.bodies.are_layered() && !own.measurement.kind.is_stiffness() {
            let parameters = self.parameters_of(experiment);
            // There may be a contact without derivatives.
            if let Ok(predicted) = self.predict(experiment, &parameters) {
                return Ok(predicted);
            }
        }
        self.predict(experiment, &[])
    }

    /// Returns the parameters of the slots that are of an experiment, in their order.
    pub fn parameters_of(&self, experiment: usize) -> Vec<Parameter> {
        let slots = self.slots_of(experiment).into_iter();
        slots.map(|slot| self.slots[slot].parameter).collect()
    }

    /// Predicts the points of an experiment, with derivatives with respect to `parameters`.
    pub fn predict(&self, experiment: usize, parameters: &[Parameter]) -> Result<Predicted, Error> {
        let own = &self.assigned[experiment];
        own.predict(&own.experiment, &self.contact_of(), parameters)
    }

    /// Returns the fitted ordinate of a point; `None` for one that is left out, and without a contact.
    pub fn ordinate(&self, e: usize, i: usize) -> Option<f64> {
        let one = &self.assigned[e];
        let value = self.predicted.as_ref()?[e].values[i];
        (one.branches[i] != Branch::LeftOut).then(|| one.experiment.ordinate_of(value))
    }

    /// Returns the smallest and the largest fitted contact radius (m) of experiment `e`: infinity and 0
    /// without contacts.
    pub fn contact_radii(&self, e: usize) -> Option<[f64; 2]> {
        let radii = &self.predicted.as_ref()?[e].radii;
        let counting = self.assigned[e].counting_points().map(|i| radii[i]);
        Some(ends_of_radii(counting))
    }

    /// Returns the contact of bodies, with the derivatives with respect to the slots if they are asked
    /// for. It is a new one only if the bodies are new.
    pub fn contact(&self, bodies: &Bodies, gradient: bool) -> Result<Contact, Error> {
        let mut contacts = self.contacts.borrow_mut();
        let known = contacts
            .iter()
            .find(|(known, has_gradient, _)| known == bodies && *has_gradient >= gradient);
        if let Some((_, _, contact)) = known {
            return Ok(contact.clone());
        }
        let by = self.slots.iter().filter(|_| gradient);
        let by: Vec<Parameter> = by.map(|slot| slot.parameter).collect();
        let contact = bodies.contact(self.table, &by)?;
        // On layers the derivatives need two more contacts for each value.
        let most = if bodies.are_layered() {
            2 * (1 + self.slots.len())
        } else {
            2
        };
        if contacts.len() >= most * self.assigned.len() {
            contacts.remove(0);
        }
        contacts.push((bodies.clone(), gradient, contact.clone()));
        Ok(contact)
    }

    /// Makes contacts as [`Self::contact`] does.
    pub fn contact_of(&self) -> impl Fn(&Bodies, &[Parameter]) -> Result<Contact, Error> {
        |bodies, by| self.contact(bodies, !by.is_empty())
    }

    /// Takes the errors of the abscissae by the slopes of the present model. Returns the largest
    /// relative change of the deviation of a point that counts.
    pub fn weigh(&mut self) -> Result<f64, Error> {
        let (mut largest, mut moved) = (0.0_f64, false);
        for e in 0..self.assigned.len() {
            let mut own = self.assigned[e].clone();
            own.weigh(&self.contact_of())?;
            moved |= own.experiment.measurement.kind.at_radii()
                && (own.experiment.usual_abscissa_noise() > 0.0 || own.experiment.has_line_law());
            for i in own.counting_points() {
                let ratio = own.deviation(i) / self.assigned[e].deviation(i);
                largest = largest.max((ratio - 1.0).abs());
            }
            self.assigned[e] = own;
        }
        if moved {
            self.update()?;
        }
        Ok(largest)
    }

    /// Returns the rows of the residuals that each experiment has.
    pub fn rows_of_experiments(&self) -> Vec<Range<usize>> {
        let mut end = 0;
        let rows = |one: &Assigned| {
            let begin = end;
            end += one.counting();
            begin..end
        };
        self.assigned.iter().map(rows).collect()
    }

    /// Returns the number of points that count.
    pub fn counting(&self) -> usize {
        self.assigned.iter().map(Assigned::counting).sum()
    }

    /// Returns the number of points that count and of priors.
    pub fn residual_count(&self) -> usize {
        let priors = self.slots.iter().filter(|slot| slot.prior.is_some());
        self.counting() + priors.count()
    }

    /// Returns the residuals of the points that count, model less data, in units of the noise, and
    /// those of the priors.
    pub fn plain_residuals(&self) -> Option<DVector<f64>> {
        self.residuals_in(Assigned::deviation)
    }

    /// Returns [`Self::plain_residuals`] in units of the standard deviation of each point alone.
    pub fn residuals_alone(&self) -> Option<DVector<f64>> {
        self.residuals_in(Assigned::deviation_alone)
    }

    /// Returns the residuals in units of a deviation of each point, and those of the priors.
    fn residuals_in(&self, deviation: fn(&Assigned, usize) -> f64) -> Option<DVector<f64>> {
        let predicted = self.predicted.as_ref()?;
        let mut residuals = Vec::with_capacity(self.counting() + self.slots.len());
        for (assigned, predicted) in self.assigned.iter().zip(predicted) {
            for i in assigned.counting_points() {
                let difference = predicted.values[i] - assigned.experiment.compared(i);
                residuals.push(difference / deviation(assigned, i));
            }
        }
        residuals.extend(self.slots.iter().enumerate().filter_map(|(slot, of)| {
            let prior = of.prior?;
            Some((self.value(slot) - prior.mean) / prior.width)
        }));
        let all_finite = residuals.iter().all(|residual| residual.abs() < LARGEST);
        all_finite.then(|| DVector::from_vec(residuals))
    }

    /// Returns the derivatives of [`Self::plain_residuals`] with respect to the values of the
    /// slots.
    pub fn plain_jacobian(&self) -> Option<DMatrix<f64>> {
        let height = self.residual_count();
        // Column by column, as the matrix stores them.
        let mut entries = vec![0.0; height * self.slots.len()];
        let mut row = 0;
        for (e, assigned) in self.assigned.iter().enumerate() {
            let slots = self.slots_of(e);
            let known = self.predicted.as_ref().map(|all| &all[e]);
            let known = known.filter(|one| one.derivatives.len() == one.values.len() * slots.len());
            let predicted = match known {
                Some(known) => Cow::Borrowed(known),
                None => Cow::Owned(self.predict(e, &self.parameters_of(e)).ok()?),
            };
            for i in assigned.counting_points() {
                let derivatives = &predicted.derivatives[i * slots.len()..][..slots.len()];
                let deviation = assigned.deviation(i);
                for (&slot, derivative) in slots.iter().zip(derivatives) {
                    entries[height * slot + row] = derivative / deviation;
                }
                row += 1;
            }
        }
        for (slot, of) in self.slots.iter().enumerate() {
            if let Some(prior) = of.prior {
                entries[height * slot + row] = 1.0 / prior.width;
                row += 1;
            }
        }
        let all_finite = entries.iter().all(|derivative| derivative.abs() < LARGEST);
        all_finite.then(|| DMatrix::from_vec(height, self.slots.len(), entries))
    }

    /// Returns the derivatives of [`Self::plain_residuals`] with respect to the values in units of
    /// their sizes, and these sizes.
    pub fn jacobian_of_sizes(&self) -> Option<(DMatrix<f64>, Vec<f64>)> {
        let mut jacobian = self.plain_jacobian()?;
        let sizes: Vec<f64> = (0..self.slots.len())
            .map(|slot| self.slots[slot].coordinate.size(self.value(slot)))
            .collect();
        for (mut column, size) in jacobian.column_iter_mut().zip(&sizes) {
            column *= *size;
        }
        Some((jacobian, sizes))
    }

    /// Returns [`Self::plain_residuals`], weighted by the loss.
    pub fn weighted_residuals(&self) -> Option<DVector<f64>> {
        let weigh = |residual| weighted(self.loss, residual).0;
        Some(self.plain_residuals()?.map(weigh))
    }

    /// Returns the derivatives of [`Self::weighted_residuals`] with respect to the coordinates.
    pub fn weighted_jacobian(&self) -> Option<DMatrix<f64>> {
        let residuals = self.plain_residuals()?;
        let mut jacobian = self.plain_jacobian()?;
        // The weights of squares are 1.
        if self.loss != Loss::Squares {
            for (mut row, residual) in jacobian.row_iter_mut().zip(residuals.iter()) {
                row *= weighted(self.loss, *residual).1;
            }
        }
        for (slot, mut column) in jacobian.column_iter_mut().enumerate() {
            column *= self.slots[slot].coordinate.slope(self.x[slot]);
        }
        Some(jacobian)
    }

    /// Returns the problem without a slot, at a fixed value of it; `None` if it has no contact
    /// there.
    pub fn with_fixed(&self, slot: usize, value: f64) -> Option<Self> {
        let mut fixed = self.clone();
        let removed = fixed.slots.remove(slot);
        fixed.x = self.x.clone().remove_row(slot);
        for (e, assigned) in fixed.assigned.iter_mut().enumerate() {
            if removed.experiment.is_none_or(|own| own == e) {
                assigned.experiment.replace(removed.parameter, value).ok()?;
            }
        }
        fixed.update().ok()?;
        Some(fixed)
    }

    /// Returns twice the loss of the present residuals; infinity without a contact.
    pub fn misfit(&self) -> f64 {
        self.weighted_residuals()
            .map_or(f64::INFINITY, |residuals| residuals.norm_squared())
    }
}
