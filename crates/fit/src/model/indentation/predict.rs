//! The stiffness that the model predicts, as the logarithm that a fit compares.
//!
//! The stiffness of one file spans two decades and has a noise in per cent, so that the fit compares
//! its logarithm.

use super::sample::Sample;
use crate::model::differences::ContactOf;
use crate::model::predicted::Predicted;
use crate::statistics::range;
use crate::{Branch, Error, Experiment, Kind};

/// The change of the logarithm of a stiffness by which the part of its noise that is in the contact
/// depth is found.
const STEP: f64 = 1e-4;

impl Experiment {
    /// Returns the number of a point that a fit compares: the ordinate, or the logarithm of a
    /// stiffness.
    pub(crate) fn compared(&self, i: usize) -> f64 {
        let ordinate = self.measurement.points[i].ordinate;
        if self.measurement.kind.is_stiffness() {
            ordinate.ln()
        } else {
            ordinate
        }
    }

    /// Returns the range of the numbers of all points that a fit compares.
    pub(crate) fn compared_range(&self) -> f64 {
        range((0..self.measurement.points.len()).map(|i| self.compared(i)))
    }

    /// Returns the ordinate of a number that a fit compares.
    pub(crate) fn ordinate_of(&self, compared: f64) -> f64 {
        if self.measurement.kind.is_stiffness() {
            compared.exp()
        } else {
            compared
        }
    }

    /// Returns the standard deviation of the number of a point that a fit compares, where the point
    /// has one of its own.
    pub(crate) fn own_deviation(&self, i: usize) -> Option<f64> {
        let reading = self.measurement.points[i].ordinate;
        Some(self.errors.ordinate.get(i)? / self.measurement.kind.scale(reading))
    }

    /// Predicts the logarithms of the stiffness (N/m) that is read at all points that are not left
    /// out; NaN where the model has no contact.
    pub(crate) fn predict_stiffness(
        &self,
        contact_of: &ContactOf<'_>,
        branches: &[Branch],
    ) -> Result<Predicted, Error> {
        let count = self.measurement.points.len();
        let mut predicted = Predicted::new(vec![f64::NAN; count], 0);
        let counts = |i: &usize| branches[*i] != Branch::LeftOut;
        let sample = self.sample(contact_of, branches)?;
        for i in (0..count).filter(counts) {
            let (radius, stiffness) = self.stiffness_at(i, self.compared(i), &sample)?;
            predicted.radii[i] = radius;
            predicted.values[i] = stiffness.ln();
        }
        if !self.indentation.phases.is_empty() {
            self.predict_storage(contact_of, branches, &mut predicted)?;
        }
        // The frame is in series with the contact.
        let compliance = self.indentation.frame_compliance;
        if compliance != 0.0 && self.indentation.phases.is_empty() {
            for value in &mut predicted.values {
                *value = -((-*value).exp() + compliance).ln();
            }
        }
        Ok(predicted)
    }

    /// Makes the contacts of the sample, for the deepest of its points.
    pub(super) fn sample(
        &self,
        contact_of: &ContactOf<'_>,
        branches: &[Branch],
    ) -> Result<Sample, Error> {
        let of = &self.indentation;
        let mut most = 0.0_f64;
        if of.thinning > 0.0 && self.measurement.kind == Kind::StiffnessDepth {
            let contact = contact_of(&self.bodies, &[])?;
            for i in (0..branches.len()).filter(|&i| branches[i] != Branch::LeftOut) {
                let place = self.place(i, self.measurement.points[i].ordinate, &contact)?;
                most = most.max(of.thinning * place.depth);
            }
        }
        Sample::new(&self.bodies, contact_of, most)
    }

    /// Returns the contact radius (m) of a point of which the logarithm of the stiffness was read,
    /// and the stiffness (N/m) of the sample with the factor `beta`.
    pub(super) fn stiffness_at(
        &self,
        i: usize,
        compared: f64,
        sample: &Sample,
    ) -> Result<(f64, f64), Error> {
        let place = self.place(i, compared.exp(), sample.contact())?;
        if place.radius.is_nan() || place.radius <= 0.0 {
            return Ok((0.0, f64::NAN));
        }
        let thinner = self.indentation.thinning * place.depth;
        let stiffness = sample.stiffness(place.radius, thinner)?;
        Ok((place.radius, self.indentation.beta * stiffness))
    }

    /// Returns the factor of the noise of each point: a stiffness that is read too high also makes
    /// the contact depth too high, and with it the stiffness that is predicted. Empty where the
    /// contact radius does not depend on the stiffness.
    pub(crate) fn noise_factors(
        &self,
        contact_of: &ContactOf<'_>,
        branches: &[Branch],
    ) -> Result<Vec<f64>, Error> {
        if self.measurement.kind != Kind::StiffnessDepth {
            return Ok(Vec::new());
        }
        let sample = self.sample(contact_of, branches)?;
        let factor = |i: usize| {
            if branches[i] == Branch::LeftOut {
                return Ok(1.0);
            }
            let at = |by: f64| {
                let (_, stiffness) = self.stiffness_at(i, self.compared(i) + by, &sample)?;
                let read = 1.0 / (1.0 / stiffness + self.indentation.frame_compliance);
                Ok::<_, Error>(read.ln())
            };
            let slope = (at(STEP)? - at(-STEP)?) / (2.0 * STEP);
            Ok((1.0 - slope).abs())
        };
        (0..branches.len()).map(factor).collect()
    }
}
