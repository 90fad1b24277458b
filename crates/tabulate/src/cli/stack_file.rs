//! Stacks of layers, as TOML files give them, or tables of a stack.

use std::io::{Read, Take};
use std::path::Path;
use std::sync::Arc;

use anyhow::{Context, anyhow};
use interp::Curve;

use super::table_name::TableName;
use crate::input::Limited;
use crate::solve::stack_curve;
use crate::stack::Stack;
use crate::stack::text::{NamedStack, Text};
use crate::table::StackTable;
use crate::{Error, input, printable};

/// The help of an argument that names a stack file. Clap shows it as it stands.
pub const HELP: &str = "Stack of layers, as a TOML file in SI units: base = { young_modulus = .., poisson_ratio = .. } and, \
    from the base up, a [[layers]] with young_modulus, poisson_ratio, thickness and perhaps a name, by which messages and fits call it, for each. A base with \
    young_modulus = inf is rigid and needs no Poisson ratio. A table of a stack, made of a scene with a [stack], stands for its stack";

/// The largest number of bytes of a stack file. A larger one is taken for a mistake.
const LONGEST: u64 = 1 << 20;

/// The first bytes of an HDF5 file.
const HDF5: &[u8] = b"\x89HDF\r\n\x1a\n";

/// A stack of layers that the command line names.
#[derive(Debug)]
pub struct NamedLayers {
    /// The stack.
    pub stack: Stack,
    /// What is known besides the layers.
    pub source: Source,
}

/// Where a stack is from.
#[derive(Debug)]
pub enum Source {
    /// A TOML file, with the names that it gives to layers, from the base up. Contacts are solved.
    Text { names: Vec<Option<String>> },
    /// A table. Contacts are looked up.
    Table(Arc<StackTable<'static>>),
}

impl NamedLayers {
    /// Makes the curve under a sphere of reduced modulus `sphere_modulus` (Pa): looks it up, or
    /// solves for it in the `range` of `a/t` to a relative `tolerance`.
    pub fn curve(
        &self,
        sphere_modulus: f64,
        range: [f64; 2],
        tolerance: f64,
    ) -> Result<Curve, Error> {
        match &self.source {
            Source::Text { .. } => stack_curve(&self.stack, sphere_modulus, range, tolerance),
            Source::Table(table) => table.curve(sphere_modulus),
        }
    }
}

/// Reads a stack file or a table. An error names the file, and the layer if it is about one.
pub fn read(path: &Path) -> anyhow::Result<NamedLayers> {
    let failed = |source| Error::Read {
        path: path.to_owned(),
        source,
    };
    let (file, _) = input::open(path, LONGEST).map_err(failed)?;
    let mut start: Take<Limited> = file.take(HDF5.len() as u64);
    let mut bytes = Vec::new();
    start.read_to_end(&mut bytes).map_err(failed)?;
    if bytes == HDF5 || interp::is_packed(&bytes) {
        let table = TableName::File(path.to_owned()).read()?;
        let table = StackTable::new(&table)
            .with_context(|| printable::path(path))?
            .into_owned();
        return Ok(NamedLayers {
            stack: table.stack().clone(),
            source: Source::Table(Arc::new(table)),
        });
    }
    // From where it stands: a pipe cannot be read again.
    let mut file = start.into_inner();
    file.read_to_end(&mut bytes).map_err(failed)?;
    let named = String::from_utf8(bytes)
        .map_err(anyhow::Error::from)
        .and_then(|text| parse(&text));
    let NamedStack { stack, names } = named.with_context(|| printable::path(path))?;
    Ok(NamedLayers {
        stack,
        source: Source::Text { names },
    })
}

/// Parses the text of a stack file.
fn parse(text: &str) -> anyhow::Result<NamedStack> {
    let text: Text =
        toml::from_str(text).map_err(|error| anyhow!("{}", error.to_string().trim_end()))?;
    text.stack().map_err(|what| anyhow!(what))
}

#[cfg(test)]
mod tests {
    use interp::Elastic;

    use super::*;
    use crate::hostile::each_damaged;

    const SOUND: &str = "base = { young_modulus = 2e11, poisson_ratio = 0.25 }\n\
         [[layers]]\nname = \"primer\"\nyoung_modulus = 5e5\npoisson_ratio = 0.5\nthickness = 2.5e-6\n\
         [[layers]]\nyoung_modulus = 35e5\npoisson_ratio = 0.5\nthickness = 75e-7\n";

    #[test]
    fn a_stack_file_is_read_as_it_stands() {
        let NamedStack { stack, names } = parse(SOUND).expect("sound");
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
        let base = parse(&rigid).expect("sound").stack.base();
        assert_eq!(base.young(), f64::INFINITY);
    }

    #[test]
    fn a_mistake_is_named_with_its_layer() {
        let cases = [
            (
                "5e5",
                "inf",
                ["layer \"primer\", 1 of 2", "give it as the base"],
            ),
            ("5e5", "-1", ["layer \"primer\", 1 of 2", "Young's modulus"]),
            ("35e5", "1e300", ["layer 2 of 2", "1e9 times"]),
            ("75e-7", "0", ["layer 2 of 2", "> 0 and finite"]),
            (
                "2e11, poisson_ratio = 0.25",
                "1",
                ["base", "poisson_ratio is missing"],
            ),
            (
                "poisson_ratio = 0.25",
                "poisson_ratio = 0.6",
                ["base", "(-1, 0.5]"],
            ),
            ("name", "label", ["unknown field", "label"]),
            ("name = \"primer\"", "name = \"\"", ["", ""]),
        ];
        for (from, to, parts) in cases {
            let text = SOUND.replacen(from, to, 1);
            if parts[0].is_empty() {
                parse(&text).expect("sound");
                continue;
            }
            let message = format!("{:#}", parse(&text).expect_err("refused"));
            for part in parts {
                assert!(message.contains(part), "{message:?} lacks {part:?}");
            }
        }
        let twice = SOUND.replace(
            "young_modulus = 35e5",
            "name = \"primer\"\nyoung_modulus = 35e5",
        );
        let message = format!("{:#}", parse(&twice).expect_err("refused"));
        assert!(
            message.contains("layer \"primer\", 2 of 2") && message.contains("layer 1"),
            "{message}"
        );
        let bare = format!(
            "{:#}",
            parse(SOUND.lines().next().expect("the base")).expect_err("refused")
        );
        assert!(bare.contains("no [[layers]]"), "{bare}");
    }

    #[test]
    fn a_damaged_stack_file_is_refused_or_sound() {
        const WORDS: [&str; 12] = [
            "nan",
            "inf",
            "-inf",
            "-",
            "0",
            "1e-308",
            "1e308",
            "[[layers]]",
            "name",
            "{",
            "\"",
            "\n",
        ];
        let (mut refused, mut accepted) = (0, 0);
        each_damaged(
            SOUND.as_bytes(),
            &WORDS,
            3,
            |_, bytes| match std::str::from_utf8(bytes).map(parse) {
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
