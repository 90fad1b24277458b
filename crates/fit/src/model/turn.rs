//! The turn from approach to retract under adhesion hysteresis.

use contact::{Derivatives, Input, State};

use super::predictor::Predictor;
use super::{Branch, Parameter};

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

impl Predictor<'_> {
    /// Returns the contact at the turn, if the receding work of adhesion is the larger one.
    pub(super) fn turn(&self) -> Result<Option<Turn>, contact::Error> {
        let (of, contact) = (self.experiment, self.contact);
        if of.bodies.probe.is_flat_punch() {
            // Its contact is as wide as the punch in any state.
            return Ok(None);
        }
        let w = of.work_of_adhesion;
        let is_hysteretic = of
            .work_of_adhesion_receding
            .is_some_and(|receding| receding > w);
        let both = Branch::CONTACTS.map(|branch| self.branches.contains(&branch));
        let Some(&largest) = self
            .order
            .first()
            .filter(|_| is_hysteretic && both == [true; 2])
        else {
            return Ok(None);
        };
        let value = self.imposed(largest);
        if value <= 0.0 {
            return Ok(None);
        }
        let state = contact.equilibria(w, of.control())?.loading(value)?;
        let a = state.contact_radius;
        let (load, penetration) = contact.load_and_penetration(a, 0.0)?;
        let mut radius = Vec::new();
        if !self.columns.is_empty() {
            let gradient = contact.gradient(a, w)?;
            let slope = of.imposed_by(gradient.by(Input::ContactRadius)?);
            for &parameter in self.columns {
                let input = match parameter {
                    Parameter::WorkOfAdhesion if w > 0.0 => Some(Input::WorkOfAdhesion),
                    _ => of.bodies.input(parameter),
                };
                let change = match input {
                    Some(input) => -of.imposed_by(gradient.by(input)?),
                    None => of.imposed_derivative(parameter, state.load),
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
    pub(super) fn pin(&mut self, turn: &Turn, i: usize) -> Result<(), contact::Error> {
        let (of, columns) = (self.experiment, self.columns);
        let abscissa = of.measurement.points[i].abscissa;
        let (control, a) = (of.control(), turn.state.contact_radius);
        let [load, penetration] = turn.adhesionless;
        let flat_punch = (control.imposed(load, penetration) - of.imposed(abscissa))
            / control.imposed(turn.stiffness, 1.0);
        let (load, penetration) = (load - turn.stiffness * flat_punch, penetration - flat_punch);
        self.predicted.values[i] = of.baseline_at(abscissa) + load;
        self.predicted.radii[i] = a;
        self.predicted.pinned[i] = true;
        if columns.is_empty() {
            return Ok(());
        }
        // The work of adhesion at which this state would be an equilibrium stands for the strength
        // of the singularity.
        let w = self
            .contact
            .energy_release_rate_at_penetration(a, penetration)?
            .max(1e-9 * of.work_of(Branch::Receding));
        let gradient = self.contact.gradient(a, w)?;
        let by_work = gradient.by(Input::WorkOfAdhesion)?;
        let by_radius = gradient.by(Input::ContactRadius)?;
        let stiffness = by_work.load / of.imposed_by(by_work);
        let at_fixed_value = |by: Derivatives| by.load - stiffness * of.imposed_by(by);
        let row = self.row(i).iter_mut().zip(columns);
        for ((derivative, &parameter), radius) in row.zip(&turn.radius) {
            let [constant, slope] = of.baseline_derivative(parameter);
            *derivative = constant
                + slope * (abscissa - of.contact_point)
                + at_fixed_value(by_radius) * radius
                + stiffness * of.imposed_derivative(parameter, load);
            if let Some(input) = of.bodies.input(parameter) {
                *derivative += at_fixed_value(gradient.by(input)?);
            }
        }
        Ok(())
    }
}
