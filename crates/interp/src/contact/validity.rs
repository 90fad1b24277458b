//! How far a contact is from what the model supposes: numbers, and thresholds for them.

use std::f64::consts::PI;

use crate::contact::contact::finite;
use crate::material::system::positive;
use crate::{Contact, Error};

/// The geometry of a contact beside what the model supposes of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Validity {
    /// `a/R`. The model takes the sphere for a paraboloid. A rigid sphere that is none has its
    /// adhesionless penetration larger by a part `(a/R)^2/3` and more (Sneddon, Int. J. Eng. Sci.
    /// 3, 47, 1965: `(a/2) ln((R+a)/(R-a))` on a half-space).
    pub a_over_r: f64,
    /// The film's part; none on a half-space.
    pub film: Option<FilmValidity>,
}

/// The film's part of [`Validity`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FilmValidity {
    /// `a/t`, the degree of confinement (Shull, Mater. Sci. Eng. R 36, 1, 2002).
    pub a_over_t: f64,
    /// How compressible the film is in this contact, `(3/16) (1 - 2 nu1)/(1 - nu1) (a/t)^2`.
    ///
    /// It is the stiffness of a thin film under a flat frictionless punch if its volume were fixed,
    /// so that it had to flow sideways like in a squeeze film (`3 pi G1 a^4/(8 t^3)` on a rigid
    /// base), over the one if it could not move sideways at all
    /// (`2 pi G1 a^2 (1 - nu1)/((1 - 2 nu1) t)`). Above 1 a thin film gives way in volume; below,
    /// it behaves as incompressible, its stress reaches deep into the contact, and where it is
    /// about 1 every digit of `1/2 - nu1` counts (Johnson, *Contact Mechanics*, 5.8).
    pub compressibility: f64,
    /// Whether `a/t` is between the nodes of the table or curve, not beyond them, where there is an
    /// expansion or an error.
    pub in_range: bool,
}

impl Validity {
    /// Where `a/R` begins to show: 0.3 % of the penetration.
    pub const LARGE_A_OVER_R: f64 = 0.1;

    /// Whether `a/R` is above [`Validity::LARGE_A_OVER_R`].
    pub fn is_large_contact(&self) -> bool {
        self.a_over_r > Self::LARGE_A_OVER_R
    }
}

impl FilmValidity {
    /// The `a/t` from which a film is confined.
    pub const CONFINED_A_OVER_T: f64 = 1.0;

    /// Whether the film is thin for the contact, but yields sideways only: `a/t` above
    /// [`FilmValidity::CONFINED_A_OVER_T`] and [`FilmValidity::compressibility`] below 1. Under
    /// tension such films, if they are soft, may cavitate or finger rather than separate at a round
    /// edge, which the model does not know of.
    pub fn is_confined(&self) -> bool {
        self.a_over_t > Self::CONFINED_A_OVER_T && self.compressibility < 1.0
    }
}

/// How short the range of the attraction is: the model supposes none at all, the JKR limit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AdhesionRange {
    /// Tabor's parameter `mu = (R w^2 / (Es*^2 z0^3))^{1/3}`, with the compound modulus `Es*` of
    /// sphere and film: the attraction acts at the edge, and where its zone is small beside the
    /// film, sphere and film are all that the edge deforms.
    pub tabor: f64,
    /// The length (m) of the zone in which attraction acts outside the contact,
    /// `(pi/4) Es* z0^2/w`, of Dugdale's constant stress `w/z0` (Maugis, J. Colloid Interface Sci.
    /// 150, 243, 1992). Eq. 8 needs it small beside both contact radius and film thickness.
    pub cohesive_zone: f64,
}

impl AdhesionRange {
    /// Tabor's parameter from which JKR holds (Johnson and Greenwood, J. Colloid Interface Sci.
    /// 192, 326, 1997).
    pub const JKR: f64 = 5.0;

    /// The largest part of contact radius and film thickness that is small.
    pub const SMALL_ZONE: f64 = 0.1;

    /// Whether Tabor's parameter is at least [`AdhesionRange::JKR`].
    pub fn is_jkr(&self) -> bool {
        self.tabor >= Self::JKR
    }

    /// Whether the zone of attraction is at most [`AdhesionRange::SMALL_ZONE`] of a length (m):
    /// contact radius or film thickness.
    pub fn is_short_beside(&self, length: f64) -> bool {
        self.cohesive_zone <= Self::SMALL_ZONE * length
    }
}

impl Contact {
    /// How far a contact of radius `a` (m) is from what the model supposes.
    ///
    /// # Errors
    /// [`Error::Unphysical`] for an `a` that is not positive and finite, or too large beside `R` or
    /// `t` for f64.
    pub fn validity(&self, a: f64) -> Result<Validity, Error> {
        positive("contact radius", a)?;
        let film = match self.system().zip(self.curve()) {
            Some((system, curve)) => {
                let (a_over_t, nu1) = (a / system.film_thickness, system.film.poisson());
                let compressibility = finite(
                    a,
                    3.0 / 16.0 * (1.0 - 2.0 * nu1) / (1.0 - nu1) * a_over_t * a_over_t,
                )?;
                let [from, to] = curve.range();
                let in_range = (from..=to).contains(&a_over_t);
                Some(FilmValidity {
                    a_over_t,
                    compressibility,
                    in_range,
                })
            }
            None => None,
        };
        Ok(Validity {
            a_over_r: finite(a, a / self.mechanics().sphere_radius())?,
            film,
        })
    }

    /// How an attraction of range `z0` (m) and work of adhesion `w` (J/m^2) compares with the JKR
    /// limit. `z0` is the distance at which the attraction is over, or largest: of the order of an
    /// atom's diameter for van der Waals forces.
    ///
    /// # Errors
    /// [`Error::Unphysical`] unless `w` and `z0` are positive and finite, and the result too.
    pub fn adhesion_range(&self, w: f64, interaction_range: f64) -> Result<AdhesionRange, Error> {
        positive("work of adhesion", w)?;
        positive("interaction range", interaction_range)?;
        let modulus = self.mechanics().sphere_film_modulus();
        // The length of the solids' deformation by the attraction, w / (Es* z0), times z0.
        let stretch = w / modulus / interaction_range;
        let tabor =
            (self.mechanics().sphere_radius() / interaction_range * stretch * stretch).cbrt();
        let cohesive_zone = 0.25 * PI * interaction_range / stretch;
        let held = tabor.is_finite() && cohesive_zone.is_finite();
        Error::unless(
            held,
            "interaction range",
            interaction_range,
            "such that Tabor's parameter is a number that f64 holds",
        )?;
        Ok(AdhesionRange {
            tabor,
            cohesive_zone,
        })
    }
}
