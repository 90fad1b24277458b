//! Stacks of layers, as the command line names them: a TOML file, or a table of a stack.

use std::fs::{self, File};
use std::io::{self, Read};
use std::path::Path;
use std::sync::Arc;

use anyhow::Context;
use interp::Table;

use super::note;
use super::quantity::PLAIN_MODULUS;
use super::table_name::TableName;
use crate::printable;
use crate::stack::NamedStack;
use crate::table::stack_of;
use solve::stack::Stack;

/// The help of an argument that names a stack file. Clap shows it as it stands.
pub const HELP: &str = "Stack of layers, as a TOML file in SI units: base = { young_modulus = .., poisson_ratio = .. } and, \
    for each layer from the base up, [[layers]] with young_modulus, poisson_ratio and thickness. Optional keys of a layer are name, \
    which messages and fits use, and interface, what joins it to what lies below: \"bonded\" (without the key), \"sliding\" or \
    { tangential_stiffness = PA_PER_M, normal_stiffness = inf }. A base with young_modulus = inf is rigid and needs no Poisson \
    ratio. In place of a TOML file, a table made of a scene with a [stack] names the stack of the scene";

/// The first bytes of an HDF5 file.
const HDF5: &[u8] = b"\x89HDF\r\n\x1a\n";

/// A stack of layers that the command line names.
#[derive(Clone, Debug)]
pub struct Layers {
    pub named: NamedStack,
    /// The table in which contacts are looked up; without one they are solved.
    pub table: Option<Arc<Table>>,
}

impl Layers {
    pub fn stack(&self) -> &Stack {
        &self.named.stack
    }
}

/// Reads a stack file or a table. An error names the file, and the layer if it is about one.
pub fn read(path: &Path) -> anyhow::Result<Layers> {
    if !is_table(path).unwrap_or(false) {
        let named = NamedStack::read(path)?;
        note_soft(path, &named);
        return Ok(Layers { named, table: None });
    }
    let table = TableName::File(path.to_owned()).read()?;
    let named = stack_of(&table).and_then(|named| Ok(named.ok_or(interp::Error::NotOfStack)?));
    let named = named.with_context(|| printable::path(path))?;
    let table = Some(Arc::new(table.into_owned()));
    Ok(Layers { named, table })
}

/// Notes on standard error that a modulus is that of no usual solid: a stack file has no units.
fn note_soft(path: &Path, named: &NamedStack) {
    let stack = &named.stack;
    let moduli = stack.layers().iter().map(|layer| layer.solid.young());
    let soft = moduli
        .chain([stack.base().young()])
        .find(|&young| young < PLAIN_MODULUS);
    if let Some(young) = soft {
        note(&format!(
            "{}: a Young's modulus is {young:?} Pa, softer than almost all solids. Stack files are in SI units: if MPa are \
             meant, write {young}e6, and {young}e9 for GPa.",
            printable::path(path)
        ));
    }
}

/// Returns whether a file begins as a table does. A pipe, which can be read once only, is none.
fn is_table(path: &Path) -> io::Result<bool> {
    let mut start = Vec::new();
    if fs::metadata(path)?.is_file() {
        File::open(path)?
            .take(HDF5.len() as u64)
            .read_to_end(&mut start)?;
    }
    Ok(start == HDF5 || interp::is_packed(&start))
}
