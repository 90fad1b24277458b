//! The numbers that can be fitted.

use std::borrow::Cow;
use std::fmt;
use std::str::FromStr;

use contact::LawParameter;

use super::LayerName;
use crate::Error;
use units::Dimension;

/// The names of relaxation times and their weights; those of further ones end with a point and the number.
const TIME: &str = "relaxation-time";
const WEIGHT: &str = "relaxation-weight";
/// Whether the logarithm of a parameter is fitted.
const POSITIVE: bool = true;
const ANY_SIGN: bool = false;

named! {
    /// A number of a layer that can be fitted.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
    pub enum LayerQuantity {
        /// Young's modulus, Pa.
        Modulus = "modulus",
        /// The thickness, m.
        Thickness = "thickness",
        /// The tangential stiffness of the interface below the layer, Pa/m.
        InterfaceStiffness = "interface-stiffness",
    }
}

impl LayerQuantity {
    pub(super) const fn dimension(self) -> Dimension {
        match self {
            Self::Modulus => Dimension::Modulus,
            Self::Thickness => Dimension::Length,
            Self::InterfaceStiffness => Dimension::ModulusPerLength,
        }
    }
}

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
    /// The speed `v0` (m/s) of the contact line at which the energy release rate is twice the work of adhesion where the
    /// line recedes, and half of it where it advances: see [`contact::RateDependent`].
    DoublingSpeed,
    /// The exponent `n` of the speed of the contact line, dimensionless: see [`contact::RateDependent`].
    SpeedExponent,
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
    /// A number of the layers of a stack that have this name.
    Layer(LayerName, LayerQuantity),
    /// A number of the function by which bodies relax.
    Law(LawParameter),
}

impl Parameter {
    /// All parameters but those of the layers of a stack, and of further relaxation times.
    pub const ALL: [Self; 19] = [
        Self::SphereModulus,
        Self::FilmModulus,
        Self::FilmPoissonRatio,
        Self::FilmThickness,
        Self::WorkOfAdhesion,
        Self::WorkOfAdhesionReceding,
        Self::DoublingSpeed,
        Self::SpeedExponent,
        Self::LoadOffset,
        Self::ContactPoint,
        Self::Baseline,
        Self::BaselineSlope,
        Self::Stiffness,
        Self::Hardness,
        Self::TipRounding,
        Self::FrameCompliance,
        Self::Law(LawParameter::RelaxedFraction),
        Self::Law(LawParameter::Exponent),
        Self::Law(LawParameter::Time(0)),
    ];

    /// The zeros of the instrument.
    pub(crate) const ZEROS: [Self; 4] = [
        Self::LoadOffset,
        Self::ContactPoint,
        Self::Baseline,
        Self::BaselineSlope,
    ];

    /// The zeros of the load: one number where a force is measured against a position.
    pub(crate) const LEVELS: [Self; 2] = [Self::LoadOffset, Self::Baseline];

    pub(crate) const WORKS: [Self; 2] = [Self::WorkOfAdhesion, Self::WorkOfAdhesionReceding];

    /// The numbers by which the work of adhesion depends on the speed of the contact line.
    pub(crate) const OF_LINE: [Self; 2] = [Self::DoublingSpeed, Self::SpeedExponent];

    /// Returns the name, without that of a layer and the number of a relaxation time; the dimension, if there is one;
    /// and whether the parameter is positive.
    const fn facts(self) -> (&'static str, Option<Dimension>, bool) {
        use Dimension::{Compliance, Force, ForcePerLength, Length, Modulus, Speed, Time};
        match self {
            Self::SphereModulus => ("sphere-modulus", Some(Modulus), POSITIVE),
            Self::FilmModulus => ("film-modulus", Some(Modulus), POSITIVE),
            Self::FilmPoissonRatio => ("film-poisson-ratio", None, ANY_SIGN),
            Self::FilmThickness => ("film-thickness", Some(Length), POSITIVE),
            Self::WorkOfAdhesion => ("work-of-adhesion", Some(ForcePerLength), POSITIVE),
            Self::WorkOfAdhesionReceding => {
                ("work-of-adhesion-receding", Some(ForcePerLength), POSITIVE)
            }
            Self::DoublingSpeed => ("doubling-speed", Some(Speed), POSITIVE),
            Self::SpeedExponent => ("speed-exponent", None, POSITIVE),
            Self::LoadOffset => ("load-offset", Some(Force), ANY_SIGN),
            Self::ContactPoint => ("contact-point", Some(Length), ANY_SIGN),
            Self::Baseline => ("baseline", Some(Force), ANY_SIGN),
            Self::BaselineSlope => ("baseline-slope", Some(ForcePerLength), ANY_SIGN),
            Self::Stiffness => ("stiffness", Some(ForcePerLength), POSITIVE),
            Self::Hardness => ("hardness", Some(Modulus), POSITIVE),
            Self::TipRounding => ("tip-rounding", Some(Length), ANY_SIGN),
            Self::FrameCompliance => ("frame-compliance", Some(Compliance), ANY_SIGN),
            Self::Layer(_, what) => (what.name(), Some(what.dimension()), POSITIVE),
            Self::Law(LawParameter::RelaxedFraction) => ("relaxed-fraction", None, ANY_SIGN),
            Self::Law(LawParameter::Exponent) => ("relaxation-exponent", None, ANY_SIGN),
            Self::Law(LawParameter::Time(_)) => (TIME, Some(Time), POSITIVE),
            Self::Law(LawParameter::Weight(_)) => (WEIGHT, None, POSITIVE),
        }
    }

    /// Returns the name, as on the command line: that of a layer begins with the name of the layer,
    /// `oxide.modulus`, `oxide.thickness` or `oxide.interface-stiffness`; that of a further relaxation
    /// time ends with its number, `relaxation-time.2`.
    pub fn name(self) -> Cow<'static, str> {
        let (name, ..) = self.facts();
        match self {
            Self::Layer(layer, _) => format!("{layer}.{name}").into(),
            Self::Law(LawParameter::Time(k @ 1..) | LawParameter::Weight(k)) => {
                format!("{name}.{}", k + 1).into()
            }
            _ => name.into(),
        }
    }

    /// Returns the name with underscores, as JSON objects and Python have it, `work_of_adhesion`. The name of a
    /// layer stays as it is: `top-coat.interface_stiffness`.
    pub fn identifier(self) -> String {
        match self {
            Self::Layer(layer, what) => format!("{layer}.{}", what.name().replace('-', "_")),
            _ => self.name().replace('-', "_"),
        }
    }

    /// Returns the names of parameters, between commas.
    pub fn names(all: impl IntoIterator<Item = Self>) -> String {
        let names: Vec<_> = all.into_iter().map(Self::name).collect();
        names.join(", ")
    }

    /// Returns the SI unit as it follows a number.
    pub(crate) fn after_number(self) -> String {
        match self.unit() {
            "1" => String::new(),
            unit => format!(" {unit}"),
        }
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
        self.facts().1
    }

    /// Whether it is a work of adhesion.
    pub const fn is_work_of_adhesion(self) -> bool {
        matches!(self, Self::WorkOfAdhesion | Self::WorkOfAdhesionReceding)
    }

    /// Tells whether it is the modulus of a body.
    pub(crate) const fn is_modulus(self) -> bool {
        matches!(
            self,
            Self::SphereModulus | Self::FilmModulus | Self::Layer(_, LayerQuantity::Modulus)
        )
    }

    /// Tells whether it is the thickness of a film or layer.
    pub(crate) const fn is_thickness(self) -> bool {
        matches!(
            self,
            Self::FilmThickness | Self::Layer(_, LayerQuantity::Thickness)
        )
    }

    pub(crate) const fn is_of_film(self) -> bool {
        matches!(
            self,
            Self::FilmModulus | Self::FilmPoissonRatio | Self::FilmThickness
        )
    }

    /// Tells whether the parameter is positive. Then its logarithm is fitted.
    pub const fn is_positive(self) -> bool {
        self.facts().2
    }

    /// Tells whether the parameter belongs to the bodies, so that another value needs another
    /// contact.
    pub const fn is_of_bodies(self) -> bool {
        self.is_of_film() || matches!(self, Self::SphereModulus | Self::Layer(..))
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
        let numbered = || {
            let (first, last) = name.rsplit_once('.')?;
            if let Some(what) = LayerQuantity::of_name(last) {
                return first.parse().ok().map(|layer| Self::Layer(layer, what));
            }
            match (first, last.parse::<usize>().ok()?.checked_sub(1)?) {
                (TIME, k) => Some(Self::Law(LawParameter::Time(k))),
                (WEIGHT, k @ 1..) => Some(Self::Law(LawParameter::Weight(k))),
                _ => None,
            }
        };
        Self::ALL
            .into_iter()
            .find(|parameter| parameter.name() == name)
            .or_else(numbered)
            .ok_or_else(|| Error::UnknownParameter(name.to_owned()))
    }
}
