//! A probe on a stack of layers.

use std::fmt;
use std::str::FromStr;

use arrayvec::ArrayString;
use interp::{Elastic, Probe, System};
use solve::stack::{Interface, Layer, Stack};

use super::{Interrupt, Kind, LayerQuantity, Measurement, Parameter, Solver};
use crate::Error;
use crate::statistics::extremes;

/// The largest number of bytes of the name of a layer.
const LONGEST_NAME: usize = 40;

/// The factor by which the largest contact radius at a measured radius is exceeded, so that the
/// slopes there are known.
pub(super) const MARGIN: f64 = 1.2;

/// The contact radius over `sqrt(R D)` that no contact is expected to exceed on the way `D`, the
/// range of the penetrations or heights. Of a thin incompressible layer on a rigid base without
/// adhesion it is 2; JKR's contact at the end of a pull to the pull-off has 1.5.
const WIDEST: f64 = 3.0;

/// The name of a layer, with which its [parameters](Parameter) begin: `oxide.modulus`.
///
/// A name has 1 to 40 bytes. It has no comma and no equals sign, which separate settings of
/// parameters, no control character, and no white space at its ends.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct LayerName(ArrayString<LONGEST_NAME>);

impl LayerName {
    /// Returns the name.
    pub fn as_str(&self) -> &str {
        &self.0
    }
}

impl fmt::Debug for LayerName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:?}", self.as_str())
    }
}

impl fmt::Display for LayerName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.as_str())
    }
}

impl FromStr for LayerName {
    type Err = Error;

    fn from_str(name: &str) -> Result<Self, Error> {
        let is_plain = |c: char| !(c == ',' || c == '=' || c.is_control());
        let is_allowed = !name.is_empty() && name.trim() == name && name.chars().all(is_plain);
        let stored = ArrayString::from(name).ok().filter(|_| is_allowed);
        stored
            .map(Self)
            .ok_or_else(|| {
                Error::NotFitted(format!(
                    "{name:?} cannot name a layer in a fit: a name has 1 to 40 bytes, no comma, equals sign or control \
                     character, and no space at its ends; give the layer another name"
                ))
            })
    }
}

/// One layer, and its name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NamedLayer {
    /// The name by which parameters call it: they set the values of all layers that have it. A
    /// layer without a name is fixed.
    pub name: Option<LayerName>,
    /// The layer.
    pub layer: Layer,
}

impl NamedLayer {
    /// Returns the layers of a stack with their `names`, from the base up.
    ///
    /// # Errors
    /// [`Error::NotFitted`] for a name that a layer of a fit cannot have.
    pub fn all(stack: &Stack, names: &[Option<String>]) -> Result<Vec<Self>, Error> {
        let named = |(layer, name): (&Layer, &Option<String>)| {
            Ok(Self {
                name: name.as_deref().map(str::parse).transpose()?,
                layer: *layer,
            })
        };
        stack.layers().iter().zip(names).map(named).collect()
    }

    /// Returns the film of a system as a single layer without a name.
    pub fn of_film(system: &System) -> Vec<Self> {
        vec![Self {
            name: None,
            layer: Layer::bonded(system.film, system.film_thickness),
        }]
    }

    /// Returns the value of a parameter; `None` of an interface that is bonded or slides.
    pub(crate) fn get(&self, what: LayerQuantity) -> Option<f64> {
        match what {
            LayerQuantity::Modulus => Some(self.layer.solid.young()),
            LayerQuantity::Thickness => Some(self.layer.thickness),
            LayerQuantity::InterfaceStiffness => self.interface_stiffness(),
        }
    }

    /// Replaces the value of a parameter.
    pub(super) fn set(&mut self, what: LayerQuantity, value: f64) -> Result<(), interp::Error> {
        let Layer {
            solid,
            thickness,
            interface,
        } = &mut self.layer;
        match what {
            LayerQuantity::Modulus => *solid = Elastic::new(value, solid.poisson())?,
            LayerQuantity::Thickness => *thickness = value,
            LayerQuantity::InterfaceStiffness => {
                let [_, normal] = interface.stiffnesses();
                let tangential = value;
                *interface = Interface::Springs { tangential, normal };
            }
        }
        Ok(())
    }

    /// Returns the tangential stiffness (Pa/m) of the springs below; `None` where there are none: the
    /// layer is bonded or slides.
    pub(crate) fn interface_stiffness(&self) -> Option<f64> {
        let [tangential, _] = self.layer.interface.stiffnesses();
        (tangential > 0.0 && tangential.is_finite()).then_some(tangential)
    }

    /// Returns the tangential stiffness (Pa/m) of an interface as stiff as the layer itself, at which
    /// the data are most likely to tell how stiff it is.
    pub(crate) fn own_stiffness(&self) -> f64 {
        self.layer.solid.reduced() / self.layer.thickness
    }
}

/// Up to which contact radii the contacts on layers are needed, m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reach {
    /// Contacts as wide as this one are needed.
    pub needed: f64,
    /// No contact is expected to be wider than this one. Contacts are computed so far where that
    /// takes no long time.
    pub expected: f64,
}

impl Reach {
    /// Returns the reach up to a contact radius, m.
    pub(super) const fn up_to(needed: f64) -> Self {
        let expected = needed;
        Self { needed, expected }
    }

    /// Returns the reach that a measurement needs under a probe.
    ///
    /// At measured contact radii it is a little more than the largest of them. Against penetrations
    /// or heights it is estimated from their range and from the radius of the probe.
    /// A flat punch has one contact radius.
    pub fn of(measurement: &Measurement, probe: &Probe) -> Self {
        if let Probe::FlatPunch { radius } = probe {
            return Self::up_to(MARGIN * radius);
        }
        let [least, most] = extremes(measurement.points.iter().map(|point| point.abscissa));
        let largest = probe.radius().unwrap_or(f64::INFINITY);
        match measurement.kind {
            Kind::LoadRadius | Kind::PenetrationRadius | Kind::StiffnessRadius => {
                Self::up_to((MARGIN * most).min(largest))
            }
            // What they need depends on the hardness and the area function: see
            // `Experiment::reach_contacts`.
            Kind::StiffnessLoad | Kind::StiffnessDepth => Self::up_to(0.0),
            Kind::LoadPenetration | Kind::ForceHeight => Self {
                needed: 0.0,
                expected: (WIDEST * (largest * (most - least)).sqrt()).min(largest),
            },
        }
    }
}

/// A probe on a stack of layers on a base.
#[derive(Clone, Debug, PartialEq)]
pub struct Layered {
    /// The shape of the probe: [`Probe::Paraboloid`] or [`Probe::FlatPunch`].
    pub probe: Probe,
    /// The reduced modulus `E2*` of the probe, Pa; infinity is rigid.
    pub sphere_modulus: f64,
    /// The base; with an infinite modulus it is rigid.
    pub base: Elastic,
    /// The layers, from the base up. The probe touches the last one.
    pub layers: Vec<NamedLayer>,
    /// Up to which contact radii contacts are needed.
    pub reach: Reach,
    /// How contacts are made.
    pub solver: Solver,
    /// Whether somebody no longer waits for the contacts.
    pub interrupt: Interrupt,
}

impl Layered {
    /// Returns a half-space as the base without layers, of which any probe has a contact stiffness.
    pub fn bare(
        measurement: &Measurement,
        probe: &Probe,
        sphere_modulus: f64,
        base: Elastic,
    ) -> Self {
        Self {
            reach: Reach::of(measurement, probe),
            probe: probe.clone(),
            sphere_modulus,
            base,
            layers: Vec::new(),
            solver: Solver::Direct,
            interrupt: Interrupt::default(),
        }
    }

    /// Returns the layers on their base.
    ///
    /// # Errors
    /// Those of [`Stack::new`].
    pub fn stack(&self) -> Result<Stack, solve::Error> {
        let layers = self.layers.iter().map(|named| named.layer);
        Stack::new(self.base, layers.collect::<Vec<_>>())
    }

    /// Returns the thickness of all layers, m.
    pub fn thickness(&self) -> f64 {
        self.layers.iter().map(|named| named.layer.thickness).sum()
    }

    /// Returns the solid that the probe touches; the base where there is no layer.
    pub fn surface(&self) -> Elastic {
        self.layers.last().map_or(self.base, |top| top.layer.solid)
    }

    /// Lists the parameters of the layers that have a name.
    pub fn parameters(&self) -> Vec<Parameter> {
        let names = self.layers.iter().filter_map(|named| named.name);
        names
            .flat_map(|name| LayerQuantity::ALL.map(|what| Parameter::Layer(name, what)))
            .collect()
    }

    /// Names the parameters of the layers, in a sentence.
    pub(super) fn names(&self) -> String {
        let names = Parameter::names(self.parameters());
        if names.is_empty() {
            "give a layer a name to fit its modulus or thickness".into()
        } else {
            format!("its layers have {names}")
        }
    }

    /// Returns the film: the only layer, if it has no name. The parameters of the film are its
    /// parameters.
    pub(crate) fn film(&self) -> Option<&NamedLayer> {
        match &self.layers[..] {
            [film] if film.name.is_none() => Some(film),
            _ => None,
        }
    }

    pub(crate) fn layer(&self, name: LayerName) -> Option<&NamedLayer> {
        self.layers.iter().find(|named| named.name == Some(name))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_that_settings_cannot_hold_are_refused() {
        let long = "x".repeat(LONGEST_NAME + 1);
        for name in ["", " oxide", "a,b", "a=b", "a\nb", &long] {
            let error = name.parse::<LayerName>().expect_err("refused").to_string();
            assert!(error.contains("1 to 40 bytes"), "{error}");
        }
        for name in ["oxide", "silicon dioxide", "Al2O3 (ALD).1", &long[1..]] {
            let layer: LayerName = name.parse().expect("a name");
            assert_eq!(layer.as_str(), name);
            for what in LayerQuantity::ALL {
                let parameter = Parameter::Layer(layer, what);
                assert_eq!(
                    parameter.name().parse::<Parameter>().expect("its name"),
                    parameter
                );
            }
        }
    }
}
