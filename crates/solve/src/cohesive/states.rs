//! The states at given contact radii, and the fields in them.

use crate::Error;
use crate::cohesive::annulus::Annulus;
use crate::cohesive::checks::Solution;
use crate::cohesive::fixed_radius::{FixedRadius, Part};
use crate::cohesive::{Cohesive, CohesiveState, SMALLEST, search};

impl Cohesive {
    /// Returns the state at the contact radius `a`, m.
    ///
    /// Of several outer radii at which the gap is `z0`, it is the smallest.
    ///
    /// # Errors
    /// [`Error::Domain`] for a radius below [`SMALLEST`] or beyond that of the sphere;
    /// [`Error::AnnulusReach`] for one beyond [`REACH`](crate::cohesive::REACH), or whose annulus is;
    /// [`Error::NotAContact`] where the contact would open inside, or the gap in the annulus is not
    /// between 0 and `z0`.
    pub fn state(&self, contact_radius: f64) -> Result<CohesiveState, Error> {
        let mut contact = self.fixed(contact_radius)?;
        let solution = self.solution(&mut contact, contact_radius, None)?;
        self.check(&solution)?;
        let Solution { annulus, part, .. } = &solution;
        Ok(self.in_si([annulus.inner, annulus.outer], part.load, part.penetration))
    }

    /// Returns the pressure (Pa, positive in compression) at the radii `r` (m) inside the contact of
    /// radius `a`, m. It falls to `-sigma0` at `r = a`.
    ///
    /// # Errors
    /// As [`Cohesive::state`], and [`Error::Domain`] for a radius outside the contact.
    pub fn pressure(&self, contact_radius: f64, radii: &[f64]) -> Result<Vec<f64>, Error> {
        for &r in radii {
            Error::check("radius", r, [0.0, contact_radius])?;
        }
        let mut contact = self.fixed(contact_radius)?;
        let solution = self.solution(&mut contact, contact_radius, None)?;
        let stress = 0.5 * self.traction * self.modulus;
        let pressure = |r: &f64| stress * solution.pressure(r / self.thickness);
        Ok(radii.iter().map(pressure).collect())
    }

    /// Returns the gap (m) at the radii `r` (m) outside the contact of radius `a`, m.
    ///
    /// # Errors
    /// As [`Cohesive::state`], and [`Error::Domain`] for a radius inside the contact or beyond twice
    /// the outer radius of the attraction.
    pub fn gap(&self, contact_radius: f64, radii: &[f64]) -> Result<Vec<f64>, Error> {
        let mut contact = self.fixed(contact_radius)?;
        let solution = self.solution(&mut contact, contact_radius, None)?;
        let farthest = 2.0 * solution.annulus.outer * self.thickness;
        for &r in radii {
            Error::check("radius", r, [contact_radius, farthest])?;
        }
        let scaled: Vec<f64> = radii.iter().map(|r| r / self.thickness).collect();
        let gaps = solution.gaps(&scaled);
        Ok(gaps.into_iter().map(|gap| gap * self.thickness).collect())
    }

    /// Returns `count` radii, evenly spaced in their logarithm between the ends of `contact_radii`.
    ///
    /// # Errors
    /// [`Error::Domain`] for fewer than two radii.
    pub fn branch_radii(contact_radii: [f64; 2], count: usize) -> Result<Vec<f64>, Error> {
        Error::check("number of radii", count as f64, [2.0, 1e6])?;
        let [from, to] = contact_radii;
        let radius = |i: usize| match i {
            0 => from,
            _ if i == count - 1 => to,
            _ => from * (to / from).powf(i as f64 / (count - 1) as f64),
        };
        Ok((0..count).map(radius).collect())
    }

    /// Prepares a contact radius, m.
    fn fixed(&self, contact_radius: f64) -> Result<FixedRadius<'_>, Error> {
        let range = [SMALLEST * self.thickness, self.sphere_radius];
        Error::check("contact radius", contact_radius, range)?;
        // A radius that differs from the reach by rounding has no annulus.
        if contact_radius >= (1.0 - 1e-12) * self.reach() * self.thickness {
            return Err(self.beyond_reach(contact_radius));
        }
        let radius = contact_radius / self.thickness;
        FixedRadius::new(radius, &self.symbol)
            .ok_or_else(|| self.no_contact(radius, "rounding has left no digits"))
    }

    /// The error of a contact radius (m) at which the attraction acts farther than is solved.
    fn beyond_reach(&self, contact_radius: f64) -> Error {
        Error::AnnulusReach {
            contact_radius,
            reach: self.reach() * self.thickness,
        }
    }

    /// Solves a contact radius, m, with an annulus near a `width` if one is given.
    pub(super) fn solution<'a>(
        &'a self,
        contact: &'a mut FixedRadius<'_>,
        contact_radius: f64,
        width: Option<f64>,
    ) -> Result<Solution<'a>, Error> {
        let annulus = self.annulus(contact, contact_radius, width)?;
        let (parts, q) = contact.parts(&annulus);
        Ok(Solution {
            bodies: self,
            annulus,
            part: Part::sum(&parts, [self.curvature, self.traction]),
            q,
        })
    }

    /// Finds the smallest annulus at whose outer radius the gap is `z0`.
    fn annulus(
        &self,
        contact: &mut FixedRadius<'_>,
        contact_radius: f64,
        width: Option<f64>,
    ) -> Result<Annulus, Error> {
        /// The largest growth of `tan(phi)^2` from one trial to the next.
        const GROWTH: f64 = 2.5;
        /// The first growth near a known width.
        const NEAR: f64 = 1.2;
        let radius = contact_radius / self.thickness;
        let reach = self.reach();
        // The square of tan(phi), with which the gap grows almost linearly: for a known width, or
        // for a short range, (pi/4) es w/sigma0^2 beside a long crack, and a long one, in which the
        // bodies keep their shapes. Either alone would open the gap, and the inverse squares add.
        let square = |width: f64| width * (width + 2.0 * radius) / (radius * radius);
        let farthest = ((reach / radius).powi(2) - 1.0).max(0.0);
        let (first, mut growth) = if let Some(width) = width {
            (square(width) / NEAR.sqrt(), NEAR)
        } else {
            let short = square(2.0 * self.zone());
            let long = 2.0 * self.range / (self.curvature * radius * radius);
            (short * long / (short + long) / GROWTH, GROWTH)
        };
        let mut low = first.min(farthest);
        let weights = [self.curvature, self.traction];
        let mut excess = |square: f64| {
            let (parts, _) = contact.parts(&Annulus::new(radius, square.sqrt()));
            weights[0] * parts[0].opening + weights[1] * parts[1].opening - self.range
        };
        let mut value = excess(low);
        let mut high = None;
        while value > 0.0 && low >= f64::MIN_POSITIVE {
            high = Some((low, value));
            low /= growth;
            growth = GROWTH;
            value = excess(low);
        }
        if low < f64::MIN_POSITIVE {
            return Err(Error::NarrowAnnulus {
                contact_radius,
                range: self.range * self.thickness,
            });
        }
        let high = loop {
            if let Some(high) = high {
                break high;
            }
            if low >= farthest {
                return Err(self.beyond_reach(contact_radius));
            }
            let next = (growth * low).min(farthest);
            growth = GROWTH;
            let there = excess(next);
            if there < 0.0 {
                (low, value) = (next, there);
            } else {
                high = Some((next, there));
            }
        };
        let square = search::crossing(excess, (low, value), high);
        Ok(Annulus::new(radius, square.sqrt()))
    }

    /// Refuses a solution that is not a contact.
    fn check(&self, solution: &Solution<'_>) -> Result<(), Error> {
        /// The accuracy of the pressures and gaps that are compared.
        const ACCURACY: f64 = 1e-6;
        let Annulus { inner, outer, .. } = solution.annulus;
        if solution.least_pressure() < -1.0 - ACCURACY {
            let what = "the attraction inside would be larger than its largest stress: the contact would open there";
            return Err(self.no_contact(inner, what));
        }
        let within = [0.1, 0.3, 0.5, 0.7, 0.9].map(|part| inner + part * (outer - inner));
        let beyond = [1.05, 1.2, 1.5].map(|factor| factor * outer);
        let radii: Vec<f64> = within.into_iter().chain(beyond).collect();
        let gaps = solution.gaps(&radii);
        let tolerance = ACCURACY * self.range;
        let inside = gaps[..within.len()]
            .iter()
            .all(|gap| (-tolerance..self.range + tolerance).contains(gap));
        let outside = gaps[within.len()..]
            .iter()
            .all(|gap| *gap > self.range - tolerance);
        if inside && outside {
            return Ok(());
        }
        let what = "the gap is not between 0 and the range of the attraction in the annulus, and beyond it outside";
        Err(self.no_contact(inner, what))
    }
}
