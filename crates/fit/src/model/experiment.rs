//! A measurement with all that is known about it.

use std::borrow::Cow;
use std::fmt;

use super::{
    Bodies, Indentation, Kind, LineSpeed, Measurement, Parameter, PointErrors, Relaxing, Solver,
};
use crate::Error;

/// A measurement with all that is known about it.
///
/// Each value is a parameter's fixed value, or the start of the fit where the parameter is
/// [`Free`](crate::Free) and says so. All units are SI.
#[derive(Clone, Debug, PartialEq)]
pub struct Experiment {
    /// The measured points.
    pub measurement: Measurement,
    /// Sphere, film and substrate.
    pub bodies: Bodies,
    /// The Poisson ratio of the sphere, if it is known. Contacts need the reduced modulus only; a
    /// report then tells Young's modulus of the sphere, too.
    pub sphere_poisson_ratio: Option<f64>,
    /// The work of adhesion, J/m^2; 0 is a contact without adhesion.
    pub work_of_adhesion: f64,
    /// The work of adhesion on retract, J/m^2; `None` is that of approach. Points without a
    /// direction have that of approach.
    pub work_of_adhesion_receding: Option<f64>,
    /// The speed of the contact line at which the work of adhesion is doubled or halved, m/s: see
    /// [`Parameter::DoublingSpeed`]. `None`, as for [`Self::speed_exponent`], is a work of adhesion that does not depend
    /// on the speed. With it the points are contact radii, and have times or [`Self::line_speeds`].
    pub doubling_speed: Option<f64>,
    /// The exponent of the speed of the contact line: see [`Parameter::SpeedExponent`].
    pub speed_exponent: Option<f64>,
    /// What a load reads without a force, N.
    pub load_offset: f64,
    /// The reading of a penetration or height at which the sphere would just touch, m.
    pub contact_point: f64,
    /// The force that is read at the contact point without a contact, N.
    pub baseline: f64,
    /// The slope of the force that is read without a contact, N/m.
    pub baseline_slope: f64,
    /// The stiffness of the cantilever, N/m, which [`Kind::ForceHeight`] needs.
    pub stiffness: Option<f64>,
    /// Whether the forces are this stiffness times a measured deflection. Then another stiffness
    /// changes the forces, too.
    pub from_deflection: bool,
    /// The standard deviation of an ordinate, in N or m, and of a contact stiffness relative to it
    /// (0.01 is 1 %); `None` if it is to be estimated from the residuals.
    pub noise: Option<f64>,
    /// The standard deviation of an abscissa, m; 0 is exact.
    pub abscissa_noise: f64,
    /// Standard deviations that differ from point to point, which stand for those above.
    pub errors: PointErrors,
    /// What is known of a measurement of contact stiffness; other kinds do not use it.
    pub indentation: Indentation,
    /// The time of each point, s; empty where it is not known.
    pub times: Vec<f64>,
    /// The speed of the contact line at each point; empty are those that radii and times show.
    pub line_speeds: Vec<LineSpeed>,
    /// How the bodies relax: see [`Relaxing`].
    pub relaxing: Option<Relaxing>,
}

impl Experiment {
    /// Takes a measurement on known bodies, without adhesion, with an instrument whose zeros are
    /// right, with exact abscissae, and with unknown noise of the ordinates.
    pub const fn new(measurement: Measurement, bodies: Bodies) -> Self {
        Self {
            measurement,
            bodies,
            sphere_poisson_ratio: None,
            work_of_adhesion: 0.0,
            work_of_adhesion_receding: None,
            doubling_speed: None,
            speed_exponent: None,
            load_offset: 0.0,
            contact_point: 0.0,
            baseline: 0.0,
            baseline_slope: 0.0,
            stiffness: None,
            from_deflection: false,
            noise: None,
            abscissa_noise: 0.0,
            errors: PointErrors {
                abscissa: Vec::new(),
                ordinate: Vec::new(),
            },
            indentation: Indentation::NEW,
            times: Vec::new(),
            line_speeds: Vec::new(),
            relaxing: None,
        }
    }

    /// Returns the value of a parameter; `None` where the experiment has none: a thickness without
    /// a film, a layer that is not there, a stiffness that is not given, a receding work of
    /// adhesion that is not its own.
    pub fn get(&self, parameter: Parameter) -> Option<f64> {
        if parameter.is_of_film() && !self.bodies.have_film() {
            return None;
        }
        Some(match parameter {
            Parameter::SphereModulus => self.bodies.sphere_modulus,
            Parameter::FilmModulus => self.bodies.film().young(),
            Parameter::FilmPoissonRatio => self.bodies.film().poisson(),
            Parameter::FilmThickness => self.bodies.top_thickness()?,
            Parameter::WorkOfAdhesion => self.work_of_adhesion,
            Parameter::WorkOfAdhesionReceding => return self.work_of_adhesion_receding,
            Parameter::DoublingSpeed => return self.doubling_speed,
            Parameter::SpeedExponent => return self.speed_exponent,
            Parameter::LoadOffset => self.load_offset,
            Parameter::ContactPoint => self.contact_point,
            Parameter::Baseline => self.baseline,
            Parameter::BaselineSlope => self.baseline_slope,
            Parameter::Stiffness => return self.stiffness,
            Parameter::Hardness => return self.indentation.hardness,
            Parameter::TipRounding => self.indentation.tip_rounding,
            Parameter::FrameCompliance => self.indentation.frame_compliance,
            Parameter::Layer(name, what) => return self.bodies.layer(name)?.get(what),
            Parameter::Law(own) => return self.relaxing.as_ref()?.law.parameter(own),
        })
    }

    /// Replaces the value of a parameter. Another stiffness changes the forces, too, if they are
    /// [those of a deflection](Self::from_deflection).
    ///
    /// # Errors
    /// [`Error::Contact`] for a film that is not physical; [`Error::NotFitted`] for the
    /// thickness of a half-space, for the film of a stack of layers, and for a layer that is not
    /// there.
    pub fn set(&mut self, parameter: Parameter, value: f64) -> Result<(), Error> {
        if let Some(reason) = self.why_not_there(parameter) {
            return Err(self.not_applicable(parameter, reason));
        }
        Ok(self.replace(parameter, value)?)
    }

    /// The error of an experiment that cannot be used so.
    pub(crate) fn not_fitted(&self, reason: impl fmt::Display) -> Error {
        Error::NotFitted(format!("{}: {reason}", self.measurement.name))
    }

    /// The error of a parameter that this experiment does not tell.
    pub(crate) fn not_applicable(&self, parameter: Parameter, reason: impl fmt::Display) -> Error {
        let experiment = &self.measurement.name;
        Error::NotFitted(format!(
            "{parameter} cannot be found from {experiment}: {reason}"
        ))
    }

    /// The error of a setting of this experiment whose value is not allowed.
    pub(crate) fn wrong_setting(
        &self,
        what: impl fmt::Display,
        value: f64,
        allowed: impl Into<String>,
    ) -> Error {
        let name = format!("{what} of {}", self.measurement.name);
        Error::setting(name, value, allowed)
    }

    /// Replaces the value of a parameter that the experiment has.
    pub(crate) fn replace(
        &mut self,
        parameter: Parameter,
        value: f64,
    ) -> Result<(), contact::Error> {
        match parameter {
            Parameter::WorkOfAdhesion => self.work_of_adhesion = value,
            Parameter::WorkOfAdhesionReceding => self.work_of_adhesion_receding = Some(value),
            Parameter::DoublingSpeed => self.doubling_speed = Some(value),
            Parameter::SpeedExponent => self.speed_exponent = Some(value),
            Parameter::LoadOffset => self.load_offset = value,
            Parameter::ContactPoint => self.contact_point = value,
            Parameter::Baseline => self.baseline = value,
            Parameter::BaselineSlope => self.baseline_slope = value,
            Parameter::Stiffness => self.set_stiffness(value),
            Parameter::Hardness => self.indentation.hardness = Some(value),
            Parameter::TipRounding => self.indentation.tip_rounding = value,
            Parameter::FrameCompliance => self.indentation.frame_compliance = value,
            Parameter::Law(own) => {
                if let Some(relaxing) = &mut self.relaxing {
                    relaxing.law = relaxing.law.with(own, value);
                }
            }
            _ => self.bodies.replace(parameter, value)?,
        }
        Ok(())
    }

    /// Replaces the stiffness of the cantilever, and with it the forces that are deflections times it.
    fn set_stiffness(&mut self, value: f64) {
        if let (true, Some(before)) = (self.from_deflection, self.stiffness) {
            let by = value / before;
            for point in &mut self.measurement.points {
                point.ordinate *= by;
            }
            for error in &mut self.errors.ordinate {
                *error *= by;
            }
        }
        self.stiffness = Some(value);
    }

    /// Returns why these bodies do not have a parameter, if they do not have it.
    fn why_not_there(&self, parameter: Parameter) -> Option<Cow<'static, str>> {
        if let Some(reason) = self.why_not_relaxing(parameter) {
            return Some(reason.into());
        }
        let bodies = &self.bodies;
        let names = || match Parameter::names(bodies.parameters_of_layers()) {
            none if none.is_empty() => "give a layer a name to fit its modulus or thickness".into(),
            names => format!("its layers have {names}"),
        };
        let reason = match parameter {
            Parameter::FilmThickness if bodies.are_half_space() => "a half-space has no thickness",
            Parameter::WorkOfAdhesionReceding if matches!(bodies.solver, Solver::Stick { .. }) => {
                "with full friction the contact depends on the ratio of both works of adhesion, which a fit \
                 keeps: give the solver this ratio, and points of retract only; the work of adhesion that is found is \
                 then that of the receding line"
            }
            _ if parameter.is_of_film() && !bodies.have_film() => {
                return Some(format!("it has layers instead of one film; {}", names()).into());
            }
            Parameter::Layer(name, _) if bodies.layer(name).is_some() => return None,
            Parameter::Layer(..) if bodies.are_layered() => {
                return Some(format!("there is no such layer; {}", names()).into());
            }
            Parameter::Layer(..) => {
                "it has no stack of layers; give one, or free the parameters of the film"
            }
            _ => return None,
        };
        Some(reason.into())
    }

    /// Tells whether nobody waits any longer for the contacts of the experiment.
    pub(crate) fn is_interrupted(&self) -> bool {
        self.bodies.interrupt.is_requested()
    }

    /// Returns why a parameter has no effect on this experiment, if it has none.
    pub fn why_without_effect(&self, parameter: Parameter) -> Option<Cow<'static, str>> {
        if let Some(reason) = self.why_not_there(parameter) {
            return Some(reason);
        }
        let kind = self.measurement.kind;
        if kind.is_stiffness()
            && let Some(reason) = self.why_without_effect_on_stiffness(parameter)
        {
            return Some(reason);
        }
        let has_load = kind != Kind::PenetrationRadius;
        let has_position = kind.at_positions();
        let reason = match parameter {
            Parameter::SphereModulus if self.get(parameter) == Some(f64::INFINITY) => {
                "the sphere is rigid; give it a modulus to fit one"
            }
            Parameter::FilmModulus if self.get(parameter) == Some(f64::INFINITY) => {
                "the half-space is rigid; give it a modulus to fit one"
            }
            Parameter::Hardness | Parameter::TipRounding | Parameter::FrameCompliance
                if !kind.is_stiffness() =>
            {
                "no contact stiffness is measured"
            }
            Parameter::DoublingSpeed | Parameter::SpeedExponent => self.why_without_line_speed()?,
            Parameter::LoadOffset if !has_load => "no load is measured",
            Parameter::ContactPoint if kind == Kind::LoadRadius => {
                "neither penetration nor height is measured"
            }
            Parameter::Baseline | Parameter::BaselineSlope if !has_position => {
                "the force is not measured against a penetration or height"
            }
            Parameter::Stiffness if kind != Kind::ForceHeight => {
                "no height of a cantilever is measured"
            }
            Parameter::Layer(..) => self.bodies.solver.why_layers_are_fixed()?,
            _ => return None,
        };
        Some(reason.into())
    }

    /// Accepts the zeros of the instrument, and the stiffness of the cantilever where one is
    /// needed.
    pub(crate) fn accept_instrument(&self) -> Result<(), Error> {
        for parameter in Parameter::ZEROS {
            let value = self.get(parameter).unwrap_or(0.0);
            if !(-1e100..=1e100).contains(&value) {
                let allowed = "finite, and at most 1e100: check the unit";
                return Err(self.wrong_setting(parameter, value, allowed));
            }
        }
        self.accept_relaxing()?;
        self.accept_line_law()?;
        if self.measurement.kind != Kind::ForceHeight {
            return Ok(());
        }
        let stiffness = self.stiffness.unwrap_or(f64::NAN);
        if stiffness > 0.0 && stiffness.is_finite() {
            return Ok(());
        }
        let allowed =
            "positive and finite: forces against heights need the stiffness of the cantilever";
        Err(self.wrong_setting("stiffness", stiffness, allowed))
    }
}
