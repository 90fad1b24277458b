//! The numbers that can be fitted.

use std::borrow::Cow;
use std::fmt;
use std::str::FromStr;

use super::LayerName;
use crate::Error;
use units::Dimension;

/// The ends of the names of the parameters of a layer.
const MODULUS: &str = ".modulus";
const THICKNESS: &str = ".thickness";
const INTERFACE: &str = ".interface-stiffness";
/// The names of relaxation times and their weights, before a point and the number.
const TIME: &str = "relaxation-time";
const WEIGHT: &str = "relaxation-weight";

/// A number that can be fitted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Parameter {
    /// The reduced modulus `E2*` of the sphere, Pa.
    SphereModulus,
    /// Young's modulus `E1` of the film, Pa; without a film, that of the half-space.
    FilmModulus,
    /// The Poisson ratio `nu1` of the film; without a film, that of the half-space.
    FilmPoissonRatio,
    /// The thickness `t` of the film, m.
    FilmThickness,
    /// The work of adhesion `w`, J/m^2: that of both directions, or of approach alone where
    /// [`Parameter::WorkOfAdhesionReceding`] is given or free.
    WorkOfAdhesion,
    /// The work of adhesion of points measured on retract, J/m^2.
    WorkOfAdhesionReceding,
    /// What a load reads without a force, N.
    LoadOffset,
    /// The reading of a penetration or height at which the sphere would just touch, m.
    ContactPoint,
    /// The force that is read at the contact point without a contact, N.
    Baseline,
    /// The slope of the force that is read without a contact, N/m.
    BaselineSlope,
    /// The stiffness `k` of the cantilever, N/m.
    Stiffness,
    /// The hardness `H` (Pa), load over contact area, of a measurement of contact stiffness.
    Hardness,
    /// The depth `h0` (m) by which the tip of an indenter is blunter than its area function.
    TipRounding,
    /// The compliance `Cf` of the frame of an indenter, m/N.
    FrameCompliance,
    /// Young's modulus of a layer of a stack, Pa.
    LayerModulus(LayerName),
    /// The thickness of a layer of a stack, m.
    LayerThickness(LayerName),
    /// The tangential stiffness of the interface below a layer of a stack, Pa/m.
    LayerInterfaceStiffness(LayerName),
    /// The part of the modulus that is left in the end, where the bodies relax.
    RelaxedFraction,
    /// The exponent of a relaxation function.
    RelaxationExponent,
    /// A relaxation time, s, by its number from 1.
    RelaxationTime(u8),
    /// The weight of a relaxation time, by its number from 2. That of the first one is what the
    /// relaxed fraction and the other weights leave.
    RelaxationWeight(u8),
}

impl Parameter {
    /// All parameters but those of the layers of a stack, and of further relaxation times.
    pub const ALL: [Self; 17] = [
        Self::SphereModulus,
        Self::FilmModulus,
        Self::FilmPoissonRatio,
        Self::FilmThickness,
        Self::WorkOfAdhesion,
        Self::WorkOfAdhesionReceding,
        Self::LoadOffset,
        Self::ContactPoint,
        Self::Baseline,
        Self::BaselineSlope,
        Self::Stiffness,
        Self::Hardness,
        Self::TipRounding,
        Self::FrameCompliance,
        Self::RelaxedFraction,
        Self::RelaxationExponent,
        Self::RelaxationTime(1),
    ];

    /// Returns the name, as on the command line: that of a layer begins with the name of the layer,
    /// `oxide.modulus`, `oxide.thickness` or `oxide.interface-stiffness`; that of a further relaxation
    /// time ends with its number, `relaxation-time.2`.
    pub fn name(self) -> Cow<'static, str> {
        Cow::Borrowed(match self {
            Self::SphereModulus => "sphere-modulus",
            Self::FilmModulus => "film-modulus",
            Self::FilmPoissonRatio => "film-poisson-ratio",
            Self::FilmThickness => "film-thickness",
            Self::WorkOfAdhesion => "work-of-adhesion",
            Self::WorkOfAdhesionReceding => "work-of-adhesion-receding",
            Self::LoadOffset => "load-offset",
            Self::ContactPoint => "contact-point",
            Self::Baseline => "baseline",
            Self::BaselineSlope => "baseline-slope",
            Self::Stiffness => "stiffness",
            Self::Hardness => "hardness",
            Self::TipRounding => "tip-rounding",
            Self::FrameCompliance => "frame-compliance",
            Self::LayerModulus(layer) => return format!("{layer}{MODULUS}").into(),
            Self::LayerThickness(layer) => return format!("{layer}{THICKNESS}").into(),
            Self::LayerInterfaceStiffness(layer) => return format!("{layer}{INTERFACE}").into(),
            Self::RelaxedFraction => "relaxed-fraction",
            Self::RelaxationExponent => "relaxation-exponent",
            Self::RelaxationTime(1) => TIME,
            Self::RelaxationTime(number) => return format!("{TIME}.{number}").into(),
            Self::RelaxationWeight(number) => return format!("{WEIGHT}.{number}").into(),
        })
    }

    /// Returns the name with underscores, as JSON objects and Python have it, `work_of_adhesion`. The name of a
    /// layer stays as it is: `top-coat.interface_stiffness`.
    pub fn identifier(self) -> String {
        match self {
            Self::LayerModulus(_) | Self::LayerThickness(_) => self.name().into_owned(),
            Self::LayerInterfaceStiffness(layer) => {
                format!("{layer}{}", INTERFACE.replace('-', "_"))
            }
            _ => self.name().replace('-', "_"),
        }
    }

    /// Returns the names of parameters, between commas.
    pub fn names(all: impl IntoIterator<Item = Self>) -> String {
        let names: Vec<_> = all.into_iter().map(Self::name).collect();
        names.join(", ")
    }

    /// Returns the SI unit; `"1"` for a number without one.
    pub const fn unit(self) -> &'static str {
        match (self, self.dimension()) {
            // A force per length is also an energy per area.
            (Self::WorkOfAdhesion | Self::WorkOfAdhesionReceding, _) => "J/m^2",
            (_, Some(Dimension::ForcePerLength)) => "N/m",
            (_, Some(dimension)) => dimension.unit(),
            (_, None) => "1",
        }
    }

    /// Returns the dimension; `None` for a number without one.
    pub const fn dimension(self) -> Option<Dimension> {
        Some(match self {
            Self::SphereModulus | Self::FilmModulus | Self::Hardness | Self::LayerModulus(_) => {
                Dimension::Modulus
            }
            Self::FilmPoissonRatio
            | Self::RelaxedFraction
            | Self::RelaxationExponent
            | Self::RelaxationWeight(_) => return None,
            Self::RelaxationTime(_) => Dimension::Time,
            Self::FilmThickness
            | Self::LayerThickness(_)
            | Self::ContactPoint
            | Self::TipRounding => Dimension::Length,
            Self::FrameCompliance => Dimension::Compliance,
            Self::LayerInterfaceStiffness(_) => Dimension::ModulusPerLength,
            Self::LoadOffset | Self::Baseline => Dimension::Force,
            Self::WorkOfAdhesion
            | Self::WorkOfAdhesionReceding
            | Self::BaselineSlope
            | Self::Stiffness => Dimension::ForcePerLength,
        })
    }

    /// Whether it is a work of adhesion.
    pub const fn is_work_of_adhesion(self) -> bool {
        matches!(self, Self::WorkOfAdhesion | Self::WorkOfAdhesionReceding)
    }

    /// Tells whether the parameter is positive. Then its logarithm is fitted.
    pub const fn is_positive(self) -> bool {
        matches!(
            self,
            Self::SphereModulus
                | Self::FilmModulus
                | Self::FilmThickness
                | Self::WorkOfAdhesion
                | Self::WorkOfAdhesionReceding
                | Self::Stiffness
                | Self::Hardness
                | Self::LayerModulus(_)
                | Self::LayerThickness(_)
                | Self::LayerInterfaceStiffness(_)
                | Self::RelaxationTime(_)
                | Self::RelaxationWeight(_)
        )
    }

    /// Tells whether the parameter belongs to the bodies, so that another value needs another
    /// contact.
    pub const fn is_of_bodies(self) -> bool {
        matches!(
            self,
            Self::SphereModulus
                | Self::FilmModulus
                | Self::FilmPoissonRatio
                | Self::FilmThickness
                | Self::LayerModulus(_)
                | Self::LayerThickness(_)
                | Self::LayerInterfaceStiffness(_)
        )
    }
}

impl fmt::Display for Parameter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(&self.name())
    }
}

impl FromStr for Parameter {
    type Err = Error;

    fn from_str(name: &str) -> Result<Self, Error> {
        let found = Self::ALL
            .into_iter()
            .find(|parameter| parameter.name() == name);
        let layer = |suffix: &str| name.strip_suffix(suffix)?.parse().ok();
        let of_time = || {
            let number = |prefix| name.strip_prefix(prefix)?.strip_prefix('.')?.parse().ok();
            let time = number(TIME).filter(|&number| number > 0);
            let weight = number(WEIGHT).filter(|&number| number > 1);
            let time = time.map(Self::RelaxationTime);
            time.or(weight.map(Self::RelaxationWeight))
        };
        found
            .or_else(of_time)
            .or_else(|| layer(MODULUS).map(Self::LayerModulus))
            .or_else(|| layer(THICKNESS).map(Self::LayerThickness))
            .or_else(|| layer(INTERFACE).map(Self::LayerInterfaceStiffness))
            .ok_or_else(|| Error::UnknownParameter(name.to_owned()))
    }
}
