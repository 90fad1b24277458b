//! Stacks of layers as TOML gives them: a file of a stack, or the table `[stack]` of a scene.

use interp::Elastic;
use serde::Deserialize;

use crate::Error;
use crate::stack::{Layer, Stack};

/// The keys of a stack, before they are checked.
#[derive(Clone, Debug, Deserialize)]
#[serde(
    deny_unknown_fields,
    expecting = "a table with base = { .. } and layers: write them out, as in a stack file"
)]
pub struct Text {
    base: Base,
    #[serde(default)]
    layers: Vec<TextLayer>,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Base {
    young_modulus: f64,
    poisson_ratio: Option<f64>,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct TextLayer {
    name: Option<String>,
    young_modulus: f64,
    poisson_ratio: f64,
    thickness: f64,
}

/// A stack with the names that its text gives to layers.
#[derive(Debug)]
pub struct NamedStack {
    /// The stack.
    pub stack: Stack,
    /// The names of the layers, from the base up.
    #[cfg(feature = "cli")]
    pub names: Vec<Option<String>>,
}

impl Text {
    /// Checks the keys.
    ///
    /// # Errors
    /// A sentence with the layer, or the base, the value and the range.
    pub fn stack(self) -> Result<NamedStack, String> {
        let Self { base, layers } = self;
        let names: Vec<Option<String>> = layers.iter().map(|layer| layer.name.clone()).collect();
        let of_layer = |i: usize| match &names[i] {
            Some(name) => format!("layer {name:?}, {} of {} from the base", i + 1, names.len()),
            None => format!("layer {} of {} from the base", i + 1, names.len()),
        };
        for (i, name) in names.iter().enumerate() {
            let first = names.iter().position(|other| other == name);
            if let (Some(_), Some(first)) = (name, first)
                && first < i
            {
                return Err(format!(
                    "{}: layer {} has this name, too; give another",
                    of_layer(i),
                    first + 1
                ));
            }
        }
        let base = match base.poisson_ratio {
            Some(poisson) => Elastic::new(base.young_modulus, poisson),
            // A rigid body has none; any one serves.
            None if base.young_modulus == f64::INFINITY => Elastic::new(f64::INFINITY, 0.0),
            None => {
                return Err("base: poisson_ratio is missing; give one in (-1, 0.5], or \
                     young_modulus = inf for a rigid base"
                    .into());
            }
        }
        .map_err(|error| format!("base: {error}"))?;
        let solids = layers.iter().enumerate().map(|(i, layer)| {
            Ok(Layer {
                solid: Elastic::new(layer.young_modulus, layer.poisson_ratio)
                    .map_err(|error| format!("{}: {error}", of_layer(i)))?,
                thickness: layer.thickness,
            })
        });
        match Stack::new(base, solids.collect::<Result<Vec<_>, String>>()?) {
            Ok(stack) => Ok(NamedStack {
                stack,
                #[cfg(feature = "cli")]
                names,
            }),
            Err(Error::Layer { layer, what, .. }) => {
                Err(format!("{}: {what}", of_layer(layer - 1)))
            }
            Err(Error::NoLayers) => {
                Err("there is no [[layers]]: a stack needs at least one, with \
                 young_modulus, poisson_ratio and thickness"
                    .into())
            }
            Err(error) => Err(error.to_string()),
        }
    }
}
