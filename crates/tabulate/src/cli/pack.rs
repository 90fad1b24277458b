//! `tabulate pack`

use std::path::PathBuf;

use super::read_table;
use crate::output;

/// Convert an HDF5 table to the packed form that `interp` loads without HDF5, value for value
#[derive(clap::Args)]
pub struct Arguments {
    /// The HDF5 table
    #[arg(value_name = "TABLE.h5")]
    table: PathBuf,
    /// The packed table to write
    #[arg(short, long, value_name = "TABLE.bin")]
    output: PathBuf,
}

pub fn run(arguments: &Arguments) -> anyhow::Result<()> {
    output::check(Some(&arguments.output), Some(&arguments.table))?;
    let bytes = read_table(&arguments.table)?.to_packed()?;
    Ok(output::atomically(&arguments.output, |unfinished| std::fs::write(unfinished, &bytes))?)
}
