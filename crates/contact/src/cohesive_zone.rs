//! A short cohesive zone around a contact, as a correction of JKR's contact.
//!
//! Dugdale's law is a constant traction `sigma0` where the gap is below `w/sigma0`. Under it the
//! attraction acts in a zone outside the contact, `a < r < c`, and no stress is singular (Maugis,
//! J. Colloid Interface Sci. 150, 243, 1992, on a half-space).
//!
//! Where the zone is short beside the contact radius and the film, its surroundings are in plane
//! strain, and see only the field of a crack tip. To lowest order the zone of such a tip has the
//! length `l` below, that of Dugdale (1960) and of Barenblatt (1962). To the next order the stress
//! ahead of it, `(2 sigma0/pi) atan sqrt(l/x)` at the distance `x`, is that of a tip at `x =
//! -2l/3`, at the radius `b`. What remains comes from the curvature of the line: the energy of a
//! zone of fixed length is proportional to the length of the line, `w l/6` per length in Maugis'
//! equations expanded about JKR. It knows no film and no shape of the probe, and so
//!
//! ```text
//! l = pi Es* w/(4 sigma0^2)        b = a + 2l/3        c = a + l        G(b) = w (1 + l/(6b))
//! load and penetration: those of JKR at the radius b with the energy G(b)
//! ```
//!
//! The remainder is of second order in `l`.

use std::f64::consts::PI;

use super::line_energy::LineEnergy;
use crate::Error;
use crate::{Contact, Control, Equilibrium};
use interp::Probe;
use interp::check::positive;

/// The law of a cohesive zone: a constant attraction over a finite range (Dugdale).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CohesiveZone {
    /// The traction `sigma0`, Pa. It acts where the gap is below `w/sigma0`.
    pub stress: f64,
}

impl CohesiveZone {
    /// The longest cohesive zone that counts as short, over the contact radius and over the
    /// thickness of the film, or of the top layer of a stack.
    pub const LONGEST: f64 = 0.25;

    /// The largest mean tension `-F/(pi c^2)` within the outer radius over the stress of the attraction, which bears no
    /// more than its stress: a confined film, which can hardly yield, is under tension throughout, and the contact
    /// opens inside. On a half-space no short zone has as much.
    pub const MOST_TENSION: f64 = 0.9;
}

/// A state with a cohesive zone around the contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CohesiveState {
    /// Contact radius `a`, m; 0 before the contact.
    pub contact_radius: f64,
    /// Outer radius `c` of the attraction, m.
    pub outer_radius: f64,
    /// Load `F`, N, positive in compression.
    pub load: f64,
    /// Penetration `delta`, m, positive when the sphere has moved in.
    pub penetration: f64,
}

/// A contact with a short cohesive zone, from [`Contact::cohesive_zone`].
#[derive(Clone, Debug)]
pub struct ShortZone<'a> {
    contact: &'a Contact,
    energy: LineEnergy,
    /// The traction of the attraction, Pa.
    stress: f64,
}

impl Contact {
    /// Corrects the contact with work of adhesion `w` (J/m^2) for an attraction of finite `range`.
    ///
    /// The correction is exact to first order in the length `l` of the cohesive zone over the
    /// contact radius and over the thickness of the film, or of the top layer of a stack. It costs
    /// as much as JKR. The load at pull-off under an imposed load errs by up to 0.7 % where `l` is a fifth
    /// of the shorter of contact radius and thickness, and by 0.06 % where it is a twentieth; at an imposed displacement by
    /// 3 % and 0.4 %, and by up to 40 % where the curve has two nearly equal least penetrations (against solves of random films; five are in
    /// `tests/truth/cohesive_zone.rs`). The error falls with the square of `l`. At a given contact radius
    /// load and penetration err by more, on half-spaces by up to 3 % of what adhesion lowers them by where
    /// `l` is a twentieth of the radius, because they are not stationary there. The crate `solve` solves zones of any length
    /// (`solve::cohesive::Cohesive`; on the command line `pull-off --interaction-range`).
    ///
    /// ```
    /// # fn main() -> Result<(), contact::Error> {
    /// use interp::{Elastic, HalfSpace, Probe};
    /// use contact::{Contact, Control, CohesiveZone};
    ///
    /// let system = HalfSpace { probe: Probe::Paraboloid { radius: 1e-6 }, sphere_modulus: f64::INFINITY, solid: Elastic::new(1e7, 0.5)? };
    /// let contact = Contact::half_space(&system)?;
    /// let attraction = contact.cohesive_zone(0.05, CohesiveZone { stress: 1e7 })?;
    /// let (jkr, pull_off) = (contact.pull_off(0.05, Control::Load)?, attraction.pull_off(Control::Load)?);
    /// assert!(pull_off.load < jkr.load && pull_off.outer_radius > pull_off.contact_radius);
    /// # Ok(()) }
    /// ```
    ///
    /// # Errors
    /// [`interp::Error::Unphysical`] unless `w` and the stress are positive and finite; [`Error::LongZone`]
    /// for a zone longer than [`CohesiveZone::LONGEST`] times the film, or top layer, or largest
    /// contact; [`interp::Error::OtherProbe`] for a shape with edges or bends; [`Error::Sticks`] with full friction.
    pub fn cohesive_zone(&self, w: f64, range: CohesiveZone) -> Result<ShortZone<'_>, Error> {
        positive("work of adhesion", w)?;
        positive("stress of the attraction", range.stress)?;
        let (modulus, stress) = (self.mechanics().sphere_film_modulus(), range.stress);
        let zone = 0.25 * PI * (modulus / stress) * (w / stress);
        self.smooth_probe()?;
        self.without_stick(
            "an attraction of finite range",
            "outside the contact the surfaces do not touch and cannot stick; take the limit of short \
             ranges (JKR), or a curve without friction",
        )?;
        let [_, largest] = self.mechanics().radii();
        short(zone, largest, "largest contact radius of the probe")?;
        if let Some(thickness) = self.top_thickness() {
            short(zone, thickness, "thickness of the film or top layer")?;
        }
        Ok(ShortZone {
            contact: self,
            energy: LineEnergy {
                work_of_adhesion: w,
                zone,
            },
            stress,
        })
    }

    /// Returns the thickness of the film, or of the top layer of a stack, m; `None` on a
    /// half-space.
    fn top_thickness(&self) -> Option<f64> {
        let (system, curve) = self.system().zip(self.curve())?;
        Some(system.film_thickness * curve.stack().map_or(1.0, |stack| stack.top))
    }

    /// Accepts the probes whose shape is smooth everywhere but at its tip.
    fn smooth_probe(&self) -> Result<(), Error> {
        match self.probe() {
            Probe::Paraboloid { .. }
            | Probe::Sphere { .. }
            | Probe::PowerLaw { .. }
            | Probe::Cone { .. } => return Ok(()),
            Probe::RoundedCone { .. }
            | Probe::FlatPunch { .. }
            | Probe::FlatEndedCone { .. }
            | Probe::Profile(_) => {}
        }
        Err(interp::Error::OtherProbe {
            question: "an attraction of finite range",
            probe: self.mechanics().probe(),
            reason: "the cohesive zone must lie where the shape is smooth, and this one has \
                     an edge or a bend; use a paraboloid, a sphere, a cone or a power law",
        }
        .into())
    }
}

impl ShortZone<'_> {
    /// Returns the length `l = pi Es* w/(4 sigma0^2)` of the cohesive zone, m.
    pub const fn zone(&self) -> f64 {
        self.energy.zone
    }

    /// Returns the state at the contact radius `a`, m.
    ///
    /// # Errors
    /// As [`Contact::load_and_penetration`]; [`Error::LongZone`] for a contact radius that is below
    /// the zone over [`CohesiveZone::LONGEST`]; [`Error::Tension`] for a contact that opens inside.
    pub fn state(&self, a: f64) -> Result<CohesiveState, Error> {
        self.contact.mechanics().check_radius(a)?;
        short(self.zone(), a, "contact radius")?;
        let b = a + 2.0 / 3.0 * self.zone();
        let (load, penetration) = self.contact.load_and_penetration(b, self.energy.at(b))?;
        bears(self.stress, load, a + self.zone())?;
        Ok(CohesiveState {
            contact_radius: a,
            outer_radius: a + self.zone(),
            load,
            penetration,
        })
    }

    /// Returns the state in which the contact separates on unloading, as [`Contact::pull_off`].
    ///
    /// # Errors
    /// As [`Contact::pull_off`] and [`ShortZone::state`].
    pub fn pull_off(&self, control: Control) -> Result<CohesiveState, Error> {
        let tip = self
            .contact
            .equilibria_with(self.energy, control)?
            .pull_off()?;
        self.at_tip(tip.contact_radius)
    }

    /// Returns the equilibria at an imposed load (N), penetration (m) or position of the spring
    /// (m), in ascending order of contact radius.
    ///
    /// They are those of [`Equilibria::at`](crate::Equilibria::at). Unstable ones that have no
    /// [`ShortZone::state`] are left out.
    ///
    /// # Errors
    /// As [`Contact::equilibria`] and [`Equilibria::at`](crate::Equilibria::at);
    /// [`Error::LongZone`] and [`Error::Tension`] for a stable equilibrium without a state.
    pub fn equilibria(
        &self,
        control: Control,
        imposed: f64,
    ) -> Result<Vec<Equilibrium<CohesiveState>>, Error> {
        let all = self
            .contact
            .equilibria_with(self.energy, control)?
            .at(imposed)?;
        let mut found = Vec::with_capacity(all.len());
        for tip in all {
            match self.at_tip(tip.state.contact_radius) {
                Err(Error::LongZone { .. } | Error::Tension { .. }) if !tip.stable => {}
                state => found.push(Equilibrium {
                    state: state?,
                    stable: tip.stable,
                }),
            }
        }
        Ok(found)
    }

    /// Returns the state whose crack tip has the radius `b`, m.
    fn at_tip(&self, b: f64) -> Result<CohesiveState, Error> {
        let contact_radius = b - 2.0 / 3.0 * self.zone();
        short(self.zone(), contact_radius, "contact radius")?;
        self.state(contact_radius)
    }
}

/// Accepts a zone (m) that is short beside a `length` (m), which `what` names.
pub(crate) fn short(zone: f64, length: f64, what: &'static str) -> Result<(), Error> {
    let most = CohesiveZone::LONGEST;
    if zone <= most * length {
        return Ok(());
    }
    Err(Error::LongZone {
        zone,
        what,
        length,
        most,
    })
}

/// Returns the mean tension `-F/(pi r^2)` (Pa) within a radius (m) under a load (N).
pub(crate) fn mean_tension(load: f64, r: f64) -> f64 {
    -load / (PI * r * r)
}

/// Accepts a load (N) within an outer radius (m) that an attraction of this stress (Pa) bears.
pub(crate) fn bears(stress: f64, load: f64, outer_radius: f64) -> Result<(), Error> {
    let (tension, most) = (mean_tension(load, outer_radius), CohesiveZone::MOST_TENSION);
    if tension <= most * stress {
        return Ok(());
    }
    Err(Error::Tension {
        tension,
        stress,
        most,
    })
}
