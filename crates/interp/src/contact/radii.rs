//! The contact radii among which states are sought.

use super::Contact;
use super::contact::Bodies;
use crate::{Curve, Error};

/// The radius (m) from which a search starts where the range begins at 0.
const SMALLEST: f64 = 1e-60;
/// The radius (m) at which a search ends where the range is not bounded.
const LARGEST: f64 = 1e60;

impl Contact {
    /// Returns the smallest and the largest contact radius (m) among which states are sought.
    ///
    /// They are those of the curve's nodes. The range begins at 0 if the expansion for thick films
    /// is accurate enough at all radii below the nodes, as it is on the embedded table. On a
    /// half-space the range is 0 to infinity. Searches replace 0 by 1e-60 m (or by the radius of
    /// the smallest node, if that is smaller) and infinity by 1e60 m.
    pub fn contact_radius_range(&self) -> [f64; 2] {
        match self.node_radii() {
            Some([from, to]) => [if self.extends_to_zero() { 0.0 } else { from }, to],
            None => [0.0, f64::INFINITY],
        }
    }

    /// Returns the smallest and the largest contact radius (m) of the curve's nodes; `None` on a
    /// half-space.
    pub(super) fn node_radii(&self) -> Option<[f64; 2]> {
        match &self.bodies {
            Bodies::Coated { system, curve } => {
                let radius = |a_over_t| a_over_t * system.film_thickness;
                Some(curve.range().map(radius))
            }
            Bodies::HalfSpace(_) => None,
        }
    }

    /// Returns the range of a search: [`Contact::contact_radius_range`] with positive finite ends.
    pub(super) fn search_range(&self) -> [f64; 2] {
        let [from, to] = self.node_radii().unwrap_or([SMALLEST, LARGEST]);
        let from = if self.extends_to_zero() {
            SMALLEST.min(from)
        } else {
            from
        };
        [from, to]
    }

    /// Makes the error of a state whose contact radius is outside the range of a search.
    pub(super) fn outside(&self, name: &'static str, value: f64) -> Error {
        let [from, to] = self.search_range();
        Error::OutsideRadii {
            name,
            value,
            from,
            to,
        }
    }

    /// Tells whether there are states of all contact radii below the nodes.
    fn extends_to_zero(&self) -> bool {
        self.curve().is_none_or(Curve::goes_on_to_zero)
    }
}
