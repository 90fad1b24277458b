//! The readings of an instrument, and their calibration.

use super::{Experiment, Kind};

named! {
    /// A quantity that an instrument reads. Where its calibration is off, all readings err by one factor, from their zero.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum Scale {
        /// Contact radii: the scale of a microscope.
        ContactRadius = "contact-radius",
        /// Penetrations.
        Penetration = "penetration",
        /// Heights of the base of a cantilever.
        Height = "height",
        /// Loads: those of a load cell, or of a cantilever by the sensitivity of its deflection.
        Load = "load",
        /// Contact stiffnesses.
        ContactStiffness = "contact-stiffness",
    }
}

impl Kind {
    /// Returns the quantities that are read as abscissa and ordinate.
    pub(crate) const fn scales(self) -> [Scale; 2] {
        match self {
            Self::LoadRadius => [Scale::ContactRadius, Scale::Load],
            Self::PenetrationRadius => [Scale::ContactRadius, Scale::Penetration],
            Self::LoadPenetration => [Scale::Penetration, Scale::Load],
            Self::ForceHeight => [Scale::Height, Scale::Load],
            Self::StiffnessRadius => [Scale::ContactRadius, Scale::ContactStiffness],
            Self::StiffnessLoad => [Scale::Load, Scale::ContactStiffness],
            Self::StiffnessDepth => [Scale::Penetration, Scale::ContactStiffness],
        }
    }
}

impl Experiment {
    /// Tells whether a quantity is read.
    pub(super) fn is_read(&self, scale: Scale) -> bool {
        let has_loads = !self.indentation.loads.is_empty();
        self.measurement.kind.scales().contains(&scale) || (scale == Scale::Load && has_loads)
    }

    /// Multiplies all readings of a quantity, from their zero. Of contact radii the speeds of the contact line follow.
    pub(super) fn multiply_readings(&mut self, scale: Scale, factor: f64) {
        let [abscissa, ordinate] = self.measurement.kind.scales();
        let first = if self.measurement.kind.at_positions() {
            self.contact_point
        } else {
            0.0
        };
        let mut points = std::mem::take(&mut self.measurement.points);
        for point in &mut points {
            if scale == ordinate {
                let zero = self.baseline_at(point.abscissa);
                point.ordinate = zero + factor * (point.ordinate - zero);
            }
            if scale == abscissa {
                point.abscissa = first + factor * (point.abscissa - first);
            }
        }
        self.measurement.points = points;
        if scale == Scale::Load {
            self.indentation
                .loads
                .iter_mut()
                .for_each(|load| *load *= factor);
        }
        if scale == Scale::ContactRadius {
            self.line_speeds
                .iter_mut()
                .for_each(|line| line.speed *= factor);
        }
    }

    /// Moves the contact radii of all points that have one by a length (m).
    pub(super) fn move_radii(&mut self, by: f64) {
        let points = self.measurement.points.iter_mut();
        for point in points.filter(|point| point.abscissa > 0.0) {
            point.abscissa += by;
        }
    }
}
