//! The contact radii of points.

use std::f64::consts::PI;

use contact::{Contact, Control};

use super::Indentation;
use crate::{Experiment, Kind};

/// The contact of a point: its radius and, where a depth tells it, its contact depth, m.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    pub radius: f64,
    pub depth: f64,
}

impl Indentation {
    /// Returns the contact depth (m) of the depth `h` (m) that the sample is indented, a load (N)
    /// and a stiffness (N/m).
    pub(super) fn depth_of(&self, h: f64, load: f64, stiffness: f64) -> f64 {
        let [factor, epsilon] = self.contact_depth.factors(self.epsilon);
        factor * (h - epsilon * load / stiffness + self.tip_rounding)
    }

    /// Returns the depth (m) that belongs to a contact depth: the inverse of [`Self::depth_of`].
    pub(super) fn indented(&self, contact_depth: f64, load: f64, stiffness: f64) -> f64 {
        let [factor, epsilon] = self.contact_depth.factors(self.epsilon);
        contact_depth / factor + epsilon * load / stiffness - self.tip_rounding
    }
}

impl Experiment {
    /// Returns the contact of a point, NaN where there is none. `measured` is the stiffness that was
    /// read there; an elastic contact is found with the equilibria of `contact`.
    pub(super) fn place(
        &self,
        i: usize,
        measured: f64,
        contact: &Contact,
    ) -> Result<Place, contact::Error> {
        if let Some(place) = self.place_without_contact(i, measured) {
            return Ok(place);
        }
        let equilibria = contact.equilibria(self.work_of_adhesion, Control::Load)?;
        let state = equilibria.loading(self.measurement.points[i].abscissa)?;
        let (radius, depth) = (state.contact_radius, 0.0);
        Ok(Place { radius, depth })
    }

    /// Returns the contact of a point as [`Self::place`]; `None` where it follows from elasticity.
    pub(super) fn place_without_contact(&self, i: usize, measured: f64) -> Option<Place> {
        let of = &self.indentation;
        let abscissa = self.measurement.points[i].abscissa;
        let at = |radius| Place { radius, depth: 0.0 };
        Some(match (self.measurement.kind, of.hardness) {
            (Kind::StiffnessDepth, _) => {
                let load = of.loads.get(i).copied().unwrap_or(f64::NAN);
                let stiffness = 1.0 / (1.0 / measured - of.frame_compliance);
                let h = abscissa - of.frame_compliance * load;
                let depth = of.depth_of(h, load, stiffness);
                Place {
                    radius: if stiffness > 0.0 {
                        of.area.radius(depth)
                    } else {
                        f64::NAN
                    },
                    depth,
                }
            }
            (Kind::StiffnessLoad, Some(hardness)) => at((abscissa / (PI * hardness)).sqrt()),
            (Kind::StiffnessLoad, None) => return None,
            _ => at(abscissa),
        })
    }

    /// Tells whether the shape of the probe and the work of adhesion matter: everywhere but for a contact
    /// stiffness whose contact radii do not follow from loads by elasticity.
    pub const fn has_shape(&self, hardness_is_free: bool) -> bool {
        !self.measurement.kind.is_stiffness() || self.is_elastic_load() && !hardness_is_free
    }

    /// Tells whether the contact radii of a contact stiffness follow from loads by elasticity.
    pub(crate) const fn is_elastic_load(&self) -> bool {
        matches!(self.measurement.kind, Kind::StiffnessLoad) && self.indentation.hardness.is_none()
    }
}
