//! The contact radii among which states are sought.

use crate::Contact;
use crate::Error;
use crate::bodies::Bodies;
use interp::{Curve, Probe};

/// The radius (m) from which a search starts where the range begins at 0.
const SMALLEST: f64 = 1e-60;
/// The largest radius of a search over that of the shape, which a contact must stay below. A radius
/// keeps this distance through its logarithm and back.
const BELOW_LARGEST: f64 = 1.0 - 1e-12;
/// The relative rounding of a radius through its logarithm and back.
const ROUNDING: f64 = 1e-14;

impl Contact {
    /// Returns the smallest and the largest contact radius (m) among which states are sought.
    ///
    /// They are those of the curve's nodes, but the range ends below the sphere's radius `R`, at `R
    /// (1 - 1e-12)`. It begins at 0 on a half-space, and on a film if the expansion for thick films
    /// is accurate enough at all radii below the nodes, as it is on the embedded table. Searches
    /// replace 0 by 1e-60 m (or by the radius of the smallest node, if that is smaller).
    ///
    /// Under another probe than a sphere the range ends where the shape is known no further, and at
    /// 1e3 m at most. That of a flat end begins at its radius, and that of a flat punch consists of
    /// its radius.
    ///
    /// The range is empty, its beginning above its end, if the curve has no radius below `R`.
    pub fn contact_radius_range(&self) -> [f64; 2] {
        let [least, most] = self.mechanics().radii();
        if self.is_punch() {
            return [0.5 * (least + most); 2];
        }
        let most = BELOW_LARGEST * most;
        let [from, to] = self.node_radii().unwrap_or([0.0, most]);
        let from = if self.extends_to_zero() { 0.0 } else { from };
        [from.max(least), to.min(most)]
    }

    /// Tells whether the range begins at the contact of a flat end, below which there is none. It does not where
    /// the curve's nodes begin above the radius of the end.
    pub(crate) fn begins_at_flat_end(&self) -> bool {
        let [least, _] = self.mechanics().radii();
        self.is_punch() || (least > 0.0 && self.contact_radius_range()[0] == least)
    }

    /// Returns the contact radius of a logarithm of the search. At the ends of the range it is
    /// exactly the end.
    pub(crate) fn radius_at(&self, u: f64) -> f64 {
        let [least, most] = self.mechanics().radii();
        if self.is_punch() {
            // Between them lies nothing but the rounding of its radius.
            return f64::midpoint(least, most);
        }
        let a = u.exp();
        if a <= least * (1.0 + ROUNDING) {
            least
        } else {
            a
        }
    }

    /// Returns the smallest and the largest contact radius (m) of the curve's nodes; `None` on a
    /// half-space.
    pub(crate) fn node_radii(&self) -> Option<[f64; 2]> {
        match &self.bodies {
            Bodies::Coated { system, curve, .. } => {
                let radius = |a_over_t| a_over_t * system.film_thickness;
                Some(curve.range().map(radius))
            }
            Bodies::HalfSpace(_) => None,
        }
    }

    /// Returns the range of a search: [`Contact::contact_radius_range`] with a positive beginning.
    ///
    /// # Errors
    /// [`interp::Error::BeyondSphere`] if it is empty.
    pub(crate) fn search_range(&self) -> Result<[f64; 2], Error> {
        let [from, to] = self.search_ends();
        self.mechanics().check_radius(from)?;
        Ok([from, to])
    }

    /// Returns the ends of [`Contact::search_range`], whether it is empty or not.
    fn search_ends(&self) -> [f64; 2] {
        let [from, to] = self.contact_radius_range();
        let node = self.node_radii().map_or(SMALLEST, |[node, _]| node);
        [from.max(SMALLEST.min(node)), to]
    }

    /// Makes the error of a state whose contact radius is outside the range of a search.
    pub(crate) fn outside(&self, name: &'static str, value: f64) -> Error {
        let [from, to] = self.search_ends();
        let [_, most] = self.mechanics().radii();
        // On a film most shapes end where the curve does; a sphere ends at a part of its radius, and a profile at its
        // last point.
        let probe = self.probe();
        let is_own = matches!(probe, Probe::Sphere { .. }) || most == probe.contact_radii()[1];
        Error::OutsideRadii {
            name,
            value,
            from,
            to,
            at_end_of_probe: is_own && to == BELOW_LARGEST * most,
        }
    }

    /// Tells whether there are states of all contact radii below the nodes.
    fn extends_to_zero(&self) -> bool {
        self.curve().is_none_or(Curve::goes_on_to_zero)
    }
}
