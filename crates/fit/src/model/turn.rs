//! The turn from approach to retract under adhesion hysteresis.

use contact::{Contact, Derivatives, Input, State};
use interp::Probe;

use super::predicted::Predicted;
use super::{Branch, Experiment, Parameter};

/// The contact at the turn from approach to retract, in which the line stays until the energy
/// release rate reaches the receding work of adhesion.
pub(super) struct Turn {
    pub(super) state: State,
    /// Load and penetration without a singularity at the edge, and the stiffness.
    adhesionless: [f64; 2],
    stiffness: f64,
    /// The derivatives of the contact radius with respect to the parameters asked for.
    radius: Vec<f64>,
}

impl Experiment {
    /// Returns the contact at the turn, if the receding work of adhesion is the larger one.
    pub(super) fn turn(
        &self,
        contact: &Contact,
        branches: &[Branch],
        order: &[usize],
        columns: &[Parameter],
    ) -> Result<Option<Turn>, contact::Error> {
        if matches!(self.bodies.probe(), Probe::FlatPunch { .. }) {
            // Its contact is as wide as the punch in any state.
            return Ok(None);
        }
        let w = self.work_of_adhesion;
        let is_hysteretic = self
            .work_of_adhesion_receding
            .is_some_and(|receding| receding > w);
        let both = [Branch::Advancing, Branch::Receding].map(|branch| branches.contains(&branch));
        let Some(&largest) = order.first().filter(|_| is_hysteretic && both == [true; 2]) else {
            return Ok(None);
        };
        let control = self.control();
        let value = self.imposed(self.measurement.points[largest].abscissa);
        if value <= 0.0 {
            return Ok(None);
        }
        let state = contact.equilibria(w, control)?.loading(value)?;
        let a = state.contact_radius;
        let (load, penetration) = contact.load_and_penetration(a, 0.0)?;
        let mut radius = Vec::new();
        if !columns.is_empty() {
            let gradient = contact.gradient(a, w)?;
            let by = gradient.by(Input::ContactRadius)?;
            let slope = control.imposed(by.load, by.penetration);
            for &parameter in columns {
                let input = match parameter {
                    Parameter::WorkOfAdhesion if w > 0.0 => Some(Input::WorkOfAdhesion),
                    _ => self.bodies.input(parameter),
                };
                let change = match input {
                    Some(input) => {
                        let by = gradient.by(input)?;
                        -control.imposed(by.load, by.penetration)
                    }
                    None => self.imposed_derivative(parameter, state.load),
                };
                radius.push(change / slope);
            }
        }
        Ok(Some(Turn {
            state,
            adhesionless: [load, penetration],
            stiffness: contact.stiffness(a)?,
            radius,
        }))
    }

    /// Predicts a point in the contact of the turn, instead of one that recedes.
    pub(super) fn pin(
        &self,
        contact: &Contact,
        turn: &Turn,
        i: usize,
        parameters: Option<&[Parameter]>,
        predicted: &mut Predicted,
    ) -> Result<(), contact::Error> {
        let abscissa = self.measurement.points[i].abscissa;
        let (control, a) = (self.control(), turn.state.contact_radius);
        let [load, penetration] = turn.adhesionless;
        let flat_punch = (control.imposed(load, penetration) - self.imposed(abscissa))
            / control.imposed(turn.stiffness, 1.0);
        let (load, penetration) = (load - turn.stiffness * flat_punch, penetration - flat_punch);
        predicted.values[i] = self.baseline_at(abscissa) + load;
        predicted.radii[i] = a;
        predicted.pinned[i] = true;
        let Some(columns) = parameters else {
            return Ok(());
        };
        // The work of adhesion at which this state would be an equilibrium stands for the strength
        // of the singularity. At the turn it is that of approach.
        let w = contact
            .energy_release_rate_at_penetration(a, penetration)?
            .max(self.work_of_adhesion)
            .max(1e-9 * self.work_of(Branch::Receding));
        let gradient = contact.gradient(a, w)?;
        let by_work = gradient.by(Input::WorkOfAdhesion)?;
        let by_radius = gradient.by(Input::ContactRadius)?;
        let stiffness = by_work.load / control.imposed(by_work.load, by_work.penetration);
        let at_fixed_value =
            |by: Derivatives| by.load - stiffness * control.imposed(by.load, by.penetration);
        let row = &mut predicted.derivatives[i * columns.len()..][..columns.len()];
        for ((derivative, &parameter), radius) in row.iter_mut().zip(columns).zip(&turn.radius) {
            let [constant, slope] = self.baseline_derivative(parameter);
            *derivative = constant
                + slope * (abscissa - self.contact_point)
                + at_fixed_value(by_radius) * radius
                + stiffness * self.imposed_derivative(parameter, load);
            if let Some(input) = self.bodies.input(parameter) {
                *derivative += at_fixed_value(gradient.by(input)?);
            }
        }
        Ok(())
    }
}
