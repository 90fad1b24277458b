//! Stacks of layers, as the command line names their files.

use std::path::Path;

pub use crate::stack::NamedStack;

/// The help of an argument that names a stack file. Clap shows it as it stands.
pub const HELP: &str = "Stack of layers, as a TOML file in SI units: base = { young_modulus = .., poisson_ratio = .. } and, \
    from the base up, a [[layers]] with young_modulus, poisson_ratio, thickness and perhaps a name, by which messages and fits call it, for each. A base with \
    young_modulus = inf is rigid and needs no Poisson ratio";

/// Reads a stack file. An error names the file, and the layer if it is about one.
pub fn read(path: &Path) -> anyhow::Result<NamedStack> {
    Ok(NamedStack::read(path)?)
}
