//! Values to start from, and the reach of contacts.

use std::f64::consts::PI;

use super::radius::Place;
use crate::statistics::median;
use crate::{Experiment, Kind, Parameter, Reach};

/// How far contacts reach beyond the radii that the start of the fit has.
const MARGIN: f64 = 1.5;

/// What starts and doubts ask of the points of a contact stiffness.
impl Experiment {
    /// Returns the hardness that the loads and stiffnesses tell with the modulus of the substrate, or of the film on a rigid
    /// substrate, `(4/pi) beta^2 E*^2 P/S^2`. With no modulus of a film that `is_unknown`, it is the hardness with which
    /// the widest contact is as wide as the film is thick.
    pub(crate) fn hardness_to_start_from(
        &self,
        is_unknown: impl Fn(Parameter) -> bool,
    ) -> Option<f64> {
        if self.measurement.kind != Kind::StiffnessLoad {
            return None;
        }
        let base = self.bodies.base().filter(|base| base.young().is_finite());
        if base.is_none()
            && is_unknown(Parameter::FilmModulus)
            && let Some(thickness) = self.bodies.thickness()
        {
            let loads = self.measurement.points.iter().map(|point| point.abscissa);
            return Some(loads.fold(0.0, f64::max) / (PI * thickness * thickness));
        }
        let solid = base.unwrap_or_else(|| self.bodies.film());
        let sphere = self.get(Parameter::SphereModulus)?;
        let compound = 1.0 / (1.0 / solid.reduced() + 1.0 / sphere);
        let points = self.measurement.points.iter();
        let ratios = points.map(|point| point.abscissa / point.ordinate.powi(2));
        let stiffness = 2.0 * self.indentation.beta * compound;
        let hardness = stiffness * stiffness * median(ratios.collect()) / PI;
        (hardness > 0.0 && hardness.is_finite()).then_some(hardness)
    }

    /// Returns the modulus of the film or of the sphere that a half-space would have with the
    /// stiffness of these points.
    pub(crate) fn modulus_of_half_space(&self, parameter: Parameter) -> Option<f64> {
        let beta = self.indentation.beta;
        let points = 0..self.measurement.points.len();
        let moduli = points.map(|i| {
            let point = &self.measurement.points[i];
            let stiffness = point.ordinate / beta;
            match self.measured_place(i) {
                Some(place) => stiffness / (2.0 * place.radius),
                None => {
                    let radius = self.bodies.probe.radius().unwrap_or(f64::NAN);
                    (stiffness.powi(3) / (6.0 * radius * point.abscissa)).sqrt()
                }
            }
        });
        let compound = median(moduli.collect());
        let other = match parameter {
            Parameter::SphereModulus => self.bodies.film().reduced(),
            _ => self.get(Parameter::SphereModulus)?,
        };
        let modulus = self.bodies.modulus_beside(parameter, compound, other);
        (modulus > 0.0 && modulus.is_finite()).then_some(modulus)
    }

    /// Returns the measured contact of a point; `None` where it follows from elasticity.
    pub(super) fn measured_place(&self, i: usize) -> Option<Place> {
        self.place_without_contact(i, self.measurement.points[i].ordinate)
    }

    /// Returns the contact depths of all points, m.
    pub(crate) fn contact_depths(&self) -> Vec<f64> {
        let points = 0..self.measurement.points.len();
        let places = points.filter_map(|i| self.measured_place(i));
        places.map(|place| place.depth).collect()
    }

    /// Returns the largest contact radius of the points, m.
    pub(crate) fn largest_radius(&self) -> f64 {
        let points = 0..self.measurement.points.len();
        let radius = |i: usize| {
            let load = self.measurement.points[i].abscissa;
            self.measured_place(i)
                .map_or_else(|| self.elastic_radius(load), |place| place.radius)
        };
        points.map(radius).fold(0.0, f64::max)
    }

    /// Lets contacts on layers reach as far as the points of a contact stiffness need them.
    pub(crate) fn reach_contacts(&mut self) {
        if !self.measurement.kind.is_stiffness() {
            return;
        }
        let mut widest = self.largest_radius();
        if self.measurement.kind == Kind::StiffnessDepth {
            // Before the stiffness is there, no contact depth is larger than the depth.
            let depths = self.measurement.points.iter().map(|point| point.abscissa);
            let deepest =
                1.2 * (depths.fold(0.0, f64::max) + self.indentation.tip_rounding.max(0.0));
            widest = widest.max(self.indentation.area.radius(deepest));
        }
        let needed = self.bodies.reach.needed;
        self.bodies.reach = Reach::up_to((MARGIN * widest).max(needed));
    }

    /// Returns an upper estimate of the contact radius at a load (N): that of JKR on the softest of
    /// the bodies.
    fn elastic_radius(&self, load: f64) -> f64 {
        let bodies = &self.bodies;
        let softest = if bodies.are_layered() {
            let layers = bodies.layers.iter();
            layers
                .map(|layer| layer.layer.solid.reduced())
                .fold(bodies.base.reduced(), f64::min)
        } else {
            bodies.film().reduced()
        };
        let sphere = self.get(Parameter::SphereModulus).unwrap_or(f64::INFINITY);
        let compound = 1.0 / (1.0 / softest + 1.0 / sphere);
        let radius = self.bodies.probe.radius().unwrap_or(f64::NAN);
        let pull = 3.0 * PI * self.work_of_adhesion * radius;
        let jkr = load + pull + (2.0 * pull * load + pull * pull).sqrt();
        (0.75 * radius * jkr / compound).cbrt().min(radius)
    }
}
