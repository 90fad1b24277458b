//! The readings of an instrument, and their calibration.

use super::{Experiment, Fixed, Kind};
use crate::statistics::{extremes, range};

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

    /// Returns the move of the readings that is as large as what is read: the largest contact radius (m) of a zero of contact
    /// radii, and of a drift the range of the penetrations or heights over the duration (m/s); `None` where there is none.
    pub(crate) fn largest_move(&self, one: Fixed) -> Option<f64> {
        let points = &self.measurement.points;
        let abscissae = points.iter().map(|point| point.abscissa);
        let [abscissa, _] = self.measurement.kind.scales();
        let size = match (one, abscissa) {
            (Fixed::ContactRadiusZero, Scale::ContactRadius) => extremes(abscissae)[1],
            (Fixed::PositionDrift, Scale::Penetration | Scale::Height)
                if self.times.len() == points.len() =>
            {
                range(abscissae) / range(self.times.iter().copied())
            }
            _ => return None,
        };
        (size > 0.0 && size.is_finite()).then_some(size)
    }

    /// Moves penetrations or heights by a speed (m/s) times the time since the first point.
    pub(super) fn move_positions(&mut self, speed: f64) {
        let Some(&begin) = self.times.first() else {
            return;
        };
        for (point, time) in self.measurement.points.iter_mut().zip(&self.times) {
            point.abscissa += speed * (time - begin);
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
