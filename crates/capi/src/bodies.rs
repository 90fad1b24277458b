//! What C fills in, and what it reads.

use contact::{Control, State};
use interp::{Elastic, Error, Probe, System};

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
    /// Radius of the probe, m; not read for a cone.
    pub probe_radius: f64,
    /// Half angle of a cone, rad, between 0 and pi/2; not read for other shapes.
    pub half_angle: f64,
    /// Reduced modulus E2* of the probe, Pa; infinity is rigid.
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

/// What is imposed on a contact: the values of the argument `control` of `cc_pull_off`.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CcControl {
    /// The load: a dead weight.
    Load = 0,
    /// The penetration: a rigid machine.
    Displacement = 1,
    /// The position of the far end of a spring, such as a cantilever.
    Spring = 2,
}

/// A state of a contact.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
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
        let is = |probe: CcProbe| self.probe == probe as i32;
        let probe = if is(CcProbe::Paraboloid) {
            Probe::Paraboloid { radius }
        } else if is(CcProbe::Sphere) {
            Probe::Sphere { radius }
        } else if is(CcProbe::Cone) {
            Probe::Cone { half_angle }
        } else if is(CcProbe::RoundedCone) {
            Probe::RoundedCone { radius, half_angle }
        } else if is(CcProbe::FlatPunch) {
            Probe::FlatPunch { radius }
        } else if is(CcProbe::FlatEndedCone) {
            Probe::FlatEndedCone { radius, half_angle }
        } else {
            return Err(Failure::argument(format!(
                "probe = {} is no shape: give a value of CcProbe, 0 to 5",
                self.probe
            )));
        };
        let solid = |young, poisson| Elastic::new(young, poisson);
        Ok(System {
            probe,
            sphere_modulus: self.probe_modulus,
            film: solid(self.film_modulus, self.film_poisson_ratio)?,
            film_thickness: self.film_thickness,
            substrate: solid(self.substrate_modulus, self.substrate_poisson_ratio)?,
        })
    }
}

/// Returns the control of a number of `CcControl`.
pub(crate) fn control(control: i32, spring_stiffness: f64) -> Result<Control, Failure> {
    let is = |one: CcControl| control == one as i32;
    if is(CcControl::Load) {
        Ok(Control::Load)
    } else if is(CcControl::Displacement) {
        Ok(Control::Displacement)
    } else if is(CcControl::Spring) {
        Ok(Control::Spring {
            stiffness: spring_stiffness,
        })
    } else {
        Err(Failure::argument(format!(
            "control = {control} is none: give a value of CcControl, 0 to 2"
        )))
    }
}

impl From<State> for CcState {
    fn from(state: State) -> Self {
        Self {
            contact_radius: state.contact_radius,
            load: state.load,
            penetration: state.penetration,
        }
    }
}

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        Self::of(&error)
    }
}
