//! The ordinates that the contact model predicts for the points of an experiment, and their
//! derivatives with respect to parameters.

use interp::{Contact, Control, Derivatives, Equilibria, Input, State};

use super::{Bodies, Branch, Direction, Experiment, Kind, Parameter};

/// Contacts whose radius is within this factor of that at the end of the branch give the slope by
/// which a branch is continued beyond its end.
const NEAR_END: f64 = 1.1;

/// The predictions for all points of an experiment.
#[derive(Clone, Debug)]
pub(crate) struct Predicted {
    /// The ordinates; those of points that are left out mean nothing.
    pub values: Vec<f64>,
    /// The contact radii, m; 0 without a contact.
    pub radii: Vec<f64>,
    /// The points beyond the end of their branch.
    pub beyond: Vec<bool>,
    /// The points in the contact of the turn, whose line does not move.
    pub pinned: Vec<bool>,
    /// The derivatives with respect to each of the parameters asked for, point after point.
    pub derivatives: Vec<f64>,
}

/// The end of a stable branch.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BranchEnd {
    /// The abscissa at which it ends.
    pub abscissa: f64,
    /// The derivatives of this abscissa with respect to the parameters asked for.
    pub derivatives: [f64; 11],
}

impl Experiment {
    /// Returns the work of adhesion of a branch.
    pub(crate) fn work_of(&self, branch: Branch) -> f64 {
        match branch {
            Branch::Receding | Branch::Pinned => self
                .work_of_adhesion_receding
                .unwrap_or(self.work_of_adhesion),
            _ => self.work_of_adhesion,
        }
    }

    /// Returns the imposed penetration or position of the spring at an abscissa.
    pub(crate) fn imposed(&self, abscissa: f64) -> f64 {
        match self.measurement.kind {
            Kind::ForceHeight => self.contact_point - abscissa,
            _ => abscissa - self.contact_point,
        }
    }

    /// Returns the derivative of the imposed value with respect to the abscissa, 1 or -1.
    pub(crate) fn sense(&self) -> f64 {
        if self.measurement.kind == Kind::ForceHeight {
            -1.0
        } else {
            1.0
        }
    }

    /// Returns what is imposed on the contact.
    pub(crate) fn control(&self) -> Control {
        match (self.measurement.kind, self.stiffness) {
            (Kind::ForceHeight, Some(stiffness)) => Control::Spring { stiffness },
            _ => Control::Displacement,
        }
    }

    /// Returns the reading without a contact.
    pub(crate) fn baseline_at(&self, abscissa: f64) -> f64 {
        match self.measurement.kind {
            Kind::LoadRadius => self.load_offset,
            Kind::PenetrationRadius => self.contact_point,
            _ => {
                self.load_offset
                    + self.baseline
                    + self.baseline_slope * (abscissa - self.contact_point)
            }
        }
    }

    /// Returns the input of the contact that a parameter of the bodies is.
    fn input(&self, parameter: Parameter) -> Option<Input> {
        let coated = matches!(self.bodies, Bodies::Coated(_));
        Some(match parameter {
            Parameter::SphereModulus => Input::SphereModulus,
            Parameter::FilmModulus if coated => Input::FilmModulus,
            Parameter::FilmModulus => Input::SubstrateModulus,
            Parameter::FilmPoissonRatio if coated => Input::FilmPoisson,
            Parameter::FilmPoissonRatio => Input::SubstratePoisson,
            Parameter::FilmThickness => Input::FilmThickness,
            _ => return None,
        })
    }

    /// Tells whether a parameter is the work of adhesion of a branch.
    fn is_work_of(&self, parameter: Parameter, branch: Branch) -> bool {
        let receding = branch == Branch::Receding && self.work_of_adhesion_receding.is_some();
        match parameter {
            Parameter::WorkOfAdhesion => !receding,
            Parameter::WorkOfAdhesionReceding => receding,
            _ => false,
        }
    }

    /// Returns the derivative of the reading without a contact.
    fn baseline_derivative(&self, parameter: Parameter, abscissa: f64) -> f64 {
        match (self.measurement.kind, parameter) {
            (Kind::PenetrationRadius, Parameter::ContactPoint) => 1.0,
            (Kind::PenetrationRadius, _) => 0.0,
            (_, Parameter::LoadOffset) => 1.0,
            (Kind::LoadRadius, _) => 0.0,
            (_, Parameter::Baseline) => 1.0,
            (_, Parameter::BaselineSlope) => abscissa - self.contact_point,
            (_, Parameter::ContactPoint) => -self.baseline_slope,
            _ => 0.0,
        }
    }

    /// Predicts all points that are not left out. `order` lists the points by descending imposed
    /// value. Without `parameters` there are no derivatives.
    pub(crate) fn predict(
        &self,
        contact: &Contact,
        branches: &[Branch],
        order: &[usize],
        parameters: Option<&[Parameter]>,
    ) -> Result<Predicted, interp::Error> {
        let points = &self.measurement.points;
        let columns = parameters.unwrap_or_default();
        let width = columns.len();
        let mut predicted = Predicted {
            values: points
                .iter()
                .map(|point| self.baseline_at(point.abscissa))
                .collect(),
            radii: vec![0.0; points.len()],
            beyond: vec![false; points.len()],
            pinned: vec![false; points.len()],
            derivatives: Vec::with_capacity(points.len() * width),
        };
        for point in points {
            predicted.derivatives.extend(
                columns
                    .iter()
                    .map(|&parameter| self.baseline_derivative(parameter, point.abscissa)),
            );
        }
        match self.measurement.kind {
            Kind::LoadRadius | Kind::PenetrationRadius => {
                self.predict_at_radii(contact, branches, parameters, &mut predicted)?;
            }
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
    ) -> Result<(), interp::Error> {
        let load = self.measurement.kind == Kind::LoadRadius;
        let columns = parameters.unwrap_or_default();
        for (i, (point, &branch)) in self.measurement.points.iter().zip(branches).enumerate() {
            if !matches!(branch, Branch::Advancing | Branch::Receding) {
                continue;
            }
            let (a, w) = (point.abscissa, self.work_of(branch));
            predicted.radii[i] = a;
            if parameters.is_none() {
                predicted.values[i] += if load {
                    contact.load(a, w)?
                } else {
                    contact.load_and_penetration(a, w)?.1
                };
                continue;
            }
            let gradient = contact.gradient(a, w)?;
            let of = |both: Derivatives| if load { both.load } else { both.penetration };
            predicted.values[i] += if load {
                gradient.load()
            } else {
                gradient.penetration()
            };
            let row = &mut predicted.derivatives[i * columns.len()..][..columns.len()];
            for (derivative, &parameter) in row.iter_mut().zip(columns) {
                if let Some(input) = self.input(parameter) {
                    *derivative += of(gradient.by(input)?);
                } else if self.is_work_of(parameter, branch) && w > 0.0 {
                    *derivative += of(gradient.by(Input::WorkOfAdhesion)?);
                }
            }
        }
        Ok(())
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
    ) -> Result<(), interp::Error> {
        let points = &self.measurement.points;
        let w = self.work_of(branch);
        let of_branch = order.iter().filter(|&&i| branches[i] == branch);
        let mut within: Vec<usize> = of_branch.copied().collect();
        if within.is_empty() {
            return Ok(());
        }
        let control = self.control();
        let equilibria = contact.equilibria(w, control)?;
        let imposed_at = |i: usize| self.imposed(points[i].abscissa);
        let mut beyond = Vec::new();
        let end = if w > 0.0 {
            Some(equilibria.pull_off()?)
        } else {
            None
        };
        let least = end.map_or(0.0, |end| imposed(control, end.load, end.penetration));
        within.retain(|&i| {
            let inside = imposed_at(i) > least;
            if !inside && end.is_some() {
                beyond.push(i);
            }
            inside
        });
        // On approach, the contact that grows from the first touch; below the contact point the same
        // contact as on retract.
        let split = within
            .iter()
            .position(|&i| points[i].direction != Some(Direction::Approach) || imposed_at(i) < 0.0)
            .filter(|_| branch == Branch::Advancing)
            .unwrap_or(if branch == Branch::Advancing {
                within.len()
            } else {
                0
            });
        let (loading, unloading) = within.split_at(split);
        for (indices, course) in [
            (loading, interp::Branch::Loading),
            (unloading, interp::Branch::Unloading),
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
        (branch, course): (Branch, interp::Branch),
        indices: &[usize],
        parameters: Option<&[Parameter]>,
        predicted: &mut Predicted,
    ) -> Result<(), interp::Error> {
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
        // The inputs asked for, and the column of each.
        let mut inputs = Vec::new();
        let mut input_columns = Vec::new();
        for (column, &parameter) in columns.iter().enumerate() {
            let input = if self.is_work_of(parameter, branch) {
                Some(Input::WorkOfAdhesion)
            } else {
                self.input(parameter)
            };
            if let Some(input) = input {
                inputs.push(input);
                input_columns.push(column);
            }
        }
        let zero = Derivatives {
            load: 0.0,
            penetration: 0.0,
        };
        let mut derivatives = vec![zero; values.len() * (1 + inputs.len())];
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

    /// Returns the derivative of the imposed value of a fixed abscissa, less that of the imposed
    /// value of a fixed state: with respect to the contact point and the stiffness of the spring.
    fn imposed_derivative(&self, parameter: Parameter, load: f64) -> f64 {
        match (parameter, self.control()) {
            (Parameter::ContactPoint, _) => -self.sense(),
            (Parameter::Stiffness, Control::Spring { stiffness }) => load / (stiffness * stiffness),
            _ => 0.0,
        }
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
    ) -> Result<(), interp::Error> {
        let control = self.control();
        let a = end.contact_radius;
        let (load, penetration) =
            contact.load_and_penetration(NEAR_END * a, self.work_of(branch))?;
        let least = imposed(control, end.load, end.penetration);
        let slope = (load - end.load) / (imposed(control, load, penetration) - least);
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
                let input = if self.is_work_of(parameter, branch) {
                    Some(Input::WorkOfAdhesion)
                } else {
                    self.input(parameter)
                };
                if let Some(input) = input {
                    let by = gradient.by(input)?;
                    *derivative += by.load - slope * imposed(control, by.load, by.penetration);
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
    ) -> Result<Option<BranchEnd>, interp::Error> {
        let w = self.work_of(branch);
        if w == 0.0
            || matches!(
                self.measurement.kind,
                Kind::LoadRadius | Kind::PenetrationRadius
            )
        {
            return Ok(None);
        }
        let control = self.control();
        let end = contact.pull_off(w, control)?;
        let gradient = contact.gradient(end.contact_radius, w)?;
        let mut derivatives = [0.0; 11];
        for (derivative, &parameter) in derivatives.iter_mut().zip(columns) {
            let input = if self.is_work_of(parameter, branch) {
                Some(Input::WorkOfAdhesion)
            } else {
                self.input(parameter)
            };
            let of_state = match input {
                Some(input) => {
                    let by = gradient.by(input)?;
                    imposed(control, by.load, by.penetration)
                }
                None => -self.imposed_derivative(parameter, end.load),
            };
            *derivative = self.sense() * of_state;
        }
        let value = imposed(control, end.load, end.penetration);
        Ok(Some(BranchEnd {
            abscissa: self.contact_point + self.sense() * value,
            derivatives,
        }))
    }
}

/// The contact at the turn from approach to retract, in which the line stays until the energy
/// release rate reaches the receding work of adhesion.
struct Turn {
    state: State,
    /// Load and penetration without a singularity at the edge, and the stiffness.
    adhesionless: [f64; 2],
    stiffness: f64,
    /// The derivatives of the contact radius with respect to the parameters asked for.
    radius: Vec<f64>,
}

impl Experiment {
    /// Returns the contact at the turn, if the receding work of adhesion is the larger one.
    fn turn(
        &self,
        contact: &Contact,
        branches: &[Branch],
        order: &[usize],
        columns: &[Parameter],
    ) -> Result<Option<Turn>, interp::Error> {
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
            let slope = imposed(control, by.load, by.penetration);
            for &parameter in columns {
                let input = match parameter {
                    Parameter::WorkOfAdhesion if w > 0.0 => Some(Input::WorkOfAdhesion),
                    _ => self.input(parameter),
                };
                let change = match input {
                    Some(input) => {
                        let by = gradient.by(input)?;
                        -imposed(control, by.load, by.penetration)
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
    fn pin(
        &self,
        contact: &Contact,
        turn: &Turn,
        i: usize,
        parameters: Option<&[Parameter]>,
        predicted: &mut Predicted,
    ) -> Result<(), interp::Error> {
        let abscissa = self.measurement.points[i].abscissa;
        let (control, a) = (self.control(), turn.state.contact_radius);
        let [load, penetration] = turn.adhesionless;
        let flat_punch = (imposed(control, load, penetration) - self.imposed(abscissa))
            / imposed(control, turn.stiffness, 1.0);
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
        let stiffness = by_work.load / imposed(control, by_work.load, by_work.penetration);
        let at_fixed_value =
            |by: Derivatives| by.load - stiffness * imposed(control, by.load, by.penetration);
        let row = &mut predicted.derivatives[i * columns.len()..][..columns.len()];
        for ((derivative, &parameter), radius) in row.iter_mut().zip(columns).zip(&turn.radius) {
            *derivative = self.baseline_derivative(parameter, abscissa)
                + at_fixed_value(by_radius) * radius
                + stiffness * self.imposed_derivative(parameter, load);
            if let Some(input) = self.input(parameter) {
                *derivative += at_fixed_value(gradient.by(input)?);
            }
        }
        Ok(())
    }
}

/// Returns the imposed value of a load and a penetration, or its derivative from theirs.
pub(crate) fn imposed(control: Control, load: f64, penetration: f64) -> f64 {
    match control {
        Control::Load => load,
        Control::Displacement => penetration,
        Control::Spring { stiffness } => penetration + load / stiffness,
    }
}
