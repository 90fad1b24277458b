//! The layers on a base, and their names.

use std::fmt;
use std::str::FromStr;

use arrayvec::ArrayString;
use interp::{Elastic, System};
use solve::stack::{Interface, Layer, Stack};

use super::LayerQuantity;
use crate::Error;

/// The largest number of bytes of the name of a layer.
const LONGEST_NAME: usize = 40;

/// The name of a layer, with which its [parameters](crate::Parameter) begin: `oxide.modulus`.
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Parameter;

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
