//! `tabulate unpack`

use std::path::PathBuf;

use super::read_table;
use crate::output;
use crate::table::archive;

/// Convert a packed table back to HDF5: value for value, or the values of a low-rank one at its
/// nodes
#[derive(clap::Args)]
pub struct Arguments {
    /// The packed table
    #[arg(value_name = "TABLE.bin")]
    table: PathBuf,
    /// The HDF5 table to write
    #[arg(short, long, value_name = "TABLE.h5")]
    output: PathBuf,
}

pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    output::check(Some(&arguments.output), Some(&arguments.table))?;
    Ok(archive::write(
        &read_table(&arguments.table)?,
        &arguments.output,
    )?)
}
