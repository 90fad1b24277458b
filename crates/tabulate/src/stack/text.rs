//! The text of a stack, and the stack with the names of its layers.

use std::path::Path;

use contact::magnitude::Magnitude;
use interp::{Elastic, Probe};
use serde::Deserialize;

use super::interface;
use crate::{Error, input};
use solve::stack::{Layer, Stack};

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
    interface: Option<toml::Value>,
}

/// A stack with the names of its layers, as a file or a scene gives them.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedStack {
    /// The stack.
    pub stack: Stack,
    /// The names of the layers, from the base up; `None` for a layer without one.
    pub names: Vec<Option<String>>,
}

impl NamedStack {
    /// Names what no contact has of a probe of a reduced modulus (Pa), of the layers and their base, and of the work of
    /// adhesion (J/m^2) between probe and layers.
    pub fn magnitudes(
        &self,
        probe: &Probe,
        sphere_modulus: f64,
        work_of_adhesion: f64,
    ) -> Vec<Magnitude> {
        let layers = self.stack.layers().iter();
        let layers = layers.map(|layer| [layer.thickness, layer.solid.young()]);
        let base = self.stack.base().young();
        Magnitude::of_layered(probe, sphere_modulus, base, layers, work_of_adhesion)
    }

    /// Reads a stack file: TOML in SI units.
    ///
    /// It has `base = { young_modulus = .., poisson_ratio = .. }` and, from the base up, a
    /// `[[layers]]` with `young_modulus`, `poisson_ratio`, `thickness` and perhaps a `name` and an
    /// `interface` for each layer. The interface is what joins the layer to what lies below it:
    /// `"bonded"`, which no interface means, `"sliding"`, or springs, `{ tangential_stiffness = ..,
    /// normal_stiffness = .. }` in Pa/m, of which the latter is infinity if it is left out. A base with
    /// `young_modulus = inf` is rigid and needs no Poisson ratio.
    ///
    /// # Errors
    /// [`Error::Read`] if the file cannot be read, or has more than a megabyte;
    /// [`Error::StackFile`] with the file, the layer, the value and the range.
    pub fn read(path: &Path) -> Result<Self, Error> {
        Self::parse(&input::text(path)?).map_err(|what| Error::StackFile {
            path: path.to_owned(),
            what,
        })
    }

    /// Parses the text of a stack file. An error is a sentence, which names the layer if it is
    /// about one.
    fn parse(text: &str) -> Result<Self, String> {
        let text: Text = toml::from_str(text).map_err(|error| {
            let about_a_number = ["expected f64", "must be quoted"]
                .iter()
                .any(|part| error.message().contains(part));
            let hint = if about_a_number {
                "; numbers here are in SI units and stand without quotes, such as 7.5e-6"
            } else {
                ""
            };
            format!("{}{hint}", error.to_string().trim_end())
        })?;
        text.stack()
    }
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
            let solid = Elastic::new(layer.young_modulus, layer.poisson_ratio)
                .map_err(|error| format!("{}: {error}", of_layer(i)))?;
            let interface = layer.interface.as_ref().map(interface::read).transpose();
            Ok(Layer {
                solid,
                thickness: layer.thickness,
                interface: interface
                    .map_err(|what| format!("{}: {what}", of_layer(i)))?
                    .unwrap_or_default(),
            })
        });
        match Stack::new(base, solids.collect::<Result<Vec<_>, String>>()?) {
            Ok(stack) => Ok(NamedStack { stack, names }),
            Err(solve::Error::Layer { layer, what, .. }) => {
                Err(format!("{}: {what}", of_layer(layer - 1)))
            }
            Err(solve::Error::NoLayers) => {
                Err("there is no [[layers]]: a stack needs at least one, with \
                 young_modulus, poisson_ratio and thickness"
                    .into())
            }
            Err(error) => Err(error.to_string()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hostile::each_damaged;

    const SOUND: &str = "base = { young_modulus = 2e11, poisson_ratio = 0.25 }\n\
         [[layers]]\nname = \"primer\"\nyoung_modulus = 5e5\npoisson_ratio = 0.5\nthickness = 2.5e-6\n\
         [[layers]]\nyoung_modulus = 35e5\npoisson_ratio = 0.5\nthickness = 75e-7\n";

    #[test]
    fn a_stack_file_is_read_as_it_stands() {
        let NamedStack { stack, names } = NamedStack::parse(SOUND).expect("sound");
        assert_eq!(names, [Some("primer".to_owned()), None]);
        let layers = stack.layers();
        assert_eq!(stack.base(), Elastic::new(2e11, 0.25).expect("physical"));
        assert_eq!(
            layers
                .iter()
                .map(|layer| layer.thickness)
                .collect::<Vec<_>>(),
            [2.5e-6, 7.5e-6]
        );
        let rigid = SOUND.replace("2e11, poisson_ratio = 0.25", "inf");
        let base = NamedStack::parse(&rigid).expect("sound").stack.base();
        assert_eq!(base.young(), f64::INFINITY);
    }

    #[test]
    fn a_mistake_is_named_with_its_layer() {
        let unnamed = SOUND.replace("\"primer\"", "\"\"");
        NamedStack::parse(&unnamed).expect("sound");
        // The text that is changed, the new one, and words of the message.
        let changes = "
            5e5 | inf | layer \"primer\", 1 of 2; give it as the base
            5e5 | -5e5 | layer \"primer\", 1 of 2; Young's modulus
            35e5 | 1e300 | layer 2 of 2; 1e9 times
            poisson_ratio = 0.5 | poisson_ratio = 0.51 | layer \"primer\", 1 of 2; (-1, 0.5]
            thickness | height | unknown field; height
            75e-7 | 0 | layer 2 of 2; > 0 and finite
            2e11, poisson_ratio = 0.25 | 1 | base; poisson_ratio is missing
            poisson_ratio = 0.25 | poisson_ratio = 0.6 | base; (-1, 0.5]
            name | label | unknown field; label";
        for line in changes.lines().skip(1) {
            let cells: Vec<&str> = line.trim().split(" | ").collect();
            let [from, to, words] = cells[..] else {
                panic!("not three cells: {line}")
            };
            let message = NamedStack::parse(&SOUND.replacen(from, to, 1)).expect_err(line);
            for word in words.split("; ") {
                assert!(message.contains(word), "{message:?} lacks {word:?}");
            }
        }
        let twice = SOUND.replace(
            "young_modulus = 35e5",
            "name = \"primer\"\nyoung_modulus = 35e5",
        );
        let message = NamedStack::parse(&twice).expect_err("refused");
        assert!(
            message.contains("layer \"primer\", 2 of 2") && message.contains("layer 1"),
            "{message}"
        );
        let bare = NamedStack::parse(SOUND.lines().next().expect("the base")).expect_err("refused");
        assert!(bare.contains("no [[layers]]"), "{bare}");
    }

    #[test]
    fn a_damaged_stack_file_is_refused_or_sound() {
        const INTERFACE: &str =
            "interface = { tangential_stiffness = 2e11, normal_stiffness = 3e12 }\n";
        const WORDS: &str = "nan|inf|-inf|-|0|1e-308|1e308|[[layers]]|name|interface|{|\"|\n";
        let (mut refused, mut accepted) = (0, 0);
        each_damaged(
            format!("{SOUND}{INTERFACE}").as_bytes(),
            WORDS,
            3,
            |_, bytes| match std::str::from_utf8(bytes).map(NamedStack::parse) {
                Ok(Ok(named)) => {
                    accepted += 1;
                    assert!(named.stack.thickness().is_finite());
                }
                _ => refused += 1,
            },
        );
        println!("{refused} refused, {accepted} accepted");
        assert!(refused > 0 && accepted > 0);
    }
}
