//! The size of an attraction's range beside the contact, compared with the JKR limit.

use std::f64::consts::PI;

use super::cohesive_zone::{CohesiveZone, bears, mean_tension, short};
use crate::Error;
use crate::{Contact, Control};
use interp::check::positive;

/// The size of the cohesive zone in which the attraction acts. The model assumes JKR's limit, in which
/// it is zero.
#[derive(Clone, Copy, Debug)]
pub struct ZoneSize<'a> {
    /// Tabor's parameter `mu = (R w^2 / (Es*^2 z0^3))^{1/3}`, with the compound modulus `Es*` of
    /// sphere and film. The attraction acts at the edge: if its zone is small beside the film
    /// thickness, it deforms the sphere and the film alone.
    pub tabor: f64,
    /// The length (m) of the zone outside the contact in which the attraction acts,
    /// `(pi/4) Es* z0^2/w`, for Dugdale's constant stress `w/z0` (Maugis, J. Colloid Interface Sci.
    /// 150, 243, 1992). Eq. 8 assumes that it is small beside contact radius and film thickness.
    pub cohesive_zone: f64,
    /// The range over the thickness of the film, or of all layers of a stack; 0 on a half-space.
    pub range_over_thickness: f64,
    /// The mean tension `|F|/(pi a^2)` of JKR's contact at pull-off under an imposed load over the stress `w/z0`, the
    /// largest that the attraction bears; NaN where that pull-off is not known. On a half-space it is `0.65/mu`. On a
    /// confined film, which can hardly yield, it may be above 1: such a contact opens inside.
    pub tension: f64,
    contact: &'a Contact,
    work_of_adhesion: f64,
    stress: f64,
}

impl ZoneSize<'_> {
    /// The value of Tabor's parameter from which JKR holds (Johnson and Greenwood, J. Colloid
    /// Interface Sci. 192, 326, 1997).
    pub const JKR: f64 = 5.0;

    /// The range over the thickness up to which this holds on a film. Farther out the gap beside the contact on a thin
    /// film is that of bodies that do not yield.
    pub const THIN: f64 = 0.1;

    /// The mean tension over the stress of the attraction up to which JKR holds on a film. Beyond 1 the contact opens
    /// inside.
    pub const TENSE: f64 = 0.3;

    /// Tells whether Tabor's parameter is at least [`ZoneSize::JKR`], the range at most [`ZoneSize::THIN`] of the
    /// thickness, and the tension at most [`ZoneSize::TENSE`]. The pull-off load of JKR under an imposed load then errs by
    /// up to 0.7 % (Dugdale's law, random systems; two are in `tests/truth/cohesive_zone.rs`); with a range of 0.3 of the
    /// thickness by up to 17 %, and with a tension above 1 by 5 to 30 %.
    pub fn is_jkr(&self) -> bool {
        self.tabor >= Self::JKR
            && self.range_over_thickness <= Self::THIN
            && self.tension <= Self::TENSE
    }

    /// Returns the part by which the pull-off load of JKR is too small, for Dugdale's law and to
    /// first order in the length `l` of the cohesive zone:
    ///
    /// ```text
    /// F/F_JKR - 1 = (S |delta_fp|/(2 |F_JKR|)) l/(6 a)        0.0859/mu^2 on a half-space
    /// ```
    ///
    /// `F_JKR`, `a` and the term `S |delta_fp|` of eq. 9 belong to the pull-off of
    /// [`Contact::pull_off`] under an imposed load. The load is stationary there, so that to first
    /// order it feels only the energy `w (1 + l/(6 a))` of the line ([`Contact::cohesive_zone`]).
    /// `z0` is the distance at which Dugdale's traction ends.
    ///
    /// Against an independent program on 1200 films: where `l` is a twentieth of the shorter of contact
    /// radius and film thickness it is too large by up to 7 % of itself, or too small by 2 %; where it is a
    /// fifth, by 26 % and 9 %.
    ///
    /// # Errors
    /// As [`Contact::pull_off`] and [`Contact::cohesive_zone`]: [`Error::LongZone`] for a zone that
    /// is not short; [`Error::Tension`] for a contact that opens inside.
    pub fn pull_off_error(&self) -> Result<f64, Error> {
        let (contact, w, zone) = (self.contact, self.work_of_adhesion, self.cohesive_zone);
        contact.cohesive_zone(
            w,
            CohesiveZone {
                stress: self.stress,
            },
        )?;
        let pull_off = contact.pull_off(w, Control::Load)?;
        let a = pull_off.contact_radius;
        short(zone, a, "contact radius")?;
        bears(self.stress, pull_off.load, a + zone)?;
        let lowered_by = contact.adhesionless_load(a)? - pull_off.load;
        Ok(0.5 * lowered_by / pull_off.load.abs() * zone / (6.0 * a))
    }
}

impl Contact {
    /// Compares an attraction of work of adhesion `w` (J/m^2) and range `interaction_range`, `z0`
    /// (m), with the JKR limit.
    ///
    /// `z0` is the distance at which the attraction is largest, or at which it ends. For van der
    /// Waals forces it is of the order of the diameter of an atom.
    ///
    /// # Errors
    /// [`interp::Error::Unphysical`] unless `w` and `interaction_range` are positive and finite, and for a
    /// result that overflows an f64; [`interp::Error::OtherProbe`] for a probe without a radius of curvature.
    pub fn zone_size(&self, w: f64, interaction_range: f64) -> Result<ZoneSize<'_>, Error> {
        positive("work of adhesion", w)?;
        positive("interaction range", interaction_range)?;
        let radius = self.with_radius_of_curvature("Tabor's parameter")?;
        let modulus = self.mechanics().sphere_film_modulus();
        // The displacement w/Es* of the solids by the attraction, over z0.
        let stretch = w / modulus / interaction_range;
        let tabor = (radius / interaction_range * stretch * stretch).cbrt();
        let cohesive_zone = 0.25 * PI * interaction_range / stretch;
        let finite = tabor.is_finite() && cohesive_zone.is_finite();
        interp::Error::unless(
            finite,
            "interaction range",
            interaction_range,
            "such that Tabor's parameter and the length of the zone do not overflow an f64",
        )?;
        let stress = w / interaction_range;
        let tension = self.pull_off(w, Control::Load).map_or(f64::NAN, |state| {
            mean_tension(state.load, state.contact_radius) / stress
        });
        Ok(ZoneSize {
            tabor,
            cohesive_zone,
            range_over_thickness: self
                .system()
                .map_or(0.0, |system| interaction_range / system.film_thickness),
            tension,
            contact: self,
            work_of_adhesion: w,
            stress,
        })
    }
}
