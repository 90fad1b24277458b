//! How imposed values and readings follow from the state of a contact, and their derivatives.

use contact::{Control, Input};

use super::{Branch, Experiment, Kind, Parameter};

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
        self.sense() * (abscissa - self.contact_point)
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
            // The zeros of loads and depths are not its own.
            Kind::StiffnessRadius | Kind::StiffnessLoad | Kind::StiffnessDepth => 0.0,
            Kind::LoadPenetration | Kind::ForceHeight => {
                self.load_offset
                    + self.baseline
                    + self.baseline_slope * (abscissa - self.contact_point)
            }
        }
    }

    /// Returns the input of the contact on a branch that a parameter is.
    pub(super) fn input_on(&self, parameter: Parameter, branch: Branch) -> Option<Input> {
        let receding = branch == Branch::Receding && self.work_of_adhesion_receding.is_some();
        match parameter {
            Parameter::WorkOfAdhesion if !receding => Some(Input::WorkOfAdhesion),
            Parameter::WorkOfAdhesionReceding if receding => Some(Input::WorkOfAdhesion),
            Parameter::DoublingSpeed | Parameter::SpeedExponent => Some(Input::WorkOfAdhesion),
            _ => self.bodies.input(parameter),
        }
    }

    /// Returns the derivative of the reading without a contact: a constant, and the factor of the distance
    /// of the abscissa from the contact point.
    pub(super) const fn baseline_derivative(&self, parameter: Parameter) -> [f64; 2] {
        match (self.measurement.kind, parameter) {
            (Kind::PenetrationRadius, Parameter::ContactPoint) => [1.0, 0.0],
            (Kind::PenetrationRadius, _) => [0.0; 2],
            (_, Parameter::LoadOffset) => [1.0, 0.0],
            (Kind::LoadRadius, _) => [0.0; 2],
            (_, Parameter::Baseline) => [1.0, 0.0],
            (_, Parameter::BaselineSlope) => [0.0, 1.0],
            (_, Parameter::ContactPoint) => [-self.baseline_slope, 0.0],
            _ => [0.0; 2],
        }
    }

    /// Adds the derivatives of the readings without a contact to `derivatives`, with a column for each
    /// parameter.
    pub(super) fn add_baseline_derivatives(
        &self,
        parameters: &[Parameter],
        derivatives: &mut [f64],
    ) {
        for (column, &parameter) in parameters.iter().enumerate() {
            let [constant, slope] = self.baseline_derivative(parameter);
            if [constant, slope] != [0.0; 2] {
                let rows = derivatives.chunks_exact_mut(parameters.len());
                for (point, row) in self.measurement.points.iter().zip(rows) {
                    row[column] += constant + slope * (point.abscissa - self.contact_point);
                }
            }
        }
    }

    /// Returns the derivative of the imposed value of a fixed abscissa, less that of the imposed
    /// value of a fixed state: with respect to the contact point and the stiffness of the spring.
    pub(super) fn imposed_derivative(&self, parameter: Parameter, load: f64) -> f64 {
        match (parameter, self.control()) {
            (Parameter::ContactPoint, _) => -self.sense(),
            (Parameter::Stiffness, Control::Spring { stiffness }) => load / (stiffness * stiffness),
            _ => 0.0,
        }
    }
}
