//! Synthetic measurements of contact stiffness.

use std::f64::consts::PI;

use super::accept::VISCOUS;
use super::sample::Sample;
use crate::model::differences::ContactOf;
use crate::{Branch, Error, Experiment, Kind};

/// The contact radii (m) among which that of a depth is searched.
const RADII: [f64; 2] = [1e-12, 1.0];
/// The bisections of the logarithm of a contact radius.
const BISECTIONS: usize = 200;

impl Experiment {
    /// Gives the points the stiffness that the model has there, those at depths the loads of the
    /// hardness, and with a loss tangent the phases.
    pub(crate) fn make_stiffness(&mut self, contact_of: &ContactOf<'_>) -> Result<(), Error> {
        self.accept_directions()?;
        let loss_tangent = self.indentation.loss_tangent;
        if !(0.0..=1.0).contains(&loss_tangent) {
            let allowed = "from 0 to 1, where the phases are exact to 1 %";
            return Err(self.wrong_setting("the loss tangent", loss_tangent, allowed));
        }
        if loss_tangent > 0.0 && self.is_elastic_load() {
            return Err(self.not_fitted(VISCOUS));
        }
        self.indentation.phases.clear();
        let count = self.measurement.points.len();
        let branches = vec![Branch::Advancing; count];
        if self.measurement.kind == Kind::StiffnessDepth {
            self.make_depths(contact_of)?;
            return Ok(());
        }
        let predicted = self.predict_stiffness(contact_of, &branches)?;
        for (point, value) in self.measurement.points.iter_mut().zip(predicted.values) {
            point.ordinate = value.exp();
        }
        if loss_tangent > 0.0 {
            self.make_phases(contact_of, &branches)?;
        }
        Ok(())
    }

    /// Makes stiffness and load at depths, `P = H pi a^2`.
    fn make_depths(&mut self, contact_of: &ContactOf<'_>) -> Result<(), Error> {
        let of = self.indentation.clone();
        let Some(hardness) = of.hardness else {
            let allowed = "given: the loads of simulated depths follow from it";
            return Err(self.wrong_setting("the hardness", f64::NAN, allowed));
        };
        let depths = self.measurement.points.iter().map(|point| point.abscissa);
        let deepest = depths.fold(0.0, f64::max);
        let samples = self.samples(contact_of, of.thinning * 1.2 * deepest)?;
        // Below it nothing is solved.
        let of_sample = |sample: &Sample| sample.contact().contact_radius_range()[0];
        let smallest = samples.iter().map(of_sample).fold(0.0, f64::max);
        let (mut loads, mut phases) = (Vec::new(), Vec::new());
        for i in 0..self.measurement.points.len() {
            let target = self.measurement.points[i].abscissa;
            // The depth, the load, the stiffness and the phase that are read at a contact radius.
            let at = |radius: f64| {
                let contact_depth = of.area.depth(radius);
                let load = PI * hardness * radius * radius;
                let thinner = of.thinning * contact_depth;
                let [read, phase] = self.read_at(&samples, radius, thinner)?;
                let stiffness = 1.0 / (1.0 / read - of.frame_compliance);
                let h = of.indented(contact_depth, load, stiffness);
                Ok::<_, Error>((h + of.frame_compliance * load, load, read, phase))
            };
            let [least, most] = RADII;
            let [mut low, mut high] = [least.max(smallest), most].map(f64::ln);
            for _ in 0..BISECTIONS {
                let middle = 0.5 * (low + high);
                // No contact is wider than the reach of the sample.
                let too_deep = at(middle.exp())
                    .ok()
                    .is_none_or(|(h, ..)| h.is_nan() || h >= target);
                if too_deep {
                    high = middle;
                } else {
                    low = middle;
                }
            }
            let (h, load, stiffness, phase) = at(low.exp())?;
            let apart = (h / target - 1.0).abs();
            if apart.is_nan() || apart >= 1e-6 {
                let allowed = "a depth at which the model has a contact: deeper than the tip \
                               rounding, and within the reach of the sample";
                let line = self.measurement.points[i].line;
                return Err(self.refused(line, "penetration", target, allowed));
            }
            loads.push(load);
            if of.loss_tangent > 0.0 {
                phases.push(phase);
            }
            self.measurement.points[i].ordinate = stiffness;
        }
        (self.indentation.loads, self.indentation.phases) = (loads, phases);
        Ok(())
    }
}
