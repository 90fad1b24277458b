//! `tabulate unpack`

use std::path::PathBuf;

use anyhow::Context;
use interp::Table;

use crate::archive;

/// Convert a packed table back to HDF5, value for value
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
    let table = Table::read(&arguments.table).with_context(|| arguments.table.display().to_string())?;
    Ok(archive::write(&table, &arguments.output)?)
}
