//! What all steps of a measured history need.

use interp::Curve;

use super::elastic::ElasticCurve;
use super::exponentials::Exponentials;
use crate::{Contact, Error, Input};

/// What all steps need.
pub(super) struct Setting<'a> {
    pub contact: &'a Contact,
    pub curve: ElasticCurve,
    pub law: Exponentials,
    /// Its derivatives, of the same rates.
    pub variations: Vec<Exponentials>,
    pub inputs: &'a [Input],
    /// The compliance of the spring, m/N; 0 without one.
    pub compliance: f64,
    /// The energy at which the line recedes, J/m^2, without a spring and derivatives.
    pub receding: Option<f64>,
    /// The number of derivatives; 0 if none are asked for.
    pub width: usize,
}

impl Setting<'_> {
    /// Returns the flat-punch penetration (m) by which adhesion lowers a contact that recedes and had a penetration (m)
    /// without it.
    ///
    /// With full friction it is that of a punch that sticks, because the contact has grown without adhesion.
    pub fn lowers(&self, penetration: f64) -> Result<f64, Error> {
        let Some(work) = self.receding else {
            return Ok(0.0);
        };
        let radius = self.curve.radius(penetration);
        if radius <= 0.0 {
            return Ok(0.0);
        }
        let mechanics = self.contact.mechanics();
        let edge = mechanics.edge_singularity(radius, work)?;
        let punch = self.contact.curve().and_then(Curve::stick);
        let quantities = match self.contact.system().zip(punch) {
            Some((system, punch)) => punch.quantities(radius / system.film_thickness)?,
            None => self.contact.quantities(radius)?,
        };
        Ok(mechanics
            .lowered_by(radius, edge, quantities.eeq, quantities.gamma)
            .penetration)
    }

    /// Completes the derivatives of a step: `of_fixed` with the parts that do not depend on the
    /// change of the penetration at its end, of which the load changes by `stiffness`. Returns the
    /// derivatives of the penetration.
    pub fn complete(&self, load: f64, stiffness: f64, of_fixed: &mut [f64], moved: &mut [f64]) {
        for (column, (by, moved)) in of_fixed.iter_mut().zip(moved).enumerate() {
            let place = match column {
                0 => 1.0,
                1 => load * self.compliance * self.compliance,
                _ => 0.0,
            };
            *by = (*by + stiffness * place) / (1.0 + stiffness * self.compliance);
            *moved = place - *by * self.compliance;
        }
    }
}
