//! The ordinates that the contact model predicts for the points of an experiment, and their
//! derivatives with respect to parameters.

use contact::{Contact, Derivatives, Equilibria, Input, State};

use super::predicted::{BranchEnd, Predicted};
use super::predictor::Predictor;
use super::turn::Turn;
use super::{Branch, Direction, Experiment, Kind, Parameter};

/// Contacts whose radius is within this factor of that at the end of the branch give the slope by
/// which a branch is continued beyond its end.
const NEAR_END: f64 = 1.1;

impl Experiment {
    /// Predicts all points that are not left out. `order` lists the points by descending imposed
    /// value. The derivatives are those with respect to `columns`.
    pub(crate) fn predict(
        &self,
        contact: &Contact,
        branches: &[Branch],
        order: &[usize],
        columns: &[Parameter],
    ) -> Result<Predicted, contact::Error> {
        let points = self.measurement.points.iter();
        let values = points.map(|point| self.baseline_at(point.abscissa));
        let mut predicted = Predicted::new(values.collect(), columns.len());
        self.add_baseline_derivatives(columns, &mut predicted.derivatives);
        let mut predictor = Predictor {
            experiment: self,
            contact,
            branches,
            order,
            columns,
            predicted,
        };
        match self.measurement.kind {
            Kind::LoadRadius | Kind::PenetrationRadius => {
                for branch in Branch::CONTACTS {
                    predictor.at_radii(branch)?;
                }
            }
            // A contact stiffness is predicted by `predict_stiffness`.
            Kind::StiffnessRadius | Kind::StiffnessLoad | Kind::StiffnessDepth => {}
            Kind::LoadPenetration | Kind::ForceHeight => {
                let turn = predictor.turn()?;
                for branch in Branch::CONTACTS {
                    predictor.at_positions(branch, turn.as_ref())?;
                }
            }
        }
        Ok(predictor.predicted)
    }
}

impl Predictor<'_> {
    /// Predicts the points of a branch at measured contact radii.
    fn at_radii(&mut self, branch: Branch) -> Result<(), contact::Error> {
        let of = self.experiment;
        let load = of.measurement.kind == Kind::LoadRadius;
        let speeds = of.has_line_law().then(|| of.speeds_of_line());
        let (mut inputs, mut columns) = self.inputs_on(branch);
        if of.work_of(branch) == 0.0 {
            // The load falls like the root of `w`.
            columns.retain(|&column| of.bodies.input(self.columns[column]).is_some());
            inputs.retain(|&input| input != Input::WorkOfAdhesion);
        }
        let mut by = vec![Derivatives::ZERO; inputs.len()];
        for (i, point) in of.measurement.points.iter().enumerate() {
            if self.branches[i] != branch {
                continue;
            }
            let a = point.abscissa;
            let speed = speeds.as_ref().map_or(0.0, |speeds| speeds[i].speed);
            let (w, by_parameter) = of.work_at(branch, speed)?;
            self.predicted.radii[i] = a;
            self.predicted.values[i] += match (load, inputs.is_empty()) {
                (true, true) => self.contact.load(a, w)?,
                (false, true) => self.contact.load_and_penetration(a, w)?.1,
                (true, false) => self.contact.derivatives(a, w, &inputs, &mut by)?.0,
                (false, false) => self.contact.derivatives(a, w, &inputs, &mut by)?.1,
            };
            for ((by, &column), input) in by.iter().zip(&columns).zip(&inputs) {
                let by_input = if load { by.load } else { by.penetration };
                let moved = match input {
                    Input::WorkOfAdhesion => by_parameter(self.columns[column]),
                    _ => 1.0,
                };
                self.row(i)[column] += by_input * moved;
            }
        }
        Ok(())
    }

    /// Predicts the points of a branch at imposed penetrations or positions of the spring.
    fn at_positions(&mut self, branch: Branch, turn: Option<&Turn>) -> Result<(), contact::Error> {
        let of = self.experiment;
        let w = of.work_of(branch);
        let of_branch = self.order.iter().copied();
        let of_branch: Vec<usize> = of_branch.filter(|&i| self.branches[i] == branch).collect();
        if of_branch.is_empty() {
            return Ok(());
        }
        let control = of.control();
        let equilibria = self.contact.equilibria(w, control)?;
        let end = (w > 0.0).then(|| equilibria.pull_off()).transpose()?;
        let least = end.map_or(0.0, |end| control.imposed(end.load, end.penetration));
        let is_within = |&i: &usize| self.imposed(i) > least;
        let (within, beyond): (Vec<usize>, Vec<usize>) = of_branch.into_iter().partition(is_within);
        // On approach, the contact that grows from the first touch; below the contact point the
        // same contact as on retract.
        let loads = |&i: &usize| {
            branch == Branch::Advancing
                && of.measurement.points[i].direction == Some(Direction::Approach)
                && self.imposed(i) >= 0.0
        };
        let split = within.iter().take_while(|i| loads(i)).count();
        let (loading, unloading) = within.split_at(split);
        self.follow(&equilibria, (branch, contact::Branch::Loading), loading)?;
        self.follow(&equilibria, (branch, contact::Branch::Unloading), unloading)?;
        if let Some(end) = end
            && !beyond.is_empty()
        {
            self.continue_beyond((branch, &end), &beyond)?;
        }
        if let Some(turn) = turn.filter(|_| branch == Branch::Receding) {
            for &i in &within {
                if self.predicted.radii[i] > turn.state.contact_radius {
                    self.pin(turn, i)?;
                }
            }
        }
        Ok(())
    }

    /// Predicts points on the stable branch.
    fn follow(
        &mut self,
        equilibria: &Equilibria<'_>,
        (branch, course): (Branch, contact::Branch),
        indices: &[usize],
    ) -> Result<(), contact::Error> {
        let values: Vec<f64> = indices.iter().map(|&i| self.imposed(i)).collect();
        let mut states = vec![State::ORIGIN; values.len()];
        let (inputs, input_columns) = self.inputs_on(branch);
        let mut derivatives = Vec::new();
        if self.columns.is_empty() {
            equilibria.branch(&values, course, &mut states)?;
        } else {
            derivatives.resize(values.len() * (1 + inputs.len()), Derivatives::ZERO);
            equilibria.branch_with_gradient(
                &values,
                course,
                &inputs,
                &mut states,
                &mut derivatives,
            )?;
        }
        for (&i, state) in indices.iter().zip(&states) {
            self.predicted.values[i] += state.load;
            self.predicted.radii[i] = state.contact_radius;
        }
        let (of, columns) = (self.experiment, self.columns);
        let rows = derivatives.chunks_exact(1 + inputs.len());
        for ((&i, state), row) in indices.iter().zip(&states).zip(rows) {
            let own = self.row(i);
            for (by, &column) in row[1..].iter().zip(&input_columns) {
                own[column] += by.load;
            }
            for (derivative, &parameter) in own.iter_mut().zip(columns) {
                *derivative += row[0].load * of.imposed_derivative(parameter, state.load);
            }
        }
        Ok(())
    }

    /// Continues a branch beyond its end by a straight line, so that the sum of squares has no
    /// jump.
    fn continue_beyond(
        &mut self,
        (branch, end): (Branch, &State),
        indices: &[usize],
    ) -> Result<(), contact::Error> {
        let (of, contact, columns) = (self.experiment, self.contact, self.columns);
        let (control, w, a) = (of.control(), of.work_of(branch), end.contact_radius);
        let least = control.imposed(end.load, end.penetration);
        let slope = if of.bodies.probe.is_flat_punch() {
            let stiffness = contact.stiffness(a)?;
            stiffness / control.imposed(stiffness, 1.0)
        } else {
            let (load, penetration) = contact.load_and_penetration(NEAR_END * a, w)?;
            (load - end.load) / (control.imposed(load, penetration) - least)
        };
        let has_derivatives = !columns.is_empty();
        let gradient = has_derivatives
            .then(|| contact.gradient(a, w))
            .transpose()?;
        for &i in indices {
            self.predicted.values[i] += end.load + slope * (self.imposed(i) - least);
            self.predicted.radii[i] = a;
            self.predicted.beyond[i] = true;
            let Some(gradient) = &gradient else { continue };
            for (derivative, &parameter) in self.row(i).iter_mut().zip(columns) {
                if let Some(input) = of.input_on(parameter, branch) {
                    let by = gradient.by(input)?;
                    *derivative += by.load - slope * of.imposed_by(by);
                }
                *derivative += slope * of.imposed_derivative(parameter, end.load);
            }
        }
        Ok(())
    }
}

impl Experiment {
    /// Returns where a stable branch ends on unloading, with the derivatives of its abscissa.
    pub(crate) fn branch_end(
        &self,
        contact: &Contact,
        branch: Branch,
        columns: &[Parameter],
    ) -> Result<Option<BranchEnd>, contact::Error> {
        let w = self.work_of(branch);
        if w == 0.0 || !self.measurement.kind.at_positions() {
            return Ok(None);
        }
        let control = self.control();
        let end = contact.pull_off(w, control)?;
        let mut derivatives = Vec::with_capacity(columns.len());
        if !columns.is_empty() {
            let gradient = contact.gradient(end.contact_radius, w)?;
            for &parameter in columns {
                let of_state = match self.input_on(parameter, branch) {
                    Some(input) => self.imposed_by(gradient.by(input)?),
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
