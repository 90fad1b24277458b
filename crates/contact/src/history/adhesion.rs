//! What adhesion adds to a contact that recedes.

use interp::Curve;

use super::HistoryError;
use crate::{Contact, Error};

/// Adhesion of the receding line.
#[derive(Clone, Copy)]
pub(super) struct Adhesion<'a> {
    pub contact: &'a Contact,
    /// The energy at which the line recedes, J/m^2.
    pub work: f64,
}

impl Adhesion<'_> {
    /// Returns the flat-punch penetration (m) by which adhesion lowers a contact of a radius (m).
    ///
    /// With full friction it is that of a punch that sticks, because the contact has grown without adhesion.
    pub fn lowers(self, radius: f64) -> Result<f64, HistoryError> {
        if radius <= 0.0 {
            return Ok(0.0);
        }
        let mechanics = self.contact.mechanics();
        let edge = mechanics.edge_singularity(radius, self.work)?;
        let quantities = match self
            .contact
            .system()
            .zip(self.contact.curve().and_then(Curve::stick))
        {
            Some((system, punch)) => {
                let found = punch.quantities(radius / system.film_thickness);
                found.map_err(Error::from)?
            }
            None => self.contact.quantities(radius)?,
        };
        Ok(mechanics
            .lowered_by(radius, edge, quantities.eeq, quantities.gamma)
            .penetration)
    }
}
