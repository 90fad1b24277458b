//! The values of an experiment that a fit takes as given.

use std::borrow::Cow;
use std::f64::consts::FRAC_PI_2;

use interp::{Elastic, Probe};

use super::{Experiment, Kind, LayerName, LayerQuantity, Parameter, Reach, Relaxing, Scale};
use crate::Error;
use units::Dimension;

/// A value that a fit takes as given.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fixed {
    /// A parameter that is not free.
    Parameter(Parameter),
    /// The radius of the probe, m.
    SphereRadius,
    /// The half-angle of a cone, rad.
    HalfAngle,
    /// The factor `beta` of a contact stiffness.
    Beta,
    /// A factor on all readings of a quantity, which is 1.
    Scale(Scale),
    /// The reading at which the contact radius is 0, which is 0 m: by this length all radii are read too large, as by a
    /// threshold in a picture.
    ContactRadiusZero,
    /// The speed, 0 m/s, with which readings of penetrations or heights drift that have times.
    PositionDrift,
    /// Young's modulus of the substrate, or of the base of a stack, Pa.
    SubstrateModulus,
    /// The Poisson ratio of the substrate, or of the base of a stack.
    SubstratePoissonRatio,
    /// Young's modulus of a reference sample, which has no layers, Pa. Where it is that of a substrate beside it, both
    /// are taken for one material, and it is a [`Self::SubstrateModulus`].
    ReferenceModulus,
    /// The Poisson ratio of such a sample.
    ReferencePoissonRatio,
    /// A number of a layer of a stack without a name, by its number from 1, from the base up.
    Layer(usize, LayerQuantity),
    /// The Poisson ratio of such a layer.
    LayerPoissonRatio(usize),
    /// The Poisson ratio of a layer with a name.
    NamedPoissonRatio(LayerName),
}

impl Fixed {
    /// Returns the parameter that it is; `None` for a value that no fit finds.
    pub const fn parameter(self) -> Option<Parameter> {
        match self {
            Self::Parameter(parameter) => Some(parameter),
            _ => None,
        }
    }

    /// Returns the dimension; `None` for a Poisson ratio and a factor.
    pub const fn dimension(self) -> Option<Dimension> {
        match self {
            Self::Parameter(parameter) => parameter.dimension(),
            Self::SphereRadius | Self::ContactRadiusZero => Some(Dimension::Length),
            Self::HalfAngle => Some(Dimension::Angle),
            Self::PositionDrift => Some(Dimension::Speed),
            Self::SubstrateModulus | Self::ReferenceModulus => Some(Dimension::Modulus),
            Self::Layer(_, what) => Some(what.dimension()),
            Self::Beta
            | Self::Scale(_)
            | Self::SubstratePoissonRatio
            | Self::ReferencePoissonRatio
            | Self::LayerPoissonRatio(_)
            | Self::NamedPoissonRatio(_) => None,
        }
    }

    /// Returns the name, as on the command line.
    pub fn name(self) -> Cow<'static, str> {
        match self {
            Self::Parameter(parameter) => parameter.name(),
            Self::SphereRadius => "sphere-radius".into(),
            Self::HalfAngle => "half-angle".into(),
            Self::Beta => "beta".into(),
            Self::Scale(scale) => scale.name().into(),
            Self::ContactRadiusZero => "contact-radius-zero".into(),
            Self::PositionDrift => "position-drift".into(),
            Self::SubstrateModulus => "substrate-modulus".into(),
            Self::SubstratePoissonRatio => "substrate-poisson-ratio".into(),
            Self::ReferenceModulus => "reference-modulus".into(),
            Self::ReferencePoissonRatio => "reference-poisson-ratio".into(),
            Self::Layer(number, what) => format!("layer-{number}.{}", what.name()).into(),
            Self::LayerPoissonRatio(number) => format!("layer-{number}.poisson-ratio").into(),
            Self::NamedPoissonRatio(layer) => format!("{layer}.poisson-ratio").into(),
        }
    }

    /// Returns the name with underscores, as [`Parameter::identifier`].
    pub fn identifier(self) -> String {
        match self {
            Self::Parameter(parameter) => parameter.identifier(),
            Self::NamedPoissonRatio(layer) => format!("{layer}.poisson_ratio"),
            _ => self.name().replace('-', "_"),
        }
    }

    /// Returns the quantity of a name.
    pub fn parse(name: &str) -> Option<Self> {
        let all = [
            Self::SphereRadius,
            Self::HalfAngle,
            Self::Beta,
            Self::ContactRadiusZero,
            Self::PositionDrift,
            Self::SubstrateModulus,
            Self::SubstratePoissonRatio,
            Self::ReferenceModulus,
            Self::ReferencePoissonRatio,
        ];
        let of_layer = || {
            let (number, what) = name.strip_prefix("layer-")?.split_once('.')?;
            let number = number.parse().ok().filter(|&number| number > 0)?;
            let ratio = (what == "poisson-ratio").then_some(Self::LayerPoissonRatio(number));
            ratio.or_else(|| Some(Self::Layer(number, LayerQuantity::of_name(what)?)))
        };
        let of_named_layer = || {
            let layer = name.strip_suffix(".poisson-ratio")?.parse().ok()?;
            Some(Self::NamedPoissonRatio(layer))
        };
        all.into_iter()
            .find(|one| one.name() == name)
            .or_else(of_layer)
            .or_else(|| name.parse().ok().map(Self::Parameter))
            .or_else(|| Scale::of_name(name).map(Self::Scale))
            .or_else(of_named_layer)
    }

    /// Returns the SI unit; `"1"` for a Poisson ratio and a factor.
    pub const fn unit(self) -> &'static str {
        match (self, self.dimension()) {
            (Self::Parameter(parameter), _) => parameter.unit(),
            (_, Some(dimension)) => dimension.unit(),
            (_, None) => "1",
        }
    }

    /// Tells whether several values err in proportion, by one factor, as positive values do. Others are off by the
    /// same number.
    pub const fn errs_in_proportion(self) -> bool {
        match self {
            Self::Parameter(parameter) => parameter.is_positive(),
            _ => !self.is_poisson_ratio() && !self.moves_readings(),
        }
    }

    /// Tells whether it is a zero or a drift of what is read as abscissa, which no parameter is.
    pub(crate) const fn moves_readings(self) -> bool {
        matches!(self, Self::ContactRadiusZero | Self::PositionDrift)
    }

    pub(crate) const fn is_poisson_ratio(self) -> bool {
        match self {
            Self::Parameter(parameter) => matches!(parameter, Parameter::FilmPoissonRatio),
            _ => self.dimension().is_none() && !matches!(self, Self::Beta | Self::Scale(_)),
        }
    }
}

impl Experiment {
    /// Lists the values that a fit may take as given: those of the bodies, and the parameters.
    pub(crate) fn quantities(&self) -> Vec<Fixed> {
        let mut all = vec![
            Fixed::SphereRadius,
            Fixed::SubstrateModulus,
            Fixed::SubstratePoissonRatio,
            Fixed::ReferenceModulus,
            Fixed::ReferencePoissonRatio,
        ];
        let mut parameters = Parameter::ALL.to_vec();
        parameters.extend(self.bodies.parameters_of_layers());
        // The parameters of a film are its own.
        let stacked = (!self.bodies.have_film()).then_some(&self.bodies.layers);
        for (i, layer) in stacked.into_iter().flatten().enumerate() {
            match layer.name {
                Some(name) => all.push(Fixed::NamedPoissonRatio(name)),
                None => all.extend([
                    Fixed::Layer(i + 1, LayerQuantity::Modulus),
                    Fixed::Layer(i + 1, LayerQuantity::Thickness),
                    Fixed::LayerPoissonRatio(i + 1),
                ]),
            }
        }
        all.push(Fixed::Beta);
        let of_law = self.relaxing.iter().flat_map(Relaxing::parameters);
        parameters.extend(of_law.filter(|one| !Parameter::ALL.contains(one)));
        all.extend(parameters.into_iter().map(Fixed::Parameter));
        all
    }

    /// Lists the positive values, Poisson ratios, scales and zeros of what is read that matter to a fit of the parameters
    /// `free` and that it takes as given.
    pub(crate) fn fixed(&self, free: &[Parameter]) -> Vec<Fixed> {
        // The layers of a table are those of its file.
        let in_table = self.bodies.solver.why_layers_are_fixed().is_some();
        let matters = |one: &Fixed| {
            let is_kind = match one {
                Fixed::Parameter(parameter) => {
                    let is_usual = parameter.is_positive() || one.is_poisson_ratio();
                    // A free level takes up a load offset.
                    let is_zero = self.is_zero_of_ordinates(*one)
                        && !(self.measurement.kind.at_positions()
                            && free.contains(&Parameter::Baseline));
                    (is_usual || is_zero)
                        && !free.contains(parameter)
                        && self.why_without_effect(*parameter).is_none()
                }
                Fixed::SphereRadius | Fixed::HalfAngle => self.has_shape(false),
                Fixed::Beta | Fixed::Scale(_) => true,
                one if one.moves_readings() => true,
                _ => !in_table,
            };
            let is_usual = |value: f64| !one.errs_in_proportion() || value > 0.0;
            is_kind
                && self
                    .value_of(*one)
                    .is_some_and(|value| value.is_finite() && is_usual(value))
        };
        let mut all = self.quantities();
        all.insert(1, Fixed::HalfAngle);
        all.extend([Fixed::ContactRadiusZero, Fixed::PositionDrift]);
        all.extend(Scale::ALL.map(Fixed::Scale));
        all.retain(matters);
        all
    }

    /// Tells whether a value is the zero of the ordinates.
    pub(crate) fn is_zero_of_ordinates(&self, one: Fixed) -> bool {
        let zero = match self.measurement.kind {
            Kind::LoadRadius | Kind::LoadPenetration => Parameter::LoadOffset,
            Kind::PenetrationRadius => Parameter::ContactPoint,
            Kind::ForceHeight => Parameter::Baseline,
            Kind::StiffnessRadius | Kind::StiffnessLoad | Kind::StiffnessDepth => return false,
        };
        one == Fixed::Parameter(zero)
    }

    /// Returns a value that a fit takes as given; `None` where there is none, and for the Poisson
    /// ratio of a rigid body.
    pub fn value_of(&self, one: Fixed) -> Option<f64> {
        let substrate = self.bodies.base();
        let numbered = self.bodies.are_layered().then_some(&self.bodies.layers);
        let layer = |number: usize| numbered?.get(number.wrapping_sub(1));
        let poisson = |solid: Elastic| solid.young().is_finite().then(|| solid.poisson());
        let reference = self.bodies.are_bare().then_some(self.bodies.base);
        match one {
            Fixed::Parameter(Parameter::FilmPoissonRatio) => {
                self.get(Parameter::FilmPoissonRatio)?;
                poisson(self.bodies.film())
            }
            Fixed::Parameter(parameter) => self.get(parameter),
            Fixed::SphereRadius => self.bodies.probe.radius(),
            Fixed::HalfAngle => match self.bodies.probe {
                Probe::Cone { half_angle }
                | Probe::RoundedCone { half_angle, .. }
                | Probe::FlatEndedCone { half_angle, .. } => Some(half_angle),
                _ => None,
            },
            Fixed::Beta => self
                .measurement
                .kind
                .is_stiffness()
                .then_some(self.indentation.beta),
            Fixed::SubstrateModulus => substrate.map(|solid| solid.young()),
            Fixed::SubstratePoissonRatio => substrate.and_then(poisson),
            Fixed::Scale(scale) => self.is_read(scale).then_some(1.0),
            Fixed::ContactRadiusZero | Fixed::PositionDrift => self.largest_move(one).map(|_| 0.0),
            Fixed::ReferenceModulus => reference.map(|solid| solid.young()),
            Fixed::ReferencePoissonRatio => reference.and_then(poisson),
            Fixed::Layer(number, what) => layer(number)?.get(what),
            Fixed::LayerPoissonRatio(number) => poisson(layer(number)?.layer.solid),
            Fixed::NamedPoissonRatio(name) => poisson(self.bodies.layer(name)?.layer.solid),
        }
    }

    /// Replaces a value that a fit takes as given. The contacts on layers are then needed as far as they are under the
    /// new shape of the probe ([`Reach::of`]).
    ///
    /// # Errors
    /// [`Error::Setting`] for a value that the measurement does not have; [`Error::Contact`] for a
    /// solid that is not physical.
    pub fn set_fixed(&mut self, one: Fixed, value: f64) -> Result<(), Error> {
        if let Fixed::Parameter(parameter) = one {
            return self.set(parameter, value);
        }
        let wrong = |allowed: &'static str| Err(self.wrong_setting(one.name(), value, allowed));
        match (one, self.value_of(one)) {
            (Fixed::Scale(_), _) => {
                return wrong("left out: it is 1; multiply readings that are off in the data");
            }
            (one, _) if one.moves_readings() => {
                return wrong("left out: it is 0; take it off the readings in the data");
            }
            (Fixed::SphereRadius, None) => {
                return wrong("left out: the probe has no radius");
            }
            (Fixed::SphereRadius | Fixed::Layer(_, LayerQuantity::Thickness), Some(_))
                if value.is_nan() || value <= 0.0 =>
            {
                return wrong("above 0");
            }
            (Fixed::HalfAngle, Some(_)) if !(value > 0.0 && value < FRAC_PI_2) => {
                return wrong("above 0 and below pi/2 rad");
            }
            (Fixed::SubstrateModulus | Fixed::SubstratePoissonRatio, _)
                if self.bodies.base().is_none() =>
            {
                return wrong("left out: a half-space has no substrate");
            }
            // A rigid substrate has one that does not matter.
            (Fixed::SubstratePoissonRatio, None) => {}
            (_, None) => return wrong("of bodies that have it: check its name"),
            _ => {}
        }
        self.replace_fixed(one, value)?;
        if matches!(one, Fixed::SphereRadius | Fixed::HalfAngle) {
            self.bodies.reach = Reach::of(&self.measurement, &self.bodies.probe);
        }
        Ok(())
    }

    /// Replaces a value that is there.
    pub(crate) fn replace_fixed(&mut self, one: Fixed, value: f64) -> Result<(), contact::Error> {
        match one {
            Fixed::Parameter(parameter) => self.replace(parameter, value)?,
            Fixed::Beta => self.indentation.beta = value,
            Fixed::Scale(scale) => self.multiply_readings(scale, value),
            Fixed::ContactRadiusZero => self.move_radii(-value),
            Fixed::PositionDrift => self.move_positions(-value),
            Fixed::SphereRadius => {
                if let Probe::Paraboloid { radius }
                | Probe::Sphere { radius }
                | Probe::RoundedCone { radius, .. }
                | Probe::FlatPunch { radius }
                | Probe::FlatEndedCone { radius, .. } = &mut self.bodies.probe
                {
                    *radius = value;
                }
            }
            Fixed::HalfAngle => {
                if let Probe::Cone { half_angle }
                | Probe::RoundedCone { half_angle, .. }
                | Probe::FlatEndedCone { half_angle, .. } = &mut self.bodies.probe
                {
                    *half_angle = value;
                }
            }
            Fixed::SubstrateModulus | Fixed::ReferenceModulus => {
                self.bodies.base = Elastic::new(value, self.bodies.base.poisson())?;
            }
            Fixed::SubstratePoissonRatio | Fixed::ReferencePoissonRatio => {
                self.bodies.base = Elastic::new(self.bodies.base.young(), value)?;
            }
            _ => {
                for (number, named) in (1..).zip(&mut self.bodies.layers) {
                    let solid = &mut named.layer.solid;
                    match one {
                        Fixed::Layer(own, what) if own == number => named.set(what, value)?,
                        Fixed::LayerPoissonRatio(own) if own == number => {
                            *solid = Elastic::new(solid.young(), value)?;
                        }
                        Fixed::NamedPoissonRatio(name) if named.name == Some(name) => {
                            *solid = Elastic::new(solid.young(), value)?;
                        }
                        _ => {}
                    }
                }
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every name that a message or a result shows is one that `--known` and `Known` take. Identifiers keep the names of layers.
    #[test]
    fn names_are_read_as_they_are_written() {
        for (name, identifier) in [
            ("sphere-radius", "sphere_radius"),
            ("half-angle", "half_angle"),
            ("beta", "beta"),
            ("contact-radius", "contact_radius"),
            ("contact-radius-zero", "contact_radius_zero"),
            ("position-drift", "position_drift"),
            ("load", "load"),
            ("film-thickness", "film_thickness"),
            ("work-of-adhesion", "work_of_adhesion"),
            ("substrate-poisson-ratio", "substrate_poisson_ratio"),
            ("relaxation-time", "relaxation_time"),
            ("relaxation-time.2", "relaxation_time.2"),
            ("relaxation-weight.2", "relaxation_weight.2"),
            ("layer-2.modulus", "layer_2.modulus"),
            ("layer-2.poisson-ratio", "layer_2.poisson_ratio"),
            ("top-coat.modulus", "top-coat.modulus"),
            (
                "top_coat.interface-stiffness",
                "top_coat.interface_stiffness",
            ),
            ("top-coat.poisson-ratio", "top-coat.poisson_ratio"),
        ] {
            let read = Fixed::parse(name).expect("a name");
            assert_eq!((&*read.name(), &*read.identifier()), (name, identifier));
        }
        assert_eq!(Fixed::parse("oxide.colour"), None);
    }
}
