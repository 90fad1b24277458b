//! Points and settings that are no measurement of contact stiffness.

use std::borrow::Cow;

use super::radius::Place;
use crate::{Direction, Error, Experiment, Kind, Parameter};

/// The largest factor `beta`, factor `epsilon` and part of the depth by which a film is thinned that
/// a measurement has.
const MOST: [(&str, f64, f64); 3] = [
    ("beta", 0.5, 2.0),
    ("epsilon", 0.0, 2.0),
    ("the thinning", 0.0, 1.0),
];

/// Why a film with a loss angle needs a hardness or measured contact radii.
pub(super) const VISCOUS: &str = "its film is viscous, and the contact radii would follow from the loads as those of an \
                                  elastic one: give a hardness, or measure contact radii";

impl Experiment {
    /// Accepts the settings of a measurement of contact stiffness.
    pub(crate) fn accept_indentation(&self) -> Result<(), Error> {
        let (kind, of) = (self.measurement.kind, &self.indentation);
        if !kind.is_stiffness() {
            return Ok(());
        }
        let values = [of.beta, of.epsilon, of.thinning];
        for ((what, least, most), value) in MOST.into_iter().zip(values) {
            if !(least..=most).contains(&value) {
                let allowed = format!("from {least} to {most}");
                return Err(self.wrong_setting(what, value, allowed));
            }
        }
        if let Some(value) = of.hardness.filter(|v| !(*v > 0.0 && v.is_finite())) {
            let allowed = "positive and finite, Pa";
            return Err(self.wrong_setting(Parameter::Hardness, value, allowed));
        }
        if of.tip_rounding.is_nan() || of.tip_rounding.abs() >= 1e-3 {
            let allowed = "below 1e-3 m: check the unit";
            return Err(self.wrong_setting(Parameter::TipRounding, of.tip_rounding, allowed));
        }
        if !(0.0..1.0).contains(&of.frame_compliance) {
            let allowed = "at least 0, and below 1 m/N: check the unit (1 nm/mN is 1e-6 m/N)";
            let value = of.frame_compliance;
            return Err(self.wrong_setting(Parameter::FrameCompliance, value, allowed));
        }
        if of.thinning > 0.0 && kind != Kind::StiffnessDepth {
            let allowed = "0 where no depth is measured: the contact depth thins the film";
            return Err(self.wrong_setting("the thinning", of.thinning, allowed));
        }
        Ok(())
    }

    /// Accepts the settings and the points of a measurement of contact stiffness.
    pub(crate) fn accept_stiffness(&self) -> Result<(), Error> {
        self.accept_indentation()?;
        let (kind, of) = (self.measurement.kind, &self.indentation);
        if !kind.is_stiffness() {
            return Ok(());
        }
        let points = &self.measurement.points;
        let count = |what: &str, found: usize, allowed: String| {
            self.wrong_setting(format!("the number of {what}"), found as f64, allowed)
        };
        if kind == Kind::StiffnessDepth && of.loads.len() != points.len() {
            let allowed = format!(
                "that of the points, {}: the contact depth needs the load of each",
                points.len()
            );
            return Err(count("loads", of.loads.len(), allowed));
        }
        if !of.phases.is_empty() && of.phases.len() != points.len() {
            let allowed = format!("0, or that of the points, {}", points.len());
            return Err(count("phases", of.phases.len(), allowed));
        }
        if !of.phases.is_empty() && self.is_elastic_load() {
            return Err(self.not_fitted(VISCOUS));
        }
        self.accept_directions()?;
        let thickness = self.bodies.top_thickness();
        let [abscissa, ordinate] = kind.names();
        for (i, point) in points.iter().enumerate() {
            let refused =
                |name, value, allowed| Err(self.refused(point.line, name, value, allowed));
            let loads = (kind == Kind::StiffnessDepth).then(|| ("load", of.loads[i]));
            let numbers = [(ordinate, point.ordinate), (abscissa, point.abscissa)];
            for (name, value) in numbers.into_iter().chain(loads) {
                if !(value > 0.0 && value < 1e100) {
                    let allowed = "positive and finite: leave out rows without contact, and those under tension";
                    return refused(name, value, allowed);
                }
            }
            if let Some(&phase) = of
                .phases
                .get(i)
                .filter(|phase| phase.is_nan() || phase.abs() >= 1.57)
            {
                let allowed = "between -1.57 and 1.57 rad: check its unit";
                return refused("phase", phase, allowed);
            }
            let stiffness = 1.0 / point.ordinate - of.frame_compliance;
            if stiffness.is_nan() || stiffness <= 0.0 {
                let allowed = "below the stiffness of the frame, 1/frame-compliance";
                return refused(ordinate, point.ordinate, allowed);
            }
            if let Some(Place { radius, depth }) = self.measured_place(i)
                && kind == Kind::StiffnessDepth
            {
                if radius.is_nan() || radius <= 0.0 {
                    let allowed = "such that the contact depth and the area there are positive: \
                                   check the units, or leave out the first rows";
                    return refused("contact depth", depth, allowed);
                }
                if thickness.is_some_and(|thickness| {
                    let thinned = of.thinning * depth;
                    thinned.is_nan() || thinned >= thickness
                }) {
                    let allowed = "such that something of the thinned film is left: leave out the \
                                   deepest rows, or thin it by a smaller part";
                    return refused("contact depth", depth, allowed);
                }
            }
        }
        Ok(())
    }

    /// Accepts the directions of points of which a load or a depth tells the contact radius.
    pub(super) fn accept_directions(&self) -> Result<(), Error> {
        if self.measurement.kind == Kind::StiffnessRadius {
            return Ok(());
        }
        let mut points = self.measurement.points.iter();
        match points.find(|point| point.direction == Some(Direction::Retract)) {
            None => Ok(()),
            Some(point) => Err(Error::setting(
                format!(
                    "the retract of {}, {} {}",
                    self.measurement.name, self.measurement.numbering, point.line
                ),
                point.abscissa,
                "left out: while a sample is unloaded its load and its depth do not tell the \
                 contact radius",
            )),
        }
    }

    /// Returns why a parameter has no effect on a contact stiffness, if it has none. The bodies have
    /// the parameter.
    pub(crate) fn why_without_effect_on_stiffness(
        &self,
        parameter: Parameter,
    ) -> Option<Cow<'static, str>> {
        let kind = self.measurement.kind;
        let is_elastic = self.is_elastic_load();
        Some(Cow::Borrowed(match parameter {
            Parameter::WorkOfAdhesion if !is_elastic => {
                "a contact stiffness depends on adhesion only where an elastic load tells the \
                 contact radius"
            }
            Parameter::WorkOfAdhesionReceding => "the contact stiffness is that of loading",
            Parameter::LoadOffset | Parameter::Baseline | Parameter::BaselineSlope => {
                "a contact stiffness is measured, and its loads have no zero of their own"
            }
            Parameter::ContactPoint => {
                "a contact stiffness is measured; where depths tell the contact radius, \
                 tip-rounding takes its place"
            }
            Parameter::Stiffness => "no height of a cantilever is measured",
            Parameter::Hardness if kind != Kind::StiffnessLoad => {
                "the contact radius does not follow from a load"
            }
            Parameter::TipRounding if kind != Kind::StiffnessDepth => "no depth is measured",
            _ => return None,
        }))
    }
}
