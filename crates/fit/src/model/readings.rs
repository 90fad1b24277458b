//! How imposed values and readings follow from the state of a contact, and their derivatives.

use contact::{Control, Input};

use super::{Bodies, Branch, Experiment, Kind, Parameter};

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
    pub(super) fn input(&self, parameter: Parameter) -> Option<Input> {
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

    /// Returns the input of the contact on a branch that a parameter is.
    pub(super) fn input_on(&self, parameter: Parameter, branch: Branch) -> Option<Input> {
        if self.is_work_of(parameter, branch) {
            Some(Input::WorkOfAdhesion)
        } else {
            self.input(parameter)
        }
    }

    /// Tells whether a parameter is the work of adhesion of a branch.
    pub(super) fn is_work_of(&self, parameter: Parameter, branch: Branch) -> bool {
        let receding = branch == Branch::Receding && self.work_of_adhesion_receding.is_some();
        match parameter {
            Parameter::WorkOfAdhesion => !receding,
            Parameter::WorkOfAdhesionReceding => receding,
            _ => false,
        }
    }

    /// Returns the derivative of the reading without a contact.
    pub(super) fn baseline_derivative(&self, parameter: Parameter, abscissa: f64) -> f64 {
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

/// Returns the imposed value of a load and a penetration, or its derivative from theirs.
pub(crate) fn imposed(control: Control, load: f64, penetration: f64) -> f64 {
    match control {
        Control::Load => load,
        Control::Displacement => penetration,
        Control::Spring { stiffness } => penetration + load / stiffness,
    }
}
