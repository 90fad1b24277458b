//! The bodies and the attraction between them, in the units of the solve.

use std::sync::Arc;

use interp::{Normalisation, Probe, System};

use crate::Error;
use crate::cohesive::CohesiveState;
use crate::compliance::Compliance;
use crate::compliance::layered::LayeredCompliance;
use crate::compliance::surface::SurfaceCompliance;
use crate::compliance::symbol::Symbol;
use crate::stack::Stack;

/// The radii, over the thickness of the top layer, of contacts and of annuli that are solved.
pub const REACH: f64 = 120.0;

/// The smallest radius of a contact, over the thickness of the top layer, that is solved.
pub const SMALLEST: f64 = 1e-12;

/// The shortest range that is taken, m, far below any: squares of much shorter ones underflow.
const SHORTEST: f64 = 1e-100;

/// A sphere on a coated substrate with an attraction of finite range.
#[derive(Clone, Debug)]
pub struct Cohesive {
    pub(super) symbol: Symbol<Arc<dyn SurfaceCompliance>>,
    pub(super) sphere_radius: f64,
    /// The thickness of the top layer, m: the unit of length.
    pub(super) thickness: f64,
    /// The modulus that normalises, Pa: the unit of moduli.
    pub(super) modulus: f64,
    /// `1/R`.
    pub(super) curvature: f64,
    /// `tau = 2 sigma0`.
    pub(super) traction: f64,
    /// `z0`.
    pub(super) range: f64,
}

impl Cohesive {
    /// Takes a film on a substrate, or a `stack` of layers in its place, whose [`Stack::system`] the `system` is, the work of
    /// adhesion `w` (J/m^2) and the range `z0` (m) of the attraction, whose traction is `sigma0 = w/z0`. The probe is a
    /// paraboloid.
    ///
    /// # Errors
    /// As [`System::material`]; [`Error::Domain`] unless `w` is positive and `z0` is at least 1e-100 m, and for a
    /// range that is not below the radius of the sphere; [`Error::OnlyParaboloid`] for another probe.
    pub fn new(
        system: &System,
        stack: Option<&Stack>,
        work_of_adhesion: f64,
        range: f64,
    ) -> Result<Self, Error> {
        let merged = stack.map(|stack| stack.merged().of_top_layer());
        let system = &match &merged {
            Some(merged) => System {
                probe: system.probe.clone(),
                film_thickness: merged.top().thickness,
                ..merged.system(1.0, system.sphere_modulus)
            },
            None => system.clone(),
        };
        let material = system.material()?;
        let surface: Arc<dyn SurfaceCompliance> = match merged.filter(|merged| !merged.is_film()) {
            Some(merged) => Arc::new(LayeredCompliance::new(&merged)),
            None => Arc::new(Compliance::new(&material)),
        };
        let modulus = match material.normalisation() {
            Normalisation::Sphere => system.sphere_modulus,
            Normalisation::Film => system.film.reduced(),
        };
        let Probe::Paraboloid {
            radius: sphere_radius,
        } = system.probe
        else {
            return Err(Error::OnlyParaboloid {
                probe: system.probe.name(),
            });
        };
        let thickness = system.film_thickness;
        let positive = [f64::MIN_POSITIVE, f64::MAX];
        Error::check("work of adhesion", work_of_adhesion, positive)?;
        Error::check("interaction range", range, [SHORTEST, sphere_radius])?;
        Ok(Self {
            symbol: Symbol::with_compliance(surface, &material),
            sphere_radius,
            thickness,
            modulus,
            curvature: thickness / sphere_radius,
            traction: 2.0 * (work_of_adhesion / range) / modulus,
            range: range / thickness,
        })
    }

    /// Returns the largest radius of an attraction that is solved.
    pub(super) fn reach(&self) -> f64 {
        if self.symbol.contrast() == 0.0 {
            self.sphere_radius / self.thickness
        } else {
            REACH
        }
    }

    /// Returns a state in SI units; the attraction acts between the two radii.
    pub(super) fn in_si(
        &self,
        [inner, outer]: [f64; 2],
        load: f64,
        penetration: f64,
    ) -> CohesiveState {
        CohesiveState {
            contact_radius: inner * self.thickness,
            outer_radius: outer * self.thickness,
            load: self.load_in_si(load),
            penetration: penetration * self.thickness,
        }
    }

    /// Returns a load in N.
    pub(super) fn load_in_si(&self, load: f64) -> f64 {
        load * self.modulus * self.thickness * self.thickness
    }

    /// Makes the error of a radius at which there is no solution.
    pub(super) fn no_contact(&self, radius: f64, what: &'static str) -> Error {
        Error::NotAContact {
            contact_radius: radius * self.thickness,
            what,
        }
    }
}
