//! What C fills in, and what it reads.

use interp::{Elastic, Probe, System};

use crate::guard::Failure;

/// The shapes of the probe: the values of `CcSystem.probe`. Angles are between the axis and the flank.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CcProbe {
    /// Paraboloid of the radius of curvature `probe_radius`: the sphere of JKR's and Barthel's models.
    Paraboloid = 0,
    /// The sphere of `probe_radius` itself.
    Sphere = 1,
    /// Cone of `half_angle`.
    Cone = 2,
    /// Cone of `half_angle` with a round end of `probe_radius`.
    RoundedCone = 3,
    /// Flat cylindrical punch of `probe_radius`.
    FlatPunch = 4,
    /// Cone of `half_angle` with a flat end of `probe_radius`.
    FlatEndedCone = 5,
}

/// A probe on a film on a substrate, in SI units.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct CcSystem {
    /// The shape of the probe: a value of `CcProbe`.
    pub probe: i32,
    /// Radius of the probe, m; not read for a cone. Messages name it `sphere_radius`.
    pub probe_radius: f64,
    /// Half angle of a cone, rad, between 0 and pi/2; not read for other shapes.
    pub half_angle: f64,
    /// Reduced modulus E2* of the probe, Pa, at most 1e25; infinity is rigid. Messages name it `sphere_modulus`.
    pub probe_modulus: f64,
    /// Young's modulus of the film, Pa.
    pub film_modulus: f64,
    /// Poisson ratio of the film, from 0 to 0.5.
    pub film_poisson_ratio: f64,
    /// Thickness of the film, m.
    pub film_thickness: f64,
    /// Young's modulus of the substrate, Pa; infinity is rigid.
    pub substrate_modulus: f64,
    /// Poisson ratio of the substrate, from 0 to 0.5.
    pub substrate_poisson_ratio: f64,
}

/// A state of a contact.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CcState {
    /// Contact radius, m.
    pub contact_radius: f64,
    /// Load, N, positive in compression.
    pub load: f64,
    /// Penetration, m, positive when the probe has moved in.
    pub penetration: f64,
}

impl CcSystem {
    /// Returns the system.
    pub(crate) fn read(&self) -> Result<System, Failure> {
        let (radius, half_angle) = (self.probe_radius, self.half_angle);
        let shapes = [
            (CcProbe::Paraboloid, Probe::Paraboloid { radius }),
            (CcProbe::Sphere, Probe::Sphere { radius }),
            (CcProbe::Cone, Probe::Cone { half_angle }),
            (
                CcProbe::RoundedCone,
                Probe::RoundedCone { radius, half_angle },
            ),
            (CcProbe::FlatPunch, Probe::FlatPunch { radius }),
            (
                CcProbe::FlatEndedCone,
                Probe::FlatEndedCone { radius, half_angle },
            ),
        ];
        let shape = shapes
            .into_iter()
            .find(|(shape, _)| *shape as i32 == self.probe);
        let (_, probe) = shape.ok_or_else(|| {
            let given = self.probe;
            Failure::argument(format!(
                "probe = {given} is no shape: give a value of CcProbe, 0 to 5"
            ))
        })?;
        Ok(System {
            probe,
            sphere_modulus: self.probe_modulus,
            film: solid("film", self.film_modulus, self.film_poisson_ratio)?,
            film_thickness: self.film_thickness,
            substrate: solid(
                "substrate",
                self.substrate_modulus,
                self.substrate_poisson_ratio,
            )?,
        })
    }
}

/// Returns a solid; the error names the body.
fn solid(name: &str, young: f64, poisson: f64) -> Result<Elastic, Failure> {
    Elastic::new(young, poisson).map_err(|error| Failure::from(error).of(name))
}
