//! The ordinates that the contact model predicts for the points of an experiment, and their
//! derivatives with respect to parameters.

use contact::{Contact, Derivatives, Equilibria, Input, State};
use interp::Probe;

use super::predicted::{BranchEnd, Predicted};
use super::turn::Turn;
use super::{Branch, Direction, Experiment, Kind, Parameter};

/// Contacts whose radius is within this factor of that at the end of the branch give the slope by
/// which a branch is continued beyond its end.
const NEAR_END: f64 = 1.1;

impl Experiment {
    /// Predicts all points that are not left out. `order` lists the points by descending imposed
    /// value. Without `parameters` there are no derivatives.
    pub(crate) fn predict(
        &self,
        contact: &Contact,
        branches: &[Branch],
        order: &[usize],
        parameters: Option<&[Parameter]>,
    ) -> Result<Predicted, contact::Error> {
        let points = &self.measurement.points;
        let columns = parameters.unwrap_or_default();
        let mut predicted = Predicted {
            values: points
                .iter()
                .map(|point| self.baseline_at(point.abscissa))
                .collect(),
            radii: vec![0.0; points.len()],
            beyond: vec![false; points.len()],
            pinned: vec![false; points.len()],
            derivatives: vec![0.0; points.len() * columns.len()],
        };
        self.add_baseline_derivatives(columns, &mut predicted.derivatives);
        match self.measurement.kind {
            Kind::LoadRadius | Kind::PenetrationRadius => {
                self.predict_at_radii(contact, branches, parameters, &mut predicted)?;
            }
            // A contact stiffness is predicted by `predict_stiffness`.
            Kind::StiffnessRadius | Kind::StiffnessLoad | Kind::StiffnessDepth => {}
            Kind::LoadPenetration | Kind::ForceHeight => {
                let turn = self.turn(contact, branches, order, columns)?;
                for branch in [Branch::Advancing, Branch::Receding] {
                    self.predict_branch(
                        contact,
                        (branch, branches),
                        order,
                        turn.as_ref(),
                        parameters,
                        &mut predicted,
                    )?;
                }
            }
        }
        Ok(predicted)
    }

    /// Predicts the points at measured contact radii.
    fn predict_at_radii(
        &self,
        contact: &Contact,
        branches: &[Branch],
        parameters: Option<&[Parameter]>,
        predicted: &mut Predicted,
    ) -> Result<(), contact::Error> {
        let load = self.measurement.kind == Kind::LoadRadius;
        let columns = parameters.unwrap_or_default();
        for branch in [Branch::Advancing, Branch::Receding] {
            let w = self.work_of(branch);
            let (mut inputs, mut input_columns) = self.inputs_on(branch, columns);
            if w == 0.0 {
                // The load falls like the root of `w`.
                input_columns.retain(|&column| self.bodies.input(columns[column]).is_some());
                inputs.retain(|&input| input != Input::WorkOfAdhesion);
            }
            let mut by = vec![Derivatives::ZERO; inputs.len()];
            for (i, point) in self.measurement.points.iter().enumerate() {
                if branches[i] != branch {
                    continue;
                }
                let a = point.abscissa;
                predicted.radii[i] = a;
                predicted.values[i] += match (load, inputs.is_empty()) {
                    (true, true) => contact.load(a, w)?,
                    (false, true) => contact.load_and_penetration(a, w)?.1,
                    (true, false) => contact.derivatives(a, w, &inputs, &mut by)?.0,
                    (false, false) => contact.derivatives(a, w, &inputs, &mut by)?.1,
                };
                for (by, &column) in by.iter().zip(&input_columns) {
                    predicted.derivatives[i * columns.len() + column] +=
                        if load { by.load } else { by.penetration };
                }
            }
        }
        Ok(())
    }

    /// Returns the inputs of the contact on a branch that parameters are, and the number of each of
    /// these parameters.
    fn inputs_on(&self, branch: Branch, columns: &[Parameter]) -> (Vec<Input>, Vec<usize>) {
        let columns = columns.iter().enumerate();
        columns
            .filter_map(|(column, &parameter)| Some((self.input_on(parameter, branch)?, column)))
            .unzip()
    }

    /// Predicts the points of one branch at imposed penetrations or positions of the spring.
    fn predict_branch(
        &self,
        contact: &Contact,
        (branch, branches): (Branch, &[Branch]),
        order: &[usize],
        turn: Option<&Turn>,
        parameters: Option<&[Parameter]>,
        predicted: &mut Predicted,
    ) -> Result<(), contact::Error> {
        let points = &self.measurement.points;
        let w = self.work_of(branch);
        let of_branch = order.iter().copied();
        let of_branch: Vec<usize> = of_branch.filter(|&i| branches[i] == branch).collect();
        if of_branch.is_empty() {
            return Ok(());
        }
        let control = self.control();
        let equilibria = contact.equilibria(w, control)?;
        let imposed_at = |i: usize| self.imposed(points[i].abscissa);
        let end = (w > 0.0).then(|| equilibria.pull_off()).transpose()?;
        let least = end.map_or(0.0, |end| control.imposed(end.load, end.penetration));
        let is_within = |&i: &usize| imposed_at(i) > least;
        let (within, beyond): (Vec<usize>, Vec<usize>) = of_branch.into_iter().partition(is_within);
        // On approach, the contact that grows from the first touch; below the contact point the
        // same contact as on retract.
        let loads = |&i: &usize| {
            branch == Branch::Advancing
                && points[i].direction == Some(Direction::Approach)
                && imposed_at(i) >= 0.0
        };
        let split = within.iter().take_while(|i| loads(i)).count();
        let (loading, unloading) = within.split_at(split);
        for (indices, course) in [
            (loading, contact::Branch::Loading),
            (unloading, contact::Branch::Unloading),
        ] {
            self.follow(
                &equilibria,
                (branch, course),
                indices,
                parameters,
                predicted,
            )?;
        }
        if let Some(end) = end
            && !beyond.is_empty()
        {
            self.continue_beyond(
                contact,
                (branch, &end),
                &beyond,
                parameters.unwrap_or_default(),
                predicted,
            )?;
        }
        if let Some(turn) = turn.filter(|_| branch == Branch::Receding) {
            for &i in &within {
                if predicted.radii[i] > turn.state.contact_radius {
                    self.pin(contact, turn, i, parameters, predicted)?;
                }
            }
        }
        Ok(())
    }

    /// Predicts points on the stable branch.
    fn follow(
        &self,
        equilibria: &Equilibria<'_>,
        (branch, course): (Branch, contact::Branch),
        indices: &[usize],
        parameters: Option<&[Parameter]>,
        predicted: &mut Predicted,
    ) -> Result<(), contact::Error> {
        let values: Vec<f64> = indices
            .iter()
            .map(|&i| self.imposed(self.measurement.points[i].abscissa))
            .collect();
        let mut states = vec![State::ORIGIN; values.len()];
        let Some(columns) = parameters else {
            equilibria.branch(&values, course, &mut states)?;
            for (&i, state) in indices.iter().zip(&states) {
                predicted.values[i] += state.load;
                predicted.radii[i] = state.contact_radius;
            }
            return Ok(());
        };
        let (inputs, input_columns) = self.inputs_on(branch, columns);
        let mut derivatives = vec![Derivatives::ZERO; values.len() * (1 + inputs.len())];
        equilibria.branch_with_gradient(&values, course, &inputs, &mut states, &mut derivatives)?;
        let rows = derivatives.chunks_exact(1 + inputs.len());
        for ((&i, state), row) in indices.iter().zip(&states).zip(rows) {
            predicted.values[i] += state.load;
            predicted.radii[i] = state.contact_radius;
            let own = &mut predicted.derivatives[i * columns.len()..][..columns.len()];
            for (by, &column) in row[1..].iter().zip(&input_columns) {
                own[column] += by.load;
            }
            let by_imposed = row[0].load;
            for (derivative, &parameter) in own.iter_mut().zip(columns) {
                *derivative += by_imposed * self.imposed_derivative(parameter, state.load);
            }
        }
        Ok(())
    }

    /// Continues a branch beyond its end by a straight line, so that the sum of squares has no
    /// jump.
    fn continue_beyond(
        &self,
        contact: &Contact,
        (branch, end): (Branch, &State),
        indices: &[usize],
        columns: &[Parameter],
        predicted: &mut Predicted,
    ) -> Result<(), contact::Error> {
        let control = self.control();
        let a = end.contact_radius;
        let least = control.imposed(end.load, end.penetration);
        let slope = if matches!(self.bodies.probe(), Probe::FlatPunch { .. }) {
            let stiffness = contact.stiffness(a)?;
            stiffness / control.imposed(stiffness, 1.0)
        } else {
            let (load, penetration) =
                contact.load_and_penetration(NEAR_END * a, self.work_of(branch))?;
            (load - end.load) / (control.imposed(load, penetration) - least)
        };
        let gradient = if columns.is_empty() {
            None
        } else {
            Some(contact.gradient(a, self.work_of(branch))?)
        };
        for &i in indices {
            let excess = self.imposed(self.measurement.points[i].abscissa) - least;
            predicted.values[i] += end.load + slope * excess;
            predicted.radii[i] = a;
            predicted.beyond[i] = true;
            let Some(gradient) = &gradient else { continue };
            let row = &mut predicted.derivatives[i * columns.len()..][..columns.len()];
            for (derivative, &parameter) in row.iter_mut().zip(columns) {
                if let Some(input) = self.input_on(parameter, branch) {
                    let by = gradient.by(input)?;
                    *derivative += by.load - slope * control.imposed(by.load, by.penetration);
                }
                *derivative += slope * self.imposed_derivative(parameter, end.load);
            }
        }
        Ok(())
    }

    /// Returns where a stable branch ends on unloading, with the derivatives of its abscissa.
    pub(crate) fn branch_end(
        &self,
        contact: &Contact,
        branch: Branch,
        columns: &[Parameter],
    ) -> Result<Option<BranchEnd>, contact::Error> {
        let w = self.work_of(branch);
        if w == 0.0 || self.measurement.kind.at_radii() || self.measurement.kind.is_stiffness() {
            return Ok(None);
        }
        let control = self.control();
        let end = contact.pull_off(w, control)?;
        let mut derivatives = Vec::with_capacity(columns.len());
        if !columns.is_empty() {
            let gradient = contact.gradient(end.contact_radius, w)?;
            for &parameter in columns {
                let of_state = match self.input_on(parameter, branch) {
                    Some(input) => {
                        let by = gradient.by(input)?;
                        control.imposed(by.load, by.penetration)
                    }
                    None => -self.imposed_derivative(parameter, end.load),
                };
                derivatives.push(self.sense() * of_state);
            }
        }
        let value = control.imposed(end.load, end.penetration);
        Ok(Some(BranchEnd {
            abscissa: self.contact_point + self.sense() * value,
            derivatives,
        }))
    }
}
